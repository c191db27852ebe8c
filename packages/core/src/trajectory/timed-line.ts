import { solveAll, solverScratch, type SolverScratch } from "../kinematics/inverse.ts";
import { explainReach } from "../kinematics/explain.ts";
import type { Reach } from "../kinematics/reach.ts";
import type { Robot } from "../model/robot.ts";
import { identity, type Pose } from "../spatial/pose.ts";
import { fromEulerAngles, toEulerAngles, type EulerSequence } from "../spatial/turns.ts";
import { degrees, wrapAngle } from "../spatial/units.ts";
import type { Vector3 } from "../spatial/vector.ts";
import { cubicLaw, type LawPoint } from "./laws.ts";

export interface TimedLineOptions {
  /**
   * How the turn angles go over time: by the same cubic as the position, or evenly (the paper says both, erratum E-24).
   */
  readonly angles?: "cubic" | "linear";
  readonly sequence?: EulerSequence;
}

/**
 * A straight line of the tool with a given duration, as the lead-through paper writes it:
 *
 *   p(t) = p₀ + π(t/T) (p₁ − p₀),   turn angles α(t) = α₀ + π(t/T) (α₁ − α₀),   π(τ) = 3τ² − 2τ³
 *
 * The speed is set by T alone. Everything is a formula of t, so whatever frame rate looks at it sees the same path.
 *
 * @see row L-50 … L-54, Table A4 and Appendix C of the paper.
 */
export class TimedLine {
  readonly from: Pose;
  readonly to: Pose;
  readonly duration_s: number;
  private readonly linear: boolean;
  private readonly sequence: EulerSequence;
  private readonly begin: Vector3;
  private readonly sweep: Vector3;
  private readonly law: LawPoint = { value: 0, speed: 0, acceleration: 0 };

  constructor(from: Pose, to: Pose, duration_s: number, { angles = "cubic", sequence = "yxz" }: TimedLineOptions = {}) {
    this.from = from;
    this.to = to;
    this.duration_s = duration_s;
    this.linear = angles === "linear";
    this.sequence = sequence;
    this.begin = toEulerAngles(sequence, from.quaternion);
    const end = toEulerAngles(sequence, to.quaternion);
    this.sweep = [
      wrapAngle(end[0] - this.begin[0]),
      wrapAngle(end[1] - this.begin[1]),
      wrapAngle(end[2] - this.begin[2]),
    ];
  }

  /** Pose of the tool at t; before the start the first, after the end the last. */
  at(t_s: number, out: Pose = identity()): Pose {
    const tau = this.duration_s > 0 ? Math.min(1, Math.max(0, t_s / this.duration_s)) : 1;
    const share = cubicLaw(tau, this.law).value;
    const turn = this.linear ? tau : share;
    for (let i = 0; i < 3; i++)
      out.position[i] = this.from.position[i]! + (this.to.position[i]! - this.from.position[i]!) * share;
    fromEulerAngles(
      this.sequence,
      this.begin[0] + this.sweep[0] * turn,
      this.begin[1] + this.sweep[1] * turn,
      this.begin[2] + this.sweep[2] * turn,
      out.quaternion,
    );
    return out;
  }
}

/** How a frame was judged. Joints count from 1. */
export type FrameVerdict =
  | { readonly kind: "fine" }
  | { readonly kind: "unreachable"; readonly reach: Reach; readonly sentence: string }
  | {
      readonly kind: "position" | "speed";
      readonly joint: number;
      readonly value: number;
      readonly limit: number;
      readonly sentence: string;
    };

const FINE: FrameVerdict = { kind: "fine" };

/**
 * Steps 3 to 6 of Table A4, once a rendering frame: inverse kinematics of the pose, position check, joint speeds by
 * Euler's difference q̇ = (q − q_before)/Δt, speed check against what the motors can do (rows L-25, L-26, L-55, L-56).
 */
export class FrameCheck {
  readonly q_rad: Float64Array;
  readonly qd_rad_s: Float64Array;
  private readonly robot: Robot;
  private readonly scratch: SolverScratch = solverScratch();
  private begun = false;

  /** @param near  the posture the first frame is nearest to. */
  constructor(robot: Robot, near: ArrayLike<number>) {
    this.robot = robot;
    this.q_rad = Float64Array.from(near);
    this.qd_rad_s = new Float64Array(near.length);
  }

  /** @param dt_s  since the frame before; the first frame has no speed. */
  frame(baseFromFlange: Pose<"base", "flange">, dt_s: number): FrameVerdict {
    const { robot, q_rad, qd_rad_s } = this;
    const joints = robot.arm.joints;
    const reach = solveAll(robot, baseFromFlange, { near: q_rad }, this.scratch);
    if (reach.kind === "outside-limits") return position(reach.joint, reach.wanted_rad, reach.limit_rad);
    if (reach.kind !== "reached") return { kind: "unreachable", reach, sentence: explainReach(reach) };
    const q = reach.solutions[0]!.q_rad;
    let worst: FrameVerdict = FINE;
    let by = 1;
    for (let j = 0; j < q.length; j++) {
      qd_rad_s[j] = this.begun && dt_s > 0 ? (q[j]! - q_rad[j]!) / dt_s : 0;
      const limit = joints[j]!.limits.speed_rad_s;
      const load = Math.abs(qd_rad_s[j]!) / limit;
      if (load > by) {
        by = load;
        worst = speed(j + 1, qd_rad_s[j]!, limit);
      }
    }
    q_rad.set(q);
    this.begun = true;
    return worst;
  }
}

const position = (joint: number, value: number, limit: number): FrameVerdict => ({
  kind: "position",
  joint,
  value,
  limit,
  sentence: `Joint position q${joint} out of limit: ${degrees(value).toFixed(1)}°, its limit is ${degrees(limit).toFixed(1)}°.`,
});
const speed = (joint: number, value: number, limit: number): FrameVerdict => ({
  kind: "speed",
  joint,
  value,
  limit,
  sentence: `Joint speed q̇${joint} out of limit: ${degrees(value).toFixed(1)}°/s, its limit is ${degrees(limit).toFixed(1)}°/s.`,
});
