import { emptyProgram, planProgram, pose, robotById, type Program, type Step } from "@twincell/core";
import { expect, test } from "vitest";
import { laneBars } from "./lanes.ts";

const robot = robotById("staubli_rx90l")!;
const to = (id: string, angle: number): Step => ({
  id,
  type: "move",
  path: "ptp",
  target: { q: [...robot.home_rad].with(0, angle) },
  speed: { ratio: 0.5 },
  blend_m: 0,
});
const bars = (steps: readonly Step[], more: Partial<Program> = {}) => {
  const program: Program = { ...emptyProgram(robot.id), ...more, steps };
  const { plan } = planProgram(program, robot);
  return { bars: laneBars(program, plan), plan };
};

test("a loop in a loop: one bar outside with its passes, one inside for each of them", () => {
  const inner: Step = { id: "in", type: "repeat", times: 3, steps: [to("b", 0.2), to("c", 0.1)] };
  const { bars: found, plan } = bars([
    to("z", 0.5),
    { id: "out", type: "repeat", times: 2, steps: [to("a", 0), inner] },
    to("end", 0.7),
  ]);
  expect(found.map(({ step, depth, passes_s }) => [step, depth, passes_s.length])).toEqual([
    ["out", 0, 2],
    ["in", 1, 3],
    ["in", 1, 3],
  ]);
  const [out, first, second] = found;
  const starts = (id: string): number[] => plan.segments.filter(({ step }) => step === id).map(each => each.start_s);
  expect(out!.start_s).toBe(starts("a")[0]);
  expect(out!.end_s).toBeCloseTo(starts("end")[0]!, 9);
  expect(out!.passes_s).toEqual(starts("a"));
  expect([...first!.passes_s, ...second!.passes_s]).toEqual(starts("b"));
});

test("a loop that is all of another loop has its own bar in each pass", () => {
  const inner: Step = { id: "in", type: "repeat", times: 2, steps: [to("b", 0.2), to("c", 0.1)] };
  const { bars: found } = bars([{ id: "out", type: "repeat", times: 3, steps: [inner] }]);
  expect(found.map(({ step, passes_s }) => [step, passes_s.length])).toEqual([
    ["out", 3],
    ["in", 2],
    ["in", 2],
    ["in", 2],
  ]);
});

test("a pallet that calls a routine, which is called once more after it: nine passes, and the last call is outside", () => {
  const pallet = {
    frame: "world",
    origin: pose<"frame", "place">(),
    rowEnd: [1, 0, 0] as [number, number, number],
    columnEnd: [0, 1, 0] as [number, number, number],
    rows: 3,
    columns: 3,
    layers: 1,
    layer_m: 0,
  };
  const { bars: found, plan } = bars(
    [
      {
        id: "p",
        type: "pallet",
        pallet: "P",
        steps: [{ id: "call", type: "call", routine: "R" }, to("place", 0.4)],
      },
      { id: "again", type: "call", routine: "R" },
    ],
    { pallets: { P: pallet }, routines: { R: [to("pick", -0.4)] } },
  );
  expect(found).toHaveLength(1);
  expect(found[0]!.passes_s).toHaveLength(9);
  expect(found[0]!.end_s).toBeCloseTo(plan.segments.at(-1)!.start_s, 9);
});

test("a program without blocks has no bars", () => {
  expect(bars([to("a", 0.1), to("b", 0.2)]).bars).toEqual([]);
});
