import type { CertifiedPiece } from "../collision/motion.ts";
import type { MotionCertificate } from "../collision/certificate.ts";
import type { ProgramCertificate, SegmentCertificate } from "./certificate.ts";
import type { CornerCertificate } from "./corner-certificate.ts";
import type { CornerPiece } from "./corners.ts";

const FORMAT = "twincell.certificate";
/** Certificates of version 1 say nothing of corners. */
const VERSION = 2;
/** More pieces than this are no certificate of ours. */
const MAX_PIECES = 5_000_000;

export type ReadCertificate =
  | { readonly kind: "certificate"; readonly certificate: ProgramCertificate }
  | { readonly kind: "not-a-certificate"; readonly sentence: string };

/**
 * The certificate as text: names of solids once, each piece as five numbers [a, b, from, to, at least m]; `from` and
 * `to` of motions in seconds after their start, of lines in corners as a share of the line.
 */
export function writeCertificate({ robot, program, margin_m, segments, corners }: ProgramCertificate): string {
  const solids: string[] = [];
  const numbers = new Map<string, number>();
  const numberOf = (name: string): number =>
    numbers.get(name) ?? (numbers.set(name, solids.length), solids.push(name) - 1);
  const short = (pieces: readonly CertifiedPiece[]): number[][] =>
    pieces.map(p => [numberOf(p.a), numberOf(p.b), p.from, p.to, p.atLeast_m]);
  const motions = segments.map(({ step, start_s, from, to, clearance_m, pieces }) => ({
    step,
    start_s,
    from,
    to,
    clearance_m: Number.isFinite(clearance_m) ? clearance_m : null,
    pieces: short(pieces),
  }));
  const rounded = corners.map(({ step, at_s, pieces }) => ({
    step,
    at_s,
    pieces: pieces.map(({ from, to, lines }) => ({ from, to, lines: lines.map(line => short(line.pieces)) })),
  }));
  return `${JSON.stringify({ format: FORMAT, version: VERSION, robot, program, margin_m, solids, segments: motions, corners: rounded })}\n`;
}

/**
 * Reads what `writeCertificate` wrote; anything else is an answer with the place. It does not say whether the claims
 * hold.
 */
export function readCertificate(text: string): ReadCertificate {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    return not("The file is not JSON.");
  }
  if (!isRecord(value) || value.format !== FORMAT) return not(`A certificate says "format": "${FORMAT}".`);
  if (value.version !== VERSION && value.version !== 1)
    return not(`version: this release reads certificates of the versions 1 and ${VERSION}.`);
  const { robot, program, margin_m, solids, segments } = value;
  const corners = value.version === 1 ? [] : value.corners;
  if (typeof robot !== "string" || typeof program !== "string") return not("robot, program: two names are expected.");
  if (!isNumber(margin_m) || margin_m < 0) return not("margin_m: a number of 0 or more is expected.");
  if (!Array.isArray(solids) || !solids.every(name => typeof name === "string"))
    return not("solids: a list of names is expected.");
  if (!Array.isArray(segments)) return not("segments: a list is expected.");
  if (!Array.isArray(corners)) return not("corners: a list is expected.");
  const reader = new PieceReader(solids);
  try {
    return {
      kind: "certificate",
      certificate: {
        robot,
        program,
        margin_m,
        segments: (segments as unknown[]).map((segment, i) => segmentFrom(segment, `segments[${i}]`, reader)),
        corners: (corners as unknown[]).map((corner, i) => cornerFrom(corner, `corners[${i}]`, reader)),
      },
    };
  } catch (problem) {
    if (problem instanceof NotACertificate) return not(problem.message);
    throw problem;
  }
}

class NotACertificate extends Error {}

function segmentFrom(value: unknown, where: string, reader: PieceReader): SegmentCertificate {
  if (
    !isRecord(value) ||
    typeof value.step !== "string" ||
    !isNumber(value.start_s) ||
    !isNumber(value.from) ||
    !isNumber(value.to)
  )
    throw new NotACertificate(`${where}: step, start_s, from and to are expected.`);
  const { step, start_s, from, to, clearance_m } = value;
  if (clearance_m !== null && !isNumber(clearance_m))
    throw new NotACertificate(`${where}.clearance_m: a number or null is expected.`);
  const pieces = reader.read(value.pieces, `${where}.pieces`);
  return { step, start_s, from, to, clearance_m: clearance_m ?? Infinity, pieces };
}

function cornerFrom(value: unknown, where: string, reader: PieceReader): CornerCertificate {
  if (!isRecord(value) || typeof value.step !== "string" || !isNumber(value.at_s) || !Array.isArray(value.pieces))
    throw new NotACertificate(`${where}: step, at_s and pieces are expected.`);
  const { step, at_s } = value;
  const pieces = (value.pieces as unknown[]).map((piece, k): CornerPiece => {
    const place = `${where}.pieces[${k}]`;
    if (!isRecord(piece) || !isNumber(piece.from) || !isNumber(piece.to) || !Array.isArray(piece.lines))
      throw new NotACertificate(`${place}: from, to and lines are expected.`);
    const { from, to } = piece;
    if (!(to > from)) throw new NotACertificate(`${place}: a piece ends after it begins.`);
    const lines = (piece.lines as unknown[]).map((line, l): MotionCertificate => {
      const own = reader.read(line, `${place}.lines[${l}]`);
      const clearance_m = own.reduce((least, { atLeast_m }) => Math.min(least, atLeast_m), Infinity);
      return { from: 0, to: 1, clearance_m, pieces: own };
    });
    return { from, to, lines };
  });
  return { step, at_s, pieces };
}

/** Reads lists of pieces, and no more of them than a certificate has. */
class PieceReader {
  readonly #solids: readonly string[];
  #count = 0;
  constructor(solids: readonly string[]) {
    this.#solids = solids;
  }

  read(value: unknown, where: string): readonly CertifiedPiece[] {
    if (!Array.isArray(value)) throw new NotACertificate(`${where}: a list is expected.`);
    if ((this.#count += value.length) > MAX_PIECES)
      throw new NotACertificate(`${where}: more than ${MAX_PIECES} pieces are not read.`);
    return (value as unknown[]).map((piece, k): CertifiedPiece => {
      if (!Array.isArray(piece) || piece.length !== 5 || !piece.every(isNumber))
        throw new NotACertificate(`${where}[${k}]: five numbers are expected.`);
      const [a, b, from, to, atLeast_m] = piece as [number, number, number, number, number];
      const [nameA, nameB] = [this.#solids[a], this.#solids[b]];
      if (nameA === undefined || nameB === undefined)
        throw new NotACertificate(`${where}[${k}]: there is no such solid.`);
      if (!(to >= from) || atLeast_m < 0)
        throw new NotACertificate(`${where}[${k}]: a piece ends after it begins and claims 0 or more.`);
      return { a: nameA, b: nameB, from, to, atLeast_m };
    });
  }
}

const not = (sentence: string): ReadCertificate => ({ kind: "not-a-certificate", sentence });
const isRecord = (value: unknown): value is Readonly<Record<string, unknown>> =>
  typeof value === "object" && value !== null && !Array.isArray(value);
const isNumber = (value: unknown): value is number => typeof value === "number" && Number.isFinite(value);
