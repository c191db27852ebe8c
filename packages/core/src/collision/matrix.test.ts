import { describe, expect, test } from "vitest";
import {
  allowedPairs,
  boxMesh,
  CellCollider,
  editPair,
  learnPairs,
  linkSolids,
  pose,
  robotById,
  seededRandom,
  type CellGeometry,
} from "../index.ts";
import { planarArm, planarCell } from "./testing/test-arm.ts";

describe("pairs of the robot that need no look are learnt", () => {
  const robot = robotById("ur10e")!;
  const cell: CellGeometry = {
    worldFromBase: pose(),
    links: linkSolids(robot),
    objects: [],
    allowedPairs: [],
    shapeError_m: 0,
  };
  const matrix = learnPairs(cell, robot.arm, 81, 1000);

  test("the same seed gives the same matrix, every pair has its reason", () => {
    expect(learnPairs(cell, robot.arm, 81, 1000)).toEqual(matrix);
    expect(matrix.entries.length).toBe(21);
    expect(matrix.entries.filter(({ reason }) => reason === "adjacent").length).toBe(6);
    expect(matrix.entries.find(({ a, b }) => a === "link 2" && b === "link 4")).toMatchObject({
      reason: "sometimes",
      watched: true,
      samples: 1000,
    });
  });

  test("no pair that touches in 10,000 other postures is left out", () => {
    const all = new CellCollider(cell, robot.arm);
    const culled = new Set(allowedPairs(matrix).map(([a, b]) => `${a} ${b}`));
    const random = seededRandom(82);
    const met = new Set<string>();
    for (let i = 0; i < 10_000; i++) {
      const q = robot.arm.joints.map(
        ({ limits: { lower_rad, upper_rad } }) => lower_rad + random() * (upper_rad - lower_rad),
      );
      for (const { a, b } of all.check(q)) met.add(`${a} ${b}`);
    }
    expect(met.size).toBeGreaterThan(7);
    expect([...met].filter(pair => culled.has(pair))).toEqual([]);
  });

  test("shapes that overlap in every posture are left out, and a person may decide otherwise", () => {
    // The tool's block is as large as the whole arm: it holds link 2 whatever the posture.
    const big = planarCell([], { tool: { name: "block", mesh: boxMesh([9, 9, 0.1]) } });
    const learnt = learnPairs(big, planarArm, 83, 200);
    expect(learnt.entries.find(({ a, b }) => a === "link 2" && b === "tool")).toMatchObject({
      reason: "always",
      watched: false,
      touches: 200,
    });
    expect(new CellCollider({ ...big, allowedPairs: allowedPairs(learnt) }, planarArm).check([0, 0, 0])).toEqual([]);
    const edited = editPair(learnt, "tool", "link 2", true);
    expect(new CellCollider({ ...big, allowedPairs: allowedPairs(edited) }, planarArm).check([0, 0, 0])).toEqual([
      { a: "link 2", b: "tool", between: "self" },
    ]);
    expect(editPair(learnt, "link 1", "link 2", true)).toEqual(learnt);
  });
});

describe("the matrix in a cell", () => {
  const robot = robotById("ur10e")!;
  const cell: CellGeometry = {
    worldFromBase: pose(),
    links: linkSolids(robot),
    objects: [],
    allowedPairs: [],
    shapeError_m: 0,
  };
  const FOLDED = [0, -1.2, 2.9, 0, 0, 0];
  const meet = (geometry: CellGeometry): string[] => {
    const collider = new CellCollider(geometry, robot.arm);
    collider.allowContactsAt(robot.home_rad);
    return collider.check(FOLDED).map(({ a, b }) => `${a} ${b}`);
  };

  test("leaves out what a person left out, in the collider and with it in every check", () => {
    const matrix = learnPairs(cell, robot.arm, 84, 300, robot.home_rad);
    const [first] = meet(cell);
    expect(first).toBeDefined();
    const [a, b] = [first!.slice(0, 6), first!.slice(7)];
    expect(meet({ ...cell, pairs: matrix })).toEqual(meet(cell));
    expect(meet({ ...cell, pairs: editPair(matrix, a, b, false) })).toEqual(meet(cell).filter(pair => pair !== first));
  });

  test("what touches in the free posture is left out by design, and is watched again when a person says so", () => {
    const collider = new CellCollider(cell, robot.arm);
    const touching = collider.check(FOLDED);
    const matrix = learnPairs(cell, robot.arm, 85, 300, FOLDED);
    const designed = matrix.entries.filter(({ reason }) => reason === "at home");
    expect(designed.map(({ a, b }) => [a, b])).toEqual(
      touching
        .map(({ a, b }) => [a, b])
        .filter(([a, b]) => matrix.entries.some(entry => entry.a === a && entry.b === b && entry.touches < 300)),
    );
    expect(designed.every(({ watched }) => !watched)).toBe(true);
    const { a, b } = designed[0]!;
    const again = new CellCollider({ ...cell, pairs: editPair(matrix, a, b, true) }, robot.arm);
    again.allowContactsAt(FOLDED);
    expect(again.check(FOLDED)).toContainEqual({ a, b, between: "self" });
  });
});
