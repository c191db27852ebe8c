import type { TagDetector } from "./detector.ts";
import type { MarkerSheet } from "./sheet.ts";
import { assumedLens, distort, type Lens } from "./lens.ts";
import { solveSymmetric } from "../spatial/symmetric.ts";
import { type PlanarPose, PlanarPoseSolver } from "./planar-pose.ts";

/** What one picture shows of a flat board: the same number of pairs in both. */
export interface BoardView {
  /** Where points are seen, u, v, two numbers a point [px]. */
  readonly pixels: Float64Array;
  /** Where they are on the board, x, y, two numbers a point [m]; four to a tag, top left first, clockwise. */
  readonly board: Float64Array;
  /** The side of a tag [m]: the first four points of the view are one. */
  readonly side_m: number;
}

export type LensCalibration =
  | {
      readonly kind: "calibrated";
      readonly lens: Lens;
      /** Root mean square distance of all points from where the lens puts them [px]. */
      readonly rms_px: number;
      /** One standard deviation of the focal length [px], from the covariance of the fit. */
      readonly focal_px: number;
      readonly sentence: string;
    }
  | { readonly kind: "too-few"; readonly views: number; readonly sentence: string }
  /** The views do not tell the focal length: tilt the board more. */
  | { readonly kind: "too-flat"; readonly focal_px: number; readonly sentence: string }
  /** The points do not fit any lens: the board is not flat, or not printed at 100 %. */
  | { readonly kind: "poor"; readonly rms_px: number; readonly sentence: string };

export const MIN_VIEWS = 5;
const INNER = 6;
const MAX_STEPS = 60;
/** The focal length must be known to this share. */
const MAX_FOCAL_SHARE = 0.01;
const MAX_RMS_PX = 1;
const FIRST_ANGLES_RAD = [0.85, 1.15, 1.5] as const;

/**
 * The lens of a camera from views of a flat board: fx, fy, cx, cy, k1, k2 and a pose for each view with the least sum
 * of squared pixel errors (Levenberg–Marquardt, from three angles of view).
 *
 * @param width of the pictures [px] @param height of the pictures [px]
 * @see Zhang, A flexible new technique for camera calibration, IEEE PAMI 22(11) 2000.
 */
export function calibrateLens(width: number, height: number, views: readonly BoardView[]): LensCalibration {
  if (views.length < MIN_VIEWS)
    return {
      kind: "too-few",
      views: views.length,
      sentence: `${MIN_VIEWS} views of the board are the least; ${views.length} were given.`,
    };
  let best: Fit | null = null;
  for (const angle of FIRST_ANGLES_RAD) {
    const fit = fitFrom(assumedLens(width, height, angle), views);
    if (fit && (best === null || fit.cost < best.cost)) best = fit;
  }
  if (best === null)
    return {
      kind: "poor",
      rms_px: Infinity,
      sentence: "The views fit no lens. Print the board at 100 % and keep it flat.",
    };
  const points = views.reduce((sum, { pixels }) => sum + pixels.length / 2, 0);
  const rms_px = Math.sqrt(best.cost / points);
  if (rms_px > MAX_RMS_PX)
    return {
      kind: "poor",
      rms_px,
      sentence: `The points miss by ${rms_px.toFixed(2)} px; ${MAX_RMS_PX} px is allowed. Keep the board flat and still.`,
    };
  const freedom = Math.max(1, 2 * points - INNER - 6 * views.length);
  const focal_px = Math.sqrt((best.focalVariance * best.cost) / freedom);
  const share = focal_px / best.lens.fx;
  if (!(share < MAX_FOCAL_SHARE))
    return {
      kind: "too-flat",
      focal_px,
      sentence: `The focal length is known to ${(100 * share).toFixed(1)} %; 1 % is needed. Tilt the board by 20° to 40° in different directions.`,
    };
  return {
    kind: "calibrated",
    lens: best.lens,
    rms_px,
    focal_px,
    sentence: `Calibrated from ${views.length} views: ${rms_px.toFixed(2)} px root mean square, focal length ${best.lens.fx.toFixed(0)} ± ${(2 * focal_px).toFixed(1)} px.`,
  };
}

interface Fit {
  readonly lens: Lens;
  readonly cost: number;
  /** Of fx for a pixel error of 1. */
  readonly focalVariance: number;
}

