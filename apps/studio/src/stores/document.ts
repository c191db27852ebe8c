import type { CellDocument, ObjectRecord, ToolRecord } from "@twincell/project";
import { robotById, type Pose, type Program, type Robot } from "@twincell/core";
import { cellStore } from "./cell.ts";

interface Moment { readonly label: string; readonly document: CellDocument }
const DEPTH = 200;
let past: readonly Moment[] = [];
let future: readonly Moment[] = [];
/** Edits with the same key within this time become one undo step: typing, dragging, nudging. */
const MERGE_MS = 800;
let lastKey = "", lastAt_ms = -Infinity;

function publish(document: CellDocument | null, unsaved: boolean): void {
  cellStore.setState(state => ({
    document, undo: past.map(moment => moment.label).reverse(), redo: future.map(moment => moment.label).reverse(),
    saving: unsaved ? { kind: "unsaved" } : state.saving,
  }));
}

/** Shows another document; undo starts afresh. */
export function showDocument(document: CellDocument): void {
  past = []; future = []; lastKey = "";
  publish(document, true);
}

/**
 * The only way to change the document. `change` returns the new document, or the same one when there is nothing to do.
 * @param merge  edits that share this key and follow one another quickly are one undo step; `at_ms` is their time.
 */
export function commit(label: string, change: (document: CellDocument) => CellDocument, merge?: { readonly key: string; readonly at_ms: number }): boolean {
  const before = cellStore.getState().document;
  if (!before) return false;
  const after = change(before);
  if (after === before) return false;
  const merged = merge !== undefined && merge.key === lastKey && merge.at_ms - lastAt_ms < MERGE_MS && past.length > 0;
  if (!merged) past = [...past.slice(1 - DEPTH), { label, document: before }];
  lastKey = merge?.key ?? ""; lastAt_ms = merge?.at_ms ?? -Infinity;
  future = [];
  publish(after, true);
  return true;
}

export function undo(): string | null {
  const moment = past.at(-1), now = cellStore.getState().document;
  if (!moment || !now) return null;
  past = past.slice(0, -1);
  future = [...future, { label: moment.label, document: now }];
  lastKey = "";
  publish(moment.document, true);
  return moment.label;
}
export function redo(): string | null {
  const moment = future.at(-1), now = cellStore.getState().document;
  if (!moment || !now) return null;
  future = future.slice(0, -1);
  past = [...past, { label: moment.label, document: now }];
  lastKey = "";
  publish(moment.document, true);
  return moment.label;
}

export const robotOf = (document: CellDocument | null): Robot | null => (document ? robotById(document.robot.id) ?? null : null);
export const programOf = (document: CellDocument | null): Program | null => document?.programs.find(program => program.name === document.program) ?? null;
export const toolOf = (document: CellDocument | null): ToolRecord | null => document?.tools.find(tool => tool.name === document.tool) ?? null;
export const objectOf = (document: CellDocument | null, id: string): ObjectRecord | null => document?.objects.find(object => object.id === id) ?? null;
export const theProgram = (): Program | null => programOf(cellStore.getState().document);
export const theRobot = (): Robot | null => robotOf(cellStore.getState().document);

/** The document with its current program changed. */
export function withProgram(document: CellDocument, change: (program: Program) => Program): CellDocument {
  const before = programOf(document);
  if (!before) return document;
  const after = change(before);
  return after === before ? document : { ...document, programs: document.programs.map(program => (program === before ? after : program)) };
}
export function withObject(document: CellDocument, id: string, change: (object: ObjectRecord) => ObjectRecord): CellDocument {
  const objects = document.objects.map(object => (object.id === id ? change(object) : object));
  return objects.every((object, i) => object === document.objects[i]) ? document : { ...document, objects };
}
/** Pose of the tool tip on the flange; the flange itself without a tool. */
export function flangeFromTcpOf(document: CellDocument | null): Pose<"flange", "tcp"> {
  return toolOf(document)?.flangeFromTcp ?? { position: [0, 0, 0], quaternion: [0, 0, 0, 1] };
}
