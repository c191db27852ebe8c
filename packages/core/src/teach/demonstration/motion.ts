import { scale, type Vector3 } from "../../spatial/vector.ts";
import { turnBetween } from "../../trajectory/geometry.ts";
import type { Demonstration } from "./demonstration.ts";

/** What the tool did at each sample, in the world. */
export interface DemonstratedMotion {
  readonly velocity_mps: readonly Vector3[];
  readonly angular_radps: readonly Vector3[];
  readonly acceleration_mps2: readonly Vector3[];
}

/**
 * Velocities by central differences, one-sided at both ends, and accelerations by the same of the velocities:
 *
 *   v_i = (x_{i+1} − x_{i−1}) / (t_{i+1} − t_{i−1}),   ω_i = 2 log(q_{i+1} q_{i−1}⁻¹) / (t_{i+1} − t_{i−1})
 */
export function demonstratedMotion({ times_s, worldFromTcp }: Demonstration): DemonstratedMotion {
  const last = times_s.length - 1;
  const around = (i: number): readonly [number, number] => [Math.max(0, i - 1), Math.min(last, i + 1)];
  const slope = (of: (i: number) => Vector3, i: number): Vector3 => {
    const [a, b] = around(i);
    const span_s = times_s[b]! - times_s[a]!;
    const from = of(a);
    return of(b).map((value, k) => (value - from[k]!) / span_s) as Vector3;
  };
  const velocity_mps = times_s.map((_, i) => slope(k => [...worldFromTcp[k]!.position], i));
  return {
    velocity_mps,
    angular_radps: times_s.map((_, i) => {
      const [a, b] = around(i);
      const turn = turnBetween(worldFromTcp[a]!.quaternion, worldFromTcp[b]!.quaternion);
      return scale(turn, 1 / (times_s[b]! - times_s[a]!));
    }),
    acceleration_mps2: times_s.map((_, i) => slope(k => velocity_mps[k]!, i)),
  };
}
