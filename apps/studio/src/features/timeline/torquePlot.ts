import type { Plan, Pose, Program, Robot, TorqueSeries } from "@twincell/core";

type Profiler = (
  plan: Plan,
  robot: Robot,
  program: Program,
  options: { readonly period_s: number; readonly worldFromBase: Pose<"world", "base"> },
) => TorqueSeries;
export type TorquePlot =
  | { readonly kind: "known"; readonly data: [number[], ...number[][]] }
  | { readonly kind: "unknown"; readonly sentence: string };

/** Lines at −100 and 100 % behind the joints' torques. */
export const LIMIT_LINES = 2;
const POINTS = 1200;

/**
 * [t, J1 … Jn, −100, 100]: torques as shares of what each joint can give [%], so that two lines are the limits of all;
 * or why not.
 */
export function torquePlot(
  plan: Plan,
  robot: Robot,
  program: Program,
  worldFromBase: Pose<"world", "base">,
  profile: Profiler,
): TorquePlot {
  const series = profile(plan, robot, program, { period_s: Math.max(plan.duration_s / POINTS, 1e-3), worldFromBase });
  if (series.kind === "unknown") return series;
  const { joints, limits_Nm, torque_Nm, times_s } = series;
  const rows = Array.from({ length: joints }, (_, j) =>
    Array.from(times_s, (_t, i) => (100 * torque_Nm[i * joints + j]!) / limits_Nm[j]!),
  );
  return {
    kind: "known",
    data: [Array.from(times_s), ...rows, ...[-100, 100].map(limit => Array.from(times_s, () => limit))],
  };
}
