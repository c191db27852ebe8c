import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import {
  angleBetween,
  cross,
  norm,
  subtract,
  addCatalogue,
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
import { CATALOGUE } from "./makers.ts";

addCatalogue(CATALOGUE);

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

/**
 * Square from axis 1 (from axis 2, of an arm with a closed form that is not ortho-parallel) to the wrist; of others
 * from joint 2 to the flange [m].
 */
function lengthOf({ arm, family, reachMeasuredTo }: Robot): (q_rad: readonly number[]) => number {
  const links = Array.from({ length: arm.joints.length + 1 }, () => identity<"base", "link">());
  const flange = identity<"base", "flange">();
  const second = arm.joints[1]!.axis;
  return q_rad => {
    linkPoses(arm, q_rad, links);
    flangePose(arm, q_rad, flange);
    const end = reachMeasuredTo === "flange" ? flange.position : links[5]!.position;
    if (family.kind === "ortho-parallel") return Math.hypot(end[0], end[1]);
    const from = subtract(end, links[2]!.position);
    if (family.kind === "general" || family.kind === "spherical-seven") return norm(from);
    return norm(cross(from, rotate(links[2]!.quaternion, second)));
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
    expect(robot.sources["lengths, limits, speeds"]).toContain(entry.repository);
    expect(robot.sources["lengths, limits, speeds"]).toMatch(/(Apache|BSD|MIT).*commit [0-9a-f]{7}/);
    expect(robot.assumptions.length).toBeGreaterThan(0);
  });

  test("the payload stands there with its source or is unknown; mass and repeatability, for which there is none, are unknown", () => {
    expect(robot.payload_kg).toBe(entry.payload?.kg);
    expect(robot.payloadMax_kg).toBe(entry.payload?.kg);
    expect(robot.sources.payload !== undefined).toBe(entry.payload !== undefined);
    const unstated = robot.assumptions.some(sentence => sentence.startsWith("The payload is not stated"));
    expect(unstated).toBe(entry.payload === undefined);
    // Where the name is the source, the number can be read in it; Doosan writes it in two digits.
    if (entry.payload?.from === "designation")
      expect(entry.name).toMatch(new RegExp(`(?<![1-9])${entry.payload.kg}(?!\\.)`));
    expect(robot).not.toHaveProperty("mass_kg");
    expect(robot).not.toHaveProperty("repeatability_m");
    expect(robot.sources.reach).toMatch(/^Computed/);
    expect(robot.assumptions.join(" ")).toContain(`${Math.round(1000 * robot.reach_m)} mm`);
    expect(robot.unverified === true).toBe(!(id in WITNESS.robots));
  });

  test("the reach said to be computed is within 2.5 % of what a search within the limits finds; of an arm without closed form not below it", () => {
    const got_m = farthest_m(robot);
    const said = `stated ${robot.reach_m} m, found ${got_m.toFixed(3)} m`;
    expect(got_m / robot.reach_m, said).toBeLessThan(robot.family.kind === "general" ? 1 : 1.025);
    if (robot.family.kind !== "general") expect(got_m / robot.reach_m, said).toBeGreaterThan(0.975);
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
