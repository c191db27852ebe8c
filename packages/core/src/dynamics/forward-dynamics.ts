import { BODY, type DynamicsModel } from "./model.ts";
import {
  addCrossForce,
  addCrossMotion,
  dot6,
  dynamicsScratch,
  momentum,
  placeBodies,
  type DynamicsScratch,
} from "./placed.ts";

/**
 * How the joints accelerate under given torques: the articulated-body algorithm, linear in the number of joints.
 *
 *   U_i = I^A_i S_i,   D_i = S_i · U_i + J_i gear_i²,   u_i = τ_i − S_i · p^A_i
 *   I^a_i = I^A_i − U_i U_iᵀ / D_i,   p^a_i = p^A_i + I^a_i c_i + U_i u_i / D_i
 *   q̈_i = ( u_i − U_i · (a_{i−1} + c_i) ) / D_i,   a_0 = −g
 *
 * @param q, qd    n angles [rad] and speeds [rad/s].
 * @param torques  n torques at the joints [N m].
 * @param out      receives n accelerations [rad/s²]; returned.
 * @param scratch  made for this model; with it and `out` the call allocates nothing.
 * @see Featherstone, Rigid Body Dynamics Algorithms, Springer 2008, ch. 7.
 */
export function forwardDynamics(
  model: DynamicsModel,
  q: ArrayLike<number>,
  qd: ArrayLike<number>,
  torques: ArrayLike<number>,
  out: Float64Array = new Float64Array(model.rotors_kgm2.length),
  scratch: DynamicsScratch = dynamicsScratch(model),
): Float64Array {
  placeBodies(model, q, scratch);
  const n = model.rotors_kgm2.length;
  const { axes, placed, speeds, forces, steps, articulated, loads, divisors, rest, one, two } = scratch;
  steps.fill(0);
  for (let i = 0; i < n; i++) {
    const at = 6 * i;
    for (let k = 0; k < 6; k++) {
      speeds[at + k] = (i > 0 ? speeds[at - 6 + k]! : 0) + axes[at + k]! * qd[i]!;
      forces[at + k] = 0;
    }
    addCrossMotion(speeds, axes, at, qd[i]!, steps, at);
    momentum(placed, i, speeds, at, one, 0);
    addCrossForce(speeds, at, one, forces, at);
    spread(placed, i, articulated);
  }
  for (let i = n - 1; i >= 0; i--) {
    const at = 6 * i;
    const inertia = 36 * i;
    for (let r = 0; r < 6; r++) loads[at + r] = dot6(articulated, inertia + 6 * r, axes, at);
    const divisor = dot6(axes, at, loads, at) + model.rotors_kgm2[i]!;
    const u = torques[i]! - dot6(axes, at, forces, at);
    divisors[i] = divisor;
    rest[i] = u;
    if (i === 0) break;
    for (let r = 0; r < 6; r++)
      for (let c = 0; c < 6; c++) articulated[inertia + 6 * r + c]! -= (loads[at + r]! * loads[at + c]!) / divisor;
    for (let r = 0; r < 6; r++) {
      forces[at - 6 + r]! +=
        forces[at + r]! + dot6(articulated, inertia + 6 * r, steps, at) + (loads[at + r]! * u) / divisor;
    }
    for (let k = 0; k < 36; k++) articulated[inertia - 36 + k]! += articulated[inertia + k]!;
  }
  const g = model.gravity_mps2;
  one.fill(0);
  for (let k = 0; k < 3; k++) one[3 + k] = -g[k]!;
  for (let i = 0; i < n; i++) {
    const at = 6 * i;
    for (let k = 0; k < 6; k++) two[k] = one[k]! + steps[at + k]!;
    out[i] = (rest[i]! - dot6(loads, at, two, 0)) / divisors[i]!;
    for (let k = 0; k < 6; k++) one[k] = two[k]! + axes[at + k]! * out[i]!;
  }
  return out;
}

/** A body as a 6 × 6 matrix: ( I_o  h× ; −h×  m 1 ). */
function spread(placed: Float64Array, body: number, out: Float64Array): void {
  const b = BODY * body;
  const o = 36 * body;
  const m = placed[b]!;
  const hx = placed[b + 1]!;
  const hy = placed[b + 2]!;
  const hz = placed[b + 3]!;
  const xx = placed[b + 4]!;
  const yy = placed[b + 5]!;
  const zz = placed[b + 6]!;
  const xy = placed[b + 7]!;
  const xz = placed[b + 8]!;
  const yz = placed[b + 9]!;
  out[o] = xx;
  out[o + 1] = xy;
  out[o + 2] = xz;
  out[o + 3] = 0;
  out[o + 4] = -hz;
  out[o + 5] = hy;
  out[o + 6] = xy;
  out[o + 7] = yy;
  out[o + 8] = yz;
  out[o + 9] = hz;
  out[o + 10] = 0;
  out[o + 11] = -hx;
  out[o + 12] = xz;
  out[o + 13] = yz;
  out[o + 14] = zz;
  out[o + 15] = -hy;
  out[o + 16] = hx;
  out[o + 17] = 0;
  out[o + 18] = 0;
  out[o + 19] = hz;
  out[o + 20] = -hy;
  out[o + 21] = m;
  out[o + 22] = 0;
  out[o + 23] = 0;
  out[o + 24] = -hz;
  out[o + 25] = 0;
  out[o + 26] = hx;
  out[o + 27] = 0;
  out[o + 28] = m;
  out[o + 29] = 0;
  out[o + 30] = hy;
  out[o + 31] = -hx;
  out[o + 32] = 0;
  out[o + 33] = 0;
  out[o + 34] = 0;
  out[o + 35] = m;
}
