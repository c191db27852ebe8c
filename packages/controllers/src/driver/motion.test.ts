import { planProgram, robotById, emptyProgram, type MoveStep } from "@twincell/core";
import { expect, test } from "vitest";
import { MotionMaker } from "./motion.ts";

const robot = robotById("ur10e")!;
const turn = (by_rad: number, time_s: number): MoveStep => ({
  id: "turn",
  type: "move",
  path: "ptp",
  target: { q: robot.home_rad.map((q, joint) => (joint === 0 ? q + by_rad : q)) },
  speed: { time_s },
  blend_m: 0,
});

test.each([
  [0.3, 1],
  [0.3, 1.5],
  [0.02, 4],
  [2.5, 10],
])(
  "a joint move of %d rad in %d s gets the share of joint speed that takes as long, ramps included",
  (by_rad, time_s) => {
    const from_rad = Float64Array.from(robot.home_rad);
    const answer = new MotionMaker(robot).make(turn(by_rad, time_s), { tools: {}, frames: {} }, from_rad);
    if (answer.kind !== "motion" || answer.motion.path !== "joints") throw new Error(answer.kind);
    const { ratio } = answer.motion;
    const steps = [{ ...turn(by_rad, time_s), speed: { ratio } }];
    const planned = planProgram({ ...emptyProgram(robot.id), steps }, robot, { start_rad: from_rad });
    expect(planned.plan.duration_s / time_s).toBeCloseTo(1, 2);
  },
);
