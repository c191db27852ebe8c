import type { SerialArm } from "../model/arm.ts";
import { isSlide, slideOf } from "../model/slide.ts";
import { norm } from "../spatial/vector.ts";
import type { CellCollider, SolidPair } from "./cell-collider.ts";
import {
  checkMotion,
  type CertifiedPiece,
  type JointMotion,
  type MotionOptions,
  type MotionVerdict,
} from "./motion.ts";

/**
 * What proves a motion clear: for every watched pair, pieces that cover the whole of it. Plain data, can be kept with a
 * program.
 */
export interface MotionCertificate {
  readonly from: number;
  readonly to: number;
  /** The least of what is proven of any piece [m]. */
  readonly clearance_m: number;
  readonly pieces: readonly CertifiedPiece[];
}

export type CertificateVerdict =
  | { readonly kind: "confirmed"; readonly looks: number }
  /** Why it proves nothing, and for which pair from where on. */
  | {
      readonly kind: "refuted";
      readonly reason: "gap" | "too near" | "unproven" | "too fast";
      readonly a: string;
      readonly b: string;
      readonly at: number;
    };

/** `checkMotion`, and with the verdict "clear" its certificate; null without. */
export function certifyMotion(
  collider: CellCollider,
  motion: JointMotion,
  from: number,
  to: number,
  options: MotionOptions = {},
): { readonly verdict: MotionVerdict; readonly certificate: MotionCertificate | null } {
  const pieces: CertifiedPiece[] = [];
  const verdict = checkMotion(collider, motion, from, to, { ...options, proof: pieces });
  if (verdict.kind !== "clear") return { verdict, certificate: null };
  return {
    verdict,
    certificate: {
      from,
      to,
      clearance_m: pieces.reduce((least, { atLeast_m }) => Math.min(least, atLeast_m), Infinity),
      pieces,
    },
  };
}

/** A stretch this many times halved is given up. */
const MOST_HALVINGS = 30;
const ROUNDING_M = 1e-9;

/**
 * Proves a certificate again by other means than it was made: distances by the search for the nearest triangles, and
 * how far a solid can move from the plain sum of lengths along the arm:
 *
 *   |Δp| ≤ Σ_k rate_k |Δt| (|p_{k+1}| + … + |p_m| + |p_body| + radius)
 *
 * A piece whose middle is not far enough for that coarser bound is halved. A look nearer than claimed refutes it, and
 * so do a stretch that no piece of a watched pair covers and a joint that moves faster than the motion says.
 *
 * @param collider  of the cell the certificate is about: build a new one to trust nothing of the first.
 * @param watched   pairs that must be proven; all by default.
 */
export function verifyCertificate(
  collider: CellCollider,
  arm: SerialArm,
  motion: JointMotion,
  certificate: MotionCertificate,
  watched: (pair: SolidPair) => boolean = () => true,
): CertificateVerdict {
  const q = new Float64Array(motion.maxRate.length);
  const before = new Float64Array(q.length);
  let looks = 0;
  for (const pair of collider.pairs) {
    if (!watched(pair)) continue;
    const { a, b } = pair.contact;
    const rate = rateOf(pair, arm, motion.maxRate);
    const refuted = (reason: "gap" | "too near" | "unproven" | "too fast", at: number): CertificateVerdict => ({
      kind: "refuted",
      reason,
      a,
      b,
      at,
    });
    const pieces = certificate.pieces.filter(piece => piece.a === a && piece.b === b).sort((x, y) => x.from - y.from);
    let covered = certificate.from;
    for (const piece of pieces) {
      if (piece.from > covered) return refuted("gap", covered);
      covered = Math.max(covered, piece.to);
      motion.sample(piece.from, before);
      motion.sample(piece.to, q);
      if (
        q.some((angle, k) => Math.abs(angle - before[k]!) > motion.maxRate[k]! * (piece.to - piece.from) + ROUNDING_M)
      )
        return refuted("too fast", piece.from);
      const open: [from: number, to: number, halvings: number][] = [[piece.from, piece.to, 0]];
      for (let part = open.pop(); part; part = open.pop()) {
        const [from, to, halvings] = part;
        const middle = (from + to) / 2;
        const wanted_m = piece.atLeast_m + (rate * (to - from)) / 2;
        motion.sample(middle, q);
        collider.place(q);
        looks++;
        const distance_m = collider.distanceOf(pair, wanted_m + ROUNDING_M);
        if (distance_m === 0 || distance_m < piece.atLeast_m - ROUNDING_M) return refuted("too near", middle);
        if (distance_m >= wanted_m - ROUNDING_M) continue;
        if (halvings >= MOST_HALVINGS) return refuted("unproven", middle);
        open.push([middle, to, halvings + 1], [from, middle, halvings + 1]);
      }
    }
    if (covered < certificate.to) return refuted("gap", covered);
  }
  return { kind: "confirmed", looks };
}

/** Bound on the speed of any point of the pair's outer solid seen from the other [m per unit of t]. */
function rateOf({ a, b }: SolidPair, arm: SerialArm, maxRate: ArrayLike<number>): number {
  const outer = a.carrier > b.carrier ? a : b;
  const inner = outer === a ? b : a;
  let far_m = norm(outer.carrierFromBody.position) + outer.solid.radius_m;
  let rate = 0;
  for (let joint = outer.carrier; joint > Math.max(0, inner.carrier); joint--) {
    const { parentFromJoint } = arm.joints[joint - 1]!;
    rate += maxRate[joint - 1]! * (isSlide(arm.joints[joint - 1]!) ? 1 : far_m);
    far_m += norm(parentFromJoint.position) + slideOf([arm.joints[joint - 1]!]);
  }
  return rate;
}
