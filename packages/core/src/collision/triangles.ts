/** Where corners, edges and normals of the two triangles begin in `CORNERS`; p0 is the origin. */
const A = 0; // p1
const B = 3; // p2
const C = 6; // p1 to p2
const D = 9; // q0
const E = 12; // q1
const F = 15; // q2
const G = 18; // q0 to q1
const H = 21; // q0 to q2
const K = 24; // q1 to q2
const N = 27; // normal of p
const M = 30; // normal of q
/** Kept between the steps of one call: indices are handed on, since numbers would be allocated. */
const CORNERS = new Float64Array(33);

/**
 * Whether two triangles, surface and border included, share a point. Separating axes: both normals, the nine products
 * of edges and, for triangles in one plane, the six in-plane normals of edges. Two triangles are apart exactly when
 * one of these axes separates them; touching counts as sharing.
 *
 * @param p  three corners from index i on, @param q  three corners from index j on, in the same frame [m].
 * @see Gottschalk, Lin, Manocha, OBBTree, SIGGRAPH 1996, for the axes of polytopes.
 */
export function trianglesTouch(p: Float64Array, i: number, q: Float64Array, j: number): boolean {
  const px = p[i]!;
  const py = p[i + 1]!;
  const pz = p[i + 2]!;
  // Everything relative to p0: coordinates stay small and the first corner projects to 0.
  const ax = p[i + 3]! - px;
  const ay = p[i + 4]! - py;
  const az = p[i + 5]! - pz;
  const bx = p[i + 6]! - px;
  const by = p[i + 7]! - py;
  const bz = p[i + 8]! - pz;
  const dx = q[j]! - px;
  const dy = q[j + 1]! - py;
  const dz = q[j + 2]! - pz;
  const ex = q[j + 3]! - px;
  const ey = q[j + 4]! - py;
  const ez = q[j + 5]! - pz;
  const fx = q[j + 6]! - px;
  const fy = q[j + 7]! - py;
  const fz = q[j + 8]! - pz;

  const nx = ay * bz - az * by;
  const ny = az * bx - ax * bz;
  const nz = ax * by - ay * bx;
  const nd = nx * dx + ny * dy + nz * dz;
  const ne = nx * ex + ny * ey + nz * ez;
  const nf = nx * fx + ny * fy + nz * fz;
  if ((nd > 0 && ne > 0 && nf > 0) || (nd < 0 && ne < 0 && nf < 0)) return false;

  const gx = ex - dx;
  const gy = ey - dy;
  const gz = ez - dz;
  const hx = fx - dx;
  const hy = fy - dy;
  const hz = fz - dz;
  const mx = gy * hz - gz * hy;
  const my = gz * hx - gx * hz;
  const mz = gx * hy - gy * hx;
  const md = mx * dx + my * dy + mz * dz;
  const ma = mx * ax + my * ay + mz * az;
  const mb = mx * bx + my * by + mz * bz;
  if ((md < 0 && ma > md && mb > md) || (md > 0 && ma < md && mb < md)) return false;

  CORNERS[A] = ax;
  CORNERS[A + 1] = ay;
  CORNERS[A + 2] = az;
  CORNERS[B] = bx;
  CORNERS[B + 1] = by;
  CORNERS[B + 2] = bz;
  CORNERS[C] = bx - ax;
  CORNERS[C + 1] = by - ay;
  CORNERS[C + 2] = bz - az;
  CORNERS[D] = dx;
  CORNERS[D + 1] = dy;
  CORNERS[D + 2] = dz;
  CORNERS[E] = ex;
  CORNERS[E + 1] = ey;
  CORNERS[E + 2] = ez;
  CORNERS[F] = fx;
  CORNERS[F + 1] = fy;
  CORNERS[F + 2] = fz;
  CORNERS[G] = gx;
  CORNERS[G + 1] = gy;
  CORNERS[G + 2] = gz;
  CORNERS[H] = hx;
  CORNERS[H + 1] = hy;
  CORNERS[H + 2] = hz;
  CORNERS[K] = fx - ex;
  CORNERS[K + 1] = fy - ey;
  CORNERS[K + 2] = fz - ez;
  CORNERS[N] = nx;
  CORNERS[N + 1] = ny;
  CORNERS[N + 2] = nz;
  CORNERS[M] = mx;
  CORNERS[M + 1] = my;
  CORNERS[M + 2] = mz;
  return !(edgesApart() || inPlaneApart());
}

/** Products of edges. An axis across edge e of p and edge f of q sees p as two values and q as two values. */
const edgesApart = (): boolean =>
  apart(A, G, B, B, D, F, D) ||
  apart(A, H, B, B, D, E, D) ||
  apart(A, K, B, B, E, D, E) ||
  apart(B, G, A, A, D, F, D) ||
  apart(B, H, A, A, D, E, D) ||
  apart(B, K, A, A, E, D, E) ||
  apart(C, G, A, A, D, F, D) ||
  apart(C, H, A, A, D, E, D) ||
  apart(C, K, A, A, E, D, E);

/** Normals of edges in the plane of their triangle, for triangles in one plane. */
const inPlaneApart = (): boolean =>
  apart(N, A, B, B, D, E, F) ||
  apart(N, B, A, A, D, E, F) ||
  apart(N, C, B, B, D, E, F) ||
  apart(M, G, A, B, D, F, D) ||
  apart(M, H, A, B, D, E, D) ||
  apart(M, K, A, B, E, D, E);

/** Whether the axis first × second separates {0, u, w} from {v1, v2, v3}; all are places in `CORNERS`. */
function apart(first: number, second: number, u: number, w: number, v1: number, v2: number, v3: number): boolean {
  const t = CORNERS;
  const x = t[first + 1]! * t[second + 2]! - t[first + 2]! * t[second + 1]!;
  const y = t[first + 2]! * t[second]! - t[first]! * t[second + 2]!;
  const z = t[first]! * t[second + 1]! - t[first + 1]! * t[second]!;
  const pu = x * t[u]! + y * t[u + 1]! + z * t[u + 2]!;
  const pw = x * t[w]! + y * t[w + 1]! + z * t[w + 2]!;
  const q1 = x * t[v1]! + y * t[v1 + 1]! + z * t[v1 + 2]!;
  const q2 = x * t[v2]! + y * t[v2 + 1]! + z * t[v2 + 2]!;
  const q3 = x * t[v3]! + y * t[v3 + 1]! + z * t[v3 + 2]!;
  const pLow = pu < pw ? (pu < 0 ? pu : 0) : pw < 0 ? pw : 0;
  const pHigh = pu > pw ? (pu > 0 ? pu : 0) : pw > 0 ? pw : 0;
  const qLow = q1 < q2 ? (q1 < q3 ? q1 : q3) : q2 < q3 ? q2 : q3;
  const qHigh = q1 > q2 ? (q1 > q3 ? q1 : q3) : q2 > q3 ? q2 : q3;
  return qLow > pHigh || qHigh < pLow;
}
