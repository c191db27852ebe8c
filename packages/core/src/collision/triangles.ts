/** Where corners, edges and normals of the triangles p and q begin in `CORNERS`; the corner p0 is the origin. */
const P1 = 0;
const P2 = 3;
/** Edge from p1 to p2; those from p0 are p1 and p2 themselves. */
const P12 = 6;
const Q0 = 9;
const Q1 = 12;
const Q2 = 15;
const Q01 = 18;
const Q02 = 21;
const Q12 = 24;
const NORMAL_P = 27;
const NORMAL_Q = 30;
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

  CORNERS[P1] = ax;
  CORNERS[P1 + 1] = ay;
  CORNERS[P1 + 2] = az;
  CORNERS[P2] = bx;
  CORNERS[P2 + 1] = by;
  CORNERS[P2 + 2] = bz;
  CORNERS[P12] = bx - ax;
  CORNERS[P12 + 1] = by - ay;
  CORNERS[P12 + 2] = bz - az;
  CORNERS[Q0] = dx;
  CORNERS[Q0 + 1] = dy;
  CORNERS[Q0 + 2] = dz;
  CORNERS[Q1] = ex;
  CORNERS[Q1 + 1] = ey;
  CORNERS[Q1 + 2] = ez;
  CORNERS[Q2] = fx;
  CORNERS[Q2 + 1] = fy;
  CORNERS[Q2 + 2] = fz;
  CORNERS[Q01] = gx;
  CORNERS[Q01 + 1] = gy;
  CORNERS[Q01 + 2] = gz;
  CORNERS[Q02] = hx;
  CORNERS[Q02 + 1] = hy;
  CORNERS[Q02 + 2] = hz;
  CORNERS[Q12] = fx - ex;
  CORNERS[Q12 + 1] = fy - ey;
  CORNERS[Q12 + 2] = fz - ez;
  CORNERS[NORMAL_P] = nx;
  CORNERS[NORMAL_P + 1] = ny;
  CORNERS[NORMAL_P + 2] = nz;
  CORNERS[NORMAL_Q] = mx;
  CORNERS[NORMAL_Q + 1] = my;
  CORNERS[NORMAL_Q + 2] = mz;
  return !(edgesApart() || inPlaneApart());
}

/** Products of edges. An axis across edge e of p and edge f of q sees p as two values and q as two values. */
const edgesApart = (): boolean =>
  apart(P1, Q01, P2, P2, Q0, Q2, Q0) ||
  apart(P1, Q02, P2, P2, Q0, Q1, Q0) ||
  apart(P1, Q12, P2, P2, Q1, Q0, Q1) ||
  apart(P2, Q01, P1, P1, Q0, Q2, Q0) ||
  apart(P2, Q02, P1, P1, Q0, Q1, Q0) ||
  apart(P2, Q12, P1, P1, Q1, Q0, Q1) ||
  apart(P12, Q01, P1, P1, Q0, Q2, Q0) ||
  apart(P12, Q02, P1, P1, Q0, Q1, Q0) ||
  apart(P12, Q12, P1, P1, Q1, Q0, Q1);

/** Normals of edges in the plane of their triangle, for triangles in one plane. */
const inPlaneApart = (): boolean =>
  apart(NORMAL_P, P1, P2, P2, Q0, Q1, Q2) ||
  apart(NORMAL_P, P2, P1, P1, Q0, Q1, Q2) ||
  apart(NORMAL_P, P12, P2, P2, Q0, Q1, Q2) ||
  apart(NORMAL_Q, Q01, P1, P2, Q0, Q2, Q0) ||
  apart(NORMAL_Q, Q02, P1, P2, Q0, Q1, Q0) ||
  apart(NORMAL_Q, Q12, P1, P2, Q1, Q0, Q1);

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
