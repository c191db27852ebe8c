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

  const cx = bx - ax;
  const cy = by - ay;
  const cz = bz - az;
  const kx = fx - ex;
  const ky = fy - ey;
  const kz = fz - ez;
  // An axis across edge e of p and edge f of q sees p as (0, corner off e) and q as (corner on f, corner off f).
  return !(
    apart(ay * gz - az * gy, az * gx - ax * gz, ax * gy - ay * gx, bx, by, bz, dx, dy, dz, fx, fy, fz) ||
    apart(ay * hz - az * hy, az * hx - ax * hz, ax * hy - ay * hx, bx, by, bz, dx, dy, dz, ex, ey, ez) ||
    apart(ay * kz - az * ky, az * kx - ax * kz, ax * ky - ay * kx, bx, by, bz, ex, ey, ez, dx, dy, dz) ||
    apart(by * gz - bz * gy, bz * gx - bx * gz, bx * gy - by * gx, ax, ay, az, dx, dy, dz, fx, fy, fz) ||
    apart(by * hz - bz * hy, bz * hx - bx * hz, bx * hy - by * hx, ax, ay, az, dx, dy, dz, ex, ey, ez) ||
    apart(by * kz - bz * ky, bz * kx - bx * kz, bx * ky - by * kx, ax, ay, az, ex, ey, ez, dx, dy, dz) ||
    apart(cy * gz - cz * gy, cz * gx - cx * gz, cx * gy - cy * gx, ax, ay, az, dx, dy, dz, fx, fy, fz) ||
    apart(cy * hz - cz * hy, cz * hx - cx * hz, cx * hy - cy * hx, ax, ay, az, dx, dy, dz, ex, ey, ez) ||
    apart(cy * kz - cz * ky, cz * kx - cx * kz, cx * ky - cy * kx, ax, ay, az, ex, ey, ez, dx, dy, dz) ||
    apart(ny * az - nz * ay, nz * ax - nx * az, nx * ay - ny * ax, bx, by, bz, dx, dy, dz, ex, ey, ez, fx, fy, fz) ||
    apart(ny * bz - nz * by, nz * bx - nx * bz, nx * by - ny * bx, ax, ay, az, dx, dy, dz, ex, ey, ez, fx, fy, fz) ||
    apart(ny * cz - nz * cy, nz * cx - nx * cz, nx * cy - ny * cx, ax, ay, az, dx, dy, dz, ex, ey, ez, fx, fy, fz) ||
    apart(
      my * gz - mz * gy,
      mz * gx - mx * gz,
      mx * gy - my * gx,
      ax,
      ay,
      az,
      dx,
      dy,
      dz,
      fx,
      fy,
      fz,
      dx,
      dy,
      dz,
      bx,
      by,
      bz,
    ) ||
    apart(
      my * hz - mz * hy,
      mz * hx - mx * hz,
      mx * hy - my * hx,
      ax,
      ay,
      az,
      dx,
      dy,
      dz,
      ex,
      ey,
      ez,
      dx,
      dy,
      dz,
      bx,
      by,
      bz,
    ) ||
    apart(
      my * kz - mz * ky,
      mz * kx - mx * kz,
      mx * ky - my * kx,
      ax,
      ay,
      az,
      ex,
      ey,
      ez,
      dx,
      dy,
      dz,
      ex,
      ey,
      ez,
      bx,
      by,
      bz,
    )
  );
}

/** Whether the axis separates {0, u, w} from {v1, v2, v3}; points not given repeat earlier ones. */
function apart(
  x: number,
  y: number,
  z: number,
  ux: number,
  uy: number,
  uz: number,
  v1x: number,
  v1y: number,
  v1z: number,
  v2x: number,
  v2y: number,
  v2z: number,
  v3x = v1x,
  v3y = v1y,
  v3z = v1z,
  wx = ux,
  wy = uy,
  wz = uz,
): boolean {
  const u = x * ux + y * uy + z * uz;
  const w = x * wx + y * wy + z * wz;
  const v1 = x * v1x + y * v1y + z * v1z;
  const v2 = x * v2x + y * v2y + z * v2z;
  const v3 = x * v3x + y * v3y + z * v3z;
  const pLow = u < w ? (u < 0 ? u : 0) : w < 0 ? w : 0;
  const pHigh = u > w ? (u > 0 ? u : 0) : w > 0 ? w : 0;
  const qLow = v1 < v2 ? (v1 < v3 ? v1 : v3) : v2 < v3 ? v2 : v3;
  const qHigh = v1 > v2 ? (v1 > v3 ? v1 : v3) : v2 > v3 ? v2 : v3;
  return qLow > pHigh || qHigh < pLow;
}
