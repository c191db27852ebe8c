import { expect, test } from "vitest";
import { cyclesOf, productionStore, toggled } from "./production.ts";

test("once is one cycle, several as many as counted, until stopped no number at all", () => {
  const choice = productionStore.getState();
  expect(cyclesOf({ ...choice, cycles: "once" })).toBe(1);
  expect(cyclesOf({ ...choice, cycles: "several", count: 7 })).toBe(7);
  expect(cyclesOf({ ...choice, cycles: "forever", count: 7 })).toBeNull();
});

test("a breakpoint is set and taken away again, the others stay", () => {
  expect(toggled(["a"], "b")).toEqual(["a", "b"]);
  expect(toggled(["a", "b"], "a")).toEqual(["b"]);
});
