import { CellCollider, keptApart } from "../collision/cell-collider.ts";
import type { CellGeometry } from "../collision/cell.ts";
import { findPath, type PathOptions, type PathOutcome } from "../planning/find-path.ts";
import { PathValidator } from "../planning/path-validator.ts";
import type { Refusal } from "../outcomes.ts";
import type { Robot } from "../model/robot.ts";
import { jointText } from "../model/slide.ts";
import { resolveMove, type PlanContext } from "../trajectory/moves.ts";
import { RunPlanner } from "../trajectory/run.ts";
import { checkProgram, type CheckOptions } from "./check.ts";
import { layOutProgram, type Layout } from "../trajectory/layout.ts";
import { jointMove } from "./repairs.ts";
import { nameOf } from "./solid-names.ts";
import { applyRepair, freshStepIds } from "../program/edit.ts";
import type { MoveStep, Program } from "../program/program.ts";
import type { Repair } from "./verdict.ts";

export interface DetourOptions extends Omit<PathOptions, "maxLooks">, Pick<CheckOptions, "start_rad" | "payload"> {
  readonly cell: CellGeometry;
  /** Distance the robot must keep from the cell [m]; more is tried first. */
  readonly margin_m?: number;
  readonly maxLooks?: number;
}

export type Detour =
  /** Points to go through before the step, as one edit; the whole program was checked with them. */
  | { readonly kind: "found"; readonly repair: Repair; readonly points: number; readonly length_rad: number }
  | { readonly kind: "none"; readonly why: Refusal }
  | { readonly kind: "cancelled" };

/** Wanted first, with the robot's shape error on top; where that finds nothing the margin asked for has to do [m]. */
const COMFORTABLE_M = 0.01;
/** How far the path may leave an inserted point, the most first [m]: what touches nothing is taken. */
const BLENDS_M = [0.1, 0.05, 0.02, 0] as const;
const CAREFUL = { ratio: 0.25 } as const;

/**
 * Finds points to lead a step past what it meets: from where the step begins to where it ends, as joint moves through
 * free postures, blended as far as nothing is touched. A straight or circular step becomes a joint move, because its
 * line is what is blocked.
 */
export function detour(program: Program, step: string, robot: Robot, options: DetourOptions): Detour {
  const { cell, margin_m = 0 } = options;
  const { worldFromBase } = cell;
  const layout = layOutProgram(program, robot, {
    worldFromBase,
    ...(options.start_rad === undefined ? {} : { start_rad: options.start_rad }),
  });
  const context: PlanContext = { tools: program.tools, frames: program.frames, worldFromBase };
  const ends = endsOf(layout, step, robot);
  if (ends === undefined)
    return none(
      "way.no-move",
      "This step is no move that can be carried out, so there is nothing to lead round.",
      "Mend what stops it first; the check says what it is.",
    );
  let answer: PathOutcome | undefined;
  for (const margin of margin_m < COMFORTABLE_M ? [COMFORTABLE_M, margin_m] : [margin_m]) {
    const collider = new CellCollider(cell, robot.arm);
    collider.allowContactsAt(robot.home_rad);
    const checker = new PathValidator(collider, robot.arm, { margin_m: margin, keepsMargin: keptApart });
    answer = findPath(checker, ends.from_rad, ends.to_rad, options);
    if (answer.kind === "cancelled") return { kind: "cancelled" };
    if (answer.kind !== "found") continue;
    const repair = fitting(program, ends.step, answer.way, robot, context, options);
    if (repair !== undefined)
      return { kind: "found", repair, points: answer.way.length - 2, length_rad: answer.length_rad };
  }
  return { kind: "none", why: whyNot(answer!, cell, robot) };
}

interface Ends {
  readonly step: MoveStep;
  readonly from_rad: Float64Array;
  readonly to_rad: Float64Array;
}

function endsOf(layout: Layout, id: string, robot: Robot): Ends | undefined {
  for (const [turn, from_rad] of layout.starts) {
    const move = layout.moves.get(turn);
    if (move === undefined || (layout.turns.get(turn)?.written.id ?? turn) !== id) continue;
    const answer = new RunPlanner(robot).plan(
      [{ ...move, step: { ...move.step, blend_m: 0, blend_ratio: 0 } }],
      from_rad,
    );
    // Where the straight way cannot be followed the end is still known, when it was taught as a posture.
    const to_rad = answer.kind === "timed" ? lastOf(answer.run.parts, from_rad.length) : move.q_rad;
    return to_rad === undefined ? undefined : { step: { ...move.step, id }, from_rad, to_rad };
  }
  return undefined;
}

