import { describe, expect, test } from "vitest";
import {
  allBranches,
  angleBetween,
  branchOf,
  distance,
  explainReach,
  flangePose,
  identity,
  multiply,
  fromAxisAngle,
  nearestSolution,
  pose,
  robotById,
  sameBranch,
  seededRandom,
  solveAll,
  solverScratch,
  solveOrthoParallel,
  travel,
  wrapAngle,
  type OrthoParallelGeometry,
  type Pose,
  type Quaternion,
  type Reach,
} from "../index.ts";

const robot = robotById("staubli_rx90l")!;
const family = robot.family as OrthoParallelGeometry;
const reached = (reach: Reach): Extract<Reach, { kind: "reached" }> => {
  if (reach.kind !== "reached") throw new Error(explainReach(reach));
  return reach;
};
const modulo = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(a, (angle, i) => Math.abs(wrapAngle(angle - b[i]!))));

function expectSamePose(a: Pose, b: Pose, tolerance = 1e-9): void {
  expect(distance(a.position, b.position)).toBeLessThan(tolerance);
  expect(angleBetween(a.quaternion, b.quaternion)).toBeLessThan(tolerance);
}
const inLimits = (random: () => number): Float64Array =>
  Float64Array.from(
    robot.arm.joints,
    ({ limits }) => limits.lower_rad + random() * (limits.upper_rad - limits.lower_rad),
  );

describe("N-11 inverse of forward", () => {
  test("the joints one came from are among the answers, and every answer meets the pose", () => {
    const random = seededRandom(20);
    for (let n = 0; n < 2000; n++) {
      const q = inLimits(random);
      const target = flangePose(robot.arm, q);
      const { solutions } = reached(solveAll(robot, target, { near: q }));
      expect(travel(solutions[0]!.q_rad, q)).toBeLessThan(1e-6);
      for (const { q_rad, branch } of solutions) {
        expectSamePose(flangePose(robot.arm, q_rad), target);
        expect(sameBranch(branch!, branchOf(robot, q_rad)!)).toBe(true);
      }
    }
  });

  test("a required branch is kept", () => {
    const random = seededRandom(21);
    for (let n = 0; n < 200; n++) {
      const q = inLimits(random);
      const branch = branchOf(robot, q)!;
      const { solutions } = reached(solveAll(robot, flangePose(robot.arm, q), { branch }));
      expect(solutions.every(solution => sameBranch(solution.branch!, branch))).toBe(true);
      expect(solutions.some(({ q_rad }) => travel(q_rad, q) < 1e-6)).toBe(true);
    }
  });

  test("other lengths, zeros, turning senses and flanges are solved as well", () => {
    const random = seededRandom(22);
    const out = new Float64Array(48);
    const geometry: OrthoParallelGeometry = {
      kind: "ortho-parallel",
      a1_m: 0.15,
      a2_m: -0.04,
      b_m: 0.03,
      c1_m: 0.5,
      c2_m: 0.6,
      c3_m: 0.7,
      c4_m: 0.1,
      offsets_rad: [0.3, -1.2, 0.4, 2, 0, Math.PI],
      signs: [-1, 1, 1, -1, 1, -1],
      formulaFromFlange: pose([0.01, -0.02, 0.03], fromAxisAngle([0, 1, 0], 0.7)),
    };
    for (let n = 0; n < 500; n++) {
      const q = Array.from({ length: 6 }, () => (random() - 0.5) * 6);
      const count = solveOrthoParallel(geometry, formulaByHand(geometry, q), out);
      const found = Array.from({ length: count }, (_, i) => out.subarray(6 * i, 6 * i + 6));
      expect(Math.min(...found.map(candidate => modulo(candidate, q)))).toBeLessThan(1e-6);
      for (const candidate of found) expectSamePose(formulaByHand(geometry, candidate), formulaByHand(geometry, q));
    }
  });
});

