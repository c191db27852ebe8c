import type { CommandOutcome, EmittedFile, Refusal, Robot, Scheduler } from "@twincell/core";
import { C3_COMMAND } from "../codec/c3.ts";
import { OVERWRITE } from "../codec/c3-requests.ts";
import type { C3Client } from "./client.ts";
import type { KukaState } from "./state.ts";
import * as say from "./words.ts";
import { refused, stopped } from "../../outcomes.ts";

const CHUNK = 32_000;
const LOOK_S = 0.012;
const FOLDER = "KRC:\\R1\\PROGRAM\\";

export interface RunningText {
  readonly outcome: Promise<CommandOutcome>;
  stop(): void;
}

/**
 * Writes a module to the controller and selects it in the place of the running program; the name under which it then
 * stands there.
 */
export async function handKrl(
  files: readonly EmittedFile[],
  client: C3Client,
): Promise<{ readonly kind: "selected"; readonly name: string } | { readonly kind: "refused"; readonly why: Refusal }> {
  const main = mainOf(files);
  if (!main) return { kind: "refused", why: say.fileRefused("without .src") };
  for (const file of files) if (!(await put(client, file))) return { kind: "refused", why: say.fileRefused(file.name) };
  const name = nameOf(main);
  await client.order({ kind: "control", command: C3_COMMAND.cancel, interpreter: 1 });
  if (
    !(await client.order({ kind: "select", run: false, name: `${FOLDER}${main.name}`, parameters: "", force: false }))
  )
    return { kind: "refused", why: say.programRefused(name) };
  return { kind: "selected", name };
}

/**
 * Starts the selected module and waits for its end. The first motion runs to the path at reduced speed; where the
 * controller then asks for a second start it gets it, as part of the same command.
 */
export function runKrl(
  name: string,
  client: C3Client,
  state: KukaState,
  scheduler: Scheduler,
  robot: Robot,
): RunningText {
  let wanted = true;
  const control = (command: number): Promise<boolean> => client.order({ kind: "control", command, interpreter: 1 });

  async function outcome(): Promise<CommandOutcome> {
    return (await control(C3_COMMAND.start))
      ? watched(name)
      : refused(wanted ? say.programRefused(name) : say.stoppedHere(robot));
  }

  /** Follows the states of the controller to the end of the program. */
  function watched(name: string): Promise<CommandOutcome> {
    let seen = state.sample.sequence;
    let second = false;
    return new Promise(resolve => {
      const stopLooking = scheduler.every(LOOK_S, () => {
        if (client.isClosed) {
          stopLooking();
          resolve(stopped(say.closedHere));
          return;
        }
        if (state.sample.sequence === seen) return;
        seen = state.sample.sequence;
        const end = (with_: CommandOutcome): void => {
          stopLooking();
          void control(C3_COMMAND.cancel).then(() => {
            resolve(with_);
          });
        };
        if (state.program !== name) return;
        if (state.programState === "P_END") end({ kind: "done" });
        if (state.programState !== "P_STOP") return;
        if (!wanted || state.sample.safety !== "normal")
          end({
            kind: "stopped",
            why: wanted ? { ...say.notCarriedOut, sentence: state.sample.message } : say.stoppedHere(robot),
          });
        else if (!second) {
          second = true;
          void control(C3_COMMAND.start);
        } else if (!state.sample.moving) end({ kind: "stopped", why: say.notCarriedOut });
      });
    });
  }

  return {
    outcome: outcome(),
    stop() {
      wanted = false;
      void control(C3_COMMAND.stop);
    },
  };
}

const mainOf = (files: readonly EmittedFile[]): EmittedFile | undefined =>
  files.find(({ name }) => /\.src$/i.test(name));
const nameOf = ({ name }: EmittedFile): string => name.replace(/\.src$/i, "").toUpperCase();
/** What the controller will call the program of those files; "" when there is none. */
export const programOf = (files: readonly EmittedFile[]): string => {
  const main = mainOf(files);
  return main ? nameOf(main) : "";
};

async function put(client: C3Client, { name, text }: EmittedFile): Promise<boolean> {
  const bytes = Uint8Array.from(text, sign => sign.charCodeAt(0) & 255);
  if (!(await client.order({ kind: "put-begin", size: bytes.length }))) return false;
  for (let offset = 0; offset < bytes.length; offset += CHUNK) {
    if (!(await client.order({ kind: "put-data", offset, data: bytes.subarray(offset, offset + CHUNK) }))) return false;
  }
  return client.order({ kind: "put-end", flags: OVERWRITE, name: `${FOLDER}${name}` });
}
