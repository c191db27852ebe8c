import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import {
  flangePose,
  fromAxisAngle,
  jacobian,
  jacobianScratch,
  manipulability,
  nearestSingularity,
  pose,
  robotById,
  rotate,
  seededRandom,
  singularValues,
  tipTwist,
  transformPoint,
  type SerialArm,
  type Vector3,
} from "../index.ts";

const robot = robotById("staubli_rx90l")!;
const random = seededRandom(31);
const angles = (n: number): Float64Array => Float64Array.from({ length: n }, () => (random() - 0.5) * 6);

/** Axes in odd directions and turned frames, so that no special case of the RX90L hides a fault. */
const odd: SerialArm = {
  name: "seven odd axes",
  joints: Array.from({ length: 7 }, (_, i) => {
    const axis: Vector3 =
      i === 0 ? [1, 0, 0] : i === 1 ? [0, -1, 0] : i === 2 ? [0, 0, -1] : unit([Math.sin(i), Math.cos(2 * i), 0.3 * i]);
    return {
      name: `joint_${i + 1}`,
      axis,
      parentFromJoint: pose([0.1 * i, 0.2 - 0.03 * i, 0.25], fromAxisAngle(unit([1, i, -i]), 0.4 * i)),
      limits: { lower_rad: -3, upper_rad: 3, speed_rad_s: 1, acceleration_rad_s2: 1 },
    };
  }),
  lastJointFromFlange: pose([0.05, -0.02, 0.1], fromAxisAngle([0, 1, 0], 1)),
};
function unit([x, y, z]: Vector3): Vector3 {
  const n = Math.hypot(x, y, z);
  return [x / n, y / n, z / n];
}

describe.each([
  ["Stäubli RX90L", robot.arm],
  ["seven odd axes", odd],
] as const)("Jacobian of %s", (_, arm) => {
  test("is the derivative of forward kinematics at the tip", () => {
    const n = arm.joints.length;
    const tip: Vector3 = [0.03, -0.05, 0.2];
    const h = 1e-6;
    for (let round = 0; round < 100; round++) {
      const q = angles(n);
      const rows = jacobian(arm, q, tip);
      for (let i = 0; i < n; i++) {
        const ahead = flangePose(
          arm,
          q.map((angle, j) => angle + (j === i ? h : 0)),
        );
        const behind = flangePose(
          arm,
          q.map((angle, j) => angle - (j === i ? h : 0)),
        );
        const a = transformPoint(ahead, tip);
        const b = transformPoint(behind, tip);
        for (let row = 0; row < 3; row++) expect(rows[row * n + i]!).toBeCloseTo((a[row]! - b[row]!) / (2 * h), 8);
        // The turning rate: how a vector fixed in the flange moves, ω × v.
        const omega: Vector3 = [rows[3 * n + i]!, rows[4 * n + i]!, rows[5 * n + i]!];
        for (const fixed of [
          [1, 0, 0],
          [0, 1, 0],
          [0, 0, 1],
        ] as Vector3[]) {
          const va = rotate(ahead.quaternion, fixed);
          const vb = rotate(behind.quaternion, fixed);
          const v = rotate(flangePose(arm, q).quaternion, fixed);
          const turned = [
            omega[1] * v[2] - omega[2] * v[1],
            omega[2] * v[0] - omega[0] * v[2],
            omega[0] * v[1] - omega[1] * v[0],
          ];
          for (let k = 0; k < 3; k++) expect(turned[k]!).toBeCloseTo((va[k]! - vb[k]!) / (2 * h), 8);
        }
      }
    }
  });

  test("leaves the flange's pose in the scratch, and a tip at the flange is no tip", () => {
    const q = angles(arm.joints.length);
    const scratch = jacobianScratch(arm.joints.length);
    const rows = jacobian(arm, q, null, undefined, scratch);
    const flange = flangePose(arm, q);
    // The pose alone is had by a shorter way of reckoning: equal but for the last digits.
    [...flange.position, ...flange.quaternion].forEach((value, i) => {
      expect([...scratch.baseFromFlange.position, ...scratch.baseFromFlange.quaternion][i]).toBeCloseTo(value, 13);
    });
    expect([...jacobian(arm, q, [0, 0, 0])]).toEqual([...rows]);
  });
});

test("the tip's twist is the Jacobian times the joint speeds", () => {
  const q = angles(6);
  const speeds = angles(6);
  const h = 1e-6;
  const twist = tipTwist(jacobian(robot.arm, q), speeds);
  const a = flangePose(
    robot.arm,
    q.map((angle, i) => angle + speeds[i]! * h),
  );
  const b = flangePose(
    robot.arm,
    q.map((angle, i) => angle - speeds[i]! * h),
  );
  for (let row = 0; row < 3; row++) expect(twist[row]!).toBeCloseTo((a.position[row]! - b.position[row]!) / (2 * h), 7);
});

/**
 * Witness: pinocchio's Jacobian and LAPACK's singular values at the seeds of the inverse cases, printed to four digits.
 */
const inverse = JSON.parse(
  readFileSync(new URL("../../../../fixtures/kinematics/staubli_rx90l.inverse.json", import.meta.url), "utf8"),
) as { poses: { seed_q: number[]; sigma_min_seed: number }[] };

test("the smallest singular value agrees with the reference at every seed", () => {
  for (const { seed_q, sigma_min_seed } of inverse.poses) {
    expect(Number(singularValues(jacobian(robot.arm, seed_q))[5]!.toPrecision(4))).toBeCloseTo(sigma_min_seed, 9);
  }
});

test("singular values are 0 on a singularity, and manipulability is their product", () => {
  expect(singularValues(jacobian(robot.arm, [0.3, -1, 1.5, 0.4, 0, 0.2]))[5]).toBeLessThan(1e-15);
  expect(manipulability(jacobian(robot.arm, robot.home_rad))).toBeLessThan(1e-15);
  const rows = jacobian(robot.arm, [0.3, -1, 1.5, 0.4, 0.8, 0.2]);
  expect(manipulability(rows)).toBeCloseTo(
    Math.abs(determinant(Array.from({ length: 6 }, (_, r) => [...rows.slice(6 * r, 6 * r + 6)]))),
    12,
  );
});

function determinant(m: number[][]): number {
  if (m.length === 1) return m[0]![0]!;
  return m[0]!.reduce(
    (sum, value, column) =>
      sum + (column % 2 ? -1 : 1) * value * determinant(m.slice(1).map(row => row.filter((_, j) => j !== column))),
    0,
  );
}

test("the nearest singularity is named with its distance", () => {
  const near = (q: number[]): string => nearestSingularity(robot, q)!.sentence;
  expect(near([0, -1, 1.5, 0, (2 * Math.PI) / 180, 0])).toBe("Joint 5 is 2.0° from where axes 4 and 6 are in line.");
  expect(near([0, -1, Math.PI / 2 + (3 * Math.PI) / 180, 0, 1, 0])).toBe(
    "Joint 3 is 3.0° from where the arm is in one line.",
  );
  expect(
    nearestSingularity(robot, [
      0,
      -Math.PI / 2 - 0.8,
      Math.PI / 2 + 0.8 + Math.asin((0.45 * Math.sin(0.8)) / 0.65),
      0,
      1,
      0,
    ]),
  ).toMatchObject({ which: "shoulder", clearance: expect.closeTo(0, 9) });
  expect(nearestSingularity({ ...robot, family: { kind: "general" } }, robot.home_rad)).toBeNull();
});
