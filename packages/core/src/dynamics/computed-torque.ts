import type { DynamicsModel } from "./model.ts";
import { inverseDynamics } from "./inverse-dynamics.ts";
import { dynamicsScratch, type DynamicsScratch } from "./placed.ts";

/** Working memory of `computedTorque`. */
export interface ComputedTorqueScratch {
  readonly dynamics: DynamicsScratch;
  readonly wanted: Float64Array;
}
export const computedTorqueScratch = (model: DynamicsModel): ComputedTorqueScratch => ({
  dynamics: dynamicsScratch(model),
  wanted: new Float64Array(model.rotors_kgm2.length),
});

/**
 * The advanced control law (row L-68): the model takes gravity, coupling and centrifugal torques away, and every joint
 * answers like a mass point on a spring of its own, at the same pace in every posture.
 *
 *   τ = M(q) ( q̈_d + 2 ω ė + ω² e ) + h(q, q̇),   e = q_d − q
 *
 * @param bandwidth_rad_s  ω; errors fade with e^{−ω t} (1 + ω t).
 * @param torqueMax_Nm     per joint; null for none.
 * @param out              receives n torques [N m]; returned.
 */
export function computedTorque(
  model: DynamicsModel,
  wanted: { readonly q: ArrayLike<number>; readonly qd: ArrayLike<number>; readonly qdd: ArrayLike<number> },
  q: ArrayLike<number>,
  qd: ArrayLike<number>,
  bandwidth_rad_s: number,
  torqueMax_Nm: ArrayLike<number> | null,
  out: Float64Array = new Float64Array(model.rotors_kgm2.length),
  scratch: ComputedTorqueScratch = computedTorqueScratch(model),
): Float64Array {
  const n = model.rotors_kgm2.length;
  const aim = scratch.wanted;
  for (let i = 0; i < n; i++)
    aim[i] =
      wanted.qdd[i]! + 2 * bandwidth_rad_s * (wanted.qd[i]! - qd[i]!) + bandwidth_rad_s ** 2 * (wanted.q[i]! - q[i]!);
  inverseDynamics(model, q, qd, aim, out, scratch.dynamics);
  if (torqueMax_Nm)
    for (let i = 0; i < n; i++) out[i] = Math.max(-torqueMax_Nm[i]!, Math.min(torqueMax_Nm[i]!, out[i]!));
  return out;
}
