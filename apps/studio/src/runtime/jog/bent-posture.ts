import { flangeOfTcp, fromAxisAngle, multiply, type Pose, type Robot, solveAll } from "@twincell/core";
import type { CellDocument } from "@twincell/project";
import { flangeFromTcpOf } from "../../stores/document.ts";

/** Heights of the tool tip that are tried, best first [m]: where a hand is that is held before the chest. */
const HEIGHTS_M = [1.2, 1.1, 1.3, 1, 0.9, 0.8, 1.4, 0.7, 0.6];
/** Shares of the longest reach from the axis of the base. */
const SHARES = [0.6, 0.5, 0.7, 0.4, 0.8];
/** The tool points down and so far outwards [rad]. */
const OUTWARDS_RAD = [0.5, 0.25, 0.8, 0, 1.1];
/** A joint this share of its range from its limit is far enough: more of it is no better. */
const ROOM_ENOUGH = 0.15;
/** Joints turned by less than this are a straight arm [rad]. */
const STRAIGHT_RAD = 0.35;

/**
 * A bent posture of the robot with its tool tip at the height of a person's chest: all of the first height that has any
 * is compared, and the one with the most room to its limits and to a straight elbow is taken.
 *
 * @param towards_rad  the way from the base in which the tool is held, in the world, about z.
 * @param isFree       whether nothing touches in that posture.
 * Returns null for a robot that cannot be so.
 */
export function bentPosture(
  document: CellDocument,
  robot: Robot,
  towards_rad: number,
  isFree: (q_rad: Float64Array) => boolean,
): Float64Array | null {
  const [x, y] = document.robot.worldFromBase.position;
  const reach_m = reachOf(robot);
  const about = fromAxisAngle([0, 0, 1], towards_rad);
  const flangeFromTcp = flangeFromTcpOf(document);
  for (const height_m of HEIGHTS_M) {
    let best: { readonly q_rad: Float64Array; readonly room: number } | null = null;
    for (const share of SHARES)
      for (const outwards_rad of OUTWARDS_RAD) {
        const away_m = share * reach_m;
        const worldFromTcp: Pose<"world", "tcp"> = {
          position: [x + away_m * Math.cos(towards_rad), y + away_m * Math.sin(towards_rad), height_m],
          quaternion: multiply(about, fromAxisAngle([0, 1, 0], Math.PI - outwards_rad)),
        };
        const flange = flangeOfTcp(document.robot.worldFromBase, worldFromTcp, flangeFromTcp);
        const found = solveAll(robot, flange, { near: robot.home_rad });
        if (found.kind !== "reached") continue;
        for (const { q_rad } of found.solutions) {
          const room = Math.min(ROOM_ENOUGH, roomToLimits(robot, q_rad));
          if (room > (best?.room ?? 0) && isFree(q_rad)) best = { q_rad, room };
        }
      }
    if (best) return best.q_rad;
  }
  return null;
}

/** The least distance of a joint to its limit, as a share of its range; 0 for an arm that is stretched. */
function roomToLimits(robot: Robot, q_rad: ArrayLike<number>): number {
  let room = 1;
  for (const [i, { limits }] of robot.arm.joints.entries()) {
    const range = limits.upper_rad - limits.lower_rad;
    room = Math.min(room, (q_rad[i]! - limits.lower_rad) / range, (limits.upper_rad - q_rad[i]!) / range);
  }
  // The wrist in line with the forearm leaves two axes that do the same.
  const wrist_rad = Math.abs(q_rad[q_rad.length - 2] ?? 1);
  return wrist_rad < STRAIGHT_RAD ? 0 : room;
}

/** From the axis of the base to the flange with every link in line, at most [m]. */
function reachOf(robot: Robot): number {
  return robot.arm.joints.reduce((sum, { parentFromJoint: { position } }) => sum + Math.hypot(...position), 0);
}
