import type { ThreeParallelGeometry } from "../model/robot.ts";
import type { Pose } from "../spatial/pose.ts";
import { formulaToJoints, freeAngle, wantedWrist, WRIST_NUMBERS } from "./wrist.ts";

/**
 * Below this sine of θ5 axes 4 and 6 are parallel, and θ6 is free to choose; room for right angles rounded to ten
 * digits, and still verified to 1e-9.
 */
const SINGULAR_SINE = 6e-10;
/** Nearer than this to axis 1 the wrist leaves θ1 free to choose [m]; only where b = 0. */
const SINGULAR_RADIUS_M = 4e-10;
/**
 * Below this sine of θ5 the sum of θ2, θ3, θ4 and θ6 is known far better than either: θ6 is then taken from the sum as
 * found.
 */
const NEAR_SINGULAR_SINE = 1e-3;
/** Outside the reach by no more than this is a rounding of its edge [m]. */
const EDGE_M = 4e-10;
/** Kept between the steps of one call: the wanted wrist. */
const WANTED = new Float64Array(WRIST_NUMBERS);
/** Kept between the steps of one call: θ1 and the wrist, as formula angles, sines and cosines. */
const STEP = new Float64Array(9);
const THETA1 = 0;
const COS1 = 1;
const SIN1 = 2;
/** How far the wrist is in front of axis 2 [m]. */
const AHEAD = 3;
const THETA5 = 4;
const THETA6 = 5;
const PHI = 6;
const SIN_PHI = 7;
const COS_PHI = 8;

/**
 * Closed-form inverse of an arm whose axes 2, 3 and 4 are parallel, all branches.
 *
 *   p = Rz(θ1) (ahead, b, z),   ahead = ±√(px² + py² − b²)                    shoulder front, back
 *   Rz(−θ1) R = M = Ry(φ) Rz(θ5) Ry(θ6),   φ = θ2 + θ3 + θ4
 *   cos θ5 = M22;   θ6 = atan2(M23, M21);   φ = atan2(M32, −M12), each turned by π where θ5 < 0      wrist
 *   (x, z) = (ahead − a1, pz) − c5 (sin φ, cos φ)                              axis 4 in the plane of the arm
 *   cos θ3 = (x² + z² − c2² − c3²) / (2 c2 c3)                                 elbow
 *   θ2 = atan2(x, z) − atan2(c3 sin θ3, c2 + c3 cos θ3),   θ4 = φ − θ2 − θ3
 *
 * Where θ5 is 0 or π only φ ± θ6 is determined: θ6 is taken from `near`, or 0, or where the arm cannot reach so, such
 * that it just can. Where b = 0 and the wrist lies on axis 1, θ1 is taken from `near`, or 0.
 *
 * @param baseFromFlange  the pose to reach. Read only; must be finite and of unit quaternion.
 * @param out             receives up to eight solutions of six angles [rad], the robot's own zero and sign, in (−π, π].
 *                        Order: shoulder front, back; within it θ5 ≥ 0, θ5 < 0; within it θ3 ≥ 0, θ3 < 0.
 * @param near            six joint angles that free angles are taken from, or undefined.
 * @returns number of solutions: 0 … 8. Allocates nothing. Limits are not looked at.
 * @see Hawkins, Analytic Inverse Kinematics for the Universal Robots UR-5/UR-10 Arms, Georgia Tech 2013, for the order
 * of steps.
 */
export function solveThreeParallel(
  geometry: ThreeParallelGeometry,
  baseFromFlange: Pose,
  out: Float64Array,
  near?: ArrayLike<number>,
): number {
  const { b_m: b, signs, offsets_rad: offsets } = geometry;
  wantedWrist(geometry, baseFromFlange, WANTED);
  const px = WANTED[0]!;
  const py = WANTED[1]!;
  const radius2 = px * px + py * py;
  const radius = Math.sqrt(radius2);
  if (radius < Math.abs(b) - EDGE_M) return 0;
  const u = radius2 > b * b ? Math.sqrt(radius2 - b * b) : 0;
  const onAxis = radius < SINGULAR_RADIUS_M;
  const heading = onAxis ? freeAngle(geometry, near, 0) : Math.atan2(py, px);
  const aside = b === 0 ? 0 : Math.atan2(b, u);

  // Formula angles go straight into `out`, and all are turned into the robot's at the end.
  let at = 0;
  const lastShoulder = u > 0 ? 2 : 1;
  for (let shoulder = 0; shoulder < lastShoulder; shoulder++) {
    const ahead = shoulder === 0 ? u : -u;
    const t1 = shoulder === 0 ? heading - aside : heading + aside - Math.PI;
    STEP[THETA1] = t1;
    STEP[COS1] = onAxis ? Math.cos(t1) : (px * ahead + py * b) / radius2;
    STEP[SIN1] = onAxis ? Math.sin(t1) : (py * ahead - px * b) / radius2;
    STEP[AHEAD] = ahead - geometry.a1_m;
    const lastWrist = solveWrist(geometry, near) ? 1 : -1;
    at = addElbows(geometry, lastWrist, out, at);
  }
  formulaToJoints(out, at, signs, offsets);
  return at / 6;
}

/**
 * θ5, θ6 and φ of the wrist with θ5 ≥ 0, from θ1 in `STEP`; the other wrist has all three turned by π.
 *
 * @returns whether axes 4 and 6 are parallel, so that there is one wrist only.
 */