function fitFrom(first: Lens, views: readonly BoardView[]): Fit | null {
  const n = INNER + 6 * views.length;
  let lens = first;
  const poses = views.map(view => firstPose(first, view));
  if (poses.some(pose => pose === null)) return null;
  let known = poses as PlanarPose[];
  const A = new Float64Array(n * n);
  const b = new Float64Array(n);
  const kept = new Float64Array(n * n);
  let cost = linearise(lens, known, views, A, b, n);
  let damping = 1e-3;
  for (let step = 0; step < MAX_STEPS; step++) {
    kept.set(A);
    const gradient = b.slice();
    for (let i = 0; i < n; i++) A[n * i + i]! *= 1 + damping;
    if (!solveSymmetric(A, b, n)) return null;
    const nextLens = movedLens(lens, b);
    const nextPoses = known.map((pose, i) => movedPose(pose, b, INNER + 6 * i));
    const next = linearise(nextLens, nextPoses, views, A, b, n);
    if (next < cost) {
      const gain = cost - next;
      lens = nextLens;
      known = nextPoses;
      cost = next;
      damping = Math.max(1e-10, damping * 0.1);
      if (gain < 1e-9 * cost) break;
    } else {
      A.set(kept);
      b.set(gradient);
      damping *= 10;
      if (damping > 1e8) break;
    }
  }
  linearise(lens, known, views, A, b, n);
  b.fill(0);
  b[0] = 1;
  const solved = solveSymmetric(A, b, n);
  // Focal lengths were moved as shares of themselves.
  return solved && Number.isFinite(cost) ? { lens, cost, focalVariance: b[0] * lens.fx * lens.fx } : null;
}

function firstPose(lens: Lens, { pixels, board, side_m }: BoardView): PlanarPose | null {
  const seen = new Float64Array(pixels.length);
  for (let i = 0; i < pixels.length; i += 2) {
    seen[i] = (pixels[i]! - lens.cx) / lens.fx;
    seen[i + 1] = (pixels[i + 1]! - lens.cy) / lens.fy;
  }
  const cx = (board[0]! + board[4]!) / 2;
  const cy = (board[1]! + board[5]!) / 2;
  const square = board.slice(0, 8).map((value, i) => value - (i % 2 === 0 ? cx : cy));
  const solver = new PlanarPoseSolver();
  if (!solver.square(seen.slice(0, 8), side_m, square)) return null;
  for (const pose of [solver.best, solver.other]) {
    for (let i = 0; i < 3; i++) pose.position[i]! -= pose.rotation[3 * i]! * cx + pose.rotation[3 * i + 1]! * cy;
    solver.refine(pose, seen, board, pixels.length / 2);
  }
  return solver.other.error < solver.best.error ? solver.other : solver.best;
}

/** Writes JᵀJ and Jᵀr of all pixel errors by central differences of the projection; returns the sum of squares. */
function linearise(
  lens: Lens,
  poses: readonly PlanarPose[],
  views: readonly BoardView[],
  A: Float64Array,
  b: Float64Array,
  n: number,
): number {
  A.fill(0);
  b.fill(0);
  let cost = 0;
  const at = new Float64Array(2);
  const J = new Float64Array(2 * (INNER + 6));
  for (const [k, { pixels, board }] of views.entries()) {
    const { rotation: R, position: t } = poses[k]!;
    for (let i = 0; i < pixels.length; i += 2) {
      const rx = R[0]! * board[i]! + R[1]! * board[i + 1]!;
      const ry = R[3]! * board[i]! + R[4]! * board[i + 1]!;
      const rz = R[6]! * board[i]! + R[7]! * board[i + 1]!;
      const z = rz + t[2]!;
      if (!(z > 1e-6)) return Infinity;
      const x = (rx + t[0]!) / z;
      const y = (ry + t[1]!) / z;
      distort(lens, x, y, at);
      const du = pixels[i]! - at[0]!;
      const dv = pixels[i + 1]! - at[1]!;
      cost += du * du + dv * dv;
      derivatives(lens, x, y, z, rx, ry, rz, J);
      gather(A, b, n, k, J, 0, du);
      gather(A, b, n, k, J, INNER + 6, dv);
    }
  }
  return cost;
}

