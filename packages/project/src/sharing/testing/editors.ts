import { seededRandom } from "@twincell/core";
import { readDocument } from "../../open.ts";
import { saveDocument } from "../../save.ts";
import { createEditingRoom, type EditingRoom, type RoomEditor } from "../room.ts";
import { createEditingSession, type EditingSession } from "../session.ts";
import { cellForEditors, lostIntents, noIntents, randomEdit } from "./random-edit.ts";

export interface EditingRun {
  readonly editors: number;
  readonly seed: number;
  /** Virtual time in which edits are made [s]. */
  readonly seconds: number;
  readonly edits_per_s: number;
  /** An editor is out of reach for this share of the time. */
  readonly offline: number;
}
export interface EditingOutcome {
  readonly edits: number;
  readonly disconnections: number;
  readonly refused: readonly string[];
  readonly lost: readonly string[];
  /** How many different cells the editors and the server have at the end. */
  readonly different: number;
  readonly opens: boolean;
  readonly bytes: number;
}

/** Events in virtual time. */
function timeline() {
  const events: { at_s: number; run: () => void }[] = [];
  let now_s = 0;
  return {
    now: () => now_s,
    after(delay_s: number, run: () => void): void {
      const event = { at_s: now_s + delay_s, run };
      let at = events.length;
      // The next is at the end; of those at the same time the first that was asked for.
      while (at > 0 && events[at - 1]!.at_s <= event.at_s) at--;
      events.splice(at, 0, event);
    },
    runAll(): void {
      for (let next = events.pop(); next; next = events.pop()) {
        now_s = next.at_s;
        next.run();
      }
    },
  };
}

/**
 * Editors of one cell with random edits, random delays and random times without a connection, in virtual time. What was
 * on its way when a connection ended is lost, as on a network. At the end everybody has a connection and everything has
 * arrived.
 */
export function runEditors({ editors, seed, seconds, edits_per_s, offline }: EditingRun): EditingOutcome {
  const random = seededRandom(seed);
  const time = timeline();
  const room: EditingRoom = createEditingRoom({ from: { document: cellForEditors(editors), epoch: "one" } });
  const intents = noIntents();
  const refused: string[] = [];
  let edits = 0;
  let disconnections = 0;
  let numbers = 1;
  const delay_s = (): number => 0.005 + 0.3 * random() ** 4;

  const clients = Array.from({ length: editors }, (_, who) => {
    const session: EditingSession = createEditingSession({
      onEvent(event) {
        if (event.type === "refused") refused.push(...event.labels.map(label => `${label}: ${event.why.sentence}`));
      },
      newEditor: () => ++numbers,
    });
    let line = 0;
    let count = 0;
    function connect(): void {
      const mine = ++line;
      // Messages of one connection come in the order in which they were sent.
      let up_s = 0;
      let down_s = 0;
      const later = (from_s: number, run: () => void): number => {
        const at_s = Math.max(from_s, time.now() + delay_s());
        time.after(at_s - time.now(), () => {
          if (line === mine) run();
        });
        return at_s;
      };
      const place: RoomEditor = room.join(
        `editor ${who}`,
        () => "write",
        message => {
          down_s = later(down_s, () => {
            session.receive(message);
          });
        },
      );
      leave = place.leave;
      session.connected(message => {
        up_s = later(up_s, () => {
          place.receive(message);
        });
      });
    }
    let leave = (): void => undefined;
    function disconnect(): void {
      disconnections++;
      line++;
      leave();
      session.disconnected();
    }
    function edit(): void {
      const history = session.history();
      if (history === null) return;
      const after = randomEdit(history.document, who, ++count, random, intents);
      if (after === history.document) return;
      edits++;
      history.commit(`edit ${count}`, after);
    }
    function goOn(): void {
      if (time.now() > seconds) return;
      edit();
      time.after((2 * random()) / edits_per_s, goOn);
    }
    function comeAndGo(): void {
      if (time.now() > seconds) return;
      disconnect();
      time.after(20 * offline * random(), () => {
        connect();
        time.after(20 * (1 - offline) * random() + 1, comeAndGo);
      });
    }
    connect();
    time.after(1 + random(), goOn);
    time.after(3 + 10 * random(), comeAndGo);
    return { session };
  });
  time.runAll();

  const cells = new Set([
    saveDocument({ ...room.document, program: "" }),
    ...clients.map(({ session }) => saveDocument({ ...session.document!, program: "" })),
  ]);
  const outcome: EditingOutcome = {
    edits,
    disconnections,
    refused,
    lost: lostIntents(room.document, intents),
    different: cells.size,
    opens: readDocument(JSON.parse(saveDocument(room.document))).kind === "opened",
    bytes: room.state().length,
  };
  for (const { session } of clients) session.close();
  room.close();
  return outcome;
}
