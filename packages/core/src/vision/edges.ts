import { distort, undistort, type Lens } from "./lens.ts";

/** Places along a side where its edge is looked for. */
const SAMPLES = 32;
/** So much of a side is left out at each corner, where two edges meet. */
const CORNER_SHARE = 0.08;
/** How far from the expected edge it is looked for [px]: first from corners of the halved picture, then from a line. */
const FIRST_REACH = 3;
const SECOND_REACH = 2;
/** Gradients are taken this far to both sides [px], in steps of a quarter. */
const GRADIENT_REACH = 1;
const STEP = 0.25;
/** The weakest edge that counts, grey levels over 2 px. */
const MIN_GRADIENT = 8;

/**
 * The corners of a dark quadrilateral to a fraction of a pixel: a straight line is laid through each side's edge and
 * neighbours are made to meet. Works in directions without the lens's distortion, where straight edges are straight.
 */
export class EdgeRefiner {
  readonly #line = new Float64Array(12);
  readonly #at = new Float64Array(2);
  readonly #direction = new Float64Array(2);

  /**
   * @param corners in: 8 pixel coordinates, clockwise on the screen, good to about 3 px. Out: 8 directions x/z, y/z
   * @param reach_px the edge is looked for no farther away, so that the next module is not found instead
   * @returns whether every side has an edge
   */
  refine(gray: Uint8Array, stride: number, rows: number, lens: Lens, corners: Float64Array, reach_px: number): boolean {
    for (let i = 0; i < 4; i++) this.#toDirection(lens, corners, 2 * i);
    for (let round = 0; round < 2; round++) {
      const reach = Math.min(reach_px, round === 0 ? FIRST_REACH : SECOND_REACH);
      for (let side = 0; side < 4; side++) if (!this.#fit(gray, stride, rows, lens, corners, side, reach)) return false;
      for (let side = 0; side < 4; side++) if (!this.#meet((side + 3) & 3, side, corners)) return false;
    }
    return true;
  }

  #toDirection(lens: Lens, corners: Float64Array, at: number): void {
    undistort(lens, corners[at]!, corners[at + 1]!, this.#direction);
    corners[at] = this.#direction[0]!;
    corners[at + 1] = this.#direction[1]!;
  }

  /** Lays a line n · p = c through the edge of one side, weighted by the strength of the edge. */
  #fit(
    gray: Uint8Array,
    stride: number,
    rows: number,
    lens: Lens,
    corners: Float64Array,
    side: number,
    reach: number,
  ): boolean {
    const a = 2 * side;
    const b = 2 * ((side + 1) & 3);
    const at = this.#at;
    distort(lens, corners[a]!, corners[a + 1]!, at);
    const ax = at[0]!;
    const ay = at[1]!;
    distort(lens, corners[b]!, corners[b + 1]!, at);
    const dx = at[0]! - ax;
    const dy = at[1]! - ay;
    const long = Math.sqrt(dx * dx + dy * dy);
    if (long < 4) return false;
    // Clockwise on the screen with y down: outwards, to the bright, is (dy, −dx).
    const nx = dy / long;
    const ny = -dx / long;
    let sw = 0;
    let sx = 0;
    let sy = 0;
    let sxx = 0;
    let sxy = 0;
    let syy = 0;
    let met = 0;
    for (let i = 0; i < SAMPLES; i++) {
      const t = CORNER_SHARE + ((1 - 2 * CORNER_SHARE) * i) / (SAMPLES - 1);
      distort(
        lens,
        corners[a]! + t * (corners[b]! - corners[a]!),
        corners[a + 1]! + t * (corners[b + 1]! - corners[a + 1]!),
        at,
      );
      const offset = edgeAlong(gray, stride, rows, at[0]!, at[1]!, nx, ny, reach);
      if (offset !== offset) continue;
      undistort(lens, at[0]! + offset * nx, at[1]! + offset * ny, this.#direction);
      const x = this.#direction[0]!;
      const y = this.#direction[1]!;
      met++;
      sw++;
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
      syy += y * y;
    }
    if (met < SAMPLES / 2) return false;
    const mx = sx / sw;
    const my = sy / sw;
    const cxx = sxx / sw - mx * mx;
    const cyy = syy / sw - my * my;
    const cxy = sxy / sw - mx * my;
    const angle = 0.5 * Math.atan2(2 * cxy, cxx - cyy);
    const line = this.#line;
    line[3 * side] = -Math.sin(angle);
    line[3 * side + 1] = Math.cos(angle);
    line[3 * side + 2] = -Math.sin(angle) * mx + Math.cos(angle) * my;
    return true;
  }

  #meet(before: number, after: number, corners: Float64Array): boolean {
    const line = this.#line;
    const ax = line[3 * before]!;
    const ay = line[3 * before + 1]!;
    const bx = line[3 * after]!;
    const by = line[3 * after + 1]!;
    const det = ax * by - bx * ay;
    if (Math.abs(det) < 0.05) return false;
    corners[2 * after] = (line[3 * before + 2]! * by - line[3 * after + 2]! * ay) / det;
    corners[2 * after + 1] = (ax * line[3 * after + 2]! - bx * line[3 * before + 2]!) / det;
    return true;
  }
}

/** Where along a normal (dark to bright) the edge is: centre of the squared gradients [px], or NaN. */
function edgeAlong(
  gray: Uint8Array,
  stride: number,
  rows: number,
  x: number,
  y: number,
  nx: number,
  ny: number,
  reach: number,
): number {
  let weights = 0;
  let moment = 0;
  let strongest = 0;
  for (let n = -reach; n <= reach; n += STEP) {
    const inside = grayAt(gray, stride, rows, x + (n - GRADIENT_REACH) * nx, y + (n - GRADIENT_REACH) * ny);
    const outside = grayAt(gray, stride, rows, x + (n + GRADIENT_REACH) * nx, y + (n + GRADIENT_REACH) * ny);
    const gradient = outside - inside;
    if (!(gradient > 0)) continue;
    const weight = gradient * gradient;
    weights += weight;
    moment += weight * n;
    if (gradient > strongest) strongest = gradient;
  }
  return strongest < MIN_GRADIENT ? NaN : moment / weights;
}

/** The grey value between pixels, by bilinear interpolation; NaN outside of the picture. */
export function grayAt(gray: Uint8Array, stride: number, rows: number, x: number, y: number): number {
  const column = Math.floor(x);
  const line = Math.floor(y);
  if (column < 0 || line < 0 || column + 1 >= stride || line + 1 >= rows) return NaN;
  const at = line * stride + column;
  const fx = x - column;
  const fy = y - line;
  const top = gray[at]! + fx * (gray[at + 1]! - gray[at]!);
  const bottom = gray[at + stride]! + fx * (gray[at + stride + 1]! - gray[at + stride]!);
  return top + fy * (bottom - top);
}
