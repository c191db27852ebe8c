/** A point of a profile or of an outline [m]. */
export type Point2 = readonly [number, number];

/**
 * A closed convex curve, counter-clockwise, that can be drawn moved inwards by `inset_m`.
 * Every inset has the same number of points, so that neighbouring ones can be joined by quads.
 */
export type Outline = (inset_m: number) => Point2[];

/** Rounded drawings lie inside the true curve; a wall that must enclose them lies outside. */
export type Fit = "inside" | "around";

const circleFactor = (steps: number, span_rad: number, fit: Fit): number =>
  fit === "around" ? 1 / Math.cos(span_rad / steps / 2) : 1;

function arc(
  out: Point2[],
  centre: Point2,
  radius_m: number,
  from_rad: number,
  to_rad: number,
  steps: number,
  fit: Fit,
): void {
  const r = radius_m * circleFactor(steps, to_rad - from_rad, fit);
  for (let i = 0; i <= steps; i++) {
    const angle = from_rad + ((to_rad - from_rad) * i) / steps;
    out.push([centre[0] + r * Math.cos(angle), centre[1] + r * Math.sin(angle)]);
  }
}

export function circle(radius_m: number, sides = 48, fit: Fit = "inside", centre: Point2 = [0, 0]): Outline {
  const factor = circleFactor(sides, 2 * Math.PI, fit);
  return inset_m =>
    Array.from({ length: sides }, (_, i) => {
      const angle = (2 * Math.PI * (i + 0.5)) / sides;
      const r = (radius_m - inset_m) * factor;
      return [centre[0] + r * Math.cos(angle), centre[1] + r * Math.sin(angle)] as const;
    });
}

/** Convex hull of two circles; the side of a robot arm. Needs |a − b| > |ra − rb|. */
export function stadium(a: Point2, ra_m: number, b: Point2, rb_m: number, steps = 20, fit: Fit = "inside"): Outline {
  const dx = b[0] - a[0];
  const dy = b[1] - a[1];
  const along = Math.atan2(dy, dx);
  const tangent = Math.acos((ra_m - rb_m) / Math.sqrt(dx * dx + dy * dy));
  return inset_m => {
    const points: Point2[] = [];
    arc(points, a, ra_m - inset_m, along + tangent, along + 2 * Math.PI - tangent, steps, fit);
    arc(points, b, rb_m - inset_m, along - tangent, along + tangent, steps, fit);
    return points;
  };
}

/**
 * Rectangle 2·halfU × 2·halfV with round corners. A radius of both halves is a circle with the same number of points.
 */
export function roundedRectangle(
  halfU_m: number,
  halfV_m: number,
  radius_m: number,
  centre: Point2 = [0, 0],
  steps = 11,
  fit: Fit = "inside",
): Outline {
  return inset_m => {
    const points: Point2[] = [];
    const hu = halfU_m - radius_m;
    const hv = halfV_m - radius_m;
    const r = Math.max(radius_m - inset_m, 1e-5);
    for (let corner = 0; corner < 4; corner++) {
      const su = corner === 0 || corner === 3 ? 1 : -1;
      const sv = corner < 2 ? 1 : -1;
      arc(
        points,
        [centre[0] + su * hu, centre[1] + sv * hv],
        r,
        (corner * Math.PI) / 2,
        ((corner + 1) * Math.PI) / 2,
        steps,
        fit,
      );
    }
    return points;
  };
}

/** The polyline with each inner corner replaced by an arc of that radius (less where a neighbour is too near). */
export function filleted(points: readonly Point2[], radius_m: number, steps = 3): Point2[] {
  const out: Point2[] = [points[0]!];
  for (let i = 1; i + 1 < points.length; i++) {
    const [px, py] = points[i - 1]!;
    const [x, y] = points[i]!;
    const [nx, ny] = points[i + 1]!;
    const before = Math.hypot(px - x, py - y);
    const after = Math.hypot(nx - x, ny - y);
    const ax = (px - x) / before;
    const ay = (py - y) / before;
    const bx = (nx - x) / after;
    const by = (ny - y) / after;
    const half = Math.acos(Math.max(-1, Math.min(1, ax * bx + ay * by))) / 2;
    const cut = Math.min(radius_m / Math.tan(half), before * 0.49, after * 0.49);
    if (half > Math.PI / 2 - 0.02 || cut < 1e-6) {
      out.push([x, y]);
      continue;
    }
    const r = cut * Math.tan(half);
    const toCentre = r / Math.sin(half);
    const mx = ax + bx;
    const my = ay + by;
    const m = Math.hypot(mx, my);
    const cx = x + (mx / m) * toCentre;
    const cy = y + (my / m) * toCentre;
    const start = Math.atan2(y + ay * cut - cy, x + ax * cut - cx);
    let sweep = Math.atan2(y + by * cut - cy, x + bx * cut - cx) - start;
    if (sweep > Math.PI) sweep -= 2 * Math.PI;
    if (sweep < -Math.PI) sweep += 2 * Math.PI;
    for (let k = 0; k <= steps; k++)
      out.push([cx + r * Math.cos(start + (sweep * k) / steps), cy + r * Math.sin(start + (sweep * k) / steps)]);
  }
  out.push(points[points.length - 1]!);
  return out;
}
