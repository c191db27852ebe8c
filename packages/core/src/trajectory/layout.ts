import type { Robot } from "../model/robot.ts";
import { Follower } from "./follow.ts";
import {
  chooseBranches,
  ContinuitySolver,
  withChoice,
  type Break,
  type Choice,
  type Flip,
} from "./continuity/index.ts";
import { GoalFinder } from "./goal.ts";
import { resolveMove, type Move, type PlanContext } from "./moves.ts";
import type { Plan } from "./plan.ts";
import { PlanWriter, inRuns, type MoveFlowEvent, type FlowPart, type PlanNote, type PlanOptions } from "./planner.ts";
import { PATH_TOLERANCE_M, RunPlanner } from "./run.ts";
import type { RunStop } from "./run-path.ts";
import { flow, type FlowFailure, type PlaceVisit } from "../program/flow.ts";
import type { MoveStep, Program, Step } from "../program/program.ts";
import { everyStep } from "../program/walk.ts";

/** A step that could not be laid out as taught, and when. */
export interface Obstacle {
  readonly move: Move;
  readonly stop: RunStop;
  readonly at_s: number;
}

/**
 * A move that no posture of its path gets through, with how far the best gets, or before which the arm would have to
 * turn over.
 */
export type Impasse = { readonly move: Move; readonly broken: Break } | { readonly move: Move; readonly flip: Flip };

export interface Ends {
  readonly from_rad: Float64Array;
  readonly to_rad: Float64Array;
}

/** One carrying out of a step that is carried out more than once, or at the place of a pallet. */
export interface Turn {
  readonly written: Step;
  readonly visits: readonly PlaceVisit[];
}

/**
 * A whole program laid out as far as it goes, so that every step can be judged. A step that is carried out again gets
 * an id of its own for every time; `turns` says which step it was, and where.
 */
export interface Layout {
  readonly plan: Plan;
  readonly notes: readonly PlanNote[];
  readonly obstacles: readonly Obstacle[];
  readonly impasses: readonly Impasse[];
  /**
   * The postures at both ends of a taught move, before blending, by id; only of paths with something to choose or to
   * follow.
   */
  readonly ends: ReadonlyMap<string, Ends>;
  /** The moves by id. */
  readonly moves: ReadonlyMap<string, Move>;
  /** Posture in which each move begins. */
  readonly starts: ReadonlyMap<string, Float64Array>;
  readonly turns: ReadonlyMap<string, Turn>;
  /** Ids, as the program has them, of steps that were laid out, or found to be impossible. */
  readonly evaluated: ReadonlySet<string>;
  /** Decisions that lead to too many postures: what follows was not looked at from all of them. */
  readonly unjudged: ReadonlySet<string>;
  /** Steps at which the program cannot go on. */
  readonly failures: readonly { readonly step: Step; readonly why: FlowFailure; readonly at_s: number }[];
  /** Nothing was left out: a step that is not `evaluated` is never reached. */
  readonly complete: boolean;
  /** Loops were cut short because the program has more than this many steps. */
  readonly cut: number | undefined;
}

export interface LayoutOptions extends PlanOptions {
  readonly onProgress?: ((share: number) => void) | undefined;
  readonly cancelled?: (() => boolean) | undefined;
}

/** Twice round shows how the end of a loop goes into its beginning. */
const ROUNDS = 2;
/** Loops beyond this many steps go round twice only. */
const MOST_LAID_OUT = 100_000;
/** Postures that decisions may lead to at one place of the program; with more the decision stays unjudged. */
const MOST_POSTURES = 8;
/** Postures this near are one [rad]. */
const SAME_RAD = 1e-9;

/**
 * Like `planProgram`, but goes on behind a step that cannot be carried out, from the posture its target would have, and
 * beyond joint limits, so that the path there can be drawn and named (rows L-38, L-40). Both sides of a decision are
 * laid out, and what follows from every posture they lead to. Postures are chosen as `planProgram` chooses them.
 */
export function layOutProgram(program: Program, robot: Robot, options: LayoutOptions = {}): Layout {
  const sheet = new Sheet(program, robot, options);
  const count = Math.max(1, Array.from(everyStep(program)).length);
  const goesOn = (): boolean => {
    if (options.cancelled?.() === true) return false;
    options.onProgress?.(sheet.evaluated.size / count);
    return true;
  };
  // Postures are chosen over all that is done one after the other: from decision to decision.
  let complete = true;
  let parts: LinearPart[] = [];
  for (const part of inRuns(flow(program, { rounds: ROUNDS, mostSteps: MOST_LAID_OUT }))) {
    if (part.kind === "run" || part.kind === "step" || part.kind === "passed" || part.kind === "assigned") {
      parts.push(part);
      continue;
    }
    complete = sheet.section(parts, goesOn) && goesOn();
    parts = [];
    if (!complete) break;
    sheet.turn(part);
  }
  complete &&= sheet.section(parts, goesOn);
  return sheet.finish(complete);
}

