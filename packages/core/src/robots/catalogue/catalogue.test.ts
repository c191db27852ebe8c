import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import {
  angleBetween,
  CATALOGUE,
  catalogueRobot,
  distance,
  flangePose,
  fromMatrix,
  identity,
  LIBRARY,
  linkPoses,
  robotById,
  rotate,
  seededRandom,
  solveAll,
  solverScratch,
  type Random,
  type Robot,
} from "../../index.ts";

interface Witnessed {
  readonly joints: readonly string[];
  readonly samples: readonly { readonly q: readonly number[]; readonly T: readonly (readonly number[])[] }[];
}
/** Witness: pinocchio on the descriptions expanded by xacro (scripts/catalogue/witness.py). Units m, rad. */
const WITNESS = JSON.parse(
  readFileSync(new URL("../../../../../fixtures/kinematics/catalogue-fk.json", import.meta.url), "utf8"),
) as { readonly robots: Readonly<Record<string, Witnessed>> };
const ENTRIES = CATALOGUE.flatMap(({ vendor, robots }) => robots.map(entry => ({ ...entry, vendor })));
/** Bytes that the catalogue may add to what the studio loads. */
const MOST_BYTES = 60_000;
const STARTS = 12;

const randomWithin = ({ arm }: Robot, random: Random): number[] =>
  arm.joints.map(({ limits: { lower_rad, upper_rad } }) => lower_rad + random() * (upper_rad - lower_rad));

/** From axis 1 (from the shoulder, of an arm that is not ortho-parallel) to the wrist centre or to the flange [m]. */
function lengthOf(robot: Robot): (q_rad: readonly number[]) => number {
  const links = Array.from({ length: robot.arm.joints.length + 1 }, () => identity<"base", "link">());
  const flange = identity<"base", "flange">();
  return q_rad => {
    linkPoses(robot.arm, q_rad, links);
    flangePose(robot.arm, q_rad, flange);
    const end = robot.reachMeasuredTo === "flange" ? flange.position : links[5]!.position;
    return robot.family.kind === "ortho-parallel" ? Math.hypot(end[0], end[1]) : distance(end, links[2]!.position);
  };
}

/** The greatest of these lengths within the limits: hill climbing, joint by joint, from seeded starts. */
function farthest_m(robot: Robot): number {
  const random = seededRandom(1);
  const lengthAt = lengthOf(robot);
  let best = 0;
  for (let start = 0; start < STARTS; start++) {
    let q: readonly number[] = randomWithin(robot, random);
    let length = lengthAt(q);
    for (let step_rad = 0.5; step_rad > 1e-4; ) {
      let isBetter = false;
      for (const [j, { limits }] of robot.arm.joints.entries())
        for (const turn_rad of [step_rad, -step_rad]) {
          const next = q.with(j, Math.min(limits.upper_rad, Math.max(limits.lower_rad, q[j]! + turn_rad)));
          const found = lengthAt(next);
          if (found <= length + 1e-9) continue;
          q = next;
          length = found;
          isBetter = true;
        }
      if (!isBetter) step_rad /= 2;
    }
    best = Math.max(best, length);
  }
  return best;
}

describe("the catalogue", () => {
  test("at least 60 arms of at least 14 makers, each with an id of its own, each found by robotById", () => {
    expect(ENTRIES.length).toBeGreaterThanOrEqual(60);
    expect(CATALOGUE.length).toBeGreaterThanOrEqual(14);
    const ids = [...LIBRARY.map(({ id }) => id), ...ENTRIES.map(({ id }) => id)];
    expect(new Set(ids).size).toBe(ids.length);
    for (const { id, vendor } of ENTRIES) expect(robotById(id)).toMatchObject({ id, vendor });
    expect(robotById("ur5e")).toBe(catalogueRobot("ur5e"));
    expect(robotById("no_such_robot")).toBeUndefined();
  });

  test(`its data are no more than ${MOST_BYTES} bytes`, () => {
    expect(new TextEncoder().encode(JSON.stringify(CATALOGUE)).length).toBeLessThanOrEqual(MOST_BYTES);
  });

  test("the witness knows every arm of the catalogue and no other", () => {
    expect(Object.keys(WITNESS.robots).toSorted()).toEqual(ENTRIES.map(({ id }) => id).toSorted());
  });
});

