import { linkPoses } from "../kinematics/forward.ts";
import { solveAll } from "../kinematics/inverse.ts";
import { isSingularConfiguration } from "../kinematics/singularity.ts";
import type { Robot } from "../model/robot.ts";
import { isSlide } from "../model/slide.ts";
import { identity, pose } from "../spatial/pose.ts";
import { fromAxisAngle, multiply, type Quaternion } from "../spatial/quaternion.ts";

/** Where the flange is tried, as shares of the reach: in front of the base, and above its shoulder; the best first. */
const PLACES: readonly (readonly [number, number])[] = [
  [0.58, 0.05],
  [0.5, 0.05],
  [0.65, -0.05],
  [0.5, 0.2],
  [0.42, 0.1],
  [0.7, 0.2],
];
const TURNS = 8;
/** Room that is left to every joint limit [rad]. */
const ROOM_RAD = 0.15;

/**
 * A bent posture over the work: the flange points down in front of the base, the elbow is as high as it gets, no joint
 * is near a limit and the arm is not singular. The home position where there is none. For showing a robot; nobody's
 * program begins there.
 *
 * @returns one angle a joint [rad; m where it slides]; a new array.
 */
export function readyPosture(robot: Robot): Float64Array {
  const { arm, reach_m } = robot;
  const n = arm.joints.length;
  const links = Array.from({ length: n + 1 }, () => identity<"base", "link">());
  linkPoses(arm, new Float64Array(n), links);
  const shoulder_m = links[Math.min(2, n)]!.position[2];
  const down: Quaternion = [1, 0, 0, 0];
  for (const [out, up] of PLACES) {
    let best: Float64Array | undefined;
    let highest_m = -Infinity;
    for (let i = 0; i < TURNS; i++) {
      const turn = fromAxisAngle([0, 0, 1], (2 * Math.PI * i) / TURNS);
      const there = pose<"base", "flange">([out * reach_m, 0, shoulder_m + up * reach_m], multiply(turn, down));
      const reach = solveAll(robot, there, { near: robot.home_rad });
      if (reach.kind !== "reached") continue;
      for (const { q_rad } of reach.solutions) {
        if (!hasRoom(robot, q_rad) || isSingularConfiguration(robot, q_rad)) continue;
        linkPoses(arm, q_rad, links);
        const lowest_m = Math.min(...links.slice(1).map(({ position }) => position[2]));
        const elbow_m = links[Math.min(3, n)]!.position[2];
        // The least turned of those with the elbow up.
        const height_m = elbow_m - 0.02 * reach_m * turned(q_rad);
        if (lowest_m < 0 || height_m <= highest_m) continue;
        highest_m = height_m;
        best = Float64Array.from(q_rad);
      }
    }
    if (best) return best;
  }
  return Float64Array.from(robot.home_rad);
}

const turned = (q_rad: ArrayLike<number>): number => Array.from(q_rad).reduce((sum, q) => sum + Math.abs(q), 0);

const hasRoom = ({ arm }: Robot, q_rad: ArrayLike<number>): boolean =>
  arm.joints.every((joint, i) => {
    if (isSlide(joint)) return true;
    const { lower_rad, upper_rad } = joint.limits;
    return q_rad[i]! - lower_rad > ROOM_RAD && upper_rad - q_rad[i]! > ROOM_RAD;
  });
