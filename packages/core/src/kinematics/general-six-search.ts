import type { GeneralSixGeometry } from "../model/robot.ts";
import type { Pose } from "../spatial/pose.ts";
import {
  complete,
  CONDITION,
  evaluate,
  MARGIN,
  THETA1,
  THETA6,
  wantWrist,
  type GeneralSixScratch,
} from "./general-six.ts";

/**
 * Slots of the answer: at most 16 postures exist; some are found twice, where two stretches meet, and the caller sorts
 * them out.
 */
export const MAX_GENERAL_SIX = 32;

/**
 * Samples of θ6 around its circle to see where the arm reaches, and along each stretch to see where the condition
 * changes its sign.
 */
const CIRCLE = 64;
const ALONG = 64;
/** A step in which the condition, or θ1, changes by more than this is halved. */
const LARGEST_CHANGE = 0.25;
const LARGEST_TURN_RAD = 0.4;
const MOST_HALVINGS = 14;
/** A least |condition| below this may be two roots all but fallen together: refinement decides. */
const TOUCHING = 1e-5;
const BESIDE = 1e-3;
/** How far apart two values give a slope; only its sign is asked for. */
const SLOPE_STEP = 1e-6;
/** How near the border of the reach a border between two samples is looked for [m²]. */
const NEAR_BORDER_M2 = 0.02;
const GOLDEN = 0.3819660112501051;
const GOLDEN_STEPS = 36;
const BISECTIONS = 52;
const TURN = 2 * Math.PI;

/**
 * All postures of a six-joint arm without spherical wrist.
 *
 * With θ6 given the arm is closed form in four ways (shoulder, elbow), and one condition is left: the angle between
 * axes 4 and 5 is as built. The circle of θ6 is cut into the stretches in which the arm reaches; in each the condition
 * is sampled with
 *
 *   θ6 = middle − half · cos τ
 *
 * which makes it smooth up to the border, where two of the four ways meet. Changes of sign are bisected; between
 * samples the condition's least magnitude is looked for, so that two near roots, and two fallen together, are not
 * passed over.
 *
 * @param out  receives up to `MAX_GENERAL_SIX` candidates of six angles [rad], the robot's own zero and sign, in (−π,
 *   π]: good to
 *             about 1e-9 (1e-5 where two fall together) and to be refined, verified and told apart by the caller.
 * @returns number of candidates. Limits are not looked at.
 */
export function solveGeneralSix(
  geometry: GeneralSixGeometry,
  baseFromFlange: Pose,
  out: Float64Array,
  scratch: GeneralSixScratch,
): number {
  wantWrist(geometry, baseFromFlange, scratch);
  const search: Search = { geometry, scratch, out, count: 0, shoulder: 1, elbow: 1, middle: 0, half: 0 };
  for (let shoulder = 1; shoulder >= -1; shoulder -= 2) {
    search.shoulder = shoulder;
    const stretches = findStretches(search);
    for (let elbow = 1; elbow >= -1; elbow -= 2) {
      search.elbow = elbow;
      for (let s = 0; s < stretches; s++) {
        const start = scratch.stretches[2 * s]!;
        const end = scratch.stretches[2 * s + 1]!;
        const whole = end - start >= TURN;
        search.middle = whole ? start : 0.5 * (start + end);
        search.half = whole ? 0 : 0.5 * (end - start);
        followStretch(search);
      }
    }
  }
  return search.count;
}

interface Search {
  readonly geometry: GeneralSixGeometry;
  readonly scratch: GeneralSixScratch;
  readonly out: Float64Array;
  count: number;
  shoulder: number;
  elbow: number;
  /** Of the stretch being followed; half = 0 when it is the whole circle. */
  middle: number;
  half: number;
}

/** The condition at τ of the present stretch. */
function conditionAt(search: Search, tau: number): number {
  const at = search.scratch.at;
  at[THETA6] = search.half === 0 ? search.middle + tau : search.middle - search.half * Math.cos(tau);
  evaluate(search.geometry, search.shoulder, search.elbow, search.scratch);
  return at[CONDITION]!;
}

