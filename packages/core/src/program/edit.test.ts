import fc from "fast-check";
import { describe, expect, test } from "vitest";
import {
  appendStep,
  applyRepair,
  duplicateSteps,
  freshGroupIds,
  freshStepId,
  insertAfter,
  insertBefore,
  insertInto,
  insertSteps,
  moveBefore,
  moveInto,
  moveSteps,
  placeOf,
  regroupSteps,
  removeSteps,
  replaceStep,
  wrapInRepeat,
} from "./edit.ts";
import { parseProgram } from "./parse.ts";
import { emptyProgram, type Program, type Step } from "./program.ts";
import { everyStep, listsOf } from "./walk.ts";

const wait = (id: string, s = 1): Step => ({ id, type: "wait", s });
const of = (...ids: string[]): Program => ({ ...emptyProgram("staubli_rx90l"), steps: ids.map(id => wait(id)) });
const ids = (program: Program): string => program.steps.map(step => step.id).join(" ");

describe("edits of a program", () => {
  test("ids of new groups are no group's, also after one before them was taken away", () => {
    const program = {
      ...of("a"),
      groups: { "edge-2": { name: "Edge 2" }, "edge-x": { name: "Edge" }, "path-7": { name: "Path" } },
    };
    expect(freshGroupIds(program, 2, "edge-")).toEqual(["edge-3", "edge-4"]);
    expect(freshGroupIds(program, 1, "demonstration-")).toEqual(["demonstration-1"]);
  });

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
    for (const same of [
      removeSteps(program, ["z"]),
      moveSteps(program, ["z"], 0),
      replaceStep(program, "z", wait("z")),
      duplicateSteps(program, ["z"]),
      insertBefore(program, "z", [wait("x")]),
    ]) {
      expect(same).toBe(program);
    }
  });

  test("reordering keeps every step once", () => {
    expect(ids(moveSteps(of("a", "b", "c", "d"), ["d", "b"], 0))).toBe("b d a c");
    fc.assert(
      fc.property(
        fc.uniqueArray(fc.string({ minLength: 1 }), { minLength: 1, maxLength: 8 }),
        fc.array(fc.nat(9), { maxLength: 4 }),
        fc.integer({ min: -2, max: 12 }),
        (names, picks, to) => {
          const moved = moveSteps(
            of(...names),
            picks.map(i => names[i % names.length]!),
            to,
          );
          expect(moved.steps.map(step => step.id).sort()).toEqual([...names].sort());
        },
      ),
      { seed: 3, numRuns: 300 },
    );
  });

  test("fresh ids are never taken", () => {
    expect(freshStepId(of("s1", "s7", "x9"))).toBe("s8");
    expect(ids(duplicateSteps(of("s1", "s2", "s3"), ["s1", "s2"]))).toBe("s1 s2 s4 s5 s3");
    fc.assert(
      fc.property(fc.array(fc.constantFrom("s1", "s2", "s3", "a"), { maxLength: 6 }), added => {
        const all = insertSteps(
          of("s1", "s2"),
          1,
          added.map(id => wait(id)),
        ).steps.map(step => step.id);
        expect(new Set(all).size).toBe(all.length);
      }),
      { seed: 4, numRuns: 200 },
    );
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

describe("edits inside blocks", () => {
  const loop = (id: string, ...steps: Step[]): Step => ({ id, type: "repeat", times: 2, steps });
  const choice = (id: string, then: Step[], otherwise: Step[]): Step => ({
    id,
    type: "if",
    when: { signal: "part", is: true },
    then,
    else: otherwise,
  });
  const nested: Program = {
    ...of("a"),
    signals: { part: { kind: "digital-in" } },
    routines: { pick: [wait("p")] },
    steps: [wait("a"), loop("l", wait("b"), choice("i", [wait("c")], [wait("d"), wait("e")])), wait("f")],
  };
  const drawn = (steps: readonly Step[]): string =>
    steps
      .map(
        step =>
          step.id +
          listsOf(step)
            .map(list => `(${drawn(list)})`)
            .join(""),
      )
      .join(" ");

  test("insert, remove, replace, duplicate and regroup find a step wherever it is", () => {
    expect(drawn(insertBefore(nested, "c", [wait("x")]).steps)).toBe("a l(b i(x c)(d e)) f");
    expect(drawn(insertAfter(nested, "d", [wait("a")]).steps)).toBe("a l(b i(c)(d s1 e)) f");
    expect(drawn(insertInto(nested, { block: "i", side: "else" }, 9, [wait("x")]).steps)).toBe("a l(b i(c)(d e x)) f");
    expect(insertInto(nested, { routine: "pick" }, 0, [wait("x")]).routines.pick!.map(step => step.id)).toEqual([
      "x",
      "p",
    ]);
    expect(drawn(removeSteps(nested, ["d", "a"]).steps)).toBe("l(b i(c)(e)) f");
    expect(removeSteps(nested, ["p"]).routines).toEqual({ pick: [] });
    expect(drawn(replaceStep(nested, "e", wait("z")).steps)).toBe("a l(b i(c)(d z)) f");
    expect(drawn(duplicateSteps(nested, ["i"]).steps)).toBe("a l(b i(c)(d e) s1(s2)(s3 s4)) f");
    expect(
      [...everyStep(regroupSteps(nested, ["c", "e"], "g"))].filter(step => step.group === "g").map(step => step.id),
    ).toEqual(["c", "e"]);
    expect(placeOf(nested, "e")).toEqual({ where: { block: "i", side: "else" }, at: 1 });
  });

  test("steps move in and out of blocks; a block never goes into itself", () => {
    expect(drawn(moveBefore(nested, ["f"], "d").steps)).toBe("a l(b i(c)(f d e))");
    expect(drawn(moveSteps(nested, ["c"], 0).steps)).toBe("c a l(b i()(d e)) f");
    expect(drawn(moveInto(nested, ["a", "f"], { block: "l" }, 1).steps)).toBe("l(b a f i(c)(d e))");
    expect(moveInto(nested, ["l"], { block: "i" }, 0)).toBe(nested);
    expect(moveBefore(nested, ["b"], "i")).toBe(nested);
    expect(drawn(wrapInRepeat(nested, ["d", "e"], "forever").steps)).toBe("a l(b i(c)(r1(d e))) f");
  });

  test("a step taken out of its pallet stays at the first place, and the program can still be read", () => {
    const pallet: Program = {
      ...emptyProgram("staubli_rx90l"),
      frames: { table: { position: [1, 0, 0], quaternion: [0, 0, 0, 1] } },
      pallets: {
        tray: {
          frame: "table",
          origin: { position: [0.1, 0.2, 0], quaternion: [0, 0, 1, 0] },
          rowEnd: [0.3, 0.2, 0],
          columnEnd: [0.1, 0.4, 0],
          rows: 3,
          columns: 3,
          layers: 1,
          layer_m: 0,
        },
      },
      steps: [
        {
          id: "t",
          type: "pallet",
          pallet: "tray",
          steps: [
            {
              id: "m",
              type: "move",
              path: "lin",
              target: { pose: { position: [0.01, 0, 0.05], quaternion: [0, 0, 0, 1] }, frame: "tray", tool: "flange" },
              speed: { mps: 0.1 },
              blend_m: 0,
            },
          ],
        },
      ],
    };
    const out = moveSteps(pallet, ["m"], 0);
    const [step] = out.steps;
    expect(step).toMatchObject({ target: { frame: "table", pose: { quaternion: [0, 0, 1, 0] } } });
    if (step?.type === "move" && "pose" in step.target)
      step.target.pose.position.forEach((x, i) => {
        expect(x).toBeCloseTo([0.09, 0.2, 0.05][i]!, 12);
      });
    expect(parseProgram(out).kind).toBe("program");
  });

  test("reordering at random keeps every step once, and every step inside what it was inside of or where it was put", () => {
    const all = [...everyStep(nested)].map(step => step.id).sort();
    fc.assert(
      fc.property(fc.subarray(all), fc.constantFrom(...all), (ids, before) => {
        const moved = moveBefore(nested, ids, before);
        expect([...everyStep(moved)].map(step => step.id).sort()).toEqual(all);
        expect(parseProgram(moved).kind).toBe("program");
      }),
      { seed: 5, numRuns: 300 },
    );
  });
});
