import { expect, test } from "vitest";
import { emptyProgram, planProgram, pose, robotById, torqueProfile, type Program } from "@twincell/core";
import { LIMIT_LINES, torquePlot } from "./torquePlot.ts";

const programOf = (robot: string, q: number[]): Program => ({
  ...emptyProgram(robot),
  steps: [{ id: "a", type: "move", path: "ptp", target: { q }, speed: { ratio: 0.5 }, blend_m: 0 }],
});

test("X-10 torques are plotted as shares of their limits between two lines at 100 %, or the reason is shown", () => {
  const ur10e = robotById("ur10e")!;
  const program = programOf("ur10e", [0.3, -1.2, 1.4, -1.6, -1.5, 0]);
  const { plan } = planProgram(program, ur10e);
  const plotted = torquePlot(plan, ur10e, program, pose(), torqueProfile);
  if (plotted.kind === "unknown") throw new Error(plotted.sentence);
  expect(plotted.data.length).toBe(1 + 6 + LIMIT_LINES);
  expect(new Set(plotted.data.map(row => row.length)).size).toBe(1);
  expect(plotted.data.slice(-LIMIT_LINES).map(row => row[0])).toEqual([-100, 100]);
  // Against torques given by hand: two instants of two joints with limits of 50 and 20 N m.
  const byHand = torquePlot(plan, ur10e, program, pose(), () => ({
    kind: "known",
    joints: 2,
    limits_Nm: Float64Array.of(50, 20),
    torque_Nm: Float64Array.of(25, -20, -50, 4),
    times_s: Float64Array.of(0, 1.5),
    assumptions: [],
  }));
  expect(byHand).toEqual({
    kind: "known",
    data: [
      [0, 1.5],
      [50, -100],
      [-100, 20],
      [-100, -100],
      [100, 100],
    ],
  });
  const rx90l = robotById("staubli_rx90l")!;
  const other = programOf("staubli_rx90l", [0, -1, 2, 0, 0.6, 0]);
  expect(torquePlot(planProgram(other, rx90l).plan, rx90l, other, pose(), torqueProfile)).toMatchObject({
    kind: "unknown",
  });
});
