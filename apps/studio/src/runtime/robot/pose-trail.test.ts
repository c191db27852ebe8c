import fc from "fast-check";
import { expect, test } from "vitest";
import { poseTrail } from "./pose-trail.ts";

test("X-40 a moment between two samples is on their line; after the last it is the last; before the first there is none", () => {
  const trail = poseTrail(2, 8);
  const out = new Float64Array(2);
  expect(trail.at(1, out)).toBe(false);
  trail.record(1, [0, 10]);
  trail.record(2, [1, 20]);
  expect(trail.at(0.99, out)).toBe(false);
  expect([trail.at(1.25, out), ...out]).toEqual([true, 0.25, 12.5]);
  expect([trail.at(9, out), ...out]).toEqual([true, 1, 20]);
});

test("X-40 whatever was recorded within its length is found again, when it has gone round many times too", () => {
  fc.assert(
    fc.property(
      fc.array(fc.double({ min: 0.001, max: 0.1, noNaN: true }), { minLength: 1, maxLength: 200 }),
      fc.double({ min: 0, max: 1, noNaN: true }),
      (steps_s, part) => {
        const trail = poseTrail(1, 32);
        const out = new Float64Array(1);
        let at_s = 5;
        const times = steps_s.map(step_s => (at_s += step_s));
        // The angle is the time itself: then any moment between must be itself as well.
        for (const time_s of times) trail.record(time_s, [time_s]);
        const kept = times.slice(-32);
        const wanted_s = kept[0]! + part * (kept.at(-1)! - kept[0]!);
        expect(trail.at(wanted_s, out)).toBe(true);
        expect(out[0]).toBeCloseTo(wanted_s, 9);
        if (times.length > 32) expect(trail.at(times.at(-33)!, out)).toBe(false);
      },
    ),
    { seed: 40 },
  );
});

test("X-40 a clock that jumped back begins anew", () => {
  const trail = poseTrail(1);
  const out = new Float64Array(1);
  trail.record(100, [1]);
  trail.record(1, [2]);
  expect([trail.at(50, out), ...out]).toEqual([true, 2]);
  expect(trail.at(0.5, out)).toBe(false);
});
