import type { ProgramChange } from "../program/edit.ts";
import type { Vector3 } from "../spatial/vector.ts";

/**
 * What a way out changes. "target": the point is moved; "edge": points are put back onto the edge they were traced on;
 * "part": what it was taught on; "base": the robot; "zone": the robot stops
 * at the point.
 */
export type RepairKind =
  | "branch"
  | "spin"
  | "tilt"
  | "target"
  | "edge"
  | "part"
  | "base"
  | "joint"
  | "joint-move"
  | "detour"
  | "zone"
  | "slower";

/** A way out that a person can apply with one click: the step as it would be, and what else has to change with it. */
export interface Repair extends ProgramChange {
  readonly sentence: string;
  readonly kind?: RepairKind;
  /** The robot stands elsewhere by this much [m], in the world. */
  readonly moveBase?: { readonly by_m: Vector3 };
}

export interface Finding {
  /**
   * "reach.too-far", "limits.joint", "speed.joint", "branch.jump", "collision.contact", "collision.corner",
   * "collision.corner-out-of-reach", …
   */
  readonly code: string;
  /** Counts from 1. */
  readonly joint?: number;
  readonly value: number;
  readonly limit: number;
  readonly unit: "rad" | "m" | "rad/s" | "rad/s2" | "rad/s3" | "m/s" | "m/s2" | "m/s3" | "s" | "kg" | "Nm" | "N" | "1";
  /** Seconds after the start of the program. */
  readonly at_s: number;
  readonly sentence: string;
  readonly repairs: readonly Repair[];
}

export type StepVerdict = "ok" | "warn" | "bad" | "unknown";
export interface StepReport {
  readonly id: string;
  readonly verdict: StepVerdict;
  readonly findings: readonly Finding[];
}

/** The greatest torque that a joint is asked for [N m; N of a slide], when and in which step. Joints count from 1. */
export interface JointTorque {
  readonly joint: number;
  readonly torque_Nm: number;
  /** null where it is not published. */
  readonly limit_Nm: number | null;
  readonly at_s: number;
  readonly step: string;
}

/** Row X-10: torques of a robot whose masses or torque limits nobody publishes are unknown, and never "ok". */
export type TorqueVerdict =
  | { readonly kind: "known"; readonly joints: readonly JointTorque[]; readonly sentence: string }
  | { readonly kind: "unknown"; readonly sentence: string };

/** What the checker says of a program. `ok` is true when every step is ok or warned of: none bad, none unknown. */
export interface Verdict {
  readonly ok: boolean;
  readonly steps: readonly StepReport[];
  readonly duration_s: number;
  /** Least distance seen between the robot and the cell over the whole program; null when it was not measured. */
  readonly clearance_m: number | null;
  readonly torque: TorqueVerdict;
  /** What the result rests on, one sentence each. */
  readonly assumptions: readonly string[];
}
