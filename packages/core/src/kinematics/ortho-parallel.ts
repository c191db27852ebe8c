import type { OrthoParallelGeometry } from "../model/robot.ts";
import type { Pose } from "../spatial/pose.ts";
import { formulaToJoints, freeAngle, WRIST_NUMBERS } from "./wrist.ts";

/** Slots of the answer: solution s occupies out[6 s] … out[6 s + 5]. */
export const MAX_BRANCHES = 8;

/** Below this sine of the wrist bend θ4 and θ6 turn about one line, and θ4 is free to choose. */
export const SINGULAR_SINE = 2e-10;
/** Nearer than this to axis 1 the wrist centre leaves θ1 free to choose [m]. */
const SINGULAR_RADIUS_M = 4e-10;
/** Below this sine of the wrist bend θ4 ± θ6 is known far better than either: θ6 is then taken from θ4 as found. */
const NEAR_SINGULAR_SINE = 1e-3;
/** A wrist centre this far outside the reach is a rounding of its edge [m]; what is left over stays below 1e-9. */
const EDGE_M = 4e-10;
/** Kept between the steps of one call: wrist centre [m], then x, y and z axis of the formula's flange. */
const WANTED = new Float64Array(WRIST_NUMBERS);
/** Kept between the steps of one call: the arm up to joint 3, as formula angles, sines and cosines. */
const ARM = new Float64Array(11);
const THETA1 = 0;
const THETA2 = 1;
const THETA3 = 2;
const COS1 = 3;
const SIN1 = 4;
const COS23 = 5;
const SIN23 = 6;
const M11 = 7;
const M12 = 8;
const M13 = 9;
const M23 = 10;

/**
 * Closed-form inverse of an ortho-parallel basis with spherical wrist, all branches.
 *
 *   c = p − c4 · R ẑ                                       wrist centre, seen from the base
 *   θ1 = atan2(cy, cx) − atan2(b, u),  u = √(cx² + cy² − b²)          shoulder front
 *   θ1 = atan2(cy, cx) + atan2(b, u) − π                              shoulder back
 *   x = u − a1  or  −u − a1,  z = cz − c1,  k² = a2² + c3²
 *   cos φ = (x² + z² − c2² − k²) / (2 c2 k)                φ = ±: elbow;  θ3 = φ − atan2(a2, c3)
 *   θ2 = atan2(x, z) − atan2(k sin φ, c2 + k cos φ)
 *   Rz(θ4) Ry(θ5) Rz(θ6) = R03(θ1, θ2, θ3)ᵀ R              θ5 = ±: wrist
 *
 * θ2 follows from the φ really taken, so that rounding at full stretch moves the wrist in second order only.
 * Where θ5 = 0 only θ4 ± θ6 is determined: θ4 is taken from `near`, or 0. Where the wrist centre lies on axis 1, θ1
 * likewise.
 *
 * @param geometry        seven lengths, offsets and signs. Read only.
 * @param baseFromFlange  the pose to reach. Read only; must be finite and of unit quaternion.
 * @param out             receives up to eight solutions of six angles [rad], robot's own zero and sign, in (−π, π].
 *                        Order: shoulder front, back; within it φ > 0, φ < 0; within it θ5 ≥ 0, θ5 < 0.
 *                        Solutions that coincide (stretched elbow, straight wrist) appear once.
 * @param near            six joint angles that free angles are taken from, or undefined.
 * @returns number of solutions: 0, or 1 … 8. Allocates nothing. Limits are not looked at.
 * @see Brandstötter, Angerer, Hofbaur, An Analytical Solution of the Inverse Kinematics Problem of Industrial Serial
 *      Manipulators with an Ortho-parallel Basis and a Spherical Wrist, Austrian Robotics Workshop 2014.
 */
