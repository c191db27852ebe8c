import { describe, expect, test } from "vitest";
import {
  averagedBeziers,
  distance,
  filterDemonstration,
  FILTER_DEFAULTS,
  fittedBeziers,
  pathDeviation,
  pointsOnBeziers,
  pose,
  sampleRate_Hz,
  seededRandom,
  type Demonstration,
  type Quaternion,
  type Vector3,
} from "../../index.ts";

const DOWN: Quaternion = [1, 0, 0, 0];
/** A hand that is where `at` says, `rate` times a second. */
const shown = (
  seconds: number,
  at: (t: number) => Vector3,
  rate = 50,
  closed: (t: number) => boolean = () => false,
): Demonstration => {
  const times_s = Array.from({ length: Math.round(seconds * rate) + 1 }, (_, i) => i / rate);
  return {
    times_s,
    worldFromTcp: times_s.map(t => pose(at(t), DOWN)),
    closed: times_s.map(closed),
  };
};
const noisy = (seed: number, size_m: number): (() => number) => {
  const random = seededRandom(seed);
  return () => size_m * (2 * random() - 1);
};
const positions = ({ worldFromTcp }: Demonstration): Vector3[] => worldFromTcp.map(({ position }) => position);

test("M-34 M-55 50 and 100 samples a second are both read", () => {
  expect(sampleRate_Hz(shown(2, t => [t, 0, 0]))).toBeCloseTo(50, 9);
  expect(sampleRate_Hz(shown(2, t => [t, 0, 0], 100))).toBeCloseTo(100, 9);
});

test("M-38 M-41 samples of a hand that stands become their mean, tremor and all", () => {
  const tremor = noisy(38, 0.001);
  const demonstration = shown(2, () => [0.5 + tremor(), tremor(), 0.3 + tremor()]);
  const { parts, points } = filterDemonstration(demonstration);
  expect([parts.length, points, parts[0]!.kind]).toEqual([1, 1, "stop"]);
  const [stop] = parts;
  if (stop?.kind !== "stop") throw new Error("no stop");
  for (const k of [0, 1, 2]) {
    const mean = positions(demonstration).reduce((sum, point) => sum + point[k]!, 0) / 101;
    expect(stop.pose.position[k]).toBeCloseTo(mean, 12);
  }
});

test("M-39 of a straight path of 100 samples its start and end are kept, and no sample is further from it than allowed", () => {
  const tremor = noisy(39, 0.0008);
  const line = shown(2, t => [0.4 + 0.15 * t, -0.1 + 0.1 * t + tremor(), 0.3 + tremor()]);
  const { parts, points, deviation } = filterDemonstration(line);
  expect(parts.map(({ kind }) => kind)).toEqual(["straight"]);
  expect([line.times_s.length, points]).toEqual([101, 2]);
  expect(deviation.max_m).toBeLessThanOrEqual(FILTER_DEFAULTS.straight_m);
});

describe("M-40 curves", () => {
  const arc = (t: number): Vector3 => [0.5 + 0.1 * Math.cos(t), 0.1 * Math.sin(t), 0.3];
  const samples = positions(shown(1.5, arc, 60));

  test("every 5 to 10 samples are one control point, and four control points one Bézier curve", () => {
    const curves = averagedBeziers(samples);
    const inner = samples.length - 2;
    expect(inner / (3 * curves.length - 1)).toBeGreaterThanOrEqual(5);
    expect(inner / (3 * curves.length - 1)).toBeLessThanOrEqual(10);
    for (const curve of curves) expect(curve).toHaveLength(4);
    expect(curves[0]![0]).toEqual(samples[0]);
    expect(curves.at(-1)![3]).toEqual(samples.at(-1));
    curves.slice(1).forEach((curve, i) => {
      expect(curve[0]).toEqual(curves[i]![3]);
    });
    // The first inner control point is the mean of its own samples.
    const count = Math.floor(inner / (3 * curves.length - 1));
    const group = samples.slice(1, 1 + count);
    for (const k of [0, 1, 2])
      expect(curves[0]![1][k]).toBeCloseTo(group.reduce((sum, point) => sum + point[k]!, 0) / count, 12);
  });

  test("the error of both fits over the arc: averages within 4 mm, least squares within 0.1 mm", () => {
    const off_mm = (curves: ReturnType<typeof averagedBeziers>): number =>
      1000 * pathDeviation(pointsOnBeziers(curves, 64), samples).max_m;
    expect(off_mm(averagedBeziers(samples))).toBeLessThan(4);
    expect(off_mm(fittedBeziers(samples, 1e-4))).toBeLessThan(0.1);
    expect(off_mm(averagedBeziers(samples))).toBeGreaterThan(5 * off_mm(fittedBeziers(samples, 1e-4)));
  });
});

test("M-37 M-47 stop, straight, curve, straight, grip: each is recognised, and the deviation is that of the overlay", () => {
  const tremor = noisy(47, 0.0006);
  const corner = (t: number): Vector3 => {
    if (t < 1) return [0.4, 0, 0.3];
    if (t < 3) return [0.4 + 0.15 * (t - 1), 0, 0.3];
    const angle = ((t - 3) / 2) * (Math.PI / 2);
    if (t < 5) return [0.7 + 0.1 * Math.sin(angle), 0.1 - 0.1 * Math.cos(angle), 0.3];
    if (t < 7) return [0.8, 0.1 + 0.1 * (t - 5), 0.3];
    return [0.8, 0.3, 0.3];
  };
  const demonstration = shown(
    8,
    t => corner(t).map(v => v + tremor()) as Vector3,
    100,
    t => t >= 7.5,
  );
  const filtered = filterDemonstration(demonstration);
  expect(filtered.parts.map(({ kind }) => kind)).toEqual(["stop", "straight", "curve", "straight", "stop"]);
  expect(filtered.points).toBeLessThan(30);
  const end = filtered.parts.at(-1)!;
  expect([demonstration.closed[end.first], demonstration.closed[end.last]]).toEqual([false, true]);
  expect(filtered.deviation).toEqual(pathDeviation(filtered.polyline, positions(demonstration)));
  expect(filtered.deviation.max_m).toBeLessThan(0.004);
  expect(filtered.deviation.rms_m).toBeLessThan(0.0012);
  // Against what the hand meant to do, tremor aside.
  const meant = demonstration.times_s.map(corner);
  expect(pathDeviation(filtered.polyline, meant).max_m).toBeLessThan(0.004);
});

test("500 random ways of straights and rests: every sample stays within rest and straightness of the filtered way", () => {
  const random = seededRandom(500);
  for (let n = 0; n < 500; n++) {
    const corners = Array.from({ length: 2 + Math.floor(4 * random()) }, (): Vector3 => [random(), random(), random()]);
    const legs = corners.length - 1;
    const demonstration = shown(legs * 1.5, t => {
      const leg = Math.min(legs - 1, Math.floor(t / 1.5));
      const s = Math.min(1, (t - 1.5 * leg) / 1.1);
      return corners[leg]!.map((v, k) => v + s * (corners[leg + 1]![k]! - v)) as Vector3;
    });
    const { deviation, parts } = filterDemonstration(demonstration);
    expect(deviation.max_m).toBeLessThan(FILTER_DEFAULTS.straight_m + FILTER_DEFAULTS.rest_m);
    expect(parts[0]!.first).toBe(0);
    expect(parts.at(-1)!.last).toBe(demonstration.times_s.length - 1);
    expect(distance(parts.length > 0 ? corners[0]! : [9, 9, 9], demonstration.worldFromTcp[0]!.position)).toBe(0);
  }
});
