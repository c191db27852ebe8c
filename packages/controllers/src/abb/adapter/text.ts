import type { CommandOutcome, EmittedFile, UploadedProgram, Refusal, Robot, Scheduler } from "@twincell/core";
import { latin1Bytes, pathText } from "../../http/index.ts";
import { EGM_FILE, EGM_MODULE, TASK } from "../codec/index.ts";
import type { RwsClient, RwsReply } from "./rws-client.ts";
import type { PanelState } from "./rws-state.ts";
import { noModule, refusedThere, wasStopped } from "./words.ts";
import { DONE, stopped } from "../../outcomes.ts";

/**
 * A text from its being handed over to its end. A stop counts from the beginning, and ends it also before it was
 * started.
 */
export interface TextRun {
  readonly handed: Promise<UploadedProgram>;
  stop(): void;
}

const FOLDER = "$HOME";
const LOOK_S = 0.05;
const STOPS_S = 5;
const MODULE = /^\s*MODULE\s+([A-Za-z][A-Za-z0-9_]*)/im;
const execution = (action: string): string => `/rw/rapid/execution?action=${action}`;
const tasks = (action: string): string => `/rw/rapid/tasks/${TASK}?action=${action}`;
const START = {
  regain: "continue",
  execmode: "continue",
  condition: "none",
  stopatbp: "disabled",
  alltaskbytsp: "true",
} as const;
export const startProgram = (client: RwsClient, cycle: "once" | "forever"): Promise<RwsReply> =>
  client.post(execution("start"), { ...START, cycle });
/** @param quick  as fast as the motors can, also where a motion of the program is under way. */
export const stopProgram = (client: RwsClient, quick = false): Promise<RwsReply> =>
  client.post(execution("stop"), { stopmode: quick ? "qstop" : "stop" });
export const pointToMain = (client: RwsClient): Promise<RwsReply> => client.post(execution("resetpp"));

const wrong = (what: string, reply: RwsReply): Refusal | null =>
  reply.kind === "answer" ? null : refusedThere(what, reply.sentence);

/**
 * The program that waits for targets has its place again; whether it is started is for who calls. Why not, or null:
 * another program is never taken for it.
 */
export async function putBack(client: RwsClient, left: Set<string>): Promise<Refusal | null> {
  const modules = await client.get(`/rw/rapid/modules?task=${TASK}`);
  const names = modules.kind === "answer" ? modules.states.map(({ fields, title }) => fields["name"] ?? title) : null;
  if (!names) return wrong("Reading which modules are loaded", modules);
  for (const module of [...left]) {
    const gone = names.includes(module) ? await client.post(tasks("unloadmod"), { module }) : null;
    const why = gone && wrong(`Unloading ${module}`, gone);
    if (why) return why;
    left.delete(module);
  }
  const why = names.includes(EGM_MODULE)
    ? null
    : (wrong(
        `Loading ${EGM_FILE}`,
        await client.post(tasks("loadmod"), { modulepath: `${FOLDER}/${EGM_FILE}`, replace: "true" }),
      ) ?? wrong("Setting the program pointer to PROC main", await pointToMain(client)));
  await client.post("/rw/mastership/rapid?action=release");
  return why;
}

/**
 * Puts modules on the controller and loads them in the place of the program that waits for targets; started, they run
 * once from PROC main to their end. That program has its place again then. Mastership of RAPID is held all the time.
 *
 * @param left  modules of texts that are on the controller, kept by who calls: what could not be taken away now is
 *   taken away later.
 * @param isMoving  by the last state: what comes next begins when the robot has come to rest.
 * @param over  called when it has its place again; `well` unless the controller itself stopped the text, which a person
 *   looks at first.
 */
