import type { MoveStep, Program, Step } from "../program/program.ts";
import { motionAssumptions } from "../robots/jerk.ts";
import type { Robot } from "../robots/robot.ts";
import type { Pose } from "../spatial/pose.ts";
import { passes, resolveMove } from "./moves.ts";
import type { MotionSegment, Plan, Segment } from "./plan.ts";
import type { Slowed } from "./run-timing.ts";
import { PATH_TOLERANCE_M, RunPlanner } from "./run.ts";
import { explainStop, type Stuck } from "./stop.ts";

export interface PlanOptions {
  /** Posture the program starts from; the robot's home by default. */
  readonly start_rad?: ArrayLike<number>;
  /** Where the robot stands in the cell. */
  readonly worldFromBase?: Pose<"world", "base">;
  /** How far the TCP may be off a commanded path [m]. */
  readonly tolerance_m?: number;
  /** Time a gripper is given to close or open [s]. */
  readonly gripper_s?: number;
}

/** Not published for most grippers; a plan gives one this long. */
export const GRIPPER_S = 0.2;

/** What the planner noticed on the way, for the checks. */
export interface PlanNote { readonly step: string; readonly at_s: number; readonly slowed: Slowed }

interface Planned {
  readonly plan: Plan;
  readonly notes: readonly PlanNote[];
  /** What the plan's duration rests on, one sentence each (row N-64). */
  readonly assumptions: readonly string[];
}
export type PlanAnswer = ({ readonly kind: "planned" } & Planned) | ({ readonly kind: "stuck"; readonly stuck: Stuck } & Planned);

const isMove = (step: Step | undefined): step is MoveStep => step?.type === "move";

/**
 * Lays a program out in time: joints together on joint moves, straight and circular TCP paths within `tolerance_m`,
 * corners blended, and every joint within its speed and acceleration at every instant. A program that cannot be carried
 * out gives the plan up to the step that stands in the way.
 *
 * The program is trusted to come from `parseProgram`.
 */
export function planProgram(program: Program, robot: Robot, options: PlanOptions = {}): PlanAnswer {
  const writer = new PlanWriter(robot, options);
  const planner = new RunPlanner(robot, options.tolerance_m ?? PATH_TOLERANCE_M);
  const context = { tools: program.tools, frames: program.frames, ...(options.worldFromBase === undefined ? {} : { worldFromBase: options.worldFromBase }) };
  const steps = program.steps, assumptions = durationAssumptions(program, robot);
  for (let i = 0; i < steps.length;) {
    const step = steps[i]!;
    if (step.type !== "move") { writer.rest(step); i++; continue; }
    let moves = runFrom(steps, i).map(move => resolveMove(move, robot, context));
    for (;;) {
      const answer = planner.plan(moves, writer.q);
      if (answer.kind === "timed") { writer.run(answer.run.parts, answer.run.slowed); break; }
      const at = answer.stop.move, stuck = explainStop(answer.stop, moves[at]!, robot);
      if (at > 0) {
        // What comes before the move in the way can still be done, with a stop at its end.
        moves = moves.slice(0, at);
        const before = planner.plan(moves, writer.q);
        if (before.kind === "timed") writer.run(before.run.parts, before.run.slowed);
      }
      return { kind: "stuck", stuck, plan: writer.plan(program.robot), notes: writer.notes, assumptions };
    }
    i += moves.length;
  }
  return { kind: "planned", plan: writer.plan(program.robot), notes: writer.notes, assumptions };
}

/** What the durations of a program's steps rest on, one sentence each. */
export const durationAssumptions = (program: Program, robot: Robot, gripper_s = GRIPPER_S): string[] => [
  ...robot.assumptions, ...motionAssumptions(robot),
  ...(program.steps.some(step => step.type === "gripper") ? [`The gripper is given ${gripper_s} s to close or open.`] : []),
];

/** The moves from step `at` on that are passed without a stop in between. */
export function runFrom(steps: readonly Step[], at: number): MoveStep[] {
  const run: MoveStep[] = [];
  for (let i = at; ; i++) {
    const step = steps[i], next = steps[i + 1];
    if (!isMove(step)) return run;
    run.push(step);
    if (!isMove(next) || !passes(step, next)) return run;
  }
}

/** Appends segments and keeps the time and the posture they end at. */
export class PlanWriter {
  readonly q: Float64Array;
  readonly notes: PlanNote[] = [];
  private readonly segments: Segment[] = [];
  private readonly gripper_s: number;
  private t_s = 0;
  private closed = false;

  constructor(robot: Robot, options: PlanOptions) {
    this.q = Float64Array.from(options.start_rad ?? robot.home_rad);
    this.gripper_s = options.gripper_s ?? GRIPPER_S;
  }

  get now_s(): number { return this.t_s; }

  rest(step: Exclude<Step, MoveStep>): void {
    if (step.type === "gripper") this.closed = step.closed;
    const duration_s = step.type === "wait" ? step.s : step.type === "gripper" ? this.gripper_s : 0;
    this.segments.push({ kind: "rest", step: step.id, start_s: this.t_s, duration_s, q_rad: this.q.slice(), gripperClosed: this.closed });
    this.t_s += duration_s;
  }

  run(parts: readonly MotionSegment[], slowed: readonly Slowed[]): void {
    const n = this.q.length, begun_s = this.t_s;
    for (const part of parts) {
      // Summed one by one, so that each part begins at the very number the one before ends at.
      this.segments.push({ ...part, start_s: this.t_s });
      this.t_s += part.duration_s;
      this.q.set(part.q_rad.subarray(part.q_rad.length - n));
    }
    for (const one of slowed) this.notes.push({ step: parts[one.move]!.step, at_s: begun_s + parts[one.move]!.start_s, slowed: one });
  }

  /** Goes on from another posture, for drawing what comes behind a step that cannot be carried out. */
  jumpTo(q_rad: ArrayLike<number>): void { this.q.set(q_rad); }

  plan(robot: string): Plan { return { robot, duration_s: this.t_s, segments: this.segments }; }
}
