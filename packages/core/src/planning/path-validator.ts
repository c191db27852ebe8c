import type { CellCollider, SolidPair } from "../collision/cell-collider.ts";
import { ClearanceMaps } from "../collision/clearance-map.ts";
import type { Contact } from "../collision/cell.ts";
import { checkMotion, jointLine, marginOf, type MotionVerdict } from "../collision/motion.ts";
import type { SerialArm } from "../model/arm.ts";

export interface PathRules {
  /** Distance to keep [m], with the robot's shape error on top as `marginOf` says; 0 asks for no contact only. */
  readonly margin_m?: number;
  /** Which pairs keep the margin; the others only must not touch. All pairs by default. */
  readonly keepsMargin?: (pair: SolidPair) => boolean;
  /** Asked of a pair that is too near in the posture last placed: whether it may be so. Not asked by `prove`. */
  readonly excused?: (pair: SolidPair) => boolean;
}

/** By so much a pair may come nearer on a way along what is too near already [m]. */
const SLIDE_M = 1e-4;

/**
 * Says of postures and of straight lines in joint space whether they are free. It remembers what it proved, so one is
 * kept for as long as its cell stays as it is; it sees when objects of its collider move. One a worker, as the collider
 * is.
 */
export class PathValidator {
  readonly collider: CellCollider;
  readonly arm: SerialArm;
  readonly #rules: Required<PathRules>;
  readonly #maps: ClearanceMaps;
  readonly #q: Float64Array;
  #pairs: SolidPair[] = [];
  #margins: number[] = [];
  #edition = -1;
  /** Postures looked at since it was made. */
  looks = 0;

  constructor(collider: CellCollider, arm: SerialArm, rules: PathRules = {}) {
    this.collider = collider;
    this.arm = arm;
    this.#rules = {
      margin_m: rules.margin_m ?? 0,
      keepsMargin: rules.keepsMargin ?? (() => true),
      excused: rules.excused ?? (() => false),
    };
    this.#maps = new ClearanceMaps(collider, arm);
    this.#q = new Float64Array(arm.joints.length);
  }

  /** Whether every watched pair keeps its margin at q. The pair that was in the way last is asked first. */
  free(q: ArrayLike<number>): boolean {
    return this.inTheWay(q) === null;
  }

  /** The first pair found too near at q; null where q is free. */
  inTheWay(q: ArrayLike<number>): Contact | null {
    this.#refresh();
    this.looks++;
    const { collider } = this;
    const pairs = this.#pairs;
    const margins = this.#margins;
    collider.place(q);
    for (let i = 0; i < pairs.length; i++) {
      const pair = pairs[i]!;
      const margin = margins[i]!;
      if (this.#maps.provenAround(pair, margin, q, null, 0)) continue;
      if (margin > 0 ? collider.distanceOf(pair, margin, margin) >= margin : !collider.touchOf(pair)) continue;
      if (this.#rules.excused(pair)) continue;
      pairs.splice(i, 1);
      pairs.unshift(pair);
      margins.splice(i, 1);
      margins.unshift(margin);
      return pair.contact;
    }
    return null;
  }

  /**
   * From a posture in which pairs are nearer than their margin: how many postures of a way, from its beginning, lead
   * out of that or along it. Every such pair keeps the distance that it had at `from` (from a contact the distance must
   * grow with each posture) and no other pair comes too near. Ends with the first posture that is free. 0 where `from`
   * is free already, or the first posture goes deeper. Looks at the postures one by one; proves nothing.
   */
  wayOut(from: ArrayLike<number>, way: readonly ArrayLike<number>[]): number {
    if (this.free(from)) return 0;
    this.collider.place(from);
    const near = this.#pairs.map((pair, i) => (this.#rules.excused(pair) ? Infinity : this.#distanceAt(i)));
    const least = near.slice();
    for (const [count, q] of way.entries()) {
      this.collider.place(q);
      let outside = true;
      for (let i = 0; i < near.length; i++) {
        if (this.#rules.excused(this.#pairs[i]!)) continue;
        const distance_m = this.#distanceAt(i);
        if (distance_m === Infinity) continue;
        outside = false;
        const leaves = near[i] === 0 ? distance_m > least[i]! : distance_m >= near[i]! - SLIDE_M;
        if (!leaves) return count;
        least[i] = distance_m;
      }
      if (outside) return count + 1;
    }
    return way.length;
  }

  /** Distance of a pair in the posture last placed, where it is below its margin; Infinity where it is not. */
  #distanceAt(index: number): number {
    const pair = this.#pairs[index]!;
    const margin = this.#margins[index]!;
    if (margin === 0) return this.collider.touchOf(pair) ? 0 : Infinity;
    return this.collider.distanceOf(pair, margin);
  }

  /**
   * Whether samples no farther apart than `step_rad` along the straight line are free, the ends taken as known. The
   * middle comes first, then the quarters: a line through something is found out early. Proves nothing; `prove` does.
   */
  sampled(from: ArrayLike<number>, to: ArrayLike<number>, step_rad: number): boolean {
    const parts = 2 ** Math.max(0, Math.ceil(Math.log2(distanceBetween(from, to) / step_rad)));
    for (let stride = parts; stride > 1; stride /= 2) {
      for (let i = stride / 2; i < parts; i += stride)
        if (!this.free(alongLine(from, to, i / parts, this.#q))) return false;
    }
    return true;
  }

  /** The verdict on the whole straight line, between all samples as well: t from 0 to 1. */
  prove(from: ArrayLike<number>, to: ArrayLike<number>, maxChecks = 4000): MotionVerdict {
    const { margin_m, keepsMargin } = this.#rules;
    return checkMotion(this.collider, jointLine(from, to), 0, 1, {
      margin_m,
      keepsMargin,
      maxChecks,
      resolution_m: Math.min(0.0002, Math.max(margin_m / 10, 0.00005)),
      maps: this.#maps,
    });
  }

  #refresh(): void {
    if (this.#edition === this.collider.edition) return;
    this.#edition = this.collider.edition;
    this.#pairs = [...this.collider.pairs];
    this.#margins = this.#pairs.map(pair =>
      this.#rules.keepsMargin(pair) ? marginOf(pair, this.#rules.margin_m, this.collider) : 0,
    );
  }
}

/** Length of the straight line in joint space, √Σ Δq² [rad]; a slide counts its metres as radians. */
export function distanceBetween(a: ArrayLike<number>, b: ArrayLike<number>): number {
  let sum = 0;
  for (let i = 0; i < a.length; i++) {
    const d = b[i]! - a[i]!;
    sum += d * d;
  }
  return Math.sqrt(sum);
}

/** a + t (b − a). `out` may be either input. */
export function alongLine<Out extends Float64Array>(
  a: ArrayLike<number>,
  b: ArrayLike<number>,
  t: number,
  out: Out,
): Out {
  for (let i = 0; i < out.length; i++) out[i] = a[i]! + t * (b[i]! - a[i]!);
  return out;
}
