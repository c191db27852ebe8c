import { expect, test } from "vitest";
import {
  checkHand,
  flangePose,
  identity,
  inverseDynamics,
  robotById,
  seededRandom,
  torqueModel,
  type Demonstration,
  type Pose,
} from "../index.ts";

const robot = robotById("ur10e")!;
const START = [0.2, -1.2, 1.6, -1.9, -1.4, 0.3];
const RATE_HZ = 50;
/** Joint 1 swings: q = A sin(ω t), so that speed and torque are known at every moment. */
const SWING = { amplitude: 0.4, omega: 2 };
const swung = (t_s: number): number[] => START.with(0, START[0]! + SWING.amplitude * Math.sin(SWING.omega * t_s));
function shown(tremor_m = 0, count = 320): Demonstration {
  const random = seededRandom(36);
  const times_s = Array.from({ length: count }, (_, i) => i / RATE_HZ);
  return {
    times_s,
    closed: times_s.map(() => false),
    worldFromTcp: times_s.map(t => {
      const { position, quaternion } = flangePose(robot.arm, swung(t));
      return {
        position: position.map(value => value + tremor_m * (2 * random() - 1)) as [number, number, number],
        quaternion,
      };
    }),
  };
}
const check = (demonstration: Demonstration) => checkHand(demonstration, robot, identity(), identity(), START);

test("M-36 positions and orientations become joint angles: speed and torque of a known swing come out, within 3 %", () => {
  const { unreached, speed, torque } = check(shown());
  expect(unreached).toBe(0);
  const limit = robot.arm.joints[0]!.limits.speed_rad_s;
  expect(speed!.joint).toBe(1);
  expect(speed!.fraction / ((SWING.amplitude * SWING.omega) / limit)).toBeCloseTo(1, 1.5);
  // The witness: the largest torque share along the very same swing, from its formula.
  const known = torqueModel(robot);
  if (known.kind !== "known") throw new Error(known.sentence);
  let most = 0;
  for (let t = 0; t < 6.38; t += 0.005) {
    const sine = Math.sin(SWING.omega * t);
    const qd = [SWING.amplitude * SWING.omega * Math.cos(SWING.omega * t), 0, 0, 0, 0, 0];
    const qdd = [-SWING.amplitude * SWING.omega ** 2 * sine, 0, 0, 0, 0, 0];
    inverseDynamics(known.carrying(undefined), swung(t), qd, qdd).forEach((value, j) => {
      most = Math.max(most, Math.abs(value) / known.limits_Nm[j]!);
    });
  }
  expect(Math.abs(torque!.fraction / most - 1)).toBeLessThan(0.03);
});

test("a tremor of 1 mm is no motion: the fastest joint stays below twice what the hand did", () => {
  const steady = check(shown()).speed!.fraction;
  expect(check(shown(0.001)).speed!.fraction).toBeLessThan(2 * steady);
});

test("L-33 samples out of reach are counted, the first with its moment and why; without masses that is said", () => {
  const demonstration = shown();
  const far = demonstration.worldFromTcp.map((pose, i) =>
    i >= 100 && i < 140 ? { ...pose, position: [3, 0, 1] as [number, number, number] } : pose,
  );
  const { unreached, first } = check({ ...demonstration, worldFromTcp: far });
  expect(unreached).toBe(40);
  expect(first!.at_s).toBeCloseTo(2, 9);
  expect(first!.sentence).toMatch(/\.$/);
  const rx90l = robotById("staubli_rx90l")!;
  const still: Demonstration = {
    times_s: [0, 0.02, 0.04],
    closed: [false, false, false],
    worldFromTcp: [0, 1, 2].map(() => flangePose(rx90l.arm, rx90l.home_rad) as Pose as Pose<"world", "tcp">),
  };
  const answer = checkHand(still, rx90l, identity(), identity());
  expect(answer.torqueUnknown).toMatch(/are unknown: the masses/);
  expect(answer.torque).toBeNull();
  expect(
    checkHand(
      { ...still, times_s: [0], worldFromTcp: [still.worldFromTcp[0]!], closed: [false] },
      rx90l,
      identity(),
      identity(),
    ),
  ).toEqual({ unreached: 0, first: null, speed: null, torque: null, torqueUnknown: null });
});
