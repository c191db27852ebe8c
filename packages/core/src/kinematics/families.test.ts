import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import {
  allBranches,
  angleBetween,
  branchOf,
  compose,
  distance,
  elbowIntervals,
  elbowOf,
  explainReach,
  familyOf,
  flangePose,
  fromAxisAngle,
  fromMatrix,
  fromEulerAngles,
  generalSixFlange,
  minSingularValue,
  nearestSolution,
  pose,
  robotById,
  robotFromArm,
  sameBranch,
  seededRandom,
  solveAll,
  solverScratch,
  solveThreeParallel,
  sphericalSevenFlange,
  threeParallelFlange,
  travel,
  wrapAngle,
  type Joint,
  type Pose,
  type Random,
  type Reach,
  type Robot,
  type SerialArm,
  type Vector3,
} from "../index.ts";

const read = (name: string): unknown =>
  JSON.parse(readFileSync(new URL(`../../../../fixtures/kinematics/${name}`, import.meta.url), "utf8"));
const poseOf = (T: number[][]): Pose<"base", "flange"> =>
  pose([T[0]![3]!, T[1]![3]!, T[2]![3]!], fromMatrix(T.slice(0, 3).flatMap(row => row.slice(0, 3))));
const apart = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(a, (angle, j) => Math.abs(wrapAngle(angle - b[j]!))));
const gap = (a: Pose, b: Pose): number =>
  Math.max(distance(a.position, b.position), angleBetween(a.quaternion, b.quaternion));
const inLimits = (robot: Robot, random: Random): Float64Array =>
  Float64Array.from(
    robot.arm.joints,
    ({ limits: { lower_rad, upper_rad } }) => lower_rad + random() * (upper_rad - lower_rad),
  );

const ur10e = robotById("ur10e")!;
const gofa = robotById("abb_crb15000_5_95")!;
const iiwa = robotById("kuka_lbr_iiwa_14_r820")!;
/** The iiwa as its drawing has it, without the sideways steps of 0.436 mm. */
const straight = robotFromArm({
  ...iiwa.arm,
  joints: iiwa.arm.joints.map(joint => ({
    ...joint,
    parentFromJoint: pose<"parent", "joint">([0, 0, joint.parentFromJoint.position[2]]),
  })),
});

test("every library robot without spherical six-joint wrist has its family", () => {
  expect([ur10e, gofa, iiwa, straight].map(({ family }) => family.kind)).toEqual([
    "three-parallel",
    "general-6r",
    "spherical-seven",
    "spherical-seven",
  ]);
  if (iiwa.family.kind !== "spherical-seven" || straight.family.kind !== "spherical-seven") return;
  expect(straight.family.deviation_m).toBe(0);
  expect(iiwa.family.deviation_m).toBeGreaterThan(4e-4);
  expect(iiwa.family.deviation_m).toBeLessThan(1e-3);
});

/**
 * Witness: EAIK for the UR10e, 500-start Newton on pinocchio for the GoFa (a lower bound); both verified by pinocchio.
 */
describe.each([
  [ur10e, "ur10e.inverse.json"],
  [gofa, "abb_crb15000.inverse.json"],
] as const)("N-11 $name", (robot, file) => {
  const { poses } = read(file) as { poses: { T: number[][]; solutions: number[][] }[] };
  test("every solution of the reference is found to 1e-9 and none is invented", () => {
    expect(poses.length).toBeGreaterThanOrEqual(40);
    const scratch = solverScratch();
    for (const { T, solutions } of poses) {
      const wanted = poseOf(T);
      const got = allBranches(robot, wanted, undefined, scratch);
      for (const q of got) expect(gap(flangePose(robot.arm, q), wanted)).toBeLessThan(1e-9);
      expect(got.length).toBe(solutions.length);
      for (const solution of solutions) {
        const nearest = got.toSorted((a, b) => apart(a, solution) - apart(b, solution))[0]!;
        // The matrices carry 15 digits: nearer to a singularity the angles carry fewer.
        expect(apart(nearest, solution)).toBeLessThan(1e-9 + 3e-14 / minSingularValue(robot.arm, solution) ** 2);
      }
    }
  });
});

