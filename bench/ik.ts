import {
  armScratch,
  flangePose,
  generalSixScratch,
  identity,
  MAX_GENERAL_SIX,
  nearestSolution,
  posesAgree,
  refine,
  refineScratch,
  robotById,
  robotFromArm,
  seededRandom,
  solveBatch,
  batchFor,
  POSE_STRIDE,
  solveGeneralSix,
  solveOrthoParallel,
  solverScratch,
  solveSphericalSeven,
  solveThreeParallel,
  type Pose,
  type Robot,
} from "@twincell/core";
import { collections, figure, settled, type Bench, type Figure } from "./figure.ts";
import { eaikFigures } from "./kinematics-peers.ts";
import { KR6_ARM } from "./robots/kr6.ts";

/**
 * More inputs than a branch predictor can learn by heart. Many rounds shorter than a time slice: the median then stands
 * even while other processes share the cores.
 */
const POSES = 8192;
const CALLS = 2000;
const ROUNDS = 301;
const WARM_UP = 100;
const PEER_POSES = 2000;
/** The search over θ6 takes hundreds of microseconds: fewer of them make a round. */
const SEARCHES = 40;
const SEARCH_ROUNDS = 61;
const SEARCH_WARM_UP = 20;
const MILLION = 1_000_000;

/**
 * Inverse kinematics, all branches of one pose, one thread: the closed form alone, and with every branch put back
 * through forward kinematics of the arm description (refined where the robot's file rounds its right angles) and
 * compared with the pose to 1e-9 (m, rad). `collections` counts how often garbage was collected in a million calls.
 */
export const run: Bench = async () => {
  const library = (id: string): Robot => {
    const robot = robotById(id);
    if (!robot) throw new Error(`The library has no ${id}.`);
    return robot;
  };
  return [
    ...(await figuresOf("rx90l", library("staubli_rx90l"), 1.0, 2.0)),
    ...(await figuresOf("kr6", robotFromArm(KR6_ARM), 1.0, 2.0)),
    ...(await figuresOf("ur10e", library("ur10e"), 1.2)),
    ...(await figuresOf("iiwa14", library("kuka_lbr_iiwa_14_r820"))),
    ...(await figuresOf("crb15000", library("abb_crb15000_5_95"))),
  ];
};

async function figuresOf(name: string, robot: Robot, budget?: number, verifiedBudget?: number): Promise<Figure[]> {
  const random = seededRandom(1);
  const { arm, family } = robot;
  const n = arm.joints.length;
  const out = new Float64Array(6 * MAX_GENERAL_SIX);
  const scratch = armScratch();
  const again = identity<"base", "flange">();
  const starts = Array.from({ length: POSES }, () =>
    Float64Array.from(
      arm.joints,
      ({ limits: { lower_rad, upper_rad } }) => lower_rad + random() * (upper_rad - lower_rad),
    ),
  );
  const poses = starts.map(q => flangePose(arm, q));
  const answers = Array.from({ length: MAX_GENERAL_SIX }, (_, s) => out.subarray(n * s, n * s + n)).filter(
    answer => answer.length === n,
  );
  const six = generalSixScratch();
  const newton = refineScratch(n);
  const searched = family.kind === "general-6r";
  const solve = (pose: Pose<"base", "flange">): number => {
    switch (family.kind) {
      case "ortho-parallel":
        return solveOrthoParallel(family, pose, out);
      case "three-parallel":
        return solveThreeParallel(family, pose, out);
      case "spherical-seven":
        return solveSphericalSeven(family, pose, 0.3, out);
      case "general-6r":
        return solveGeneralSix(family, pose, out, six);
      case "general":
        return 0;
    }
  };
  let held = 0;
  let solved = 0;
  let calls = 0;
  const verify = (i: number): void => {
    const pose = poses[i % POSES]!;
    const count = solve(pose);
    for (let s = 0; s < count; s++) {
      const q = answers[s]!;
      flangePose(arm, q, again, scratch);
      if (posesAgree(again, pose, 1e-9, 1e-9) || refine(arm, q, pose, newton) < 1e-9) held++;
    }
    solved += count;
    calls++;
  };
  const timed = (call: (i: number) => void): number[] =>
    searched ? settled(SEARCHES, SEARCH_ROUNDS, SEARCH_WARM_UP, call) : settled(CALLS, ROUNDS, WARM_UP, call);
  const bare = timed(i => {
    solve(poses[i % POSES]!);
  });
  const figures: Figure[] = [];
  if (family.kind === "spherical-seven") {
    // The file's sideways steps are mended branch by branch: `solveBatch` is the way to all verified branches.
    const one = Float64Array.from(poses.flatMap(({ position, quaternion }) => [...position, ...quaternion]));
    const batch = batchFor(n, CALLS);
    const working = solverScratch();
    const rows = one.subarray(0, CALLS * POSE_STRIDE);
    const verified = settled(1, 31, 5, () => {
      solveBatch(robot, rows, batch, 0.3, working);
    }).map(us => us / CALLS);
    figures.push(
      figure(`ik/${name}`, "us", bare, "eight branches of one elbow angle, closed form"),
      figure(
        `ik/${name}-verified`,
        "us",
        verified,
        "each branch mended for the file's sideways steps of 0.436 mm and verified; batch call",
      ),
    );
  } else {
    const verified = timed(verify);
    const each = `${(solved / calls).toFixed(2)} ${searched ? "candidates" : "solutions"} per pose`;
    if (!searched && held !== solved)
      throw new Error(`${solved - held} of ${solved} solutions of ${name} do not meet their pose to 1e-9.`);
    figures.push(
      figure(`ik/${name}`, "us", bare, `${each}${budget === undefined ? "" : `; budget ${budget.toFixed(1)}`}`),
      figure(
        `ik/${name}-verified`,
        "us",
        verified,
        `${each}, each through forward kinematics${searched ? ", refined" : ""}${verifiedBudget === undefined ? "" : `; budget ${verifiedBudget.toFixed(1)}`}`,
      ),
    );
  }
  const working = solverScratch();
  const q = new Float64Array(n);
  const near = starts.map(start => start.map(angle => angle + 0.01));
  figures.push(
    figure(
      `ik/${name}-nearest`,
      "us",
      timed(i => {
        nearestSolution(robot, poses[i % POSES]!, near[i % POSES]!, q, working);
      }),
      "the solution inside the limits nearest to a posture 0.01 rad away in every joint, verified",
    ),
  );
  if (family.kind === "ortho-parallel" || family.kind === "three-parallel")
    figures.push(...eaikFigures(name, arm, starts.slice(0, PEER_POSES)));
  if (!searched)
    figures.push(
      figure(
        `ik/${name}-collections`,
        "per 10⁶",
        [await collections(MILLION, verify)],
        "garbage collections; budget 0",
      ),
    );
  return figures;
}

if (import.meta.main) for (const line of await run()) process.stdout.write(`${JSON.stringify(line)}\n`);
