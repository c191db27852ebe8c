import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import { flangePose } from "../kinematics/forward.ts";
import { axesOfJoints, jointsOfAxes } from "../model/vendor.ts";
import type { Robot } from "../model/robot.ts";
import { compose, inverse } from "../spatial/pose.ts";
import { toMatrix } from "../spatial/quaternion.ts";
import { millimetres } from "../spatial/units.ts";
import { CATALOGUE } from "./catalogue/makers.ts";
import { LIBRARY, addCatalogue, catalogueRobots, falseSection, robotById } from "./index.ts";

addCatalogue(CATALOGUE);

interface Sample {
  readonly axes_deg: readonly number[];
  readonly flange_mm: readonly number[];
  readonly rotation: readonly number[];
}
const { robots: GOLDEN } = JSON.parse(
  readFileSync(new URL("../../../../fixtures/vendor/axes.json", import.meta.url), "utf8"),
) as { readonly robots: Readonly<Record<string, readonly Sample[]>> };

/** a · bᵀ of two rotation matrices, row after row. */
const between = (a: ArrayLike<number>, b: ArrayLike<number>): number[] =>
  [0, 1, 2].flatMap(i => [0, 1, 2].map(j => [0, 1, 2].reduce((sum, k) => sum + a[3 * i + k]! * b[3 * j + k]!, 0)));

const flangeAt = (robot: Robot, axes_deg: readonly number[]) =>
  compose(
    inverse(robot.baseFromVendorWorld),
    flangePose(robot.arm, jointsOfAxes(robot.vendorSection!, axes_deg, new Float64Array(axes_deg.length))),
  );

describe("what controllers show, by the makers' drawings (fixtures/vendor/axes.py)", () => {
  test.each(Object.entries(GOLDEN))(
    "%s: the flange is where the controller would say, and turns as it would",
    (id, samples) => {
      const robot = robotById(id)!;
      const first = toMatrix(flangeAt(robot, samples[0]!.axes_deg).quaternion);
      for (const { axes_deg, flange_mm, rotation } of samples) {
        const { position, quaternion } = flangeAt(robot, axes_deg);
        position.forEach((value, i) => expect(millimetres(value)).toBeCloseTo(flange_mm[i]!, 3));
        between(toMatrix(quaternion), first).forEach((value, i) =>
          expect(value).toBeCloseTo(between(rotation, samples[0]!.rotation)[i]!, 7),
        );
      }
    },
  );

  test("every maker whose axes are counted has a robot that is held so", () => {
    const held = new Set(Object.keys(GOLDEN).flatMap(id => robotById(id)!.vendorSection!.languages));
    expect([...held].sort()).toEqual(
      ["fanuc-ls", "inform", "kawasaki-as", "krl", "melfa-basic", "rapid", "urscript", "val3"].sort(),
    );
  });
});

test("shown axes come back to the joints they were, with signs, zeros and couplings", () => {
  const counting = {
    axes: [
      { name: "1", sign: -1, zero_deg: 30 },
      { name: "2", sign: 1, zero_deg: -90 },
      { name: "3", sign: -1, zero_deg: 0 },
    ],
    couplings: [{ axis: 3, with: 2, factor: -1 }],
  } as const;
  const shown = axesOfJoints(counting, [0.1, 0.2, 0.3], new Float64Array(3));
  const [q1, q2, q3] = [0.1, 0.2, 0.3].map(value => (value * 180) / Math.PI) as [number, number, number];
  expect([...shown].map(value => value.toFixed(9))).toEqual(
    [30 - q1, q2 - 90, -q3 - (q2 - 90)].map(value => value.toFixed(9)),
  );
  [0.1, 0.2, 0.3].forEach((q, i) => expect(jointsOfAxes(counting, shown, new Float64Array(3))[i]).toBeCloseTo(q, 12));
});

test("every section counts as many axes as its arm has joints, with sources, and no posture contradicts it", () => {
  const all = [...LIBRARY, ...catalogueRobots()].filter(({ vendorSection }) => vendorSection !== undefined);
  expect(all.length).toBe(13 + 69);
  for (const robot of all) {
    expect(robot.vendorSection!.axes.length, robot.id).toBe(robot.arm.joints.length);
    expect(Object.keys(robot.vendorSection!.sources).length, robot.id).toBeGreaterThan(0);
    expect(falseSection(robot), robot.id).toBeUndefined();
  }
});

test("a section on a wrong arm is refused with both sets of numbers", () => {
  const { axes_deg, flange_mm } = GOLDEN["abb_irb2400_12_155"]![0]!;
  const of = robotById("abb_irb2400_12_155")!;
  const postures = [{ axes_deg, flange_mm: flange_mm as unknown as readonly [number, number, number] }];
  const section = { ...of.vendorSection!, postures };
  expect(falseSection({ ...of, vendorSection: section })).toBeUndefined();
  // The same lengths without the rod: axis 3 of such a controller counts from the upper arm.
  const uncoupled = falseSection({ ...of, vendorSection: { ...section, couplings: [] } });
  expect(uncoupled).toContain(flange_mm.map(value => value.toFixed(1)).join(", "));
  expect(uncoupled).toMatch(
    /that of the ABB IRB 2400-12\/1\.55 is at \(-?\d+\.\d, -?\d+\.\d, -?\d+\.\d\) mm: \d+\.\d mm apart/,
  );
  const other = robotById("abb_irb1200_7_70")!;
  expect(falseSection({ ...other, vendorSection: section })).toMatch(/IRB 1200-7\/0\.7 is at \(/);
});
