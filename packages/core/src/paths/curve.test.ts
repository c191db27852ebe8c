import { expect, test } from "vitest";
import { distanceToPolyline, lerp, pathDeviation, seededRandom, type Vector3 } from "../index.ts";

test("the deviation of points from a polyline is the largest of their distances to every segment, for 300 seeded ways", () => {
  const random = seededRandom(81);
  const somewhere = (size: number): Vector3 => [
    size * (random() - 0.5),
    size * (random() - 0.5),
    size * (random() - 0.5),
  ];
  for (let n = 0; n < 300; n++) {
    const way: Vector3[] = [somewhere(1)];
    const length = 1 + Math.floor(random() * 200);
    while (way.length < length) {
      const step = somewhere(0.1);
      way.push(way.at(-1)!.map((value, k) => value + step[k]!) as Vector3);
    }
    const points = Array.from({ length: 50 }, () =>
      lerp(way[Math.floor(random() * way.length)]!, somewhere(1), random() * 0.3),
    );
    const distances = points.map(point => distanceToPolyline(way, point));
    const { max_m, rms_m, at } = pathDeviation(way, points);
    expect(max_m).toBeCloseTo(Math.max(...distances), 15);
    expect(distances[at]).toBe(Math.max(...distances));
    expect(rms_m).toBeCloseTo(Math.hypot(...distances) / Math.sqrt(points.length), 15);
  }
});

test("9,996 points along a way of 3,000 segments are held against it in under a second", () => {
  const way = Array.from({ length: 3000 }, (_, i): Vector3 => [i * 0.001, Math.sin(i / 50) * 0.1, 0]);
  const points = Array.from({ length: 9_996 }, (_, i): Vector3 => [i * 0.0003, Math.sin((i * 0.3) / 50) * 0.1, 0.002]);
  const began_ms = performance.now();
  const { max_m } = pathDeviation(way, points);
  expect(performance.now() - began_ms).toBeLessThan(1000);
  expect(max_m).toBeCloseTo(0.002, 5);
});
