import { flangePose } from "../kinematics/forward.ts";
import type { Robot } from "../model/robot.ts";
import { compose } from "../spatial/pose.ts";
import { distance } from "../spatial/vector.ts";
import { GoalFinder } from "./goal.ts";
import { Follower } from "./follow.ts";
import { timeJointLeg } from "./joint-leg.ts";
import type { Move } from "./moves.ts";
import { RunPath, type CornerSweep, type RunStop } from "./run-path.ts";
import { RunTimer, type TimedRun } from "./run-timing.ts";

/** TCP distance [m] between the plan and the commanded straight, circular or spline path. */
export const PATH_TOLERANCE_M = 5e-7;

/** A posture this far [rad] outside its limit is rounding. */
export const LIMIT_SLACK_RAD = 1e-9;

export type RunAnswer =
  | { readonly kind: "timed"; readonly run: TimedRun }
  | { readonly kind: "stopped"; readonly stop: RunStop };

/**
 * Lays out runs of moves: geometry first, then time. One per planner or stepper: its working memory is reused from run
 * to run.
 */
export class RunPlanner {
  private readonly robot: Robot;
  private readonly path: RunPath;
  private readonly timer: RunTimer;
  private readonly goals: GoalFinder;

  constructor(robot: Robot, tolerance_m = PATH_TOLERANCE_M) {
    this.robot = robot;
    this.path = new RunPath(robot, tolerance_m);
    this.timer = new RunTimer(robot);
    this.goals = new GoalFinder(robot, new Follower(robot.arm));
  }

  /**
   * @param moves  passed into each other, the last one ends at rest.
   * @param q0     posture at the start, at rest. Only read.
   * @param beyondLimits  lays a run out even where it leaves the joint limits, to be drawn and explained.
   */
  plan(moves: readonly Move[], q0: Float64Array, beyondLimits = false): RunAnswer {
    const answer = this.lay(moves, q0);
    if (beyondLimits || answer.kind === "stopped") return answer;
    const stop = this.firstBeyond(answer.run);
    return stop === undefined ? answer : { kind: "stopped", stop };
  }

  /** What lies between sharp and widest at each corner of a run that was planned; see `RunPath.corners`. */
  corners(...of: Parameters<RunPath["corners"]>): CornerSweep[] {
    return this.path.corners(...of);
  }

  private lay(moves: readonly Move[], q0: Float64Array): RunAnswer {
    const first = moves[0];
    if (moves.length === 1 && first !== undefined && first.step.path === "ptp") {
      const goal = this.goals.find(first, q0);
      if (goal.kind === "none") return { kind: "stopped", stop: { kind: "goal", move: 0, goal } };
      return { kind: "timed", run: timeJointLeg(first, q0, goal.q_rad, this.robot) };
    }
    const stop = this.path.lay(moves, q0);
    if (stop !== undefined) return { kind: "stopped", stop };
    const run = this.timer.time(
      this.path.path,
      moves.map(move => move.step),
      q0,
      (move, q, q1) => this.tcpSlope(moves[move]!, q, q1),
    );
    return { kind: "timed", run };
  }

  /** The first node that lies outside the joint limits. */
  private firstBeyond(run: TimedRun): RunStop | undefined {
    const joints = this.robot.arm.joints;
    const n = joints.length;
    for (let move = 0; move < run.parts.length; move++) {
      const part = run.parts[move]!;
      for (let i = 0; i < part.q_rad.length; i++) {
        const { lower_rad, upper_rad } = joints[i % n]!.limits;
        const q = part.q_rad[i]!;
        if (q > upper_rad + LIMIT_SLACK_RAD || q < lower_rad - LIMIT_SLACK_RAD) {
          const share = part.duration_s > 0 ? part.times_s[Math.floor(i / n)]! / part.duration_s : 1;
          return {
            kind: "limit",
            move,
            share,
            joint: (i % n) + 1,
            wanted_rad: q,
            limit_rad: q > upper_rad ? upper_rad : lower_rad,
          };
        }
      }
    }
    return undefined;
  }

  /** |dp/ds| of the TCP on a joint leg. */
  private tcpSlope(move: Move, q: Float64Array, q1: Float64Array): number {
    const step = 1e-5;
    const at = (k: number) =>
      compose(
        flangePose(
          this.robot.arm,
          q.map((a, j) => a + q1[j]! * k),
        ),
        move.flangeFromTcp,
      ).position;
    return distance(at(-step), at(step)) / (2 * step);
  }
}
