import fc from "fast-check";
import { describe, expect, test } from "vitest";
import {
  appendStep, applyRepair, duplicateSteps, freshStepId, insertBefore, insertSteps, moveSteps, regroupSteps, removeSteps, replaceStep,
} from "./edit.ts";
import { emptyProgram, type Program, type Step } from "./program.ts";

const wait = (id: string, s = 1): Step => ({ id, type: "wait", s });
const of = (...ids: string[]): Program => ({ ...emptyProgram("staubli_rx90l"), steps: ids.map(id => wait(id)) });
const ids = (program: Program): string => program.steps.map(step => step.id).join(" ");

describe("edits of a program", () => {
  test("insert, append, remove, replace", () => {
    expect(ids(insertSteps(of("a", "b"), 1, [wait("x"), wait("y")]))).toBe("a x y b");
    expect(ids(insertBefore(of("a", "b"), "b", [wait("x")]))).toBe("a x b");
    expect(ids(appendStep(of("a"), wait("a")))).toBe("a s1");
    expect(ids(removeSteps(of("a", "b", "c"), ["a", "c", "z"]))).toBe("b");
    expect(replaceStep(of("a", "b"), "b", wait("b", 9)).steps[1]).toEqual(wait("b", 9));
    expect(ids(replaceStep(of("a", "b"), "b", wait("a", 9)))).toBe("a b");
  });

  test("an id that does not exist changes nothing", () => {
    const program = of("a", "b");
    for (const same of [removeSteps(program, ["z"]), moveSteps(program, ["z"], 0), replaceStep(program, "z", wait("z")), duplicateSteps(program, ["z"]), insertBefore(program, "z", [wait("x")])]) {
      expect(same).toBe(program);
    }
  });

  test("reordering keeps every step once", () => {
    expect(ids(moveSteps(of("a", "b", "c", "d"), ["d", "b"], 0))).toBe("b d a c");
    fc.assert(fc.property(fc.uniqueArray(fc.string({ minLength: 1 }), { minLength: 1, maxLength: 8 }), fc.array(fc.nat(9), { maxLength: 4 }), fc.integer({ min: -2, max: 12 }), (names, picks, to) => {
      const moved = moveSteps(of(...names), picks.map(i => names[i % names.length]!), to);
      expect(moved.steps.map(step => step.id).sort()).toEqual([...names].sort());
    }), { seed: 3, numRuns: 300 });
  });

  test("fresh ids are never taken", () => {
    expect(freshStepId(of("s1", "s7", "x9"))).toBe("s8");
    expect(ids(duplicateSteps(of("s1", "s2", "s3"), ["s1", "s2"]))).toBe("s1 s2 s4 s5 s3");
    fc.assert(fc.property(fc.array(fc.constantFrom("s1", "s2", "s3", "a"), { maxLength: 6 }), added => {
      const all = insertSteps(of("s1", "s2"), 1, added.map(id => wait(id))).steps.map(step => step.id);
      expect(new Set(all).size).toBe(all.length);
    }), { seed: 4, numRuns: 200 });
  });

  test("groups come and go with their members", () => {
    const grouped = regroupSteps(of("a", "b", "c"), ["a", "b"], "edge", { name: "Edge 1" });
    expect(grouped.groups).toEqual({ edge: { name: "Edge 1" } });
    expect(grouped.steps.map(step => step.group)).toEqual(["edge", "edge", undefined]);
    const half = regroupSteps(grouped, ["a"], undefined);
    expect(half.groups).toEqual(grouped.groups);
    expect(regroupSteps(half, ["b"], undefined)).toEqual(of("a", "b", "c"));
  });

  test("a repair replaces the step and puts the extra points before it", () => {
    expect(ids(applyRepair(of("a", "b"), "b", { replace: wait("b", 2), insertBefore: [wait("x")] }))).toBe("a x b");
  });
});
