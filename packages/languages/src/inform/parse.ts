import { emptyProgram, type Pose, type Robot, type Signals } from "@twincell/core";
import { headingOr, plainText, textFault, textLines, unrolled, withComments, type Comment } from "../parser/index.ts";
import type { ReadSteps } from "../reading/checked-import.ts";
import { executable, openInform, type Run } from "./interpret.ts";
import type { PulseData } from "./pulses.ts";
import { keptOnController } from "./run/state.ts";

/**
 * The neutral program that jobs amount to, with TOOL.CND and UFRAME.CND behind them. The first job is executed
 * and its motions are written down, so loops, calls and shifts come out as what they do, and decisions by inputs as
 * decisions.
 */
export function parseInform(
  text: string,
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
  pulses: PulseData | undefined,
): ReadSteps {
  const opened = openInform(text, robot, worldFromBase, pulses);
  if (opened.kind === "not-understood") return opened;
  const runs: Run[] = [];
  const executed = (signals?: Signals): Run["steps"] => {
    const run = opened.start(signals);
    runs.push(run);
    return run.steps;
  };
  const done = unrolled(executed, opened.context.signals, { program: "job", statement: "an instruction" });
  if (done.kind === "not-understood") return done;
  const lines = textLines(text).map(plainText);
  const { tools, frames, signals } = opened.context;
  const assumed = [...new Map(runs.flatMap(run => [...run.assumed]))].map(([name, at]) =>
    textFault(at, "TOOL.CND or UFRAME.CND behind the job", keptOnController(name)),
  );
  return {
    kind: "parsed",
    waits: done.waits,
    executable: () => executable(opened),
    warnings: [...assumed, ...done.repeated],
    program: {
      ...emptyProgram(robot.id, nameOf(lines)),
      ...withComments(lines, done, comment),
      tools,
      frames,
      signals,
    },
  };
}

/** What a person called the job: its comment, or its name. */
function nameOf(lines: readonly string[]): string {
  const end = lines.findIndex(line => /^END\b/i.test(line.trim()));
  const head = lines.slice(0, end < 0 ? undefined : end);
  const of = (word: RegExp): string | undefined =>
    head.map(line => word.exec(line)?.[1]).find(text => text !== undefined);
  return of(/^\/\/\/COMM\s+(.*\S)/i) ?? of(/^\/\/NAME\s+(\S+)/i) ?? "Job";
}

/** `'name` before a step, `'== name` before a group of steps, `'* text` for a comment of its own. */
const comment = (line: string): Comment | undefined =>
  /^\/JOB\b/i.test(line) ? { kind: "new-part" } : headingOr(/^\s*'(.*)/.exec(line)?.[1]);
