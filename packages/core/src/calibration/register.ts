import { fromMatrix, normalizeQuaternion, rotate, toMatrix, type Quaternion } from "../spatial/quaternion.ts";
import { pose, transformPoint, type Pose } from "../spatial/pose.ts";
import { subtract, type Vector3 } from "../spatial/vector.ts";
import { symmetricEigen } from "../spatial/eigen.ts";
import { isFinitePoint, meanOf, residualOf, type Residual } from "./residual.ts";

/** A point known in the drawing of a thing and measured where it stands. */
export interface PointPair {
  readonly known: Vector3;
  readonly measured: Vector3;
}

/**
 * Where a thing stands, by points known on it; `residual` is the registration error to be shown beside the cell and
 * added to its margins (row T-64).
 */
export type Registration =
  | {
      readonly kind: "registered";
      readonly intoFromFrame: Pose<"into", "frame">;
      readonly residual: Residual;
      readonly sentence: string;
    }
  | { readonly kind: "too-few"; readonly got: number; readonly sentence: string }
  /** How far the points stand out of one line, on average. */
  | { readonly kind: "in-line"; readonly spread_m: number; readonly sentence: string }
  | { readonly kind: "not-a-point"; readonly sentence: string };

const FEWEST = 3;
/** Points must stand out of one line by this much, on average, for the turn about the line to be known. */
const LEAST_SPREAD_M = 0.002;

/**
 * The rigid motion that brings known points onto measured ones with least Σ |R k + t − m|². A reflection cannot come of
 * it: R is the unit quaternion that belongs to the largest eigenvalue of Horn's 4 × 4 matrix.
 *
 * @see Horn, Closed-form solution of absolute orientation using unit quaternions, J. Opt. Soc. Am. A 4(4) 1987.
 */
export function registerPoints(pairs: readonly PointPair[]): Registration {
  const flawed = pairs.findIndex(({ known, measured }) => !isFinitePoint(known) || !isFinitePoint(measured));
  if (flawed >= 0)
    return { kind: "not-a-point", sentence: `A coordinate of point ${flawed + 1} is not a finite number.` };
  if (pairs.length < FEWEST)
    return {
      kind: "too-few",
      got: pairs.length,
      sentence: `${FEWEST} points are the least; ${pairs.length} were given.`,
    };
  const knownMean = meanOf(pairs.map(({ known }) => known));
  const measuredMean = meanOf(pairs.map(({ measured }) => measured));
  const H = new Float64Array(9);
  const scatter = new Float64Array(9);
  for (const { known, measured } of pairs) {
    const k = subtract(known, knownMean);
    const m = subtract(measured, measuredMean);
    for (let row = 0; row < 3; row++)
      for (let column = 0; column < 3; column++) {
        H[3 * row + column]! += k[row]! * m[column]!;
        scatter[3 * row + column]! += k[row]! * k[column]!;
      }
  }
  const spread_m = Math.sqrt(Math.max(0, symmetricEigen(scatter).values[1]!) / pairs.length);
  if (spread_m < LEAST_SPREAD_M) {
    return {
      kind: "in-line",
      spread_m,
      sentence: `The points lie in one line to ${(spread_m * 1000).toFixed(2)} mm; one must stand aside for the turn about that line.`,
    };
  }
  const quaternion = hornRotation(H);
  const turned = rotate(quaternion, knownMean);
  const intoFromFrame = pose<"into", "frame">(subtract(measuredMean, turned), quaternion);
  const residual = residualOf(
    pairs.map(({ measured }) => measured),
    pairs.map(({ known }) => transformPoint(intoFromFrame, known)),
  );
  const sentence = `The points are met to ${(residual.rms_m * 1000).toFixed(2)} mm (root mean square); point ${residual.worst} is worst with ${(residual.worst_m * 1000).toFixed(2)} mm.`;
  return { kind: "registered", intoFromFrame, residual, sentence };
}

/**
 * The rotation that turns vectors k into vectors m with least Σ |R k − m|², w ≥ 0.
 *
 * @param H Σ k mᵀ, row by row
 */
export function hornRotation(H: Float64Array): Quaternion {
  const [xx, xy, xz, yx, yy, yz, zx, zy, zz] = [...H] as [
    number,
    number,
    number,
    number,
    number,
    number,
    number,
    number,
    number,
  ];
  const N = [
    xx + yy + zz,
    yz - zy,
    zx - xz,
    xy - yx,
    yz - zy,
    xx - yy - zz,
    xy + yx,
    zx + xz,
    zx - xz,
    xy + yx,
    yy - xx - zz,
    yz + zy,
    xy - yx,
    zx + xz,
    yz + zy,
    zz - xx - yy,
  ];
  const [w, x, y, z] = [...symmetricEigen(N).vectors[0]!] as [number, number, number, number];
  return fromMatrix(toMatrix(normalizeQuaternion([x, y, z, w])));
}
