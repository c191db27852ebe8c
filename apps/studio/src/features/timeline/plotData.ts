import type { Plan, Program, Robot, TorqueSeries } from "@twincell/core";

export type PlotWhat = "angles" | "speeds" | "torques";
type Sampler = (plan: Plan, t_s: number, q_rad: Float64Array, qd_rad_s?: Float64Array) => unknown;
type Profiler = (plan: Plan, robot: Robot, program: Program, options: { readonly period_s: number }) => TorqueSeries;
const POINTS = 1200, JOINTS = 6, DEGREES = 180 / Math.PI;

/** [t, J1 … J6] in s and ° or °/s on an even grid. */
export function plotData(plan: Plan, what: "angles" | "speeds", sample: Sampler): [number[], ...number[][]] {
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

/** [t, J1 … Jn] with torques as a share of what each joint can give [%], so that one pair of lines at ±100 is the limit of all; or why not. */
export function torquePlotData(plan: Plan, robot: Robot, program: Program, profile: Profiler): { readonly kind: "known"; readonly data: [number[], ...number[][]] } | { readonly kind: "unknown"; readonly sentence: string } {
  const series = profile(plan, robot, program, { period_s: Math.max(plan.duration_s / POINTS, 1e-3) });
  if (series.kind === "unknown") return series;
  const { joints, limits_Nm, torque_Nm, times_s } = series;
  const rows = Array.from({ length: joints }, (_, j) => Array.from(times_s, (_t, i) => (100 * torque_Nm[i * joints + j]!) / limits_Nm[j]!));
  return { kind: "known", data: [Array.from(times_s), ...rows] };
}