test("N-10 forward kinematics of the iiwa agrees with the reference to 1e-9", () => {
  const { samples } = read("kuka_lbr_iiwa14.forward.json") as { samples: { q: number[]; T: number[][] }[] };
  expect(samples.length).toBe(120);
  for (const { q, T } of samples) {
    const { position, quaternion } = flangePose(iiwa.arm, q);
    const wanted = poseOf(T);
    const sign = Math.sign(quaternion.reduce((sum, value, i) => sum + value * wanted.quaternion[i]!, 0));
    expect(
      Math.max(
        distance(position, wanted.position),
        ...quaternion.map((value, i) => Math.abs(value - sign * wanted.quaternion[i]!)),
      ),
    ).toBeLessThan(1e-9);
  }
});

describe("L-21, M-43 the joints one came from are among the answers, every answer meets the pose, its branch is its own", () => {
  const cases: readonly (readonly [string, Robot, number, (q: ArrayLike<number>) => boolean])[] = [
    ["three-parallel", ur10e, 1500, () => true],
    ["spherical-seven, as drawn", straight, 800, () => true],
    // Within this band of a stretched elbow or upright shoulder the steps of 0.436 mm decide which postures exist at
    // all.
    [
      "spherical-seven, with sideways steps",
      iiwa,
      400,
      q =>
        Math.abs(Math.sin(q[3]!)) > 0.02 &&
        Math.abs(Math.sin(q[1]!)) > 2e-3 &&
        Math.max(Math.abs(Math.sin(q[1]!)), Math.abs(Math.sin(q[3]!))) > 0.1,
    ],
    ["general-6r", gofa, 300, q => minSingularValue(gofa.arm, q) > 1e-3],
  ];
  test.each(cases)("%s, seed 21", (_, robot, count, outsideBand) => {
    const random = seededRandom(21);
    const scratch = solverScratch();
    let tried = 0;
    for (let n = 0; n < count; n++) {
      const q = inLimits(robot, random);
      const wanted = flangePose(robot.arm, q);
      if (!outsideBand(q)) continue;
      tried++;
      const elbow = elbowOf(robot, q);
      const found = allBranches(robot, wanted, undefined, scratch, elbow);
      expect(found.some(solution => apart(solution, q) < 1e-5)).toBe(true);
      for (const solution of found) {
        expect(gap(flangePose(robot.arm, solution), wanted)).toBeLessThan(1e-9);
        expect(solution.every(angle => angle > -Math.PI && angle <= Math.PI)).toBe(true);
        if (elbow !== undefined) expect(Math.abs(wrapAngle(elbowOf(robot, solution)! - elbow))).toBeLessThan(1e-9);
      }
      const names = found.map(solution => branchOf(robot, solution)!);
      expect(names.some(name => sameBranch(name, branchOf(robot, q)!))).toBe(true);
      if (robot.family.kind !== "general-6r")
        for (const [i, name] of names.entries()) expect(names.findIndex(other => sameBranch(other, name))).toBe(i);
    }
    expect(tried).toBeGreaterThan(0.95 * count);
  });
});

describe("N-16, N-25 near", () => {
  test.each([ur10e, gofa, iiwa])(
    "$name: the nearest solution is the first of all and is followed along a path without a jump",
    robot => {
      const random = seededRandom(16);
      const scratch = solverScratch();
      const n = robot.arm.joints.length;
      const out = new Float64Array(n);
      for (let k = 0; k < 30; k++) {
        const q = inLimits(robot, random).map(angle => 0.9 * angle);
        const start = q.map(angle => angle + 0.02 * (random() - 0.5));
        if (minSingularValue(robot.arm, q) < 0.05 || (n === 7 && Math.abs(Math.sin(q[1]!)) < 0.2)) continue;
        const wanted = flangePose(robot.arm, q);
        const reach = solveAll(robot, wanted, { near: start }, scratch);
        expect(nearestSolution(robot, wanted, start, out, scratch)).toBe(true);
        expect(gap(flangePose(robot.arm, out), wanted)).toBeLessThan(1e-9);
        if (reach.kind === "beyond-workspace") continue;
        if (reach.kind !== "reached") throw new Error(explainReach(reach));
        expect(travel(reach.solutions[0]!.q_rad, out)).toBeLessThan(1e-6);
        expect(travel(out, start)).toBeLessThan(1);
        if (n === 7) expect(Math.abs(wrapAngle(elbowOf(robot, out)! - elbowOf(robot, start)!))).toBeLessThan(1e-9);
      }
    },
  );
});