type LinearPart = Extract<FlowPart, { kind: "run" | "step" | "passed" | "assigned" }>;
type Turning = Exclude<FlowPart, LinearPart>;
/** A posture the robot may be in, and how it was chosen to go on from there. */
interface Chain {
  readonly q: Float64Array;
  readonly choice: Choice | undefined;
}

class Sheet {
  readonly evaluated = new Set<string>();
  private readonly program: Program;
  private readonly robot: Robot;
  private readonly context: PlanContext;
  private readonly writer: PlanWriter;
  private readonly planner: RunPlanner;
  private readonly goals: GoalFinder;
  private readonly solver: ContinuitySolver;
  private readonly obstacles: Obstacle[] = [];
  private readonly impasses: Impasse[] = [];
  private readonly failures: Layout["failures"][number][] = [];
  private readonly ends = new Map<string, Ends>();
  private readonly moves = new Map<string, Move>();
  private readonly starts = new Map<string, Float64Array>();
  private readonly unjudged = new Set<string>();
  private readonly turns = new Map<string, Turn>();
  private readonly times = new Map<string, number>();
  /** Postures the robot may be in here; none where the program never gets to. */
  private postures: readonly Float64Array[];
  private readonly forks: { readonly before: readonly Float64Array[]; after: readonly Float64Array[] }[] = [];
  private made = 0;

  constructor(program: Program, robot: Robot, options: LayoutOptions) {
    this.program = program;
    this.robot = robot;
    this.context = {
      tools: program.tools,
      frames: program.frames,
      ...(options.worldFromBase === undefined ? {} : { worldFromBase: options.worldFromBase }),
    };
    this.writer = new PlanWriter(robot, options);
    this.planner = new RunPlanner(robot, options.tolerance_m ?? PATH_TOLERANCE_M);
    this.goals = new GoalFinder(robot, new Follower(robot.arm));
    this.solver = new ContinuitySolver(robot);
    this.postures = [this.writer.q.slice()];
  }

  /** What is done one after the other, from every posture the robot may be in. @returns false when `goesOn` did. */
  section(parts: readonly LinearPart[], goesOn: () => boolean): boolean {
    const runs = parts.flatMap(part =>
      part.kind === "run" ? [part.moves.map(({ step }) => resolveMove(step, this.robot, this.context))] : [],
    );
    let chains: readonly Chain[] = this.postures.map(q => ({
      q,
      choice: chooseBranches(runs, this.robot, q, this.solver),
    }));
    let run = 0;
    let first = 0;
    for (const part of parts) {
      if (!goesOn()) return false;
      if (part.kind === "run") {
        chains = this.run(part.moves, runs[run++]!, chains, first);
        first += part.moves.length;
      } else if (chains.length > 0) this.happen(part);
    }
    this.postures = chains.map(({ q }) => q);
    return true;
  }

  /** Decisions and ends. */
  turn(happening: Turning): void {
    switch (happening.kind) {
      case "fork":
        this.forks.push({ before: this.postures, after: [] });
        return;
      case "other": {
        const fork = this.forks.at(-1)!;
        fork.after = this.postures;
        this.postures = fork.before;
        return this.stand(this.postures);
      }
      case "join": {
        const after = distinct([...this.forks.pop()!.after, ...this.postures].map(q => ({ q })));
        if (after.length > MOST_POSTURES) this.unjudged.add(happening.step.id);
        this.postures = after.slice(0, MOST_POSTURES).map(({ q }) => q);
        return this.stand(this.postures);
      }
      case "failed":
        this.failures.push({ step: happening.step, why: happening.why, at_s: this.writer.now_s });
        this.evaluated.add(happening.step.id);
        return;
      case "end":
        this.postures = [];
    }
  }

  private happen(happening: Exclude<LinearPart, { kind: "run" }>): void {
    if (happening.kind === "step") {
      if (happening.step.type === "move") return;
      this.made++;
      this.writer.rest(happening.step, happening.stands);
    }
    this.evaluated.add(happening.step.id);
  }

