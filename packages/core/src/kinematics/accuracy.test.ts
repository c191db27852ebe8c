import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { distance, flangePose, robotById, type Vector3 } from "../index.ts";

const read = (name: string): unknown =>
  JSON.parse(readFileSync(new URL(`../../../../fixtures/kinematics/${name}`, import.meta.url), "utf8"));
const robot = robotById("staubli_rx90l")!;
/** Witness: pinocchio, cross-checked with yourdfpy and MuJoCo. Units m, rad. */
const forward = read("staubli_rx90l.forward.json") as {
  samples: { q: number[]; T: number[][] }[];
  near_singular: { q: number[]; T: number[][] }[];
};
/** Table 4 of the edge-tracing paper, as printed [mm]. */
const table = (
  read("staubli_rx90l.paper.json") as { table4: { unity_mm: Vector3; real_mm: Vector3; error_mm: Vector3 }[] }
).table4;

test("N-59 the tool centre point is within 0.01 mm of an independent forward kinematics on every reference pose, on each axis", () => {
  const cases = [...forward.samples, ...forward.near_singular];
  expect(cases.length).toBeGreaterThanOrEqual(200);
  let worst_mm = 0;
  for (const { q, T } of cases) {
    const { position } = flangePose(robot.arm, q);
    for (let axis = 0; axis < 3; axis++) worst_mm = Math.max(worst_mm, 1000 * Math.abs(position[axis]! - T[axis]![3]!));
  }
  expect(worst_mm).toBeLessThan(0.01);
});

test("the fixture of the paper's accuracy table is as printed: 12 rows, every error is unity − real, at most 0.62 mm on an axis and 0.884 mm in space", () => {
  expect(table).toHaveLength(12);
  let axis_mm = 0;
  let space_mm = 0;
  let squares = 0;
  for (const { unity_mm, real_mm, error_mm } of table) {
    for (let k = 0; k < 3; k++) {
      expect(unity_mm[k]! - real_mm[k]!).toBeCloseTo(error_mm[k]!, 6);
      axis_mm = Math.max(axis_mm, Math.abs(error_mm[k]!));
    }
    const gap = distance(unity_mm, real_mm);
    space_mm = Math.max(space_mm, gap);
    squares += gap * gap;
  }
  expect(axis_mm).toBeCloseTo(0.62, 9);
  expect(space_mm).toBeCloseTo(0.884, 3);
  expect(Math.sqrt(squares / 12)).toBeCloseTo(0.394, 3);
  // The two components of −0.62: X of row 2, Y of row 12.
  expect([table[1]!.error_mm[0], table[11]!.error_mm[1]]).toEqual([-0.62, -0.62]);
});
