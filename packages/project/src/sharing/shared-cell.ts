import * as Y from "yjs";
import type { CellDocument } from "../document.ts";
import type { History } from "../history.ts";
import { decode, keysInOrder, writeChanges, type Namer } from "./encode.ts";
import { CELL_LAYOUT, isRecord } from "./layout.ts";
import { mendMerged } from "./mend.ts";
import { markOf } from "./order.ts";

/** Where the cell is in the shared document. */
export const ROOT = "cell";
const OWN = "own";
const OTHERS = "others";
/** Steps back that are kept. */
const DEPTH = 200;

export interface SharedCellOptions {
  /** A cell that is shared from here on, or the state of one that others share already. */
  readonly from: { readonly document: CellDocument } | { readonly state: Uint8Array };
  /** What is made of every merged state before it is looked at: the same for every editor of the cell. */
  readonly normalise?: ((document: CellDocument) => CellDocument) | undefined;
  /** The number of this editor, at least 1 and less than 2³²; a random one when left out. */
  readonly editor?: number | undefined;
}

/**
 * A cell document that several people edit at the same time: what each of them changes is merged, whatever order it
 * comes in, and every editor has the same cell once everybody has everything. Undo takes back what this editor did.
 * Which program is worked on is each editor's own.
 */
export interface SharedCell {
  /** The cell as it is now. Parts that did not change are the very same objects as before. */
  readonly document: CellDocument;
  readonly undoLabels: readonly string[];
  readonly redoLabels: readonly string[];
  /**
   * Writes what differs between `document` and `after`. Commits that follow each other with the same `gesture` are one
   * step of undo.
   */
  commit(label: string, after: CellDocument, gesture?: string): void;
  undo(): void;
  redo(): void;
  /** Everything, for somebody who has nothing yet or for a disk. */
  state(): Uint8Array;
  /** What this editor has, in short. */
  vector(): Uint8Array;
  /** What somebody with that vector has not. */
  missing(vector: Uint8Array): Uint8Array;
  /** Takes what another editor did. Throws when the bytes are no update. */
  apply(update: Uint8Array): void;
  /** Whether something came that builds on what never came. */
  readonly incomplete: boolean;
  /** Told of every change, own ones with the update to be sent. */
  onChange(listener: (update: Uint8Array, own: boolean) => void): () => void;
  close(): void;
}

/** The cell as it was last read, and what it was made of. */
interface Seen {
  readonly merged: unknown;
  readonly program: string | null;
  readonly document: CellDocument;
}

/** Whether an update changes anything. Throws when the bytes are no update. */
export function changesSomething(update: Uint8Array): boolean {
  const { structs, ds } = Y.decodeUpdate(update);
  return structs.length > 0 || ds.clients.size > 0;
}

