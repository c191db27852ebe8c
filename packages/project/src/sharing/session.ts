import type { CellDocument } from "../document.ts";
import type { History } from "../history.ts";
import { readDocument } from "../open.ts";
import { graftChanges } from "./graft.ts";
import type { Editor, EditingRefusal, EditingRight, EditorMessage, Presence, RoomMessage } from "./messages.ts";
import { changesSomething, createSharedCell, type SharedCell } from "./shared-cell.ts";

/** What happened in a session, for whoever shows it. */
export type EditingEvent =
  /** The cell is another one than a moment ago: others changed it, or it was opened. */
  | { readonly type: "document" }
  /** Who is in, where they are, whether the server is reached, what one may do. */
  | { readonly type: "editors" }
  /**
   * Changes of this editor that could not be put into the cell. `kept` is the cell as this editor had it: nothing in it
   * is lost.
   */
  | {
      readonly type: "refused";
      readonly why: EditingRefusal;
      readonly labels: readonly string[];
      readonly kept: CellDocument;
    };

/** What is kept of a session over a reload of its page. */
export interface KeptSession {
  readonly epoch: string;
  readonly state: Uint8Array;
  /** It holds changes that the server has not confirmed. */
  readonly unsent: boolean;
}
export interface EditingSessionOptions {
  readonly onEvent: (event: EditingEvent) => void;
  /** What is made of every merged state before it is shown. */
  readonly normalise?: (document: CellDocument) => CellDocument;
  readonly kept?: KeptSession | null;
  /** The number of an editor of shared documents, for tests that have to come out the same. */
  readonly newEditor?: () => number;
}

/**
 * One editor of a shared cell. Edits are taken at once, with or without a connection; what was done meanwhile is merged
 * when there is one again.
 */
export interface EditingSession {
  /** Null until the cell was heard for the first time. */
  readonly document: CellDocument | null;
  readonly right: EditingRight;
  readonly online: boolean;
  /** Changes that the server has not confirmed. */
  readonly waiting: number;
  /** The others who are in. */
  readonly editors: readonly Editor[];
  readonly connection: number;
  readonly who: string;
  /** Undo, redo and commits of this editor. Null until there is a cell. */
  history(): History | null;
  /** There is a connection: begins with a message to it. */
  connected(send: (message: EditorMessage) => void): void;
  disconnected(): void;
  receive(message: RoomMessage): void;
  point(presence: Presence): void;
  keep(): KeptSession | null;
  close(): void;
}

interface Waiting {
  readonly number: number;
  readonly label: string;
  readonly before: CellDocument;
  readonly after: CellDocument;
}
const NOTHING = new Uint8Array();

