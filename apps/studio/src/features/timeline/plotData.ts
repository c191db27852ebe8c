import type { Plan } from "@twincell/core";

export type PlotWhat = "angles" | "speeds";
type Sampler = (plan: Plan, t_s: number, q_rad: Float64Array, qd_rad_s?: Float64Array) => unknown;
const POINTS = 1200;
const DEGREES = 180 / Math.PI;

/** [t, J1 … Jn] in s and ° or °/s on an even grid. */
export function plotData(plan: Plan, joints: number, what: PlotWhat, sample: Sampler): [number[], ...number[][]] {
  const t: number[] = [];
  const rows: number[][] = Array.from({ length: joints }, () => []);
  const q = new Float64Array(joints);
  const qd = new Float64Array(joints);
  for (let i = 0; i <= POINTS; i++) {
    const at = (plan.duration_s * i) / POINTS;
    sample(plan, at, q, qd);
    t.push(at);
    for (let j = 0; j < joints; j++) rows[j]!.push((what === "angles" ? q[j]! : qd[j]!) * DEGREES);
  }
  return [t, ...rows];
}
