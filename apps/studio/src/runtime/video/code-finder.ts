import { findQuads, squareToQuad, type Quad } from "./quads.ts";
import { CODE_CELLS, readCells, type TimeCode } from "./time-code.ts";

/**
 * What a picture says. A camera that films a screen on which its own picture is shown sees several codes, smaller and
 * older ones in the picture within the picture. "mixed": a code is there, but two of them are seen at once, one fading
 * into the next.
 */
export type CodeSighting =
  | { readonly kind: "read"; readonly codes: readonly TimeCode[] }
  | { readonly kind: "mixed" }
  | { readonly kind: "none" };

/** Black and white of a code differ by more than this, of 255. */
const LEAST_CONTRAST = 24;
/** So near to the middle between black and white a cell is neither. */
const NEITHER = 0.14;
const SPOTS = [-0.2, 0, 0.2] as const;

/** Brightness of RGBA pixels, Rec. 709 in whole numbers. */
export function grayOf(rgba: Uint8ClampedArray | Uint8Array, out: Uint8Array): Uint8Array {
  for (let i = 0, k = 0; i < out.length; i++, k += 4)
    out[i] = (54 * rgba[k]! + 183 * rgba[k + 1]! + 19 * rgba[k + 2]!) >> 8;
  return out;
}

/**
 * Looks for a time code in a picture, filmed from any side. The light of a screen and of a room differ, so that several
 * thresholds are tried: Otsu's of the whole picture and some beside it.
 *
 * @param session  of the measurement; codes of another are not seen.
 */
export function findCode(gray: Uint8Array, width: number, height: number, session: number): CodeSighting {
  const otsu = otsuThreshold(gray);
  const codes: TimeCode[] = [];
  let mixed = false;
  for (const factor of [1, 0.6, 1.4, 0.35, 1.8]) {
    const threshold = otsu * factor;
    if (threshold <= 4 || threshold >= 252) continue;
    findQuads(gray, width, height, threshold, quad => {
      const seen = readQuad(gray, width, height, quad, session);
      if (seen === "mixed") mixed = true;
      else if (seen) codes.push(seen);
    });
    if (codes.length > 0) return { kind: "read", codes };
    if (mixed) return { kind: "mixed" };
  }
  return { kind: "none" };
}

/** The threshold that parts brightnesses best. @see Otsu, IEEE Trans. SMC 9 (1979). */
function otsuThreshold(gray: Uint8Array): number {
  const counts = new Float64Array(256);
  for (const value of gray) counts[value]!++;
  let all = 0;
  for (let value = 0; value < 256; value++) all += value * counts[value]!;
  let below = 0;
  let sum = 0;
  let best = 127;
  let most = -1;
  for (let value = 0; value < 255; value++) {
    below += counts[value]!;
    sum += value * counts[value]!;
    const above = gray.length - below;
    if (below === 0 || above === 0) continue;
    const between = below * above * (sum / below - (all - sum) / above) ** 2;
    if (between > most) {
      most = between;
      best = value + 1;
    }
  }
  return best;
}

const values = new Float64Array(CODE_CELLS * CODE_CELLS);
const cells = new Uint8Array(CODE_CELLS * CODE_CELLS);
const quiet = new Float64Array(4 * CODE_CELLS);

function readQuad(
  gray: Uint8Array,
  width: number,
  height: number,
  quad: Quad,
  session: number,
): TimeCode | "mixed" | null {
  const map = squareToQuad(quad);
  const last = CODE_CELLS - 1;
  let frame = 0;
  for (let row = 0; row < CODE_CELLS; row++) {
    for (let column = 0; column < CODE_CELLS; column++) {
      const value = (values[row * CODE_CELLS + column] = cellAt(gray, width, height, map, row + 0.5, column + 0.5));
      if (row === 0 || column === 0 || row === last || column === last) frame += value;
    }
  }
  frame /= 4 * last;
  for (let k = 0; k < CODE_CELLS; k++) {
    quiet[4 * k] = cellAt(gray, width, height, map, -0.5, k + 0.5);
    quiet[4 * k + 1] = cellAt(gray, width, height, map, CODE_CELLS + 0.5, k + 0.5);
    quiet[4 * k + 2] = cellAt(gray, width, height, map, k + 0.5, -0.5);
    quiet[4 * k + 3] = cellAt(gray, width, height, map, k + 0.5, CODE_CELLS + 0.5);
  }
  quiet.sort();
  const white = quiet[quiet.length >> 1]!;
  const range = white - frame;
  const middle = (white + frame) / 2;
  // A hand or the edge of the picture may cover some of the white around.
  if (range < LEAST_CONTRAST || quiet[quiet.length >> 2]! < middle) return null;
  let mixed = false;
  for (let row = 0; row < CODE_CELLS; row++) {
    for (let column = 0; column < CODE_CELLS; column++) {
      const i = row * CODE_CELLS + column;
      const value = values[i]!;
      const inFrame = row === 0 || column === 0 || row === last || column === last;
      if (inFrame && value > middle) return null;
      cells[i] = value < middle ? 1 : 0;
      mixed ||= !inFrame && Math.abs(value - middle) < NEITHER * range;
    }
  }
  return mixed ? "mixed" : readCells(cells, session);
}

/** Mean brightness in the middle of a cell, in cells from the corner of the frame. */
function cellAt(
  gray: Uint8Array,
  width: number,
  height: number,
  map: Float64Array,
  row: number,
  column: number,
): number {
  let sum = 0;
  for (const down of SPOTS) {
    for (const right of SPOTS) {
      const u = (column + right) / CODE_CELLS;
      const v = (row + down) / CODE_CELLS;
      const w = map[6]! * u + map[7]! * v + 1;
      const x = Math.min(width - 1, Math.max(0, Math.floor((map[0]! * u + map[1]! * v + map[2]!) / w)));
      const y = Math.min(height - 1, Math.max(0, Math.floor((map[3]! * u + map[4]! * v + map[5]!) / w)));
      sum += gray[y * width + x]!;
    }
  }
  return sum / (SPOTS.length * SPOTS.length);
}
