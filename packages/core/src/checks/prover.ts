import { keptApart, type CellCollider } from "../collision/cell-collider.ts";
import { certifyMotion, type MotionCertificate } from "../collision/certificate.ts";
import { ClearanceMaps } from "../collision/clearance-map.ts";
import { checkMotion, jointLine, type MotionVerdict } from "../collision/motion.ts";
import type { SerialArm } from "../model/arm.ts";
import type { MotionSegment } from "../trajectory/plan.ts";
import type { Stretch } from "./grasped-parts.ts";
import { motionOf } from "./segment-motion.ts";

/** Proves single motions; keeps the working memory of one collider. */
export class Prover {
  private readonly collider: CellCollider;
  private readonly margin_m: number;
  private readonly rates: Float64Array;
  private readonly maps: ClearanceMaps;
  constructor(collider: CellCollider, margin_m: number, arm: SerialArm) {
    this.collider = collider;
    this.margin_m = margin_m;
    this.rates = new Float64Array(arm.joints.length);
    this.maps = new ClearanceMaps(collider, arm);
  }

  /** The whole motion with everything watched, or stretch by stretch as given. */
  prove(
    segment: MotionSegment,
    stretches: readonly Stretch[] = [{ from: 0, to: segment.duration_s, watched: () => true, keepsMargin: keptApart }],
  ): MotionVerdict {
    const motion = motionOf(segment, this.rates);
    let checks = 0;
    for (const { from, to, ...pairs } of stretches) {
      const verdict = checkMotion(this.collider, motion, from, to, {
        margin_m: this.margin_m,
        maps: this.maps,
        ...pairs,
      });
      if (verdict.kind !== "clear") return verdict;
      checks += verdict.checks;
    }
    return { kind: "clear", checks };
  }

  /** Straight from posture to posture, with everything so near to it in joint angles. */
  proveLine(
    from_rad: ArrayLike<number>,
    to_rad: ArrayLike<number>,
    slack_rad: ArrayLike<number>,
    pairs: Pick<Stretch, "watched" | "keepsMargin">,
  ): MotionVerdict {
    return checkMotion(this.collider, jointLine(from_rad, to_rad), 0, 1, {
      margin_m: this.margin_m,
      maps: this.maps,
      slack_rad,
      ...pairs,
    });
  }

  /** As `proveLine`, and what proves it. */
  certifyLine(
    from_rad: ArrayLike<number>,
    to_rad: ArrayLike<number>,
    slack_rad: ArrayLike<number>,
    pairs: Pick<Stretch, "watched" | "keepsMargin">,
  ): ReturnType<typeof certifyMotion> {
    return certifyMotion(this.collider, jointLine(from_rad, to_rad), 0, 1, {
      margin_m: this.margin_m,
      slack_rad,
      ...pairs,
    });
  }

  /** As `prove`, and what proves it; slower, because nothing that was found before is used. */
  certify(segment: MotionSegment, stretches: readonly Stretch[]): ReturnType<typeof certifyMotion> {
    const motion = motionOf(segment, this.rates);
    const proven: MotionCertificate[] = [];
    let checks = 0;
    for (const { from, to, ...pairs } of stretches) {
      const { verdict, certificate } = certifyMotion(this.collider, motion, from, to, {
        margin_m: this.margin_m,
        ...pairs,
      });
      if (verdict.kind !== "clear" || certificate === null) return { verdict, certificate: null };
      checks += verdict.checks;
      proven.push(certificate);
    }
    const clearance_m = Math.min(...proven.map(each => each.clearance_m));
    return {
      verdict: { kind: "clear", checks },
      certificate: { from: 0, to: segment.duration_s, clearance_m, pieces: proven.flatMap(({ pieces }) => pieces) },
    };
  }
}
