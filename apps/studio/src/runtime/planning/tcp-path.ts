import {
  armScratch,
  compose,
  everyStep,
  flangePose,
  identity,
  samplePlan,
  type Plan,
  type Pose,
  type Program,
  type Robot,
  type Vector3,
  type Verdict,
} from "@twincell/core";
import type { PathStretch } from "../../stores/play.ts";

/** Between two drawn points the TCP moves by less than a few millimetres at ordinary speeds. */
const EVERY_S = 0.02;
const MOST = 120;

/** The way of the TCP in the world, step by step with its verdict, for drawing. */
export function tcpPath(
  plan: Plan,
  verdict: Verdict,
  program: Program,
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
): readonly PathStretch[] {
  const verdicts = new Map(verdict.steps.map(step => [step.id, step.verdict]));
  const tools = toolsByStep(program);
  const q = new Float64Array(robot.arm.joints.length);
  const scratch = armScratch();
  const baseFromFlange = identity<"base", "flange">();
  const worldFromFlange = identity<"world", "flange">();
  const worldFromTcp = identity<"world", "tcp">();
  return plan.segments.flatMap((segment): PathStretch[] => {
    if (segment.kind !== "motion") return [];
    const flangeFromTcp = tools.get(segment.step) ?? identity<"flange", "tcp">();
    const count = Math.min(MOST, Math.max(1, Math.ceil(segment.duration_s / EVERY_S)));
    const points: Vector3[] = [];
    for (let i = 0; i <= count; i++) {
      samplePlan(plan, segment.start_s + segment.duration_s * Math.min(i / count, 1 - 1e-9), q);
      compose(worldFromBase, flangePose(robot.arm, q, baseFromFlange, scratch), worldFromFlange);
      compose(worldFromFlange, flangeFromTcp, worldFromTcp);
      points.push([worldFromTcp.position[0], worldFromTcp.position[1], worldFromTcp.position[2]]);
    }
    return [{ step: segment.step, verdict: verdicts.get(segment.step) ?? "unknown", points }];
  });
}

function toolsByStep(program: Program): ReadonlyMap<string, Pose<"flange", "tcp">> {
  const tools = new Map<string, Pose<"flange", "tcp">>();
  for (const step of everyStep(program)) {
    const tool = step.type === "move" && step.target.tool !== undefined ? program.tools[step.target.tool] : undefined;
    if (tool) tools.set(step.id, tool);
  }
  return tools;
}
