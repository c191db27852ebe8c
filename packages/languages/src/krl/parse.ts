import { type Pose, type Robot, type TextFault } from "@twincell/core";
import { textFault, type Comment, programOfExecution, metByName } from "../parser/index.ts";
import type { ReadSteps } from "../reading/checked-import.ts";
import { assumedFaults, openKrl, type Run } from "./interpret.ts";

/**
 * The neutral program that a KRL text amounts to: a .src, with its .dat behind it. It is executed and its motions are
 * written down, so loops, calls and pallets come out as what they do, and decisions by inputs as decisions.
 */
export function parseKrl(text: string, robot: Robot, worldFromBase: Pose<"world", "base">): ReadSteps {
  const opened = openKrl(text, robot, worldFromBase);
  if (opened.kind === "not-understood") return opened;
  return programOfExecution<Run>(text, robot, {
    start: opened.start,
    declared: opened.context,
    executable: () => ({ kind: "ready", run: signals => opened.start(signals).steps, context: opened.context }),
    words: { program: "program", statement: "a statement" },
    title: nameOf,
    comment,
    warnings: runs => [
      ...assumedFaults(metByName(runs, run => run.assumed)),
      ...metByName(runs, run => run.notes).values(),
      ...warned(runs),
    ],
  });
}

/** What was odd on the way, each once. */
function warned(runs: readonly Run[]): TextFault[] {
  const said = new Map(
    runs.flatMap(run => run.warned.map(each => [`${each.at.line} ${each.sentence}`, each] as const)),
  );
  return [...said.values()].map(({ at, sentence }) => textFault(at, "an axis from 1 to 6", sentence));
}

/** What a person called the program: its &COMMENT, or the name of its first routine. */
function nameOf(lines: readonly string[]): string {
  const comment = lines.map(line => /^\s*&\s*COMMENT\s+(.*\S)/i.exec(line)?.[1]).find(text => text !== undefined);
  return (
    comment ??
    lines.map(line => /^\s*(?:GLOBAL\s+)?DEF\s+([^\s(;]+)/i.exec(line)?.[1]).find(text => text !== undefined) ??
    "Program"
  );
}

/** Folds that the editor of the controller makes by itself. */
const OWN_FOLD = /^(?:INI|BASISTECH|USER|EXTERNAL|MODULE)\b|;%\{/i;

/** `;name` before a step, `;FOLD name` around a group of steps, `;* text` for a comment of its own. */
function comment(line: string): Comment | undefined {
  const said = /^\s*;(.*)/.exec(line)?.[1]?.trim() ?? "";
  if (said === "") return undefined;
  const fold = /^FOLD\b\s*(.*)/i.exec(said)?.[1];
  if (fold !== undefined) return { kind: "fold", text: OWN_FOLD.test(fold) ? "" : fold };
  if (/^ENDFOLD\b/i.test(said)) return { kind: "end-of-fold" };
  return said.startsWith("*") ? { kind: "remark", text: said.slice(1).trim() } : { kind: "name", text: said };
}
