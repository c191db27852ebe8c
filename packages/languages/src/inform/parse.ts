import { type Pose, type Robot } from "@twincell/core";
import { headingOr, textFault, type Comment, programOfExecution, metByName } from "../parser/index.ts";
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
  return programOfExecution<Run>(text, robot, {
    start: opened.start,
    declared: opened.context,
    executable: () => executable(opened),
    words: { program: "job", statement: "an instruction" },
    title: nameOf,
    comment,
    warnings: runs =>
      Array.from(
        metByName(runs, run => run.assumed),
        ([name, at]) => textFault(at, "TOOL.CND or UFRAME.CND behind the job", keptOnController(name)),
      ),
  });
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
