import { insertSteps, seededRandom, type Program, type Step } from "@twincell/core";
import * as fc from "fast-check";
import { expect, test } from "vitest";
import { isTextProgram, type CellDocument, type ToolRecord } from "../document.ts";
import { edgeTraceCell, emptyCell, EXAMPLES } from "../example/index.ts";
import { readDocument } from "../open.ts";
import { saveDocument } from "../save.ts";
import { importedText, textCell } from "./testing/text-cell.ts";
import { cellForEditors, noIntents, randomEdit } from "./testing/random-edit.ts";
import { runEditors } from "./testing/editors.ts";
import { graftChanges } from "./graft.ts";
import type { EditingRight, RoomMessage } from "./messages.ts";
import { orderBetween, ordersFor } from "./order.ts";
import { createEditingRoom } from "./room.ts";
import { createEditingSession, type EditingEvent, type EditingSession } from "./session.ts";
import { createSharedCell, type SharedCell } from "./shared-cell.ts";

const text = (cell: CellDocument): string => saveDocument({ ...cell, program: "" });
const steps = (cell: CellDocument): readonly Step[] => {
  const [program] = cell.programs;
  return program && !isTextProgram(program) ? program.steps : [];
};
function withSteps(cell: CellDocument, change: (steps: readonly Step[]) => readonly Step[]): CellDocument {
  return {
    ...cell,
    programs: cell.programs.map((each, i) =>
      i > 0 || isTextProgram(each) ? each : { ...each, steps: change(each.steps) },
    ),
  };
}
const wait = (id: string, s = 1): Step => ({ type: "wait", id, s });
/** Two editors of one cell who have not heard from each other since it was shared. */
function two(cell: CellDocument): readonly [SharedCell, SharedCell, () => void] {
  const a = createSharedCell({ from: { document: cell }, editor: 1 });
  const b = createSharedCell({ from: { state: a.state() }, editor: 2 });
  return [
    a,
    b,
    () => {
      const [toA, toB] = [b.missing(a.vector()), a.missing(b.vector())];
      a.apply(toA);
      b.apply(toB);
    },
  ];
}

test("a cell that is shared is the same cell, with every example and a vendor's text", () => {
  for (const cell of [...EXAMPLES.map(({ make }) => make()), textCell("a\nb\n")]) {
    const shared = createSharedCell({ from: { document: cell } });
    expect(text(createSharedCell({ from: { state: shared.state() } }).document)).toBe(text(cell));
  }
});

test("two editors who change different fields of one step, one object and one cell both find their change", () => {
  const [a, b, meet] = two(withSteps(edgeTraceCell(), list => [...list, wait("w")]));
  a.commit(
    "time",
    withSteps(a.document, list =>
      list.map(each => (each.id === "w" && each.type === "wait" ? { ...each, s: 7 } : each)),
    ),
  );
  b.commit(
    "name",
    withSteps(b.document, list => list.map(each => (each.id === "w" ? { ...each, name: "rest" } : each))),
  );
  const [object] = a.document.objects;
  a.commit("colour", { ...a.document, objects: a.document.objects.with(0, { ...object!, color: "#123456" }) });
  b.commit("move", {
    ...b.document,
    name: "Ours",
    objects: b.document.objects.with(0, {
      ...object!,
      worldFromObject: { position: [9, 0, 0], quaternion: [0, 0, 0, 1] },
    }),
  });
  meet();
  expect(text(a.document)).toBe(text(b.document));
  expect(steps(a.document).at(-1)).toEqual({ type: "wait", id: "w", s: 7, name: "rest" });
  expect(a.document.objects[0]).toMatchObject({ color: "#123456", worldFromObject: { position: [9, 0, 0] } });
  expect(a.document.name).toBe("Ours");
});

test("a step that one moves and another changes is there once, at the new place with the new value", () => {
  const [a, b, meet] = two(withSteps(emptyCell(), () => [wait("x"), wait("y"), wait("z")]));
  a.commit(
    "order",
    withSteps(a.document, ([x, y, z]) => [z!, x!, y!]),
  );
  b.commit(
    "time",
    withSteps(b.document, list =>
      list.map(each => (each.id === "z" && each.type === "wait" ? { ...each, s: 5 } : each)),
    ),
  );
  meet();
  expect(steps(a.document).map(({ id }) => id)).toEqual(["z", "x", "y"]);
  expect(steps(b.document)[0]).toMatchObject({ id: "z", s: 5 });
});

