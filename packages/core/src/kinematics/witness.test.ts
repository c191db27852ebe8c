import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import {
  allBranches,
  angleBetween,
  distance,
  explainReach,
  flangePose,
  fromMatrix,
  identity,
  nearestSolution,
  pose,
  robotById,
  seededRandom,
  solveAll,
  solverScratch,
  travel,
  wrapAngle,
  type Pose,
} from "../index.ts";

const robot = robotById("staubli_rx90l")!;
const read = (name: string): unknown =>
  JSON.parse(readFileSync(new URL(`../../../../fixtures/kinematics/${name}`, import.meta.url), "utf8"));
const forward = read("staubli_rx90l.forward.json") as {
  near_singular: { q: number[]; T: number[][]; type: string; delta_rad: number }[];
};
const inverse = read("staubli_rx90l.inverse.json") as {
  poses: { T: number[][]; seed_q: number[]; solutions: number[][] }[];
};
const poseOf = (T: number[][]): Pose<"base", "flange"> =>
  pose([T[0]![3]!, T[1]![3]!, T[2]![3]!], fromMatrix(T.slice(0, 3).flatMap(row => row.slice(0, 3))));
const limits = robot.arm.joints.map(joint => joint.limits);
const inside = (q: ArrayLike<number>): boolean =>
  limits.every(({ lower_rad, upper_rad }, j) => q[j]! >= lower_rad - 1e-9 && q[j]! <= upper_rad + 1e-9);
const anyAngles = (random: () => number): Float64Array =>
  Float64Array.from(limits, ({ lower_rad, upper_rad }) => lower_rad + (upper_rad - lower_rad) * random());
const missBy = (q: Float64Array, wanted: Pose): number => {
  const got = flangePose(robot.arm, q);
  return Math.max(distance(got.position, wanted.position), angleBetween(got.quaternion, wanted.quaternion));
};

test("N-11 ten thousand round trips, seed 11: FK of every solution is the pose, the way there among them", () => {
  const random = seededRandom(11);
  const scratch = solverScratch();
  let worst = 0;
  for (let n = 0; n < 10_000; n++) {
    const q = anyAngles(random);
    const baseFromFlange = flangePose(robot.arm, q);
    const found = allBranches(robot, baseFromFlange, undefined, scratch);
    for (const solution of found) worst = Math.max(worst, missBy(solution, baseFromFlange));
    expect(found.some(solution => solution.every((angle, j) => Math.abs(wrapAngle(angle - q[j]!)) < 1e-6))).toBe(true);
  }
  expect(worst).toBeLessThan(1e-9);
});

test("N-11, N-18 poses at and near every singularity round trip, with and without a neighbour", () => {
  expect(forward.near_singular.length).toBe(20);
  for (const { q, T } of forward.near_singular) {
    const wanted = poseOf(T);
    for (const near of [undefined, q]) {
      const found = allBranches(robot, wanted, near);
      expect(found.length).toBeGreaterThan(0);
      for (const solution of found) expect(missBy(solution, wanted)).toBeLessThan(1e-9);
    }
    const out = new Float64Array(6);
    expect(nearestSolution(robot, wanted, q, out)).toBe(true);
    expect(missBy(out, wanted)).toBeLessThan(2e-9);
    // Joint angles are as good as the singularity lets them be: a pose of 1e-15 tells an elbow 1e-7 apart.
    expect(travel(out, q)).toBeLessThan(1e-4);
  }
});

test("N-15, N-16 least total travel agrees with brute force over all turns of the reference's solutions", () => {
  const random = seededRandom(16);
  let many = 0;
  for (const { T, solutions, seed_q } of inverse.poses) {
    const near =
      random() < 0.5 ? anyAngles(random) : Float64Array.from(seed_q, angle => angle + 0.2 * (random() - 0.5));
    let least = Infinity;
    let count = 0;
    for (const solution of solutions) {
      for (let code = 0; code < 3 ** 6; code++) {
        const q = solution.map((angle, j) => angle + 2 * Math.PI * ((Math.trunc(code / 3 ** j) % 3) - 1));
        if (!inside(q)) continue;
        count++;
        least = Math.min(least, travel(q, near));
      }
    }
    const reach = solveAll(robot, poseOf(T), { near });
    if (reach.kind !== "reached") throw new Error(explainReach(reach));
    expect(reach.solutions.length).toBe(count);
    expect(reach.solutions.every(({ q_rad }) => inside(q_rad))).toBe(true);
    expect(travel(reach.solutions[0]!.q_rad, near)).toBeCloseTo(least, 8);
    const out = new Float64Array(6);
    expect(nearestSolution(robot, poseOf(T), near, out)).toBe(true);
    expect(travel(out, near)).toBeCloseTo(least, 8);
    if (count > 8) many++;
  }
  expect(many).toBeGreaterThan(20); // whole turns matter
});

test("N-17 solving takes a small part of a frame", () => {
  const random = seededRandom(17);
  const poses = Array.from({ length: 500 }, () => flangePose(robot.arm, anyAngles(random)));
  const near = Float64Array.from(robot.home_rad);
  const out = new Float64Array(6);
  const scratch = solverScratch();
  for (const wanted of poses) nearestSolution(robot, wanted, near, out, scratch);
  const began = performance.now();
  for (const wanted of poses) nearestSolution(robot, wanted, near, out, scratch);
  expect((performance.now() - began) / poses.length).toBeLessThan(0.5); // ms; a frame has 16
});

test("nothing is ever NaN: no number in, no number out; a pose that is none is refused in words", () => {
  for (const bad of [
    pose([NaN, 0, 0]),
    pose([0, Infinity, 0]),
    pose([0.5, 0, 0.8], [0, 0, 0, 0]),
    pose([0.5, 0, 0.8], [NaN, 0, 0, 1]),
  ]) {
    const reach = solveAll(robot, bad as Pose<"base", "flange">);
    const out = Float64Array.of(1, 2, 3, 4, 5, 6);
    expect(reach.kind).toBe("not-a-pose");
    expect(explainReach(reach)).toMatch(/[a-z].*\.$/);
    expect(nearestSolution(robot, bad as Pose<"base", "flange">, robot.home_rad, out)).toBe(false);
    expect([...out]).toEqual([1, 2, 3, 4, 5, 6]);
  }
  const random = seededRandom(5);
  const scratch = solverScratch();
  for (let n = 0; n < 2000; n++) {
    const wanted = flangePose(
      robot.arm,
      Float64Array.from({ length: 6 }, () => ((Math.trunc(random() * 9) - 4) * Math.PI) / 4),
      identity(),
      scratch.arm,
    );
    for (const solution of allBranches(robot, wanted, undefined, scratch))
      expect(solution.every(Number.isFinite)).toBe(true);
  }
});
