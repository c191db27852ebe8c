import { inverseDynamics } from "../../dynamics/inverse-dynamics.ts";
import { dynamicsScratch } from "../../dynamics/placed.ts";
import type { Program } from "../../program/program.ts";
import type { Robot } from "../../model/robot.ts";
import type { Plan } from "../plan.ts";
import { segmentAt } from "../sample.ts";
import { eachInstant, instantAt, jointState } from "./instants.ts";
import { loadsAlong, torqueModel, type LoadOptions } from "./loads.ts";

/** Torques along a plan for a plot: rows in order of time, two where the acceleration jumps. Plain data. */
export interface TorqueProfile {
  readonly kind: "known";
  readonly joints: number;
  /** Seconds after the start of the plan, one a row. */
  readonly times_s: Float64Array;
  /** Rows × joints [N m; N of a slide]. */
  readonly torque_Nm: Float64Array;
  /** One a joint; Infinity where it is not published. */
  readonly limits_Nm: Float64Array;
}
export type TorqueSeries = TorqueProfile | { readonly kind: "unknown"; readonly sentence: string };

/**
 * Torques that a plan asks of every joint, by inverse dynamics (rows X-10, L-15): weight, inertia, centrifugal torques,
 * rotors where they are published, and the load that the program's payload steps say. Friction is not in it.
 */
export function torqueProfile(
  plan: Plan,
  robot: Robot,
  program: Pick<Program, "steps" | "routines">,
  options: LoadOptions & { readonly period_s?: number } = {},
): TorqueSeries {
  const known = torqueModel(robot, options.worldFromBase);
  if (known.kind === "unknown") return known;
  const n = robot.arm.joints.length;
  const loads = loadsAlong(plan, program, options.payload);
  const state = jointState(n);
  const torque = new Float64Array(n);
  const times: number[] = [];
  const rows: number[] = [];
  const scratch = dynamicsScratch(known.carrying(undefined));
  plan.segments.forEach((segment, s) => {
    const model = known.carrying(loads[s]);
    eachInstant(segment, options.period_s ?? 0.01, state, () => {
      inverseDynamics(model, state.q, state.qd, state.qdd, torque, scratch);
      times.push(segment.start_s + state.t_s);
      for (let j = 0; j < n; j++) rows.push(torque[j]!);
    });
  });
  return {
    kind: "known",
    joints: n,
    times_s: Float64Array.from(times),
    torque_Nm: Float64Array.from(rows),
    limits_Nm: known.limits_Nm,
  };
}

/**
 * Torques at any instant of a plan, as `torqueProfile` has them along all of it. The answer of `at` is reused by the
 * next call.
 */
export type TorqueAt =
  | { readonly kind: "known"; readonly at: (t_s: number) => Float64Array }
  | { readonly kind: "unknown"; readonly sentence: string };

export function torqueAt(
  plan: Plan,
  robot: Robot,
  program: Pick<Program, "steps" | "routines">,
  options: LoadOptions = {},
): TorqueAt {
  const known = torqueModel(robot, options.worldFromBase);
  if (known.kind === "unknown") return known;
  const n = robot.arm.joints.length;
  const loads = loadsAlong(plan, program, options.payload);
  const state = jointState(n);
  const torque = new Float64Array(n);
  const scratch = dynamicsScratch(known.carrying(undefined));
  const at = (t_s: number): Float64Array => {
    const index = segmentAt(plan, t_s);
    const segment = plan.segments[index];
    if (segment === undefined) return torque.fill(0);
    instantAt(segment, t_s - segment.start_s, state);
    return inverseDynamics(known.carrying(loads[index]), state.q, state.qd, state.qdd, torque, scratch);
  };
  return { kind: "known", at };
}