export function createEditingSession({ onEvent, normalise, kept, newEditor }: EditingSessionOptions): EditingSession {
  let cell: SharedCell | null = null;
  let stopHearing: () => void = () => undefined;
  let epoch: string | null = null;
  let send: ((message: EditorMessage) => void) | null = null;
  let joined = false;
  let right: EditingRight = "write";
  let number = 0;
  let waiting: Waiting[] = [];
  let refusedFor: EditingRefusal | null = null;
  let connection = 0;
  let who = "";
  let presence: Presence | null = null;
  const editors = new Map<number, Editor>();
  /** The cell as it was last fit to be shown: between a merge and the answer of the server it may be none. */
  let shown: CellDocument | null = null;

  function take(state: Uint8Array): SharedCell {
    stopHearing();
    cell?.close();
    cell = createSharedCell({
      from: { state },
      normalise,
      editor: newEditor?.(),
    });
    const own = cell;
    let before = own.document;
    shown = before;
    stopHearing = own.onChange((update, mine) => {
      const after = own.document;
      if (mine) {
        waiting.push({ number: ++number, label: own.undoLabels[0] ?? "", before, after });
        if (joined) send?.({ type: "update", number, update });
      }
      before = after;
    });
    return own;
  }
  let unsent = kept?.unsent === true;
  if (kept) {
    take(kept.state);
    ({ epoch } = kept);
  }

  /** What is not confirmed is done again on the present state of the cell, each change by itself. */
  function putOn(state: Uint8Array): void {
    const again = waiting;
    const had = cell?.document ?? null;
    const why = refusedFor;
    waiting = [];
    refusedFor = null;
    const fresh = take(state);
    const left: string[] = [];
    const mayWrite = right === "write";
    for (const { label, before, after } of again) {
      const now = fresh.document;
      const next = mayWrite ? graftChanges(before, after, now) : now;
      if (next !== now && readDocument(next).kind === "opened") fresh.commit(label, next);
      else left.push(label);
    }
    // Of what an earlier page did only its outcome is known.
    const unknown = unsent && again.length === 0;
    unsent = false;
    if ((left.length > 0 || unknown) && had !== null)
      onEvent({
        type: "refused",
        labels: left,
        kept: had,
        why: why ?? {
          code: "editing.unreadable",
          sentence: "What you changed does not fit with what others did.",
          hint: "Your cell as it was is kept.",
        },
      });
  }

  function onJoined(message: Extract<RoomMessage, { readonly type: "joined" }>): void {
    ({ connection, who, right } = message);
    editors.clear();
    for (const editor of message.editors) editors.set(editor.connection, editor);
    const isAnother = epoch !== message.epoch || cell === null || refusedFor !== null;
    epoch = message.epoch;
    if (isAnother) {
      joined = true;
      putOn(message.update);
    } else {
      cell!.apply(message.update);
      const update = cell!.missing(message.vector);
      joined = true;
      // Everything that was done meanwhile goes as one.
      if (changesSomething(update)) send?.({ type: "update", number, update });
      else {
        waiting = [];
        unsent = false;
      }
    }
    if (presence) send?.({ type: "presence", presence });
  }
  /** What the server has can be opened; with what this editor did meanwhile it may be that it cannot. */
  function show(): void {
    const now = cell!.document;
    if (waiting.length === 0 || readDocument(now).kind === "opened") shown = now;
  }
  /** After an own change of what is shown, that is shown; of anything else it is looked at first. */
  function showOwn(was: CellDocument): void {
    if (shown === was) shown = cell!.document;
    else show();
  }

  const join = (fresh: boolean): void => {
    joined = false;
    send?.({
      type: "join",
      epoch: fresh ? null : epoch,
      vector: fresh || cell === null ? NOTHING : cell.vector(),
    });
  };
  return {
    get document() {
      return cell === null ? null : shown;
    },
    get right() {
      return right;
    },
    get online() {
      return joined;
    },
    get waiting() {
      return waiting.length;
    },
    get editors() {
      return [...editors.values()];
    },
    get connection() {
      return connection;
    },
    get who() {
      return who;
    },
    history() {
      return cell === null ? null : historyOf(cell);
    },
    connected(to) {
      send = to;
      join(false);
    },
    disconnected() {
      send = null;
      joined = false;
      editors.clear();
      onEvent({ type: "editors" });
    },
    receive(message) {
      switch (message.type) {
        case "joined":
          onJoined(message);
          show();
          onEvent({ type: "document" });
          onEvent({ type: "editors" });
          return;
        case "update":
          cell?.apply(message.update);
          show();
          onEvent({ type: "document" });
          return;
        case "accepted":
          waiting = waiting.filter(each => each.number > message.number);
          unsent = false;
          if (waiting.length === 0) onEvent({ type: "editors" });
          return;
        case "refused":
          refusedFor = message.why;
          join(true);
          return;
        case "editor":
          editors.set(message.editor.connection, message.editor);
          onEvent({ type: "editors" });
          return;
        case "left":
          editors.delete(message.connection);
          onEvent({ type: "editors" });
          return;
      }
    },
    point(next) {
      presence = next;
      if (joined) send?.({ type: "presence", presence });
    },
    keep: () =>
      cell === null || epoch === null ? null : { epoch, state: cell.state(), unsent: unsent || waiting.length > 0 },
    close() {
      stopHearing();
      cell?.close();
      cell = null;
      send = null;
    },
  };

  function historyOf(now: SharedCell): History {
    return {
      document: shown ?? now.document,
      undoLabels: now.undoLabels,
      redoLabels: now.redoLabels,
      commit(label, next, gesture) {
        // What is changed is what is shown; where that is not the merged state, its changes are put on it.
        const merged = now.document;
        now.commit(label, shown === null || shown === merged ? next : graftChanges(shown, next, merged), gesture);
        showOwn(merged);
        return historyOf(cell ?? now);
      },
      undo() {
        const was = now.document;
        now.undo();
        showOwn(was);
        return historyOf(cell ?? now);
      },
      redo() {
        const was = now.document;
        now.redo();
        showOwn(was);
        return historyOf(cell ?? now);
      },
    };
  }
}
