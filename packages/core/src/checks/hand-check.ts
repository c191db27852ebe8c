import { inverseDynamics } from "../dynamics/inverse-dynamics.ts";
import { dynamicsScratch } from "../dynamics/placed.ts";
import { explainReach } from "../kinematics/explain.ts";
import { flangeOfTcp, nearestSolution, solveAll, solverScratch } from "../kinematics/inverse.ts";
import type { Robot } from "../model/robot.ts";
import { identity, type Pose } from "../spatial/pose.ts";
import type { Demonstration } from "../teach/demonstration/demonstration.ts";
import { torqueModel } from "../trajectory/torque/loads.ts";

/** What a robot that followed a hand would have to do. */
export interface HandCheck {
  /** Samples that no posture inside the limits reaches, and why the first of them is not. */
  readonly unreached: number;
  readonly first: { readonly at_s: number; readonly sentence: string } | null;
  /** The joint that comes nearest to its speed limit; null with too few samples to tell. */
  readonly speed: JointLoad | null;
  /** The same of torques; null where they are not known, with why. */
  readonly torque: JointLoad | null;
  readonly torqueUnknown: string | null;
}
/** A joint, from 1, and how much of its limit it needs at its worst moment: 1 is the limit. */
export interface JointLoad {
  readonly joint: number;
  readonly fraction: number;
  readonly at_s: number;
}

/** Angles are averaged over this long on both sides before they are differentiated: a tremor is no motion [s]. */
const SMOOTH_S = 0.1;
/** Fewer have no acceleration. */
const LEAST_SAMPLES = 3;

/**
 * Whether a robot could follow a recorded hand as it went (rows M-36, L-33): position and orientation of every sample
 * to inverse kinematics, nearest to the posture before; speeds and accelerations of the joints, by central
 * differences of the averaged angles, to their limits and to inverse dynamics. Samples that are not reached are
 * passed over.
 *
 *   q_i = IK(x_i),   q̇_i = (q_{i+1} − q_{i−1}) / (t_{i+1} − t_{i−1}),   q̈ likewise of q̇,   τ = RNEA(q, q̇, q̈)
 *
 * @param near  posture that the first sample is solved nearest to; the home position when left out.
 */
export function checkHand(
  { times_s, worldFromTcp }: Demonstration,
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
  flangeFromTcp: Pose<"flange", "tcp">,
  near: ArrayLike<number> = robot.home_rad,
): HandCheck {
  const n = robot.arm.joints.length;
  const scratch = solverScratch();
  const wanted = identity<"base", "flange">();
  const times: number[] = [];
  const angles: Float64Array[] = [];
  let last = Float64Array.from(near);
  let unreached = 0;
  let first: HandCheck["first"] = null;
  worldFromTcp.forEach((pose, i) => {
    flangeOfTcp(worldFromBase, pose, flangeFromTcp, wanted);
    const q = new Float64Array(n);
    if (nearestSolution(robot, wanted, last, q, scratch)) {
      times.push(times_s[i]!);
      angles.push(q);
      last = q;
      return;
    }
    unreached++;
    first ??= { at_s: times_s[i]! - times_s[0]!, sentence: explainReach(solveAll(robot, wanted, { near: last })) };
  });
  if (angles.length < LEAST_SAMPLES) return { unreached, first, speed: null, torque: null, torqueUnknown: null };
  const q = averaged(times, angles);
  const qd = slopes(times, q);
  const qdd = slopes(times, qd);
  const most = (fractionOf: (i: number, j: number) => number): JointLoad => {
    let best = { joint: 1, fraction: 0, at_s: 0 };
    for (let i = 0; i < q.length; i++)
      for (let j = 0; j < n; j++) {
        const fraction = fractionOf(i, j);
        if (fraction > best.fraction) best = { joint: j + 1, fraction, at_s: times[i]! - times_s[0]! };
      }
    return best;
  };
  const speed = most((i, j) => Math.abs(qd[i]![j]!) / robot.arm.joints[j]!.limits.speed_rad_s);
  const known = torqueModel(robot, worldFromBase);
  if (known.kind === "unknown") return { unreached, first, speed, torque: null, torqueUnknown: known.sentence };
  const model = known.carrying(undefined);
  const working = dynamicsScratch(model);
  const torques = q.map((angle, i) => inverseDynamics(model, angle, qd[i]!, qdd[i]!, new Float64Array(n), working));
  const torque = most((i, j) => Math.abs(torques[i]![j]!) / known.limits_Nm[j]!);
  return { unreached, first, speed, torque, torqueUnknown: null };
}

/** Means over `SMOOTH_S` to both sides, as many samples on the one as on the other: ends are not pulled inwards. */
function averaged(times: readonly number[], angles: readonly Float64Array[]): Float64Array[] {
  return angles.map((own, i) => {
    let reach = 0;
    while (
      i - reach - 1 >= 0 &&
      i + reach + 1 < angles.length &&
      times[i + reach + 1]! - times[i]! <= SMOOTH_S &&
      times[i]! - times[i - reach - 1]! <= SMOOTH_S
    )
      reach++;
    const mean = new Float64Array(own.length);
    for (let k = i - reach; k <= i + reach; k++)
      for (let j = 0; j < own.length; j++) mean[j]! += angles[k]![j]! / (2 * reach + 1);
    return mean;
  });
}

function slopes(times: readonly number[], values: readonly Float64Array[]): Float64Array[] {
  const end = values.length - 1;
  return values.map((_, i) => {
    const from = Math.max(0, i - 1);
    const to = Math.min(end, i + 1);
    return values[to]!.map((value, j) => (value - values[from]![j]!) / (times[to]! - times[from]!));
  });
}
