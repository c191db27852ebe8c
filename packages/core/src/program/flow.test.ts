import { describe, expect, test } from "vitest";
import { compose, type Pose } from "../spatial/pose.ts";
import { palletSlots } from "./pallet.ts";
import { LOOK_AGAIN_S, flow, unrolled } from "./flow.ts";
import { emptyProgram, type MoveStep, type Predicate, type Program, type Step } from "./program.ts";
import { SignalTable, holds } from "./signals.ts";

const wait = (id: string): Step => ({ id, type: "wait", s: 1 });
const move = (id: string, blend_m = 0, frame = "world"): MoveStep => ({
  id,
  type: "move",
  path: "lin",
  target: { pose: { position: [0, 0, 0.1], quaternion: [0, 0, 0, 1] }, frame, tool: "flange" },
  speed: { mps: 0.1 },
  blend_m,
});
const repeat = (id: string, times: number | "forever", ...steps: Step[]): Step => ({
  id,
  type: "repeat",
  times,
  steps,
});
const of = (...steps: Step[]): Program => ({ ...emptyProgram("staubli_rx90l"), steps });
const ids = (program: Program, signals?: SignalTable, most = 50): string => {
  const seen: string[] = [];
  for (const step of unrolled(program, signals)) {
    seen.push(step.type === "wait" && step.s === 0 ? "|" : step.id);
    if (seen.length >= most) break;
  }
  return seen.join(" ");
};

