import { trianglesTouch } from "./triangles.ts";

/**
 * Squared distance of two triangles [m²] with the two points where it is found: the least over nine pairs of edges
 * and six corners over faces, 0 where the triangles share a point.
 *
 * @param p, q  three corners each from index i and j on, in one frame [m].
 * @param limit  a squared distance; anything not below it is answered with Infinity and leaves `out` alone.
 * @param out  receives the point on p and the point on q.
 * @see Ericson, Real-Time Collision Detection, Morgan Kaufmann 2005, sections 5.1.5, 5.1.9, 5.1.10.
 */
export function triangleDistance2(
  p: Float64Array,
  i: number,
  q: Float64Array,
  j: number,
  limit: number,
  out: Float64Array,
): number {
  const planes = planeGap2(p, i, q, j, limit);
  if (planes >= limit) return Infinity;
  if (planes === 0 && trianglesTouch(p, i, q, j)) {
    if (!crossing(p, i, q, j, out) && !crossing(q, j, p, i, out)) edges(p, i, q, j, Infinity, out);
    return 0;
  }
  let best = edges(p, i, q, j, limit, out);
  best = corners(p, i, q, j, best, out, 0);
  best = corners(q, j, p, i, best, out, 3);
  return best < limit ? best : Infinity;
}

/** Squared distance of the segments that begin at p[i] and at q[j] [m²]. */
export function segmentDistance2(p: Float64Array, i: number, q: Float64Array, j: number): number {
  const rx = p[i]! - q[j]!;
  const ry = p[i + 1]! - q[j + 1]!;
  const rz = p[i + 2]! - q[j + 2]!;
  const ux = p[i + 3]! - p[i]!;
  const uy = p[i + 4]! - p[i + 1]!;
  const uz = p[i + 5]! - p[i + 2]!;
  const vx = q[j + 3]! - q[j]!;
  const vy = q[j + 4]! - q[j + 1]!;
  const vz = q[j + 5]! - q[j + 2]!;
  const uu = ux * ux + uy * uy + uz * uz;
  const vv = vx * vx + vy * vy + vz * vz;
  const uv = ux * vx + uy * vy + uz * vz;
  const ur = ux * rx + uy * ry + uz * rz;
  const vr = vx * rx + vy * ry + vz * rz;
  const area = uu * vv - uv * uv;
  let s = area > 1e-14 * uu * vv ? clamp((uv * vr - ur * vv) / area) : 0;
  let t = (uv * s + vr) / vv;
  if (t < 0) {
    t = 0;
    s = clamp(-ur / uu);
  } else if (t > 1) {
    t = 1;
    s = clamp((uv - ur) / uu);
  }
  const dx = rx + s * ux - t * vx;
  const dy = ry + s * uy - t * vy;
  const dz = rz + s * uz - t * vz;
  return dx * dx + dy * dy + dz * dz;
}

/**
 * Squared gap between the plane of either triangle and the other triangle, the larger of the two; 0 when both straddle.
 */
function planeGap2(p: Float64Array, i: number, q: Float64Array, j: number, enough: number): number {
  const first = gapToPlane2(p, i, q, j);
  return first >= enough ? first : Math.max(first, gapToPlane2(q, j, p, i));
}

function gapToPlane2(p: Float64Array, i: number, q: Float64Array, j: number): number {
  const x = p[i]!;
  const y = p[i + 1]!;
  const z = p[i + 2]!;
  const ux = p[i + 3]! - x;
  const uy = p[i + 4]! - y;
  const uz = p[i + 5]! - z;
  const vx = p[i + 6]! - x;
  const vy = p[i + 7]! - y;
  const vz = p[i + 8]! - z;
  const nx = uy * vz - uz * vy;
  const ny = uz * vx - ux * vz;
  const nz = ux * vy - uy * vx;
  const a = nx * (q[j]! - x) + ny * (q[j + 1]! - y) + nz * (q[j + 2]! - z);
  const b = nx * (q[j + 3]! - x) + ny * (q[j + 4]! - y) + nz * (q[j + 5]! - z);
  const c = nx * (q[j + 6]! - x) + ny * (q[j + 7]! - y) + nz * (q[j + 8]! - z);
  const gap = a > 0 ? Math.min(a, b, c) : -Math.max(a, b, c);
  return gap > 0 ? (gap * gap) / (nx * nx + ny * ny + nz * nz) : 0;
}

