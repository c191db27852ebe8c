import type { CellCollider } from "../collision/cell-collider.ts";
import type { CellGeometry } from "../collision/cell.ts";
import { verifyCertificate, type CertificateVerdict } from "../collision/certificate.ts";
import { jointLine, marginOf, slackOf } from "../collision/motion.ts";
import type { Robot } from "../model/robot.ts";
import { chordsAround, pairsInCorner, type CornerPiece, type PassedCorner } from "./corners.ts";
import type { Stretch } from "./grasped-parts.ts";

/**
 * The proof of a corner that is passed without a stop, for whatever curve a controller takes in it: pieces that cover
 * it from its point (0) to its widest form (1).
 */
export interface CornerCertificate {
  /** The step that ends in the corner. */
  readonly step: string;
  readonly at_s: number;
  readonly pieces: readonly CornerPiece[];
}

/** A claim that does not hold, or is less than the margin. */
export interface RefutedClaim {
  readonly kind: "refuted";
  readonly step: string;
  readonly reason: Extract<CertificateVerdict, { kind: "refuted" }>["reason"] | "below margin";
  readonly a: string;
  readonly b: string;
  readonly at_s: number;
}

export type CornerCertificateVerdict =
  | { readonly kind: "confirmed"; readonly looks: number }
  | { readonly kind: "missing"; readonly step: string; readonly start_s: number; readonly of: "corner" }
  | RefutedClaim;

/** Certificates are about the same motion or corner when their times differ by less [s]. */
export const SAME_TIME_S = 1e-9;

/**
 * Proves the certificate of one corner again: that its pieces cover it, that each of them claims enough for all chords
 * it stands for, and each claim by the other method of `verifyCertificate`. What no piece covers, and what the arm does
 * not reach, is not proven: the corner is "missing".
 *
 * @param corner  laid out anew.
 */
export function verifyCorner(
  collider: CellCollider,
  robot: Robot,
  cell: CellGeometry,
  { corners, margin_m }: { readonly corners: readonly CornerCertificate[]; readonly margin_m: number },
  { step, at_s, sweep }: PassedCorner,
  before: Stretch | undefined,
  behind: Stretch | undefined,
): CornerCertificateVerdict {
  const missing: CornerCertificateVerdict = { kind: "missing", step, start_s: at_s, of: "corner" };
  const own = corners.find(each => each.step === step && Math.abs(each.at_s - at_s) < SAME_TIME_S);
  if (own === undefined) return missing;
  const { watched, keepsMargin } = pairsInCorner(before, behind);
  let covered = 0;
  let looks = 0;
  for (const { from, to, lines } of [...own.pieces].sort((a, b) => a.from - b.from)) {
    const around = from <= covered ? chordsAround(sweep, from, to) : undefined;
    if (around === undefined || lines.length !== around.chord.length - 1) return missing;
    const { chord, slack_rad } = around;
    const wanted = new Map(
      collider.pairs.map(pair => [
        `${pair.contact.a}\n${pair.contact.b}`,
        watched(pair) ? (keepsMargin(pair) ? marginOf(pair, margin_m, cell) : 0) + slackOf(pair, slack_rad) : 0,
      ]),
    );
    for (const [k, line] of lines.entries()) {
      if (line.from > 0 || line.to < 1) return missing;
      const low = line.pieces.find(({ a, b, atLeast_m }) => atLeast_m < (wanted.get(`${a}\n${b}`) ?? 0));
      if (low !== undefined) return { kind: "refuted", step, reason: "below margin", a: low.a, b: low.b, at_s };
      const verdict = verifyCertificate(collider, robot.arm, jointLine(chord[k]!, chord[k + 1]!), line, watched);
      if (verdict.kind === "refuted") {
        const { reason, a, b } = verdict;
        return { kind: "refuted", step, reason, a, b, at_s };
      }
      looks += verdict.looks;
    }
    covered = Math.max(covered, to);
  }
  return covered < 1 ? missing : { kind: "confirmed", looks };
}