describe("flow of a program", () => {
  test("loops, calls and nested blocks become the steps they amount to, comments nothing", () => {
    const program: Program = {
      ...of(
        wait("a"),
        repeat("r", 2, wait("b"), { id: "c", type: "call", routine: "pick" }),
        { id: "k", type: "comment", text: "" },
        wait("z"),
      ),
      routines: { pick: [wait("p"), repeat("q", 2, wait("x"))] },
    };
    expect(ids(program)).toBe("a b p x x b p x x z");
    expect(ids(of(repeat("r", 0, wait("b"))))).toBe("");
  });

  test("a loop without end goes on for as long as it is asked; one that does nothing lets time pass", () => {
    expect(ids(of(repeat("r", "forever", wait("a"))), undefined, 4)).toBe("a a a a");
    const [step] = unrolled(of(repeat("r", "forever", { id: "k", type: "comment", text: "" })));
    expect(step).toEqual({ id: "r", type: "wait", s: LOOK_AGAIN_S });
  });

  test("a decision is read when it is come to; steps before it that are passed stop first", () => {
    const signals = new SignalTable();
    const choice: Step = {
      id: "i",
      type: "if",
      when: { signal: "part", is: true },
      then: [wait("yes")],
      else: [wait("no")],
    };
    const run = unrolled(of(move("m", 0.01), choice, choice), signals);
    expect(run.next().value).toMatchObject({ id: "m" });
    expect(run.next().value).toMatchObject({ id: "m", type: "wait", s: 0 });
    signals.write("part", true);
    expect(run.next().value).toMatchObject({ id: "yes" });
    signals.write("part", false);
    expect(run.next().value).toMatchObject({ id: "no" });
  });

  test("a move that is passed stops at the end of a list, before a block and before a call, and nowhere else", () => {
    const m = move("m", 0.01);
    const n = move("n", 0.01);
    expect(ids(of(m, { id: "k", type: "comment", text: "" }, n, wait("w"), n))).toBe("m n w n");
    expect(ids(of(m, repeat("r", 2, m, n), n))).toBe("m | m n | m n | n");
    expect(ids({ ...of(m, { id: "c", type: "call", routine: "p" }), routines: { p: [n] } })).toBe("m | n |");
    expect(
      ids(of({ ...m, until: { when: { signal: "part", is: true }, missing: "fault" } }, repeat("r", 1, wait("w")))),
    ).toBe("m w");
  });

  test("stop ends the program from inside blocks and routines", () => {
    expect(
      ids({
        ...of(repeat("r", 3, { id: "c", type: "call", routine: "p" }), wait("z")),
        routines: { p: [wait("a"), { id: "s", type: "stop" }, wait("b")] },
      }),
    ).toBe("a s");
  });

  test("M-54 inside a pallet, targets in its frame are the places, in the frame the pallet stands in", () => {
    const pallet = {
      frame: "table",
      origin: {
        position: [0.1, 0, 0] as [number, number, number],
        quaternion: [0, 0, 1, 0] as [number, number, number, number],
      },
      rowEnd: [0.3, 0, 0] as [number, number, number],
      columnEnd: [0.1, 0.2, 0] as [number, number, number],
      rows: 3,
      columns: 3,
      layers: 1,
      layer_m: 0,
    };
    const program: Program = {
      ...of({ id: "t", type: "pallet", pallet: "tray", steps: [move("in", 0, "tray"), move("home")] }),
      frames: { table: { position: [1, 0, 0], quaternion: [0, 0, 0, 1] } },
      pallets: { tray: pallet },
    };
    const steps = [...unrolled(program)].filter(step => step.type === "move");
    expect(steps.length).toBe(18);
    palletSlots(pallet).forEach((frameFromPlace, i) => {
      const { target } = steps[2 * i]!;
      const wanted = compose(frameFromPlace, { position: [0, 0, 0.1], quaternion: [0, 0, 0, 1] } as Pose as Pose<
        "place",
        "tcp"
      >);
      expect(target).toMatchObject({ frame: "table", pose: wanted });
      expect(steps[2 * i + 1]!.target).toEqual(move("home").target);
    });
  });

  test("looked at from both sides, a decision forks and joins, and a loop without end is gone round as often as asked", () => {
    const program = of(
      {
        id: "i",
        type: "if",
        when: { signal: "part", is: true },
        then: [{ id: "s", type: "stop" }],
        else: [wait("no")],
      },
      repeat("r", "forever", wait("a")),
      wait("z"),
    );
    const seen = Array.from(flow(program, { rounds: 2 }), happening =>
      happening.kind === "step" || happening.kind === "passed" ? happening.step.id : happening.kind,
    );
    expect(seen.join(" ")).toBe("i fork s end other no join r a a end z");
  });

  test("conditions compare lines that are on or off, and levels", () => {
    const signals = new SignalTable([
      ["on", true],
      ["level", 2.5],
    ]);
    expect([
      holds({ signal: "on", is: true }, signals),
      holds({ signal: "off", is: false }, signals),
      holds({ signal: "level", is: true }, signals),
    ]).toEqual([true, true, true]);
    expect([
      holds({ signal: "level", above: 2.5 }, signals),
      holds({ signal: "level", above: 2.4 }, signals),
      holds({ signal: "level", below: 3 }, signals),
      holds({ signal: "on", above: 0.5 }, signals),
    ]).toEqual([false, true, true, true]);
  });
});