test("things that two add under one id or name are both there, one with a number, and the cell opens", () => {
  const [a, b, meet] = two(emptyCell());
  const tool: ToolRecord = { name: "Gun", flangeFromTcp: { position: [0, 0, 0.1], quaternion: [0, 0, 0, 1] } };
  for (const [each, s] of [
    [a, 1],
    [b, 2],
  ] as const) {
    each.commit(
      "step",
      withSteps(each.document, list => [...list, wait("s1", s)]),
    );
    each.commit("tool", { ...each.document, tools: [...each.document.tools, tool] });
  }
  meet();
  expect(text(a.document)).toBe(text(b.document));
  expect(new Set(steps(a.document).map(({ id }) => id))).toEqual(new Set(["s1", "s1-2"]));
  expect(a.document.tools.map(({ name }) => name)).toEqual(["Gun", "Gun 2"]);
  expect(readDocument(a.document).kind).toBe("opened");
});

test("a program that one renames keeps what another does in it", () => {
  const [a, b, meet] = two(withSteps(emptyCell(), () => [wait("x")]));
  const [program] = a.document.programs;
  a.commit("name", { ...a.document, programs: [{ ...program!, name: "Weld" }], program: "Weld" });
  b.commit(
    "step",
    withSteps(b.document, list => [...list, wait("y")]),
  );
  meet();
  expect(b.document.programs.map(({ name }) => name)).toEqual(["Weld"]);
  expect(steps(b.document).map(({ id }) => id)).toEqual(["x", "y"]);
  expect(b.document.program).toBe("Weld");
});

test("two who type in one text keep both lines, and a changed line changes only there", () => {
  const [a, b, meet] = two(textCell("one\ntwo\nthree\nfour\n"));
  a.commit("text", importedText(a.document, "zero\none\ntwo\nthree\nfour\n"));
  b.commit("text", importedText(b.document, "one\ntwo\n3\nfour\nfive\n"));
  meet();
  expect(text(a.document)).toBe(text(b.document));
  const [program] = a.document.programs;
  expect(program && isTextProgram(program) ? program.files[0]!.text : "").toBe("zero\none\ntwo\n3\nfour\nfive\n");
});

test("undo takes back what one did oneself, in its own order, and leaves what others did", () => {
  const [a, b, meet] = two(emptyCell());
  a.commit(
    "mine",
    withSteps(a.document, list => [...list, wait("a1")]),
  );
  b.commit(
    "theirs",
    withSteps(b.document, list => [...list, wait("b1")]),
  );
  a.commit("drag", { ...a.document, name: "1" }, "drag");
  a.commit("drag", { ...a.document, name: "2" }, "drag");
  meet();
  expect(a.undoLabels).toEqual(["drag", "mine"]);
  a.undo();
  expect(a.document.name).toBe(emptyCell().name);
  a.undo();
  meet();
  expect(steps(b.document).map(({ id }) => id)).toEqual(["b1"]);
  expect(a.redoLabels).toEqual(["mine", "drag"]);
  a.redo();
  meet();
  expect(
    steps(b.document)
      .map(({ id }) => id)
      .toSorted(),
  ).toEqual(["a1", "b1"]);
  expect(b.undoLabels).toEqual(["theirs"]);
});

test("parts that did not change are the very same objects, and a change that is none writes nothing", () => {
  const [a, b, meet] = two(edgeTraceCell());
  const before = a.document;
  b.commit("name", { ...b.document, name: "Other" });
  meet();
  expect(a.document).not.toBe(before);
  expect(a.document.objects).toBe(before.objects);
  expect(a.document.programs).toBe(before.programs);
  const vector = a.vector();
  a.commit("nothing", { ...a.document, name: "Other" });
  expect(a.vector()).toEqual(vector);
});

