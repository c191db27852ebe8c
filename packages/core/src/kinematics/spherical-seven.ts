import type { SphericalSevenGeometry } from "../model/robot.ts";
import type { Pose } from "../spatial/pose.ts";
import { formulaToJoints, freeAngle, wantedWrist, WRIST_NUMBERS } from "./wrist.ts";

/** Below this sine of θ2 or θ6 the axes on both sides are one line, and one of the two angles is free to choose. */
const SINGULAR_SINE = 2e-10;
/** Outside the reach by no more than this is a rounding of its edge [m]. */
const EDGE_M = 4e-10;
/**
 * Nearer than this to upright, shoulder to wrist has no vertical plane: the elbow then counts from the formula's x
 * axis.
 */
const UPRIGHT_SINE = 1e-9;
/**
 * An arm that misses the formula is given no straighter start than this [sine]: a stretched one could be refined to
 * neither side.
 */
const LEAST_BEND = 0.02;
/** Kept between the steps of one call: the wanted wrist. */
const WANTED = new Float64Array(WRIST_NUMBERS);
/** Kept between the steps of one call: the arm on its way, from the upper arm to what θ7 follows from. */
const STEP = new Float64Array(18);
const UX = 0;
const UY = 1;
const UZ = 2;
const DX = 3;
const DY = 4;
const DZ = 5;
const COS4 = 6;
const SIN4 = 7;
const THETA1 = 8;
const THETA2 = 9;
const THETA3 = 10;
const THETA4 = 11;
const THETA5 = 12;
const THETA6 = 13;
const V11 = 14;
const V12 = 15;
const V21 = 16;
const V22 = 17;

/**
 * Closed-form inverse of a seven-joint arm with spherical shoulder and wrist, all eight branches of one elbow angle.
 *
 *   w = unit vector shoulder → wrist, r its length;   t1 ⊥ w in the vertical plane through w, upwards;   t2 = w × t1
 *   t = cos ψ · t1 + sin ψ · t2                                     where the elbow stands off the line shoulder–wrist
 *   cos θ4 = (r² − c3² − c5²) / (2 c3 c5);   α = atan2(c5 |sin θ4|, c3 + c5 cos θ4)
 *   u = cos α · w + sin α · t = Rz(θ1) Ry(θ2) ẑ                     the upper arm;   θ2 = ±
 *   d = sin α · w − cos α · t = ± Rz(θ1) Ry(θ2) Rz(θ3) x̂            the side the forearm bends to;   θ4 = ±
 *   Rz(θ5) Ry(θ6) Rz(θ7) = R04ᵀ R                                   θ6 = ±
 *
 * ψ = 0 is the elbow in the vertical plane and above, and it counts right-handed about shoulder → wrist. It decides θ3
 * of a stretched arm as well. Where θ2 = 0 (or π) θ1 is taken from `near`, or 0; where θ6 = 0 (or π) θ5 likewise.
 *
 * @param elbow_rad  the elbow angle ψ.
 * @param out        receives up to eight solutions of seven angles [rad], the robot's own zero and sign, in (−π, π].
 *                   Order: θ2 ≥ 0, θ2 < 0; within it θ4 ≥ 0, θ4 < 0; within it θ6 ≥ 0, θ6 < 0.
 * @param near       seven joint angles that free angles are taken from, or undefined.
 * @returns number of solutions: 0 … 8. Allocates nothing. Limits are not looked at.
 * @see Shimizu, Kakuya, Yoon, Kitagaki, Kosuge, Analytical Inverse Kinematic Computation for 7-DOF Redundant
 * Manipulators
 *      With Joint Limits, IEEE Transactions on Robotics 24 (2008).
 */
export function solveSphericalSeven(
  geometry: SphericalSevenGeometry,
  baseFromFlange: Pose,
  elbow_rad: number,
  out: Float64Array,
  near?: ArrayLike<number>,
): number {
  wantedWrist(geometry, baseFromFlange, WANTED);
  if (!placeElbow(geometry, elbow_rad)) return 0;
  const oneShoulder = solveShoulder(geometry, near);
  const oneWrist = solveWrist();
  const t1 = STEP[THETA1]!;
  const t2 = STEP[THETA2]!;
  const t3 = STEP[THETA3]!;
  const t4 = STEP[THETA4]!;
  const t6 = STEP[THETA6]!;
  let at = 0;
  const lastShoulder = oneShoulder ? 1 : -1;
  const lastWrist = oneWrist ? 1 : -1;
  for (let shoulder = 1; shoulder >= lastShoulder; shoulder -= 2) {
    const turned3 = shoulder === 1 ? 0 : Math.PI;
    for (let elbow = 1; elbow >= -1; elbow -= 2) {
      // θ4 < 0 turns frame 4 by π about its z axis, and θ5 takes that back.
      const turned5 = elbow === 1 ? 0 : Math.PI;
      const t5 = oneWrist ? freeAngle(geometry, near, 4) - turned5 : STEP[THETA5]!;
      const k5 = Math.cos(t5);
      const s5 = Math.sin(t5);
      const t7 = Math.atan2(k5 * STEP[V21]! - s5 * STEP[V11]!, k5 * STEP[V22]! - s5 * STEP[V12]!);
      for (let wrist = 1; wrist >= lastWrist; wrist -= 2) {
        const half = wrist === 1 ? 0 : Math.PI;
        out[at] = t1 + turned3;
        out[at + 1] = shoulder * t2;
        out[at + 2] = t3 + turned3 + turned5;
        out[at + 3] = elbow * t4;
        out[at + 4] = t5 + turned5 + half;
        out[at + 5] = wrist * t6;
        out[at + 6] = t7 + half;
        at += 7;
      }
    }
  }
  formulaToJoints(out, at, geometry.signs, geometry.offsets_rad);
  return at / 7;
}

