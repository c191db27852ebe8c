import { flangePose } from "../kinematics/forward.ts";
import { compose, inverse, pose, type Pose } from "../spatial/pose.ts";
import { fromAxisAngle, multiply, rotate, type Quaternion } from "../spatial/quaternion.ts";
import { wrapAngle } from "../spatial/units.ts";
import { dot, scale, subtract, type Vector3 } from "../spatial/vector.ts";
import type { SerialArm } from "../model/arm.ts";
import {
  axesAtZero,
  clean,
  deviation,
  footOn,
  frameOf,
  passing,
  product,
  seenFrom,
  skew,
  upward,
  type Line,
  type Turned,
} from "./axes.ts";
import type { ThreeParallelGeometry } from "../model/robot.ts";

/**
 * Right angles written with ten digits, as robot files have them, are right angles. What is left over, refinement takes
 * out.
 */
const ROUNDING = 1e-7;
/** The formula must meet the arm at every tried posture this closely [m, rad]. */
const AGREES = 1e-6;
const X: Vector3 = [1, 0, 0];
const Y: Vector3 = [0, 1, 0];
const Z: Vector3 = [0, 0, 1];
type Six = [number, number, number, number, number, number];
type SixAxes = [Line, Line, Line, Line, Line, Line];

/**
 * Lengths, zeros and turning senses of an arm whose axes 2, 3 and 4 are parallel and square to axis 1, with 5 square to
 * 4 and 6 square to 5, each meeting the one before. The base may stand anyhow. Read off the joint axes with all angles
 * 0, then held against forward kinematics at 40 random postures to 1e-6.
 *
 * “Front” is the side the wrist is on when all angles are 0.
 *
 * @returns null for an arm of another kind.
 */
export function threeParallelFromArm(arm: SerialArm): ThreeParallelGeometry | null {
  if (arm.joints.length !== 6) return null;
  const axes = axesAtZero(arm) as SixAxes;
  if (!isThreeParallel(axes)) return null;
  const [axis1, axis2, , , axis5, axis6] = axes;

  const signs: Six = [upward(axis1.along), 1, 1, 1, 1, 1];
  const up = scale(axis1.along, signs[0]);
  const origin = footOn(axis1, axis2);
  const wrist = footOn(axis5, axis6);
  // y along axis 2 or against it, so that the wrist is in front; on axis 1, so that x points as the base's.
  let baseFromFormula: Pose<"base", "formula"> = frameOf(origin, up, axis2.along);
  const ahead = seenFrom(baseFromFormula, { along: Z, through: wrist }).through[0];
  if (ahead < -ROUNDING || (Math.abs(ahead) <= ROUNDING && rotate(baseFromFormula.quaternion, X)[0] < 0))
    baseFromFormula = frameOf(origin, up, scale(axis2.along, -1));
  const [, two, three, four, five, six] = axes.map(axis => seenFrom(baseFromFormula, axis)) as SixAxes;
  const [xw, b, zw] = seenFrom(baseFromFormula, { along: Z, through: wrist }).through;
  for (const [j, axis] of [two, three, four].entries()) signs[j + 1] = axis.along[1] < 0 ? -1 : 1;

  const upper = subtract(three.through, two.through);
  const fore = subtract(four.through, three.through);
  const c2 = Math.hypot(upper[0], upper[2]);
  const c3 = Math.hypot(fore[0], fore[2]);
  if (c2 < 1e-6 || c3 < 1e-6) return null;
  const lean2 = Math.atan2(upper[0], upper[2]);
  const lean3 = Math.atan2(fore[0], fore[2]);
  const along5 = five.along[0] * (xw - four.through[0]) + five.along[2] * (zw - four.through[2]);
  signs[4] = along5 < 0 ? -1 : 1;
  const lean4 = Math.atan2(signs[4] * five.along[0], signs[4] * five.along[2]);
  const hand = fromAxisAngle(Y, lean4);
  const back: Quaternion = [-hand[0], -hand[1], -hand[2], hand[3]];
  const flange = flangePose(arm, new Float64Array(6));
  const outwards = dot(subtract(flange.position, wrist), axis6.along);
  signs[5] = outwards < -ROUNDING ? -1 : 1;
  const tip = scale(rotate(back, six.along), signs[5]);
  const turn5 = Math.atan2(-tip[0], tip[1]);

  const baseFromWrist = compose(
    baseFromFormula,
    pose<"formula", "wrist">([xw, b, zw], multiply(hand, fromAxisAngle(Z, turn5))),
  );
  const zeros: Six = [0, lean2, wrapAngle(lean3 - lean2), wrapAngle(lean4 - lean3), turn5, 0];
  const geometry: ThreeParallelGeometry = {
    kind: "three-parallel",
    a1_m: clean(two.through[0]),
    b_m: clean(b),
    c2_m: c2,
    c3_m: c3,
    c5_m: clean(Math.abs(along5)),
    offsets_rad: [0, -zeros[1] || 0, -zeros[2] || 0, -zeros[3] || 0, -zeros[4] || 0, 0],
    signs,
    baseFromFormula,
    wristFromFlange: compose(inverse(baseFromWrist), flange),
  };
  const { position_m, angle_rad } = deviation(arm, q => threeParallelFlange(geometry, q));
  return position_m < AGREES && angle_rad < AGREES ? geometry : null;
}

/** Axes 2, 3 and 4 parallel and square to 1, 5 square to 4, 6 square to 5, each of these meeting the one before. */
function isThreeParallel([axis1, axis2, axis3, axis4, axis5, axis6]: SixAxes): boolean {
  const parallel = skew(axis2.along, axis3.along) < ROUNDING && skew(axis3.along, axis4.along) < ROUNDING;
  const square =
    Math.abs(dot(axis1.along, axis2.along)) < ROUNDING &&
    Math.abs(dot(axis4.along, axis5.along)) < ROUNDING &&
    Math.abs(dot(axis5.along, axis6.along)) < ROUNDING;
  return parallel && square && passing(axis4, axis5) <= ROUNDING && passing(axis5, axis6) <= ROUNDING;
}

/**
 * Pose of the flange by the formula, elementary turn after turn. Slow and plain: `flangePose` is the way to compute it.
 */
export function threeParallelFlange(geometry: ThreeParallelGeometry, q_rad: ArrayLike<number>): Pose<"base", "flange"> {
  const { a1_m, b_m, c2_m, c3_m, c5_m, signs, offsets_rad, baseFromFormula, wristFromFlange } = geometry;
  const steps: readonly Turned[] = [
    [[0, 0, 0], Z],
    [[a1_m, b_m, 0], Y],
    [scale(Z, c2_m), Y],
    [scale(Z, c3_m), Y],
    [scale(Z, c5_m), Z],
    [[0, 0, 0], Y],
  ];
  return compose(product(baseFromFormula, steps, signs, offsets_rad, q_rad) as Pose<"base", "wrist">, wristFromFlange);
}
