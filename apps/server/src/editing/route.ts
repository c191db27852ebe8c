import type { IncomingMessage } from "node:http";
import type { Scheduler } from "@twincell/core";
import type { EditingRight, RoomEditor } from "@twincell/project/sharing";
import { LONGEST_MESSAGE, nameSchema, readEditorMessage, SOCKETS, writeEditing } from "@twincell/protocol";
import type { WebSocket } from "ws";
import type { Gate } from "../people/gate.ts";
import { mayUse } from "../people/tokens.ts";
import type { Route } from "../sockets/doors.ts";
import type { OpenRoom, SharedCells } from "./shared-cells.ts";

/** A reader so far behind is let go [bytes]. */
const MOST_WAITING = 64 << 20;
const MOST_EDITORS = 256;
/** Messages of one editor in a second; a person dragging sends 30. */
const MOST_PER_S = 120;
/** What waits for the cell to be read from the disk. */
const MOST_EARLY = 64;

/** Lets pages of this server in to edit a cell together: `?cell=NAME`, and `&look=1` for somebody who only looks. */
export function editingRoute(
  shared: SharedCells,
  gate: Pick<Gate, "nameOf" | "roleOf" | "byLink">,
  scheduler: Pick<Scheduler, "now_s">,
  audit: (who: string, action: string, detail: string, done: boolean) => void = () => undefined,
): Route {
  let count = 0;
  let inside = 0;
  return {
    path: SOCKETS.editing,
    longest: LONGEST_MESSAGE,
    welcome(socket, request) {
      const { searchParams } = new URL(request.url ?? "/", "http://here");
      const cell = searchParams.get("cell") ?? "";
      if (!nameSchema.safeParse(cell).success || inside >= MOST_EDITORS) {
        socket.close(1008, inside >= MOST_EDITORS ? "Very many people edit here." : "?cell= wants the name of a cell.");
        return;
      }
      inside++;
      const who = gate.byLink(request) ? `guest ${++count}` : (gate.nameOf(request) ?? `studio ${++count}`);
      const right = rightOf(gate, request, cell, searchParams.get("look") !== null);
      const editor = inRoom(shared, socket, { cell, who, right, audit });
      const rate = allowance(scheduler);
      socket.on("message", (data, binary) => {
        if (binary || !rate()) socket.close(1008, binary ? "Messages are texts." : "Too many messages.");
        else editor.hear(String(data as Buffer));
      });
      let gone = false;
      const leave = (): void => {
        if (gone) return;
        gone = true;
        inside--;
        editor.leave();
      };
      socket.on("close", leave);
      socket.on("error", leave);
    },
  };
}

/** Asked at each message: roles change while people edit. */
function rightOf(
  gate: Pick<Gate, "roleOf" | "byLink">,
  request: IncomingMessage,
  cell: string,
  looks: boolean,
): () => EditingRight {
  const role = gate.roleOf(request);
  return () => {
    if (looks || gate.byLink(request)) return "look";
    return role === null || mayUse(role(cell), "write") ? "write" : "comment";
  };
}

interface Entering {
  readonly cell: string;
  readonly who: string;
  readonly right: () => EditingRight;
  readonly audit: (who: string, action: string, detail: string, done: boolean) => void;
}
function inRoom(shared: SharedCells, socket: WebSocket, { cell, who, right, audit }: Entering) {
  let open: OpenRoom | null = null;
  let editor: RoomEditor | null = null;
  let left = false;
  const early: string[] = [];
  const send = (text: string): void => {
    if (socket.bufferedAmount > MOST_WAITING) socket.terminate();
    else socket.send(text);
  };
  function hear(text: string): void {
    if (editor === null) {
      if (early.length < MOST_EARLY) early.push(text);
      else socket.close(1008, "Too many messages.");
      return;
    }
    const read = readEditorMessage(text);
    if (read.kind === "read") editor.receive(read.message);
    else socket.close(1008, read.sentence.slice(0, 120));
  }
  shared
    .open(cell, (why, code) => {
      socket.close(code, why);
    })
    .then(
      found => {
        if (!("room" in found)) {
          socket.close(1008, found.kind === "refused" ? found.why.sentence.slice(0, 120) : "");
          return;
        }
        open = found;
        if (left) {
          open.leave();
          return;
        }
        if (right() !== "look") audit(who, "edits the cell", cell, true);
        // One line of a connection: the log is not filled by whoever tries again and again.
        let told = false;
        editor = open.room.join(who, right, message => {
          if (message.type === "refused" && !told) {
            told = true;
            audit(who, "edits the cell", `${cell}: ${message.why.sentence}`, false);
          }
          send(writeEditing(message));
        });
        for (const text of early.splice(0)) hear(text);
      },
      (problem: unknown) => {
        socket.close(1011, problem instanceof Error ? problem.message.slice(0, 120) : "The cell cannot be read.");
      },
    );
  return {
    hear,
    leave(): void {
      left = true;
      editor?.leave();
      open?.leave();
    },
  };
}

/** Whether one more message comes within what one editor may send. */
function allowance({ now_s }: Pick<Scheduler, "now_s">): () => boolean {
  let left = MOST_PER_S;
  let at_s = now_s();
  return () => {
    const now = now_s();
    left = Math.min(MOST_PER_S, left + (now - at_s) * MOST_PER_S);
    at_s = now;
    left -= 1;
    return left >= 0;
  };
}
