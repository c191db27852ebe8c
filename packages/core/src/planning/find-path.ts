import type { Contact } from "../collision/cell.ts";
import { seededRandom, type Random } from "../random.ts";
import { shorten } from "./shorten.ts";
import { ConfigurationTree } from "./tree.ts";
import { alongLine, distanceBetween, type PathValidator } from "./path-validator.ts";

export interface PathOptions {
  /** The same seed, cell and ends give the same way. */
  readonly seed?: number;
  /** Postures looked at before it gives up. */
  readonly maxLooks?: number;
  /** A clock and how long it may take [s]; without them only `maxLooks` ends the search. */
  readonly now_s?: () => number;
  readonly within_s?: number;
  /** Called with 0 … 1, the part of the limit that is used up. */
  readonly onProgress?: (share: number) => void;
  readonly cancelled?: () => boolean;
}

export type PathOutcome =
  /**
   * Postures from start to goal; every straight line between two of them is proven free over its whole length.
   * `length_rad` is the sum of their lengths √Σ Δq².
   */
  | {
      readonly kind: "found";
      readonly way: readonly Float64Array[];
      readonly length_rad: number;
      readonly looks: number;
    }
  /** An end is not free, or not within the joint limits: no search was made. */
  | { readonly kind: "blocked"; readonly end: "start" | "goal"; readonly contact: Contact }
  | {
      readonly kind: "outside-limits";
      readonly end: "start" | "goal";
      readonly joint: number;
      readonly wanted_rad: number;
      readonly limit_rad: number;
    }
  /** Nothing was found within the limit; `within_s` is there when it was the clock. */
  | { readonly kind: "not-found"; readonly looks: number; readonly within_s?: number }
  | { readonly kind: "cancelled"; readonly looks: number };

/** Samples along a line while searching [rad]; the proof that follows leaves nothing between them. */
const STEP_RAD = 0.17;
/** How far a tree grows at a time [rad]. */
const REACH_RAD = 1.2;
const MOST_LOOKS = 60_000;
const ASK_EVERY = 64;
/**
 * Where a proof fails the samples of the next try stand twice as dense, so many times; then lines are proven before
 * they are taken.
 */
const MOST_TRIES = 3;
/** A goal that is within this of a limit counts as on it [rad]. */
const ON_LIMIT_RAD = 1e-9;

/**
 * A way from one posture to another that touches nothing: straight where that is free, else by two trees that grow
 * towards each other from both ends, then shortened. Whatever is returned has been proven along its whole length with
 * `checkMotion`, so that no obstacle is too thin to be seen.
 *
 * @see Kuffner, LaValle, RRT-Connect: an efficient approach to single-query path planning, ICRA 2000.
 * @see Geraerts, Overmars, Creating high-quality paths for motion planning, IJRR 2007, for shortening.
 */
export function findPath(
  checker: PathValidator,
  from: ArrayLike<number>,
  to: ArrayLike<number>,
  options: PathOptions = {},
): PathOutcome {
  const joints = checker.arm.joints;
  const start = Float64Array.from(from);
  const goal = Float64Array.from(to);
  const began = checker.looks;
  for (const [end, q] of [
    ["start", start],
    ["goal", goal],
  ] as const) {
    const k = joints.findIndex(
      ({ limits }, i) => !(q[i]! >= limits.lower_rad - ON_LIMIT_RAD && q[i]! <= limits.upper_rad + ON_LIMIT_RAD),
    );
    if (k >= 0)
      return {
        kind: "outside-limits",
        end,
        joint: k + 1,
        wanted_rad: q[k]!,
        limit_rad: q[k]! > joints[k]!.limits.upper_rad ? joints[k]!.limits.upper_rad : joints[k]!.limits.lower_rad,
      };
    const contact = checker.inTheWay(q);
    if (contact !== null) return { kind: "blocked", end, contact };
  }
  const budget = new Budget(checker, options);
  const random = seededRandom(options.seed ?? 1);
  const found = (way: readonly Float64Array[]): PathOutcome => ({
    kind: "found",
    way,
    length_rad: lengthOf(way),
    looks: checker.looks - began,
  });
  for (let attempt = 0; attempt <= MOST_TRIES; attempt++) {
    const step_rad = STEP_RAD / 2 ** attempt;
    const proven = attempt === MOST_TRIES;
    const lineFree = (a: ArrayLike<number>, b: ArrayLike<number>): boolean =>
      checker.sampled(a, b, step_rad) && (!proven || checker.prove(a, b).kind === "clear");
    if (lineFree(start, goal) && (proven || checker.prove(start, goal).kind === "clear")) return found([start, goal]);
    const rough = grow(start, goal, lineFree, checker, random, budget);
    if (rough === null) return budget.outcome(checker.looks - began);
    const way = shorten(rough, lineFree, random);
    if (everyLineProven(checker, way)) return found(way);
    // Shortening may have led a way through something thin that the longer one avoids.
    if (everyLineProven(checker, rough)) return found(rough);
  }
  return budget.outcome(checker.looks - began);
}

