import { describe, expect, test } from "vitest";
import {
  compareMethods,
  distanceTo,
  flangePose,
  jacobian,
  pose,
  robotById,
  seededRandom,
  slopeOf,
  solveGradient,
  type GradientStep,
  type SerialArm,
} from "../../index.ts";

const robot = robotById("staubli_rx90l")!;
const { arm } = robot;
const random = seededRandom(23);
/** Two links of 1 m in a plane, as the finding of rows X-23 … X-26 was made on. */
const planar: SerialArm = {
  name: "two links",
  joints: [0, 1].map(i => ({
    name: `joint_${i + 1}`,
    axis: [0, 0, 1] as [number, number, number],
    parentFromJoint: pose([i, 0, 0]),
    limits: { lower_rad: -3, upper_rad: 3, speed_rad_s: 1, acceleration_rad_s2: 1 },
  })),
  lastJointFromFlange: pose([1, 0, 0]),
};
const angles = (): Float64Array =>
  Float64Array.from(
    arm.joints,
    ({ limits }) =>
      0.5 * (limits.lower_rad + limits.upper_rad) + 0.7 * (limits.upper_rad - limits.lower_rad) * (random() - 0.5),
  );

describe("gradient descent as the thesis prints it", () => {
  test("X-23 with a constant rate the distance falls until within about L, and then stays bounded by it", () => {
    for (const [steering, L] of [
      [planar, 0.05],
      [planar, 0.01],
      [arm, 0.05],
      [arm, 0.02],
    ] as const) {
      for (let n = 0; n < 10; n++) {
        const n0 = steering.joints.length;
        const target = flangePose(steering, n0 === 6 ? angles() : [0.4 + 0.1 * n, 1.2]);
        const start = n0 === 6 ? angles().fill(0.3, 0, 1) : new Float64Array([-0.5, 0.7]);
        const answer = solveGradient(steering, target, start, { learningRate: L, near_m: 0, sweeps: 600 });
        if (answer.kind === "not-a-pose") throw new Error(answer.because);
        const near = answer.distance_m.findIndex(distance => distance < 3 * L);
        if (near < 0) continue; // a limit of the arm is in the way
        for (let i = 1; i < near; i++) expect(answer.distance_m[i]!).toBeLessThan(answer.distance_m[i - 1]!);
        expect(Math.max(...answer.distance_m.slice(near))).toBeLessThan(6 * L);
      }
    }
  });

  test("X-23 it does not fall at every step, as the paper hopes: near the target a constant rate overshoots", () => {
    const answer = solveGradient(planar, flangePose(planar, [0.6, 1.2]), [-0.5, 0.7], {
      learningRate: 0.05,
      near_m: 0,
      sweeps: 399,
    });
    if (answer.kind === "not-a-pose") throw new Error(answer.because);
    expect(
      answer.distance_m.filter((distance, i) => i > 0 && distance > answer.distance_m[i - 1]!).length,
    ).toBeGreaterThan(50);
    const ours = solveGradient(planar, flangePose(planar, [0.6, 1.2]), [-0.5, 0.7], {
      learningRate: 0.05,
      near_m: 1e-6,
      sweeps: 2000,
      backtracking: true,
    });
    if (ours.kind === "not-a-pose") throw new Error(ours.because);
    expect(ours.distance_m.every((distance, i) => i === 0 || distance <= ours.distance_m[i - 1]!)).toBe(true);
    expect(ours.position_m).toBeLessThan(5e-4);
  });

  test("X-24 Eq 1 is the slope the Jacobian gives, up to O(d)", () => {
    for (let n = 0; n < 50; n++) {
      const q = angles();
      const target = flangePose(arm, angles());
      const rows = jacobian(arm, q);
      const here = flangePose(arm, q).position;
      const far = distanceTo(arm, target, q);
      for (let i = 0; i < 6; i++) {
        const exact = [0, 1, 2].reduce(
          (sum, axis) => sum + (rows[axis * 6 + i]! * (here[axis]! - target.position[axis]!)) / far,
          0,
        );
        for (const d of [1e-2, 1e-3, 1e-4])
          expect(Math.abs(slopeOf(arm, target, q, i, d) - exact)).toBeLessThan(d * (2 + 2 / far));
      }
    }
  });

  test("X-25, X-26 every joint goes against its slope, by L times it", () => {
    const steps: GradientStep[] = [];
    const L = 0.03;
    solveGradient(arm, flangePose(arm, [0.3, -1, 1.2, 0.4, 0.7, -0.2]), [0, -1.2, 1.6, 0.1, 0.5, 0], {
      learningRate: L,
      sweeps: 20,
      near_m: 0,
      trace: step => {
        steps.push(step);
      },
    });
    expect(steps.length).toBe(120);
    for (const { slope_m_rad, from_rad, to_rad } of steps) {
      expect(to_rad).toBeCloseTo(from_rad - L * slope_m_rad, 15);
      if (Math.abs(slope_m_rad) > 1e-12) expect(Math.sign(to_rad - from_rad)).toBe(-Math.sign(slope_m_rad));
    }
  });

  test("X-27 the order is visible: from the joint after the base outwards, each from where the one before has led", () => {
    const steps: GradientStep[] = [];
    const q0 = [0, -1.2, 1.6, 0.1, 0.5, 0];
    const target = flangePose(arm, [0.3, -1, 1.2, 0.4, 0.7, -0.2]);
    solveGradient(arm, target, q0, {
      sweeps: 2,
      near_m: 0,
      trace: step => {
        steps.push(step);
      },
    });
    expect(steps.map(({ sweep, joint }) => `${sweep}.${joint}`)).toEqual([
      "1.1",
      "1.2",
      "1.3",
      "1.4",
      "1.5",
      "1.6",
      "2.1",
      "2.2",
      "2.3",
      "2.4",
      "2.5",
      "2.6",
    ]);
    const q = Float64Array.from(q0);
    for (const step of steps) {
      expect(slopeOf(arm, target, q, step.joint - 1, 1e-4)).toBeCloseTo(step.slope_m_rad, 12);
      q[step.joint - 1] = step.to_rad;
      expect(distanceTo(arm, target, q)).toBeCloseTo(step.distance_m, 12);
    }
  });
});

