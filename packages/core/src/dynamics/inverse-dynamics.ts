import type { DynamicsModel } from "./model.ts";
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
 * Torques that a motion needs: recursive Newton–Euler, everything seen from the base.
 *
 *   v_i = v_{i−1} + S_i q̇_i,   a_i = a_{i−1} + S_i q̈_i + v_i × S_i q̇_i,   a_0 = −g
 *   f_i = I_i a_i + v_i × I_i v_i + f_{i+1},   τ_i = S_i · f_i + J_i gear_i² q̈_i
 *
 * @param q, qd, qdd  n angles [rad], speeds [rad/s], accelerations [rad/s²].
 * @param out         receives n torques at the joints [N m]; returned.
 * @param scratch     made for this model; with it and `out` the call allocates nothing.
 * @throws {JointCountFault} when q does not hold n angles.
 * @see Featherstone, Rigid Body Dynamics Algorithms, Springer 2008, ch. 5.
 */
export function inverseDynamics(
  model: DynamicsModel,
  q: ArrayLike<number>,
  qd: ArrayLike<number>,
  qdd: ArrayLike<number>,
  out: Float64Array = new Float64Array(model.rotors_kgm2.length),
  scratch: DynamicsScratch = dynamicsScratch(model),
): Float64Array {
  placeBodies(model, q, scratch);
  const n = model.rotors_kgm2.length;
  const { axes, placed, speeds, accelerations, forces, one } = scratch;
  const g = model.gravity_mps2;
  for (let i = 0; i < n; i++) {
    const at = 6 * i;
    const before = at - 6;
    for (let k = 0; k < 6; k++) {
      speeds[at + k] = (i > 0 ? speeds[before + k]! : 0) + axes[at + k]! * qd[i]!;
      accelerations[at + k] = (i > 0 ? accelerations[before + k]! : k > 2 ? -g[k - 3]! : 0) + axes[at + k]! * qdd[i]!;
    }
    addCrossMotion(speeds, axes, at, qd[i]!, accelerations, at);
    momentum(placed, i, accelerations, at, forces, at);
    momentum(placed, i, speeds, at, one, 0);
    addCrossForce(speeds, at, one, forces, at);
  }
  for (let i = n - 1; i >= 0; i--) {
    const at = 6 * i;
    out[i] = dot6(axes, at, forces, at) + model.rotors_kgm2[i]! * qdd[i]!;
    if (i > 0) for (let k = 0; k < 6; k++) forces[at - 6 + k]! += forces[at + k]!;
  }
  return out;
}
