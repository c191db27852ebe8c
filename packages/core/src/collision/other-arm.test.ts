import { describe, expect, test } from "vitest";
import {
  CellCollider,
  checkProgram,
  compose,
  emptyProgram,
  flangePose,
  linkSolids,
  OtherArm,
  pose,
  robotAndCell,
  robotById,
  seededRandom,
  type CellGeometry,
  type Pose,
  type Program,
} from "../index.ts";

const ur = robotById("ur10e")!;
const kuka = robotById("kuka_kr6r900sixx")!;
const stand = { ...pose([1.3, 0.1, 0]), quaternion: [0, 0, 1, 0] } as Pose<"world", "base">;
const cellOf = (other: OtherArm | null): CellGeometry => ({
  worldFromBase: pose(),
  links: linkSolids(ur),
  objects: other?.objects ?? [],
  allowedPairs: [],
  shapeError_m: 0,
});

describe("another robot as obstacles", () => {
  test("law: the distance is the same from either side, wherever both stand", () => {
    const random = seededRandom(7);
    const mine = new OtherArm("mine", "mine", ur, linkSolids(ur), pose());
    const other = new OtherArm("other", "other", kuka, linkSolids(kuka), stand);
    const fromHere = new CellCollider(cellOf(other), ur.arm);
    const fromThere = new CellCollider({ ...cellOf(mine), worldFromBase: stand, links: linkSolids(kuka) }, kuka.arm);
    const jointed = ({ a, b }: { a: { name: string }; b: { name: string } }): boolean =>
      ![a.name, b.name].some(name => /(^link 0|\/0)$/.test(name));
    let near = 0;
    for (let i = 0; i < 60; i++) {
      const a = ur.home_rad.map(q => q + 3 * (random() - 0.5));
      const b = kuka.home_rad.map(q => q + 2 * (random() - 0.5));
      other.place(b, fromHere);
      mine.place(a, fromThere);
      const [here, there] = [
        fromHere.clearance(a, 0.6, undefined, pair => robotAndCell(pair) && jointed(pair)),
        fromThere.clearance(b, 0.6, undefined, pair => robotAndCell(pair) && jointed(pair)),
      ];
      if (here.distance_m < 0.6) near++;
      if (here.distance_m === Infinity) expect(there.distance_m).toBe(Infinity);
      else expect(there.distance_m).toBeCloseTo(here.distance_m, 9);
    }
    expect(near).toBeGreaterThan(20);
  });

  test("its links stand where its joints have them", () => {
    const q = kuka.home_rad.map((angle, k) => angle + 0.1 * k);
    const arm = new OtherArm("k", "Bert", kuka, linkSolids(kuka), stand, q);
    const last = arm.objects.at(-1)!;
    const worldFromFlange = compose(stand as Pose, flangePose(kuka.arm, q) as Pose);
    const seen = compose(last.worldFromObject as Pose, kuka.arm.lastJointFromFlange as Pose);
    seen.position.forEach((value, k) => {
      expect(value).toBeCloseTo(worldFromFlange.position[k]!, 12);
    });
    expect(arm.objects[0]!.name).toBe("the base of Bert");
    expect(last.name).toBe("link 6 of Bert");
  });

  test("T-63 a program that goes through another robot is found out, with its name; with that robot aside it is fine", () => {
    const program: Program = {
      ...emptyProgram(ur.id),
      steps: [0, -1.4, 0].map((q1, i) => ({
        id: `p${i}`,
        type: "move",
        path: "ptp",
        target: { q: [q1 + 0.7, -0.6, 0.9, -0.3, 1.57, 0] },
        speed: { ratio: 0.5 },
        blend_m: 0,
      })),
    };
    const verdictWith = (q: readonly number[]) =>
      checkProgram(program, ur, {
        cell: cellOf(new OtherArm("k", "Bert", kuka, linkSolids(kuka), stand, q)),
        start_rad: [0.7, -0.6, 0.9, -0.3, 1.57, 0],
      }).verdict;
    const bad = verdictWith([0, -0.6, 1.2, 0, 0.6, 0]);
    const fine = verdictWith([Math.PI, -0.6, 1.2, 0, 0.6, 0]);
    expect(bad.ok).toBe(false);
    expect(
      bad.steps
        .flatMap(({ findings }) => findings)
        .map(({ sentence }) => sentence)
        .join(" "),
    ).toContain("of Bert");
    expect(fine.steps.flatMap(({ findings }) => findings).filter(({ code }) => code.startsWith("collision"))).toEqual(
      [],
    );
  });
});
