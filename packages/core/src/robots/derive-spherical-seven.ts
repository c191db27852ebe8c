import { flangePose } from "../kinematics/forward.ts";
import { compose, inverse, pose, type Pose } from "../spatial/pose.ts";
import { fromAxisAngle, multiply, rotate, type Quaternion } from "../spatial/quaternion.ts";
import { distance, dot, scale, subtract, type Vector3 } from "../spatial/vector.ts";
import type { SerialArm } from "../model/arm.ts";
import {
  axesAtZero,
  deviation,
  distanceFrom,
  footOn,
  frameOf,
  passing,
  product,
  upward,
  type Line,
  type Turned,
} from "./axes.ts";
import type { SphericalSevenGeometry } from "../model/robot.ts";

const ROUNDING = 1e-7;
/** Robot files give some arms offsets of a few tenths of a millimetre where the drawing has none. */
const OFFSET_M = 2e-3;
/** The formula must meet the arm at every tried posture this closely; the offsets of shoulder and elbow add up. */
const AGREES_M = 5e-3;
const AGREES_RAD = 1e-6;
/** Less than this is rounding of the file, no offset [m]. */
const EXACT_M = 1e-12;
const SHORTEST_M = 0.02;
const Y: Vector3 = [0, 1, 0];
const Z: Vector3 = [0, 0, 1];
type Seven = [number, number, number, number, number, number, number];
type SevenAxes = [Line, Line, Line, Line, Line, Line, Line];

/**
 * Lengths, zeros and turning senses of a seven-joint arm with each axis square to the next, axes 1, 2, 3 through one
 * point, 5, 6, 7 through another, and 4 meeting 3 and 5 between them; meeting to within 2 mm. The base may stand
 * anyhow. Read off the joint axes with all angles 0, then held against forward kinematics at 40 random postures.
 *
 * @returns null for an arm of another kind.
 */
export function sphericalSevenFromArm(arm: SerialArm): SphericalSevenGeometry | null {
  if (arm.joints.length !== 7) return null;
  const axes = axesAtZero(arm) as SevenAxes;
  const [axis1, axis2, axis3, axis4, axis5, axis6, axis7] = axes;
  if (axes.some((axis, j) => j < 6 && !squareAndMeeting(axis, axes[j + 1]!))) return null;
  const shoulder = footOn(axis1, axis2);
  const elbow = footOn(axis4, axis5);
  const wrist = footOn(axis5, axis6);
  if (distanceFrom(axis3, shoulder) > OFFSET_M || distanceFrom(axis7, wrist) > OFFSET_M) return null;
  const c3 = distance(shoulder, elbow);
  const c5 = distance(elbow, wrist);
  if (c3 < SHORTEST_M || c5 < SHORTEST_M) return null;

  const flange = flangePose(arm, new Float64Array(7));
  const signs: Seven = [1, 1, 1, 1, 1, 1, 1];
  const zeros: Seven = [0, 0, 0, 0, 0, 0, 0];
  signs[0] = upward(axis1.along);
  const ends = [elbow, wrist, flange.position];
  const starts = [shoulder, elbow, wrist];
  for (const [k, j] of [2, 4, 6].entries())
    signs[j] = dot(subtract(ends[k]!, starts[k]!), axes[j]!.along) < -ROUNDING ? -1 : 1;
  const up = scale(axis1.along, signs[0]);
  let baseFromFormula: Pose<"base", "formula"> = frameOf(shoulder, up, axis2.along);
  if (rotate(baseFromFormula.quaternion, [1, 0, 0])[0] < -ROUNDING) {
    baseFromFormula = frameOf(shoulder, up, scale(axis2.along, -1));
    signs[1] = -1;
  }
  const frame = turnOntoAxes(axes, baseFromFormula.quaternion, signs, zeros);
  const [o1, o2, o3, o4, o5, o6, o7] = zeros.map(zero => -zero || 0);
  const geometry: SphericalSevenGeometry = {
    kind: "spherical-seven",
    c3_m: c3,
    c5_m: c5,
    offsets_rad: [o1!, o2!, o3!, o4!, o5!, o6!, o7!],
    signs,
    baseFromFormula,
    wristFromFlange: compose(inverse(pose<"base", "wrist">(wrist, frame)), flange),
    deviation_m: 0,
  };
  const { position_m, angle_rad } = deviation(arm, q => sphericalSevenFlange(geometry, q));
  if (!(position_m < AGREES_M && angle_rad < AGREES_RAD)) return null;
  return position_m < EXACT_M ? geometry : { ...geometry, deviation_m: position_m };
}

const squareAndMeeting = (a: Line, b: Line): boolean =>
  Math.abs(dot(a.along, b.along)) <= ROUNDING && passing(a, b) <= OFFSET_M;

/**
 * From axis to axis: the angle before an axis turns the formula's z or y onto it. Completes `signs` of the level axes
 * and `zeros`, and returns the orientation of the wrist in the base.
 */
function turnOntoAxes(axes: SevenAxes, baseFromFormula: Quaternion, signs: Seven, zeros: Seven): Quaternion {
  let frame = baseFromFormula;
  for (let j = 2; j < 7; j++) {
    const seen = rotate([-frame[0], -frame[1], -frame[2], frame[3]], axes[j]!.along);
    const aboutY = j % 2 === 0;
    if (!aboutY) signs[j] = seen[1] < -ROUNDING ? -1 : 1;
    const [x, y, z] = scale(seen, signs[j]!);
    zeros[j - 1] = aboutY ? Math.atan2(x, z) : Math.atan2(-x, y);
    frame = multiply(frame, fromAxisAngle(aboutY ? Y : Z, zeros[j - 1]!));
  }
  return frame;
}

/**
 * Pose of the flange by the formula, elementary turn after turn. Slow and plain: `flangePose` is the way to compute it.
 */
export function sphericalSevenFlange(
  geometry: SphericalSevenGeometry,
  q_rad: ArrayLike<number>,
): Pose<"base", "flange"> {
  const { c3_m, c5_m, signs, offsets_rad, baseFromFormula, wristFromFlange } = geometry;
  const none: Vector3 = [0, 0, 0];
  const steps: readonly Turned[] = [
    [none, Z],
    [none, Y],
    [none, Z],
    [scale(Z, c3_m), Y],
    [none, Z],
    [scale(Z, c5_m), Y],
    [none, Z],
  ];
  return compose(product(baseFromFormula, steps, signs, offsets_rad, q_rad) as Pose<"base", "wrist">, wristFromFlange);
}
