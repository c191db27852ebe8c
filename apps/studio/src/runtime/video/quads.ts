/** Four corners, in order around: x and y in turn [pixels]. */
export type Quad = Float64Array;

const LEAST_SIDE_PX = 20;
const LEAST_PIXELS = 150;

/**
 * Dark patches of a picture that might be the frame of a code: those whose outline is about a quadrangle. The corners
 * are found as the farthest points: from the middle the first, from it the opposite one, and from their line one on
 * either side.
 *
 * @param gray       width · height brightnesses, row by row. Read only.
 * @param threshold  below it a pixel is dark.
 * @param found      called with each; the quad is lent for the call.
 */
export function findQuads(
  gray: Uint8Array,
  width: number,
  height: number,
  threshold: number,
  found: (quad: Quad) => void,
): void {
  const seen = new Uint8Array(gray.length);
  const queue = new Int32Array(gray.length);
  const quad = new Float64Array(8);
  for (let start = 0; start < gray.length; start++) {
    if (seen[start] === 1 || gray[start]! >= threshold) continue;
    let count = 0;
    let sumX = 0;
    let sumY = 0;
    queue[count++] = start;
    seen[start] = 1;
    for (let next = 0; next < count; next++) {
      const at = queue[next]!;
      const x = at % width;
      const y = (at - x) / width;
      sumX += x;
      sumY += y;
      if (x > 0 && seen[at - 1] === 0 && gray[at - 1]! < threshold) {
        seen[at - 1] = 1;
        queue[count++] = at - 1;
      }
      if (x < width - 1 && seen[at + 1] === 0 && gray[at + 1]! < threshold) {
        seen[at + 1] = 1;
        queue[count++] = at + 1;
      }
      if (y > 0 && seen[at - width] === 0 && gray[at - width]! < threshold) {
        seen[at - width] = 1;
        queue[count++] = at - width;
      }
      if (y < height - 1 && seen[at + width] === 0 && gray[at + width]! < threshold) {
        seen[at + width] = 1;
        queue[count++] = at + width;
      }
    }
    if (count >= LEAST_PIXELS && corners(queue, count, width, sumX / count, sumY / count, quad)) found(quad);
  }
}

function corners(pixels: Int32Array, count: number, width: number, cx: number, cy: number, out: Quad): boolean {
  let first = 0;
  let second = 0;
  let left = 0;
  let right = 0;
  let most = -1;
  for (let i = 0; i < count; i++) {
    const at = pixels[i]!;
    const x = at % width;
    const y = (at - x) / width;
    const far = (x - cx) ** 2 + (y - cy) ** 2;
    if (far > most) {
      most = far;
      first = at;
    }
  }
  const ax = first % width;
  const ay = (first - ax) / width;
  most = -1;
  for (let i = 0; i < count; i++) {
    const at = pixels[i]!;
    const x = at % width;
    const y = (at - x) / width;
    const far = (x - ax) ** 2 + (y - ay) ** 2;
    if (far > most) {
      most = far;
      second = at;
    }
  }
  const bx = second % width;
  const by = (second - bx) / width;
  const dx = bx - ax;
  const dy = by - ay;
  let mostLeft = 0;
  let mostRight = 0;
  for (let i = 0; i < count; i++) {
    const at = pixels[i]!;
    const x = at % width;
    const y = (at - x) / width;
    const side = dx * (y - ay) - dy * (x - ax);
    if (side > mostLeft) {
      mostLeft = side;
      left = at;
    }
    if (-side > mostRight) {
      mostRight = -side;
      right = at;
    }
  }
  // A code seen at a slant still has its second diagonal well off the first.
  const diagonal = Math.hypot(dx, dy);
  if (mostLeft < diagonal * LEAST_SIDE_PX * 0.35 || mostRight < diagonal * LEAST_SIDE_PX * 0.35) return false;
  const lx = left % width;
  const rx = right % width;
  out.set([ax, ay, lx, (left - lx) / width, bx, by, rx, (right - rx) / width]);
  for (let k = 0; k < 4; k++) {
    const x = out[2 * k]!;
    const y = out[2 * k + 1]!;
    const nextX = out[(2 * k + 2) % 8]!;
    const nextY = out[(2 * k + 3) % 8]!;
    if (Math.hypot(nextX - x, nextY - y) < LEAST_SIDE_PX) return false;
  }
  // The frame alone is 44 % of its square; less dark than that is no frame.
  const area = (mostLeft + mostRight) / 2;
  if (count < 0.38 * area || count > 1.15 * area) return false;
  // The middles of pixels are half a pixel inside the outline.
  for (let k = 0; k < 4; k++) {
    const x = out[2 * k]! - cx;
    const y = out[2 * k + 1]! - cy;
    const length = Math.hypot(x, y);
    out[2 * k] = out[2 * k]! + (0.5 * x) / length + 0.5;
    out[2 * k + 1] = out[2 * k + 1]! + (0.5 * y) / length + 0.5;
  }
  return true;
}

/**
 * The plane's mapping of the unit square onto a quad, as 8 numbers h of
 *
 *   x = (h0 u + h1 v + h2) / (h6 u + h7 v + 1),   y = (h3 u + h4 v + h5) / (h6 u + h7 v + 1)
 *
 * @see Heckbert, Fundamentals of Texture Mapping and Image Warping, Berkeley 1989, ch. 2.
 */
export function squareToQuad(quad: Quad): Float64Array {
  const [x0, y0, x1, y1, x2, y2, x3, y3] = quad as unknown as readonly [
    number,
    number,
    number,
    number,
    number,
    number,
    number,
    number,
  ];
  const sx = x0 - x1 + x2 - x3;
  const sy = y0 - y1 + y2 - y3;
  const dx1 = x1 - x2;
  const dx2 = x3 - x2;
  const dy1 = y1 - y2;
  const dy2 = y3 - y2;
  const det = dx1 * dy2 - dx2 * dy1;
  const g = (sx * dy2 - dx2 * sy) / det;
  const h = (dx1 * sy - sx * dy1) / det;
  return Float64Array.of(x1 - x0 + g * x1, x3 - x0 + h * x3, x0, y1 - y0 + g * y1, y3 - y0 + h * y3, y0, g, h);
}
