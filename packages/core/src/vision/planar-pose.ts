import { solveSymmetric } from "../spatial/symmetric.ts";

/**
 * Pose of a plane from points on it. Two poses can explain one picture of a plane; both are found, refined and judged.
 * Nothing is allocated once a solver is made.
 */

/** A pose as the solver writes it: rotation row by row, then where the plane's origin is [m], and how well it fits. */
export interface PlanarPose {
  /** cameraFromPlane, row by row; camera x right, y down, z forward. */
  readonly rotation: Float64Array;
  readonly position: Float64Array;
  /** Root mean square of the points' errors, as directions (multiply by the focal length for pixels). */
  error: number;
}

const MAX_STEPS = 12;

export class PlanarPoseSolver {
  /** The pose that fits best, and the other one; borrowed: the next call writes them again. */
  readonly best: PlanarPose = newPose();
  readonly other: PlanarPose = newPose();
  readonly #H = new Float64Array(9);
  readonly #Rv = new Float64Array(9);
  readonly #normal = new Float64Array(36);
  readonly #right = new Float64Array(6);
  readonly #trial = newPose();

  /**
   * The two poses of a square, by infinitesimal plane-based pose estimation, each refined to the least reprojection
   * error.
   *
   * @param corners directions x/z, y/z of the corners: top left, top right, bottom right, bottom left of the upright
   *   square, 8 numbers
   * @param side_m the square's side
   * @param plane  the corners in the square's frame (x right, y up, z out of it), 8 numbers [m]
   * @returns whether the corners are a square's at all
   * @see Collins and Bartoli, Infinitesimal plane-based pose estimation, IJCV 109(3) 2014.
   */
  square(corners: Float64Array, side_m: number, plane: Float64Array): boolean {
    const H = this.#H;
    if (!squareHomography(corners, side_m, H)) return false;
    if (!this.#fromHomography(H)) return false;
    for (const pose of [this.best, this.other]) {
      placeByRotation(pose, corners, plane, 4, this.#right);
      this.refine(pose, corners, plane, 4);
    }
    if (this.other.error < this.best.error) swap(this.best, this.other);
    return Number.isFinite(this.best.error) && this.best.position[2]! > 0;
  }

  /**
   * Refines a pose to the least sum of squared direction errors (Levenberg–Marquardt, turn about the plane's origin).
   *
   * @param seen  directions x/z, y/z, two numbers a point
   * @param plane the points in the plane's frame, x and y [m], two numbers a point
   */
  refine(pose: PlanarPose, seen: Float64Array, plane: Float64Array, count: number): void {
    let cost = costOf(pose, seen, plane, count);
    let damping = 1e-4;
    for (let step = 0; step < MAX_STEPS; step++) {
      this.#linearise(pose, seen, plane, count);
      for (let i = 0; i < 6; i++) this.#normal[7 * i]! *= 1 + damping;
      if (!solveSymmetric(this.#normal, this.#right, 6)) break;
      moved(pose, this.#right, this.#trial);
      const next = costOf(this.#trial, seen, plane, count);
      if (next < cost) {
        const gain = cost - next;
        copy(this.#trial, pose);
        cost = next;
        damping = Math.max(1e-12, damping * 0.1);
        if (gain < 1e-9 * cost) break;
      } else {
        damping *= 10;
        if (damping > 1e6) break;
      }
    }
    pose.error = Math.sqrt(cost / count);
  }

  #linearise(pose: PlanarPose, seen: Float64Array, plane: Float64Array, count: number): void {
    const A = this.#normal.fill(0);
    const b = this.#right.fill(0);
    const { rotation: R, position: t } = pose;
    for (let i = 0; i < count; i++) {
      const x = plane[2 * i]!;
      const y = plane[2 * i + 1]!;
      const rx = R[0]! * x + R[1]! * y;
      const ry = R[3]! * x + R[4]! * y;
      const rz = R[6]! * x + R[7]! * y;
      const w = 1 / (rz + t[2]!);
      const u = (rx + t[0]!) * w;
      const v = (ry + t[1]!) * w;
      // d(u, v) / d(turn, shift); the turned point moves by turn × r.
      accumulate(A, b, -u * ry * w, (rz + u * rx) * w, -ry * w, w, 0, -u * w, seen[2 * i]! - u);
      accumulate(A, b, -(rz + v * ry) * w, v * rx * w, rx * w, 0, w, -v * w, seen[2 * i + 1]! - v);
    }
  }

  /** Both rotations of the plane from its homography, scaled so that H[8] = 1. */
  #fromHomography(H: Float64Array): boolean {
    const p = H[2]!;
    const q = H[5]!;
    const j00 = H[0]! - H[6]! * p;
    const j01 = H[1]! - H[7]! * p;
    const j10 = H[3]! - H[6]! * q;
    const j11 = H[4]! - H[7]! * q;
    const Rv = this.#Rv;
    turnZTo(p, q, Rv);
    const b00 = Rv[0]! - p * Rv[6]!;
    const b01 = Rv[1]! - p * Rv[7]!;
    const b10 = Rv[3]! - q * Rv[6]!;
    const b11 = Rv[4]! - q * Rv[7]!;
    const det = b00 * b11 - b01 * b10;
    const a00 = (b11 * j00 - b01 * j10) / det;
    const a01 = (b11 * j01 - b01 * j11) / det;
    const a10 = (b00 * j10 - b10 * j00) / det;
    const a11 = (b00 * j11 - b10 * j01) / det;
    const s00 = a00 * a00 + a10 * a10;
    const s11 = a01 * a01 + a11 * a11;
    const s01 = a00 * a01 + a10 * a11;
    const gamma = Math.sqrt(0.5 * (s00 + s11 + Math.sqrt((s00 - s11) ** 2 + 4 * s01 * s01)));
    if (!(gamma > 1e-12)) return false;
    const b0 = Math.sqrt(Math.max(0, 1 - s00 / (gamma * gamma)));
    const b1 = Math.sqrt(Math.max(0, 1 - s11 / (gamma * gamma))) * (s01 > 0 ? -1 : 1);
    columns(Rv, a00 / gamma, a10 / gamma, b0, a01 / gamma, a11 / gamma, b1, this.best.rotation);
    columns(Rv, a00 / gamma, a10 / gamma, -b0, a01 / gamma, a11 / gamma, -b1, this.other.rotation);
    return true;
  }
}

const newPose = (): PlanarPose => ({ rotation: new Float64Array(9), position: new Float64Array(3), error: Infinity });

function copy(from: PlanarPose, into: PlanarPose): void {
  into.rotation.set(from.rotation);
  into.position.set(from.position);
  into.error = from.error;
}

function swap(a: PlanarPose, b: PlanarPose): void {
  for (let i = 0; i < 9; i++) {
    const kept = a.rotation[i]!;
    a.rotation[i] = b.rotation[i]!;
    b.rotation[i] = kept;
  }
  for (let i = 0; i < 3; i++) {
    const kept = a.position[i]!;
    a.position[i] = b.position[i]!;
    b.position[i] = kept;
  }
  const kept = a.error;
  a.error = b.error;
  b.error = kept;
}

/**
 * The homography that takes points of a centred, upright square [m] to their directions; H[8] = 1.
 *
 * @returns false when three of the corners lie in one line
 */
export function squareHomography(corners: Float64Array, side_m: number, H: Float64Array): boolean {
  const x0 = corners[0]!;
  const y0 = corners[1]!;
  const x1 = corners[2]!;
  const y1 = corners[3]!;
  const x2 = corners[4]!;
  const y2 = corners[5]!;
  const x3 = corners[6]!;
  const y3 = corners[7]!;
  const dx1 = x1 - x2;
  const dx2 = x3 - x2;
  const dx3 = x0 - x1 + x2 - x3;
  const dy1 = y1 - y2;
  const dy2 = y3 - y2;
  const dy3 = y0 - y1 + y2 - y3;
  const det = dx1 * dy2 - dx2 * dy1;
  if (Math.abs(det) < 1e-14) return false;
  const g = (dx3 * dy2 - dx2 * dy3) / det;
  const h = (dx1 * dy3 - dx3 * dy1) / det;
  // From s, t of the unit square (t down) to metres about the centre (y up): s = x / side + 1/2, t = 1/2 − y / side.
  const a = x1 - x0 + g * x1;
  const b = x3 - x0 + h * x3;
  const d = y1 - y0 + g * y1;
  const e = y3 - y0 + h * y3;
  const w = 1 + (g + h) / 2;
  if (Math.abs(w) < 1e-9) return false;
  H[0] = a / side_m / w;
  H[1] = -b / side_m / w;
  H[2] = (x0 + (a + b) / 2) / w;
  H[3] = d / side_m / w;
  H[4] = -e / side_m / w;
  H[5] = (y0 + (d + e) / 2) / w;
  H[6] = g / side_m / w;
  H[7] = -h / side_m / w;
  H[8] = 1;
  return true;
}

/** The least turn that brings z to the direction (p, q, 1). */
function turnZTo(p: number, q: number, R: Float64Array): void {
  const n = Math.sqrt(1 + p * p + q * q);
  const x = p / n;
  const y = q / n;
  const z = 1 / n;
  const k = 1 / (1 + z);
  R[0] = 1 - x * x * k;
  R[1] = -x * y * k;
  R[2] = x;
  R[3] = -x * y * k;
  R[4] = 1 - y * y * k;
  R[5] = y;
  R[6] = -x;
  R[7] = -y;
  R[8] = z;
}

/** out = Rv · [c1 c2 c1 × c2], with c1 and c2 made square to each other first. */
function columns(
  Rv: Float64Array,
  ax: number,
  ay: number,
  az: number,
  bx: number,
  by: number,
  bz: number,
  out: Float64Array,
): void {
  const along = 1 / Math.sqrt(ax * ax + ay * ay + az * az);
  const ux = ax * along;
  const uy = ay * along;
  const uz = az * along;
  const dot = ux * bx + uy * by + uz * bz;
  let vx = bx - dot * ux;
  let vy = by - dot * uy;
  let vz = bz - dot * uz;
  const across = 1 / Math.sqrt(vx * vx + vy * vy + vz * vz);
  vx *= across;
  vy *= across;
  vz *= across;
  const wx = uy * vz - uz * vy;
  const wy = uz * vx - ux * vz;
  const wz = ux * vy - uy * vx;
  for (let row = 0; row < 3; row++) {
    const r0 = Rv[3 * row]!;
    const r1 = Rv[3 * row + 1]!;
    const r2 = Rv[3 * row + 2]!;
    out[3 * row] = r0 * ux + r1 * uy + r2 * uz;
    out[3 * row + 1] = r0 * vx + r1 * vy + r2 * vz;
    out[3 * row + 2] = r0 * wx + r1 * wy + r2 * wz;
  }
}

/** The position for a known rotation: least squares of t_x − u t_z = u r_z − r_x and the same for v. */
function placeByRotation(
  pose: PlanarPose,
  seen: Float64Array,
  plane: Float64Array,
  count: number,
  scratch: Float64Array,
): void {
  const R = pose.rotation;
  let su = 0;
  let sv = 0;
  let suv = 0;
  const b = scratch.fill(0);
  for (let i = 0; i < count; i++) {
    const x = plane[2 * i]!;
    const y = plane[2 * i + 1]!;
    const u = seen[2 * i]!;
    const v = seen[2 * i + 1]!;
    const rz = R[6]! * x + R[7]! * y;
    const eu = u * rz - (R[0]! * x + R[1]! * y);
    const ev = v * rz - (R[3]! * x + R[4]! * y);
    su += u;
    sv += v;
    suv += u * u + v * v;
    b[0]! += eu;
    b[1]! += ev;
    b[2]! -= u * eu + v * ev;
  }
  const z = (b[2]! + (su * b[0]! + sv * b[1]!) / count) / (suv - (su * su + sv * sv) / count);
  pose.position[0] = (b[0]! + su * z) / count;
  pose.position[1] = (b[1]! + sv * z) / count;
  pose.position[2] = z;
}

function costOf({ rotation: R, position: t }: PlanarPose, seen: Float64Array, plane: Float64Array, n: number): number {
  let sum = 0;
  for (let i = 0; i < n; i++) {
    const x = plane[2 * i]!;
    const y = plane[2 * i + 1]!;
    const z = R[6]! * x + R[7]! * y + t[2]!;
    if (!(z > 1e-6)) return Infinity;
    const du = (R[0]! * x + R[1]! * y + t[0]!) / z - seen[2 * i]!;
    const dv = (R[3]! * x + R[4]! * y + t[1]!) / z - seen[2 * i + 1]!;
    sum += du * du + dv * dv;
  }
  return sum;
}

const row = new Float64Array(6);
function accumulate(
  A: Float64Array,
  b: Float64Array,
  a0: number,
  a1: number,
  a2: number,
  a3: number,
  a4: number,
  a5: number,
  residual: number,
): void {
  row[0] = a0;
  row[1] = a1;
  row[2] = a2;
  row[3] = a3;
  row[4] = a4;
  row[5] = a5;
  for (let i = 0; i < 6; i++) {
    b[i]! += row[i]! * residual;
    for (let j = 0; j <= i; j++) A[6 * i + j]! += row[i]! * row[j]!;
  }
}

/** into = exp(turn) · rotation, position + shift. */
function moved(pose: PlanarPose, by: Float64Array, into: PlanarPose): void {
  const x = by[0]!;
  const y = by[1]!;
  const z = by[2]!;
  const angle = Math.sqrt(x * x + y * y + z * z);
  const s = angle < 1e-9 ? 1 : Math.sin(angle) / angle;
  const c = angle < 1e-9 ? 0.5 : (1 - Math.cos(angle)) / (angle * angle);
  const R = pose.rotation;
  for (let column = 0; column < 3; column++) {
    const a = R[column]!;
    const b = R[3 + column]!;
    const d = R[6 + column]!;
    const wx = y * d - z * b;
    const wy = z * a - x * d;
    const wz = x * b - y * a;
    into.rotation[column] = a + s * wx + c * (y * wz - z * wy);
    into.rotation[3 + column] = b + s * wy + c * (z * wx - x * wz);
    into.rotation[6 + column] = d + s * wz + c * (x * wy - y * wx);
  }
  for (let i = 0; i < 3; i++) into.position[i] = pose.position[i]! + by[3 + i]!;
}
