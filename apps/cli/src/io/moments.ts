import {
  armScratch,
  compose,
  everyStep,
  flangePose,
  identity,
  type Pose,
  type Program,
  type Robot,
} from "@twincell/core";
import { UseFault } from "./usage.ts";

/** Gripper and signals by name. */
export type Io = Readonly<Record<string, boolean | number>>;

/** One line of `simulate` and `run`: where everything is at that time. TCP in the world. */
export interface Moment {
  readonly t: number;
  readonly q: readonly number[];
  readonly position: readonly number[];
  readonly quaternion: readonly number[];
  readonly io: Io;
  readonly step: string;
}

/** Makes moments from joint angles; the TCP is that of the tool the step moves. */
export function momentWriter(
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
  tools: Program["tools"],
  toolOfStep: (step: string) => string,
) {
  const scratch = armScratch();
  const flange = identity<"base", "flange">();
  const none = identity<"flange", "tcp">();
  return (t: number, q: Float64Array, io: Io, step: string): Moment => {
    const tcp = compose(
      worldFromBase,
      compose(flangePose(robot.arm, q, flange, scratch), tools[toolOfStep(step)] ?? none),
    );
    return { t: Number(t.toFixed(9)), q: Array.from(q), position: tcp.position, quaternion: tcp.quaternion, io, step };
  };
}

/** Name of the tool each step moves; a wait keeps the tool of the move before it. */
export function toolsBySteps(program: Program): (step: string) => string {
  const tools = new Map<string, string>();
  let last = "flange";
  for (const step of everyStep(program)) {
    if (step.type === "move") last = step.target.tool ?? "flange";
    tools.set(step.id, last);
  }
  return id => tools.get(id) ?? "flange";
}

/** What every line is: gripper first, then the signals of the program, then any other that was written. */
export function ioOf(
  gripperClosed: boolean,
  lines: Program["signals"],
  known: ReadonlyMap<string, boolean | number>,
): Io {
  const quiet = Object.entries(lines).map(
    ([name, { kind }]) => [name, kind.startsWith("analogue") ? 0 : false] as const,
  );
  return Object.fromEntries([["gripper", gripperClosed], ...quiet, ...known]);
}

/** Inputs as they are given on the command line: part=true,level=2.5 */
export function inputsFrom(text: string | undefined): Record<string, boolean | number> {
  return Object.fromEntries(
    (text ?? "")
      .split(",")
      .filter(entry => entry !== "")
      .map(entry => {
        const at = entry.indexOf("=");
        const name = entry.slice(0, at).trim();
        const word = entry.slice(at + 1).trim();
        const value = word === "true" ? true : word === "false" ? false : Number(word);
        if (at < 1 || word === "" || Number.isNaN(value))
          throw new UseFault(`“${entry}” is no input.`, "Write part=true,level=2.5.");
        return [name, value];
      }),
  );
}
