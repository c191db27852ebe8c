import { toMatrix } from "../spatial/quaternion.ts";
import { compose, inverse, pose, transformPoint, type Pose } from "../spatial/pose.ts";
import { degrees } from "../spatial/units.ts";
import type { Vector3 } from "../spatial/vector.ts";
import { symmetricEigen } from "../spatial/eigen.ts";
import { frameFromThreePoints, type FrameAnswer } from "./frame.ts";
import { isFinitePoint, meanOf, residualOf, type Residual } from "./residual.ts";

/** A tool tip from touches of one fixed point, or which touches are missing. */
export type TcpAnswer =
  | {
      readonly kind: "calibrated";
      /** The tip seen from the flange, and the touched point seen from the base [m]. */
      readonly tip: Vector3;
      readonly fixedPoint: Vector3;
      readonly residual: Residual;
      /**
       * How much the poses turn, as they see the direction in the flange that they see least: an equal turn to both
       * sides about all other directions [rad].
       */
      readonly spread_rad: number;
      readonly weakest: Vector3;
      /**
       * What the residual means for the tip along the weakest direction: standard deviation [m]. 0 where no touch is to
       * spare.
       */
      readonly uncertainty_m: number;
      readonly sentence: string;
    }
  | { readonly kind: "too-few"; readonly got: number; readonly sentence: string }
  /**
   * `about` is the direction in the flange along which the tip is unknown: turn about directions square to it. Null
   * when nothing turned at all.
   */
  | {
      readonly kind: "too-alike";
      readonly spread_rad: number;
      readonly about: Vector3 | null;
      readonly sentence: string;
    }
  | { readonly kind: "not-a-pose"; readonly sentence: string };

const FEWEST = 4;
/** Turns below this to both sides tell a tip apart by less than a tenth of the touch's own error. */
const LEAST_SPREAD_RAD = (6 * Math.PI) / 180;

/**
 * The tip from flange poses in which it touches one fixed point, in different orientations ("four-point method"):
 *
 *   R_i t + p_i = c   ⇒   Σ (R_i − R̄)ᵀ (R_i − R̄) t = −Σ (R_i − R̄)ᵀ (p_i − p̄),   c = R̄ t + p̄
 *
 * The eigenvalues of the matrix say how well the touches see each direction of the flange; where one is near 0 all
 * poses were turned about that direction alone, and the tip along it is anybody's guess.
 *
 * @param touches  baseFromFlange of each touch, at least four. Read only.
 */
export function tcpFromTouches(touches: readonly Pose<"base", "flange">[]): TcpAnswer {
  const flawed = touches.findIndex(
    ({ position, quaternion: [x, y, z, w] }) =>
      !isFinitePoint(position) || !(Math.abs(Math.hypot(x, y, z, w) - 1) < 1e-3),
  );
  if (flawed >= 0)
    return {
      kind: "not-a-pose",
      sentence: `Touch ${flawed + 1} is no pose: its numbers must be finite and its quaternion of length 1.`,
    };
  if (touches.length < FEWEST)
    return {
      kind: "too-few",
      got: touches.length,
      sentence: `${FEWEST} touches are the least; ${touches.length} were given.`,
    };
  const n = touches.length;
  const turns = touches.map(({ quaternion }) => toMatrix(quaternion));
  const meanPosition = meanOf(touches.map(({ position }) => position));
  const meanTurn = Array.from({ length: 9 }, (_, i) => turns.reduce((sum, R) => sum + R[i]!, 0) / n);
  const A = new Float64Array(9);
  const b = new Float64Array(3);
  touches.forEach(({ position }, i) => {
    const D = turns[i]!.map((value, at) => value - meanTurn[at]!);
    for (let row = 0; row < 3; row++) {
      for (let column = 0; column < 3; column++)
        for (let k = 0; k < 3; k++) A[3 * row + column]! += D[3 * k + row]! * D[3 * k + column]!;
      for (let k = 0; k < 3; k++) b[row]! -= D[3 * k + row]! * (position[k]! - meanPosition[k]!);
    }
  });
  const { values, vectors } = symmetricEigen(A);
  const weakest = [...vectors[2]!] as Vector3;
  const [strong, , weak] = [0, 1, 2].map(i =>
    Math.asin(Math.min(1, Math.sqrt(Math.max(0, values[i]!) / n))),
  ) as Vector3;
  if (weak < LEAST_SPREAD_RAD) return tooAlike(strong, weak, weakest);

  const tip: Vector3 = [0, 0, 0];
  vectors.forEach((v, i) => {
    const share = (v[0]! * b[0]! + v[1]! * b[1]! + v[2]! * b[2]!) / values[i]!;
    for (let axis = 0; axis < 3; axis++) tip[axis]! += share * v[axis]!;
  });
  const touched = touches.map(touch => transformPoint(touch, tip));
  const fixedPoint = meanOf(touched);
  const residual = residualOf(
    touched,
    touched.map(() => fixedPoint),
  );
  const spare = 3 * n - 6;
  const deviation = Math.sqrt((n * residual.rms_m * residual.rms_m) / spare);
  const sentence = `The touches meet in one point to ${(residual.rms_m * 1000).toFixed(2)} mm (root mean square); touch ${residual.worst} is worst with ${(residual.worst_m * 1000).toFixed(2)} mm.`;
  return {
    kind: "calibrated",
    tip,
    fixedPoint,
    residual,
    spread_rad: weak,
    weakest,
    uncertainty_m: deviation / Math.sqrt(values[2]!),
    sentence,
  };
}

function tooAlike(strong: number, weak: number, weakest: Vector3): TcpAnswer {
  if (strong < LEAST_SPREAD_RAD) {
    return {
      kind: "too-alike",
      spread_rad: weak,
      about: null,
      sentence: `The poses differ by ${degrees(strong).toFixed(1)}° only; tilt the tool by 30° and more about two directions between touches.`,
    };
  }
  const axis = weakest.map(Math.abs).indexOf(Math.max(...weakest.map(Math.abs)));
  const name = "xyz"[axis]!;
  const others = ["x", "y", "z"].filter(other => other !== name);
  return {
    kind: "too-alike",
    spread_rad: weak,
    about: weakest,
    sentence: `The poses turn about one direction only, nearly the flange's ${name}; the tip along it is not seen. Tilt the tool about the flange's ${others.join(" or ")} as well.`,
  };
}

/**
 * How the tool is turned in the flange, by touching the fixed point with two more of its points: one on its +x axis and
 * one of its xy plane on the +y side. Seen from the flange, the three touched points are a frame.
 *
 * @param tip         the tip seen from the flange [m], as `tcpFromTouches` found it.
 * @param fixedPoint  the touched point in the base [m].
 * @param alongX      baseFromFlange while a point on the tool's +x axis touches.
 * @param inXy        baseFromFlange while a point of the tool's xy plane, y > 0, touches.
 * @returns a frame whose `intoFromFrame` is flangeFromTcp.
 */
export function tcpOrientation(
  tip: Vector3,
  fixedPoint: Vector3,
  alongX: Pose<"base", "flange">,
  inXy: Pose<"base", "flange">,
): FrameAnswer {
  const seen = (touch: Pose<"base", "flange">): Vector3 =>
    compose(inverse(touch), pose<"base", "point">(fixedPoint)).position;
  return frameFromThreePoints(tip, seen(alongX), seen(inXy));
}
