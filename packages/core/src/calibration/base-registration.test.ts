import { describe, expect, test } from "vitest";
import { seededRandom, type Random } from "../random.ts";
import {
  angleBetween,
  fromAxisAngle,
  multiply,
  normalizeQuaternion,
  rotate,
  type Quaternion,
} from "../spatial/quaternion.ts";
import { compose, pose, transformPoint } from "../spatial/pose.ts";
import { add, distance, norm, type Vector3 } from "../spatial/vector.ts";
import {
  type DrivenSample,
  HEADSET_NOISE,
  registerBase,
  registrationBound,
  type RegisteredBase,
  type Touch,
  watchDrift,
} from "./base-registration.ts";
import { fBound95, lengthBound95 } from "./confidence.ts";

const RUNS = 1000;
const gauss = (random: Random): number => Math.sqrt(-2 * Math.log(1 - random())) * Math.cos(2 * Math.PI * random());
const vector = (random: Random, size: number): Vector3 => [
  size * gauss(random),
  size * gauss(random),
  size * gauss(random),
];
const turnBy = ([x, y, z]: Vector3): Quaternion => {
  const angle = norm([x, y, z]);
  return angle < 1e-12 ? [0, 0, 0, 1] : fromAxisAngle([x / angle, y / angle, z / angle], angle);
};
/** Six points round a robot of 0.9 m reach: both sides, low and high. */
const POINTS: readonly Vector3[] = [
  [0.55, -0.35, 0.2],
  [0.55, 0.35, 0.2],
  [0.3, -0.5, 0.75],
  [0.3, 0.5, 0.75],
  [0.75, 0, 0.5],
  [-0.4, 0.3, 0.5],
];
const SECONDS_A_TOUCH = 1.5;

/** A headset whose world wanders at the full rate in one direction, for a robot that stands anywhere. */
function world(random: Random) {
  const worldFromBase = pose<"world", "base">(
    vector(random, 1),
    normalizeQuaternion([gauss(random), gauss(random), gauss(random), gauss(random)]),
  );
  const way = vector(random, 1);
  const drift = way.map(value => (value / norm(way)) * HEADSET_NOISE.drift_mps) as Vector3;
  const wandered = (at_s: number): Vector3 => drift.map(value => value * at_s) as Vector3;
  return { worldFromBase, wandered };
}
function touchOf(random: Random, real: ReturnType<typeof world>, base: Vector3, at_s: number): Touch {
  const tip = rotate(turnBy(vector(random, Math.PI)), [HEADSET_NOISE.tip_m, 0, 0]);
  const turned = rotate(turnBy(vector(random, HEADSET_NOISE.rotation_rad)), tip);
  const moved: Vector3 = [turned[0] - tip[0], turned[1] - tip[1], turned[2] - tip[2]];
  const exact = add(transformPoint(real.worldFromBase, base), real.wandered(at_s));
  return { base, world: add(add(exact, moved), vector(random, HEADSET_NOISE.position_m)), at_s };
}
/** The robot carries a controller round for 8 s; its place on the tool is nobody's knowledge. */
function drive(random: Random, real: ReturnType<typeof world>, count: number): DrivenSample[] {
  const toolFromDevice = pose<"tool", "device">([0.03, -0.02, 0.08], turnBy([0.4, 1, -0.3]));
  return Array.from({ length: count }, (_, i) => {
    const t = (2 * Math.PI * i) / count;
    const baseFromTool = pose<"base", "tool">(
      [0.5 + 0.25 * Math.cos(t), 0.4 * Math.sin(t), 0.5 + 0.25 * Math.sin(2 * t)],
      multiply(turnBy([0.8 * Math.sin(t), 0.8 * Math.cos(t), 0.6 * Math.sin(2 * t)]), turnBy([0, Math.PI, 0])),
    );
    const at_s = (8 * i) / count;
    const exact = compose(compose(real.worldFromBase, baseFromTool), toolFromDevice);
    return {
      baseFromTool,
      worldFromDevice: pose<"world", "device">(
        add(add(exact.position, real.wandered(at_s)), vector(random, HEADSET_NOISE.position_m)),
        multiply(turnBy(vector(random, HEADSET_NOISE.rotation_rad)), exact.quaternion),
      ),
      at_s,
    };
  });
}
function registered(touches: readonly Touch[], driven: readonly DrivenSample[]): RegisteredBase {
  const answer = registerBase(touches, driven);
  if (answer.kind !== "registered") throw new Error(answer.sentence);
  return answer;
}
/** Root mean square error at the base's origin when the last sample was taken, and how often it is under the bound. */
function judged(seed: number, measure: (random: Random, real: ReturnType<typeof world>) => RegisteredBase) {
  const random = seededRandom(seed);
  let squares = 0;
  let under = 0;
  let seconds = 0;
  for (let run = 0; run < RUNS; run++) {
    const real = world(random);
    const answer = measure(random, real);
    const truth = add(real.worldFromBase.position, real.wandered(answer.at_s));
    const off_m = distance(answer.worldFromBase.position, truth);
    squares += off_m * off_m;
    if (off_m <= answer.bound_m) under++;
    seconds = Math.max(seconds, answer.at_s);
  }
  return { rms_m: Math.sqrt(squares / RUNS), share: under / RUNS, seconds };
}

