import type { OrthoParallelGeometry } from "../robots/robot.ts";
import type { Pose } from "../spatial/pose.ts";

/** Slots of the answer: solution s occupies out[6 s] … out[6 s + 5]. */
export const MAX_BRANCHES = 8;

/** Below this sine of the wrist bend (and this radius of the wrist centre about axis 1) an angle is free to choose. */
export const SINGULAR_SINE = 5e-10;
const SINGULAR_RADIUS_M = 1e-10;

/** How far the elbow's cosine may exceed 1 by rounding at full stretch: 1e-9 m at arm lengths of a metre. */
const STRETCH_SLACK = 2e-9;

const TURN = 2 * Math.PI;

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
 * Where θ5 = 0 only θ4 ± θ6 is determined: θ4 is taken from `near`, or 0. Where the wrist centre lies on axis 1, θ1 likewise.
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
export function solveOrthoParallel(geometry: OrthoParallelGeometry, baseFromFlange: Pose, out: Float64Array, near?: ArrayLike<number>): number {
  const { a1_m: a1, a2_m: a2, b_m: b, c1_m: c1, c2_m: c2, c3_m: c3, c4_m: c4, signs, offsets_rad: offsets, formulaFromFlange } = geometry;
  const p = baseFromFlange.position, q = baseFromFlange.quaternion;

  // Orientation of the formula's flange: q · formulaFromFlange⁻¹.
  const f = formulaFromFlange.quaternion, fx = -f[0], fy = -f[1], fz = -f[2], fw = f[3];
  const qx = q[3] * fx + q[0] * fw + q[1] * fz - q[2] * fy, qy = q[3] * fy - q[0] * fz + q[1] * fw + q[2] * fx;
  const qz = q[3] * fz + q[0] * fy - q[1] * fx + q[2] * fw, qw = q[3] * fw - q[0] * fx - q[1] * fy - q[2] * fz;
  const r11 = 1 - 2 * (qy * qy + qz * qz), r12 = 2 * (qx * qy - qz * qw), r13 = 2 * (qx * qz + qy * qw);
  const r21 = 2 * (qx * qy + qz * qw), r22 = 1 - 2 * (qx * qx + qz * qz), r23 = 2 * (qy * qz - qx * qw);
  const r31 = 2 * (qx * qz - qy * qw), r32 = 2 * (qy * qz + qx * qw), r33 = 1 - 2 * (qx * qx + qy * qy);

  const t = formulaFromFlange.position, tz = t[2] + c4;
  const cx = p[0] - r11 * t[0] - r12 * t[1] - r13 * tz;
  const cy = p[1] - r21 * t[0] - r22 * t[1] - r23 * tz;
  const z = p[2] - r31 * t[0] - r32 * t[1] - r33 * tz - c1;

  const radius2 = cx * cx + cy * cy, u2 = radius2 - b * b;
  if (u2 < -1e-12) return 0;
  const u = u2 > 0 ? Math.sqrt(u2) : 0;
  const onAxis = radius2 < SINGULAR_RADIUS_M * SINGULAR_RADIUS_M;
  const heading = onAxis ? (near === undefined ? 0 : signs[0] * near[0]! - offsets[0]) : Math.atan2(cy, cx), aside = b === 0 ? 0 : Math.atan2(b, u);
  const k2 = a2 * a2 + c3 * c3, k = Math.sqrt(k2), bend0 = Math.atan2(a2, c3);
  const near4 = near === undefined ? 0 : signs[3] * near[3]! - offsets[3];

  let count = 0;
  for (let shoulder = 0; shoulder < 2; shoulder++) {
    const t1 = shoulder === 0 ? heading - aside : heading + aside - Math.PI;
    const x = (shoulder === 0 ? u : -u) - a1;
    const cosine = (x * x + z * z - c2 * c2 - k2) / (2 * c2 * k);
    if (cosine > 1 + STRETCH_SLACK || cosine < -1 - STRETCH_SLACK) continue;
    const cosPhi = cosine > 1 ? 1 : cosine < -1 ? -1 : cosine;
    const phi0 = Math.acos(cosPhi), sinPhi0 = Math.sin(phi0);
    const toWrist = Math.atan2(x, z), toElbow = Math.atan2(k * sinPhi0, c2 + k * cosPhi);
    const s1 = Math.sin(t1), k1 = Math.cos(t1);
    // Rows of Rz(θ1)ᵀ R that the wrist needs: the first and the third of R03ᵀ mix them.
    const m11 = k1 * r11 + s1 * r21, m12 = k1 * r12 + s1 * r22, m13 = k1 * r13 + s1 * r23;
    const n21 = -s1 * r11 + k1 * r21, n22 = -s1 * r12 + k1 * r22, n23 = -s1 * r13 + k1 * r23;

    const elbows = sinPhi0 === 0 ? 1 : 2;
    for (let elbow = 0; elbow < elbows; elbow++) {
      const phi = elbow === 0 ? phi0 : -phi0;
      const t2 = elbow === 0 ? toWrist - toElbow : toWrist + toElbow, t3 = phi - bend0;
      const s23 = Math.sin(t2 + t3), k23 = Math.cos(t2 + t3);
      // W = R03ᵀ R = Ry(−θ2−θ3) Rz(−θ1) R
      const w13 = k23 * m13 - s23 * r33, w23 = n23, w33 = s23 * m13 + k23 * r33;
      const sin5 = Math.sqrt(w13 * w13 + w23 * w23);
      if (sin5 < SINGULAR_SINE) {
        const s4 = Math.sin(near4), k4 = Math.cos(near4);
        const v11 = k23 * m11 - s23 * r31, v12 = k23 * m12 - s23 * r32;
        const t5 = Math.atan2(k4 * w13 + s4 * w23, w33), t6 = Math.atan2(-s4 * v11 + k4 * n21, -s4 * v12 + k4 * n22);
        count = write(out, count, signs, offsets, t1, t2, t3, near4, t5, t6);
        continue;
      }
      const t5 = Math.atan2(sin5, w33), t4 = Math.atan2(w23, w13);
      const t6 = Math.atan2(s23 * m12 + k23 * r32, -(s23 * m11 + k23 * r31));
      count = write(out, count, signs, offsets, t1, t2, t3, t4, t5, t6);
      count = write(out, count, signs, offsets, t1, t2, t3, t4 + Math.PI, -t5, t6 + Math.PI);
    }
  }
  return count;
}

type Six = OrthoParallelGeometry["signs"];

function write(out: Float64Array, count: number, signs: Six, offsets: Six, t1: number, t2: number, t3: number, t4: number, t5: number, t6: number): number {
  const at = 6 * count;
  out[at] = wrap((t1 + offsets[0]) * signs[0]);
  out[at + 1] = wrap((t2 + offsets[1]) * signs[1]);
  out[at + 2] = wrap((t3 + offsets[2]) * signs[2]);
  out[at + 3] = wrap((t4 + offsets[3]) * signs[3]);
  out[at + 4] = wrap((t5 + offsets[4]) * signs[4]);
  out[at + 5] = wrap((t6 + offsets[5]) * signs[5]);
  return count + 1;
}

/** Angles here are at most a few turns away: (−π, π] by adding or taking one at a time. */
function wrap(angle: number): number {
  let a = angle;
  while (a > Math.PI) a -= TURN;
  while (a <= -Math.PI) a += TURN;
  return a;
}
