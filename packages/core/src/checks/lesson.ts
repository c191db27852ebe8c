import { armScratch, flangePose } from "../kinematics/forward.ts";
import type { Robot } from "../model/robot.ts";
import type { Program } from "../program/program.ts";
import { everyStep } from "../program/walk.ts";
import { compose, identity, type Pose } from "../spatial/pose.ts";
import { rotate } from "../spatial/quaternion.ts";
import { distance, dot, type Vector3 } from "../spatial/vector.ts";
import type { Plan } from "../trajectory/plan.ts";
import { sampleSegment } from "../trajectory/sample.ts";
import type { Verdict } from "./verdict.ts";

/** A place that the tool has to come to, with the direction its z axis points there, in the world. */
export interface LessonGoal {
  readonly name: string;
  readonly position_m: Vector3;
  readonly axis: Vector3;
}

/** A task made of a program: what the tool has to do, and how well whoever made it did that (rows M-61, M-62). */
export interface Lesson {
  readonly format: "twincell.lesson";
  readonly version: 1;
  readonly name: string;
  /** Id of the robot it was made on. */
  readonly robot: string;
  readonly goals: readonly LessonGoal[];
  /** How often the gripper closes. */
  readonly grips: number;
  readonly expert: { readonly duration_s: number; readonly length_m: number };
  /** A goal counts as met within this of it [m], with the tool's axis within this [rad]. */
  readonly within_m: number;
  readonly within_rad: number;
}

export interface LessonResult {
  /** Goals met in their order. Distances are the nearest that the tool came [m], one a goal. */
  readonly met: readonly boolean[];
  readonly distances_m: readonly number[];
  readonly grips: number;
  /** Steps that cannot be carried out. */
  readonly bad: number;
  readonly duration_s: number;
  readonly length_m: number;
  /** 0 … 100. */
  readonly score: number;
  readonly passed: boolean;
  /** What is not good enough to pass. */
  readonly lacks: readonly ("goals" | "grips" | "bad" | "time" | "path" | "score")[];
}

export const PASS_SCORE = 70;
/** Passed within so many times the time and the way of the one who made the lesson. */
export const MOST_TIME_RATIO = 2;
export const MOST_PATH_RATIO = 1.5;
const MOST_GOALS = 24;
/** Two ends of moves nearer than this are one goal [m]. */
const SAME_M = 0.002;
/** The way of the tool is looked at this often [s], and at no more instants than that. */
const LOOK_S = 0.01;
const MOST_LOOKS = 20_000;

/** The way of the tool through a plan. */
interface ToolWay {
  readonly poses: readonly { readonly at_s: number; readonly position: Vector3; readonly axis: Vector3 }[];
  /** Which of the poses are ends of moves, with their steps. */
  readonly ends: readonly { readonly step: string; readonly pose: number }[];
  readonly length_m: number;
  readonly grips: number;
}

function wayOfTool(program: Program, robot: Robot, worldFromBase: Pose<"world", "base">, plan: Plan): ToolWay {
  const tools = new Map<string, Pose<"flange", "tcp">>();
  for (const step of everyStep(program))
    if (step.type === "move") tools.set(step.id, program.tools[step.target.tool ?? "flange"] ?? identity());
  const q = new Float64Array(robot.arm.joints.length);
  const scratch = armScratch();
  const flange = identity<"base", "flange">();
  const poses: { at_s: number; position: Vector3; axis: Vector3 }[] = [];
  const ends: { step: string; pose: number }[] = [];
  const every_s = Math.max(LOOK_S, plan.duration_s / MOST_LOOKS);
  let grips = 0;
  let closed = false;
  for (const segment of plan.segments) {
    if (segment.kind === "rest") {
      if (segment.gripperClosed && !closed) grips++;
      closed = segment.gripperClosed;
      continue;
    }
    const tool = tools.get(segment.step) ?? identity<"flange", "tcp">();
    const looks = Math.max(1, Math.ceil(segment.duration_s / every_s));
    for (let k = 0; k <= looks; k++) {
      const t = (segment.duration_s * k) / looks;
      sampleSegment(segment, t, q);
      const { position, quaternion } = compose(compose(worldFromBase, flangePose(robot.arm, q, flange, scratch)), tool);
      poses.push({ at_s: segment.start_s + t, position, axis: rotate(quaternion, [0, 0, 1]) });
    }
    // Several motions of one step, as of a detour, end where the last of them ends.
    if (ends.at(-1)?.step === segment.step) ends.pop();
    ends.push({ step: segment.step, pose: poses.length - 1 });
  }
  let length_m = 0;
  for (let i = 1; i < poses.length; i++) length_m += distance(poses[i - 1]!.position, poses[i]!.position);
  return { poses, ends, length_m, grips };
}

/**
 * A lesson of a program that can be carried out: its goals are where its moves end, at most 24 of them evenly along a
 * longer way. Undefined when it moves nowhere.
 */