function solveWrist(geometry: ThreeParallelGeometry, near: ArrayLike<number> | undefined): boolean {
  const k1 = STEP[COS1]!;
  const s1 = STEP[SIN1]!;
  const m12 = k1 * WANTED[6]! + s1 * WANTED[7]!;
  const m21 = k1 * WANTED[4]! - s1 * WANTED[3]!;
  const m22 = k1 * WANTED[7]! - s1 * WANTED[6]!;
  const m23 = k1 * WANTED[10]! - s1 * WANTED[9]!;
  const sin5 = Math.sqrt(m21 * m21 + m23 * m23);
  if (sin5 < SINGULAR_SINE) {
    solveParallelWrist(geometry, freeAngle(geometry, near, 5), m22 > 0 ? 1 : -1);
    return true;
  }
  const m32 = WANTED[8]!;
  const inverse = 1 / Math.sqrt(m12 * m12 + m32 * m32);
  const sinPhi = m32 * inverse;
  const cosPhi = -m12 * inverse;
  STEP[THETA5] = Math.atan2(sin5, m22);
  STEP[PHI] = Math.atan2(m32, -m12);
  STEP[SIN_PHI] = sinPhi;
  STEP[COS_PHI] = cosPhi;
  if (sin5 > NEAR_SINGULAR_SINE) {
    STEP[THETA6] = Math.atan2(m23, m21);
    return false;
  }
  const m11 = k1 * WANTED[3]! + s1 * WANTED[4]!;
  const m13 = k1 * WANTED[9]! + s1 * WANTED[10]!;
  STEP[THETA6] = Math.atan2(-(sinPhi * m11 + cosPhi * WANTED[5]!), sinPhi * m13 + cosPhi * WANTED[11]!);
  return false;
}

/**
 * The wrist whose axes 4 and 6 are parallel: θ6 as given, or where axis 4 would then be out of the arm's reach, the θ6
 * that just brings it there.
 *
 * @param turned  1 for θ5 = 0, −1 for θ5 = π.
 */
function solveParallelWrist({ c2_m, c3_m, c5_m: c5 }: ThreeParallelGeometry, theta6: number, turned: number): void {
  const k1 = STEP[COS1]!;
  const s1 = STEP[SIN1]!;
  const xw = STEP[AHEAD]!;
  const pz = WANTED[2]!;
  const m11 = k1 * WANTED[3]! + s1 * WANTED[4]!;
  const m13 = k1 * WANTED[9]! + s1 * WANTED[10]!;
  // M = Ry(φ ± θ6), times Rz(π) where θ5 = π.
  const both = Math.atan2(m13, turned * m11);
  let t6 = theta6;
  let phi = both - turned * t6;
  const away = Math.sqrt(xw * xw + pz * pz);
  const from = Math.atan2(xw, pz);
  const fourX = xw - c5 * Math.sin(phi);
  const fourZ = pz - c5 * Math.cos(phi);
  const four = Math.sqrt(fourX * fourX + fourZ * fourZ);
  const longest = c2_m + c3_m;
  const shortest = Math.abs(c2_m - c3_m);
  if (four > longest || four < shortest) {
    const wanted = four > longest ? longest : shortest;
    const cosine = away * c5 > 0 ? (away * away + c5 * c5 - wanted * wanted) / (2 * away * c5) : 2;
    if (cosine >= -1 && cosine <= 1) {
      const side = Math.sin(phi - from) < 0 ? -1 : 1;
      phi = from + side * Math.acos(cosine);
      t6 = turned * (both - phi);
    }
  }
  STEP[THETA5] = turned > 0 ? 0 : Math.PI;
  STEP[THETA6] = t6;
  STEP[PHI] = phi;
  STEP[SIN_PHI] = Math.sin(phi);
  STEP[COS_PHI] = Math.cos(phi);
}

/**
 * Both elbows, or the one of a stretched arm, of each wrist: formula angles from `out[at]` on.
 *
 * @param lastWrist  1 for the wrist in `STEP` alone, −1 for the one turned by π as well.
 * @returns where the next solution goes.
 */
function addElbows(
  { c2_m: c2, c3_m: c3, c5_m: c5 }: ThreeParallelGeometry,
  lastWrist: number,
  out: Float64Array,
  at: number,
): number {
  const longest = c2 + c3;
  const shortest = Math.abs(c2 - c3);
  const t1 = STEP[THETA1]!;
  let to = at;
  for (let wrist = 1; wrist >= lastWrist; wrist -= 2) {
    const x = STEP[AHEAD]! - c5 * wrist * STEP[SIN_PHI]!;
    const z = WANTED[2]! - c5 * wrist * STEP[COS_PHI]!;
    const s2 = x * x + z * z;
    const s = Math.sqrt(s2);
    if (s > longest + EDGE_M || s < shortest - EDGE_M) continue;
    const cosine = (s2 - c2 * c2 - c3 * c3) / (2 * c2 * c3);
    const cos3 = cosine > 1 ? 1 : cosine < -1 ? -1 : cosine;
    const sin3 = Math.sqrt((1 - cos3) * (1 + cos3));
    const t3 = Math.atan2(sin3, cos3);
    const toFour = Math.atan2(x, z);
    const toElbow = Math.atan2(c3 * sin3, c2 + c3 * cos3);
    const phi = wrist === 1 ? STEP[PHI]! : STEP[PHI]! + Math.PI;
    const t5 = wrist === 1 ? STEP[THETA5]! : -STEP[THETA5]!;
    const t6 = wrist === 1 ? STEP[THETA6]! : STEP[THETA6]! + Math.PI;
    const last = sin3 === 0 ? 1 : -1;
    for (let elbow = 1; elbow >= last; elbow -= 2) {
      const t2 = toFour - elbow * toElbow;
      out[to] = t1;
      out[to + 1] = t2;
      out[to + 2] = elbow * t3;
      out[to + 3] = phi - t2 - elbow * t3;
      out[to + 4] = t5;
      out[to + 5] = t6;
      to += 6;
    }
  }
  return to;
}
