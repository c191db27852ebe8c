import { compose, copyPose, identity, inverse, type Pose } from "../spatial/pose.ts";
import { angleBetween, slerp } from "../spatial/quaternion.ts";
import { distance, lerp, type Vector3 } from "../spatial/vector.ts";

/**
 * How a grip follows the hand. `limits` bound one frame's motion, so that a hand lost and found again never makes the
 * tip leap.
 */
export interface ClutchMode {
  /** Tip travel per hand travel. Angles are never scaled. */
  readonly scale: number;
  readonly position: "follows" | "locked";
  readonly orientation: "follows" | "locked";
  readonly maxStep_m: number;
  readonly maxTurn_rad: number;
}
export const FREE_HAND: ClutchMode = {
  scale: 1,
  position: "follows",
  orientation: "follows",
  maxStep_m: 0.1,
  maxTurn_rad: 0.5,
};

/** A tool tip held by a hand, from the closing of the grip to its opening. Written by `clutchStep`. */
export interface Grip {
  readonly handFromTcp: Pose<"hand", "tcp">;
  readonly startHand: Vector3;
  readonly worldFromTcpStart: Pose<"world", "tcp">;
  readonly worldFromTcp: Pose<"world", "tcp">;
  readonly scratch: Pose<"world", "tcp">;
}

/**
 * Closes the grip: the tip keeps its place in the hand from here on, so taking it moves nothing (row L-29). A new grip
 * each time.
 */
export function takeGrip(worldFromHand: Pose<"world", "hand">, worldFromTcp: Pose<"world", "tcp">): Grip {
  return {
    handFromTcp: compose(inverse(worldFromHand), worldFromTcp),
    startHand: [...worldFromHand.position],
    worldFromTcpStart: copyPose(worldFromTcp),
    worldFromTcp: copyPose(worldFromTcp),
    scratch: identity(),
  };
}

/**
 * Where the tip should be for the present hand.
 *
 *   worldFromTcp = worldFromHand · handFromTcp   scale 1, nothing locked
 *   p = p₀ + scale · (p_rigid − p₀)   scaled
 *   p = p₀ + scale · (hand − hand₀), R = R₀   orientation locked: no lever arm (row L-30)
 *
 * Then at most `maxStep_m` and `maxTurn_rad` from the last answer; the rest is caught up in later frames.
 *
 * @param grip  advanced in place.
 * @param out   receives the pose and is returned. A hand that is not a number leaves it at the last answer. Allocates
 *   nothing.
 */
export function clutchStep(
  grip: Grip,
  worldFromHand: Pose<"world", "hand">,
  manner: ClutchMode,
  out: Pose<"world", "tcp"> = identity(),
): Pose<"world", "tcp"> {
  const last = grip.worldFromTcp;
  const start = grip.worldFromTcpStart;
  const wanted = grip.scratch;
  if (!isFinitePose(worldFromHand)) return copyPose(last, out);
  compose(worldFromHand, grip.handFromTcp, wanted);
  if (manner.orientation === "locked") {
    for (let i = 0; i < 4; i++) wanted.quaternion[i] = start.quaternion[i]!;
    for (let i = 0; i < 3; i++)
      wanted.position[i] = start.position[i]! + worldFromHand.position[i]! - grip.startHand[i]!;
  }
  for (let i = 0; i < 3; i++) {
    wanted.position[i] =
      manner.position === "locked"
        ? start.position[i]!
        : start.position[i]! + manner.scale * (wanted.position[i]! - start.position[i]!);
  }
  const step = distance(last.position, wanted.position);
  const turn = angleBetween(last.quaternion, wanted.quaternion);
  lerp(last.position, wanted.position, step > manner.maxStep_m ? manner.maxStep_m / step : 1, last.position);
  slerp(last.quaternion, wanted.quaternion, turn > manner.maxTurn_rad ? manner.maxTurn_rad / turn : 1, last.quaternion);
  return copyPose(last, out);
}

function isFinitePose(pose: Pose): boolean {
  const [x, y, z] = pose.position;
  const [a, b, c, d] = pose.quaternion;
  return Number.isFinite(x + y + z + a + b + c + d);
}
