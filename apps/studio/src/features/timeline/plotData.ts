import type { Plan } from "@twincell/core";

export type PlotWhat = "angles" | "speeds";
type Sampler = (plan: Plan, t_s: number, q_rad: Float64Array, qd_rad_s?: Float64Array) => unknown;
const POINTS = 1200, JOINTS = 6, DEGREES = 180 / Math.PI;

/** [t, J1 … J6] in s and ° or °/s on an even grid. */
export function plotData(plan: Plan, what: PlotWhat, sample: Sampler): [number[], ...number[][]] {
  const t: number[] = [], rows: number[][] = Array.from({ length: JOINTS }, () => []);
  const q = new Float64Array(JOINTS), qd = new Float64Array(JOINTS);
  for (let i = 0; i <= POINTS; i++) {
    const at = (plan.duration_s * i) / POINTS;
    sample(plan, at, q, qd);
    t.push(at);
    for (let j = 0; j < JOINTS; j++) rows[j]!.push((what === "angles" ? q[j]! : qd[j]!) * DEGREES);
  }
  return [t, ...rows];
}