test("the same target through each method shows error, iterations and jump", () => {
  const start = [0.2, -1.1, 1.3, 0.3, 0.6, -0.1];
  const compared = compareMethods(robot, flangePose(arm, [0.3, -1, 1.2, 0.4, 0.7, -0.2]), start);
  expect(compared.map(({ method }) => method)).toEqual(["closed", "dls", "fabrik", "gradient"]);
  const [closed, dls, fabrik, gradient] = compared as [
    (typeof compared)[0],
    (typeof compared)[0],
    (typeof compared)[0],
    (typeof compared)[0],
  ];
  for (const exact of [closed, dls]) {
    expect(exact.position_m).toBeLessThan(1e-9);
    expect(exact.angle_rad).toBeLessThan(1e-9);
    expect(exact.jump_rad).toBeCloseTo(0.6, 6);
  }
  expect(fabrik.position_m).toBeLessThan(5e-3);
  expect(gradient.position_m).toBeLessThan(2e-3);
  expect(gradient.angle_rad).toBeGreaterThan(1e-3); // it never looks at the orientation
  expect(gradient.sentence).toMatch(/^After \d+ sweeps \d\.\d\d mm and .*° are left\.$/);
  const far = compareMethods(robot, pose([2, 0, 0.4]), start);
  expect(far[0]).toMatchObject({
    method: "closed",
    q_rad: null,
    sentence: "The wrist would be 2003 mm from the shoulder; the arm is 1100 mm long.",
  });
  expect(far[1]!.sentence).toMatch(/^The flange stays 8\d\d mm away/);
});
