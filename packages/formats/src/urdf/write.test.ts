import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import {
  angleBetween,
  distance,
  flangePose,
  LIBRARY,
  seededRandom,
  toMatrix,
  type Pose,
  type SerialArm,
} from "@twincell/core";
import { armFromUrdf, readUrdf, writeUrdf } from "../index.ts";
import { madeUpArm, madeUpMasses, madeUpSide } from "../testing/made-up-arm.ts";

function readBack(text: string, base?: string) {
  const read = readUrdf(text);
  if (read.kind !== "read") throw new Error(read.sentence);
  const chain = armFromUrdf(read.robot, base);
  if (chain.kind !== "chain") throw new Error(chain.sentence);
  return chain;
}
function worstGap(a: SerialArm, b: SerialArm): number {
  const random = seededRandom(12);
  let worst = 0;
  for (let n = 0; n < 100; n++) {
    const q = a.joints.map(() => 6 * random() - 3);
    const one = flangePose(a, q);
    const other = flangePose(b, q);
    worst = Math.max(worst, distance(one.position, other.position), angleBetween(one.quaternion, other.quaternion));
  }
  return worst;
}

describe("L-08 a URDF that is written and read again", () => {
  test.each(LIBRARY.map(robot => [robot.id, robot] as const))(
    "%s: same joints, limits and poses to 1e-12",
    (_, { arm, masses, baseFromVendorWorld }) => {
      const text = writeUrdf(arm, { masses, side: { name: "base", baseFromSide: baseFromVendorWorld as Pose } });
      const back = readBack(text);
      expect(worstGap(arm, back.arm)).toBeLessThan(1e-12);
      expect([back.base, back.tip]).toEqual(["base_link", "tool0"]);
      expect(back.arm.name).toBe(arm.name);
      back.arm.joints.forEach(({ name, limits }, j) => {
        const { lower_rad, upper_rad, speed_rad_s } = arm.joints[j]!.limits;
        expect([name, limits.lower_rad, limits.upper_rad, limits.speed_rad_s]).toEqual([
          arm.joints[j]!.name,
          lower_rad,
          upper_rad,
          speed_rad_s,
        ]);
      });
    },
  );

  test("an odd arm, its masses, the world its maker counts from and its meshes", () => {
    const text = writeUrdf(madeUpArm, {
      masses: madeUpMasses,
      side: madeUpSide,
      meshesOf: link => (link === 2 ? [] : [`meshes/link_${link}.stl`]),
    });
    const back = readBack(text);
    expect(worstGap(madeUpArm, back.arm)).toBeLessThan(1e-12);
    expect(
      worstGap(
        {
          ...madeUpArm,
          joints: madeUpArm.joints.map(joint => ({
            ...joint,
            axis: joint.axis.map(x => -x) as [number, number, number],
          })),
        },
        back.arm,
      ),
    ).toBeGreaterThan(0.1);
    expect(back.arm.name).toBe(madeUpArm.name);
    const fromSide = flangePose(readBack(text, "base").arm, [0, 0, 0, 0, 0, 0, 0]).position;
    const own = flangePose(madeUpArm, [0, 0, 0, 0, 0, 0, 0]).position;
    [-own[0], -own[1], own[2] - 0.4].forEach((value, k) => {
      expect(fromSide[k]).toBeCloseTo(value, 12);
    });
    expect(back.shapes.filter(({ use }) => use === "visual").map(({ link, shape }) => [link, shape.geometry])).toEqual(
      [0, 1, 3, 4, 5, 6, 7].map(link => [
        link,
        { kind: "mesh", reference: `meshes/link_${link}.stl`, scale: [1, 1, 1] },
      ]),
    );
    back.masses!.forEach(({ mass_kg, linkFromCentre, inertia_kgm2 }, i) => {
      expect(mass_kg).toBe(madeUpMasses[i]!.mass_kg);
      expect(distance(linkFromCentre!.position, madeUpMasses[i]!.linkFromCentre!.position)).toBeLessThan(1e-15);
      expect(inertia_kgm2![0] + inertia_kgm2![1] + inertia_kgm2![2]).toBeCloseTo(3 * i + 0.9, 12);
    });
  });

  test("names do not collide", () => {
    expect(readBack(writeUrdf(madeUpArm, { tip: "link_3" }), "base_link").arm.joints.length).toBe(7);
  });
});

describe("a witness reads what is written", () => {
  interface Witness {
    readonly mass_kg: number;
    readonly lower: number[];
    readonly upper: number[];
    readonly samples: readonly { q: number[]; T: number[][] }[];
  }
  const folder = new URL("../../../../fixtures/urdf/", import.meta.url);
  const text = readFileSync(new URL("made-up.urdf", folder), "utf8");
  const witness = JSON.parse(readFileSync(new URL("written.json", folder), "utf8")) as Witness;

  test("the file the witness read is the one that is written today", () => {
    expect(writeUrdf(madeUpArm, { masses: madeUpMasses, side: madeUpSide })).toBe(text);
  });
  test("pinocchio's poses, limits and mass are those of the arm", () => {
    expect(witness.samples.length).toBe(40);
    for (const { q, T } of witness.samples) {
      const flange = flangePose(madeUpArm, q);
      const R = toMatrix(flange.quaternion);
      for (let r = 0; r < 3; r++) {
        expect(Math.abs(flange.position[r]! - T[r]![3]!)).toBeLessThan(1e-12);
        for (let c = 0; c < 3; c++) expect(Math.abs(R[3 * r + c]! - T[r]![c]!)).toBeLessThan(1e-12);
      }
    }
    expect(witness.lower).toEqual(madeUpArm.joints.map(({ limits }) => limits.lower_rad));
    expect(witness.upper).toEqual(madeUpArm.joints.map(({ limits }) => limits.upper_rad));
    expect(witness.mass_kg).toBeCloseTo(
      madeUpMasses.reduce((sum, { mass_kg }) => sum + mass_kg, 0),
      12,
    );
  });
});
