import { emptyProgram, planProgram, pose, robotById, type Program } from "@twincell/core";
import { expect, test } from "vitest";
import { speedPlot } from "./speedPlot.ts";

const robot = robotById("staubli_rx90l")!;
const Q = [0.2, -1.0, 1.7, 0, 0.87, 0.2];

test("L-35 the speed of the tool along the path: 100 mm/s where 100 mm/s is programmed, nothing in waits", () => {
  const program: Program = {
    ...emptyProgram("staubli_rx90l"),
    tools: { torch: pose([0, 0, 0.2]) },
    steps: [
      { id: "a", type: "move", path: "ptp", target: { q: Q, tool: "torch" }, speed: { ratio: 0.5 }, blend_m: 0 },
      { id: "w", type: "wait", s: 1 },
      {
        id: "b",
        type: "move",
        path: "lin",
        target: { q: [0.5, ...Q.slice(1)], tool: "torch" },
        speed: { mps: 0.1 },
        blend_m: 0,
      },
    ],
  };
  const { plan } = planProgram(program, robot);
  const [t, speed, asked] = speedPlot(plan, robot, program, pose());
  const wait = plan.segments.find(segment => segment.step === "w")!;
  const during = t.flatMap((at, i) => (at >= wait.start_s && at <= wait.start_s + wait.duration_s ? [i] : []));
  expect(during.length).toBeGreaterThan(1);
  // At its border to a motion an instant stands twice: at rest, and with what the motion begins with.
  expect(Math.max(...during.slice(1, -1).map(i => speed![i]!))).toBeLessThan(5);
  const line = plan.segments.findLast(segment => segment.step === "b")!;
  const middle = t.findIndex(at => at > line.start_s + line.duration_s / 2);
  expect(speed![middle]).toBeCloseTo(100, 0);
  expect(asked![middle]).toBe(100);
  expect(asked![0]).toBeNull();
  expect(t.every((at, i) => i === 0 || at >= t[i - 1]!)).toBe(true);
});
