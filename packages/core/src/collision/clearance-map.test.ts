import { describe, expect, test } from "vitest";
import {
  CellCollider,
  checkJointLine,
  ClearanceMaps,
  linkSolids,
  pose,
  robotById,
  seededRandom,
  type CellGeometry,
} from "../index.ts";
import { box, planarArm, planarCell } from "./testing/test-arm.ts";

const drawn = (random: () => number, arm = planarArm): number[] =>
  arm.joints.map(({ limits }) => limits.lower_rad + random() * (limits.upper_rad - limits.lower_rad));

describe("what was proven before is only looked up", () => {
  const robot = robotById("ur10e")!;
  const cell: CellGeometry = {
    worldFromBase: pose(),
    links: linkSolids(robot),
    allowedPairs: [],
    shapeError_m: 0,
    objects: [box("post", [0.6, 0.3, 0.5], [0.1, 0.1, 1]), box("floor", [0, 0, -0.06], [3, 3, 0.1])],
  };

  test.each([
    [150, 0],
    [30, 0.02],
  ])(
    "verdicts on %i random lines are those of the check without it, margin %f m, also when asked again",
    (count, margin_m) => {
      const collider = new CellCollider(cell, robot.arm);
      const maps = new ClearanceMaps(collider, robot.arm);
      const random = seededRandom(90);
      const lines = Array.from(
        { length: count },
        () => [drawn(random, robot.arm).map(q => q / 3), drawn(random, robot.arm).map(q => q / 3)] as const,
      );
      const kinds = new Map<string, number>();
      for (let round = 0; round < 2; round++) {
        for (const [from, to] of lines) {
          const plain = checkJointLine(collider, from, to, { margin_m });
          const mapped = checkJointLine(collider, from, to, { margin_m, maps });
          kinds.set(plain.kind, (kinds.get(plain.kind) ?? 0) + 1);
          expect(mapped.kind).toBe(plain.kind);
          if (plain.kind === "contact" && mapped.kind === "contact") expect(mapped.at).toBeCloseTo(plain.at, 3);
        }
      }
      expect(kinds.get("clear")).toBeGreaterThan(count / 10);
      expect(kinds.get("contact")).toBeGreaterThan(count / 10);
      expect(maps.size).toBeGreaterThan(100);
    },
  );

  test("an object that moves is seen at once", () => {
    const collider = new CellCollider(planarCell([box("post", [0, 5, 0], [0.1, 0.1, 0.1])]), planarArm);
    const maps = new ClearanceMaps(collider, planarArm);
    const ask = (): string => checkJointLine(collider, [-0.5, 0, 0], [0.5, 0, 0], { maps }).kind;
    for (let i = 0; i < 20; i++) expect(ask()).toBe("clear");
    collider.moveObject("post", pose([0.5, 0, 0]));
    expect(ask()).toBe("contact");
    collider.moveObject("post", pose([0, 5, 0]));
    expect(ask()).toBe("clear");
    collider.setObject(box("thin", [2.5, 0, 0], [0.0001, 0.1, 0.1]));
    expect(ask()).toBe("contact");
  });

  test("a box called clear holds no contact: 20,000 postures drawn inside clear boxes", () => {
    const collider = new CellCollider(planarCell([box("post", [0.9, 0.9, 0], [0.2, 0.2, 0.2])]), planarArm);
    const maps = new ClearanceMaps(collider, planarArm);
    const random = seededRandom(91);
    let proven = 0;
    for (let i = 0; i < 4000; i++) {
      const q = drawn(random).map(angle => angle * 0.9);
      const half = random() * 0.2;
      for (const pair of collider.pairs) {
        if (!maps.provenAround(pair, 0, q, [1, 1, 1], half)) continue;
        proven++;
        for (let k = 0; k < 5; k++) {
          collider.place(q.map(angle => angle + (2 * random() - 1) * half));
          expect(collider.touchOf(pair)).toBe(false);
        }
      }
    }
    expect(proven).toBeGreaterThan(4000);
  });
});