/** @throws Error when the state is none of a shared cell. */
export function createSharedCell({ from, normalise = cell => cell, editor }: SharedCellOptions): SharedCell {
  const doc = new Y.Doc();
  if (editor !== undefined) doc.clientID = editor;
  const root = doc.getMap<unknown>(ROOT);
  let count = 0;
  const namer: Namer = {
    // An editor begins a session with a number of its own, so that no key of another is met.
    newKey: () => `${doc.clientID.toString(36)}.${(count++).toString(36)}`,
    mark: markOf(doc.clientID),
  };
  const known = new WeakMap<object, unknown>();
  doc.on("beforeObserverCalls", ({ changed }: Y.Transaction) => {
    for (const type of changed.keys())
      for (let at: Y.AbstractType<unknown> | null = type as Y.AbstractType<unknown>; at; at = at.parent)
        known.delete(at);
  });
  if ("state" in from) Y.applyUpdate(doc, from.state, OTHERS);
  else {
    const whole = { sensors: [], people: [], zones: [], comments: [], ...from.document };
    doc.transact(() => {
      writeChanges(root, CELL_LAYOUT, {}, whole, namer);
    }, OTHERS);
  }
  // Keys of this session begin where an earlier one with the same number ended.
  count = Y.getState(doc.store, doc.clientID);
  const undo = new Y.UndoManager(root, { trackedOrigins: new Set([OWN]), captureTimeout: Number.MAX_SAFE_INTEGER });
  let program: string | null = null;
  let seen: Seen | null = null;

  function read(): CellDocument {
    const merged = decode(root, CELL_LAYOUT, known);
    if (seen !== null && seen.merged === merged && seen.program === program) return seen.document;
    if (!isRecord(merged) || !Array.isArray(merged["programs"])) throw new Error("There is no cell in this document.");
    const whole = normalise(mendMerged(merged as unknown as CellDocument));
    const keys = programKeys();
    const at = program === null ? -1 : keys.indexOf(program);
    const name = whole.programs[at]?.name ?? whole.program;
    const document = name === whole.program ? whole : { ...whole, program: name };
    seen = { merged, program, document };
    return document;
  }
  function programKeys(): readonly string[] {
    const programs = root.get("programs");
    return programs instanceof Y.Map ? keysInOrder(programs) : [];
  }
  let label = "";
  let gestureNow: string | undefined;
  undo.on("stack-item-added", ({ stackItem }: { stackItem: { meta: Map<string, string> } }) => {
    stackItem.meta.set("label", stackItem.meta.get("label") ?? label);
  });
  const labelsOf = (stack: readonly { readonly meta: Map<unknown, unknown> }[]): readonly string[] =>
    stack.map(item => String(item.meta.get("label") ?? "")).toReversed();
  read();
  return {
    get document() {
      return read();
    },
    get undoLabels() {
      return labelsOf(undo.undoStack);
    },
    get redoLabels() {
      return labelsOf(undo.redoStack);
    },
    commit(says, after, gesture) {
      const before = read();
      if (after === before) return;
      if (gesture === undefined || gesture !== gestureNow) undo.stopCapturing();
      gestureNow = gesture;
      label = says;
      // The selected program is this editor's own: it is not written.
      doc.transact(() => {
        writeChanges(root, CELL_LAYOUT, { ...before, program: "" }, { ...after, program: "" }, namer);
      }, OWN);
      if (undo.undoStack.length > DEPTH) undo.undoStack.splice(0, undo.undoStack.length - DEPTH);
      if (after.program !== before.program) {
        const at = read().programs.findIndex(({ name }) => name === after.program);
        program = programKeys()[at] ?? null;
      }
    },
    undo() {
      gestureNow = undefined;
      label = labelsOf(undo.undoStack)[0] ?? "";
      undo.undo();
    },
    redo() {
      gestureNow = undefined;
      label = labelsOf(undo.redoStack)[0] ?? "";
      undo.redo();
    },
    state: () => Y.encodeStateAsUpdate(doc),
    vector: () => Y.encodeStateVector(doc),
    missing: vector => Y.encodeStateAsUpdate(doc, vector),
    apply(update) {
      Y.applyUpdate(doc, update, OTHERS);
    },
    get incomplete() {
      return doc.store.pendingStructs !== null || doc.store.pendingDs !== null;
    },
    onChange(listener) {
      const heard = (update: Uint8Array, origin: unknown): void => {
        listener(update, origin !== OTHERS);
      };
      doc.on("update", heard);
      return () => {
        doc.off("update", heard);
      };
    },
    close() {
      undo.destroy();
      doc.destroy();
    },
  };
}

/** A shared cell as the history of its editor: a commit goes to everybody, undo takes back the editor's own. */
export function sharedHistory(cell: SharedCell): History {
  return {
    document: cell.document,
    undoLabels: cell.undoLabels,
    redoLabels: cell.redoLabels,
    commit(label, next, gesture) {
      cell.commit(label, next, gesture);
      return sharedHistory(cell);
    },
    undo() {
      cell.undo();
      return sharedHistory(cell);
    },
    redo() {
      cell.redo();
      return sharedHistory(cell);
    },
  };
}