function marginAt(search: Search, theta6: number): number {
  search.scratch.at[THETA6] = theta6;
  evaluate(search.geometry, search.shoulder, 1, search.scratch);
  return search.scratch.at[MARGIN]!;
}

/** Start and end by turns of the stretches of θ6 within reach go to the scratch; their number is returned. */
function findStretches(search: Search): number {
  const { stretches, samples } = search.scratch;
  const step = TURN / CIRCLE;
  let inside = 0;
  for (let i = 0; i < CIRCLE; i++) {
    samples[i] = marginAt(search, i * step);
    if (samples[i]! > 0) inside++;
  }
  const marks = sliversBetween(search, step);
  if (inside === CIRCLE && marks.length === 0) {
    stretches[0] = 0;
    stretches[1] = TURN;
    return 1;
  }
  const points = [
    ...Array.from({ length: CIRCLE }, (_, i) => i * step),
    ...marks.map(mark => ((mark % TURN) + TURN) % TURN),
  ].sort((a, b) => a - b);
  points.push(points[0]! + TURN);
  const borders = bordersBetween(search, points);
  const count = Math.min(borders.length, stretches.length) >> 1;
  for (let i = 0; i < 2 * count; i++) stretches[i] = borders[i]!;
  return count;
}

/** Where between two samples the arm reaches, or does not, unlike at both: an extreme value of the margin shows it. */
function sliversBetween(search: Search, step: number): number[] {
  const samples = search.scratch.samples;
  const marks: number[] = [];
  for (let i = 0; i < CIRCLE; i++) {
    const before = samples[(i + CIRCLE - 1) % CIRCLE]!;
    const here = samples[i]!;
    const after = samples[(i + 1) % CIRCLE]!;
    if (
      Math.abs(here) < NEAR_BORDER_M2 &&
      (here > 0 ? before >= here && after >= here : before <= here && after <= here)
    ) {
      const extreme = leastOf(theta => (here > 0 ? 1 : -1) * marginAt(search, theta), (i - 1) * step, (i + 1) * step);
      if (marginAt(search, extreme) > 0 !== here > 0) marks.push(extreme);
    }
  }
  return marks;
}

/** The borders of the reach between neighbouring points, in order around the circle, beginning with a start. */
function bordersBetween(search: Search, points: readonly number[]): number[] {
  const found: number[] = [];
  let endsFirst = false;
  for (let i = 0; i + 1 < points.length; i++) {
    const from = marginAt(search, points[i]!) > 0;
    if (from === marginAt(search, points[i + 1]!) > 0) continue;
    let low = points[i]!;
    let high = points[i + 1]!;
    for (let k = 0; k < BISECTIONS; k++) {
      const middle = 0.5 * (low + high);
      if (marginAt(search, middle) > 0 === from) low = middle;
      else high = middle;
    }
    if (found.length === 0) endsFirst = from;
    // The side within reach of the two.
    found.push(from ? low : high);
  }
  // An end first means that the first stretch began before 0.
  if (endsFirst) {
    const end = found.shift();
    if (end !== undefined) found.push(end + TURN);
  }
  return found;
}

interface Sample {
  readonly tau: number;
  readonly value: number;
  readonly slope: number;
  readonly theta1: number;
}

function sampleAt(search: Search, tau: number): Sample {
  // Beyond the end of a stretch the way continues with the other elbow: the slope is taken from inside.
  const value = conditionAt(search, tau);
  const theta1 = search.scratch.at[THETA1]!;
  const step = search.half > 0 && tau > 1 ? -SLOPE_STEP : SLOPE_STEP;
  return { tau, value, slope: (conditionAt(search, tau + step) - value) / step, theta1 };
}

/** Samples the stretch, halving steps where much happens, and puts every root into `out`. */
function followStretch(search: Search): void {
  const step = (search.half === 0 ? TURN : Math.PI) / ALONG;
  let before = sampleAt(search, 0);
  for (let i = 1; i <= ALONG; i++) {
    const after = sampleAt(search, i * step);
    between(search, before, after, 0);
    before = after;
  }
}

