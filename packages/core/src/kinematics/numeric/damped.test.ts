import { describe, expect, test } from "vitest";
import {
  angleBetween,
  dampedScratch,
  distance,
  explainNumeric,
  flangePose,
  fromAxisAngle,
  lengthOfArm,
  nearestDamped,
  pose,
  robotById,
  seededRandom,
  solveAll,
  solveDamped,
  type Pose,
  type SerialArm,
  type Vector3,
} from "../../index.ts";

const rx90 = robotById("staubli_rx90l")!;
const unit = ([x, y, z]: Vector3): Vector3 => {
  const n = Math.hypot(x, y, z);
  return [x / n, y / n, z / n];
};
/** Seven axes in odd directions: no closed form, one joint more than needed. */
const odd: SerialArm = {
  name: "seven odd axes",
  joints: Array.from({ length: 7 }, (_, i) => ({
    name: `joint_${i + 1}`,
    axis: unit([Math.sin(i), Math.cos(2 * i), 0.3 * i + 0.1]),
    parentFromJoint: pose([0.05 * i, 0.2 - 0.03 * i, 0.25], fromAxisAngle(unit([1, i, -i]), 0.4 * i)),
    limits: { lower_rad: -2.5, upper_rad: 2.5, speed_rad_s: 1, acceleration_rad_s2: 1 },
  })),
  lastJointFromFlange: pose([0.05, -0.02, 0.1], fromAxisAngle([0, 1, 0], 1)),
};
const five: SerialArm = { ...odd, name: "five axes", joints: odd.joints.slice(0, 5) };
const anywhere = (arm: SerialArm, random: () => number): Float64Array =>
  Float64Array.from(arm.joints, ({ limits }) => limits.lower_rad + (limits.upper_rad - limits.lower_rad) * random());
const inside = (arm: SerialArm, q: ArrayLike<number>): boolean =>
  arm.joints.every(({ limits }, j) => q[j]! >= limits.lower_rad && q[j]! <= limits.upper_rad);
const gap = (a: Pose, b: Pose): number =>
  Math.max(distance(a.position, b.position), angleBetween(a.quaternion, b.quaternion));

describe.each([
  ["Stäubli RX90L", rx90.arm],
  ["seven odd axes", odd],
  ["five axes", five],
] as const)("damped least squares on %s", (_, arm) => {
  test("finds nearly every reachable pose from a few starts, to 1e-9, inside the limits, and says how many steps it took", () => {
    const random = seededRandom(41);
    const scratch = dampedScratch(arm.joints.length);
    let met = 0;
    let steps = 0;
    for (let n = 0; n < 300; n++) {
      const wanted = flangePose(arm, anywhere(arm, random));
      const reach = solveDamped(arm, wanted, anywhere(arm, random), { restarts: { most: 20, random } }, scratch);
      if (reach.kind === "not-a-pose") throw new Error(reach.because);
      expect(inside(arm, reach.q_rad)).toBe(true);
      expect(gap(flangePose(arm, reach.q_rad), wanted) < 2e-9).toBe(reach.kind === "converged");
      if (reach.kind === "converged") {
        met++;
        steps += reach.iterations;
      }
    }
    expect(met).toBeGreaterThan(280);
    expect(steps / met).toBeLessThan(200);
  });

  test("a nearby start always converges, in a handful of steps, without leaving its neighbourhood", () => {
    const random = seededRandom(42);
    const scratch = dampedScratch(arm.joints.length);
    const out = new Float64Array(arm.joints.length);
    for (let n = 0; n < 300; n++) {
      const q = Float64Array.from(
        arm.joints,
        ({ limits }) =>
          0.9 * (limits.lower_rad + (limits.upper_rad - limits.lower_rad) * random()) +
          0.05 * (limits.lower_rad + limits.upper_rad),
      );
      const near = q.map(angle => angle + 0.02 * (random() - 0.5));
      const wanted = flangePose(arm, q);
      expect(nearestDamped(arm, wanted, near, out, scratch)).toBe(true);
      expect(gap(flangePose(arm, out), wanted)).toBeLessThan(2e-9);
      expect(scratch.iterations).toBeLessThan(40);
    }
  });

  test("never NaN, whatever the start and the target, and every stall has a reason", () => {
    const random = seededRandom(43);
    const scratch = dampedScratch(arm.joints.length);
    for (let n = 0; n < 200; n++) {
      const q0 =
        n % 3 === 0 ? new Float64Array(arm.joints.length) : anywhere(arm, random).map(angle => angle * (n % 3));
      const wanted = pose<"base", "flange">(
        [4 * (random() - 0.5), 4 * (random() - 0.5), 4 * (random() - 0.5)],
        fromAxisAngle(unit([random() - 0.5, random() - 0.5, 0.1]), n % 5 === 0 ? Math.PI : 6 * random()),
      );
      const reach = solveDamped(arm, wanted, q0, {}, scratch);
      if (reach.kind === "not-a-pose") throw new Error(reach.because);
      expect(inside(arm, reach.q_rad)).toBe(true);
      expect(Number.isFinite(reach.position_m + reach.angle_rad)).toBe(true);
      expect(explainNumeric(reach)).toMatch(/^[A-Z].*\d.*\.$/);
    }
  });
});

