import { degrees } from "../spatial/units.ts";
import { fromMatrix } from "../spatial/quaternion.ts";
import { pose, type Pose } from "../spatial/pose.ts";
import { cross, dot, norm, normalize, subtract, type Vector3 } from "../spatial/vector.ts";
import { isFinitePoint } from "./residual.ts";

/** A frame from three points, or why they give none. */
export type FrameAnswer =
  | {
      readonly kind: "frame";
      readonly intoFromFrame: Pose;
      /** Distances of the two other points from the origin: long ones make a straight frame. */
      readonly alongX_m: number;
      readonly inPlane_m: number;
      /**
       * Angle between the two directions; how far it is from square says how well the third point was aimed at +y. It
       * does not enter the frame.
       */
      readonly angle_rad: number;
      readonly offSquare_rad: number;
      readonly sentence: string;
    }
  | { readonly kind: "too-near"; readonly which: "x" | "plane"; readonly distance_m: number; readonly sentence: string }
  | { readonly kind: "in-line"; readonly angle_rad: number; readonly sentence: string }
  | { readonly kind: "not-a-point"; readonly sentence: string };

/** Points nearer than this to the origin give no direction: a touch is good to about 0.1 mm. */
const NEAREST_M = 0.005;
/** The three points must open at least this angle. */
const LEAST_ANGLE_RAD = (5 * Math.PI) / 180;

/**
 * The frame of three points (base, user or work frame, "three-point method"):
 *
 *   x = (p_x − o) / |p_x − o|,   z = x × (p_xy − o) / |…|,   y = z × x
 *
 * @param origin  o, where the frame begins.
 * @param alongX  p_x, a point on its +x axis.
 * @param inXy    p_xy, a point of its xy plane on the +y side.
 */
export function frameFromThreePoints(origin: Vector3, alongX: Vector3, inXy: Vector3): FrameAnswer {
  if (![origin, alongX, inXy].every(isFinitePoint))
    return { kind: "not-a-point", sentence: "A coordinate of a point is not a finite number." };
  const toX = subtract(alongX, origin);
  const toPlane = subtract(inXy, origin);
  const alongX_m = norm(toX);
  const inPlane_m = norm(toPlane);
  if (alongX_m < NEAREST_M) return tooNear("x", alongX_m);
  if (inPlane_m < NEAREST_M) return tooNear("plane", inPlane_m);
  const across = cross(toX, toPlane);
  const angle_rad = Math.atan2(norm(across), dot(toX, toPlane));
  const offSquare_rad = Math.abs(angle_rad - Math.PI / 2);
  if (angle_rad < LEAST_ANGLE_RAD || angle_rad > Math.PI - LEAST_ANGLE_RAD) {
    return {
      kind: "in-line",
      angle_rad,
      sentence: `The three points open ${degrees(Math.min(angle_rad, Math.PI - angle_rad)).toFixed(1)}°; a plane needs ${degrees(LEAST_ANGLE_RAD).toFixed(0)}°.`,
    };
  }
  const x = normalize(toX);
  const z = normalize(across);
  const y = cross(z, x);
  const sentence = `The two directions are ${degrees(angle_rad).toFixed(2)}° apart; square would be 90.00°.`;
  return {
    kind: "frame",
    intoFromFrame: pose([...origin], fromMatrix([x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]])),
    alongX_m,
    inPlane_m,
    angle_rad,
    offSquare_rad,
    sentence,
  };
}

function tooNear(which: "x" | "plane", distance_m: number): FrameAnswer {
  const point = which === "x" ? "The point on +x" : "The point of the plane";
  return {
    kind: "too-near",
    which,
    distance_m,
    sentence: `${point} is ${(distance_m * 1000).toFixed(1)} mm from the origin; ${(NEAREST_M * 1000).toFixed(0)} mm are the least.`,
  };
}
