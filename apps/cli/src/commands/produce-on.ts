import { statSync } from "node:fs";
import { createInterface } from "node:readline";
import { Fault, type CommandOutcome, type Program } from "@twincell/core";
import type { EventOf, Request } from "@twincell/protocol";
import type { Given } from "../io/arguments.ts";
import type { RobotAt } from "../io/at.ts";
import { codesOf } from "../io/one-step.ts";
import { UseFault } from "../io/usage.ts";

type Ask = (request: Request) => Promise<CommandOutcome>;
type State = EventOf<"production">;

export const PRODUCTION_OPTIONS = {
  cycles: { type: "string" },
  step: { type: "boolean" },
  breakpoint: { type: "string", multiple: true },
  reload: { type: "boolean" },
} as const;

export const PRODUCTION_HELP = `  --cycles N        N cycles one after the other, or "forever"; 1 when left out
  --breakpoint ID   held before that step; may be given again
  --step            held before each step
  --reload          FILE is read again whenever it is saved, checked, and takes over at the next cycle

With any of these four, lines on standard input steer the run, and how it stands is written on standard error:
  step, or an empty line   one step, when it is held
  resume | cycle           goes on with the step it was in | with a cycle from its beginning
  hold                     stops it, keeps the place and gives the lease away: others may move the robot by hand
  breakpoints [ID…]        from now on it is held before these
  replace FILE             that program takes over at the next cycle
  stop                     ends it`;

/** Whether the options ask for a production. */
export const isProduction = (options: Given): boolean =>
  options.text("cycles") !== undefined ||
  options.flag("step") ||
  options.flag("reload") ||
  options.list("breakpoint").length > 0;

/** How often it runs: null for until it is ended. */
export function cyclesOf(options: Given): number | null {
  const said = options.text("cycles");
  if (said === undefined) return 1;
  if (said === "forever") return null;
  const cycles = Number(said);
  if (!Number.isInteger(cycles) || cycles < 1)
    throw new UseFault(`--cycles wants a whole number of 1 or more, or "forever", not "${said}".`);
  return cycles;
}

/** How a production stands, for a person. */
export function stateLine({ state, cycle, of, program, step, next }: State): string {
  const which = `cycle ${cycle}${of === null ? "" : ` of ${of}`}`;
  const then = next === null ? "" : `; ${next} takes over at the next cycle`;
  if (state === "ended") return `production ended in ${which}`;
  const where = step === "" ? "" : state === "held" ? ` before step ${step}` : `, step ${step}`;
  return `${which}, ${program}: ${state}${where}${then}`;
}

/** Where lines come from that steer a production, and where it says how it stands. */
export interface Console {
  readonly input: NodeJS.ReadableStream;
  say(line: string): void;
}
/** Standard input, and standard error. */
export const PROCESS_CONSOLE: Console = {
  input: process.stdin,
  say(line) {
    process.stderr.write(`twincell: ${line}\n`);
  },
};

/** Runs a program cycle after cycle, steered by lines of a console. */
export async function produceOn(
  options: Given,
  { info, onTold }: Pick<RobotAt, "info" | "onTold">,
  ask: Ask,
  stop: () => void,
  program: Program,
  read: (path: string) => Promise<Program>,
  { input, say }: Console = PROCESS_CONSOLE,
): Promise<CommandOutcome> {
  const station = info.id;
  const cycles = cyclesOf(options);
  const asText = options.flag("as-text");
  const despite = codesOf(options);
  let isHeld = false;
  let last = "";
  /** Given away so that others may move the robot by hand. */
  let isGivenAway = false;
  let givesAway = false;
  const sayRefused = (outcome: CommandOutcome): void => {
    if (outcome.kind !== "done") say(`${outcome.why.sentence} ${outcome.why.hint}`);
  };
  const giveAway = async (): Promise<void> => {
    givesAway = false;
    sayRefused(await ask({ type: "release", station }));
    isGivenAway = true;
    say("The lease is given away: the robot may be moved by hand. resume or cycle takes it back.");
  };
  const off = onTold(message => {
    if (message.type !== "production" || message.station !== station) return;
    isHeld = message.state === "held";
    const line = stateLine(message);
    if (line !== last) say(line);
    last = line;
    if (isHeld && givesAway) void giveAway();
  });
  const takeBack = async (): Promise<boolean> => {
    if (!isGivenAway) return true;
    for (const request of [{ type: "take", station } as const, { type: "hold", station, pressed: true } as const]) {
      const outcome = await ask(request);
      sayRefused(outcome);
      if (outcome.kind !== "done") return false;
    }
    isGivenAway = false;
    return true;
  };
  const replace = async (path: string): Promise<void> => {
    let next: Program;
    try {
      next = await read(path);
    } catch (problem) {
      if (!(problem instanceof Fault)) throw problem;
      say(`${problem.message} ${problem.hint} What runs goes on.`);
      return;
    }
    sayRefused(await ask({ type: "replace", station, program: next, asText, despite }));
  };
  const obey = async (line: string): Promise<void> => {
    const [word = "", ...rest] = line.trim().split(/\s+/);
    switch (word) {
      case "":
      case "step":
        if (await takeBack()) sayRefused(await ask({ type: "single-step", station }));
        return;
      case "resume":
      case "cycle":
        if (await takeBack())
          sayRefused(await ask({ type: "resume", station, from: word === "resume" ? "step" : "cycle" }));
        return;
      case "hold":
        if (isHeld) await giveAway();
        else {
          givesAway = true;
          sayRefused(await ask({ type: "intervene", station }));
        }
        return;
      case "breakpoints":
        sayRefused(await ask({ type: "breakpoints", station, steps: rest }));
        return;
      case "replace":
        if (rest.length === 0) say("replace wants the path of a program.");
        else await replace(rest.join(" "));
        return;
      case "stop":
        stop();
        return;
      default:
        say(`There is no "${word}" here: step, resume, cycle, hold, breakpoints, replace or stop.`);
    }
  };
  const [path] = options.positionals;
  const reloaded = options.flag("reload") ? path : undefined;
  const lines = createInterface({ input });
  lines.on("line", line => void obey(line));
  // From here on: what is saved before the first look counts too.
  let known = reloaded === undefined ? "" : stampOf(reloaded);
  const looking = setInterval(() => {
    const now = reloaded === undefined ? "" : stampOf(reloaded);
    if (reloaded === undefined || now === known || now === "") return;
    known = now;
    void replace(reloaded);
  }, RELOAD_MS);
  try {
    return await ask({
      type: "produce",
      station,
      program,
      asText,
      despite,
      cycles,
      breakpoints: [...options.list("breakpoint")],
      stepping: options.flag("step"),
    });
  } finally {
    off();
    lines.close();
    if (input === process.stdin) process.stdin.unref();
    clearInterval(looking);
  }
}
/** A saved file is seen within this [ms]. */
const RELOAD_MS = 250;
/** What changes when a file is saved; "" while there is none. */
function stampOf(path: string): string {
  const stat = statSync(path, { throwIfNoEntry: false });
  return stat ? `${stat.mtimeMs} ${stat.size}` : "";
}