/** Least squared distance over the nine pairs of edges, when it is below `best`. */
function edges(p: Float64Array, i: number, q: Float64Array, j: number, best: number, out: Float64Array): number {
  for (let a = 0; a < 3; a++) {
    const from = i + 3 * a;
    const to = i + 3 * (a === 2 ? 0 : a + 1);
    const x = p[from]!;
    const y = p[from + 1]!;
    const z = p[from + 2]!;
    const ux = p[to]! - x;
    const uy = p[to + 1]! - y;
    const uz = p[to + 2]! - z;
    const uu = ux * ux + uy * uy + uz * uz;
    for (let b = 0; b < 3; b++) {
      const start = j + 3 * b;
      const end = j + 3 * (b === 2 ? 0 : b + 1);
      const rx = x - q[start]!;
      const ry = y - q[start + 1]!;
      const rz = z - q[start + 2]!;
      const vx = q[end]! - q[start]!;
      const vy = q[end + 1]! - q[start + 1]!;
      const vz = q[end + 2]! - q[start + 2]!;
      const vv = vx * vx + vy * vy + vz * vz;
      const uv = ux * vx + uy * vy + uz * vz;
      const ur = ux * rx + uy * ry + uz * rz;
      const vr = vx * rx + vy * ry + vz * rz;
      const area = uu * vv - uv * uv;
      let s = area > 1e-14 * uu * vv ? clamp((uv * vr - ur * vv) / area) : 0;
      let t = (uv * s + vr) / vv;
      if (t < 0) {
        t = 0;
        s = clamp(-ur / uu);
      } else if (t > 1) {
        t = 1;
        s = clamp((uv - ur) / uu);
      }
      const dx = rx + s * ux - t * vx;
      const dy = ry + s * uy - t * vy;
      const dz = rz + s * uz - t * vz;
      const squared = dx * dx + dy * dy + dz * dz;
      if (squared >= best) continue;
      best = squared;
      out[0] = x + s * ux;
      out[1] = y + s * uy;
      out[2] = z + s * uz;
      out[3] = out[0] - dx;
      out[4] = out[1] - dy;
      out[5] = out[2] - dz;
    }
  }
  return best;
}

const clamp = (t: number): number => (t > 0 ? (t < 1 ? t : 1) : 0);

/** Corners of p that stand over the face of q nearer than `best`. `side` is where p's point goes in `out`. */
function corners(
  p: Float64Array,
  i: number,
  q: Float64Array,
  j: number,
  best: number,
  out: Float64Array,
  side: 0 | 3,
): number {
  const x = q[j]!;
  const y = q[j + 1]!;
  const z = q[j + 2]!;
  const ux = q[j + 3]! - x;
  const uy = q[j + 4]! - y;
  const uz = q[j + 5]! - z;
  const vx = q[j + 6]! - x;
  const vy = q[j + 7]! - y;
  const vz = q[j + 8]! - z;
  const nx = uy * vz - uz * vy;
  const ny = uz * vx - ux * vz;
  const nz = ux * vy - uy * vx;
  const nn = nx * nx + ny * ny + nz * nz;
  if (nn === 0) return best;
  for (let c = i; c < i + 9; c += 3) {
    const dx = p[c]! - x;
    const dy = p[c + 1]! - y;
    const dz = p[c + 2]! - z;
    const height = nx * dx + ny * dy + nz * dz;
    const squared = (height * height) / nn;
    if (squared >= best) continue;
    // Barycentric weights times nn: (d × v)·n and (u × d)·n.
    const s = (dy * vz - dz * vy) * nx + (dz * vx - dx * vz) * ny + (dx * vy - dy * vx) * nz;
    const t = (uy * dz - uz * dy) * nx + (uz * dx - ux * dz) * ny + (ux * dy - uy * dx) * nz;
    if (s < 0 || t < 0 || s + t > nn) continue;
    best = squared;
    const other = 3 - side;
    out[side] = p[c]!;
    out[side + 1] = p[c + 1]!;
    out[side + 2] = p[c + 2]!;
    out[other] = p[c]! - (nx * height) / nn;
    out[other + 1] = p[c + 1]! - (ny * height) / nn;
    out[other + 2] = p[c + 2]! - (nz * height) / nn;
  }
  return best;
}

/** Where an edge of p goes through the face of q; both halves of `out` receive the point. */
function crossing(p: Float64Array, i: number, q: Float64Array, j: number, out: Float64Array): boolean {
  const x = q[j]!;
  const y = q[j + 1]!;
  const z = q[j + 2]!;
  const ux = q[j + 3]! - x;
  const uy = q[j + 4]! - y;
  const uz = q[j + 5]! - z;
  const vx = q[j + 6]! - x;
  const vy = q[j + 7]! - y;
  const vz = q[j + 8]! - z;
  const nx = uy * vz - uz * vy;
  const ny = uz * vx - ux * vz;
  const nz = ux * vy - uy * vx;
  const nn = nx * nx + ny * ny + nz * nz;
  for (let e = 0; e < 3; e++) {
    const from = i + 3 * e;
    const to = i + 3 * (e === 2 ? 0 : e + 1);
    const ax = p[from]! - x;
    const ay = p[from + 1]! - y;
    const az = p[from + 2]! - z;
    const bx = p[to]! - x;
    const by = p[to + 1]! - y;
    const bz = p[to + 2]! - z;
    const ha = nx * ax + ny * ay + nz * az;
    const hb = nx * bx + ny * by + nz * bz;
    if (ha > 0 === hb > 0 || ha === hb) continue;
    const w = ha / (ha - hb);
    const dx = ax + w * (bx - ax);
    const dy = ay + w * (by - ay);
    const dz = az + w * (bz - az);
    const s = (dy * vz - dz * vy) * nx + (dz * vx - dx * vz) * ny + (dx * vy - dy * vx) * nz;
    const t = (uy * dz - uz * dy) * nx + (uz * dx - ux * dz) * ny + (ux * dy - uy * dx) * nz;
    if (s < 0 || t < 0 || s + t > nn) continue;
    out[0] = out[3] = x + dx;
    out[1] = out[4] = y + dy;
    out[2] = out[5] = z + dz;
    return true;
  }
  return false;
}
