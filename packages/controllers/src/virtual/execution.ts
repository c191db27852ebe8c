import type { Program, Refusal, Robot, Step } from "@twincell/core";
import { jointRefusal } from "../refusals.ts";

/** Steps being carried out, one cycle at a time. */
export interface Execution {
  /**
   * Moves on by one cycle.
   *
   * @param dt_s   length of the cycle.
   * @param rate   0 … 1: motion runs at this part of its speed; waiting times run whole unless it is 0.
   * @param q_rad  receives the joint angles at the end of the cycle.
   */
  advance(dt_s: number, rate: number, q_rad: Float64Array): "going" | "finished" | Refusal;
  /** Id of the step being carried out. */
  readonly step: string;
  readonly gripperClosed: boolean;
  /** Waiting or gripping: the joints stand. */
  readonly resting: boolean;
}

export interface ExecutionStart { readonly robot: Robot; readonly q_rad: Float64Array; readonly gripperClosed: boolean }
/** How steps become motion; the iterator is asked for the next step when it is needed. */
export type Execute = (steps: Iterator<Step>, context: Pick<Program, "tools" | "frames">, start: ExecutionStart) => Execution;

/** Joint moves from rest to rest, waits and the gripper. Needs no kinematics: what it cannot do it refuses by name. */
export const executeJointMoves: Execute = (steps, _context, start) => {
  const { robot } = start, n = robot.arm.joints.length;
  const from = Float64Array.from(start.q_rad), span = new Float64Array(n);
  const state = { step: "", gripperClosed: start.gripperClosed, resting: false };
  let left_s = 0, s = 0, along: Trapezoid | null = null;

  function begin(step: Step): Refusal | null {
    state.step = step.id;
    state.resting = step.type !== "move";
    if (step.type === "wait") left_s = step.s;
    else if (step.type === "gripper") state.gripperClosed = step.closed;
    else {
      if (!("q" in step.target) || step.path !== "ptp") {
        return { code: "controller.joint-moves-only", sentence: `Step ${step.id} is not a joint move.`, hint: "Teach it as joint angles with a PTP move." };
      }
      const why = jointRefusal(robot, step.target.q);
      if (why) return why;
      for (let i = 0; i < n; i++) span[i] = step.target.q[i]! - from[i]!;
      along = trapezoid(robot, span, "ratio" in step.speed ? step.speed.ratio : 1);
      s = 0;
    }
    return null;
  }

  return {
    get step() { return state.step; },
    get gripperClosed() { return state.gripperClosed; },
    get resting() { return state.resting; },
    advance(dt_s, rate, q_rad) {
      let remaining_s = dt_s;
      for (;;) {
        if (along) {
          s += remaining_s * rate;
          const part = along.at(s);
          for (let i = 0; i < n; i++) q_rad[i] = from[i]! + part * span[i]!;
          if (s < along.duration_s) return "going";
          remaining_s = rate > 0 ? (s - along.duration_s) / rate : 0;
          for (let i = 0; i < n; i++) { from[i]! += span[i]!; q_rad[i] = from[i]!; }
          along = null;
        }
        if (left_s > 0) {
          if (rate === 0) return "going";
          left_s -= remaining_s;
          if (left_s > 1e-9) return "going";
          remaining_s = -left_s;
          left_s = 0;
        }
        const next = steps.next();
        if (next.done) return "finished";
        const why = begin(next.value);
        if (why) return why;
      }
    },
  };
};

interface Trapezoid { readonly duration_s: number; at(t_s: number): number }

/**
 * Way along a straight line in joint space, 0 … 1, all joints together, the slowest at its limit:
 *
 *   v = ratio · min_i (q̇max_i / |Δ_i|)     a = min_i (q̈max_i / |Δ_i|)
 */
function trapezoid(robot: Robot, span: Float64Array, ratio: number): Trapezoid {
  let v = Infinity, a = Infinity;
  robot.arm.joints.forEach((joint, i) => {
    const way = Math.abs(span[i]!);
    if (way === 0) return;
    v = Math.min(v, ratio * joint.limits.speed_rad_s / way);
    a = Math.min(a, joint.limits.acceleration_rad_s2 / way);
  });
  if (v === Infinity) return { duration_s: 0, at: () => 1 };
  const ramp_s = Math.min(v / a, Math.sqrt(1 / a)), top = a * ramp_s, cruise_s = Math.max(0, 1 / top - ramp_s);
  const duration_s = 2 * ramp_s + cruise_s;
  return {
    duration_s,
    at(t_s) {
      if (t_s <= 0) return 0;
      if (t_s >= duration_s) return 1;
      if (t_s < ramp_s) return a * t_s * t_s / 2;
      const left_s = duration_s - t_s;
      return left_s < ramp_s ? 1 - a * left_s * left_s / 2 : top * (t_s - ramp_s / 2);
    },
  };
}
