import { BODY, type DynamicsModel } from "./model.ts";
import { dot6, dynamicsScratch, momentum, placeBodies, type DynamicsScratch } from "./placed.ts";

/**
 * Inertia of the arm at its joints, composite rigid bodies: what joint j feels when joint i accelerates.
 *
 *   M_ij = S_j · I^c_i S_i  for j ≤ i,   I^c_i = Σ_{k ≥ i} I_k,   M_ii += J_i gear_i²
 *
 * @param out      receives n × n numbers [kg m²], symmetric; returned.
 * @param scratch  made for this model; with it and `out` the call allocates nothing.
 * @see Featherstone, Rigid Body Dynamics Algorithms, Springer 2008, ch. 6.
 */
export function massMatrix(
  model: DynamicsModel,
  q: ArrayLike<number>,
  out: Float64Array = new Float64Array(model.rotors_kgm2.length ** 2),
  scratch: DynamicsScratch = dynamicsScratch(model),
): Float64Array {
  placeBodies(model, q, scratch);
  const n = model.rotors_kgm2.length;
  const { axes, placed, one } = scratch;
  for (let i = n - 1; i >= 0; i--) {
    if (i < n - 1) for (let k = 0; k < BODY; k++) placed[BODY * i + k]! += placed[BODY * (i + 1) + k]!;
    momentum(placed, i, axes, 6 * i, one, 0);
    for (let j = 0; j <= i; j++) {
      const value = dot6(axes, 6 * j, one, 0);
      out[n * i + j] = value;
      out[n * j + i] = value;
    }
    out[n * i + i]! += model.rotors_kgm2[i]!;
  }
  return out;
}
