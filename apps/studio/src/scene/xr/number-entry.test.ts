import { expect, test } from "vitest";
import { entered, typed, type KeypadKey } from "./number-entry.ts";

const all = (...keys: readonly KeypadKey[]): string => keys.reduce(typed, "");

test("a keypad types whole and decimal numbers, with a sign, and takes back", () => {
  expect(all("1", "2", "1", "8")).toBe("1218");
  expect(all("0", "5")).toBe("5");
  expect(all(".", "5")).toBe("0.5");
  expect(all("1", ".", ".", "2")).toBe("1.2");
  expect(all("1", "2", "±")).toBe("-12");
  expect(all("±", "1", "±")).toBe("1");
  expect(all("±", ".", "5")).toBe("-0.5");
  expect(all("1", "2", "⌫")).toBe("1");
  expect(all("1", "2", "C")).toBe("");
  expect(all("⌫")).toBe("");
  expect(all("1", "2", "3", "4", "5", "6", "7", "8")).toBe("1234567");
});

test("what is no number, or lies outside, is said and not done", () => {
  expect(entered("", 0, 100)).toEqual({ kind: "nothing" });
  expect(entered("-", 0, 100)).toEqual({ kind: "nothing" });
  expect(entered("-0.", 0, 100)).toEqual({ kind: "number", value: -0 });
  expect(entered("101", 1, 100)).toEqual({ kind: "outside", least: 1, most: 100 });
  expect(entered("0", 1, 100)).toEqual({ kind: "outside", least: 1, most: 100 });
  expect(entered("62.5", 1, 100)).toEqual({ kind: "number", value: 62.5 });
});
