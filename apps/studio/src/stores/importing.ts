import { withFreshIds } from "@twincell/core";
import { DIALECTS } from "@twincell/languages";
import { words } from "../words/index.ts";
import { cellStore } from "./cell.ts";
import { robotOf } from "./document.ts";
import { notify } from "./notices.ts";
import { addSteps } from "./program.ts";

/** A vendor's program text becomes steps behind the selected one. Returns what was not understood, one sentence each. */
export function importText(text: string, name = words.export.paste): readonly string[] {
  const { document } = cellStore.getState(), robot = robotOf(document);
  if (!document || !robot) return [words.run.nothing];
  const answers = DIALECTS.map(dialect => dialect.parse(text, robot, document.robot.worldFromBase));
  const parsed = answers.find(answer => answer.kind === "parsed");
  if (parsed?.kind !== "parsed") {
    const faults = answers.flatMap(answer => (answer.kind === "not-understood" ? answer.faults : [])).map(fault => words.export.line(fault.line, fault.column, fault.sentence));
    return faults.length > 0 ? faults : [words.run.notUnderstood];
  }
  const { program } = parsed;
  if (program.steps.length === 0) return [words.run.nothing];
  addSteps(words.undo.import, before => withFreshIds(before, program.steps), before => ({
    ...before, tools: { ...program.tools, ...before.tools }, frames: { ...program.frames, ...before.frames }, groups: { ...program.groups, ...before.groups },
  }));
  notify("done", words.export.imported(program.steps.length), parsed.warnings[0] ? words.export.line(parsed.warnings[0].line, parsed.warnings[0].column, parsed.warnings[0].sentence) : name);
  return [];
}