describe("N-18 singular directions of the three-parallel arm", () => {
  const general = [0.4, -1.1, 1.3, -0.6, 0.8, 0.2];
  const cases: readonly (readonly [string, number[]])[] = [
    ["axes 4 and 6 parallel", general.with(4, 0)],
    ["axes 4 and 6 against each other", general.with(4, Math.PI)],
    ["stretched", general.with(2, 0)],
    ["all angles 0", [0, 0, 0, 0, 0, 0]],
    ["upright", [0, -Math.PI / 2, 0, -Math.PI / 2, 0, 0]],
    ["stretched and straight", [0.3, -0.4, 0, 0.7, 0, 0.1]],
  ];
  test.each(cases)("%s: with and without near every answer meets the pose, and near is kept", (_, q) => {
    for (const away of [0, 1e-16, 1e-12, 1e-10, 3e-9, 1e-7, 1e-5, 1e-3]) {
      const at = q.with(4, q[4]! + away).with(2, q[2]! + away);
      const wanted = flangePose(ur10e.arm, at);
      const found = [...allBranches(ur10e, wanted), ...allBranches(ur10e, wanted, at)];
      expect(found.length).toBeGreaterThan(1);
      for (const solution of found) {
        expect(solution.every(Number.isFinite)).toBe(true);
        expect(gap(flangePose(ur10e.arm, solution), wanted)).toBeLessThan(1e-9);
      }
      const out = new Float64Array(6);
      expect(nearestSolution(ur10e, wanted, at, out)).toBe(true);
      expect(travel(out, at)).toBeLessThan(2e-3);
    }
  });
  test("with near the free joint stays and the others take the rest", () => {
    const near = general.with(5, 0.1);
    const { solutions } = solveAll(ur10e, flangePose(ur10e.arm, general.with(4, 0)), { near }) as Extract<
      Reach,
      { kind: "reached" }
    >;
    expect(solutions[0]!.q_rad[5]).toBeCloseTo(0.1, 9);
    expect(
      allBranches(ur10e, flangePose(ur10e.arm, general.with(4, 0))).some(solution => Math.abs(solution[5]!) < 1e-9),
    ).toBe(true);
    // θ5 = π, where the file's rounding of four right angles adds up to 8e-10: by the formula itself.
    const { family } = ur10e;
    const out = new Float64Array(48);
    if (family.kind !== "three-parallel") return;
    const turned = threeParallelFlange(family, general.with(4, Math.PI));
    const count = solveThreeParallel(family, turned, out, near);
    const found = Array.from({ length: count }, (_, s) => out.subarray(6 * s, 6 * s + 6));
    expect(found.filter(q => Math.abs(q[5]! - 0.1) < 1e-9).length).toBeGreaterThan(0);
    for (const q of found) expect(gap(threeParallelFlange(family, q), turned)).toBeLessThan(1e-9);
  });
  test("where θ6 at 0 leaves the reach another θ6 is taken", () => {
    const q = [0.4, -1.1, 0.05, 0, 0, 2.5];
    const wanted = flangePose(ur10e.arm, q);
    const found = allBranches(ur10e, wanted);
    expect(found.length).toBeGreaterThan(0);
    for (const solution of found) expect(gap(flangePose(ur10e.arm, solution), wanted)).toBeLessThan(1e-9);
  });
});

describe("singular postures of the other families give no NaN", () => {
  test.each([straight, iiwa, gofa])("$name at multiples of 45° and near them, seed 5", robot => {
    const random = seededRandom(5);
    const scratch = solverScratch();
    const n = robot.arm.joints.length;
    for (let k = 0; k < (n === 7 ? 200 : 60); k++) {
      const q = Float64Array.from(
        { length: n },
        () =>
          ((Math.trunc(random() * 9) - 4) * Math.PI) / 4 + (k % 3 === 0 ? 0 : (random() - 0.5) * 10 ** -(4 * (k % 3))),
      );
      const wanted = flangePose(robot.arm, q);
      for (const near of [undefined, q])
        for (const solution of allBranches(robot, wanted, near, scratch)) {
          expect(solution.every(Number.isFinite)).toBe(true);
          expect(gap(flangePose(robot.arm, solution), wanted)).toBeLessThan(1e-9);
        }
    }
  });
});