describe("flow of a program that computes", () => {
  const counting = (...steps: Step[]): Program => ({
    ...of(...steps),
    variables: { n: { type: "int" }, ready: { type: "bool" } },
    signals: { part: { kind: "digital-in" } },
  });
  const less = (most: number): Predicate => ({ expression: { op: "<", of: [{ variable: "n" }, most] } });
  const add = (id: string, by = 1): Step => ({
    id,
    type: "assign",
    variable: "n",
    to: { op: "+", of: [{ variable: "n" }, by] },
  });
  const loop = (id: string, when: Predicate, ...steps: Step[]): Step => ({ id, type: "while", when, steps });
  const choice = (id: string, when: Predicate, then: Step[], otherwise: Step[]): Step => ({
    id,
    type: "if",
    when,
    then,
    else: otherwise,
  });

  test("a counted loop goes round until its condition is false; what only computes takes no time", () => {
    const program = counting(loop("w", less(3), wait("a"), add("n")), choice("i", less(3), [wait("x")], [wait("y")]));
    expect(ids(program)).toBe("a a a y");
    expect([...unrolled(counting(loop("w", less(1000), add("n")), wait("z")))].map(step => step.id)).toEqual(["z"]);
  });

  test("a loop that computes without end is refused with its step", () => {
    const endless = counting(loop("w", less(1), { id: "a", type: "assign", variable: "n", to: 0 }));
    expect(() => [...unrolled(endless)]).toThrow(
      /Step “w”: its loop went round 100000 times without a motion or a wait/,
    );
    const divided = counting({ id: "d", type: "assign", variable: "n", to: { op: "div", of: [1, { variable: "n" }] } });
    expect(() => [...unrolled(divided)]).toThrow(/Step “d”: A number is divided by zero/);
  });

  test("a computation does not stop a move that is passed; one that looks at a line does", () => {
    const looks: Step = { id: "l", type: "assign", variable: "ready", to: { signal: "part" } };
    expect(ids(counting(move("a", 0.01), add("n"), move("b")))).toBe("a b");
    expect(ids(counting(move("a", 0.01), looks, move("b")))).toBe("a | b");
  });

  test("a routine is given values by its caller, and its parameters are its own", () => {
    const program: Program = {
      ...counting(
        { id: "c", type: "call", routine: "turns", arguments: { times: 2 } },
        { id: "d", type: "call", routine: "turns", arguments: { times: { op: "+", of: [{ variable: "n" }, 1] } } },
      ),
      parameters: { turns: { times: { type: "int" } } },
      routines: {
        turns: [
          { id: "z", type: "assign", variable: "n", to: 0 },
          loop("w", { expression: { op: "<", of: [{ variable: "n" }, { variable: "times" }] } }, wait("t"), add("n")),
          wait("|"),
        ],
      },
    };
    expect(ids(program)).toBe("t t | t t t |");
  });

  test("a wait that is late does the steps for that, and a condition is handed over with its variables as values", () => {
    const late: Step = {
      id: "w",
      type: "wait-for",
      when: { expression: { op: "and", of: [{ signal: "part" }, { op: "<", of: [{ variable: "n" }, 5] }] } },
      timeout_s: 2,
      late: [wait("late")],
    };
    const program = counting(add("n"), late, wait("z"));
    expect(ids(program, new SignalTable([["part", true]]))).toBe("w z");
    expect(ids(program, new SignalTable([["part", false]]))).toBe("w late z");
    const [first] = unrolled(program);
    expect(first).toEqual({
      id: "w",
      type: "wait-for",
      timeout_s: 2,
      late: [],
      when: { expression: { op: "and", of: [{ signal: "part" }, { op: "<", of: [1, 5] }] } },
    });
  });

  test("without inputs, decisions of variables alone are taken and both sides of the others are looked at", () => {
    const seen = (program: Program): string =>
      Array.from(flow(program, { rounds: 2 }))
        .flatMap(event =>
          event.kind === "step" ? [event.step.id] : ["fork", "other", "join"].includes(event.kind) ? [event.kind] : [],
        )
        .join(" ");
    const part: Predicate = { signal: "part", is: true };
    expect(seen(counting(choice("i", less(1), [wait("x")], [wait("y")])))).toBe("x");
    expect(seen(counting(choice("p", part, [add("n")], []), choice("i", less(1), [wait("x")], [wait("y")])))).toBe(
      "fork other join fork x other y join",
    );
    expect(seen(counting(choice("p", part, [wait("a")], []), choice("i", less(1), [wait("x")], [wait("y")])))).toBe(
      "fork a other join x",
    );
    // What a loop changes that goes round as inputs say is not known behind it.
    expect(seen(counting(loop("w", part, add("n"), wait("a")), choice("i", less(1), [wait("x")], [wait("y")])))).toBe(
      "fork a a other join fork x other y join",
    );
    expect(seen(counting(repeat("r", "forever", choice("i", less(5), [wait("x")], [wait("y")]), add("n"))))).toBe(
      "fork x other y join fork x other y join",
    );
  });
});
