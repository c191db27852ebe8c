import { expect, test } from "vitest";
import { readTyped, typedOn } from "./typed.ts";

const typed = (keys: string): string => Array.from(keys).reduce((text, key) => typedOn(text, key) ?? text, "");

test("keys become a number: sign first, one decimal point, a comma is one; other keys change nothing", () => {
  expect(readTyped(typed("-12,5"))).toEqual({ value: -12.5, fromStart: false });
  expect(readTyped(typed("1w2.3.4"))).toEqual({ value: 12.34, fromStart: false });
  expect(readTyped(typed("+250"))).toEqual({ value: 250, fromStart: true });
  expect(typedOn("12", "Backspace")).toBe("1");
  expect([readTyped(""), readTyped("-"), readTyped("+.")]).toEqual([null, null, null]);
});
