import type { MotionCertificate } from "../collision/certificate.ts";
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
  /** The motions of the plan on both sides of it. */
  readonly before: MotionSegment;
  readonly behind: MotionSegment;
}
export interface InCorner {
  readonly contact: Contact;
  /** Whether nothing is too near on both ways up to the point itself. */
  readonly isFreeSharp: boolean;
}

/** A piece of a corner that is proven clear: its chords, `from` … `to`, are all near the one in the middle. */
export interface CornerPiece {
  readonly from: number;
  readonly to: number;
  /** Of each line of the chord in the middle, t from 0 to 1. */
  readonly lines: readonly MotionCertificate[];
}
export interface JudgedCorner {
  /** What is too near in it, whatever curve the controller takes; undefined where nothing is. */
  readonly found: InCorner | undefined;
  /** Nothing is proven of a part of it: as a rule because the arm does not reach it in the posture of the plan. */
  readonly isUnproven: boolean;
  /** The pieces in which it was found clear. */
  readonly clear: readonly Omit<CornerPiece, "lines">[];
}

/** A chord that no other posture it stands for is farther from in any joint is not told apart from them [rad]. */
const FINEST_RAD = 0.0005;
/** Chords of one corner at most; what is left then counts as too near. */
const MOST_CHORDS = 2000;
/** A corner is looked at in no smaller parts for where the arm is out of reach. */
const PARTS = 16;

/**
 * The corners of a plan by the motion behind them. How a controller rounds a corner is its own: no maker promises a
 * curve. What is known is where it begins and ends at most: as far from the point as the program says or as the
 * languages of the robot make of it (`CornerRule`), whichever is farther. Whatever curve it takes in there lies between
 * the two ways and the chord that cuts them off.
 */
export function cornersOf(scene: Pick<CheckScene, "layout" | "robot">): ReadonlyMap<MotionSegment, PassedCorner> {
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
      const before = parts[sweep.move]!;
      found.set(next, {
        before,
        behind: next,
        step: before.step,
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
  scene: Pick<CheckScene, "layout" | "robot">,
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
 * Judges a corner for whatever curve the controller takes in it. Chord by chord, each with room for all that lie
 * between it and those beside it; where that is too much, by halves.
 *
 * @param before @param behind  what is watched at the end of the motion before and at the beginning of the one behind.
 */
export function judgeCorner(
  { sweep }: Pick<PassedCorner, "sweep">,
  prover: Prover,
  before: Stretch | undefined,
  behind: Stretch | undefined,
): JudgedCorner {
  const pairs = pairsInCorner(before, behind);
  const open: [from: number, to: number][] = [[0, 1]];
  let looks = 0;
  let isUnproven = false;
  const clear: Omit<CornerPiece, "lines">[] = [];
  for (let part = open.pop(); part; part = open.pop()) {
    const [from, to] = part;
    const middle = (from + to) / 2;
    const around = chordsAround(sweep, from, to);
    if (around === undefined) {
      if (to - from > 1 / PARTS) open.push([middle, to], [from, middle]);
      else isUnproven = true;
      continue;
    }
    const { chord, slack_rad } = around;
    const contact = onChord(chord, slack_rad, prover, pairs);
    looks++;
    if (contact === undefined) {
      clear.push({ from, to });
      continue;
    }
    const isFinest = Math.max(...slack_rad) <= FINEST_RAD || looks >= MOST_CHORDS;
    if (isFinest && contact === "undecided") isUnproven = true;
    else if (isFinest && contact !== "undecided")
      return { found: { contact, isFreeSharp: isFreeSharp(sweep, prover, pairs) }, isUnproven, clear };
    else open.push([middle, to], [from, middle]);
  }
  return { found: undefined, isUnproven, clear };
}

/** What proves a corner clear that was judged so; undefined where a piece of it does not stand by itself. */
export function certifyCorner(
  { sweep }: Pick<PassedCorner, "sweep">,
  { clear }: JudgedCorner,
  prover: Prover,
  before: Stretch | undefined,
  behind: Stretch | undefined,
): readonly CornerPiece[] | undefined {
  const pairs = pairsInCorner(before, behind);
  const pieces: CornerPiece[] = [];
  for (const { from, to } of clear) {
    const around = chordsAround(sweep, from, to);
    if (around === undefined) return undefined;
    const { chord, slack_rad } = around;
    const lines: MotionCertificate[] = [];
    for (let k = 1; k < chord.length; k++) {
      const { certificate } = prover.certifyLine(chord[k - 1]!, chord[k]!, slack_rad, pairs);
      if (certificate === null) return undefined;
      lines.push(certificate);
    }
    pieces.push({ from, to, lines });
  }
  return pieces;
}

/** The pairs that are watched on both sides of a corner. */
export function pairsInCorner(
  before: Stretch | undefined,
  behind: Stretch | undefined,
): Pick<Stretch, "watched" | "keepsMargin"> {
  const both = [before, behind].filter(each => each !== undefined);
  return {
    watched: pair => both.every(({ watched }) => watched(pair)),
    keepsMargin: pair => both.every(({ keepsMargin }) => keepsMargin(pair)),
  };
}

/**
 * The chord in the middle of a piece, and how far any joint is from it on the others; undefined where the arm is out of
 * reach.
 */
export function chordsAround(
  sweep: CornerSweep,
  from: number,
  to: number,
): { readonly chord: readonly Float64Array[]; readonly slack_rad: Float64Array } | undefined {
  const [first, chord, last] = [sweep.chord(from), sweep.chord((from + to) / 2), sweep.chord(to)];
  if (first === undefined || chord === undefined || last === undefined) return undefined;
  return { chord, slack_rad: spread(chord, first, last) };
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
): Contact | "undecided" | undefined {
  for (let k = 1; k < chord.length; k++) {
    const verdict = prover.proveLine(chord[k - 1]!, chord[k]!, slack_rad, pairs);
    if (verdict.kind === "contact") return verdict;
    if (verdict.kind === "undecided") return "undecided";
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