test("places in an order: between any two there is room, for any number of editors", () => {
  fc.assert(
    fc.property(fc.array(fc.tuple(fc.nat(), fc.constantFrom("a1", "b2", "zz")), { maxLength: 200 }), inserts => {
      const list = [...ordersFor(3)];
      for (const [place, mark] of inserts) {
        const at = place % (list.length + 1);
        const made = orderBetween(list[at - 1] ?? "", list[at], mark);
        expect(made > (list[at - 1] ?? "")).toBe(true);
        if (list[at] !== undefined) expect(made < list[at]).toBe(true);
        list.splice(at, 0, made);
      }
    }),
    { seed: 7 },
  );
});

test("what is written of a random edit gives the cell after it; put on another state, it leaves that state's own changes", () => {
  const random = seededRandom(5);
  const shared = createSharedCell({ from: { document: cellForEditors(3) }, editor: 1 });
  const intents = noIntents();
  for (let i = 0; i < 200; i++) {
    const before = shared.document;
    const after = randomEdit(before, i % 3, i, random, intents);
    const onto: CellDocument = { ...before, name: `name ${i}`, objects: [...before.objects].reverse() };
    const grafted = graftChanges(before, after, onto);
    expect(grafted.name).toBe(`name ${i}`);
    if (after.objects === before.objects) expect(grafted.objects).toEqual(onto.objects);
    expect(text(graftChanges(before, after, before))).toBe(text(after));
    shared.commit("edit", after);
    expect(text(shared.document)).toBe(text(after));
  }
});

test("8 editors with random edits, delays and times without a connection: identical documents, 0 lost intents, 3 seeds", () => {
  for (const seed of [1, 2, 3]) {
    const { edits, disconnections, lost, different, refused, opens } = runEditors({
      editors: 8,
      seed,
      seconds: 60,
      edits_per_s: 1,
      offline: 0.5,
    });
    expect(edits).toBeGreaterThan(300);
    expect(disconnections).toBeGreaterThan(20);
    expect({ seed, lost, different, refused, opens }).toEqual({
      seed,
      lost: [],
      different: 1,
      refused: [],
      opens: true,
    });
  }
});

/** A room with people of these rights, connected without any delay. */
function roomOf(cell: CellDocument, ...people: readonly { right: EditingRight }[]) {
  const room = createEditingRoom({ from: { document: cell, epoch: "one" } });
  const sessions = people.map((person, i) => {
    const events: EditingEvent[] = [];
    const session: EditingSession = createEditingSession({ onEvent: event => events.push(event) });
    const connect = (): void => {
      const place = room.join(
        `p${i}`,
        () => person.right,
        message => session.receive(message),
      );
      session.connected(message => place.receive(message));
    };
    connect();
    return { session, events, connect };
  });
  return { room, sessions };
}
const commit = (session: EditingSession, after: (cell: CellDocument) => CellDocument): void => {
  const history = session.history()!;
  history.commit("change", after(history.document));
};
const comment = (who: string) => ({
  id: `c-${who}`,
  program: "Program",
  step: "x",
  who,
  at: "2026-11-27T10:00:00Z",
  text: "Why?",
});

test("who may look changes nothing, who may comment writes comments in their own name: each message is looked at, with the role of that moment", () => {
  const viewer: { right: EditingRight } = { right: "look" };
  const operator: { right: EditingRight } = { right: "comment" };
  const { room, sessions } = roomOf(
    withSteps(emptyCell(), () => [wait("x")]),
    { right: "write" },
    viewer,
    operator,
  );
  const [, looks, comments] = sessions;
  commit(looks!.session, cell => ({ ...cell, name: "Mine" }));
  expect(room.document.name).toBe(emptyCell().name);
  expect(looks!.session.document!.name).toBe(emptyCell().name);
  expect(looks!.events.find(event => event.type === "refused")).toMatchObject({
    why: { code: "editing.role", sentence: "You may look at this cell, and not change it." },
    labels: ["change"],
    kept: { name: "Mine" },
  });
  commit(comments!.session, cell => ({ ...cell, comments: [comment("p2")] }));
  expect(sessions[0]!.session.document!.comments).toEqual([comment("p2")]);
  commit(comments!.session, cell => ({ ...cell, comments: [...cell.comments!, comment("p0")] }));
  commit(comments!.session, cell => ({ ...cell, name: "Theirs" }));
  expect(room.document.comments).toEqual([comment("p2")]);
  expect(room.document.name).toBe(emptyCell().name);
  viewer.right = "write";
  looks!.connect();
  commit(looks!.session, cell => ({ ...cell, name: "Now" }));
  viewer.right = "look";
  commit(looks!.session, cell => ({ ...cell, name: "Too late" }));
  expect(room.document.name).toBe("Now");
});