describe.each(ENTRIES.map(entry => [entry.id, entry] as const))("%s", (id, entry) => {
  const robot = catalogueRobot(id)!;

  test("forward kinematics meets the witness to 1e-9 m and 1e-9 rad, joint names included", () => {
    const { joints, samples } = WITNESS.robots[id]!;
    expect(robot.arm.joints.map(({ name }) => name)).toEqual(joints);
    expect(samples.length).toBe(5);
    for (const { q, T } of samples) {
      const got = flangePose(robot.arm, q);
      expect(distance(got.position, [T[0]![3]!, T[1]![3]!, T[2]![3]!])).toBeLessThan(1e-9);
      expect(angleBetween(got.quaternion, fromMatrix(T.flatMap(row => row.slice(0, 3))))).toBeLessThan(1e-9);
    }
  });

  test("limits, speeds and home are sane, sources and assumptions are said", () => {
    robot.arm.joints.forEach(({ limits, axis }, j) => {
      expect(limits.lower_rad).toBeLessThan(limits.upper_rad);
      expect(Math.max(-limits.lower_rad, limits.upper_rad)).toBeLessThanOrEqual(4 * Math.PI);
      expect(limits.speed_rad_s).toBeGreaterThan(0.5);
      expect(limits.speed_rad_s).toBeLessThan(30);
      expect(Math.hypot(...axis)).toBeCloseTo(1, 12);
      expect(robot.home_rad[j]).toBeGreaterThanOrEqual(limits.lower_rad);
      expect(robot.home_rad[j]).toBeLessThanOrEqual(limits.upper_rad);
    });
    expect(robot.payload_kg).toBeGreaterThan(0);
    expect(robot.sources["lengths, limits, speeds"]).toContain(entry.repository);
    expect(robot.sources["lengths, limits, speeds"]).toMatch(/(Apache|BSD|MIT).*commit [0-9a-f]{7}/);
    expect(robot.assumptions.length).toBeGreaterThan(0);
  });

  test("the stated reach is what the links give: within 2.5 %; a working radius, which no maker defines, within 25 %", () => {
    const got_m = farthest_m(robot);
    const slack = entry.reach_to === "radius" ? 0.25 : 0.025;
    const said = `stated ${robot.reach_m} m, computed ${got_m.toFixed(3)} m`;
    expect(Math.abs(got_m / robot.reach_m - 1), said).toBeLessThan(slack);
  });

  test("poses of random postures come back through the inverse to 1e-9; a closed form finds the posture itself", () => {
    const random = seededRandom(7);
    const scratch = solverScratch();
    const isClosed = robot.family.kind !== "general";
    for (let round = 0; round < (isClosed ? 20 : 3); round++) {
      const q = randomWithin(robot, random);
      const wanted = flangePose(robot.arm, q);
      const reach = solveAll(robot, wanted, { near: q }, scratch);
      if (reach.kind !== "reached") throw new Error(`round ${round}: ${reach.kind}`);
      for (const { q_rad } of reach.solutions) {
        const got = flangePose(robot.arm, q_rad);
        expect(distance(got.position, wanted.position)).toBeLessThan(1e-9);
        expect(angleBetween(got.quaternion, wanted.quaternion)).toBeLessThan(1e-9);
      }
      if (!isClosed) continue;
      const off = [...reach.solutions[0]!.q_rad].map((angle, j) => Math.abs(angle - q[j]!));
      expect(Math.max(...off)).toBeLessThan(1e-5);
    }
  });

  test("at home the tool of an arm with a closed form does not look up", () => {
    if (robot.family.kind === "general") return;
    expect(rotate(flangePose(robot.arm, robot.home_rad).quaternion, [0, 0, 1])[2]).toBeLessThan(0.01);
  });
});
