import type { Robot } from "../model/robot.ts";
import { degrees } from "../spatial/units.ts";
import type { PlanContext } from "../trajectory/moves.ts";
import type { MotionSegment } from "../trajectory/plan.ts";
import type { Program } from "../program/program.ts";
import type { Finding } from "./verdict.ts";
import type { Layout } from "../trajectory/layout.ts";

export type Severity = "warn" | "bad";

/** What every check is given, and where it puts what it finds. */
export interface CheckScene {
  readonly program: Program;
  readonly robot: Robot;
  readonly context: PlanContext;
  readonly layout: Layout;
  add(step: string, severity: Severity, finding: Finding): void;
}

/** A motion of the plan with the step it belongs to. */
export function* motions(scene: CheckScene): Generator<MotionSegment> {
  for (const segment of scene.layout.plan.segments)
    if (segment.kind === "motion" && segment.times_s.length > 1) yield segment;
}

/** When a step begins for the first time; 0 for one that is not in the plan. */
export function startOf(scene: CheckScene, step: string): number {
  return scene.layout.plan.segments.find(segment => segment.step === step)?.start_s ?? 0;
}

export const deg = (angle_rad: number): string => `${degrees(angle_rad).toFixed(1)}°`;
export const seconds = (t_s: number): string => `${t_s.toFixed(2)} s`;
/** A speed in m/s with as many digits as it needs. */
export const metresPerSecond = (mps: number): string => `${mps < 0.1 ? mps.toPrecision(2) : mps.toFixed(2)} m/s`;
