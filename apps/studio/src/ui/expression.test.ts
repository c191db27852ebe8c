import { expect, test } from "vitest";
import { parseTyped, showNumber } from "./expression.ts";

const length = (text: string, current_m = 0.1): number | null => {
  const typed = parseTyped(text, "length", current_m);
  return typed.kind === "value" ? typed.value : null;
};

test("plain numbers take the shown unit", () => {
  expect(length("25")).toBeCloseTo(0.025, 12);
  expect(length("-3.5")).toBeCloseTo(-0.0035, 12);
  expect(length("1e2")).toBeCloseTo(0.1, 12);
  expect(length("12,5")).toBeCloseTo(0.0125, 12);
});
test("units and arithmetic", () => {
  expect(length("25 mm")).toBeCloseTo(0.025, 12);
  expect(length("90/4")).toBeCloseTo(0.0225, 12);
  expect(length("2*(3+4) cm")).toBeCloseTo(0.14, 12);
  expect(length("1 m - 5")).toBeCloseTo(0.995, 12);
  expect(length("1 in")).toBeCloseTo(0.0254, 12);
  expect(parseTyped("90 deg", "angle", 0)).toEqual({ kind: "value", value: Math.PI / 2 });
  expect(parseTyped("50", "percent", 0)).toEqual({ kind: "value", value: 0.5 });
});
test("relative to what is there", () => {
  expect(length("+10")).toBeCloseTo(0.11, 12);
  expect(length("+= 1 cm")).toBeCloseTo(0.11, 12);
  expect(length("-=10")).toBeCloseTo(0.09, 12);
  expect(length("/4")).toBeCloseTo(0.025, 12);
  expect(length("*2")).toBeCloseTo(0.2, 12);
});
test("what cannot be understood says how far it came, and never becomes a number", () => {
  for (const text of ["", "abc", "1 +", "(2", "1/0", "5 kg", "1 mm mm", "2 mm * 3 mm", "NaN", "Infinity", "*2 mm"])
    expect(length(text), text).toBeNull();
});
test("shown numbers have a true minus and no minus zero", () => {
  expect(showNumber(-0.225_02, "length")).toBe("−225.02");
  expect(showNumber(-1e-9, "length")).toBe("0.00");
});
