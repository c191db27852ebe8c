import type { CellDocument } from "./document.ts";

/** Steps back that are kept. A cell shares what did not change with its predecessor: a day of work is some MB. */
const DEPTH = 10_000;

interface Entry {
  readonly label: string;
  readonly document: CellDocument;
}

/** A document with its past and future. Never changes: every method answers with a new history. */
export interface History {
  readonly document: CellDocument;
  /** What undo would take back, newest first. */
  readonly undoLabels: readonly string[];
  /** What redo would do again, next first. */
  readonly redoLabels: readonly string[];
  /**
   * The document after one more change. `label` says it to a person ("Move point 3"). Commits that follow each other
   * with the same `gesture` (one drag of a slider) count as one change. Forgets what could be redone.
   */
  commit(label: string, next: CellDocument, gesture?: string): History;
  /** The same history when there is nothing to take back. */
  undo(): History;
  redo(): History;
}

/** A history without past. At most `depth` changes can be taken back; older ones are forgotten. */
export function createHistory(document: CellDocument, depth = DEPTH): History {
  return history(document, [], [], depth);
}

/** past: newest last, each with the document before its change. future: next last, each with the document after. */
function history(
  document: CellDocument,
  past: readonly Entry[],
  future: readonly Entry[],
  depth: number,
  gesture?: string,
): History {
  const self: History = {
    document,
    undoLabels: past.map(entry => entry.label).reverse(),
    redoLabels: future.map(entry => entry.label).reverse(),
    commit(label, next, nextGesture) {
      if (next === document) return self;
      const goesOn = nextGesture !== undefined && nextGesture === gesture && past.length > 0;
      const longer = goesOn ? past : [...past, { label, document }];
      return history(next, longer.slice(Math.max(0, longer.length - depth)), [], depth, nextGesture);
    },
    undo() {
      const last = past.at(-1);
      if (last === undefined) return self;
      return history(last.document, past.slice(0, -1), [...future, { label: last.label, document }], depth);
    },
    redo() {
      const next = future.at(-1);
      if (next === undefined) return self;
      return history(next.document, [...past, { label: next.label, document }], future.slice(0, -1), depth);
    },
  };
  return self;
}