/** The formula as a product of elementary turns and moves, independent of the solver and of the arm description. */
function formulaByHand(g: OrthoParallelGeometry, q: ArrayLike<number>): Pose {
  const t = Array.from(q, (angle, i) => g.signs[i]! * angle - g.offsets_rad[i]!);
  const about = (axis: "y" | "z", angle: number): Quaternion =>
    fromAxisAngle(axis === "y" ? [0, 1, 0] : [0, 0, 1], angle);
  let turn = about("z", t[0]!);
  const at: [number, number, number] = [0, 0, 0];
  const move = (x: number, y: number, z: number): void => {
    const moved = multiply(multiply(turn, [x, y, z, 0]), [-turn[0], -turn[1], -turn[2], turn[3]]);
    for (let i = 0; i < 3; i++) at[i]! += moved[i]!;
  };
  move(g.a1_m, g.b_m, g.c1_m);
  turn = multiply(turn, about("y", t[1]!));
  move(0, 0, g.c2_m);
  turn = multiply(turn, about("y", t[2]!));
  move(g.a2_m, 0, g.c3_m);
  turn = multiply(turn, about("z", t[3]!));
  turn = multiply(turn, about("y", t[4]!));
  turn = multiply(turn, about("z", t[5]!));
  move(0, 0, g.c4_m);
  move(...g.formulaFromFlange.position);
  return pose(at, multiply(turn, g.formulaFromFlange.quaternion));
}

describe("N-16 least total travel", () => {
  test("agrees with brute force over branches and turns", () => {
    const random = seededRandom(23);
    const out = new Float64Array(6);
    const scratch = solverScratch();
    for (let n = 0; n < 300; n++) {
      const target = flangePose(robot.arm, inLimits(random));
      const start = inLimits(random);
      let least = Infinity;
      for (const q of allBranches(robot, target)) {
        let total = 0;
        for (let j = 0; j < 6; j++) {
          const { lower_rad, upper_rad } = robot.arm.joints[j]!.limits;
          total += Math.min(
            ...[-2, -1, 0, 1, 2]
              .map(turns => q[j]! + 2 * Math.PI * turns)
              .filter(angle => angle >= lower_rad && angle <= upper_rad)
              .map(angle => Math.abs(angle - start[j]!)),
            Infinity,
          );
        }
        least = Math.min(least, total);
      }
      expect(travel(reached(solveAll(robot, target, { near: start })).solutions[0]!.q_rad, start)).toBeCloseTo(
        least,
        9,
      );
      expect(nearestSolution(robot, target, start, out, scratch)).toBe(true);
      expect(travel(out, start)).toBeCloseTo(least, 9);
    }
  });

  test("E-06 there are at most eight distinct branches, never 96", () => {
    const random = seededRandom(24);
    for (let n = 0; n < 300; n++)
      expect(allBranches(robot, flangePose(robot.arm, inLimits(random))).length).toBeLessThanOrEqual(8);
  });
});

describe("N-18 singularities", () => {
  const straightWrist = [0.3, -1.1, 1.4, 0.9, 0, -0.4];
  const onAxis = (theta1: number): number[] => {
    // The wrist centre on axis 1: 0.45 sin θ2 + 0.65 sin(θ2 + θ3) = 0 in the formula's zero.
    const theta2 = -0.8;
    const theta23 = Math.asin((-0.45 * Math.sin(theta2)) / 0.65);
    return [theta1, theta2 - Math.PI / 2, theta23 - theta2 + Math.PI / 2, 0.4, 0.7, 0.1];
  };

  test("without near, θ4 is 0 at θ5 = 0 and nothing is NaN", () => {
    const reach = reached(solveAll(robot, flangePose(robot.arm, straightWrist)));
    expect(reach.singular).toBe(true);
    const straight = reach.solutions.filter(({ q_rad }) => Math.abs(q_rad[4]!) < 1e-9);
    expect(straight.length).toBeGreaterThan(0);
    for (const { q_rad } of straight) expect(q_rad[3]! % (2 * Math.PI)).toBeCloseTo(0, 12);
    for (const { q_rad } of reach.solutions) expect(q_rad.every(Number.isFinite)).toBe(true);
  });
  test("with near, θ4 stays and θ6 takes the rest", () => {
    const target = flangePose(robot.arm, straightWrist);
    const near = straightWrist.with(3, 1.3).with(5, -0.7);
    const { q_rad } = reached(solveAll(robot, target, { near })).solutions[0]!;
    expect(q_rad[3]).toBeCloseTo(1.3, 12);
    expect(q_rad[5]).toBeCloseTo(-0.8, 9);
  });
  test("with the wrist centre on axis 1, θ1 stays where near has it, or is 0", () => {
    const target = flangePose(robot.arm, onAxis(0.6));
    const kept = reached(solveAll(robot, target, { near: onAxis(0.6) })).solutions[0]!;
    expect(travel(kept.q_rad, onAxis(0.6))).toBeLessThan(1e-6);
    expect(reached(solveAll(robot, target)).solutions.some(({ q_rad }) => Math.abs(q_rad[0]!) < 1e-12)).toBe(true);
  });
  test("close to a singularity every answer still meets the pose to 1e-9", () => {
    for (const bend of [1e-3, 1e-5, 1e-7, 1e-8, 1e-9, 1e-10, 1e-12, 1e-16]) {
      for (const q of [
        straightWrist.with(4, bend),
        straightWrist.with(4, -bend),
        onAxis(0.6).with(1, onAxis(0)[1]! + bend),
        [0, -Math.PI / 2, Math.PI / 2 + bend, 0, bend, 0],
      ]) {
        const target = flangePose(robot.arm, q);
        const { solutions } = reached(solveAll(robot, target, { near: q }));
        for (const { q_rad } of solutions) expectSamePose(flangePose(robot.arm, q_rad), target);
        expect(travel(solutions[0]!.q_rad, q)).toBeLessThan(1e-5);
      }
    }
  });
});

