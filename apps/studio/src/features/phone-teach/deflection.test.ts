import { describe, expect, test } from "vitest";
import { deflection } from "./deflection.ts";

describe("a finger on the pad", () => {
  test("near the middle moves nothing", () => {
    expect(deflection(0.1, -0.05)).toEqual([0, 0]);
    expect(deflection(NaN, 0)).toEqual([0, 0]);
  });
  test("is all the way at the rim and beyond it, and half way between", () => {
    expect(deflection(0, 1)).toEqual([0, 1]);
    expect(deflection(0, -1.7)[1]).toBe(-1);
    expect(deflection(0.57, 0)[0]).toBeCloseTo(0.5, 6);
  });
  test("goes along one axis where it nearly does, and along both elsewhere", () => {
    expect(deflection(0.1, 0.9)[0]).toBe(0);
    const [x, y] = deflection(0.6, 0.6);
    expect(x).toBeCloseTo(y, 9);
    expect(x).toBeGreaterThan(0.4);
  });
});
