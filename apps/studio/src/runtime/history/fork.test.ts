import { emptyProgram, SignalTable, type Program, type Step } from "@twincell/core";
import { expect, test } from "vitest";
import { branchOf, restoreSignals, stepsFrom } from "./fork.ts";

const wait = (id: string): Step => ({ id, type: "wait", s: 1 });
const program: Program = {
  ...emptyProgram("ur10e"),
  signals: { part: { kind: "digital-in", address: 1 }, lamp: { kind: "digital-out", address: 2 } },
  steps: [wait("a"), { id: "r", type: "repeat", times: 2, steps: [wait("b")] }, wait("c")],
};
const state = {
  moving: true,
  mode: "automatic",
  safety: "normal",
  override: 1,
  gripperClosed: true,
  message: "",
} as const;

test("T-54 a branch begins with the gripper as it was and the step that was under way", () => {
  const from = branchOf({ state: { ...state, step: "b" }, signals: {} }, program);
  expect([...stepsFrom(["a", "b", "b", "c"].map(wait), from)].map(step => [step.id, step.type])).toEqual([
    ["b", "gripper"],
    ["b", "wait"],
    ["b", "wait"],
    ["c", "wait"],
  ]);
  expect([...stepsFrom([wait("a")], from)]).toEqual([]);
});
test("a step that the program has no longer begins at the beginning", () => {
  const from = branchOf({ state: { ...state, step: "gone" }, signals: {} }, program);
  expect(from.step).toBe("");
  expect([...stepsFrom([wait("a"), wait("c")], from)].map(({ id }) => id)).toEqual(["a", "a", "c"]);
});
test("lines stand as they did: inputs from outside, outputs by themselves", () => {
  const lines = new SignalTable();
  const inputs: [string, boolean | number][] = [];
  restoreSignals(
    { step: "", gripperClosed: false, signals: { part: true, lamp: true, level: 2 } },
    program,
    lines,
    (name, value) => {
      inputs.push([name, value]);
    },
  );
  expect(inputs).toEqual([["part", true]]);
  expect([...lines.all]).toEqual([
    ["lamp", true],
    ["level", 2],
  ]);
});