export function solveOrthoParallel(
  geometry: OrthoParallelGeometry,
  baseFromFlange: Pose,
  out: Float64Array,
  near?: ArrayLike<number>,
): number {
  const { a1_m: a1, a2_m: a2, b_m: b, c2_m: c2, c3_m: c3, signs, offsets_rad: offsets } = geometry;
  wantedCentre(geometry, baseFromFlange);
  const cx = WANTED[0]!;
  const cy = WANTED[1]!;
  const z = WANTED[2]!;

  const radius2 = cx * cx + cy * cy;
  const radius = Math.sqrt(radius2);
  if (radius < Math.abs(b) - EDGE_M) return 0;
  const u = radius2 > b * b ? Math.sqrt(radius2 - b * b) : 0;
  const onAxis = radius < SINGULAR_RADIUS_M;
  const heading = onAxis ? freeAngle(geometry, near, 0) : Math.atan2(cy, cx);
  const aside = b === 0 ? 0 : Math.atan2(b, u);
  const k2 = a2 * a2 + c3 * c3;
  const k = Math.sqrt(k2);
  const cosBend0 = c3 / k;
  const sinBend0 = a2 / k;
  const bend0 = Math.atan2(a2, c3);

  // Formula angles go straight into `out`, and all are turned into the robot's at the end: numbers handed to a function
  // that is not inlined would be allocated.
  let at = 0;
  for (let shoulder = 0; shoulder < 2; shoulder++) {
    const ahead = shoulder === 0 ? u : -u;
    const x = ahead - a1;
    const s2 = x * x + z * z;
    const s = Math.sqrt(s2);
    if (s > c2 + k + EDGE_M || s < Math.abs(c2 - k) - EDGE_M) continue;
    const t1 = shoulder === 0 ? heading - aside : heading + aside - Math.PI;
    ARM[THETA1] = t1;
    ARM[COS1] = onAxis ? Math.cos(t1) : (cx * ahead + cy * b) / radius2;
    ARM[SIN1] = onAxis ? Math.sin(t1) : (cy * ahead - cx * b) / radius2;
    const cosine = (s2 - c2 * c2 - k2) / (2 * c2 * k);
    const cosPhi = cosine > 1 ? 1 : cosine < -1 ? -1 : cosine;
    const sinPhi = Math.sqrt((1 - cosPhi) * (1 + cosPhi));
    const phi = Math.atan2(sinPhi, cosPhi);
    const across = k * sinPhi;
    const along = c2 + k * cosPhi;
    const length = Math.sqrt(across * across + along * along);
    const toWrist = Math.atan2(x, z);
    const toElbow = Math.atan2(across, along);
    const cosWrist = s > 0 ? z / s : 1;
    const sinWrist = s > 0 ? x / s : 0;
    // Between shoulder–wrist and elbow–wrist: φ − toElbow.
    const cosFore = length > 0 ? (cosPhi * along + sinPhi * across) / length : 0;
    const sinFore = length > 0 ? (sinPhi * along - cosPhi * across) / length : 1;

    // The rows of Rz(θ1)ᵀ R that both elbows' wrists need.
    const k1 = ARM[COS1]!;
    const s1 = ARM[SIN1]!;
    ARM[M11] = k1 * WANTED[3]! + s1 * WANTED[4]!;
    ARM[M12] = k1 * WANTED[6]! + s1 * WANTED[7]!;
    ARM[M13] = k1 * WANTED[9]! + s1 * WANTED[10]!;
    ARM[M23] = k1 * WANTED[10]! - s1 * WANTED[9]!;

    const last = sinPhi === 0 ? 1 : -1;
    for (let elbow = 1; elbow >= last; elbow -= 2) {
      const kf = cosWrist * cosFore - elbow * sinWrist * sinFore;
      const sf = sinWrist * cosFore + elbow * cosWrist * sinFore;
      ARM[THETA2] = toWrist - elbow * toElbow;
      ARM[THETA3] = elbow * phi - bend0;
      ARM[COS23] = kf * cosBend0 + sf * sinBend0;
      ARM[SIN23] = sf * cosBend0 - kf * sinBend0;
      at = addWrists(geometry, near, out, at);
    }
  }
  formulaToJoints(out, at, signs, offsets);
  return at / 6;
}

