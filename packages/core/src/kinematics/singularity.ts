import type { OrthoParallelGeometry, Robot } from "../robots/robot.ts";
import { degrees, millimetres } from "../spatial/units.ts";

/**
 * How far a posture is from each of the three singularities of an ortho-parallel arm with spherical wrist; each is 0 on
 * the singularity, where a finite tip speed needs an infinite joint speed.
 */
export interface SingularDistances {
  /** |sin θ5|: axes 4 and 6 in line at 0. */
  readonly wrist: number;
  /** |sin φ|, φ = θ3 + atan2(a2, c3): the arm stretched or folded at 0. */
  readonly elbow: number;
  /** Wrist centre from axis 1 [m]. */
  readonly shoulder_m: number;
}

export function singularDistances(geometry: OrthoParallelGeometry, q_rad: ArrayLike<number>): SingularDistances {
  const { signs, offsets_rad, a1_m, a2_m, b_m, c2_m, c3_m } = geometry;
  const t2 = signs[1] * q_rad[1]! - offsets_rad[1], t3 = signs[2] * q_rad[2]! - offsets_rad[2], t5 = signs[4] * q_rad[4]! - offsets_rad[4];
  const ahead = a1_m + c2_m * Math.sin(t2) + c3_m * Math.sin(t2 + t3) + a2_m * Math.cos(t2 + t3);
  return { wrist: Math.abs(Math.sin(t5)), elbow: Math.abs(Math.sin(t3 + Math.atan2(a2_m, c3_m))), shoulder_m: Math.sqrt(ahead * ahead + b_m * b_m) };
}

/** Closer than this to a singularity [sine, or m], a pose is called singular. */
const BAND = 1e-6;

/** Whether an angle is free or a direction of motion lost: wrist straight, arm stretched, or wrist centre on axis 1. */
export function isSingular(geometry: OrthoParallelGeometry, q_rad: ArrayLike<number>): boolean {
  const { wrist, elbow, shoulder_m } = singularDistances(geometry, q_rad);
  return wrist < BAND || elbow < BAND || shoulder_m < BAND;
}

/** The singularity a posture is nearest to, for a gauge: 1 is as far away as the arm can be, 0 is on it. */
export interface Singularity {
  readonly which: "wrist" | "elbow" | "shoulder";
  /** 0 … 1. */
  readonly clearance: number;
  readonly sentence: string;
}

/** The nearest singularity of a posture, or null for an arm whose singularities have no names. */
export function nearestSingularity(robot: Robot, q_rad: ArrayLike<number>): Singularity | null {
  const family = robot.family;
  if (family.kind !== "ortho-parallel") return null;
  const { wrist, elbow, shoulder_m } = singularDistances(family, q_rad);
  const reach_m = family.a1_m + family.c2_m + Math.sqrt(family.a2_m ** 2 + family.c3_m ** 2), shoulder = Math.min(1, shoulder_m / reach_m);
  if (wrist <= elbow && wrist <= shoulder) {
    return { which: "wrist", clearance: wrist, sentence: `Joint 5 is ${degrees(Math.asin(Math.min(1, wrist))).toFixed(1)}° from where axes 4 and 6 are in line.` };
  }
  if (elbow <= shoulder) {
    return { which: "elbow", clearance: elbow, sentence: `Joint 3 is ${degrees(Math.asin(Math.min(1, elbow))).toFixed(1)}° from where the arm is in one line.` };
  }
  return { which: "shoulder", clearance: shoulder, sentence: `The wrist centre is ${millimetres(shoulder_m).toFixed(0)} mm from axis 1, where joint 1 has no hold on it.` };
}
