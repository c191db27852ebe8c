import { distance, lerp, type Vector3 } from "../../spatial/vector.ts";

/** A cubic Bézier curve:  B(u) = (1−u)³ p₀ + 3(1−u)²u p₁ + 3(1−u)u² p₂ + u³ p₃. */
export type Bezier = readonly [Vector3, Vector3, Vector3, Vector3];

export function pointOnBezier([p0, p1, p2, p3]: Bezier, u: number): Vector3 {
  const r = 1 - u;
  const weights = [r * r * r, 3 * r * r * u, 3 * r * u * u, u * u * u] as const;
  return [0, 1, 2].map(
    k => weights[0] * p0[k]! + weights[1] * p1[k]! + weights[2] * p2[k]! + weights[3] * p3[k]!,
  ) as Vector3;
}

/** Points of a chain of curves, evenly in their parameters, neighbouring curves sharing the point between them. */
export function pointsOnBeziers(curves: readonly Bezier[], perCurve: number): Vector3[] {
  const points: Vector3[] = curves.length > 0 ? [[...curves[0]![0]]] : [];
  for (const curve of curves) for (let n = 1; n <= perCurve; n++) points.push(pointOnBezier(curve, n / perCurve));
  return points;
}

/** Between these many samples are averaged to a control point (row M-40). */
const FEWEST = 5;
const MOST = 10;

/**
 * Filter c as published (row M-40): every 5 to 10 samples are averaged to one control point, four control points make a
 * cubic Bézier curve, and neighbouring curves share their ends. The first and the last sample are kept.
 *
 * @param samples  at least two, of a curved stretch.
 */
export function averagedBeziers(samples: readonly Vector3[]): Bezier[] {
  const inner = samples.slice(1, -1);
  // s curves have 3 s + 1 control points; two of them are the ends.
  const most = Math.max(1, Math.floor((inner.length / FEWEST + 1) / 3));
  const least = Math.max(1, Math.ceil((inner.length / MOST + 1) / 3));
  const curves = Math.min(most, least);
  const groups = 3 * curves - 1;
  const control: Vector3[] = [samples[0]!];
  for (let g = 0; g < groups; g++) {
    const from = Math.floor((g * inner.length) / groups);
    const group = inner.slice(from, Math.max(from + 1, Math.floor(((g + 1) * inner.length) / groups)));
    control.push(group.length > 0 ? meanPoint(group) : lerp(samples[0]!, samples.at(-1)!, (g + 1) / (groups + 1)));
  }
  control.push(samples.at(-1)!);
  return Array.from({ length: curves }, (_, c) => [
    control[3 * c]!,
    control[3 * c + 1]!,
    control[3 * c + 2]!,
    control[3 * c + 3]!,
  ]);
}

export const meanPoint = (points: readonly Vector3[]): Vector3 =>
  [0, 1, 2].map(k => points.reduce((sum, point) => sum + point[k]!, 0) / points.length) as Vector3;

/**
 * Curves through the ends of a stretch whose inner control points are fitted by least squares over the samples, by
 * their chord lengths; a stretch that one curve leaves by more than `within_m` is halved. Nearer to the hand than
 * averages are: these pull the curve off the samples wherever it bends.
 */
export function fittedBeziers(samples: readonly Vector3[], within_m: number): Bezier[] {
  const u = chordParameters(samples);
  const curve = fitted(samples, u);
  const off_m = Math.max(...samples.map((point, i) => distance(point, pointOnBezier(curve, u[i]!))));
  if (off_m <= within_m || samples.length < 6) return [curve];
  const half = Math.floor(samples.length / 2);
  return [...fittedBeziers(samples.slice(0, half + 1), within_m), ...fittedBeziers(samples.slice(half), within_m)];
}

function chordParameters(samples: readonly Vector3[]): number[] {
  const along = [0];
  for (let i = 1; i < samples.length; i++) along.push(along[i - 1]! + distance(samples[i - 1]!, samples[i]!));
  const whole = along.at(-1)!;
  return along.map((at, i) => (whole > 0 ? at / whole : i / Math.max(1, samples.length - 1)));
}

/** p₁ and p₂ from the normal equations of  Σ |B(uᵢ) − xᵢ|². */
function fitted(samples: readonly Vector3[], u: readonly number[]): Bezier {
  const p0 = samples[0]!;
  const p3 = samples.at(-1)!;
  let aa = 0;
  let ab = 0;
  let bb = 0;
  const ra: Vector3 = [0, 0, 0];
  const rb: Vector3 = [0, 0, 0];
  samples.forEach((point, i) => {
    const t = u[i]!;
    const r = 1 - t;
    const a = 3 * r * r * t;
    const b = 3 * r * t * t;
    aa += a * a;
    ab += a * b;
    bb += b * b;
    for (let k = 0; k < 3; k++) {
      const rest = point[k]! - r * r * r * p0[k]! - t * t * t * p3[k]!;
      ra[k]! += a * rest;
      rb[k]! += b * rest;
    }
  });
  const determinant = aa * bb - ab * ab;
  // Fewer than two inner samples do not determine two control points: a straight one.
  if (determinant < 1e-9) return [p0, lerp(p0, p3, 1 / 3), lerp(p0, p3, 2 / 3), p3];
  return [
    p0,
    ra.map((value, k) => (value * bb - rb[k]! * ab) / determinant) as Vector3,
    rb.map((value, k) => (value * aa - ra[k]! * ab) / determinant) as Vector3,
    p3,
  ];
}