/** Of u (first 12) and v (last 12) by: share of fx, share of fy, cx, cy, k1, k2, turn (3), shift (3). */
function derivatives(
  { fx, fy, k1, k2 }: Lens,
  x: number,
  y: number,
  z: number,
  rx: number,
  ry: number,
  rz: number,
  J: Float64Array,
): void {
  const r2 = x * x + y * y;
  const d = 1 + r2 * (k1 + r2 * k2);
  const slope = k1 + 2 * r2 * k2;
  const v = INNER + 6;
  J.fill(0);
  J[0] = fx * d * x;
  J[v + 1] = fy * d * y;
  J[2] = 1;
  J[v + 3] = 1;
  J[4] = fx * r2 * x;
  J[5] = fx * r2 * r2 * x;
  J[v + 4] = fy * r2 * y;
  J[v + 5] = fy * r2 * r2 * y;
  const ux = fx * (d + 2 * x * x * slope);
  const uy = fx * 2 * x * y * slope;
  const vx = fy * 2 * x * y * slope;
  const vy = fy * (d + 2 * y * y * slope);
  // d(x, y) by turn and shift of the camera point, as in the planar solver.
  const byX = [(-x * ry) / z, (rz + x * rx) / z, -ry / z, 1 / z, 0, -x / z];
  const byY = [-(rz + y * ry) / z, (y * rx) / z, rx / z, 0, 1 / z, -y / z];
  for (let i = 0; i < 6; i++) {
    J[INNER + i] = ux * byX[i]! + uy * byY[i]!;
    J[v + INNER + i] = vx * byX[i]! + vy * byY[i]!;
  }
}

function gather(
  A: Float64Array,
  b: Float64Array,
  n: number,
  view: number,
  J: Float64Array,
  from: number,
  r: number,
): void {
  const column = (i: number): number => (i < INNER ? i : INNER + 6 * view + i - INNER);
  for (let i = 0; i < INNER + 6; i++) {
    const at = column(i);
    b[at]! += J[from + i]! * r;
    for (let j = 0; j <= i; j++) A[n * at + column(j)]! += J[from + i]! * J[from + j]!;
  }
}

const movedLens = (lens: Lens, by: Float64Array): Lens => ({
  ...lens,
  fx: lens.fx * (1 + by[0]!),
  fy: lens.fy * (1 + by[1]!),
  cx: lens.cx + by[2]!,
  cy: lens.cy + by[3]!,
  k1: lens.k1 + by[4]!,
  k2: lens.k2 + by[5]!,
});

function movedPose({ rotation: R, position }: PlanarPose, by: Float64Array, at: number): PlanarPose {
  const [x, y, z] = [by[at]!, by[at + 1]!, by[at + 2]!];
  const angle = Math.hypot(x, y, z);
  const s = angle < 1e-9 ? 1 : Math.sin(angle) / angle;
  const c = angle < 1e-9 ? 0.5 : (1 - Math.cos(angle)) / (angle * angle);
  const rotation = new Float64Array(9);
  for (let column = 0; column < 3; column++) {
    const [a, b, d] = [R[column]!, R[3 + column]!, R[6 + column]!];
    const [wx, wy, wz] = [y * d - z * b, z * a - x * d, x * b - y * a];
    rotation[column] = a + s * wx + c * (y * wz - z * wy);
    rotation[3 + column] = b + s * wy + c * (z * wx - x * wz);
    rotation[6 + column] = d + s * wz + c * (x * wy - y * wx);
  }
  return { rotation, position: position.map((value, i) => value + by[at + 3 + i]!), error: 0 };
}

/**
 * The tags of a board that a detector sees now, as a view to calibrate with.
 *
 * @param lens that the detector uses: its distortion is put back
 * @returns null when none of the board's tags is seen
 */
export function boardView(detector: TagDetector, lens: Lens, board: MarkerSheet): BoardView | null {
  const pixels: number[] = [];
  const points: number[] = [];
  const at = new Float64Array(2);
  for (let i = 0; i < detector.count; i++) {
    const { id, corners } = detector.sightings[i]!;
    const tag = board.tags.find(each => each.id === id);
    if (!tag) continue;
    const half = tag.side_m / 2;
    for (let k = 0; k < 4; k++) {
      distort(lens, corners[2 * k]!, corners[2 * k + 1]!, at);
      pixels.push(at[0]!, at[1]!);
      points.push(tag.x_m + (k === 1 || k === 2 ? half : -half), tag.y_m + (k < 2 ? half : -half));
    }
  }
  const side_m = board.tags[0]?.side_m;
  return pixels.length > 0 && side_m !== undefined
    ? { pixels: Float64Array.from(pixels), board: Float64Array.from(points), side_m }
    : null;
}