describe("why a pose cannot be reached", () => {
  test("beyond the stretched arm and inside the folded one, with the distance", () => {
    expect(solveAll(robot, pose([0, 0, 0.42 + 1.1 + 0.085 + 0.25]))).toMatchObject({
      kind: "too-far",
      beyond_m: expect.closeTo(0.25, 9),
      reach_m: 1.1,
    });
    expect(solveAll(robot, pose([0, 0, 0.42 + 0.15 + 0.085]))).toMatchObject({
      kind: "too-near",
      inside_m: expect.closeTo(0.05, 9),
      nearest_m: expect.closeTo(0.2, 9),
    });
    expect(solveAll(robot, pose([0, 0, 0.42 + 1.1 + 0.085 + 1e-6])).kind).toBe("too-far");
    expect(solveAll(robot, pose([0, 0, 0.42 + 1.1 + 0.085 + 1e-13])).kind).toBe("reached");
  });
  test("the joint that would leave its limits, of the branch that comes closest", () => {
    const stuck = solveAll(robot, flangePose(robot.arm, [3, -1, 2, 0, 0.5, 0]), {
      branch: { shoulder: "front", elbow: "up", wrist: "positive" },
    });
    expect(stuck).toMatchObject({
      kind: "outside-limits",
      joint: 1,
      wanted_rad: expect.closeTo(3, 6),
      limit_rad: expect.closeTo((160 * Math.PI) / 180, 9),
    });
    expect(explainReach(stuck)).toBe("Joint 1 would turn to 171.9°; its limit is 160.0°.");
  });
  test("numbers that are no pose are named, and near angles that are no numbers give no NaN", () => {
    expect(solveAll(robot, pose([NaN, 0, 0])).kind).toBe("not-a-pose");
    expect(solveAll(robot, pose([Infinity, 0, 0])).kind).toBe("not-a-pose");
    expect(solveAll(robot, pose([0.5, 0, 0.5], [0, 0, 0, 0])).kind).toBe("not-a-pose");
    expect(solveAll(robot, pose([0.5, 0, 0.5], [NaN, 0, 0, 1])).kind).toBe("not-a-pose");
    const home = flangePose(robot.arm, robot.home_rad);
    const out = Float64Array.from(robot.home_rad);
    for (const wild of [NaN, Infinity, -Infinity]) {
      expect(nearestSolution(robot, home, [wild, wild, wild, wild, wild, wild], out)).toBe(false);
      expect(nearestSolution(robot, pose([wild, 0, 1]), robot.home_rad, out)).toBe(false);
    }
    expect([...out]).toEqual([...robot.home_rad]);
  });
  test("an arm of another family has no solver and says so", () => {
    const general = { ...robot, family: { kind: "general" } as const };
    expect(solveAll(general, identity()).kind).toBe("no-solver");
    expect(allBranches(general, identity())).toEqual([]);
  });
});

test("one solver call fills only what it counts", () => {
  const out = new Float64Array(48).fill(7);
  const count = solveOrthoParallel(family, flangePose(robot.arm, [0.4, -1, 1.2, 0.3, 0.6, 0.2]), out);
  expect(count).toBe(8);
  out.fill(7);
  expect(solveOrthoParallel(family, pose([0, 0, 3]), out)).toBe(0);
  expect(out.every(value => value === 7)).toBe(true);
});