test("agrees with the closed form: what one reaches the other does, and the posture is one of its solutions", () => {
  const random = seededRandom(44);
  const scratch = dampedScratch(6);
  for (let n = 0; n < 100; n++) {
    const wanted = flangePose(rx90.arm, anywhere(rx90.arm, random));
    const closed = solveAll(rx90, wanted);
    const reach = solveDamped(
      rx90.arm,
      wanted,
      rx90.home_rad.map(angle => angle + 0.1),
      { restarts: { most: 60, random } },
      scratch,
    );
    if (closed.kind !== "reached" || reach.kind === "not-a-pose")
      throw new Error("The target comes from a posture inside the limits.");
    if (closed.singular || reach.kind !== "converged") continue;
    expect(
      Math.min(
        ...closed.solutions.map(({ q_rad }) => Math.max(...q_rad.map((angle, j) => Math.abs(angle - reach.q_rad[j]!)))),
      ),
    ).toBeLessThan(1e-6);
  }
});

describe("a stall says what is in the way", () => {
  test("too far: by how much", () => {
    const reach = solveDamped(
      rx90.arm,
      pose([1.5, 0, 0.42], fromAxisAngle([0, 1, 0], Math.PI / 2)),
      rx90.home_rad.map(angle => angle + 0.2),
    );
    if (reach.kind !== "stalled" || reach.because.kind !== "too-far") throw new Error(explainNumeric(reach));
    expect(reach.because.short_m).toBeCloseTo(1.5 - 1.185, 4);
    expect(explainNumeric(reach)).toBe(
      "The flange stays 315 mm away, whatever its orientation; the arm is not long enough.",
    );
  });
  test("a limit: which joint's", () => {
    const q = Float64Array.from(rx90.home_rad);
    const lower: SerialArm = {
      ...rx90.arm,
      joints: rx90.arm.joints.map((joint, j) =>
        j === 4 ? { ...joint, limits: { ...joint.limits, lower_rad: -0.3, upper_rad: 0.3 } } : joint,
      ),
    };
    q.set([0.2, -1.2, 1.9, 0, 0.8, 0]);
    const reach = solveDamped(lower, flangePose(rx90.arm, q), [0.2, -1.2, 1.9, 0, 0.25, 0]);
    expect(reach).toMatchObject({ kind: "stalled", because: { kind: "limit", joint: 5, limit_rad: 0.3 } });
    expect(explainNumeric(reach)).toMatch(/^Joint 5 stands at its limit of 17\.2°; .* are left\.$/);
  });
  test("out of steps, and numbers that are none", () => {
    expect(solveDamped(odd, pose([0.2, 0.3, 0.4]), new Float64Array(7), { steps: 2 })).toMatchObject({
      kind: "stalled",
      because: { kind: "out-of-steps", steps: 2 },
    });
    expect(solveDamped(odd, pose([NaN, 0, 0]), new Float64Array(7))).toEqual({
      kind: "not-a-pose",
      because: "A coordinate of the pose is not a finite number.",
    });
    expect(solveDamped(odd, pose(), [0, 0, 0, Infinity, 0, 0, 0])).toEqual({
      kind: "not-a-pose",
      because: "The start angle of joint 4 is not a finite number.",
    });
    expect(() => solveDamped(odd, pose(), [0, 0])).toThrow("seven odd axes has 7 joints but 2 angles were given.");
  });
});

test("no flange is farther from joint 2 than the length of the arm", () => {
  const random = seededRandom(45);
  for (const arm of [rx90.arm, odd]) {
    for (let n = 0; n < 100; n++) {
      const q = anywhere(arm, random);
      const first = flangePose(
        {
          ...arm,
          joints: arm.joints.slice(0, 1),
          lastJointFromFlange: pose(arm.joints[1]!.parentFromJoint.position),
        },
        [q[0]!],
      );
      expect(distance(flangePose(arm, q).position, first.position)).toBeLessThanOrEqual(lengthOfArm(arm) + 1e-12);
    }
  }
});