/**
 * Upper arm u, the side d that the forearm bends to and θ4 ≥ 0 for the elbow angle, into `STEP`.
 *
 * @returns whether the wrist is within reach.
 */
function placeElbow({ c3_m: c3, c5_m: c5, deviation_m }: SphericalSevenGeometry, elbow_rad: number): boolean {
  const px = WANTED[0]!;
  const py = WANTED[1]!;
  const pz = WANTED[2]!;
  const r2 = px * px + py * py + pz * pz;
  const r = Math.sqrt(r2);
  // An arm that misses the formula may reach where the formula does not: a start is given for it to be refined.
  const edge = EDGE_M + 2 * deviation_m;
  if (r > c3 + c5 + edge || r < Math.abs(c3 - c5) - edge) return false;
  const wx = r > 0 ? px / r : 0;
  const wy = r > 0 ? py / r : 0;
  const wz = r > 0 ? pz / r : 1;
  const level = Math.sqrt(wx * wx + wy * wy);
  // t1 = (ẑ − wz w) / level, or x̂ where w is upright.
  const slanted = level > UPRIGHT_SINE;
  const t1x = slanted ? (-wz * wx) / level : 1 - wx * wx;
  const t1y = slanted ? (-wz * wy) / level : -wx * wy;
  const t1z = slanted ? level : -wx * wz;
  const t2x = wy * t1z - wz * t1y;
  const t2y = wz * t1x - wx * t1z;
  const t2z = wx * t1y - wy * t1x;
  const kp = Math.cos(elbow_rad);
  const sp = Math.sin(elbow_rad);
  const tx = kp * t1x + sp * t2x;
  const ty = kp * t1y + sp * t2y;
  const tz = kp * t1z + sp * t2z;

  const cosine = (r2 - c3 * c3 - c5 * c5) / (2 * c3 * c5);
  const cos4 = cosine > 1 ? 1 : cosine < -1 ? -1 : cosine;
  const least = deviation_m > 0 ? LEAST_BEND : 0;
  const sin4 = Math.max(least, Math.sqrt((1 - cos4) * (1 + cos4)));
  const across = c5 * sin4;
  const along = c3 + c5 * cos4;
  const length = Math.sqrt(across * across + along * along);
  const ka = length > 0 ? along / length : 1;
  const sa = length > 0 ? across / length : 0;
  STEP[UX] = ka * wx + sa * tx;
  STEP[UY] = ka * wy + sa * ty;
  STEP[UZ] = ka * wz + sa * tz;
  STEP[DX] = sa * wx - ka * tx;
  STEP[DY] = sa * wy - ka * ty;
  STEP[DZ] = sa * wz - ka * tz;
  STEP[THETA4] = Math.atan2(sin4, cos4);
  STEP[COS4] = cos4;
  STEP[SIN4] = sin4;
  return true;
}

/**
 * θ1, θ2 ≥ 0 and θ3 from u and d.
 *
 * @returns whether the upper arm lies along axis 1, so that there is one shoulder only.
 */
function solveShoulder(geometry: SphericalSevenGeometry, near: ArrayLike<number> | undefined): boolean {
  const ux = STEP[UX]!;
  const uy = STEP[UY]!;
  const uz = STEP[UZ]!;
  const dx = STEP[DX]!;
  const dy = STEP[DY]!;
  const sin2 = Math.sqrt(ux * ux + uy * uy);
  const free = sin2 < SINGULAR_SINE;
  const t1 = free ? freeAngle(geometry, near, 0) : Math.atan2(uy, ux);
  const k1 = free ? Math.cos(t1) : ux / sin2;
  const s1 = free ? Math.sin(t1) : uy / sin2;
  // d seen from frame 2 is (cos θ3, sin θ3, 0) for θ2, θ4 ≥ 0; each other sign turns it by π.
  const inX = uz * (k1 * dx + s1 * dy) - sin2 * STEP[DZ]!;
  const inY = k1 * dy - s1 * dx;
  STEP[THETA1] = t1;
  STEP[THETA2] = Math.atan2(sin2, uz);
  STEP[THETA3] = Math.atan2(inY, inX);
  return free;
}

