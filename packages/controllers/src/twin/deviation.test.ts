import { emptyProgram, planProgram, robotById, type Plan, type Step } from "@twincell/core";
import { expect, test } from "vitest";
import { PlanFollower } from "./deviation.ts";

const robot = robotById("ur10e")!;
const planOf = (...steps: Step[]): Plan =>
  planProgram({ ...emptyProgram(robot.id), signals: {}, steps }, robot, { start_rad: robot.home_rad }).plan;

test("a robot that stands through a program without a motion is nowhere beside its plan, and never infinitely far", () => {
  const programs: Step[][] = [
    [{ id: "m", type: "move", path: "ptp", target: { q: [...robot.home_rad] }, speed: { ratio: 1 }, blend_m: 0 }],
    [{ id: "w", type: "wait", s: 0 }],
    [{ id: "w", type: "wait", s: 0.5 }],
    [{ id: "g", type: "gripper", closed: true }],
    [{ id: "p", type: "payload", mass_kg: 1, center_m: [0, 0, 0] }],
  ];
  for (const steps of programs) {
    const follower = new PlanFollower(planOf(...steps), 6);
    for (let i = 0; i < 5; i++) expect([steps[0]?.type, follower.take(robot.home_rad)]).toEqual([steps[0]?.type, 0]);
  }
});

test("a plan without a segment is nowhere: how far from it is not known", () => {
  for (const plan of [planOf(), planOf({ id: "c", type: "comment", text: "nothing" })])
    expect(new PlanFollower(plan, 6).take(robot.home_rad)).toBeNaN();
});

test("angles that are no numbers make the deviation unknown, not infinite", () => {
  const follower = new PlanFollower(planOf({ id: "w", type: "wait", s: 0.5 }), 6);
  expect(follower.take([NaN, 0, 0, 0, 0, 0])).toBeNaN();
});
