import { expect, test } from "vitest";
import {
  allBranches,
  BATCH_BRANCHES,
  batchFor,
  flangePose,
  flangePoseBatch,
  pose,
  POSE_STRIDE,
  robotById,
  seededRandom,
  solveBatch,
  wrapAngle,
  type Pose,
} from "../index.ts";

test.each(["staubli_rx90l", "ur10e", "kuka_lbr_iiwa_14_r820", "abb_crb15000_5_95"])(
  "%s: a batch over typed arrays gives what one call after another gives, seed 8",
  id => {
    const robot = robotById(id)!;
    const n = robot.arm.joints.length;
    const random = seededRandom(8);
    const many = 40;
    const q = Float64Array.from({ length: many * n }, () => (random() - 0.5) * 5);
    const poses = flangePoseBatch(robot.arm, q);
    const out = solveBatch(robot, poses);
    expect(poses.length).toBe(many * POSE_STRIDE);
    for (let i = 0; i < many; i++) {
      const wanted: Pose<"base", "flange"> = flangePose(robot.arm, q.subarray(i * n, i * n + n));
      const one = allBranches(robot, wanted);
      expect([...wanted.position, ...wanted.quaternion]).toEqual([
        ...poses.subarray(i * POSE_STRIDE, (i + 1) * POSE_STRIDE),
      ]);
      expect(out.counts[i]).toBe(one.length);
      one.forEach((solution, s) => {
        const at = (i * BATCH_BRANCHES + s) * n;
        solution.forEach((angle, j) => {
          expect(Math.abs(wrapAngle(out.q_rad[at + j]! - angle))).toBeLessThan(1e-12);
        });
      });
    }
  },
);

test("poses that are none, or out of reach, have no postures and disturb no other", () => {
  const robot = robotById("ur10e")!;
  const { position, quaternion } = flangePose(robot.arm, robot.home_rad);
  const poses = Float64Array.from([
    NaN,
    0,
    0,
    0,
    0,
    0,
    1,
    ...position,
    ...quaternion,
    0,
    0,
    0,
    0,
    0,
    0,
    0,
    9,
    0,
    0,
    0,
    0,
    0,
    1,
  ]);
  const out = batchFor(6, 4);
  expect([...solveBatch(robot, poses, out).counts]).toEqual([0, 8, 0, 0]);
  expect(solveBatch(robot, Float64Array.from([...pose().position, ...pose().quaternion])).counts[0]).toBe(
    allBranches(robot, pose()).length,
  );
});
