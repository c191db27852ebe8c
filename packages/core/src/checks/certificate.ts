import { CellCollider } from "../collision/cell-collider.ts";
import type { CellGeometry } from "../collision/cell.ts";
import { verifyCertificate, type CertificateVerdict, type MotionCertificate } from "../collision/certificate.ts";
import { marginOf, type JointMotion } from "../collision/motion.ts";
import type { Robot } from "../model/robot.ts";
import type { MotionSegment, Plan } from "../trajectory/plan.ts";
import { sampleSegment } from "../trajectory/sample.ts";
import { GraspedParts } from "./grasped-parts.ts";
import type { Program } from "../program/program.ts";

/** The proof of one motion of a plan: t is seconds after its start. */
export interface SegmentCertificate extends MotionCertificate {
  readonly step: string;
  readonly start_s: number;
}

/** What proves a whole program clear of contact: one certificate for each of its motions. Plain data. */
export interface ProgramCertificate {
  readonly robot: string;
  readonly program: string;
  /** The distance asked for between robot and cell [m]. */
  readonly margin_m: number;
  readonly segments: readonly SegmentCertificate[];
}

export type ProgramCertificateVerdict =
  | { readonly kind: "confirmed"; readonly segments: number; readonly looks: number }
  /** A motion of the plan that no certificate is about. */
  | { readonly kind: "missing"; readonly step: string; readonly start_s: number }
  /** A claim that does not hold, or is less than the margin. */
  | {
      readonly kind: "refuted";
      readonly step: string;
      readonly reason: Extract<CertificateVerdict, { kind: "refuted" }>["reason"] | "below margin";
      readonly a: string;
      readonly b: string;
      readonly at_s: number;
    };

/** Segments start at the same time when they differ by less [s]. */
const SAME_TIME_S = 1e-9;

/** The motion of a segment with bounds on its joint speeds. `rates` receives them and is kept by the motion. */
export function motionOf(segment: MotionSegment, rates: Float64Array): JointMotion {
  topSpeeds(segment, rates);
  return {
    sample: (t, out) => {
      sampleSegment(segment, t, out);
    },
    maxRate: rates,
  };
}

/**
 * Proves a program's certificate again, motion by motion, with a collider made anew and by the other method of
 * `verifyCertificate`.
 *
 * @param program  says with `plan` which parts are held when.
 * @param plan     laid out again from the program: a certificate of another program or another cell does not fit it.
 */
export function verifyProgram(
  certificate: ProgramCertificate,
  program: Program,
  plan: Plan,
  robot: Robot,
  cell: CellGeometry,
): ProgramCertificateVerdict {
  const collider = new CellCollider(cell, robot.arm);
  const rates = new Float64Array(robot.arm.joints.length);
  collider.allowContactsAt(robot.home_rad);
  const parts = new GraspedParts(collider, cell, program, robot.arm, plan.segments, certificate.margin_m);
  let segments = 0;
  let looks = 0;
  for (const segment of plan.segments) {
    const stretches = parts.enter(segment);
    if (segment.kind !== "motion" || segment.times_s.length < 2) continue;
    const own = certificate.segments.find(
      ({ step, start_s }) => step === segment.step && Math.abs(start_s - segment.start_s) < SAME_TIME_S,
    );
    if (own === undefined || own.from > 0 || own.to < segment.duration_s)
      return { kind: "missing", step: segment.step, start_s: segment.start_s };
    for (const { from, to, watched, keepsMargin } of stretches) {
      const proof =
        stretches.length === 1
          ? own
          : { ...own, from, to, pieces: own.pieces.filter(piece => piece.from >= from && piece.to <= to) };
      const wanted = new Map(
        collider.pairs.map(pair => [
          `${pair.contact.a}\n${pair.contact.b}`,
          watched(pair) && keepsMargin(pair) ? marginOf(pair, certificate.margin_m, cell) : 0,
        ]),
      );
      const low = proof.pieces.find(({ a, b, atLeast_m }) => atLeast_m < (wanted.get(`${a}\n${b}`) ?? 0));
      if (low !== undefined)
        return {
          kind: "refuted",
          step: segment.step,
          reason: "below margin",
          a: low.a,
          b: low.b,
          at_s: segment.start_s + low.from,
        };
      const verdict = verifyCertificate(collider, robot.arm, motionOf(segment, rates), proof, watched);
      if (verdict.kind === "refuted")
        return {
          kind: "refuted",
          step: segment.step,
          reason: verdict.reason,
          a: verdict.a,
          b: verdict.b,
          at_s: segment.start_s + verdict.at,
        };
      looks += verdict.looks;
    }
    segments++;
  }
  return { kind: "confirmed", segments, looks };
}

/**
 * Bounds on the joint speeds of a motion. A cubic's speed in Bernstein form is q̇₀, 3 Δq/h − q̇₀ − q̇₁, q̇₁ and stays
 * within the largest of them.
 */
function topSpeeds({ times_s, q_rad, qd_rad_s }: MotionSegment, out: Float64Array): void {
  const n = out.length;
  out.fill(0);
  for (let i = 0; i + 1 < times_s.length; i++) {
    const h = times_s[i + 1]! - times_s[i]!;
    for (let j = 0; j < n; j++) {
      const a = i * n + j;
      const d0 = qd_rad_s[a]!;
      const d1 = qd_rad_s[a + n]!;
      const m = h > 0 ? (3 * (q_rad[a + n]! - q_rad[a]!)) / h - d0 - d1 : 0;
      out[j] = Math.max(out[j]!, Math.abs(d0), Math.abs(d1), Math.abs(m));
    }
  }
}
