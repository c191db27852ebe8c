import { expect, test } from "vitest";
import { accelerationOf, fitAccelerometer, integrateTracker, seededRandom, type Vector3 } from "../../index.ts";

const G = 9.80665;
const line = { slope_mps2_per_V: 9.6, intercept_mps2: -24.1 };
const voltage = (a: number): number => (a - line.intercept_mps2) / line.slope_mps2_per_V;

test("M-30 acceleration is slope · V + intercept: the line through noisy readings at +g, 0 and −g is found again", () => {
  const random = seededRandom(30);
  const readings = [G, 0, -G].flatMap(acceleration_mps2 =>
    Array.from({ length: 50 }, () => ({
      acceleration_mps2,
      voltage_V: voltage(acceleration_mps2) + 0.004 * (random() - 0.5),
    })),
  );
  const answer = fitAccelerometer([
    ...readings,
    { voltage_V: 7, acceleration_mps2: 0 },
    { voltage_V: NaN, acceleration_mps2: 1 },
  ]);
  if (answer.kind !== "fitted") throw new Error(answer.sentence);
  expect(answer.line.slope_mps2_per_V).toBeCloseTo(9.6, 2);
  expect(answer.line.intercept_mps2).toBeCloseTo(-24.1, 1);
  expect(answer.rms_mps2).toBeLessThan(0.02);
  expect(accelerationOf(2.5, line)).toBeCloseTo(-0.1, 12);
  expect(fitAccelerometer([{ voltage_V: 2, acceleration_mps2: 0 }])).toMatchObject({
    kind: "too-few",
    sentence: "The readings span 0.000 V; two accelerations at least 0.05 V apart are needed.",
  });
});

/** 100 samples a second. */
const times = (seconds: number): number[] => Array.from({ length: Math.round(seconds * 100) + 1 }, (_, i) => i / 100);
const never = { cutOff_mps2: 0, standingAfter_s: Infinity };

test("M-31 M-32 a constant acceleration gives v = u + a t and s = u t + ½ a t²", () => {
  const t_s = times(2);
  const { position_m, velocity_mps } = integrateTracker(
    t_s,
    t_s.map((): Vector3 => [0.5, -0.2, 1]),
    never,
  );
  expect(velocity_mps.at(-1)!.map(v => Number(v.toFixed(9)))).toEqual([1, -0.4, 2]);
  expect(position_m.at(-1)!.map(s => Number(s.toFixed(9)))).toEqual([1, -0.4, 2]);
});

test("M-33 fluctuations below the cut-off line are no motion: 60 s at rest drift by nothing, without the line they do", () => {
  const random = seededRandom(33);
  const t_s = times(60);
  const noise = t_s.map(
    (): Vector3 => [0.28 * (random() - 0.5), 0.28 * (random() - 0.5), 0.05 + 0.1 * (random() - 0.5)],
  );
  expect(integrateTracker(t_s, noise).position_m.at(-1)).toEqual([0, 0, 0]);
  const drifts = integrateTracker(t_s, noise, never).position_m.at(-1)!;
  expect(Math.hypot(...drifts)).toBeGreaterThan(10);
});

test("M-33 a move with 1 % slope error leaves a velocity; after it the position stands for 10 s, with the cut-off line alone it drifts 50 mm", () => {
  const t_s = times(11.5);
  // Half a second of +1 m/s², half of −1 m/s² read 1 % too small.
  const a = t_s.map((t): Vector3 => [t < 0.5 ? 1 : t < 1 ? -0.99 : 0, 0, 0]);
  const standing = integrateTracker(t_s, a, { cutOff_mps2: 0.15, standingAfter_s: 0.2 });
  const at = (way: typeof standing, s: number): number => way.position_m[Math.round(s * 100)]![0];
  expect(at(standing, 11.5) - at(standing, 1.5)).toBe(0);
  expect(standing.velocity_mps.at(-1)).toEqual([0, 0, 0]);
  const drifting = integrateTracker(t_s, a, { cutOff_mps2: 0.15, standingAfter_s: Infinity });
  expect(at(drifting, 11.5) - at(drifting, 1.5)).toBeCloseTo(0.05, 3);
});
