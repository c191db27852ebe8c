import type { OrthoParallelGeometry } from "../model/robot.ts";
import type { Pose } from "../spatial/pose.ts";
import { formulaToJoints } from "./wrist.ts";

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
  const {
    a1_m: a1,
    a2_m: a2,
    b_m: b,
    c1_m: c1,
    c2_m: c2,
    c3_m: c3,
    c4_m: c4,
    signs,
    offsets_rad: offsets,
    formulaFromFlange,
  } = geometry;
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
  const tz = t[2] + c4;
  const cx = p[0] - r11 * t[0] - r12 * t[1] - r13 * tz;
  const cy = p[1] - r21 * t[0] - r22 * t[1] - r23 * tz;
  const z = p[2] - r31 * t[0] - r32 * t[1] - r33 * tz - c1;

  const radius2 = cx * cx + cy * cy;
  const radius = Math.sqrt(radius2);
  if (radius < Math.abs(b) - EDGE_M) return 0;
  const u = radius2 > b * b ? Math.sqrt(radius2 - b * b) : 0;
  const onAxis = radius < SINGULAR_RADIUS_M;
  const heading = onAxis ? signs[0] * (near === undefined ? 0 : near[0]!) - offsets[0] : Math.atan2(cy, cx);
  const aside = b === 0 ? 0 : Math.atan2(b, u);
  const near4 = signs[3] * (near === undefined ? 0 : near[3]!) - offsets[3];
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
    const k1 = onAxis ? Math.cos(t1) : (cx * ahead + cy * b) / radius2;
    const s1 = onAxis ? Math.sin(t1) : (cy * ahead - cx * b) / radius2;
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
    // Rows of Rz(θ1)ᵀ R that the wrist needs: the first and the third of R03ᵀ mix them.
    const m11 = k1 * r11 + s1 * r21;
    const m12 = k1 * r12 + s1 * r22;
    const m13 = k1 * r13 + s1 * r23;
    const w23 = k1 * r23 - s1 * r13;

    const last = sinPhi === 0 ? 1 : -1;
    for (let elbow = 1; elbow >= last; elbow -= 2) {
      const t2 = toWrist - elbow * toElbow;
      const t3 = elbow * phi - bend0;
      const kf = cosWrist * cosFore - elbow * sinWrist * sinFore;
      const sf = sinWrist * cosFore + elbow * cosWrist * sinFore;
      const k23 = kf * cosBend0 + sf * sinBend0;
      const s23 = sf * cosBend0 - kf * sinBend0;
      // W = R03ᵀ R = Ry(−θ2−θ3) Rz(−θ1) R
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
        t4 = free ? near4 : Math.atan2(w23, w13);
        const s4 = Math.sin(t4);
        const k4 = Math.cos(t4);
        const v11 = k23 * m11 - s23 * r31;
        const v12 = k23 * m12 - s23 * r32;
        const v21 = k1 * r21 - s1 * r11;
        const v22 = k1 * r22 - s1 * r12;
        t6 = Math.atan2(k4 * v21 - s4 * v11, k4 * v22 - s4 * v12);
      }
      const t5 = free ? (w33 > 0 ? 0 : Math.PI) : Math.atan2(sin5, w33);
      out[at] = t1;
      out[at + 1] = t2;
      out[at + 2] = t3;
      out[at + 3] = t4;
      out[at + 4] = t5;
      out[at + 5] = t6;
      at += 6;
      if (free) continue;
      out[at] = t1;
      out[at + 1] = t2;
      out[at + 2] = t3;
      out[at + 3] = t4 + Math.PI;
      out[at + 4] = -t5;
      out[at + 5] = t6 + Math.PI;
      at += 6;
    }
  }
  formulaToJoints(out, at, signs, offsets);
  return at / 6;
}