describe("the elbow of seven joints", () => {
  const q = [0.3, 0.7, -0.4, -1.2, 0.5, 0.9, 0.2];
  const wanted = flangePose(iiwa.arm, q);
  test("eight branches for any elbow angle, all with that angle and the same pose", () => {
    for (let elbow = -3; elbow < 3.1; elbow += 0.5) {
      const found = allBranches(iiwa, wanted, undefined, undefined, elbow);
      expect(found).toHaveLength(8);
      for (const solution of found) expect(Math.abs(wrapAngle(elbowOf(iiwa, solution)! - elbow))).toBeLessThan(1e-9);
    }
  });
  test("0 is the elbow in the vertical plane and above", () => {
    for (const solution of allBranches(straight, flangePose(straight.arm, q), undefined, undefined, 0)) {
      expect(Math.abs(Math.sin(solution[2]!))).toBeLessThan(1e-9); // joint 3 at 0 or 180°: axes 2 and 4 parallel
      const elbow = flangePose(
        { ...straight.arm, joints: straight.arm.joints.slice(0, 4), lastJointFromFlange: pose() },
        solution.subarray(0, 4),
      ).position;
      const wrist = compose(flangePose(straight.arm, q), pose<"flange", "wrist">([0, 0, -0.126])).position;
      const share = Math.hypot(elbow[0], elbow[1]) / Math.hypot(wrist[0], wrist[1]);
      expect(elbow[2]).toBeGreaterThan(0.36 + share * (wrist[2] - 0.36));
    }
  });
  test("the stretches of the elbow within the limits end where a joint meets its limit", () => {
    const intervals = elbowIntervals(iiwa, wanted);
    const own = elbowOf(iiwa, q)!;
    expect(intervals.some(({ from_rad, to_rad }) => own >= from_rad && own <= to_rad)).toBe(true);
    for (const { from_rad, to_rad } of intervals) {
      if (to_rad - from_rad > 6.28) continue;
      for (const [edge, outward] of [
        [from_rad, -1],
        [to_rad, 1],
      ] as const) {
        expect(solveAll(iiwa, wanted, { elbow_rad: edge - outward * 1e-6 }).kind).toBe("reached");
        expect(solveAll(iiwa, wanted, { elbow_rad: edge + outward * 1e-6 }).kind).toBe("outside-limits");
      }
    }
  });
  test("an elbow that the limits forbid is refused when asked for, and exchanged for the nearest when not", () => {
    const low = flangePose(iiwa.arm, [0, 1.9, 0, 1.5, 0, -1, 0]);
    const intervals = elbowIntervals(iiwa, low);
    expect(intervals.length).toBeGreaterThan(0);
    const forbidden = Array.from({ length: 60 }, (_, i) => -3 + 0.1 * i).find(
      angle => solveAll(iiwa, low, { elbow_rad: angle }).kind === "outside-limits",
    );
    if (forbidden === undefined) throw new Error("Every elbow angle is allowed there.");
    const near = allBranches(iiwa, low, undefined, undefined, forbidden)[0]!;
    const reach = solveAll(iiwa, low, { near });
    if (reach.kind !== "reached") throw new Error(explainReach(reach));
    const out = new Float64Array(7);
    expect(nearestSolution(iiwa, low, near, out)).toBe(true);
    const away = Math.abs(wrapAngle(elbowOf(iiwa, out)! - forbidden));
    const nearest = Math.min(
      ...intervals.flatMap(({ from_rad, to_rad }) =>
        [from_rad, to_rad].map(edge => Math.abs(wrapAngle(edge - forbidden))),
      ),
    );
    expect(away).toBeCloseTo(nearest, 6);
  });
});

