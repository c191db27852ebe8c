import { computedTorque, computedTorqueScratch } from "../../dynamics/computed-torque.ts";
import { armDriveGains, driveTorque, type DriveGains } from "../../dynamics/drive.ts";
import { forwardDynamics } from "../../dynamics/forward-dynamics.ts";
import { inverseDynamics } from "../../dynamics/inverse-dynamics.ts";
import { massMatrix } from "../../dynamics/mass-matrix.ts";
import type { DynamicsModel } from "../../dynamics/model.ts";
import { dynamicsScratch } from "../../dynamics/placed.ts";
import { armScratch, flangePose } from "../../kinematics/forward.ts";
import type { Program } from "../../program/program.ts";
import type { Robot } from "../../model/robot.ts";
import { identity } from "../../spatial/pose.ts";
import { distance } from "../../spatial/vector.ts";
import type { Plan } from "../plan.ts";
import { segmentAt } from "../sample.ts";
import { instantAt, jointState } from "./instants.ts";
import { loadsAlong, torqueModel, type LoadOptions } from "./loads.ts";

/** How the joints are driven along a plan. Torques saturate at the published limits. */
export type Control =
  /**
   * A spring and a damper on every joint (row L-12), critically damped where the plan starts, beside what holds the
   * arm's own weight.
   */
  | { readonly kind: "drives"; readonly bandwidth_rad_s: number }
  /** The same with gains of one's own, and nothing beside them. */
  | { readonly kind: "gains"; readonly gains: readonly DriveGains[] }
  /** Row L-68. */
  | { readonly kind: "computed-torque"; readonly bandwidth_rad_s: number };

export interface TrackingOptions extends LoadOptions {
  readonly control: Control;
  /** Shares of the planned speed to try. */
  readonly overrides: readonly number[];
  /** The controller knows of no load and reckons with the bare arm. */
  readonly loadUnknown?: boolean;
  /** Step of the integration [s]. */
  readonly step_s?: number;
}

/** How far the robot is off the plan at one override. */
export interface TrackingRow {
  readonly override: number;
  readonly duration_s: number;
  /** Of the flange from where it should be at that moment: the largest, and the root of the mean square [m]. */
  readonly worst_m: number;
  readonly rms_m: number;
  /** Of a joint [rad; m of a slide]. */
  readonly worstJoint_rad: number;
  /** Time in which some joint gives all it can [s]. */
  readonly saturated_s: number;
}
export type Tracking =
  | { readonly kind: "known"; readonly rows: readonly TrackingRow[] }
  | { readonly kind: "unknown"; readonly sentence: string };

const STEP_S = 2.5e-4;

/**
 * Accuracy over speed (row X-45): the plan is driven by forward dynamics at each override, and what the flange is off
 * is measured.
 *
 *   q̈ = FD(q, q̇, τ),   τ from the control,   q̇ ← q̇ + q̈ h,   q ← q + q̇ h
 *
 * Reference at override s:
 *   q(s t), s q̇(s t), s² q̈(s t).
 * Nothing but masses and saturation is in it: no friction, no play, no sensor.
 */
export function trackingError(
  plan: Plan,
  robot: Robot,
  program: Pick<Program, "steps" | "routines">,
  options: TrackingOptions,
): Tracking {
  const known = torqueModel(robot, options.worldFromBase);
  if (known.kind === "unknown") return known;
  const loads = loadsAlong(plan, program, options.payload);
  const models = loads.map(load => known.carrying(load));
  const believed = options.loadUnknown === true ? models.map(() => known.carrying(undefined)) : models;
  return {
    kind: "known",
    rows:
      plan.segments.length === 0
        ? []
        : options.overrides.map(override => drive(plan, robot, models, believed, known.limits_Nm, override, options)),
  };
}

function drive(
  plan: Plan,
  robot: Robot,
  models: readonly DynamicsModel[],
  believed: readonly DynamicsModel[],
  limits_Nm: Float64Array,
  override: number,
  options: TrackingOptions,
): TrackingRow {
  const { control, step_s = STEP_S } = options;
  const n = limits_Nm.length;
  const wanted = jointState(n);
  const bare = models[0]!;
  const scratch = dynamicsScratch(bare);
  const working = computedTorqueScratch(bare);
  const torque = new Float64Array(n);
  const weight = torque.slice();
  const none = torque.slice();
  const qdd = torque.slice();
  const arm = armScratch();
  const is = identity<"base", "flange">();
  const should = identity<"base", "flange">();
  const reference = (t_s: number): number => {
    const index = segmentAt(plan, t_s * override);
    const segment = plan.segments[index]!;
    instantAt(segment, t_s * override - segment.start_s, wanted);
    for (let j = 0; j < n; j++) {
      wanted.qd[j]! *= override;
      wanted.qdd[j]! *= override * override;
    }
    return index;
  };
  const first = reference(0);
  const q = wanted.q.slice();
  const qd = wanted.qd.slice();
  const gains = gainsOf(control, believed[first]!, q, limits_Nm);
  const duration_s = plan.duration_s / override;
  const steps = Math.ceil(duration_s / step_s);
  let worst_m = 0;
  let squares = 0;
  let worstJoint_rad = 0;
  let saturated_s = 0;
  for (let k = 0; k < steps; k++) {
    const index = reference(k * step_s);
    if (control.kind === "computed-torque")
      computedTorque(believed[index]!, wanted, q, qd, control.bandwidth_rad_s, limits_Nm, torque, working);
    else {
      if (control.kind === "drives") inverseDynamics(believed[index]!, q, none, none, weight, scratch);
      for (let j = 0; j < n; j++)
        torque[j] = clamped(
          driveTorque(gains[j]!, wanted.q[j]!, q[j]!, wanted.qd[j]!, qd[j]!) + weight[j]!,
          limits_Nm[j]!,
        );
    }
    let full = false;
    for (let j = 0; j < n; j++) full ||= Math.abs(torque[j]!) >= limits_Nm[j]!;
    if (full) saturated_s += step_s;
    forwardDynamics(models[index]!, q, qd, torque, qdd, scratch);
    for (let j = 0; j < n; j++) {
      qd[j]! += qdd[j]! * step_s;
      q[j]! += qd[j]! * step_s;
    }
    reference((k + 1) * step_s);
    const off_m = distance(
      flangePose(robot.arm, q, is, arm).position,
      flangePose(robot.arm, wanted.q, should, arm).position,
    );
    worst_m = Math.max(worst_m, off_m);
    squares += off_m * off_m;
    for (let j = 0; j < n; j++) worstJoint_rad = Math.max(worstJoint_rad, Math.abs(q[j]! - wanted.q[j]!));
  }
  return { override, duration_s, worst_m, rms_m: Math.sqrt(squares / Math.max(1, steps)), worstJoint_rad, saturated_s };
}

const clamped = (torque: number, limit: number): number => Math.max(-limit, Math.min(limit, torque));

function gainsOf(
  control: Control,
  model: DynamicsModel,
  q: Float64Array,
  limits_Nm: Float64Array,
): readonly DriveGains[] {
  if (control.kind === "computed-torque") return [];
  if (control.kind === "gains") return control.gains;
  const n = q.length;
  const mass = massMatrix(model, q);
  return Array.from({ length: n }, (_, j) =>
    armDriveGains(mass[j * n + j]! * control.bandwidth_rad_s ** 2, mass[j * n + j]!, limits_Nm[j]!),
  );
}
