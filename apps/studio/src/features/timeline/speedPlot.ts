import { everyStep, planPath, type Plan, type Pose, type Program, type Robot } from "@twincell/core";

/** Points over the whole plan, at least one every 2 ms. */
const POINTS = 1200;
const FINEST_S = 0.002;

/**
 * [t, TCP speed, programmed speed] in s and mm/s (row L-35): how fast the point of the step's tool goes, and what the
 * step asks for, null where it asks for none in mm/s.
 */
export function speedPlot(
  plan: Plan,
  robot: Robot,
  program: Program,
  worldFromBase: Pose<"world", "base">,
): [number[], ...(number | null)[][]] {
  const tools = new Map<string, Pose<"flange", "tcp">>();
  const asked = new Map<string, number>();
  for (const step of everyStep(program)) {
    if (step.type !== "move") continue;
    const tool = program.tools[step.target.tool ?? "flange"];
    if (tool !== undefined) tools.set(step.id, tool);
    if ("mps" in step.speed) asked.set(step.id, step.speed.mps * 1000);
  }
  const path = planPath(plan, robot, {
    worldFromBase,
    period_s: Math.max(plan.duration_s / POINTS, FINEST_S),
    flangeFromTcp: step => tools.get(step) ?? FLANGE,
  });
  const t: number[] = [];
  const is: number[] = [];
  const wanted: (number | null)[] = [];
  const add = (at_s: number, mmps: number, asked_mmps: number | null): void => {
    t.push(at_s);
    is.push(mmps);
    wanted.push(asked_mmps);
  };
  let stretch = 0;
  for (const segment of plan.segments) {
    if (segment.kind === "rest") {
      add(segment.start_s, 0, null);
      add(segment.start_s + segment.duration_s, 0, null);
      continue;
    }
    const { first, count } = path.stretches[stretch++]!;
    const mmps = asked.get(segment.step) ?? null;
    for (let k = first; k < first + count; k++) add(path.times_s[k]!, path.speed_mps[k]! * 1000, mmps);
  }
  return [t, is, wanted];
}
const FLANGE: Pose<"flange", "tcp"> = { position: [0, 0, 0], quaternion: [0, 0, 0, 1] };
