import {
  compose,
  explainStop,
  resolveMove,
  RunPlanner,
  type MoveStep,
  type PlanContext,
  type Refusal,
  type Robot,
} from "@twincell/core";
import type { AdapterMotion } from "./adapter.ts";
import { noSuchMotion } from "./words.ts";

export type MotionAnswer =
  | { readonly kind: "motion"; readonly motion: AdapterMotion }
  | { readonly kind: "refused"; readonly why: Refusal };

/**
 * Turns move steps into motions of a controller: frames and tools resolved to base and flange, reach and limits looked
 * at first.
 */
export class MotionMaker {
  private readonly robot: Robot;
  private readonly planner: RunPlanner;

  constructor(robot: Robot) {
    this.robot = robot;
    this.planner = new RunPlanner(robot);
  }

  /** @param from_rad  where the robot stands, at rest. */
  make(step: MoveStep, context: PlanContext, from_rad: Float64Array): MotionAnswer {
    const { robot } = this;
    if (step.path === "spline") return { kind: "refused", why: noSuchMotion(robot, step, "part of a spline") };
    if (step.until !== undefined) return { kind: "refused", why: noSuchMotion(robot, step, "a search") };
    const move = resolveMove(step, robot, context);
    const answer = this.planner.plan([move], from_rad);
    if (answer.kind === "stopped") return { kind: "refused", why: explainStop(answer.stop, move, robot) };
    const { parts, duration_s } = answer.run;
    const n = from_rad.length;
    const q_rad = parts.at(-1)?.q_rad.slice(-n) ?? from_rad.slice();
    const acceleration = step.acceleration?.ratio ?? 1;
    const base = { q_rad, acceleration, duration_s };
    if (step.path === "ptp")
      return {
        kind: "motion",
        motion: { ...base, path: "joints", ratio: this.ratio(step, move, from_rad, duration_s) },
      };
    const speed_mps =
      "mps" in step.speed
        ? step.speed.mps
        : "ratio" in step.speed
          ? step.speed.ratio * robot.maxTcpSpeed_mps
          : this.length(step, context, from_rad) / step.speed.time_s;
    const { baseFromFlange } = move;
    return move.via === undefined
      ? { kind: "motion", motion: { ...base, path: "line", baseFromFlange, speed_mps } }
      : {
          kind: "motion",
          motion: {
            ...base,
            path: "arc",
            baseFromVia: compose(move.via, move.tcpFromFlange),
            baseFromFlange,
            speed_mps,
          },
        };
  }

  /** A speed of the tool or a duration as the share of joint speed that takes as long. */
  private ratio(
    step: MoveStep,
    move: ReturnType<typeof resolveMove>,
    from_rad: Float64Array,
    duration_s: number,
  ): number {
    if ("ratio" in step.speed) return step.speed.ratio;
    const full = this.planner.plan([{ ...move, step: { ...step, speed: { ratio: 1 } } }], from_rad);
    return full.kind === "timed" && duration_s > 0 ? Math.min(1, full.run.duration_s / duration_s) : 1;
  }

  /** Length of the path of the tool [m]: a slow run at 1 m/s takes as many seconds, its ramps apart. */
  private length(step: MoveStep, context: PlanContext, from_rad: Float64Array): number {
    const SLOW_MPS = 1e-3;
    const run = this.planner.plan([resolveMove({ ...step, speed: { mps: SLOW_MPS } }, this.robot, context)], from_rad);
    return run.kind === "timed" ? run.run.duration_s * SLOW_MPS : 0;
  }
}
