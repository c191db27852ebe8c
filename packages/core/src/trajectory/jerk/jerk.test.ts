import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import { seededRandom } from "../../random.ts";
import { canBeLeft, canBeReached, JerkMotion, JerkPlanner, type JerkLimits, type JerkState } from "./index.ts";

interface Golden {
  readonly cases: readonly {
    readonly kind: string;
    readonly speed: number[];
    readonly acceleration: number[];
    readonly jerk: number[];
    readonly from: readonly [number[], number[], number[]];
    readonly to: readonly [number[], number[], number[]];
    readonly duration_s: number;
  }[];
}
const golden = JSON.parse(
  readFileSync(new URL("../../../../../fixtures/motion/jerk.json", import.meta.url), "utf8"),
) as Golden;

/** A state, or one that is sure to keep the limits when it is left, or when it is met. */
function randomState(
  limits: readonly JerkLimits[],
  random: () => number,
  fits: typeof canBeLeft,
): JerkState & { readonly speed: number[]; readonly acceleration: number[] } {
  const place: number[] = [];
  const speed: number[] = [];
  const acceleration: number[] = [];
  for (const { speed: v, acceleration: a, jerk: j } of limits) {
    place.push(random() * 6 - 3);
    let s = 0;
    let b = 0;
    do {
      s = (random() * 2 - 1) * v;
      b = random() < 0.3 ? 0 : (random() * 2 - 1) * a;
    } while (!fits(s, b, v, a, j));
    speed.push(s);
    acceleration.push(b);
  }
  return { place, speed, acceleration };
}
const randomLimits = (axes: number, random: () => number): JerkLimits[] =>
  Array.from({ length: axes }, () => ({
    speed: 0.2 + random() * 5,
    acceleration: 0.5 + random() * 20,
    jerk: 5 + random() * 200,
  }));

function planned(limits: readonly JerkLimits[], from: JerkState, to: JerkState): JerkMotion {
  const motion = new JerkMotion(limits.length);
  const answer = new JerkPlanner(limits).plan(from, to, motion);
  expect(answer).toEqual({ kind: "planned" });
  return motion;
}

