import type { Robot } from "../model/robot.ts";
import { isSlide } from "../model/slide.ts";
import type { Pose } from "../spatial/pose.ts";
import { candidates, settle, solverScratch, type SolverScratch } from "./candidates.ts";
import { nearestSolution } from "./inverse.ts";
import { LIMIT_SLACK_RAD } from "./turns.ts";
import { isInsideWorkspace } from "./workspace.ts";

const TURN = 2 * Math.PI;
/** A joint with little way keeps at most this share of it free at either end. */
const MOST_ROOM_SHARE = 0.1;
/** Where a joint that turns keeps so much free, one that slides keeps this many metres for a radian. */
const METRES_PER_RAD = 0.057;

export interface PoseFitOptions {
  /** How far every joint stays from its limits [rad; 57 mm of a slide for a radian]; 0 by default. */
  readonly room_rad?: number;
  /** What else a posture must satisfy, for instance that nothing touches. Called with the solver's own memory. */
  readonly accepts?: (q_rad: Float64Array) => boolean;
}

/** The robot with every joint's range smaller by `room_rad` at both ends. */
export function withRoom(robot: Robot, room_rad: number): Robot {
  if (!(room_rad > 0)) return robot;
  const joints = robot.arm.joints.map(joint => {
    const { lower_rad, upper_rad } = joint.limits;
    const wanted = isSlide(joint) ? room_rad * METRES_PER_RAD : room_rad;
    const room = Math.min(wanted, MOST_ROOM_SHARE * (upper_rad - lower_rad));
    return { ...joint, limits: { ...joint.limits, lower_rad: lower_rad + room, upper_rad: upper_rad - room } };
  });
  return { ...robot, arm: { ...robot.arm, joints } };
}

/**
 * Says whether poses can be reached at all, for searches that ask thousands of times: any branch will do, the first
 * that keeps to the limits ends the look. A posture it accepts has been put back through forward kinematics.
 *
 * Arms without a closed form are followed from home, so that a pose they could reach another way may be refused.
 */
export class PoseFit {
  /** The posture of the last pose that fitted [rad]. */
  readonly q_rad: Float64Array;
  private readonly robot: Robot;
  private readonly accepts: ((q_rad: Float64Array) => boolean) | undefined;
  private readonly scratch: SolverScratch = solverScratch();

  constructor(robot: Robot, options: PoseFitOptions = {}) {
    this.robot = withRoom(robot, options.room_rad ?? 0);
    this.accepts = options.accepts;
    this.q_rad = Float64Array.from(robot.home_rad);
  }

  fits(baseFromFlange: Pose<"base", "flange">): boolean {
    return this.miss(baseFromFlange) === 0;
  }

  /**
   * How far the worst joint of the best branch is beyond its limit [rad]: 0 for a pose that fits; Infinity where no
   * branch exists, where something else than a limit is against every one, or where that is not known of the arm.
   */
  miss(baseFromFlange: Pose<"base", "flange">): number {
    const { robot, scratch, q_rad } = this;
    const { kind } = robot.family;
    if (kind === "general" || kind === "spherical-seven") {
      const found = nearestSolution(robot, baseFromFlange, robot.home_rad, q_rad, scratch) && this.accepted(q_rad);
      return found ? 0 : Infinity;
    }
    const joints = robot.arm.joints;
    const n = joints.length;
    const count = candidates(robot, baseFromFlange, robot.home_rad, undefined, scratch);
    let least = Infinity;
    for (let s = 0; s < count; s++) {
      let worst = 0;
      for (let j = 0; j < n && worst < least; j++) {
        const { lower_rad, upper_rad } = joints[j]!.limits;
        const angle = scratch.raw[n * s + j]!;
        // Of the whole turns the one nearest to the middle of the range is least beyond an end of it.
        const turned = angle + TURN * Math.round(((lower_rad + upper_rad) / 2 - angle) / TURN);
        scratch.raw[n * s + j] = turned;
        worst = Math.max(worst, lower_rad - LIMIT_SLACK_RAD - turned, turned - LIMIT_SLACK_RAD - upper_rad);
      }
      if (worst > 0) least = Math.min(least, worst);
      else if (settle(robot, baseFromFlange, s, scratch)) {
        for (let j = 0; j < n; j++) q_rad[j] = scratch.q[j]!;
        if (this.accepted(q_rad)) return 0;
      }
    }
    return least;
  }

  private accepted(q_rad: Float64Array): boolean {
    return isInsideWorkspace(this.robot, q_rad) && this.accepts?.(q_rad) !== false;
  }
}
