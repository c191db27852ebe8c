import { armScratch, compose, flangePose, identity, type Pose, type Program, type Robot, type Step } from "@twincell/core";

/** One line of `simulate` and `run`: where everything is at that time. TCP in the world. */
export interface Moment {
  readonly t: number;
  readonly q: readonly number[];
  readonly position: readonly number[];
  readonly quaternion: readonly number[];
  readonly io: { readonly gripper: boolean };
  readonly step: string;
}

/** Makes moments from joint angles; the TCP is that of the tool the step moves. */
export function momentWriter(robot: Robot, worldFromBase: Pose<"world", "base">, tools: Program["tools"], toolOfStep: (step: string) => string) {
  const scratch = armScratch(), flange = identity<"base", "flange">(), none = identity<"flange", "tcp">();
  return (t: number, q: Float64Array, gripperClosed: boolean, step: string): Moment => {
    const tcp = compose(worldFromBase, compose(flangePose(robot.arm, q, flange, scratch), tools[toolOfStep(step)] ?? none));
    return { t: Number(t.toFixed(9)), q: Array.from(q), position: tcp.position, quaternion: tcp.quaternion, io: { gripper: gripperClosed }, step };
  };
}

/** Name of the tool each step moves; a wait keeps the tool of the move before it. */
export function toolsBySteps(steps: readonly Step[]): (step: string) => string {
  const tools = new Map<string, string>();
  let last = "flange";
  for (const step of steps) {
    if (step.type === "move") last = step.target.tool ?? "flange";
    tools.set(step.id, last);
  }
  return id => tools.get(id) ?? "flange";
}
