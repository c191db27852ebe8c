import { describe, expect, test } from "vitest";
import { checkProgram } from "../checks/check.ts";
import { PathValidator } from "../planning/path-validator.ts";
import { emptyProgram, type MoveStep } from "../program/program.ts";
import { LIBRARY, robotById } from "../robots/library/index.ts";
import { linkSolids } from "../robots/shapes/index.ts";
import type { Robot } from "../model/robot.ts";
import { pose } from "../spatial/pose.ts";
import { CellCollider, keptApart } from "./cell-collider.ts";
import type { CellGeometry } from "./cell.ts";
import { marginOf, OWN_KEPT_M } from "./motion.ts";

const cellOf = (robot: Robot): CellGeometry => ({
  worldFromBase: pose(),
  links: linkSolids(robot),
  objects: [],
  allowedPairs: [],
  shapeError_m: robot.shapeError_m,
});
const colliderOf = (robot: Robot): CellCollider => {
  const collider = new CellCollider(cellOf(robot), robot.arm);
  collider.allowContactsAt(robot.home_rad);
  return collider;
};
const freeAt = (collider: CellCollider, robot: Robot, q: readonly number[], margin_m: number): boolean =>
  new PathValidator(collider, robot.arm, { margin_m, keepsMargin: keptApart }).free(q);
const inside = (robot: Robot, q: readonly number[]): number[] =>
  q.map((angle, i) => {
    const { lower_rad, upper_rad } = robot.arm.joints[i]!.limits;
    return Math.min(upper_rad, Math.max(lower_rad, angle));
  });

describe("X-13 parts of a robot keep a distance from each other, as far as its design leaves one", () => {
  test.each(LIBRARY.map(robot => [robot.id, robot] as const))(
    "%s: the ready pose and all joints at zero are free, whatever margin is asked for",
    (_, robot) => {
      const collider = colliderOf(robot);
      for (const margin_m of [0, 0.02, 0.5]) expect(freeAt(collider, robot, robot.home_rad, margin_m)).toBe(true);
      const zero = inside(
        robot,
        robot.home_rad.map(() => 0),
      );
      expect(freeAt(collider, robot, zero, 0)).toBe(true);
    },
  );

  const rx160 = robotById("staubli_rx160")!;
  /** Leaning back, link 2 passes the foot by some millimetres, more or less as joint 1 turns: a graze is short. */
  function grazing(): { readonly q: number[]; readonly distance_m: number } {
    const collider = colliderOf(rx160);
    const pair = collider.pairs.find(({ contact: { a, b } }) => a === "link 0" && b === "link 2")!;
    for (let turn = -2.5; turn <= 2.5; turn += 0.05) {
      const q = inside(rx160, [turn, -2.3, Math.PI / 2, 0, 0, 0]);
      collider.place(q);
      const distance_m = collider.distanceOf(pair, OWN_KEPT_M);
      if (distance_m > 0.0005 && distance_m < 0.9 * OWN_KEPT_M) return { q, distance_m };
    }
    throw new Error("Link 2 never comes near link 0.");
  }

  test("RX160: link 2 beside link 0 without touching it is too near, for the guard's margin of nothing as well", () => {
    const { q } = grazing();
    const collider = colliderOf(rx160);
    expect(collider.collides(q)).toBe(false);
    expect(freeAt(collider, rx160, q, 0)).toBe(false);
  });

  test("the check says the distance and the margin, without a word of drawn shapes", () => {
    const { q, distance_m } = grazing();
    const to: MoveStep = { id: "a", type: "move", path: "ptp", target: { q }, speed: { ratio: 0.5 }, blend_m: 0 };
    const { bad } = checkProgram({ ...emptyProgram(rx160.id), steps: [to] }, rx160, { cell: cellOf(rx160) });
    const contact = bad.find(({ code }) => code === "collision.contact")!;
    expect(contact.limit).toBe(OWN_KEPT_M);
    expect(contact.value).toBeGreaterThanOrEqual(distance_m - 2e-4);
    expect(contact.sentence).toMatch(
      /^Link \d comes within \d\.\d mm of link \d at \d\.\d\d s; the margin is 5\.0 mm\.$/,
    );
  });

  test("the margin of the cell holds for them too, up to half of what they have in the ready pose", () => {
    const collider = colliderOf(rx160);
    const margins = collider.pairs.map(pair => ({ pair, kept_m: marginOf(pair, 0.03, collider) }));
    collider.place(rx160.home_rad);
    for (const { pair, kept_m } of margins)
      expect(kept_m).toBeCloseTo(Math.min(0.03, 0.5 * collider.distanceOf(pair, 10)), 9);
    expect(new Set(margins.map(({ kept_m }) => kept_m)).size).toBeGreaterThan(1);
  });
});
