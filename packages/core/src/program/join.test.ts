import { describe, expect, test } from "vitest";
import { flangePose } from "../kinematics/forward.ts";
import { robotById } from "../robots/library/index.ts";
import { pose, compose } from "../spatial/pose.ts";
import { distance } from "../spatial/vector.ts";
import { insertSteps } from "./edit.ts";
import { unrolled } from "./flow.ts";
import { joinProgram } from "./join.ts";
import { parseProgram } from "./parse.ts";
import { palletSlots } from "./pallet.ts";
import { emptyProgram, type Program, type Step } from "./program.ts";
import { countedFrom, palletsAround, worldOfTarget } from "./recount.ts";
import { callableFrom, isCalled, removeRoutine, renameRoutine, withoutParameter, withParameter } from "./routines.ts";
import { serializeProgram } from "./serialize.ts";

const robot = robotById("staubli_rx90l")!;
const base = pose<"world", "base">([0, 0, 0]);
const read = (program: Program): Program => {
  const answer = parseProgram(JSON.parse(serializeProgram(program)));
  if (answer.kind === "not-a-program") throw new Error(answer.faults.map(fault => fault.sentence).join(" "));
  return answer.program;
};
const wait = (id: string, s: number): Step => ({ id, type: "wait", s });
/** Counts to three with a line, a variable, a routine with a parameter, and ends. */
const counting = (address: number, s: number): Program => ({
  ...emptyProgram("staubli_rx90l", `Counting ${s}`),
  version: 2,
  signals: { done: { kind: "digital-out", address } },
  variables: { count: { type: "int" } },
  parameters: { turn: { level: { type: "int" } } },
  routines: { turn: [wait("s1", s), { id: "s2", type: "set", signal: "done", to: true }] },
  steps: [
    {
      id: "s3",
      type: "while",
      when: { expression: { op: "<", of: [{ variable: "count" }, 3] } },
      steps: [
        { id: "s4", type: "call", routine: "turn", arguments: { level: { variable: "count" } } },
        { id: "s5", type: "assign", variable: "count", to: { op: "+", of: [{ variable: "count" }, 1] } },
      ],
    },
    { id: "s6", type: "stop" },
  ],
});
const acts = (program: Program): readonly string[] =>
  Array.from(unrolled(program), step => (step.type === "wait" ? `wait ${step.s}` : step.type));

describe("another program", () => {
  test("N-70 is appended: both do what they did, one after the other, whatever names they share", () => {
    const first = { ...counting(1, 1), steps: counting(1, 1).steps.slice(0, -1) };
    const { program, steps } = joinProgram(first, counting(7, 2));
    const both = read(insertSteps(program, program.steps.length, steps));
    const turn = (s: number): readonly string[] => [0, 1, 2].flatMap(() => [`wait ${s}`, "set"]);
    expect(acts(both)).toEqual([...turn(1), ...turn(2)]);
    expect(both.signals).toEqual({
      done: { kind: "digital-out", address: 1 },
      "done 2": { kind: "digital-out", address: 7 },
    });
    expect(Object.keys(both.variables!)).toEqual(["count", "count_2"]);
    expect(Object.keys(both.routines)).toEqual(["turn", "turn 2"]);
    expect(both.parameters).toEqual({ turn: { level: { type: "int" } }, "turn 2": { level_2: { type: "int" } } });
  });

  test("N-70 is called twice and counts from the beginning each time; what is the same is shared", () => {
    const { program, steps } = joinProgram(
      { ...emptyProgram("staubli_rx90l"), signals: counting(1, 1).signals },
      counting(1, 1),
    );
    const called = read({
      ...program,
      routines: { ...program.routines, task: steps },
      steps: [
        { id: "k1", type: "call", routine: "task" },
        { id: "k2", type: "call", routine: "task" },
      ],
    });
    expect(acts(called)).toHaveLength(12);
    expect(Object.keys(called.signals)).toEqual(["done"]);
  });

  test("its places and frames keep where they are under their new names", () => {
    const at = (x: number): Program => ({
      ...emptyProgram("staubli_rx90l"),
      frames: { table: pose([x, 0, 0]) },
      pallets: {
        places: {
          frame: "table",
          origin: pose([0, 0, 0.1]),
          rowEnd: [0.2, 0, 0.1],
          columnEnd: [0, 0.2, 0.1],
          rows: 2,
          columns: 2,
          layers: 1,
          layer_m: 0,
        },
      },
      steps: [
        {
          id: "a",
          type: "pallet",
          pallet: "places",
          steps: [
            {
              id: "b",
              type: "move",
              path: "lin",
              target: { pose: pose([0, 0, 0.05]), frame: "places", tool: "flange" },
              speed: { mps: 0.1 },
              blend_m: 0,
            },
          ],
        },
      ],
    });
    const { program, steps } = joinProgram(at(0.5), at(0.9));
    const both = read(insertSteps(program, 1, steps));
    const first = both.steps[1]!;
    expect(first).toMatchObject({ type: "pallet", pallet: "places 2" });
    expect(palletSlots(both.pallets["places 2"]!)).toHaveLength(4);
    const move = first.type === "pallet" ? first.steps[0]! : undefined;
    if (move?.type !== "move") throw new Error("a move was expected");
    expect(worldOfTarget(both, robot, base, move.target)!.position).toEqual([0.9, 0, 0.15000000000000002]);
    expect(palletsAround(both, move.id)).toEqual(["places 2"]);
  });
});

test("a target taught as joints is counted from a place and stays where it is, in its posture", () => {
  const q = [0.2, -1.2, 1.9, 0.1, 0.8, 0.3];
  const program: Program = {
    ...emptyProgram("staubli_rx90l"),
    frames: { table: pose([0.5, 0.1, 0.2]) },
    pallets: {
      places: {
        frame: "table",
        origin: pose([0.1, 0, 0]),
        rowEnd: [0.3, 0, 0],
        columnEnd: [0.1, 0.2, 0],
        rows: 3,
        columns: 3,
        layers: 1,
        layer_m: 0,
      },
    },
  };
  const there = countedFrom(program, robot, base, { q }, "places")!;
  expect(there).toMatchObject({ frame: "places", tool: "flange", branch: { shoulder: "front" } });
  const worldFromFlange = compose(base, flangePose(robot.arm, q));
  expect(distance(worldOfTarget(program, robot, base, there)!.position, worldFromFlange.position)).toBeLessThan(1e-12);
  expect(countedFrom(program, robot, base, { q, tool: "no such" }, "places")).toBeUndefined();
});

describe("routines", () => {
  test("parameters come with a value in every call, and go with it; what is read or called stays", () => {
    const program = withParameter(counting(1, 1), "turn", "height", { type: "num", unit: "m" });
    expect(read(program).parameters!.turn).toEqual({ level: { type: "int" }, height: { type: "num", unit: "m" } });
    expect(withoutParameter(read(program), "turn", "height")).toEqual(counting(1, 1));
    expect(isCalled(program, "turn")).toBe(true);
    expect(removeRoutine(program, "turn")).toBe(program);
    expect(read(renameRoutine(program, "turn", "round")).routines).toHaveProperty("round");
    expect(renameRoutine(program, "turn", "")).toBe(program);
  });

  test("none is offered where it would come back to itself", () => {
    const routines = { a: [{ id: "1", type: "call", routine: "b" } as const], b: [], c: [] };
    expect(callableFrom({ routines }, "b")).toEqual(["c"]);
    expect(callableFrom({ routines }, undefined)).toEqual(["a", "b", "c"]);
  });
});
