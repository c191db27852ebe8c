import { describe, expect, test } from "vitest";
import {
  allBranches,
  angleBetween,
  distance,
  flangePose,
  fromAxisAngle,
  minSingularValue,
  pose,
  refine,
  refineScratch,
  robotFromArm,
  seededRandom,
  solverScratch,
  wrapAngle,
  type Joint,
  type SerialArm,
  type Vector3,
} from "../index.ts";

/**
 * A six-joint arm whose axes lie as those of a FANUC CRX-10iA: upper arm and forearm of 540 mm, axis 6 150 mm beside
 * axis 4, flange 160 mm out. The lengths are recalled from public papers on that arm, not taken from its maker: they
 * matter to this test alone.
 */
const UPPER_M = 0.54;
const FORE_M = 0.54;
const ASIDE_M = 0.15;
const FLANGE_M = 0.16;
const POSES = 60;
const STARTS = 300;
const Y: Vector3 = [0, 1, 0];
const Z: Vector3 = [0, 0, 1];
const steps: readonly (readonly [Vector3, Vector3])[] = [
  [[0, 0, 0.245], Z],
  [[0, 0, 0], Y],
  [
    [0, 0, UPPER_M],
    [0, -1, 0],
  ],
  [
    [0, 0, 0],
    [-1, 0, 0],
  ],
  [
    [FORE_M, 0, 0],
    [0, -1, 0],
  ],
  [
    [0, ASIDE_M, 0],
    [-1, 0, 0],
  ],
];
const crx: SerialArm = {
  name: "CRX-like",
  joints: steps.map(
    ([moved, axis], j): Joint => ({
      name: `J${j + 1}`,
      axis,
      parentFromJoint: pose<"parent", "joint">(moved),
      limits: { lower_rad: -Math.PI, upper_rad: Math.PI, speed_rad_s: 2, acceleration_rad_s2: 8 },
    }),
  ),
  lastJointFromFlange: pose([FLANGE_M, 0, 0], fromAxisAngle(Y, Math.PI / 2)),
};
const robot = robotFromArm(crx);
const apart = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(a, (angle, j) => Math.abs(wrapAngle(angle - b[j]!))));

describe("N-66 axes as a FANUC CRX has them", () => {
  test("are a general six whose wrist misses one point by the sideways step", () => {
    if (robot.family.kind !== "general-6r") throw new Error(robot.family.kind);
    expect(robot.family.e_m).toBeCloseTo(ASIDE_M, 9);
    expect([robot.family.c2_m, Math.hypot(...robot.family.centre_m)]).toEqual([
      expect.closeTo(UPPER_M, 9),
      expect.closeTo(FORE_M, 9),
    ]);
    const { axis4, axis5 } = robot.family;
    expect(axis4[0] * axis5[0] + axis4[1] * axis5[1] + axis4[2] * axis5[2]).toBeCloseTo(0, 12);
  });

  // Witness: Newton's method from 300 random postures, which knows of axes only.
  test("every posture that Newton's method finds from many starts is among the branches, and each branch meets its pose, seed 10", () => {
    const random = seededRandom(10);
    const scratch = solverScratch();
    const newton = refineScratch();
    const q = new Float64Array(6);
    let found = 0;
    let most = 0;
    for (let n = 0; n < POSES; n++) {
      const start = Float64Array.from({ length: 6 }, () => 2 * Math.PI * (random() - 0.5));
      const wanted = flangePose(crx, start);
      const branches = allBranches(robot, wanted, undefined, scratch);
      if (minSingularValue(crx, start) < 1e-3) continue;
      for (const branch of branches) {
        const is = flangePose(crx, branch);
        expect(
          Math.max(distance(is.position, wanted.position), angleBetween(is.quaternion, wanted.quaternion)),
        ).toBeLessThan(1e-9);
      }
      expect(branches.some(branch => apart(branch, start) < 1e-5)).toBe(true);
      for (let k = 0; k < STARTS; k++) {
        for (let j = 0; j < 6; j++) q[j] = 2 * Math.PI * (random() - 0.5);
        if (!(refine(crx, q, wanted, newton) < 1e-10) || minSingularValue(crx, q) < 1e-3) continue;
        found++;
        expect(branches.some(branch => apart(branch, q) < 1e-5)).toBe(true);
      }
      most = Math.max(most, branches.length);
    }
    expect(found).toBeGreaterThan(700);
    expect(most).toBeGreaterThanOrEqual(8);
  });
});
