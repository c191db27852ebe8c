import { flow, type FlowEvent, type FlowOptions } from "../program/flow.ts";
import type { MoveStep, PrimitiveStep, Program, SetStep } from "../program/program.ts";
import { SignalTable, holds } from "../program/signals.ts";
import { motionAssumptions } from "../model/jerk.ts";
import type { Payload } from "../dynamics/model.ts";
import type { Robot } from "../model/robot.ts";
import type { Pose } from "../spatial/pose.ts";
import { chooseBranches, withChoice } from "./continuity/index.ts";
import { passes, resolveMove, type Move } from "./moves.ts";
import type { MotionSegment, Plan, Segment, SignalWrite } from "./plan.ts";
import type { Slowed } from "./run-timing.ts";
import { PATH_TOLERANCE_M, RunPlanner } from "./run.ts";
import { Gentler, type Gentled } from "./torque/gentle.ts";
import { explainStop, type Stuck } from "./stop.ts";

export interface PlanOptions {
  /** Posture the program starts from; the robot's home by default. */
  readonly start_rad?: ArrayLike<number> | undefined;
  /** Where the robot stands in the cell. */
  readonly worldFromBase?: Pose<"world", "base"> | undefined;
  /** How far the TCP may be off a commanded path [m]. */
  readonly tolerance_m?: number;
  /** Time a gripper is given to close or open [s]. */
  readonly gripper_s?: number;
  /**
   * Slows every run of motions until no joint is asked for more torque than it can give (rows ), where masses
   * and torque limits are published. `payload` is what the flange carries before the first payload step.
   */
  readonly withinTorque?: { readonly payload?: Payload };
  /** What inputs are, for decisions; false and 0 otherwise. */
  readonly inputs?: Readonly<Record<string, boolean | number>>;
}

/** Not published for most grippers; a plan gives one this long. */
export const GRIPPER_S = 0.2;

/** What the planner noticed on the way, for the checks. */
export interface PlanNote {
  readonly step: string;
  readonly at_s: number;
  readonly slowed: Slowed;
}

interface Planned {
  readonly plan: Plan;
  readonly notes: readonly PlanNote[];
  /** Runs that were slowed for their torques. */
  readonly gentled: readonly Gentled[];
  /** What the plan's duration rests on, one sentence each (row N-64). */
  readonly assumptions: readonly string[];
}
export type PlanAnswer =
  | ({ readonly kind: "planned" } & Planned)
  | ({ readonly kind: "stuck"; readonly stuck: Stuck } & Planned);

/** Loops beyond this many steps are laid out in part. */
const MOST_PLANNED = 200_000;

/**
 * Lays a program out in time: joints together on joint moves, straight and circular TCP paths within `tolerance_m`,
 * corners blended, and every joint within its speed and acceleration at every instant. Loops, calls and pallets are
 * carried out, a loop "forever" once; waits for signals take no time. Where the nearest posture at every target would
 * lead to a flip or into a limit, postures are chosen over the whole path (`chooseBranches`); `withBranches` writes
 * them into the program. A program that cannot be carried out gives the plan up to the step that stands in the way.
 *
 * The program is trusted to come from `parseProgram`.
 */
export function planProgram(program: Program, robot: Robot, options: PlanOptions = {}): PlanAnswer {
  const writer = new PlanWriter(robot, options);
  const planner = new RunPlanner(robot, options.tolerance_m ?? PATH_TOLERANCE_M);
  const context = {
    tools: program.tools,
    frames: program.frames,
    ...(options.worldFromBase === undefined ? {} : { worldFromBase: options.worldFromBase }),
  };
  const assumptions = durationAssumptions(program, robot);
  const parts = ahead(program, options.inputs ?? {});
  const gentler = new Gentler(robot, options);
  const { gentled } = gentler;
  const runs = parts.flatMap(part =>
    part.kind === "run" ? [part.moves.map(({ step }) => resolveMove(step, robot, context))] : [],
  );
  const choice = chooseBranches(runs, robot, writer.q);
  let run = 0;
  let first = 0;
  for (const part of parts) {
    if (part.kind === "step") {
      gentler.carry(part.step);
      if (part.step.type !== "move") writer.rest(part.step, part.stands);
      continue;
    }
    if (part.kind === "failed") {
      const { code, sentence, hint } = part.why;
      const stuck: Stuck = { step: part.step.id, code, sentence, hint };
      return { kind: "stuck", stuck, plan: writer.plan(program.robot), notes: writer.notes, gentled, assumptions };
    }
    if (part.kind !== "run") continue;
    let moves: readonly Move[] = runs[run++]!;
    const count = moves.length;
    if (choice !== undefined) moves = withChoice(moves, choice, first);
    first += count;
    for (;;) {
      const answer = planner.plan(moves, writer.q);
      if (answer.kind === "timed") {
        const held = gentler.hold(answer.run.parts, writer.now_s);
        if (held.kind === "too-heavy")
          return {
            kind: "stuck",
            stuck: held.stuck,
            plan: writer.plan(program.robot),
            notes: writer.notes,
            gentled,
            assumptions,
          };
        writer.run(held.parts, answer.run.slowed);
        break;
      }
      const at = answer.stop.move;
      const stuck = explainStop(answer.stop, moves[at]!, robot);
      if (at > 0) {
        // What comes before the move in the way can still be done, with a stop at its end.
        moves = moves.slice(0, at);
        const before = planner.plan(moves, writer.q);
        const held = before.kind === "timed" ? gentler.hold(before.run.parts, writer.now_s) : undefined;
        if (before.kind === "timed" && held?.kind === "held") writer.run(held.parts, before.run.slowed);
      }
      return { kind: "stuck", stuck, plan: writer.plan(program.robot), notes: writer.notes, gentled, assumptions };
    }
  }
  return { kind: "planned", plan: writer.plan(program.robot), notes: writer.notes, gentled, assumptions };
}