  private run(
    run: readonly MoveFlowEvent[],
    resolved: readonly Move[],
    chains: readonly Chain[],
    first: number,
  ): readonly Chain[] {
    const ends: Chain[] = [];
    for (const { q, choice } of chains) {
      this.writer.jumpTo(q);
      const moves = run.map((happening, i) => this.own(happening, resolved[i]!));
      const chosen = choice === undefined ? moves : withChoice(moves, choice, first);
      for (const move of chosen) this.moves.set(move.step.id, move);
      if (choice !== undefined) {
        this.noteImpasses(choice, chosen, first);
        this.noteEnds(choice, chosen, first, q);
      }
      this.lay(chosen);
      ends.push({ q: this.writer.q.slice(), choice });
    }
    this.made += run.length;
    const after = distinct(ends);
    this.stand(after.map(({ q }) => q));
    return after;
  }

  private noteEnds({ way }: Choice, moves: readonly Move[], first: number, q: Float64Array): void {
    for (let i = 0; i < moves.length; i++) {
      const from_rad = first + i === 0 ? q : way.ends[first + i - 1];
      const to_rad = way.ends[first + i];
      if (from_rad !== undefined && to_rad !== undefined) this.ends.set(moves[i]!.step.id, { from_rad, to_rad });
    }
  }

  private noteImpasses({ turning, broken }: Choice, moves: readonly Move[], first: number): void {
    for (const one of broken) {
      const move = moves[one.move - first];
      if (move !== undefined) this.impasses.push({ move, broken: one });
    }
    for (const flip of turning) {
      const move = moves[flip.move - first];
      if (move !== undefined) this.impasses.push({ move, flip });
    }
  }

  finish(complete: boolean): Layout {
    const { writer, obstacles, impasses, ends, moves, starts, turns, evaluated, unjudged, failures } = this;
    return {
      plan: writer.plan(this.program.robot),
      notes: writer.notes,
      obstacles,
      impasses,
      ends,
      moves,
      starts,
      turns,
      evaluated,
      unjudged,
      failures,
      complete,
      cut: this.made > MOST_LAID_OUT ? MOST_LAID_OUT : undefined,
    };
  }

  private stand(configurations: readonly Float64Array[]): void {
    if (configurations[0] !== undefined) this.writer.jumpTo(configurations[0]);
  }

  /** The move under an id that no other carrying out has. */
  private own({ step, written, visits }: MoveFlowEvent, move: Move): Move {
    const time = (this.times.get(step.id) ?? 0) + 1;
    this.times.set(step.id, time);
    this.evaluated.add(step.id);
    const own: MoveStep = time === 1 ? step : { ...step, id: `${step.id}\0${time}` };
    if (time > 1 || visits.length > 0) this.turns.set(own.id, { written, visits });
    return time === 1 ? move : { ...move, step: own };
  }

  private lay(run: readonly Move[]): void {
    const { writer, obstacles } = this;
    let rest = run;
    while (rest.length > 0) {
      const stop = this.write(rest);
      if (stop === undefined) return;
      const at = stop.move;
      const move = rest[at]!;
      if (stop.kind === "goal" && stop.goal.beyond_rad !== undefined) {
        // It fails by joint limits only: the path is laid out beyond them.
        obstacles.push({ move, stop, at_s: writer.now_s });
        const q_rad = stop.goal.beyond_rad;
        rest = rest.map((other, k) => (k === at ? { ...other, q_rad } : other));
        continue;
      }
      if (at > 0) this.write(rest.slice(0, at));
      obstacles.push({ move, stop, at_s: writer.now_s });
      this.starts.set(move.step.id, writer.q.slice());
      const goal = this.goals.find(move, writer.q);
      if (goal.kind === "posture") writer.jumpTo(goal.q_rad);
      else if (goal.beyond_rad !== undefined) writer.jumpTo(goal.beyond_rad);
      rest = rest.slice(at + 1);
    }
  }

  private write(run: readonly Move[]): RunStop | undefined {
    const first = this.writer.q.slice();
    const answer = this.planner.plan(run, this.writer.q, true);
    if (answer.kind === "stopped") return answer.stop;
    for (let k = 0; k < run.length; k++)
      this.starts.set(run[k]!.step.id, k === 0 ? first : answer.run.parts[k]!.q_rad.slice(0, first.length));
    this.writer.run(answer.run.parts, answer.run.slowed);
    return undefined;
  }
}

function distinct<T extends { readonly q: Float64Array }>(all: readonly T[]): readonly T[] {
  const kept: T[] = [];
  for (const one of all)
    if (!kept.some(other => other.q.every((q, j) => Math.abs(q - one.q[j]!) <= SAME_RAD))) kept.push(one);
  return kept;
}
