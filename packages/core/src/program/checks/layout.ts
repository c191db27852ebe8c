import type { Robot } from "../../robots/robot.ts";
import { Follower } from "../../trajectory/follow.ts";
import { GoalFinder } from "../../trajectory/goal.ts";
import { resolveMove, type Move, type PlanContext } from "../../trajectory/moves.ts";
import type { Plan } from "../../trajectory/plan.ts";
import { PlanWriter, runFrom, type PlanNote, type PlanOptions } from "../../trajectory/planner.ts";
import { PATH_TOLERANCE_M, RunPlanner } from "../../trajectory/run.ts";
import type { RunStop } from "../../trajectory/run-path.ts";
import type { Program } from "../program.ts";

/** A step that could not be laid out as taught, and when. */
export interface Obstacle { readonly move: Move; readonly stop: RunStop; readonly at_s: number }

/** A whole program laid out as far as it goes, so that every step can be judged. */
export interface Layout {
  readonly plan: Plan;
  readonly notes: readonly PlanNote[];
  readonly obstacles: readonly Obstacle[];
  /** The moves by step id. */
  readonly moves: ReadonlyMap<string, Move>;
  /** Posture in which each move begins. */
  readonly starts: ReadonlyMap<string, Float64Array>;
  /** Steps that were laid out, or found to be impossible. */
  readonly evaluated: ReadonlySet<string>;
}

export interface LayoutOptions extends PlanOptions {
  readonly onProgress?: (share: number) => void;
  readonly cancelled?: () => boolean;
}

/**
 * Like `planProgram`, but goes on behind a step that cannot be carried out, from the posture its target would have, and
 * beyond joint limits, so that the path there can be drawn and named (rows L-38, L-40).
 */
export function layOut(program: Program, robot: Robot, options: LayoutOptions = {}): Layout {
  const writer = new PlanWriter(robot, options), planner = new RunPlanner(robot, options.tolerance_m ?? PATH_TOLERANCE_M);
  const goals = new GoalFinder(robot, new Follower(robot.arm));
  const context: PlanContext = { tools: program.tools, frames: program.frames, ...(options.worldFromBase === undefined ? {} : { worldFromBase: options.worldFromBase }) };
  const obstacles: Obstacle[] = [], moves = new Map<string, Move>(), starts = new Map<string, Float64Array>(), evaluated = new Set<string>();
  const steps = program.steps;

  const write = (run: readonly Move[]): RunStop | undefined => {
    const first = writer.q.slice(), answer = planner.plan(run, writer.q, true);
    if (answer.kind === "stopped") return answer.stop;
    for (let k = 0; k < run.length; k++) {
      const id = run[k]!.step.id, part = answer.run.parts[k]!;
      starts.set(id, k === 0 ? first : part.q_rad.slice(0, first.length));
      evaluated.add(id);
    }
    writer.run(answer.run.parts, answer.run.slowed);
    return undefined;
  };

  for (let i = 0; i < steps.length;) {
    if (options.cancelled?.() === true) break;
    options.onProgress?.(i / steps.length);
    const step = steps[i]!;
    if (step.type !== "move") { writer.rest(step); evaluated.add(step.id); i++; continue; }
    const run = runFrom(steps, i).map(move => resolveMove(move, robot, context));
    for (const move of run) moves.set(move.step.id, move);
    i += run.length;
    let rest: readonly Move[] = run;
    while (rest.length > 0) {
      const stop = write(rest);
      if (stop === undefined) break;
      const at = stop.move, move = rest[at]!;
      if (stop.kind === "goal" && stop.goal.beyond_rad !== undefined) {
        // It fails by joint limits only: the path is laid out beyond them.
        obstacles.push({ move, stop, at_s: writer.now_s });
        const q_rad = stop.goal.beyond_rad;
        rest = rest.map((other, k) => (k === at ? { ...other, q_rad } : other));
        continue;
      }
      if (at > 0) write(rest.slice(0, at));
      obstacles.push({ move, stop, at_s: writer.now_s });
      starts.set(move.step.id, writer.q.slice());
      evaluated.add(move.step.id);
      const goal = goals.find(move, writer.q);
      if (goal.kind === "posture") writer.jumpTo(goal.q_rad);
      else if (goal.beyond_rad !== undefined) writer.jumpTo(goal.beyond_rad);
      rest = rest.slice(at + 1);
    }
  }
  return { plan: writer.plan(program.robot), notes: writer.notes, obstacles, moves, starts, evaluated };
}
