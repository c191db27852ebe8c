import { expect, test } from "vitest";
import { calibrateFinger, degrees, fingerBend } from "../index.ts";

test("G-08 M-28 the middle of a finger's range is 45°, its ends are 0 and 90°", () => {
  const finger = { flat: 400, bent: 3600 };
  expect(degrees(fingerBend(2000, finger))).toBeCloseTo(45, 12);
  expect(degrees(fingerBend(400, finger))).toBe(0);
  expect(degrees(fingerBend(3600, finger))).toBeCloseTo(90, 12);
});
test("M-26 readings beyond the calibrated range bend no finger further", () => {
  const finger = { flat: 400, bent: 3600 };
  expect(fingerBend(0, finger)).toBe(0);
  expect(degrees(fingerBend(4095, finger))).toBeCloseTo(90, 12);
});
test("M-27 the range comes from the flat and the bent hand; readings that no 12-bit sensor gives do not count", () => {
  expect(calibrateFinger([800, 790, 2100, 3310, 3305, -5, 70000, NaN, 12.5])).toEqual({
    kind: "calibrated",
    finger: { flat: 790, bent: 3310 },
  });
  expect(calibrateFinger([800, 810])).toEqual({
    kind: "too-small",
    sentence: "The finger moved through 10 counts; 64 are needed. Open and close the hand fully.",
  });
  expect(calibrateFinger([])).toMatchObject({ kind: "too-small", sentence: expect.stringContaining("0 counts") });
});
