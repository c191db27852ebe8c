import type { CellDocument } from "../document.ts";
import { readDocument } from "../open.ts";
import type { Editor, EditingRefusal, EditingRight, EditorMessage, RoomMessage } from "./messages.ts";
import { changesSomething, createSharedCell, type SharedCell } from "./shared-cell.ts";

/** One who is in a room. */
export interface RoomEditor {
  receive(message: EditorMessage): void;
  leave(): void;
}
export interface RoomOptions {
  /** A cell, or a state that was kept with the epoch it belongs to. */
  readonly from:
    | { readonly document: CellDocument; readonly epoch: string }
    | { readonly state: Uint8Array; readonly epoch: string };
  /** Told after each change, to keep the cell. */
  readonly onChange?: () => void;
}

/**
 * The one place where the editors of a cell meet. Every update is looked at before anybody else has it: whether its
 * sender may do that, now, and whether the cell is still one that can be opened. What is refused changes nothing.
 */
export interface EditingRoom {
  readonly epoch: string;
  readonly document: CellDocument;
  readonly editors: readonly Editor[];
  state(): Uint8Array;
  /** @param right  asked at every message. */
  join(who: string, right: () => EditingRight, send: (message: RoomMessage) => void): RoomEditor;
  /** The cell was written by somebody who is in no room: a file, the API. Goes to everybody as one change. */
  replace(document: CellDocument): void;
  close(): void;
}

interface Place {
  editor: Editor;
  joined: boolean;
  readonly send: (message: RoomMessage) => void;
}

/** @throws Error when the state is none of a cell. */
export function createEditingRoom({ from, onChange = () => undefined }: RoomOptions): EditingRoom {
  const { epoch } = from;
  const cell = createSharedCell({ from });
  /** Updates are tried on this one first. */
  let trial = createSharedCell({ from: { state: cell.state() } });
  const places = new Set<Place>();
  let connections = 0;

  function offer(update: Uint8Array, right: EditingRight, who: string): EditingRefusal | null {
    if (right === "look" && changesSomething(update)) return LOOKS;
    const before = trial.document;
    trial.apply(update);
    if (trial.incomplete)
      return {
        code: "editing.incomplete",
        sentence: "This change builds on one that never came here.",
        hint: "Your changes are put on the present state of the cell.",
      };
    const after = trial.document;
    if (right !== "write" && !isOwnComments(before, after, who)) return COMMENTS;
    const opened = after === before ? null : readDocument(after);
    if (opened?.kind === "not-a-cell")
      return {
        code: "editing.unreadable",
        sentence: `With what others did the cell would be wrong: ${opened.why[0] ?? "it cannot be read."}`,
        hint: "This change is left out; your cell as it was is kept.",
      };
    cell.apply(update);
    return null;
  }
  /** Null when it was taken. What is no update at all is refused like everything that cannot be taken. */
  function offered(update: Uint8Array, right: EditingRight, who: string): EditingRefusal | null {
    let why: EditingRefusal | null;
    try {
      why = offer(update, right, who);
    } catch (problem) {
      why = {
        code: "editing.unreadable",
        sentence: `This is no change of a cell: ${problem instanceof Error ? problem.message : "it cannot be read"}.`,
        hint: "Open the cell again.",
      };
    }
    if (why !== null) {
      trial.close();
      trial = createSharedCell({ from: { state: cell.state() } });
    }
    return why;
  }
  const tell = (message: RoomMessage, but?: Place): void => {
    for (const place of places) if (place !== but && place.joined) place.send(message);
  };

  return {
    epoch,
    get document() {
      return cell.document;
    },
    get editors() {
      return [...places].filter(({ joined }) => joined).map(({ editor }) => editor);
    },
    state: () => cell.state(),
    join(who, right, send) {
      const place: Place = { editor: { connection: ++connections, who, presence: null }, joined: false, send };
      places.add(place);
      return {
        receive(message) {
          switch (message.type) {
            case "join": {
              const known = message.epoch === epoch && message.vector.length > 0;
              const others = [...places].filter(each => each !== place && each.joined).map(({ editor }) => editor);
              place.joined = true;
              send({
                type: "joined",
                epoch,
                connection: place.editor.connection,
                who,
                right: right(),
                update: known ? missing(cell, message.vector) : cell.state(),
                vector: cell.vector(),
                editors: others,
              });
              tell({ type: "editor", editor: place.editor }, place);
              return;
            }
            case "update": {
              if (!place.joined) return;
              const why = offered(message.update, right(), who);
              if (why === null) {
                send({ type: "accepted", number: message.number });
                tell({ type: "update", update: message.update }, place);
                onChange();
              } else {
                // What follows builds on it: until they begin anew nothing of theirs is looked at.
                place.joined = false;
                send({ type: "refused", number: message.number, why });
              }
              return;
            }
            case "presence":
              place.editor = { ...place.editor, presence: message.presence };
              if (place.joined) tell({ type: "editor", editor: place.editor }, place);
              return;
          }
        },
        leave() {
          if (places.delete(place)) tell({ type: "left", connection: place.editor.connection });
        },
      };
    },
    replace(document) {
      const stop = cell.onChange(update => {
        trial.apply(update);
        tell({ type: "update", update });
      });
      cell.commit("", { ...document, program: cell.document.program });
      stop();
      onChange();
    },
    close() {
      cell.close();
      trial.close();
      places.clear();
    },
  };
}

const LOOKS: EditingRefusal = {
  code: "editing.role",
  sentence: "You may look at this cell, and not change it.",
  hint: "It needs the role programmer or admin; your cell as it was is kept.",
};
const COMMENTS: EditingRefusal = {
  code: "editing.role",
  sentence: "You may write comments on steps of this cell, and not change it.",
  hint: "It needs the role programmer or admin; your cell as it was is kept.",
};

/** A vector that cannot be read asks for everything. */
function missing(cell: SharedCell, vector: Uint8Array): Uint8Array {
  try {
    return cell.missing(vector);
  } catch {
    return cell.state();
  }
}

/** Whether two states differ in nothing but comments of that person. */
function isOwnComments(before: CellDocument, after: CellDocument, who: string): boolean {
  const keys = new Set([...Object.keys(before), ...Object.keys(after)]) as Set<keyof CellDocument>;
  for (const key of keys) if (key !== "comments" && before[key] !== after[key]) return false;
  const was = before.comments ?? [];
  const is = after.comments ?? [];
  const kept = new Set(is);
  return (
    is.every(each => was.includes(each) || each.who === who) && was.every(each => kept.has(each) || each.who === who)
  );
}
