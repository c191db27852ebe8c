import type { ThreeParallelGeometry } from "../model/robot.ts";
import type { Pose } from "../spatial/pose.ts";
import { formulaToJoints, wantedWrist, WRIST_NUMBERS } from "./wrist.ts";

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
/** Kept between the steps of one call. */
const WANTED = new Float64Array(WRIST_NUMBERS);

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
  const { a1_m: a1, b_m: b, c2_m: c2, c3_m: c3, c5_m: c5, signs, offsets_rad: offsets } = geometry;

  wantedWrist(geometry, baseFromFlange, WANTED);
  const px = WANTED[0]!;
  const py = WANTED[1]!;
  const pz = WANTED[2]!;
  const r11 = WANTED[3]!;
  const r21 = WANTED[4]!;
  const r31 = WANTED[5]!;
  const r12 = WANTED[6]!;
  const r22 = WANTED[7]!;
  const r32 = WANTED[8]!;
  const r13 = WANTED[9]!;
  const r23 = WANTED[10]!;
  const r33 = WANTED[11]!;

  const radius2 = px * px + py * py;
  const radius = Math.sqrt(radius2);
  if (radius < Math.abs(b) - EDGE_M) return 0;
  const u = radius2 > b * b ? Math.sqrt(radius2 - b * b) : 0;
  const onAxis = radius < SINGULAR_RADIUS_M;
  const heading = onAxis ? signs[0] * (near === undefined ? 0 : near[0]!) - offsets[0] : Math.atan2(py, px);
  const aside = b === 0 ? 0 : Math.atan2(b, u);
  const near6 = signs[5] * (near === undefined ? 0 : near[5]!) - offsets[5];
  const longest = c2 + c3;
  const shortest = Math.abs(c2 - c3);

  // Formula angles go straight into `out`, and all are turned into the robot's at the end.
  let at = 0;
  const lastShoulder = u > 0 ? 2 : 1;
  for (let shoulder = 0; shoulder < lastShoulder; shoulder++) {
    const ahead = shoulder === 0 ? u : -u;
    const t1 = shoulder === 0 ? heading - aside : heading + aside - Math.PI;
    const k1 = onAxis ? Math.cos(t1) : (px * ahead + py * b) / radius2;
    const s1 = onAxis ? Math.sin(t1) : (py * ahead - px * b) / radius2;
    const m12 = k1 * r12 + s1 * r22;
    const m21 = k1 * r21 - s1 * r11;
    const m22 = k1 * r22 - s1 * r12;
    const m23 = k1 * r23 - s1 * r13;
    const sin5 = Math.sqrt(m21 * m21 + m23 * m23);
    const free = sin5 < SINGULAR_SINE;
    const xw = ahead - a1;
    const t5 = free ? (m22 > 0 ? 0 : Math.PI) : Math.atan2(sin5, m22);
    // sin φ, cos φ and φ for θ5 ≥ 0; the other wrist has both turned by π.
    let t6: number;
    let phi: number;
    let sinPhi: number;
    let cosPhi: number;
    if (free) {
      const m11 = k1 * r11 + s1 * r21;
      const m13 = k1 * r13 + s1 * r23;
      const turned = m22 > 0 ? 1 : -1;
      // M = Ry(φ ± θ6), times Rz(π) where θ5 = π.
      const both = Math.atan2(m13, turned * m11);
      t6 = near6;
      phi = m22 > 0 ? both - t6 : both + t6;
      const away = Math.sqrt(xw * xw + pz * pz);
      const from = Math.atan2(xw, pz);
      const fourX = xw - c5 * Math.sin(phi);
      const fourZ = pz - c5 * Math.cos(phi);
      const four = Math.sqrt(fourX * fourX + fourZ * fourZ);
      if (four > longest || four < shortest) {
        const wanted = four > longest ? longest : shortest;
        const cosine = away * c5 > 0 ? (away * away + c5 * c5 - wanted * wanted) / (2 * away * c5) : 2;
        if (cosine >= -1 && cosine <= 1) {
          const lean = Math.acos(cosine);
          const side = Math.sin(phi - from) < 0 ? -1 : 1;
          phi = from + side * lean;
          t6 = m22 > 0 ? both - phi : phi - both;
        }
      }
      sinPhi = Math.sin(phi);
      cosPhi = Math.cos(phi);
    } else {
      const m32 = r32;
      const inverse = 1 / Math.sqrt(m12 * m12 + m32 * m32);
      sinPhi = m32 * inverse;
      cosPhi = -m12 * inverse;
      phi = Math.atan2(m32, -m12);
      if (sin5 > NEAR_SINGULAR_SINE) t6 = Math.atan2(m23, m21);
      else {
        const m11 = k1 * r11 + s1 * r21;
        const m13 = k1 * r13 + s1 * r23;
        t6 = Math.atan2(-(sinPhi * m11 + cosPhi * r31), sinPhi * m13 + cosPhi * r33);
      }
    }
    const lastWrist = free ? 1 : -1;
    for (let wrist = 1; wrist >= lastWrist; wrist -= 2) {
      const fx4 = xw - c5 * wrist * sinPhi;
      const fz4 = pz - c5 * wrist * cosPhi;
      const s2 = fx4 * fx4 + fz4 * fz4;
      const s = Math.sqrt(s2);
      if (s > longest + EDGE_M || s < shortest - EDGE_M) continue;
      const cosine = (s2 - c2 * c2 - c3 * c3) / (2 * c2 * c3);
      const cos3 = cosine > 1 ? 1 : cosine < -1 ? -1 : cosine;
      const sin3 = Math.sqrt((1 - cos3) * (1 + cos3));
      const t3 = Math.atan2(sin3, cos3);
      const toFour = Math.atan2(fx4, fz4);
      const toElbow = Math.atan2(c3 * sin3, c2 + c3 * cos3);
      const whole = wrist === 1 ? phi : phi + Math.PI;
      const five = wrist === 1 ? t5 : -t5;
      const six = wrist === 1 ? t6 : t6 + Math.PI;
      const last = sin3 === 0 ? 1 : -1;
      for (let elbow = 1; elbow >= last; elbow -= 2) {
        const t2 = toFour - elbow * toElbow;
        out[at] = t1;
        out[at + 1] = t2;
        out[at + 2] = elbow * t3;
        out[at + 3] = whole - t2 - elbow * t3;
        out[at + 4] = five;
        out[at + 5] = six;
        at += 6;
      }
    }
  }
  formulaToJoints(out, at, signs, offsets);
  return at / 6;
}