/** All roots between two samples. */
function between(search: Search, a: Sample, b: Sample, depth: number): void {
  const turned = Math.abs(a.theta1 - b.theta1);
  const turn = Math.min(turned, TURN - turned);
  if (depth < MOST_HALVINGS && (Math.abs(a.value - b.value) > LARGEST_CHANGE || turn > LARGEST_TURN_RAD)) {
    const middle = sampleAt(search, 0.5 * (a.tau + b.tau));
    between(search, a, middle, depth + 1);
    between(search, middle, b, depth + 1);
    return;
  }
  if (a.value > 0 !== b.value > 0) {
    addRoots(search, a.tau, b.tau, a.value);
    return;
  }
  // Towards 0 at the one end and away from it at the other: a valley of |condition| lies between.
  const sign = a.value > 0 ? 1 : -1;
  if (sign * a.slope > 0 || sign * b.slope < 0) {
    if (Math.min(Math.abs(a.value), Math.abs(b.value)) < TOUCHING)
      addTouching(search, Math.abs(a.value) < Math.abs(b.value) ? a.tau : b.tau);
    return;
  }
  const lowest = leastOf(tau => sign * conditionAt(search, tau), a.tau, b.tau);
  const value = conditionAt(search, lowest);
  if (value > 0 !== a.value > 0) {
    addRoots(search, a.tau, lowest, a.value);
    addRoots(search, lowest, b.tau, value);
  } else if (Math.abs(value) < TOUCHING) addTouching(search, lowest);
}

/** Where a function with one valley is least, or the first place seen where it is below 0: golden section. */
function leastOf(value: (x: number) => number, low: number, high: number): number {
  let a = low;
  let b = high;
  let x = a + GOLDEN * (b - a);
  let y = b - GOLDEN * (b - a);
  let fx = value(x);
  let fy = value(y);
  for (let k = 0; k < GOLDEN_STEPS; k++) {
    if (fx < 0) return x;
    if (fy < 0) return y;
    if (fx < fy) {
      b = y;
      y = x;
      fy = fx;
      x = a + GOLDEN * (b - a);
      fx = value(x);
    } else {
      a = x;
      x = y;
      fx = fy;
      y = b - GOLDEN * (b - a);
      fy = value(y);
    }
  }
  return 0.5 * (a + b);
}

/**
 * Bisects a change of sign; then looks whether the condition without that root has two more between the same samples.
 */
function addRoots(search: Search, from: number, to: number, valueFrom: number): void {
  const root = bisect(tau => conditionAt(search, tau), from, to, valueFrom);
  add(search, root);
  const sign = valueFrom > 0 ? 1 : -1;
  const width = to - from;
  const without = (tau: number): number => (sign * conditionAt(search, tau) * width) / (root - tau);
  // Beside the root itself the quotient is its slope, and lost in rounding.
  const near = 1e-7 * width;
  const quotient = (tau: number): number =>
    without(Math.abs(tau - root) < near ? (tau < root ? root - near : root + near) : tau);
  const ends = Math.min(quotient(from), quotient(to));
  let least = ends;
  let at = from;
  for (let k = 1; k < 4; k++) {
    const tau = from + 0.25 * k * width;
    const value = quotient(tau);
    if (value < least) {
      least = value;
      at = tau;
    }
  }
  if (least >= ends) return;
  const lowest = leastOf(quotient, at - 0.25 * width, at + 0.25 * width);
  if (quotient(lowest) >= 0) return;
  add(search, bisect(quotient, from, lowest, 1));
  add(search, bisect(quotient, lowest, to, -1));
}

function bisect(value: (tau: number) => number, from: number, to: number, valueFrom: number): number {
  let low = from;
  let high = to;
  for (let k = 0; k < BISECTIONS; k++) {
    const middle = 0.5 * (low + high);
    if (value(middle) > 0 === valueFrom > 0) low = middle;
    else high = middle;
  }
  return 0.5 * (low + high);
}

/** One root or two: refinement falls to either side from beside the least value. */
function addTouching(search: Search, tau: number): void {
  for (let side = -1; side <= 1; side++) add(search, tau + side * BESIDE);
}

function add(search: Search, tau: number): void {
  if (search.count >= MAX_GENERAL_SIX) return;
  conditionAt(search, tau);
  complete(search.geometry, search.scratch, search.out, 6 * search.count);
  search.count++;
}
