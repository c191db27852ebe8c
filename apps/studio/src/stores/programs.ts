import { emptyProgram } from "@twincell/core";
import { addProgram, duplicateProgram, removeProgram, renameProgram, selectProgram } from "@twincell/project";
import { words } from "../messages/index.ts";
import { cellStore } from "./cell.ts";
import { commit } from "./document.ts";
import { notify } from "./notices.ts";
import { select } from "./selection.ts";

/** A cell stores several programs; one of them is worked on, checked, exported and run (row T-71). */
const edit = (label: string, change: Parameters<typeof commit>[1]): boolean => {
  const done = commit(label, change);
  // A step of the program before is not one of this.
  if (done) select(null);
  return done;
};
const current = (): string => cellStore.getState().document?.program ?? "";

export const chooseProgram = (name: string): boolean =>
  edit(words.undo.selectProgram(name), document => selectProgram(document, name));
export const newProgram = (): boolean =>
  edit(words.undo.addProgram, document => addProgram(document, emptyProgram(document.robot.id, words.programs.plain)));
export const copyProgram = (): boolean =>
  edit(words.undo.duplicateProgram, document => duplicateProgram(document, document.program));
export const nameProgram = (name: string): boolean =>
  commit(words.undo.renameProgram, document => renameProgram(document, document.program, name));
export function deleteProgram(): boolean {
  const name = current();
  const done = edit(words.undo.removeProgram(name), document => removeProgram(document, document.program));
  if (done) notify("info", words.programs.removed(name));
  return done;
}