export function lessonOf(
  program: Program,
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
  plan: Plan,
): Lesson | undefined {
  const way = wayOfTool(program, robot, worldFromBase, plan);
  const names = new Map(Array.from(everyStep(program), step => [step.id, step.name]));
  const goals: LessonGoal[] = [];
  for (const { step, pose } of way.ends) {
    const { position, axis } = way.poses[pose]!;
    const last = goals.at(-1);
    if (last !== undefined && distance(last.position_m, position) < SAME_M) continue;
    goals.push({ name: names.get(step) ?? "", position_m: position, axis });
  }
  if (goals.length === 0) return undefined;
  const few =
    goals.length <= MOST_GOALS
      ? goals
      : Array.from({ length: MOST_GOALS }, (_, i) => goals[Math.round((i * (goals.length - 1)) / (MOST_GOALS - 1))]!);
  return {
    format: "twincell.lesson",
    version: 1,
    name: program.name,
    robot: robot.id,
    goals: few,
    grips: way.grips,
    expert: { duration_s: plan.duration_s, length_m: way.length_m },
    within_m: 0.01,
    within_rad: 0.2,
  };
}

/**
 * Judges what a learner taught, each part 1 when as good as the one who made the lesson:
 *
 *   score = 100 · (0.3 goals + 0.25 accuracy + 0.15 clean + 0.15 time + 0.15 economy)
 *   accuracy = mean of 1 / (1 + d / within), clean = 1 / (1 + bad steps)
 *   time = min(1, T_expert / T), economy = min(1, L_expert / L), both only of the goals that are met
 *
 * d is the nearest that the tool comes to a goal after the goal before it was met.
 */
export function judgeLesson(
  lesson: Lesson,
  program: Program,
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
  plan: Plan,
  verdict: Pick<Verdict, "steps">,
): LessonResult {
  const way = wayOfTool(program, robot, worldFromBase, plan);
  const cos = Math.cos(lesson.within_rad);
  const met: boolean[] = [];
  const distances_m: number[] = [];
  let from = 0;
  for (const { position_m, axis } of lesson.goals) {
    let nearest = Number.POSITIVE_INFINITY;
    let place = -1;
    for (let i = from; i < way.poses.length; i++) {
      const each = way.poses[i]!;
      const off = distance(each.position, position_m);
      const isThere = off <= lesson.within_m && dot(each.axis, axis) >= cos;
      // Once there, the way goes on from its nearest; a later return belongs to later goals.
      if (place >= 0 && !isThere) break;
      if (off < nearest || (isThere && place < 0)) nearest = off;
      else if (place >= 0) continue;
      if (isThere) place = i;
    }
    met.push(place >= 0);
    distances_m.push(nearest);
    if (place >= 0) from = place;
  }
  const done = met.filter(Boolean).length / met.length;
  const accuracy =
    distances_m.reduce((sum, off) => sum + (Number.isFinite(off) ? 1 / (1 + off / lesson.within_m) : 0), 0) /
    distances_m.length;
  const bad = verdict.steps.filter(step => step.verdict === "bad").length;
  const share = (expert: number, own: number): number => (own > 0 ? Math.min(1, expert / own) : 0);
  const { duration_s, length_m } = lesson.expert;
  const score =
    100 *
    (0.3 * done +
      0.25 * accuracy +
      0.15 / (1 + bad) +
      0.15 * done * share(duration_s, plan.duration_s) +
      0.15 * done * share(length_m, way.length_m));
  const lacks: LessonResult["lacks"][number][] = [];
  if (done < 1) lacks.push("goals");
  if (way.grips < lesson.grips) lacks.push("grips");
  if (bad > 0) lacks.push("bad");
  if (plan.duration_s > MOST_TIME_RATIO * duration_s) lacks.push("time");
  if (way.length_m > MOST_PATH_RATIO * length_m) lacks.push("path");
  if (lacks.length === 0 && score < PASS_SCORE) lacks.push("score");
  return {
    met,
    distances_m,
    grips: way.grips,
    bad,
    duration_s: plan.duration_s,
    length_m: way.length_m,
    score,
    passed: lacks.length === 0,
    lacks,
  };
}

/** Which of several attempts is the best: one that passed before one that did not, then the higher score; else −1. */
export function bestResult(results: readonly Pick<LessonResult, "passed" | "score">[]): number {
  let best = -1;
  for (const [i, { passed, score }] of results.entries()) {
    const other = results[best];
    if (other === undefined || (passed && !other.passed) || (passed === other.passed && score > other.score)) best = i;
  }
  return best;
}

/** Reads a lesson that was saved. Undefined, or one sentence of what is wrong with it. */
export function readLesson(text: string): Lesson | string {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    return "The file is no JSON.";
  }
  const lesson = value as Partial<Lesson> | null;
  if (lesson?.format !== "twincell.lesson" || lesson.version !== 1) return "The file is no lesson of version 1.";
  const finite = (numbers: unknown): boolean =>
    Array.isArray(numbers) && numbers.length === 3 && numbers.every(Number.isFinite);
  const goals: readonly Partial<LessonGoal>[] = Array.isArray(lesson.goals) ? lesson.goals : [];
  if (goals.length === 0 || !goals.every(goal => finite(goal.position_m) && finite(goal.axis)))
    return "The lesson has no goals with a position and an axis of three numbers.";
  const numbers = [
    lesson.grips,
    lesson.within_m,
    lesson.within_rad,
    lesson.expert?.duration_s,
    lesson.expert?.length_m,
  ];
  if (!numbers.every(number => typeof number === "number" && Number.isFinite(number) && number >= 0))
    return "The lesson lacks its tolerances, or time and way of whoever made it.";
  if (typeof lesson.name !== "string" || typeof lesson.robot !== "string")
    return "The lesson says neither its name nor its robot.";
  return lesson as Lesson;
}
