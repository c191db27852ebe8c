import { withFreshIds, type Parsed, type Program } from "@twincell/core";
import { readText } from "../runtime/planning/reading.ts";
import { words } from "../messages/index.ts";
import { cellStore } from "./cell.ts";
import { robotOf } from "./document.ts";
import { notify } from "./notices.ts";
import { addSteps } from "./program.ts";

/**
 * A vendor's program text becomes steps behind the selected one. Returns what was not understood, one sentence each.
 */
export function importText(text: string, name: string): readonly string[] {
  const { document } = cellStore.getState();
  const robot = robotOf(document);
  if (!document || !robot) return [words.run.nothing];
  const reading = readText(text, robot, document.robot.worldFromBase, name);
  if (!reading) return [words.run.notUnderstood];
  if (reading.parsed.kind === "not-understood") {
    return reading.parsed.faults.length > 0
      ? reading.parsed.faults.map(fault => words.export.line(fault.line, fault.column, fault.sentence))
      : [words.run.notUnderstood];
  }
  return importParsed(reading.parsed, name) ? [] : [words.run.nothing];
}

/** What was read of a text becomes steps. Says whether there were any. */
export function importParsed({ program, warnings }: Extract<Parsed, { kind: "parsed" }>, name: string): boolean {
  if (program.steps.length === 0) return false;
  const added = addSteps(
    words.undo.import,
    before => withFreshIds(before, program.steps),
    before => ({
      ...before,
      tools: { ...program.tools, ...before.tools },
      frames: { ...program.frames, ...before.frames },
      groups: { ...program.groups, ...before.groups },
      signals: { ...program.signals, ...before.signals },
      pallets: { ...program.pallets, ...before.pallets },
      routines: withRoutines(before, program.routines),
    }),
  );
  const [warning] = warnings;
  if (added)
    notify(
      "done",
      words.export.imported(program.steps.length),
      warning ? words.export.line(warning.line, warning.column, warning.sentence) : name,
    );
  return added;
}

/**
 * Routines of a text beside those of the program, under ids of their own; one whose name is taken stays as the program
 * has it.
 */
function withRoutines(before: Program, routines: Program["routines"]): Program["routines"] {
  let so = before;
  for (const [name, steps] of Object.entries(routines))
    if (!Object.hasOwn(so.routines, name))
      so = { ...so, routines: { ...so.routines, [name]: withFreshIds(so, steps) } };
  return so.routines;
}