describe("jerk-limited motions", () => {
  test("take as long as Ruckig's, whatever the states", () => {
    expect(golden.cases.length).toBeGreaterThan(400);
    for (const { speed, acceleration, jerk, from, to, duration_s } of golden.cases) {
      const limits = speed.map((v, i) => ({ speed: v, acceleration: acceleration[i]!, jerk: jerk[i]! }));
      const motion = planned(
        limits,
        { place: from[0], speed: from[1], acceleration: from[2] },
        { place: to[0], speed: to[1], acceleration: to[2] },
      );
      expect(Math.abs(motion.duration_s / duration_s - 1)).toBeLessThan(1e-9);
    }
  });

  test("keep speed, acceleration and jerk at every sampled instant, start and end where they should, and never leap", () => {
    const random = seededRandom(41);
    const axes = 2;
    const q = new Float64Array(axes);
    const v = new Float64Array(axes);
    const a = new Float64Array(axes);
    const q0 = new Float64Array(axes);
    const v0 = new Float64Array(axes);
    const a0 = new Float64Array(axes);
    for (let k = 0; k < 1500; k++) {
      const limits = randomLimits(axes, random);
      const from = randomState(limits, random, canBeLeft);
      const to = randomState(limits, random, canBeReached);
      const motion = planned(limits, from, to);
      const T = motion.duration_s;
      const looks = 100;
      const h = T / looks;
      motion.sample(0, q0, v0, a0);
      for (let i = 0; i < axes; i++) {
        expect(
          Math.abs(q0[i]! - from.place[i]!) +
            Math.abs(v0[i]! - from.speed[i]!) +
            Math.abs(a0[i]! - from.acceleration[i]!),
        ).toBeLessThan(1e-9);
      }
      let over = 0;
      let leap = 0;
      for (let n = 1; n <= looks; n++) {
        motion.sample(n === looks ? T * (1 - 1e-15) : h * n, q, v, a);
        for (let i = 0; i < axes; i++) {
          const { speed, acceleration, jerk } = limits[i]!;
          over = Math.max(
            over,
            Math.abs(v[i]!) / speed - 1,
            Math.abs(a[i]!) / acceleration - 1,
            Math.abs(a[i]! - a0[i]!) / (h * jerk) - 1,
          );
          leap = Math.max(leap, Math.abs(q[i]! - q0[i]! - ((v[i]! + v0[i]!) / 2) * h) / (jerk * h * h * h));
        }
        q0.set(q);
        v0.set(v);
        a0.set(a);
      }
      expect(over).toBeLessThan(1e-9);
      // The trapezium rule is off by a twelfth of jerk · h³, and by an eighth where the jerk changes within h.
      expect(leap).toBeLessThan(0.13);
      for (let i = 0; i < axes; i++)
        expect(
          Math.abs(q[i]! - to.place[i]!) + Math.abs(v[i]! - to.speed[i]!) + Math.abs(a[i]! - to.acceleration[i]!),
        ).toBeLessThan(1e-7);
    }
  });

  test("no axis arrives earlier than it could alone, and one that has time left is slower, not late", () => {
    const random = seededRandom(42);
    for (let k = 0; k < 300; k++) {
      const limits = randomLimits(3, random);
      const from = randomState(limits, random, canBeLeft);
      const to = randomState(limits, random, canBeReached);
      const together = planned(limits, from, to).duration_s;
      const alone = limits.map(
        (limit, i) =>
          planned(
            [limit],
            { place: [from.place[i]!], speed: [from.speed[i]!], acceleration: [from.acceleration[i]!] },
            { place: [to.place[i]!], speed: [to.speed[i]!], acceleration: [to.acceleration[i]!] },
          ).duration_s,
      );
      expect(together).toBeGreaterThanOrEqual(Math.max(...alone) * (1 - 1e-12));
    }
  });

  test("from rest to rest all axes run along one line where the slowest one leaves the others room", () => {
    const limits = [
      { speed: 1, acceleration: 4, jerk: 40 },
      { speed: 2, acceleration: 8, jerk: 80 },
    ];
    const motion = planned(limits, { place: [0, 1] }, { place: [2, -1] });
    expect(motion.synchronised).toBe("phase");
    const q = new Float64Array(2);
    for (let k = 0; k <= 50; k++) {
      motion.sample((motion.duration_s * k) / 50, q);
      expect(q[0]! + q[1]!).toBeCloseTo(1, 12);
    }
    // 2 rad at 1 rad/s, ramps of 0.25 s, rounded over 0.1 s.
    expect(motion.duration_s).toBeCloseTo(2 + 0.25 + 0.1, 12);
  });

  test("where one line would take longer than the slowest axis, they only arrive together", () => {
    const limits = [
      { speed: 1, acceleration: 4, jerk: 40 },
      { speed: 2, acceleration: 0.5, jerk: 80 },
    ];
    const motion = planned(limits, { place: [0, 0] }, { place: [2, 0.3] });
    expect(motion.synchronised).toBe("time");
    expect(motion.duration_s).toBeCloseTo(2.35, 12);
  });

  test("an axis that would have to come back makes the others wait for it", () => {
    // At speed 1 the axis passes 0.3 after 0.3 s at speed 1; any later it must brake, go back and come again.
    const limits = [
      { speed: 1, acceleration: 2, jerk: 20 },
      { speed: 1, acceleration: 2, jerk: 20 },
    ];
    const first = { place: [0], speed: [1] };
    const last = { place: [0.3], speed: [1] };
    expect(planned([limits[0]!], first, last).duration_s).toBeCloseTo(0.3, 9);
    const motion = planned(limits, { place: [0, 0], speed: [1, 0] }, { place: [0.3, 0.5], speed: [1, 0] });
    const slow = planned([limits[1]!], { place: [0] }, { place: [0.5] }).duration_s;
    expect(slow).toBeLessThan(1.3);
    expect(motion.duration_s).toBeGreaterThan(1.8);
  });

  test("says which axis has an end that cannot be met, and which has no number", () => {
    const limits = [
      { speed: 1, acceleration: 2, jerk: 20 },
      { speed: 1, acceleration: 2, jerk: 20 },
    ];
    const motion = new JerkMotion(2);
    const planner = new JerkPlanner(limits);
    expect(planner.plan({ place: [0, 0] }, { place: [1, 1], speed: [0, 1.5] }, motion)).toEqual({
      kind: "end-outside",
      axis: 2,
    });
    expect(planner.plan({ place: [0, 0] }, { place: [1, 1], speed: [0, 1], acceleration: [0, -2] }, motion)).toEqual({
      kind: "end-outside",
      axis: 2,
    });
    expect(planner.plan({ place: [Number.NaN, 0] }, { place: [1, 1] }, motion)).toEqual({
      kind: "not-a-number",
      axis: 1,
    });
  });

  test("to where it already is takes no time", () => {
    const motion = planned([{ speed: 1, acceleration: 2, jerk: 20 }], { place: [0.4] }, { place: [0.4] });
    const q = new Float64Array(1);
    expect(motion.duration_s).toBe(0);
    motion.sample(0, q);
    expect(q[0]).toBe(0.4);
  });
});
