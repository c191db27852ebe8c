import { CellCollider } from "../collision/cell-collider.ts";
import type { CellGeometry } from "../collision/cell.ts";
import { verifyCertificate, type MotionCertificate } from "../collision/certificate.ts";
import { marginOf } from "../collision/motion.ts";
import type { Robot } from "../model/robot.ts";
import { layOutProgram } from "../trajectory/layout.ts";
import type { Plan } from "../trajectory/plan.ts";
import { samplePlan } from "../trajectory/sample.ts";
import { SAME_TIME_S, verifyCorner, type CornerCertificate, type RefutedClaim } from "./corner-certificate.ts";
import { cornersOf, type PassedCorner } from "./corners.ts";
import { GraspedParts, type Stretch } from "./grasped-parts.ts";
import { motionOf } from "./segment-motion.ts";
import type { Program } from "../program/program.ts";

/** The proof of one motion of a plan: t is seconds after its start. */
export interface SegmentCertificate extends MotionCertificate {
  readonly step: string;
  readonly start_s: number;
}

/**
 * What proves a whole program clear of contact: one certificate for each of its motions, and one for each corner that
 * it passes without a stop. Plain data.
 */
export interface ProgramCertificate {
  readonly robot: string;
  readonly program: string;
  /** The distance asked for between robot and cell [m]. */
  readonly margin_m: number;
  readonly segments: readonly SegmentCertificate[];
  /** Corners that are too near to something, or that the arm does not reach all over, have none. */
  readonly corners: readonly CornerCertificate[];
}

export type ProgramCertificateVerdict =
  | { readonly kind: "confirmed"; readonly segments: number; readonly corners: number; readonly looks: number }
  /** A motion of the plan, or the corner at the end of one, that no certificate is about. */
  | {
      readonly kind: "missing";
      readonly step: string;
      readonly start_s: number;
      readonly of: "motion" | "corner";
    }
  | RefutedClaim;

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
  const passed = cornersOfPlan(program, plan, robot, cell);
  let before: Stretch | undefined;
  let segments = 0;
  let corners = 0;
  let looks = 0;
  for (const segment of plan.segments) {
    const stretches = parts.enter(segment);
    if (segment.kind !== "motion" || segment.times_s.length < 2) continue;
    const corner = passed.get(keyOf(segment.start_s));
    if (corner !== undefined) {
      const answer = verifyCorner(collider, robot, cell, certificate, corner, before, stretches[0]);
      if (answer.kind !== "confirmed") return answer;
      passed.delete(keyOf(segment.start_s));
      looks += answer.looks;
      corners++;
    }
    before = stretches.at(-1);
    const own = certificate.segments.find(
      ({ step, start_s }) => step === segment.step && Math.abs(start_s - segment.start_s) < SAME_TIME_S,
    );
    if (own === undefined || own.from > 0 || own.to < segment.duration_s)
      return { kind: "missing", step: segment.step, start_s: segment.start_s, of: "motion" };
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
  // A plan that is not the program's own has its corners elsewhere.
  const [left] = passed.values();
  if (left !== undefined) return { kind: "missing", step: left.step, start_s: left.at_s, of: "corner" };
  return { kind: "confirmed", segments, corners, looks };
}

const keyOf = (at_s: number): number => Math.round(at_s / SAME_TIME_S);

/** The corners that the program passes without a stop, laid out anew, by the moment of the plan at which they are. */
function cornersOfPlan(
  program: Program,
  plan: Plan,
  robot: Robot,
  { worldFromBase }: CellGeometry,
): Map<number, PassedCorner> {
  const start_rad = new Float64Array(robot.arm.joints.length);
  samplePlan(plan, 0, start_rad);
  const layout = layOutProgram(program, robot, { worldFromBase, start_rad });
  const corners = new Map<number, PassedCorner>();
  for (const corner of cornersOf({ layout, robot }).values()) {
    const step = layout.turns.get(corner.step)?.written.id ?? corner.step;
    corners.set(keyOf(corner.at_s), { ...corner, step });
  }
  return corners;
}