describe("T-64 the base of a real robot, with a headset's noise of 3 mm, 0.5° and 2 mm a minute, 1,000 seeded runs", () => {
  test.each([
    ["six points touched", 6, 0, 0.005],
    ["the robot driven round", 0, 40, 0.005],
    ["three points touched and the robot driven round", 3, 40, 0.005],
  ] as const)(
    "%s: 5 mm root mean square in 10 s, and 930 to 970 runs lie under the bound",
    (_, touched, driven, aim_m) => {
      const { rms_m, share, seconds } = judged(64, (random, real) =>
        registered(
          POINTS.slice(0, touched).map((base, i) => touchOf(random, real, base, i * SECONDS_A_TOUCH)),
          driven > 0 ? drive(random, real, driven) : [],
        ),
      );
      expect(rms_m).toBeLessThanOrEqual(aim_m);
      expect(share).toBeGreaterThanOrEqual(0.93);
      expect(share).toBeLessThanOrEqual(0.97);
      expect(seconds).toBeLessThanOrEqual(10);
    },
    120_000,
  );
  test("three, four or five points are less exact, and the bound says so: 93 to 97 % lie under it", () => {
    let last_m = Infinity;
    for (const touched of [3, 4, 5]) {
      const { rms_m, share } = judged(7 + touched, (random, real) =>
        registered(
          POINTS.slice(0, touched).map((base, i) => touchOf(random, real, base, i)),
          [],
        ),
      );
      expect(share).toBeGreaterThanOrEqual(0.93);
      expect(share).toBeLessThanOrEqual(0.97);
      expect(rms_m).toBeLessThan(last_m);
      last_m = rms_m;
    }
  });
});

describe("what a registration says of itself", () => {
  const random = seededRandom(1);
  const real = world(random);
  const touches = POINTS.map((base, i) => touchOf(random, real, base, i));

  test("without noise the pose is found to 1e-9, by touch and by driving", () => {
    const worldFromBase = pose<"world", "base">([1, 2, 0.5], turnBy([0.3, -0.2, 2]));
    const exact = POINTS.map(base => ({ base, world: transformPoint(worldFromBase, base), at_s: 0 }));
    const quiet = { worldFromBase, wandered: (): Vector3 => [0, 0, 0] };
    const carried = drive(() => 0.25, quiet, 12).map(({ baseFromTool, at_s }) => ({
      baseFromTool,
      worldFromDevice: compose(
        compose(worldFromBase, baseFromTool),
        pose<"tool", "device">([0.1, 0, 0.2], turnBy([1, 0, 0])),
      ),
      at_s,
    }));
    for (const answer of [registered(exact, []), registered([], carried)]) {
      expect(distance(answer.worldFromBase.position, worldFromBase.position)).toBeLessThan(1e-9);
      expect(angleBetween(answer.worldFromBase.quaternion, worldFromBase.quaternion)).toBeLessThan(1e-7);
    }
  });
  test("the bound grows with the distance from the base and with time: 2 mm a minute", () => {
    const answer = registered(touches, []);
    const near = registrationBound(answer, [0.4, 0, 0.4], answer.at_s);
    expect(registrationBound(answer, [2, 0, 0.4], answer.at_s)).toBeGreaterThan(near);
    const later = registrationBound(answer, [0.4, 0, 0.4], answer.at_s + 60);
    expect(later - near).toBeCloseTo(0.002, 9);
  });
  test("a point touched again holds, and 30 mm aside it says that the registration has drifted", () => {
    const answer = registered(touches, []);
    const again = touchOf(random, real, POINTS[1]!, 8);
    expect(watchDrift(answer, again).kind).toBe("holds");
    const aside = watchDrift(answer, { ...again, world: add(again.world, [0.03, 0, 0]) });
    expect(aside.kind).toBe("drifted");
    expect(aside.sentence).toMatch(/has drifted: \d+\.\d mm off, \d+\.\d mm allowed/);
  });
  test("says what is wrong: too few, in one line, no number, points that disagree, a tool that was not turned", () => {
    expect(registerBase(touches.slice(0, 2), []).kind).toBe("too-few");
    const line = [0.1, 0.4, 0.7].map((x): Touch => ({ base: [x, 0, 0.3], world: [x, 1, 0.3], at_s: 0 }));
    expect(registerBase(line, []).kind).toBe("in-line");
    expect(registerBase([...touches, { base: [Number.NaN, 0, 0], world: [0, 0, 0], at_s: 0 }], []).kind).toBe(
      "not-a-point",
    );
    const swapped = touches.map((touch, i) => (i === 0 ? { ...touch, world: touches[3]!.world } : touch));
    expect(registerBase(swapped, []).kind).toBe("disagree");
    const still = drive(random, real, 8).map(sample => ({
      ...sample,
      baseFromTool: pose<"base", "tool">(sample.baseFromTool.position, [0, 0, 0, 1]),
    }));
    expect(registerBase([], still)).toMatchObject({ kind: "in-line" });
  });
  test("the quantiles agree with the tables to 2.5 %", () => {
    for (const [over, under, value] of [
      [1, 30, 4.171],
      [3, 20, 3.098],
      [2, 60, 3.15],
      [3, Infinity, 2.605],
    ] as const)
      expect(Math.abs(fBound95(over, under) / value - 1)).toBeLessThan(0.025);
    expect(lengthBound95([1, 1, 1], Infinity)).toBeCloseTo(2.795, 1);
  });
});
