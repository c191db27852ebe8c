import type { CertifiedPiece } from "../collision/motion.ts";
import type { ProgramCertificate, SegmentCertificate } from "./certificate.ts";

const FORMAT = "twincell.certificate";
const VERSION = 1;
/** More pieces than this are no certificate of ours. */
const MAX_PIECES = 5_000_000;

export type ReadCertificate =
  | { readonly kind: "certificate"; readonly certificate: ProgramCertificate }
  | { readonly kind: "not-a-certificate"; readonly sentence: string };

/** The certificate as text: names of solids once, each piece as five numbers [a, b, from s, to s, at least m]. */
export function writeCertificate({ robot, program, margin_m, segments }: ProgramCertificate): string {
  const solids: string[] = [];
  const numbers = new Map<string, number>();
  const numberOf = (name: string): number =>
    numbers.get(name) ?? (numbers.set(name, solids.length), solids.push(name) - 1);
  const short = segments.map(({ step, start_s, from, to, clearance_m, pieces }) => ({
    step,
    start_s,
    from,
    to,
    clearance_m: Number.isFinite(clearance_m) ? clearance_m : null,
    pieces: pieces.map(p => [numberOf(p.a), numberOf(p.b), p.from, p.to, p.atLeast_m]),
  }));
  return `${JSON.stringify({ format: FORMAT, version: VERSION, robot, program, margin_m, solids, segments: short })}\n`;
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
  if (value.version !== VERSION) return not(`version: this release reads certificates of version ${VERSION}.`);
  const { robot, program, margin_m, solids, segments } = value;
  if (typeof robot !== "string" || typeof program !== "string") return not("robot, program: two names are expected.");
  if (!isNumber(margin_m) || margin_m < 0) return not("margin_m: a number of 0 or more is expected.");
  if (!Array.isArray(solids) || !solids.every(name => typeof name === "string"))
    return not("solids: a list of names is expected.");
  if (!Array.isArray(segments)) return not("segments: a list is expected.");
  const read: SegmentCertificate[] = [];
  let count = 0;
  for (const [i, segment] of (segments as unknown[]).entries()) {
    const one = readSegment(segment, `segments[${i}]`, solids as string[], MAX_PIECES - count);
    if ("kind" in one) return one;
    count += one.pieces.length;
    read.push(one);
  }
  return { kind: "certificate", certificate: { robot, program, margin_m, segments: read } };
}

type NotCertificate = Extract<ReadCertificate, { readonly kind: "not-a-certificate" }>;

/** @param left  pieces that may still be read. */
function readSegment(
  segment: unknown,
  where: string,
  solids: readonly string[],
  left: number,
): SegmentCertificate | NotCertificate {
  if (
    !isRecord(segment) ||
    typeof segment.step !== "string" ||
    !isNumber(segment.start_s) ||
    !isNumber(segment.from) ||
    !isNumber(segment.to)
  )
    return not(`${where}: step, start_s, from and to are expected.`);
  const { step, start_s, from, to, clearance_m } = segment;
  if (clearance_m !== null && !isNumber(clearance_m)) return not(`${where}.clearance_m: a number or null is expected.`);
  if (!Array.isArray(segment.pieces)) return not(`${where}.pieces: a list is expected.`);
  if (segment.pieces.length > left) return not(`${where}: more than ${MAX_PIECES} pieces are not read.`);
  const pieces: CertifiedPiece[] = [];
  for (const [k, piece] of (segment.pieces as unknown[]).entries()) {
    const one = readPiece(piece, `${where}.pieces[${k}]`, solids);
    if ("kind" in one) return one;
    pieces.push(one);
  }
  return { step, start_s, from, to, clearance_m: clearance_m ?? Infinity, pieces };
}

function readPiece(piece: unknown, where: string, solids: readonly string[]): CertifiedPiece | NotCertificate {
  if (!Array.isArray(piece) || piece.length !== 5 || !piece.every(isNumber))
    return not(`${where}: five numbers are expected.`);
  const [a, b, start, end, atLeast_m] = piece as [number, number, number, number, number];
  const nameA = solids[a];
  const nameB = solids[b];
  if (nameA === undefined || nameB === undefined) return not(`${where}: there is no such solid.`);
  if (!(end >= start) || atLeast_m < 0) return not(`${where}: a piece ends after it begins and claims 0 or more.`);
  return { a: nameA, b: nameB, from: start, to: end, atLeast_m };
}

const not = (sentence: string): NotCertificate => ({ kind: "not-a-certificate", sentence });
const isRecord = (value: unknown): value is Readonly<Record<string, unknown>> =>
  typeof value === "object" && value !== null && !Array.isArray(value);
const isNumber = (value: unknown): value is number => typeof value === "number" && Number.isFinite(value);