describe("N-66 any arm of a family is recognised by its axes alone, however its base stands, seed 66", () => {
  const random = seededRandom(66);
  const any = (): number => (random() - 0.5) * 2;
  const sign = (): number => (random() < 0.5 ? -1 : 1);
  const length = (): number => 0.2 + random();
  const anyPose = (): Pose<"parent", "joint"> =>
    pose([any(), any(), any()], fromEulerAngles("zyx", 3 * any(), 1.5 * any(), 3 * any()));
  const X: Vector3 = [1, 0, 0];
  const Y: Vector3 = [0, 1, 0];
  const Z: Vector3 = [0, 0, 1];
  const armOf = (steps: readonly (readonly [Vector3, Vector3])[]): SerialArm => ({
    name: "made up",
    joints: steps.map(([moved, about], j): Joint => {
      const s = sign();
      const zero = pose<"turn", "joint">([0, 0, 0], fromAxisAngle(about, 3 * any()));
      const start = j === 0 ? anyPose() : pose<"parent", "joint">();
      return {
        name: `${j + 1}`,
        axis: [s * about[0], s * about[1], s * about[2]],
        parentFromJoint: compose(compose(start, pose<"joint", "turn">(moved)), zero),
        limits: { lower_rad: -3, upper_rad: 3, speed_rad_s: 1, acceleration_rad_s2: 4 },
      };
    }),
    lastJointFromFlange: pose([0.1 * any(), 0.1 * any(), 0.1 * any()], fromEulerAngles("zyx", 3 * any(), any(), any())),
  });
  const flangeOf = (robot: Robot, q: ArrayLike<number>): Pose => {
    const { family } = robot;
    return family.kind === "three-parallel"
      ? threeParallelFlange(family, q)
      : family.kind === "spherical-seven"
        ? sphericalSevenFlange(family, q)
        : family.kind === "general-6r"
          ? generalSixFlange(family, q)
          : pose();
  };
  const kinds: readonly (readonly [string, number, () => SerialArm])[] = [
    [
      "three-parallel",
      60,
      () =>
        armOf([
          [[0, 0, 0], Z],
          [[0.2 * any(), any(), length()], Y],
          [[0, 0.1 * any(), length()], Y],
          [[0.1 * any(), 0.1 * any(), length()], Y],
          [[0, any(), length()], Z],
          [[0, 0, length()], Y],
        ]),
    ],
    [
      "spherical-seven",
      60,
      () =>
        armOf([
          [[0, 0, 0], Z],
          [[0, 0, length()], Y],
          [[0, 0, 0], Z],
          [[0, 0, length()], Y],
          [[0, 0, 0], Z],
          [[0, 0, length()], Y],
          [[0, 0, 0], Z],
        ]),
    ],
    [
      "general-6r",
      12,
      () =>
        armOf([
          [[0, 0, 0], Z],
          [[0.1 * any(), 0.1 * any(), length()], Y],
          [[0, 0, length()], Y],
          [[0.2 * any(), 0, 0.1], Z],
          [[0, 0, length()], X],
          [[0, 0.1 + 0.1 * random(), 0.1 * any()], Y],
        ]),
    ],
  ];
  test.each(kinds)("%s", (kind, count, make) => {
    for (let n = 0; n < count; n++) {
      const arm = make();
      expect(familyOf(arm).kind).toBe(kind);
      const robot = robotFromArm(arm);
      const scratch = solverScratch();
      for (let k = 0; k < 4; k++) {
        const q = Float64Array.from(arm.joints, () => 3 * any());
        const wanted = flangePose(arm, q);
        expect(gap(flangeOf(robot, q), wanted)).toBeLessThan(1e-9);
        const found = allBranches(robot, wanted, undefined, scratch, elbowOf(robot, q));
        expect(found.some(solution => apart(solution, q) < 1e-5)).toBe(true);
        for (const solution of found) expect(gap(flangePose(arm, solution), wanted)).toBeLessThan(1e-9);
      }
    }
  });
  test("arms that only look alike are not taken for one", () => {
    const changed = (robot: Robot, joint: number, position: Vector3, turn = 0): SerialArm => ({
      ...robot.arm,
      joints: robot.arm.joints.map((each, j) =>
        j === joint
          ? {
              ...each,
              parentFromJoint: compose(
                each.parentFromJoint,
                pose<"joint", "joint">(position, fromAxisAngle([1, 0, 0], turn)),
              ),
            }
          : each,
      ),
    });
    expect(familyOf(changed(ur10e, 3, [0, 0, 0], 1e-3)).kind).toBe("general-6r"); // axes 2 and 3 are still parallel, 4 and 5 still meet
    expect(familyOf(changed(ur10e, 2, [0, 0, 0], 1e-3)).kind).toBe("general");
    expect(familyOf(changed(gofa, 4, [0, 0, 0.01])).kind).toBe("general");
    expect(familyOf(changed(iiwa, 5, [0.05, 0, 0])).kind).toBe("general");
  });
});
