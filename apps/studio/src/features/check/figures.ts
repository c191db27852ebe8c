import type { Plan, Robot, StepVerdict, Verdict } from "@twincell/core";
import { worse } from "../../stores/play.ts";
import { showNumber } from "../../ui/expression.ts";
import { words } from "../../messages/index.ts";

export interface Figure {
  readonly name: string;
  readonly says: string;
  readonly verdict: StepVerdict;
}
const NEAR_RAD = (10 * Math.PI) / 180;

/** The figures of a whole program: clearance, joint margin, reach, cycle. */
export function figures(verdict: Verdict, plan: Plan | null, robot: Robot): readonly Figure[] {
  const of = (prefix: string): StepVerdict =>
    verdict.steps.reduce<StepVerdict>(
      (so, step) => (step.findings.some(finding => finding.code.startsWith(prefix)) ? worse(so, step.verdict) : so),
      "ok",
    );
  const unreached = verdict.steps.filter(step =>
    step.findings.some(finding => finding.code.startsWith("reach")),
  ).length;
  const margin = plan ? jointMargin(plan, robot) : null;
  return [
    {
      name: words.check.clearance,
      says:
        verdict.clearance_m === null
          ? words.check.notMeasured
          : `${showNumber(verdict.clearance_m, "length", verdict.clearance_m < 0.01 ? 1 : 0)} mm`,
      verdict: verdict.clearance_m === null ? "unknown" : of("collision"),
    },
    {
      name: words.check.margin,
      says: margin === null ? words.check.notMeasured : `${showNumber(margin, "angle", 1)}°`,
      verdict: margin === null ? "unknown" : margin < 0 ? "bad" : margin < NEAR_RAD ? "warn" : "ok",
    },
    {
      name: words.check.reach,
      says:
        unreached > 0
          ? words.check.reachBad(unreached, verdict.steps.length)
          : words.check.reachOk(verdict.steps.length),
      verdict: unreached > 0 ? "bad" : "ok",
    },
    { name: words.check.cycle, says: `${showNumber(verdict.duration_s, "time", 1)} s`, verdict: of("speed") },
  ];
}

/** Least angle any joint keeps to its limits over the whole plan; negative when one is beyond. */
export function jointMargin(plan: Plan, robot: Robot): number | null {
  let least = Infinity;
  const joints = robot.arm.joints;
  const n = joints.length;
  for (const segment of plan.segments) {
    for (let at = 0; at < segment.q_rad.length; at++) {
      const { lower_rad, upper_rad } = joints[at % n]!.limits;
      const q = segment.q_rad[at]!;
      least = Math.min(least, q - lower_rad, upper_rad - q);
    }
  }
  return Number.isFinite(least) ? least : null;
}