/**
 * θ5, θ6 ≥ 0 and what θ7 follows from: R seen from frame 4.
 *
 * @returns whether axes 5 and 7 are one line, so that there is one wrist only, and θ5 is free.
 */
function solveWrist(): boolean {
  const ux = STEP[UX]!;
  const uy = STEP[UY]!;
  const uz = STEP[UZ]!;
  const dx = STEP[DX]!;
  const dy = STEP[DY]!;
  const dz = STEP[DZ]!;
  const cos4 = STEP[COS4]!;
  const sin4 = STEP[SIN4]!;
  const r11 = WANTED[3]!;
  const r21 = WANTED[4]!;
  const r31 = WANTED[5]!;
  const r12 = WANTED[6]!;
  const r22 = WANTED[7]!;
  const r32 = WANTED[8]!;
  const r13 = WANTED[9]!;
  const r23 = WANTED[10]!;
  const r33 = WANTED[11]!;
  // Frame 4 has the axes y4 = u × d and z4 = cos θ4 · u + sin θ4 · d, x4 = y4 × z4; its turn by π about z4 goes into
  // θ5.
  const y4x = uy * dz - uz * dy;
  const y4y = uz * dx - ux * dz;
  const y4z = ux * dy - uy * dx;
  const z4x = cos4 * ux + sin4 * dx;
  const z4y = cos4 * uy + sin4 * dy;
  const z4z = cos4 * uz + sin4 * dz;
  const x4x = y4y * z4z - y4z * z4y;
  const x4y = y4z * z4x - y4x * z4z;
  const x4z = y4x * z4y - y4y * z4x;
  const m13 = x4x * r13 + x4y * r23 + x4z * r33;
  const m23 = y4x * r13 + y4y * r23 + y4z * r33;
  const m33 = z4x * r13 + z4y * r23 + z4z * r33;
  const sin6 = Math.sqrt(m13 * m13 + m23 * m23);
  const free = sin6 < SINGULAR_SINE;
  STEP[THETA5] = Math.atan2(m23, m13);
  STEP[THETA6] = free ? (m33 > 0 ? 0 : Math.PI) : Math.atan2(sin6, m33);
  STEP[V11] = x4x * r11 + x4y * r21 + x4z * r31;
  STEP[V12] = x4x * r12 + x4y * r22 + x4z * r32;
  STEP[V21] = y4x * r11 + y4y * r21 + y4z * r31;
  STEP[V22] = y4x * r12 + y4y * r22 + y4z * r32;
  return free;
}

/**
 * The elbow angle ψ [rad, in (−π, π]] of a posture, as `solveSphericalSeven` counts it; of the formula where the arm
 * deviates from it. Whatever ψ it is, solving the posture's own pose with it gives the posture back. Allocates nothing.
 */
export function elbowOfSphericalSeven(geometry: SphericalSevenGeometry, q_rad: ArrayLike<number>, at = 0): number {
  const { c3_m: c3, c5_m: c5, signs, offsets_rad: offsets } = geometry;
  const t1 = signs[0] * q_rad[at]! - offsets[0];
  const t2 = signs[1] * q_rad[at + 1]! - offsets[1];
  const t3 = signs[2] * q_rad[at + 2]! - offsets[2];
  const t4 = signs[3] * q_rad[at + 3]! - offsets[3];
  const k1 = Math.cos(t1);
  const s1 = Math.sin(t1);
  const k2 = Math.cos(t2);
  const s2 = Math.sin(t2);
  const k3 = Math.cos(t3);
  const s3 = Math.sin(t3);
  const s4 = Math.sin(t4);
  const k4 = Math.cos(t4);
  const side = s4 < 0 ? -1 : 1;
  const across = c5 * s4 * side;
  const along = c3 + c5 * k4;
  const length = Math.sqrt(across * across + along * along);
  const ka = length > 0 ? along / length : 1;
  const sa = length > 0 ? across / length : 0;
  const ux = k1 * s2;
  const uy = s1 * s2;
  const uz = k2;
  const dx = side * (k1 * k2 * k3 - s1 * s3);
  const dy = side * (s1 * k2 * k3 + k1 * s3);
  const dz = -side * s2 * k3;
  const tx = sa * ux - ka * dx;
  const ty = sa * uy - ka * dy;
  const tz = sa * uz - ka * dz;
  const wx = ka * ux + sa * dx;
  const wy = ka * uy + sa * dy;
  const wz = ka * uz + sa * dz;
  const level = Math.sqrt(wx * wx + wy * wy);
  // t1 and t2 as the solver takes them.
  if (level > UPRIGHT_SINE) return Math.atan2(tx * wy - ty * wx, level * level * tz - wz * (wx * tx + wy * ty));
  return Math.atan2(wz * ty - wy * tz, tx);
}