test("a change that with what others did would make a cell that cannot be opened is refused with the place, the others go on, the own cell is kept", () => {
  const { room, sessions } = roomOf(emptyCell(), { right: "write" }, { right: "write" });
  const [a, b] = sessions;
  const routine = (program: Program): Program => ({ ...program, routines: { weld: [wait("w")] } });
  const inProgram = (cell: CellDocument, change: (program: Program) => Program): CellDocument => ({
    ...cell,
    programs: cell.programs.map(each => (isTextProgram(each) ? each : change(each))),
  });
  commit(a!.session, cell => inProgram(cell, routine));
  b!.session.disconnected();
  commit(b!.session, cell =>
    inProgram(cell, program => insertSteps(program, 0, [{ type: "call", id: "c", routine: "weld" }])),
  );
  commit(b!.session, cell => ({ ...cell, name: "Kept" }));
  commit(a!.session, cell => inProgram(cell, program => ({ ...program, routines: {} })));
  b!.connect();
  expect(room.document.name).toBe("Kept");
  expect(steps(room.document)).toEqual([]);
  expect(text(b!.session.document!)).toBe(text(room.document));
  const refused = b!.events.find(event => event.type === "refused");
  expect(refused).toMatchObject({ labels: ["change"], why: { code: "editing.unreadable" } });
  expect(refused?.type === "refused" && steps(refused.kept)).toEqual([{ type: "call", id: "c", routine: "weld" }]);
  expect(refused?.type === "refused" && refused.why.sentence).toMatch(/programs\[0\]\.steps\[0\].*weld/);
});

test("bytes that are no update, and updates that build on what never came, change nothing and end nothing", () => {
  const room = createEditingRoom({ from: { document: emptyCell(), epoch: "one" } });
  const told: RoomMessage[] = [];
  const place = room.join(
    "somebody",
    () => "write",
    message => told.push(message),
  );
  const random = seededRandom(3);
  const other = createSharedCell({ from: { document: edgeTraceCell() } });
  const early = other.vector();
  other.commit("name", { ...other.document, name: "Foreign" });
  const garbage = [
    other.missing(early),
    new Uint8Array(),
    ...Array.from({ length: 300 }, () =>
      Uint8Array.from({ length: 1 + Math.floor(random() * 40) }, () => Math.floor(random() * 256)),
    ),
  ];
  for (const update of garbage) {
    place.receive({ type: "join", epoch: null, vector: update });
    place.receive({ type: "update", number: 1, update });
  }
  expect(text(room.document)).toBe(text(emptyCell()));
  expect(told.filter(({ type }) => type === "refused").length).toBeGreaterThan(200);
  const session = createEditingSession({ onEvent: () => undefined });
  const again = room.join(
    "again",
    () => "write",
    message => session.receive(message),
  );
  session.connected(message => again.receive(message));
  commit(session, cell => ({ ...cell, name: "Goes on" }));
  expect(room.document.name).toBe("Goes on");
});

test("a session that is kept over a reload of its page, and a server that made the document anew, lose nothing", () => {
  const { room, sessions } = roomOf(emptyCell(), { right: "write" });
  const [{ session, connect }] = sessions as [(typeof sessions)[number]];
  session.disconnected();
  commit(session, cell => ({ ...cell, name: "Offline" }));
  const reloaded = createEditingSession({ onEvent: () => undefined, kept: session.keep()! });
  const place = room.join(
    "p",
    () => "write",
    message => reloaded.receive(message),
  );
  reloaded.connected(message => place.receive(message));
  expect(room.document.name).toBe("Offline");
  // The other server knows the cell as a file alone.
  const anew = createEditingRoom({ from: { document: { ...emptyCell(), training: true }, epoch: "two" } });
  connect();
  session.disconnected();
  commit(session, cell => ({ ...cell, name: "For two" }));
  const there = anew.join(
    "p",
    () => "write",
    message => session.receive(message),
  );
  session.connected(message => there.receive(message));
  expect(anew.document).toMatchObject({ name: "For two", training: true });
});