const lastOf = (parts: readonly { readonly q_rad: Float64Array }[], joints: number): Float64Array | undefined =>
  parts.at(-1)?.q_rad.slice(-joints);

/** The edit with the widest blends with which the program's own check finds nothing wrong with its steps. */
function fitting(
  program: Program,
  step: MoveStep,
  way: readonly Float64Array[],
  robot: Robot,
  context: PlanContext,
  options: DetourOptions,
): Repair | undefined {
  const { cell, margin_m = 0, cancelled } = options;
  const goal = way.at(-1)!;
  const ids = freshStepIds(program, way.length - 2);
  const speed = "ratio" in step.speed ? step.speed : CAREFUL;
  const tool = step.target.tool === undefined ? {} : { tool: step.target.tool };
  for (const blend_m of BLENDS_M) {
    const points = way.slice(1, -1).map(
      (q, i): MoveStep => ({
        id: ids[i]!,
        type: "move",
        path: "ptp",
        target: { q: [...q], ...tool },
        speed,
        blend_m,
        ...(step.group === undefined ? {} : { group: step.group }),
      }),
    );
    const last = jointMove(
      step,
      endsThere(step, way.at(-2)!, goal, robot, context) ? step.target : { q: [...goal], ...tool },
    );
    const repair: Repair = { kind: "detour", sentence: said(points.length), insertBefore: points, replace: last };
    const { verdict } = checkProgram(applyRepair(program, step.id, repair), robot, {
      cell,
      margin_m,
      ...(cancelled === undefined ? {} : { cancelled }),
      ...(options.start_rad === undefined ? {} : { start_rad: options.start_rad }),
      ...(options.payload === undefined ? {} : { payload: options.payload }),
    });
    const own = new Set([...ids, step.id]);
    if (verdict.steps.every(({ id, verdict: says }) => !own.has(id) || says === "ok" || says === "warn")) return repair;
  }
  return undefined;
}

/**
 * Whether a joint move from `before` to the step's own target ends in the posture wanted, so that the target can stay
 * as it was taught.
 */
function endsThere(
  step: MoveStep,
  before: Float64Array,
  goal: Float64Array,
  robot: Robot,
  context: PlanContext,
): boolean {
  const answer = new RunPlanner(robot).plan([resolveMove(jointMove(step, step.target), robot, context)], before);
  const end = answer.kind === "timed" ? lastOf(answer.run.parts, goal.length) : undefined;
  return end?.every((q, k) => Math.abs(q - goal[k]!) < 1e-6) === true;
}

const said = (points: number): string =>
  points === 0
    ? "Go there by a joint move; nothing is in its way."
    : points === 1
      ? "Go round over one more point."
      : `Go round over ${points} more points.`;

const none = (code: string, sentence: string, hint: string): Detour => ({
  kind: "none",
  why: { code, sentence, hint },
});

function whyNot(answer: PathOutcome, cell: CellGeometry, robot: Robot): Refusal {
  switch (answer.kind) {
    case "blocked": {
      const {
        end,
        contact: { a, b },
      } = answer;
      return {
        code: `way.${end}-in-contact`,
        sentence: `At the ${end === "start" ? "start of the step" : "target"} ${nameOf(a, cell)} is in contact with ${nameOf(b, cell)}; no way leads ${end === "start" ? "out of" : "into"} that.`,
        hint:
          end === "start"
            ? "Mend the step before, where the robot comes to stand like this."
            : "Move the target, or tilt the tool.",
      };
    }
    case "outside-limits":
      return {
        code: "way.outside-limits",
        sentence: `At the ${answer.end === "start" ? "start of the step" : "target"} joint ${answer.joint} is at ${jointText(robot.arm.joints[answer.joint - 1]!, answer.wanted_rad)}; its limit is ${jointText(robot.arm.joints[answer.joint - 1]!, answer.limit_rad)}.`,
        hint: "Bring the joint inside its limits first.",
      };
    case "not-found":
      return {
        code: "way.not-found",
        sentence: `No free way was found in ${answer.looks} postures${answer.within_s === undefined ? "" : ` and ${answer.within_s} s`}; there may be none.`,
        hint: "Make room in the cell, or split the move with a point of your own.",
      };
    case "found":
      return {
        code: "way.not-kept",
        sentence: "A free way was found, but a joint move along it fails the program's check.",
        hint: "Lower the speed of the step, then try again.",
      };
    case "cancelled":
      return { code: "way.cancelled", sentence: "The search was cancelled.", hint: "Start it again when you like." };
  }
}
