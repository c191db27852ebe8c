import { WORLD, type Body } from "./bodies.ts";
import type { CellGeometry, Contact } from "./cell.ts";
import type { CellCollider, SolidPair } from "./cell-collider.ts";
import type { ClearanceMaps } from "./clearance-map.ts";

/** A motion of the joints in time. */
export interface JointMotion {
  /** Writes the joint angles at time t [rad]. */
  readonly sample: (t: number, out: Float64Array) => void;
  /** Bounds on the speed of every joint over the whole interval asked for [rad per unit of t]. */
  readonly maxRate: ArrayLike<number>;
}

export type MotionVerdict =
  /** Proven: at no instant is any watched pair nearer than its margin. */
  | { readonly kind: "clear"; readonly checks: number }
  /** The first instant at which a pair is nearer than its margin, to within the resolution. */
  | {
      readonly kind: "contact";
      readonly at: number;
      readonly a: string;
      readonly b: string;
      readonly between: Contact["between"];
      readonly distance_m: number;
      readonly margin_m: number;
      readonly checks: number;
    }
  /** The limit on checks was used up: proven clear only until `at`. */
  | { readonly kind: "undecided"; readonly at: number; readonly checks: number };

export interface MotionOptions {
  /** Wanted distance [m]; 0 asks for no contact of the true shapes. `marginOf` says what comes on top. */
  readonly margin_m?: number;
  /** Which pairs are looked at; all by default. */
  readonly watched?: (pair: SolidPair) => boolean;
  /** Which pairs keep the margin; the others only must not touch. All pairs by default. */
  readonly keepsMargin?: (pair: SolidPair) => boolean;
  /**
   * How far each joint may be from the motion in either direction [rad]: what is proven clear is then clear for all
   * postures so near to it.
   */
  readonly slack_rad?: ArrayLike<number>;
  /** How near to the margin the answer may be undecided; it then counts as contact [m]. */
  readonly resolution_m?: number;
  readonly maxChecks?: number;
  /**
   * Receives what was proven, piece by piece; with the verdict "clear" it is the certificate (see `certificate.ts`).
   */
  readonly proof?: CertifiedPiece[];
  /**
   * What is known of this collider from before; asked first, unless a proof is wanted: that one must stand by itself.
   */
  readonly maps?: ClearanceMaps;
}

/** A pair and a stretch of the motion during which it is proven to be more than `atLeast_m` apart [m]. */
export interface CertifiedPiece {
  readonly a: string;
  readonly b: string;
  readonly from: number;
  readonly to: number;
  readonly atLeast_m: number;
}

/**
 * Whether a whole motion keeps its distance: not only at samples, but between them.
 *
 * While t moves by Δ, no point of a pair moves relative to the other by more than  Σ_k rate_k Δ ρ_k  over the joints k
 * between them, where ρ_k bounds the distance from axis k. A pair farther apart than that at the middle of an interval
 * keeps its margin throughout it (each point measured by its own ρ: what is near an axis hardly moves); otherwise the
 * interval is halved, the earlier half first. A thin obstacle cannot be stepped over.
 *
 * @see Schwarzer, Saha, Latombe, Exact collision checking of robot paths, WAFR 2002.
 */
export function checkMotion(
  collider: CellCollider,
  motion: JointMotion,
  from: number,
  to: number,
  options: MotionOptions = {},
): MotionVerdict {
  const {
    margin_m = 0,
    resolution_m = 0.0002,
    maxChecks = 100_000,
    keepsMargin = () => true,
    watched = () => true,
    proof,
  } = options;
  const maps = proof === undefined ? options.maps : undefined;
  const pairs = collider.pairs;
  const rates = pairs.map(pair => relativeRate(pair, motion.maxRate));
  const turns = pairs.map(pair => relativeTurn(pair, motion.maxRate));
  const { slack_rad } = options;
  const margins = pairs.map(
    pair =>
      (keepsMargin(pair) ? marginOf(pair, margin_m, collider) : 0) +
      (slack_rad === undefined ? 0 : slackOf(pair, slack_rad)),
  );
  const q = new Float64Array(motion.maxRate.length);
  const stack: Interval[] = [{ from, to, open: pairs.map((_, i) => i).filter(i => watched(pairs[i]!)) }];
  let checks = 0;
  for (let interval = stack.pop(); interval; interval = stack.pop()) {
    if (checks >= maxChecks) return { kind: "undecided", at: interval.from, checks };
    const middle = (interval.from + interval.to) / 2;
    const half = (interval.to - interval.from) / 2;
    const open: number[] = [];
    let blocked = false;
    motion.sample(middle, q);
    collider.place(q);
    checks++;
    for (const i of interval.open) {
      const pair = pairs[i]!;
      const margin = margins[i]!;
      const drift = rates[i]! * half;
      if (maps?.provenAround(pair, margin, q, motion.maxRate, half) === true) continue;
      if (collider.keepsApart(pair, margin + drift - turns[i]! * half * radiusOf(pair), turns[i]! * half)) {
        proof?.push({
          a: pair.contact.a,
          b: pair.contact.b,
          from: interval.from,
          to: interval.to,
          atLeast_m: provenAt(collider, pair, margin, drift),
        });
        continue;
      }
      if (drift <= resolution_m) {
        const distance_m = collider.distanceOf(pair, margin + resolution_m);
        return { kind: "contact", at: middle, ...pair.contact, distance_m, margin_m: margin, checks };
      }
      if (!blocked && collider.touchOf(pair)) blocked = true;
      open.push(i);
    }
    if (open.length === 0) continue;
    // After a contact in the middle nothing later can be the first one.
    if (blocked) stack.length = 0;
    else stack.push({ from: middle, to: interval.to, open });
    stack.push({ from: interval.from, to: middle, open });
  }
  return { kind: "clear", checks };
}

