import type { Random } from "../random.ts";
import { alongLine, distanceBetween } from "./path-validator.ts";

/** Pairs of random places on the way between which a straight line is tried, for each of its corners. */
const TRIES_PER_CORNER = 6;
const LEAST_TRIES = 12;
/** A straight line must save this part of the piece it replaces. */
const WORTH = 0.02;
/** How far from a corner it is cut off, as parts of the shorter side, the most first. */
const CUTS = [0.5, 0.25] as const;

/**
 * The same way with fewer and blunter corners: corners that are not needed are left out, random places are joined,
 * corners are cut off. Never longer than before; the ends stay.
 *
 * @param lineFree  whether a straight line may be taken.
 */
export function shorten(
  way: readonly Float64Array[],
  lineFree: (a: Float64Array, b: Float64Array) => boolean,
  random: Random,
): Float64Array[] {
  let short = withoutNeedless([...way], lineFree);
  const tries = Math.max(LEAST_TRIES, TRIES_PER_CORNER * (short.length - 2));
  for (let i = 0; i < tries && short.length > 2; i++) short = joined(short, lineFree, random);
  return cutCorners(withoutNeedless(short, lineFree), lineFree);
}

/** From each corner straight to the farthest one that is seen from it. */
function withoutNeedless(
  way: readonly Float64Array[],
  lineFree: (a: Float64Array, b: Float64Array) => boolean,
): Float64Array[] {
  const kept = [way[0]!];
  for (let i = 0; i < way.length - 1; ) {
    let j = way.length - 1;
    while (j > i + 1 && !lineFree(way[i]!, way[j]!)) j--;
    kept.push(way[j]!);
    i = j;
  }
  return kept;
}

function joined(
  way: Float64Array[],
  lineFree: (a: Float64Array, b: Float64Array) => boolean,
  random: Random,
): Float64Array[] {
  const lengths = way.slice(1).map((q, i) => distanceBetween(way[i]!, q));
  const whole = lengths.reduce((sum, length) => sum + length, 0);
  const a = placeAt(way, lengths, random() * whole);
  const b = placeAt(way, lengths, random() * whole);
  const [first, last] = a.along <= b.along ? [a, b] : [b, a];
  if (first.line === last.line) return way;
  const saved = last.along - first.along - distanceBetween(first.q, last.q);
  if (saved < WORTH * (last.along - first.along) || !lineFree(first.q, last.q)) return way;
  return [...way.slice(0, first.line + 1), first.q, last.q, ...way.slice(last.line + 1)];
}

interface Place {
  readonly line: number;
  readonly along: number;
  readonly q: Float64Array;
}

function placeAt(way: readonly Float64Array[], lengths: readonly number[], along: number): Place {
  let line = 0;
  let rest = along;
  while (line < lengths.length - 1 && rest > lengths[line]!) rest -= lengths[line++]!;
  const t = lengths[line]! > 0 ? Math.min(1, rest / lengths[line]!) : 0;
  return { line, along, q: alongLine(way[line]!, way[line + 1]!, t, new Float64Array(way[line]!.length)) };
}

function cutCorners(way: Float64Array[], lineFree: (a: Float64Array, b: Float64Array) => boolean): Float64Array[] {
  const cut = [way[0]!];
  for (let i = 1; i < way.length - 1; i++) {
    const before = cut.at(-1)!;
    const corner = way[i]!;
    const after = way[i + 1]!;
    const n = corner.length;
    const side = Math.min(distanceBetween(before, corner), distanceBetween(corner, after));
    let done = false;
    for (const part of CUTS) {
      const in_ = alongLine(
        corner,
        before,
        (part * side) / Math.max(distanceBetween(before, corner), 1e-12),
        new Float64Array(n),
      );
      const out = alongLine(
        corner,
        after,
        (part * side) / Math.max(distanceBetween(corner, after), 1e-12),
        new Float64Array(n),
      );
      if (2 * part * side - distanceBetween(in_, out) < WORTH * 2 * part * side || !lineFree(in_, out)) continue;
      cut.push(in_, out);
      done = true;
      break;
    }
    if (!done) cut.push(corner);
  }
  cut.push(way.at(-1)!);
  return cut;
}