export const lengthOf = (way: readonly ArrayLike<number>[]): number =>
  way.slice(1).reduce((sum, q, i) => sum + distanceBetween(way[i]!, q), 0);

const everyLineProven = (checker: PathValidator, way: readonly Float64Array[]): boolean =>
  way.slice(1).every((q, i) => checker.prove(way[i]!, q).kind === "clear");

type LineFree = (a: ArrayLike<number>, b: ArrayLike<number>) => boolean;

/**
 * Two trees that grow by turns, each new posture of the one being what the other reaches for. Null when the budget is
 * used up.
 */
function grow(
  start: Float64Array,
  goal: Float64Array,
  lineFree: LineFree,
  checker: PathValidator,
  random: Random,
  budget: Budget,
): Float64Array[] | null {
  const joints = checker.arm.joints;
  const n = start.length;
  const drawn = new Float64Array(n);
  const next = new Float64Array(n);
  const reached = new Float64Array(n);
  let grows = new ConfigurationTree(n).reset(start);
  let other = new ConfigurationTree(n).reset(goal);
  let fromStart = true;
  while (!budget.spent()) {
    for (let k = 0; k < n; k++)
      drawn[k] = joints[k]!.limits.lower_rad + random() * (joints[k]!.limits.upper_rad - joints[k]!.limits.lower_rad);
    const added = extend(grows, drawn, next, lineFree, checker);
    if (added >= 0) {
      reached.set(grows.at(added));
      let last = other.nearest(reached);
      let towards = -1;
      for (;;) {
        towards = extendFrom(other, last, reached, next, lineFree, checker);
        if (towards < 0 || distanceBetween(other.at(towards), reached) === 0 || budget.spent()) break;
        last = towards;
      }
      if (towards >= 0 && distanceBetween(other.at(towards), reached) === 0) {
        const [head, tail] = fromStart
          ? [grows.wayToRoot(added), other.wayToRoot(towards)]
          : [other.wayToRoot(towards), grows.wayToRoot(added)];
        return [...head.reverse(), ...tail.slice(1)];
      }
    }
    // The smaller tree grows next: what stands in a narrow place gets its turns.
    if (grows.size > other.size) {
      [grows, other] = [other, grows];
      fromStart = !fromStart;
    }
  }
  return null;
}

const extend = (
  tree: ConfigurationTree,
  to: Float64Array,
  next: Float64Array,
  lineFree: LineFree,
  checker: PathValidator,
): number => extendFrom(tree, tree.nearest(to), to, next, lineFree, checker);

/** Adds the posture one reach from node `from` towards `to`, or `to` itself; −1 when the line there is not free. */
function extendFrom(
  tree: ConfigurationTree,
  from: number,
  to: Float64Array,
  next: Float64Array,
  lineFree: LineFree,
  checker: PathValidator,
): number {
  const here = tree.at(from);
  const far_rad = distanceBetween(here, to);
  if (far_rad > REACH_RAD) alongLine(here, to, REACH_RAD / far_rad, next);
  else next.set(to);
  return checker.free(next) && lineFree(here, next) ? tree.add(next, from) : -1;
}

class Budget {
  readonly #checker: PathValidator;
  readonly #options: PathOptions;
  readonly #from: number;
  readonly #began_s: number;
  readonly #most: number;
  #asked = 0;
  #cancelled = false;
  #late = false;

  constructor(checker: PathValidator, options: PathOptions) {
    this.#checker = checker;
    this.#options = options;
    this.#from = checker.looks;
    this.#began_s = options.now_s?.() ?? 0;
    this.#most = options.maxLooks ?? MOST_LOOKS;
  }

  spent(): boolean {
    const used = this.#checker.looks - this.#from;
    const { now_s, within_s, onProgress, cancelled } = this.#options;
    if (this.#asked === 0 || used - this.#asked >= ASK_EVERY) {
      this.#asked = Math.max(1, used);
      const passed_s = (now_s?.() ?? 0) - this.#began_s;
      onProgress?.(Math.min(1, Math.max(used / this.#most, within_s === undefined ? 0 : passed_s / within_s)));
      this.#cancelled = cancelled?.() === true;
      this.#late = within_s !== undefined && passed_s > within_s;
    }
    return this.#cancelled || this.#late || used >= this.#most;
  }

  outcome(looks: number): PathOutcome {
    if (this.#cancelled) return { kind: "cancelled", looks };
    return {
      kind: "not-found",
      looks,
      ...(this.#late && this.#options.within_s !== undefined ? { within_s: this.#options.within_s } : {}),
    };
  }
}
