import type { SerialArm } from "../model/arm.ts";
import type { OrthoParallelGeometry, Robot, SphericalSevenGeometry, ThreeParallelGeometry } from "../model/robot.ts";
import { degrees, millimetres } from "../spatial/units.ts";
import { jacobian } from "./jacobian.ts";
import { singularValues } from "./manipulability.ts";

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
  const t2 = signs[1] * q_rad[1]! - offsets_rad[1];
  const t3 = signs[2] * q_rad[2]! - offsets_rad[2];
  const t5 = signs[4] * q_rad[4]! - offsets_rad[4];
  const ahead = a1_m + c2_m * Math.sin(t2) + c3_m * Math.sin(t2 + t3) + a2_m * Math.cos(t2 + t3);
  return {
    wrist: Math.abs(Math.sin(t5)),
    elbow: Math.abs(Math.sin(t3 + Math.atan2(a2_m, c3_m))),
    shoulder_m: Math.sqrt(ahead * ahead + b_m * b_m),
  };
}

/** Closer than this to a singularity [sine, or m], a pose is called singular. */
const BAND = 1e-6;

/** Whether an angle is free or a direction of motion lost: wrist straight, arm stretched, or wrist centre on axis 1. */
export function isSingular(geometry: OrthoParallelGeometry, q_rad: ArrayLike<number>): boolean {
  const { wrist, elbow, shoulder_m } = singularDistances(geometry, q_rad);
  return wrist < BAND || elbow < BAND || shoulder_m < BAND;
}

/**
 * The same for the other families: of arms whose singularities have no formula, by the least singular value of the
 * Jacobian.
 */
export function isSingularConfiguration(robot: Robot, q_rad: ArrayLike<number>): boolean {
  const family = robot.family;
  switch (family.kind) {
    case "ortho-parallel":
      return isSingular(family, q_rad);
    case "three-parallel": {
      const { wrist, elbow, shoulder_m } = threeParallelDistances(family, q_rad);
      return wrist < BAND || elbow < BAND || shoulder_m < BAND;
    }
    case "spherical-seven":
    case "general-6r":
    case "general":
      return minSingularValue(robot.arm, q_rad) < BAND;
  }
}

/**
 * The sixth singular value of the Jacobian, of fewer joints the last [m or rad per rad]: 0 where a direction of motion
 * is lost.
 */
export const minSingularValue = (arm: SerialArm, q_rad: ArrayLike<number>): number =>
  singularValues(jacobian(arm, q_rad))[Math.min(6, arm.joints.length) - 1] ?? 0;

/**
 * As of an ortho-parallel arm: axes 4 and 6 parallel, the arm stretched or folded, the meeting of axes 5 and 6 above
 * axis 1.
 */
export function threeParallelDistances(
  { signs, offsets_rad, a1_m, c2_m, c3_m, c5_m }: ThreeParallelGeometry,
  q_rad: ArrayLike<number>,
): SingularDistances {
  const [, t2, t3, t4, t5] = signs.map((sign, j) => sign * q_rad[j]! - offsets_rad[j]!) as [
    number,
    number,
    number,
    number,
    number,
    number,
  ];
  const ahead = a1_m + c2_m * Math.sin(t2) + c3_m * Math.sin(t2 + t3) + c5_m * Math.sin(t2 + t3 + t4);
  return { wrist: Math.abs(Math.sin(t5)), elbow: Math.abs(Math.sin(t3)), shoulder_m: Math.abs(ahead) };
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
  if (family.kind === "spherical-seven") return nearestOfSeven(family, q_rad);
  if (family.kind !== "ortho-parallel" && family.kind !== "three-parallel") return null;
  const { wrist, elbow, shoulder_m } =
    family.kind === "ortho-parallel" ? singularDistances(family, q_rad) : threeParallelDistances(family, q_rad);
  const reach_m =
    family.kind === "ortho-parallel"
      ? family.a1_m + family.c2_m + Math.sqrt(family.a2_m ** 2 + family.c3_m ** 2)
      : family.a1_m + family.c2_m + family.c3_m + family.c5_m;
  const shoulder = Math.min(1, shoulder_m / reach_m);
  if (wrist <= elbow && wrist <= shoulder) {
    return {
      which: "wrist",
      clearance: wrist,
      sentence: `Joint 5 is ${degrees(Math.asin(Math.min(1, wrist))).toFixed(1)}° from where axes 4 and 6 are ${family.kind === "ortho-parallel" ? "in line" : "parallel"}.`,
    };
  }
  if (elbow <= shoulder) {
    return {
      which: "elbow",
      clearance: elbow,
      sentence: `Joint 3 is ${degrees(Math.asin(Math.min(1, elbow))).toFixed(1)}° from where the arm is in one line.`,
    };
  }
  return {
    which: "shoulder",
    clearance: shoulder,
    sentence: `The wrist centre is ${millimetres(shoulder_m).toFixed(0)} mm from axis 1, where joint 1 has no hold on it.`,
  };
}

/**
 * With the elbow free to move a seven-joint arm loses a direction only where two of these meet, or when it is
 * stretched; the elbow's own motion suffers at each.
 */
function nearestOfSeven({ signs, offsets_rad }: SphericalSevenGeometry, q_rad: ArrayLike<number>): Singularity {
  const sine = (j: number): number => Math.abs(Math.sin(signs[j]! * q_rad[j]! - offsets_rad[j]!));
  const shoulder = sine(1);
  const elbow = sine(3);
  const wrist = sine(5);
  const away = (value: number): string => `${degrees(Math.asin(value)).toFixed(1)}°`;
  if (wrist <= elbow && wrist <= shoulder)
    return {
      which: "wrist",
      clearance: wrist,
      sentence: `Joint 6 is ${away(wrist)} from where axes 5 and 7 are in line.`,
    };
  if (elbow <= shoulder)
    return {
      which: "elbow",
      clearance: elbow,
      sentence: `Joint 4 is ${away(elbow)} from where the arm is in one line.`,
    };
  return {
    which: "shoulder",
    clearance: shoulder,
    sentence: `Joint 2 is ${away(shoulder)} from where axes 1 and 3 are in line.`,
  };
}
