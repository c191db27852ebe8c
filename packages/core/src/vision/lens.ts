/**
 * What a camera's lens does, in pixels of a picture of `width` × `height`; pixel centres have whole coordinates, u to
 * the right, v down. A direction x/z, y/z in the camera (x right, y down, z forward) falls on
 *
 *   r² = (x/z)² + (y/z)²,   d = 1 + k1 r² + k2 r⁴,   u = fx d x/z + cx,   v = fy d y/z + cy
 */
export interface Lens {
  readonly width: number;
  readonly height: number;
  readonly fx: number;
  readonly fy: number;
  readonly cx: number;
  readonly cy: number;
  readonly k1: number;
  readonly k2: number;
}

/**
 * A lens that was not calibrated: no distortion, centre in the middle.
 *
 * @param width  of the picture [px]
 * @param height of the picture [px]
 * @param long_rad angle of view along the longer side; phones and laptop cameras have 60° to 75°
 */
export function assumedLens(width: number, height: number, long_rad: number = (66 * Math.PI) / 180): Lens {
  const f = Math.max(width, height) / 2 / Math.tan(long_rad / 2);
  return { width, height, fx: f, fy: f, cx: (width - 1) / 2, cy: (height - 1) / 2, k1: 0, k2: 0 };
}

/**
 * The same lens for a picture of another size with the same shape: pixel centres have whole coordinates, so the centre
 * moves by half a pixel before and after it is scaled.
 */
export function scaledLens(lens: Lens, width: number, height: number): Lens {
  const sx = width / lens.width;
  const sy = height / lens.height;
  return {
    ...lens,
    width,
    height,
    fx: lens.fx * sx,
    fy: lens.fy * sy,
    cx: (lens.cx + 0.5) * sx - 0.5,
    cy: (lens.cy + 0.5) * sy - 0.5,
  };
}

/** Where a direction (x/z, y/z) is seen [px], written to out[0], out[1]. */
export function distort(lens: Lens, x: number, y: number, out: Float64Array): void {
  const r2 = x * x + y * y;
  const d = 1 + r2 * (lens.k1 + r2 * lens.k2);
  out[0] = lens.fx * d * x + lens.cx;
  out[1] = lens.fy * d * y + lens.cy;
}

/** Steps of the fixed-point iteration: with |k1| ≤ 0.4 at the picture's edge it is at 1e-9 by then. */
const STEPS = 24;

/** The direction (x/z, y/z) that is seen at a pixel, written to out[0], out[1]. Inverse of `distort`. */
export function undistort(lens: Lens, u: number, v: number, out: Float64Array): void {
  const xd = (u - lens.cx) / lens.fx;
  const yd = (v - lens.cy) / lens.fy;
  let x = xd;
  let y = yd;
  if (lens.k1 !== 0 || lens.k2 !== 0)
    for (let i = 0; i < STEPS; i++) {
      const r2 = x * x + y * y;
      const d = 1 + r2 * (lens.k1 + r2 * lens.k2);
      const nextX = xd / d;
      const nextY = yd / d;
      const moved = Math.abs(nextX - x) + Math.abs(nextY - y);
      x = nextX;
      y = nextY;
      if (moved < 1e-10) break;
    }
  out[0] = x;
  out[1] = y;
}