/** Distances farther beyond the margin than this are not measured for a certificate [m]. */
const PLENTY_M = 0.1;

/**
 * Half of what is left above the margin after the drift is claimed, so that whoever proves it again has room for a
 * coarser bound.
 */
function provenAt(collider: CellCollider, pair: SolidPair, margin_m: number, drift_m: number): number {
  const distance_m = Math.min(collider.distanceOf(pair, margin_m + drift_m + PLENTY_M), margin_m + drift_m + PLENTY_M);
  return margin_m + Math.max(0, distance_m - drift_m - margin_m) / 2;
}

interface Interval {
  readonly from: number;
  readonly to: number;
  readonly open: readonly number[];
}

/** The straight line in joint space from one posture to the other, t from 0 to 1. */
export function checkJointLine(
  collider: CellCollider,
  fromQ: ArrayLike<number>,
  toQ: ArrayLike<number>,
  options: MotionOptions = {},
): MotionVerdict {
  return checkMotion(collider, jointLine(fromQ, toQ), 0, 1, options);
}

export const jointLine = (fromQ: ArrayLike<number>, toQ: ArrayLike<number>): JointMotion => ({
  maxRate: Float64Array.from(fromQ, (q, i) => Math.abs(toQ[i]! - q)),
  sample: (t, out) => {
    for (let i = 0; i < out.length; i++) out[i] = fromQ[i]! + t * (toQ[i]! - fromQ[i]!);
  },
});

const outerOf = ({ a, b }: SolidPair): Body => (a.carrier > b.carrier ? a : b);
const radiusOf = (pair: SolidPair): number => outerOf(pair).solid.radius_m;
/** The joints between the two solids of a pair, from the first that moves one of them seen from the other. */
const firstBetween = ({ a, b }: SolidPair): number => Math.max(0, Math.min(a.carrier, b.carrier));

/** Bound on the speed of any point of the outer solid seen from the other [m per unit of t]. */
function relativeRate(pair: SolidPair, maxRate: ArrayLike<number>): number {
  const outer = outerOf(pair);
  let rate = 0;
  for (let k = firstBetween(pair); k < outer.carrier; k++) rate += maxRate[k]! * outer.reach_m[k]!;
  return rate;
}

/** How much nearer a pair may be where every joint is off by at most so much [m]. */
export const slackOf = (pair: SolidPair, slack_rad: ArrayLike<number>): number => relativeRate(pair, slack_rad);

/**
 * Bound on how fast the outer solid turns seen from the other [rad per unit of t]: a point r from its origin is Σ rate
 * (R − r) slower.
 */
function relativeTurn(pair: SolidPair, maxRate: ArrayLike<number>): number {
  let turn = 0;
  for (let k = firstBetween(pair); k < outerOf(pair).carrier; k++) turn += maxRate[k]!;
  return turn;
}

/** What a cell is not known better than; see `CellGeometry`. */
export type CellErrors = Pick<CellGeometry, "shapeError_m" | "placeError_m">;

/**
 * Two parts of a robot keep at least this [m], where its design leaves it: a robot follows its path to a few
 * millimetres, and a guard sees it now and then.
 */
export const OWN_KEPT_M = 0.005;

/**
 * Distance a pair must keep when `margin_m` is wanted [m]: the margin; between a link and an object, held or standing,
 * the shape error of the robot once, because only the link is drawn from fitted shapes; and between what the arm moves
 * and an object that stands, how far the robot may be from where it is drawn (row T-64).
 *
 * Two parts of the robot keep the margin and never less than `OWN_KEPT_M`, but no more than half of what they have
 * where the robot is known to be free (`allowContactsAt`). They get no shape error: twice the error (40 mm on many
 * arms) is more than the maker leaves between links that fold past each other, so it would stop postures that every
 * arm takes daily; and where drawn links do come close, it is the maker's joint limits and `allowContactsAt` that
 * speak for the true castings. Tools are drawn as they are.
 */
export function marginOf(
  { a, b, contact, room_m }: SolidPair,
  margin_m: number,
  { shapeError_m, placeError_m }: CellErrors,
): number {
  if (contact.between === "self" && room_m !== undefined) return Math.min(Math.max(margin_m, OWN_KEPT_M), room_m);
  const drawnAndExact = (a.kind === "link" && b.kind === "object") || (b.kind === "link" && a.kind === "object");
  const movedAndStanding =
    (a.carrier === WORLD && a.kind === "object") !== (b.carrier === WORLD && b.kind === "object");
  return Math.max(0, margin_m) + (drawnAndExact ? shapeError_m : 0) + (movedAndStanding ? (placeError_m ?? 0) : 0);
}