/** The whole program in order, before anything moves: signals change only where steps write them, and waits end. */
function ahead(program: Program, inputs: NonNullable<PlanOptions["inputs"]>): FlowPart[] {
  const signals = new SignalTable(Object.entries(inputs));
  const parts: FlowPart[] = [];
  const options: FlowOptions = {
    decide: (when, variable) => holds(when, signals, variable),
    read: signal => signals.read(signal),
    // What is waited for comes in time, and a loop that looks at lines ends after its first round.
    met: () => true,
    rounds: 1,
    lineRounds: 1,
    mostSteps: MOST_PLANNED,
  };
  for (const part of inRuns(flow(program, options))) {
    parts.push(part);
    if (part.kind === "failed") break;
    if (part.kind === "step" && part.step.type === "set") remember(part.step, signals);
  }
  return parts;
}

/** A plan decides by what is written: a pulse is over before the next decision. */
function remember({ signal, to, pulse_s }: SetStep, signals: SignalTable): void {
  signals.write(signal, pulse_s !== undefined && typeof to === "boolean" ? !to : to);
}

/** What the durations of a program's steps rest on, one sentence each. */
export const durationAssumptions = (program: Program, robot: Robot, gripper_s = GRIPPER_S): string[] => [
  ...robot.assumptions,
  ...motionAssumptions(robot),
  ...(program.steps.some(step => step.type === "gripper")
    ? [`The gripper is given ${gripper_s} s to close or open.`]
    : []),
];

type StepFlowEvent = Extract<FlowEvent, { kind: "step" }>;
/** A move that happens, with the step it comes from. */
export type MoveFlowEvent = StepFlowEvent & { readonly step: MoveStep };

/** What is laid out at once: a happening, or moves that are passed without a stop in between. */
export type FlowPart = FlowEvent | { readonly kind: "run"; readonly moves: readonly MoveFlowEvent[] };

/** The same happenings with moves that are passed without a stop in between as one. */
export function* inRuns(happenings: Iterable<FlowEvent>): Generator<FlowPart, void> {
  let moves: MoveFlowEvent[] = [];
  for (const happening of happenings) {
    const last = moves.at(-1);
    // Neither a remark nor what is computed stops the robot.
    if (happening.kind === "assigned" || (happening.kind === "passed" && happening.step.type === "comment")) {
      yield happening;
      continue;
    }
    const move = isMove(happening) ? happening : undefined;
    if (last !== undefined && !(move !== undefined && passes(last.step, move.step))) {
      yield { kind: "run", moves };
      moves = [];
    }
    if (move === undefined) yield happening;
    else moves.push(move);
  }
  if (moves.length > 0) yield { kind: "run", moves };
}

const isMove = (happening: FlowEvent): happening is MoveFlowEvent =>
  happening.kind === "step" && happening.step.type === "move";

/** Appends segments and keeps the time and the posture they end at. */
export class PlanWriter {
  readonly q: Float64Array;
  readonly notes: PlanNote[] = [];
  private readonly segments: Segment[] = [];
  private readonly writes: SignalWrite[] = [];
  private readonly gripper_s: number;
  private t_s = 0;
  private closed = false;

  constructor(robot: Robot, options: PlanOptions) {
    this.q = Float64Array.from(options.start_rad ?? robot.home_rad);
    this.gripper_s = options.gripper_s ?? GRIPPER_S;
  }

  get now_s(): number {
    return this.t_s;
  }

  /** @param stands  a stop that the program does not say: it is only there when it takes time. */
  rest(step: Exclude<PrimitiveStep, MoveStep>, stands = false): void {
    if (step.type === "gripper") this.closed = step.closed;
    if (step.type === "set") this.write(step);
    const duration_s = step.type === "wait" ? step.s : step.type === "gripper" ? this.gripper_s : 0;
    if (stands && duration_s === 0) return;
    this.segments.push({
      kind: "rest",
      step: step.id,
      start_s: this.t_s,
      duration_s,
      q_rad: this.q.slice(),
      gripperClosed: this.closed,
    });
    this.t_s += duration_s;
  }

  private write({ signal, to, pulse_s }: SetStep): void {
    this.writes.push({ at_s: this.t_s, signal, to });
    if (pulse_s !== undefined && typeof to === "boolean")
      this.writes.push({ at_s: this.t_s + pulse_s, signal, to: !to });
  }

  run(parts: readonly MotionSegment[], slowed: readonly Slowed[]): void {
    const n = this.q.length;
    const begun_s = this.t_s;
    for (const part of parts) {
      // Summed one by one, so that each part begins at the very number the one before ends at.
      this.segments.push({ ...part, start_s: this.t_s });
      this.t_s += part.duration_s;
      this.q.set(part.q_rad.subarray(part.q_rad.length - n));
    }
    for (const one of slowed)
      this.notes.push({ step: parts[one.move]!.step, at_s: begun_s + parts[one.move]!.start_s, slowed: one });
  }

  /** Goes on from another posture, for drawing what comes behind a step that cannot be carried out. */
  jumpTo(q_rad: ArrayLike<number>): void {
    this.q.set(q_rad);
  }

  plan(robot: string): Plan {
    return {
      robot,
      duration_s: this.t_s,
      segments: this.segments,
      writes: this.writes.sort((a, b) => a.at_s - b.at_s),
    };
  }
}
