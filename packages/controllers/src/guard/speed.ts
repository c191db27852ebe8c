import {
  armScratch,
  compose,
  distance,
  flangePose,
  identity,
  norm,
  type MoveStep,
  type Pose,
  type Robot,
  type SerialArm,
} from "@twincell/core";

/** Points of a joint move at which the speed of the TCP is looked at. */
const LOOKS = 64;

/**
 * Greatest speed of the TCP [m/s] in a joint move at full override:  max_s |dp/ds| · min_i (q̇max_i / |Δ_i|).
 *
 * @param flangeFromTcp  the tool; the cap is on its tip.
 */
export function jointMoveSpeed(
  robot: Robot,
  from_rad: ArrayLike<number>,
  to_rad: ArrayLike<number>,
  flangeFromTcp: Pose<"flange", "tcp">,
): number {
  const joints = robot.arm.joints;
  const q = new Float64Array(joints.length);
  let rate = Infinity;
  joints.forEach(({ limits }, i) => {
    rate = Math.min(rate, limits.speed_rad_s / Math.abs(to_rad[i]! - from_rad[i]!));
  });
  if (rate === Infinity) return 0;
  const tcp = tcpOf(robot.arm, flangeFromTcp);
  let before = identity<"base", "tcp">();
  let here = identity<"base", "tcp">();
  let most = 0;
  for (let k = 0; k <= LOOKS; k++) {
    for (let i = 0; i < joints.length; i++) q[i] = from_rad[i]! + (k / LOOKS) * (to_rad[i]! - from_rad[i]!);
    tcp(q, here);
    if (k > 0) most = Math.max(most, distance(before.position, here.position) * LOOKS);
    [before, here] = [here, before];
  }
  return most * rate;
}

/**
 * No motion within the joint speeds moves the TCP faster than this [m/s]:
 *   Σ_i q̇max_i · (length of the arm beyond joint i).
 */
export function speedBound(robot: Robot, flangeFromTcp: Pose<"flange", "tcp">): number {
  let beyond_m = norm(robot.arm.lastJointFromFlange.position) + norm(flangeFromTcp.position);
  let bound = 0;
  for (let i = robot.arm.joints.length - 1; i >= 0; i--) {
    const joint = robot.arm.joints[i]!;
    bound += joint.limits.speed_rad_s * beyond_m;
    beyond_m += norm(joint.parentFromJoint.position);
  }
  return bound;
}

/** A motion so slow that the flange stays within that speed: what modes by hand ask for. */
export function slowed(robot: Robot, step: MoveStep, from_rad: ArrayLike<number>, most_mps: number): MoveStep {
  if (step.path !== "ptp")
    return { ...step, speed: { mps: "mps" in step.speed ? Math.min(most_mps, step.speed.mps) : most_mps } };
  const to = "q" in step.target ? step.target.q : null;
  const ratio = "ratio" in step.speed ? step.speed.ratio : 1;
  const full_mps = to ? jointMoveSpeed(robot, from_rad, to, FLANGE) : speedBound(robot, FLANGE);
  return { ...step, speed: { ratio: full_mps * ratio > most_mps ? most_mps / full_mps : ratio } };
}
const FLANGE: Pose<"flange", "tcp"> = { position: [0, 0, 0], quaternion: [0, 0, 0, 1] };

/** Forward kinematics to the tip of the tool, without allocation. */
export function tcpOf(
  arm: SerialArm,
  flangeFromTcp: Pose<"flange", "tcp">,
): (q_rad: ArrayLike<number>, out: Pose<"base", "tcp">) => Pose<"base", "tcp"> {
  const scratch = armScratch();
  const flange = identity<"base", "flange">();
  return (q_rad, out) => compose(flangePose(arm, q_rad, flange, scratch), flangeFromTcp, out);
}
