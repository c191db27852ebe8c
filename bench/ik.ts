import { flangePose, robotById, seededRandom, solveOrthoParallel, armScratch, identity, posesAgree, type OrthoParallelGeometry, type Pose, type SerialArm } from "@twincell/core";
import { figure, settled, type Bench, type Figure } from "./figure.ts";
import { KR6_ARM, KR6_GEOMETRY } from "./robots/kr6.ts";

/** More inputs than a branch predictor can learn by heart. Many rounds shorter than a time slice: the median then stands even while other processes share the cores. */
const POSES = 8192, CALLS = 2000, ROUNDS = 301, WARM_UP = 100;

/**
 * Closed-form inverse kinematics, all branches of one pose, one thread: bare, and with every branch put back through
 * forward kinematics of the arm description and compared with the pose to 1e-9 (m, rad).
 */
export const run: Bench = () => {
  const rx90l = robotById("staubli_rx90l");
  if (rx90l?.family.kind !== "ortho-parallel") throw new Error("The library has no staubli_rx90l with a closed form.");
  return Promise.resolve([
    ...figuresOf("rx90l", rx90l.arm, rx90l.family),
    ...figuresOf("kr6", KR6_ARM, KR6_GEOMETRY),
  ]);
};

function figuresOf(name: string, arm: SerialArm, geometry: OrthoParallelGeometry): Figure[] {
  const random = seededRandom(1), out = new Float64Array(48);
  const poses = Array.from({ length: POSES }, () => flangePose(arm, arm.joints.map(({ limits }) => limits.lower_rad + random() * (limits.upper_rad - limits.lower_rad))));
  const scratch = armScratch(), again = identity<"base", "flange">();
  const solutions = Array.from({ length: 8 }, (_, s) => out.subarray(6 * s, 6 * s + 6));
  const bare = settled(CALLS, ROUNDS, WARM_UP, i => { solveOrthoParallel(geometry, poses[i % POSES]!, out); });
  let held = 0, solved = 0, calls = 0;
  const verified = settled(CALLS, ROUNDS, WARM_UP, i => {
    const pose: Pose = poses[i % POSES]!, count = solveOrthoParallel(geometry, pose, out);
    for (let s = 0; s < count; s++) {
      flangePose(arm, solutions[s]!, again, scratch);
      if (posesAgree(again, pose, 1e-9, 1e-9)) held++;
    }
    solved += count;
    calls++;
  });
  if (held !== solved) throw new Error(`${solved - held} of ${solved} solutions of ${name} do not meet their pose to 1e-9.`);
  const each = `${(solved / calls).toFixed(2)} solutions per pose`;
  return [
    figure(`ik/${name}`, "us", bare, `${each}; budget 1.0`),
    figure(`ik/${name}-verified`, "us", verified, `${each}, each through forward kinematics; budget 2.0`),
  ];
}

if (import.meta.main) for (const line of await run()) process.stdout.write(`${JSON.stringify(line)}\n`);
