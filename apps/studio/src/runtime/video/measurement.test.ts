import { expect, test } from "vitest";
import { createMeasurement, figuresOf } from "./measurement.ts";

test("X-40 the first picture that shows a code says how long it took; the same code again says nothing new", () => {
  const measurement = createMeasurement(0.5);
  const first = measurement.codeAt(10);
  expect(first).toEqual({ counter: 1, session: 128 });
  expect(measurement.codeAt(10.05)).toEqual(first);
  expect(measurement.seen([first], 10.12)).toBeCloseTo(0.12, 9);
  expect(measurement.seen([first], 10.15)).toBeNull();
  const second = measurement.codeAt(10.125);
  expect(second.counter).toBe(2);
  expect(measurement.seen([{ counter: 2, session: 127 }], 10.3), "another screen").toBeNull();
  expect(measurement.seen([{ counter: 3, session: 128 }], 10.3), "a code that was not drawn yet").toBeNull();
  expect(measurement.seen([second], 10.25)).toBeCloseTo(0.125, 9);
  expect(measurement.seen([first], 10.4), "an old picture after a newer one").toBeNull();
});

test("X-40 the counter goes round, and a code from long ago is not taken for a new one", () => {
  const measurement = createMeasurement(0);
  let t_s = 0;
  let code = measurement.codeAt(t_s);
  for (let i = 0; i < 70_000; i++) {
    t_s += 0.125;
    code = measurement.codeAt(t_s);
    if (i % 7 === 0) expect(measurement.seen([code], t_s + 0.0625)).toBe(0.0625);
  }
  expect(measurement.seen([{ counter: (code.counter + 65_536 - 1000) % 65_536, session: 0 }], t_s)).toBeNull();
  expect(measurement.figures).toEqual({ n: 10_000, median_s: 0.0625, p95_s: 0.0625, least_s: 0.0625, most_s: 0.0625 });
});

test("X-40 median, 95th percentile and spread of what was seen", () => {
  expect(figuresOf([])).toBeNull();
  expect(figuresOf(Array.from({ length: 100 }, (_, i) => (100 - i) / 1000))).toEqual({
    n: 100,
    median_s: 0.05,
    p95_s: 0.095,
    least_s: 0.001,
    most_s: 0.1,
  });
  expect(figuresOf([0.2])).toEqual({ n: 1, median_s: 0.2, p95_s: 0.2, least_s: 0.2, most_s: 0.2 });
});