/** R of the formula's flange and the wrist centre, seen from the base at the height c1 of axis 2, into `WANTED`. */
function wantedCentre({ c1_m, c4_m, formulaFromFlange }: OrthoParallelGeometry, baseFromFlange: Pose): void {
  const p = baseFromFlange.position;
  const q = baseFromFlange.quaternion;
  // Orientation of the formula's flange: q · formulaFromFlange⁻¹.
  const f = formulaFromFlange.quaternion;
  const fx = -f[0];
  const fy = -f[1];
  const fz = -f[2];
  const fw = f[3];
  const qx = q[3] * fx + q[0] * fw + q[1] * fz - q[2] * fy;
  const qy = q[3] * fy - q[0] * fz + q[1] * fw + q[2] * fx;
  const qz = q[3] * fz + q[0] * fy - q[1] * fx + q[2] * fw;
  const qw = q[3] * fw - q[0] * fx - q[1] * fy - q[2] * fz;
  const r11 = 1 - 2 * (qy * qy + qz * qz);
  const r12 = 2 * (qx * qy - qz * qw);
  const r13 = 2 * (qx * qz + qy * qw);
  const r21 = 2 * (qx * qy + qz * qw);
  const r22 = 1 - 2 * (qx * qx + qz * qz);
  const r23 = 2 * (qy * qz - qx * qw);
  const r31 = 2 * (qx * qz - qy * qw);
  const r32 = 2 * (qy * qz + qx * qw);
  const r33 = 1 - 2 * (qx * qx + qy * qy);
  const t = formulaFromFlange.position;
  const tz = t[2] + c4_m;
  WANTED[0] = p[0] - r11 * t[0] - r12 * t[1] - r13 * tz;
  WANTED[1] = p[1] - r21 * t[0] - r22 * t[1] - r23 * tz;
  WANTED[2] = p[2] - r31 * t[0] - r32 * t[1] - r33 * tz - c1_m;
  WANTED[3] = r11;
  WANTED[4] = r21;
  WANTED[5] = r31;
  WANTED[6] = r12;
  WANTED[7] = r22;
  WANTED[8] = r32;
  WANTED[9] = r13;
  WANTED[10] = r23;
  WANTED[11] = r33;
}

/**
 * Both wrists, or the one of a straight wrist, of the arm in `ARM`: formula angles from `out[at]` on.
 *
 * @returns where the next solution goes.
 */
function addWrists(
  geometry: OrthoParallelGeometry,
  near: ArrayLike<number> | undefined,
  out: Float64Array,
  at: number,
): number {
  const k23 = ARM[COS23]!;
  const s23 = ARM[SIN23]!;
  const m11 = ARM[M11]!;
  const m12 = ARM[M12]!;
  const m13 = ARM[M13]!;
  const r31 = WANTED[5]!;
  const r32 = WANTED[8]!;
  const r33 = WANTED[11]!;
  // W = R03ᵀ R = Ry(−θ2−θ3) Rz(−θ1) R
  const w23 = ARM[M23]!;
  const w13 = k23 * m13 - s23 * r33;
  const w33 = s23 * m13 + k23 * r33;
  const sin5 = Math.sqrt(w13 * w13 + w23 * w23);
  const free = sin5 < SINGULAR_SINE;
  let t4: number;
  let t6: number;
  if (sin5 > NEAR_SINGULAR_SINE) {
    t4 = Math.atan2(w23, w13);
    t6 = Math.atan2(s23 * m12 + k23 * r32, -(s23 * m11 + k23 * r31));
  } else {
    t4 = free ? freeAngle(geometry, near, 3) : Math.atan2(w23, w13);
    const s4 = Math.sin(t4);
    const k4 = Math.cos(t4);
    const v11 = k23 * m11 - s23 * r31;
    const v12 = k23 * m12 - s23 * r32;
    const v21 = ARM[COS1]! * WANTED[4]! - ARM[SIN1]! * WANTED[3]!;
    const v22 = ARM[COS1]! * WANTED[7]! - ARM[SIN1]! * WANTED[6]!;
    t6 = Math.atan2(k4 * v21 - s4 * v11, k4 * v22 - s4 * v12);
  }
  const t5 = free ? (w33 > 0 ? 0 : Math.PI) : Math.atan2(sin5, w33);
  out[at] = ARM[THETA1]!;
  out[at + 1] = ARM[THETA2]!;
  out[at + 2] = ARM[THETA3]!;
  out[at + 3] = t4;
  out[at + 4] = t5;
  out[at + 5] = t6;
  if (free) return at + 6;
  out[at + 6] = ARM[THETA1]!;
  out[at + 7] = ARM[THETA2]!;
  out[at + 8] = ARM[THETA3]!;
  out[at + 9] = t4 + Math.PI;
  out[at + 10] = -t5;
  out[at + 11] = t6 + Math.PI;
  return at + 12;
}
