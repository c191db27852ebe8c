import fc from "fast-check";
import { expect, test } from "vitest";
import { createClockMap } from "./clock.ts";

test("X-40 before the first round trip nothing is known, and time that runs backwards tells nothing", () => {
  const map = createClockMap();
  expect([map.offset_s, map.uncertain_s]).toEqual([NaN, Infinity]);
  map.heard(2, 100, 1);
  map.heard(1, NaN, 2);
  expect(map.offset_s).toBeNaN();
});

test("X-40 the offset is off by no more than is said, however uneven the two ways are", () => {
  const ms = fc.double({ min: 0.0001, max: 0.4, noNaN: true });
  fc.assert(
    fc.property(
      fc.double({ min: -1e6, max: 1e6, noNaN: true }),
      fc.array(fc.tuple(ms, ms), { minLength: 1, maxLength: 40 }),
      (truth_s, trips) => {
        const map = createClockMap();
        trips.forEach(([out_s, back_s], i) => {
          map.heard(i, i + out_s + truth_s, i + out_s + back_s);
        });
        expect(Math.abs(map.offset_s - truth_s)).toBeLessThanOrEqual(map.uncertain_s + 1e-9);
        expect(map.uncertain_s).toBeLessThanOrEqual(Math.min(...trips.slice(-16).map(([a, b]) => a + b)) / 2 + 1e-9);
      },
    ),
    { seed: 40 },
  );
});

test("X-40 a clock that drifts is followed: only the last 16 round trips count", () => {
  const map = createClockMap();
  for (let i = 0; i < 1000; i++) map.heard(i, i + 0.005 + i * 1e-4, i + 0.01);
  expect(map.offset_s).toBeCloseTo(999 * 1e-4, 2);
});