export function handRapid(
  files: readonly EmittedFile[],
  client: RwsClient,
  state: PanelState,
  scheduler: Scheduler,
  robot: Robot,
  left: Set<string>,
  isMoving: () => boolean,
  over: (well: boolean) => Promise<void>,
): TextRun {
  let wanted = true;
  const modules = files
    .filter(({ name }) => /\.(mod|sys)$/i.test(name))
    .map(file => ({ ...file, module: MODULE.exec(file.text)?.[1] ?? "" }));
  const pause = (): Promise<void> =>
    new Promise(resolve => {
      const stop = scheduler.every(LOOK_S, () => {
        stop();
        resolve();
      });
    });
  /** The state of the execution, asked for now. */
  const isRunning = async (): Promise<boolean | null> => {
    const reply = await client.get("/rw/rapid/execution");
    return reply.kind === "answer" && state.takePanel("ctrlexecstate", reply.states) ? state.isRunning : null;
  };
  async function stands(): Promise<boolean> {
    for (const from_s = scheduler.now_s(); scheduler.now_s() - from_s < STOPS_S; await pause()) {
      const running = await isRunning();
      if (running === null) return false;
      if (!running && !isMoving()) return true;
    }
    return false;
  }

  async function load(): Promise<Refusal | null> {
    for (const { name, text } of modules) {
      const why = wrong(
        `Writing ${name}`,
        await client.put(pathText(["fileservice", FOLDER, name]), latin1Bytes(text)),
      );
      if (why) return why;
    }
    for (const { module } of modules) if (module !== "") left.add(module);
    // Where it is not loaded there is nothing in the way.
    await client.post(tasks("unloadmod"), { module: EGM_MODULE });
    for (const { name } of modules) {
      const why = wrong(
        `Loading ${name}`,
        await client.post(tasks("loadmod"), { modulepath: `${FOLDER}/${name}`, replace: "true" }),
      );
      if (why) return why;
    }
    return wrong("Setting the program pointer to PROC main", await pointToMain(client));
  }
  /** Runs to the end, whoever ends it. */
  async function carriedOut(): Promise<CommandOutcome> {
    if (!wanted) return stopped(wasStopped(robot));
    const why = wrong("Starting the program", await startProgram(client, "once"));
    if (why) return { kind: "refused", why };
    for (;;) {
      await pause();
      const running = await isRunning();
      if (running === null) return stopped(refusedThere("The program", "the controller does not say whether it runs."));
      if (!running) break;
    }
    const task = await client.get("/rw/rapid/tasks");
    const own =
      task.kind === "answer" ? task.states.find(({ fields, title }) => (fields["name"] ?? title) === TASK) : undefined;
    // At its beginning again: it ended by itself.
    if (wanted && own?.fields["excstate"]?.startsWith("read")) return DONE;
    if (!wanted) return stopped(wasStopped(robot));
    const log = await client.get("/rw/elog/0?lang=en");
    const last = log.kind === "answer" ? log.states[0]?.fields : undefined;
    return stopped(
      refusedThere(
        "The program stopped",
        last ? `${last["title"] ?? ""}: ${last["desc"] ?? ""}` : "the controller does not say why.",
      ),
    );
  }

  async function giveBack(well: boolean): Promise<void> {
    await stands();
    await putBack(client, left);
    await over(well);
  }

  async function handed(): Promise<UploadedProgram> {
    if (modules.length === 0) return { kind: "refused", why: noModule() };
    const mine = wrong("Mastership of RAPID", await client.post("/rw/mastership/rapid?action=request"));
    if (mine) return { kind: "refused", why: mine };
    const why =
      wrong("Stopping the program that runs", await stopProgram(client)) ??
      ((await stands()) ? await load() : refusedThere("Stopping the program that runs", "it goes on running."));
    if (why) {
      await giveBack(true);
      return { kind: "refused", why };
    }
    return {
      kind: "handed",
      drop() {
        void giveBack(true);
      },
      async start() {
        const outcome = await carriedOut();
        await giveBack(outcome.kind === "done" || !wanted);
        return outcome;
      },
    };
  }
  return {
    handed: handed(),
    stop() {
      wanted = false;
      void stopProgram(client, true);
    },
  };
}
