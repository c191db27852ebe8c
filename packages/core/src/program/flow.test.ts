import { describe, expect, test } from "vitest";
import { compose, type Pose } from "../spatial/pose.ts";
import { palletSlots } from "./pallet.ts";
import { LOOK_AGAIN_S, flow, unrolled } from "./flow.ts";
import { emptyProgram, type MoveStep, type Program, type Step } from "./program.ts";
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
