import type { MotionVerdict } from "../collision/motion.ts";
import { cornerRulesOf, ruledCorner } from "../trajectory/corner-rules.ts";
import { blends, passes, type Move } from "../trajectory/moves.ts";
import type { MotionSegment } from "../trajectory/plan.ts";
import type { CornerSweep } from "../trajectory/run-path.ts";
import { RunPlanner } from "../trajectory/run.ts";
import type { Stretch } from "./grasped-parts.ts";
import type { Prover } from "./prover.ts";
import type { CheckScene } from "./scene.ts";

type Contact = Extract<MotionVerdict, { kind: "contact" }>;

/** A corner of the plan that is passed without a stop. */
export interface PassedCorner {
  /** Ids of the moves before and behind it, as the plan has them. */
  readonly step: string;
  readonly next: string;
  readonly at_s: number;
  readonly sweep: CornerSweep;
}
export interface InCorner {
  readonly contact: Contact;
  /** Whether nothing is too near on both ways up to the point itself. */
  readonly isFreeSharp: boolean;
}

/** A chord that no other posture it stands for is farther from in any joint is not told apart from them [rad]. */
const FINEST_RAD = 0.0005;
/** Chords of one corner at most; what is left then counts as too near. */
const MOST_CHORDS = 2000;
/** Parts of a corner in which the arm may be found to be out of reach; smaller ones are left out. */
const PARTS = 16;

/**
 * The corners of a plan by the motion behind them. How a controller rounds a corner is its own: no maker promises a
 * curve. What is known is where it begins and ends at most: as far from the point as the program says or as the
 * languages of the robot make of it (`CornerRule`), whichever is farther. Whatever curve it takes in there lies between
 * the two ways and the chord that cuts them off.
 */
export function cornersOf(scene: CheckScene): ReadonlyMap<MotionSegment, PassedCorner> {
  const { layout, robot } = scene;
  const found = new Map<MotionSegment, PassedCorner>();
  const rules = cornerRulesOf(robot);
  const planner = new RunPlanner(robot);
  const joints = robot.arm.joints.length;
  for (const { parts, moves } of runsOf(scene)) {
    const first = layout.starts.get(parts[0]!.step);
    if (first === undefined) continue;
    const ends = parts.map(({ q_rad }) => q_rad.slice(q_rad.length - joints));
    const sweeps = planner.corners(moves, first, ends, (step, shorter_m) =>
      rules.map(rule => ruledCorner(rule, robot, step, shorter_m)),
    );
    for (const sweep of sweeps) {
      const next = parts[sweep.move + 1]!;
      found.set(next, {
        step: parts[sweep.move]!.step,
        next: next.step,
        at_s: next.start_s,
        sweep,
      });
    }
  }
  return found;
}

/** Motions that are passed into each other, each with its move. */
function* runsOf(
  scene: CheckScene,
): Generator<{ readonly parts: readonly MotionSegment[]; readonly moves: readonly Move[] }, void> {
  let parts: MotionSegment[] = [];
  let moves: Move[] = [];
  const joints = scene.robot.arm.joints.length;
  for (const segment of scene.layout.plan.segments) {
    const move = segment.kind === "motion" ? scene.layout.moves.get(segment.step) : undefined;
    const last = moves.at(-1);
    const goesOn =
      segment.kind === "motion" &&
      move !== undefined &&
      last !== undefined &&
      passes(last.step, move.step) &&
      meet(parts.at(-1)!, segment, joints);
    if (!goesOn) {
      if (moves.some(({ step }) => blends(step))) yield { parts, moves };
      parts = [];
      moves = [];
    }
    if (segment.kind !== "motion" || move === undefined) continue;
    parts.push(segment);
    moves.push(move);
  }
  if (moves.some(({ step }) => blends(step))) yield { parts, moves };
}

/** Postures that follow each other in a plan differ by rounding [rad]; other branches of the program by more. */
const SAME_RAD = 1e-9;
function meet(before: MotionSegment, behind: MotionSegment, joints: number): boolean {
  const end = before.q_rad.length - joints;
  for (let j = 0; j < joints; j++) if (Math.abs(before.q_rad[end + j]! - behind.q_rad[j]!) > SAME_RAD) return false;
  return true;
}

/**
 * What is too near in a corner, whatever curve the controller takes in it; undefined where nothing is. Chord by chord,
 * each with room for all that lie between it and those beside it; where that is too much, by halves.
 *
 * @param before @param behind  what is watched at the end of the motion before and at the beginning of the one behind.
 */
export function firstInCorner(
  { sweep }: PassedCorner,
  prover: Prover,
  before: Stretch | undefined,
  behind: Stretch | undefined,
): InCorner | undefined {
  const both = [before, behind].filter(each => each !== undefined);
  const pairs: Pick<Stretch, "watched" | "keepsMargin"> = {
    watched: pair => both.every(({ watched }) => watched(pair)),
    keepsMargin: pair => both.every(({ keepsMargin }) => keepsMargin(pair)),
  };
  const open: [from: number, to: number][] = [[0, 1]];
  let looks = 0;
  for (let part = open.pop(); part; part = open.pop()) {
    const [from, to] = part;
    const middle = (from + to) / 2;
    const [first, chord, last] = [sweep.chord(from), sweep.chord(middle), sweep.chord(to)];
    if (first === undefined || chord === undefined || last === undefined) {
      if (to - from > 1 / PARTS) open.push([middle, to], [from, middle]);
      continue;
    }
    const slack_rad = spread(chord, first, last);
    const contact = onChord(chord, slack_rad, prover, pairs);
    looks++;
    if (contact === undefined) continue;
    if (Math.max(...slack_rad) <= FINEST_RAD || looks >= MOST_CHORDS)
      return { contact, isFreeSharp: isFreeSharp(sweep, prover, pairs) };
    open.push([middle, to], [from, middle]);
  }
  return undefined;
}

/** How far any joint is from a chord on those beside it, at most. */
function spread(
  chord: readonly Float64Array[],
  first: readonly Float64Array[],
  last: readonly Float64Array[],
): Float64Array {
  const most = new Float64Array(chord[0]!.length);
  chord.forEach((q, k) => {
    for (let j = 0; j < most.length; j++)
      most[j] = Math.max(most[j]!, Math.abs(first[k]![j]! - q[j]!), Math.abs(last[k]![j]! - q[j]!));
  });
  return most;
}

function onChord(
  chord: readonly Float64Array[],
  slack_rad: Float64Array,
  prover: Prover,
  pairs: Pick<Stretch, "watched" | "keepsMargin">,
): Contact | undefined {
  for (let k = 1; k < chord.length; k++) {
    const verdict = prover.proveLine(chord[k - 1]!, chord[k]!, slack_rad, pairs);
    if (verdict.kind === "contact") return verdict;
  }
  return undefined;
}

function isFreeSharp(sweep: CornerSweep, prover: Prover, pairs: Pick<Stretch, "watched" | "keepsMargin">): boolean {
  let last = sweep.chord(0);
  for (let k = 1; k <= PARTS; k++) {
    const chord = sweep.chord(k / PARTS);
    if (chord === undefined || last === undefined) return false;
    const none = new Float64Array(chord[0]!.length);
    const [beforeIt, behindIt] = [chord[0]!, chord.at(-1)!];
    if (prover.proveLine(last[0]!, beforeIt, none, pairs).kind !== "clear") return false;
    if (prover.proveLine(last.at(-1)!, behindIt, none, pairs).kind !== "clear") return false;
    last = chord;
  }
  return true;
}
