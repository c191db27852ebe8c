// Random round trips through forward and inverse kinematics, one family after another:
//   node scripts/soak/ik-round-trips.ts [COUNT] [SECONDS for general-6r] [FAMILY…]
// q drawn evenly inside the limits; a miss is a q that is not among the branches of its own pose (to 1e-5 rad, whole
// turns apart), a fault any branch whose forward kinematics misses the pose by 1e-9 (m, rad) or more. The result is
// kept beside this script.
import { cpus } from "node:os";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import {
  allBranches,
  angleBetween,
  distance,
  elbowOf,
  flangePose,
  identity,
  minSingularValue,
  pose,
  robotById,
  robotFromArm,
  seededRandom,
  armScratch,
  solverScratch,
  wrapAngle,
  type Robot,
} from "@twincell/core";

const SEED = 2026;
const SAME_RAD = 1e-5;
const VERIFIED = 1e-9;
const count = Number(process.argv[2] ?? 1_000_000);
const seconds = Number(process.argv[3] ?? 600);
const only = process.argv.slice(4);
const library = (id: string): Robot => {
  const robot = robotById(id);
  if (!robot) throw new Error(`The library has no ${id}.`);
  return robot;
};
const iiwa = library("kuka_lbr_iiwa_14_r820");
const drawn = robotFromArm({
  ...iiwa.arm,
  joints: iiwa.arm.joints.map(joint => ({
    ...joint,
    parentFromJoint: pose<"parent", "joint">([0, 0, joint.parentFromJoint.position[2]]),
  })),
});

interface Family {
  readonly name: string;
  readonly robot: Robot;
  readonly band: string;
  readonly inBand: (q: Float64Array) => boolean;
  readonly most_s?: number;
}
const sine = (angle: number): number => Math.abs(Math.sin(angle));
const families: readonly Family[] = [
  { name: "ortho-parallel", robot: library("kuka_kr6r900sixx"), band: "none", inBand: () => false },
  {
    name: "three-parallel",
    robot: library("ur10e"),
    band: "least singular value of the Jacobian below 1e-4: there the file's right angles, rounded to ten digits, are felt",
    inBand: q => minSingularValue(library("ur10e").arm, q) < 1e-4,
  },
  {
    name: "spherical-seven",
    robot: drawn,
    band: "none (the arm as drawn, without the file's sideways steps of 0.436 mm)",
    inBand: () => false,
  },
  {
    name: "spherical-seven-stepped",
    robot: iiwa,
    band: "|sin q2| below 2e-3, |sin q4| below 0.02, or both below 0.1: there the file's sideways steps of 0.436 mm decide which postures exist",
    inBand: q => sine(q[1]!) < 2e-3 || sine(q[3]!) < 0.02 || (sine(q[1]!) < 0.1 && sine(q[3]!) < 0.1),
  },
  {
    name: "general-6r",
    robot: library("abb_crb15000_5_95"),
    band: "least singular value of the Jacobian below 1e-3",
    inBand: q => minSingularValue(library("abb_crb15000_5_95").arm, q) < 1e-3,
    most_s: seconds,
  },
];

const path = new URL("./ik-round-trips.json", import.meta.url);
const kept: Record<string, unknown> = existsSync(path)
  ? (JSON.parse(readFileSync(path, "utf8")) as Record<string, unknown>)
  : {};
for (const { name, robot, band, inBand, most_s } of families) {
  if (only.length > 0 && !only.includes(name)) continue;
  const random = seededRandom(SEED);
  const scratch = solverScratch();
  const arm = armScratch();
  const wanted = identity<"base", "flange">();
  const back = identity<"base", "flange">();
  const joints = robot.arm.joints;
  const n = joints.length;
  let tried = 0;
  let branches = 0;
  let misses = 0;
  let missesInBand = 0;
  let inTheBand = 0;
  let faults = 0;
  let worst = 0;
  const began = performance.now();
  for (; tried < count && (most_s === undefined || performance.now() - began < 1000 * most_s); tried++) {
    const q = Float64Array.from(
      joints,
      ({ limits: { lower_rad, upper_rad } }) => lower_rad + random() * (upper_rad - lower_rad),
    );
    flangePose(robot.arm, q, wanted, arm);
    const found = allBranches(robot, wanted, undefined, scratch, elbowOf(robot, q));
    branches += found.length;
    let met = false;
    for (const solution of found) {
      flangePose(robot.arm, solution, back, arm);
      const miss = Math.max(distance(back.position, wanted.position), angleBetween(back.quaternion, wanted.quaternion));
      if (!(miss < VERIFIED)) faults++;
      worst = Math.max(worst, miss);
      let same: boolean = !met;
      for (let j = 0; j < n && same; j++) same = Math.abs(wrapAngle(solution[j]! - q[j]!)) < SAME_RAD;
      met ||= same;
    }
    const banded = inBand(q);
    if (banded) inTheBand++;
    if (!met) {
      if (banded) missesInBand++;
      else {
        misses++;
        process.stderr.write(`${name} misses ${JSON.stringify([...q])}\n`);
      }
    }
  }
  const took_s = (performance.now() - began) / 1000;
  kept[name] = {
    robot: robot.id,
    tried,
    misses,
    faults,
    worst_m_or_rad: worst,
    branches,
    singularBand: band,
    inTheBand,
    missesInTheBand: missesInBand,
    seed: SEED,
    took_s: Math.round(took_s),
    date: new Date().toISOString().slice(0, 10),
    machine: `${cpus()[0]?.model ?? "unknown"}, ${cpus().length} cores, Node ${process.versions.node}`,
  };
  process.stdout.write(`${JSON.stringify({ [name]: kept[name] })}\n`);
  writeFileSync(path, `${JSON.stringify(kept, null, 2)}\n`);
}
