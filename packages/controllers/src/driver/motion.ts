import {
  compose,
  explainStop,
  resolveMove,
  RunPlanner,
  type MoveStep,
  type PlanContext,
  type Pose,
  type Refusal,
  type Robot,
} from "@twincell/core";
import type { AdapterMotion } from "./adapter.ts";

/** A share of joint speed is found for a duration to this part of it, in no more rounds than these. */
const SAME_TIME = 1e-3;
const MOST_ROUNDS = 30;

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

  /**
   * @param step  one that the connection can say: a spline or a search has no motion of its own here.
   * @param from_rad  where the robot stands, at rest. */
  make(step: MoveStep, context: PlanContext, from_rad: Float64Array): MotionAnswer {
    const { robot } = this;
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
    // Ramps take their time at any speed: the share is mended by what it still misses, from full speed downwards.
    let share = 1;
    for (let round = 0; round < MOST_ROUNDS; round++) {
      const tried = this.planner.plan([{ ...move, step: { ...step, speed: { ratio: share } } }], from_rad);
      if (tried.kind !== "timed" || !(duration_s > 0)) return 1;
      const took = tried.run.duration_s / duration_s;
      if (Math.abs(took - 1) < SAME_TIME || (share === 1 && took > 1)) break;
      share = Math.min(1, share * took);
    }
    return share;
  }

  /** Length of the path of the tool [m]: a slow run at 1 m/s takes as many seconds, its ramps apart. */
  private length(step: MoveStep, context: PlanContext, from_rad: Float64Array): number {
    const SLOW_MPS = 1e-3;
    const run = this.planner.plan([resolveMove({ ...step, speed: { mps: SLOW_MPS } }, this.robot, context)], from_rad);
    return run.kind === "timed" ? run.run.duration_s * SLOW_MPS : 0;
  }
}

/** A motion as a step of a program, for adapters that make the path themselves. */
export function stepOfMotion(motion: AdapterMotion): MoveStep {
  const base = { id: "motion", type: "move", blend_m: 0, acceleration: { ratio: motion.acceleration } } as const;
  // The base is the world here, and the flange its tool.
  const at = (baseFromFlange: Pose<"base", "flange">) => ({
    pose: baseFromFlange as Pose as Pose<"frame", "tcp">,
    frame: "world",
    tool: "flange",
  });
  switch (motion.path) {
    case "joints":
      return { ...base, path: "ptp", target: { q: [...motion.q_rad] }, speed: { ratio: motion.ratio } };
    case "line":
      return { ...base, path: "lin", target: at(motion.baseFromFlange), speed: { mps: motion.speed_mps } };
    case "arc":
      return {
        ...base,
        path: "circ",
        target: at(motion.baseFromFlange),
        via: at(motion.baseFromVia),
        speed: { mps: motion.speed_mps },
      };
  }
}
