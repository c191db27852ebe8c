import { flangePose } from "../kinematics/forward.ts";
import { compose, inverse, pose, type Pose } from "../spatial/pose.ts";
import { fromAxisAngle, multiply, rotate, type Quaternion } from "../spatial/quaternion.ts";
import { wrapAngle } from "../spatial/units.ts";
import { addScaled, cross, dot, norm, scale, subtract, type Vector3 } from "../spatial/vector.ts";
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
import type { GeneralSixGeometry } from "../model/robot.ts";

const ROUNDING = 1e-7;
/** The formula must meet the arm at every tried posture this closely [m, rad]. */
const AGREES = 1e-6;
/** Axes 4 and 5 closer to parallel than this [sine] leave the wrist one turn short. */
const LEAST_SKEW = 0.05;
const X: Vector3 = [1, 0, 0];
const Y: Vector3 = [0, 1, 0];
const Z: Vector3 = [0, 0, 1];
type Six = [number, number, number, number, number, number];
type SixAxes = [Line, Line, Line, Line, Line, Line];

/**
 * Lengths, zeros and turning senses of a six-joint arm with axis 1 square to 2, axes 2 and 3 parallel, and 4 meeting 5;
 * axis 6 may lie anywhere. The base may stand anyhow. Read off the joint axes with all angles 0, then held against
 * forward kinematics at 40 random postures to 1e-6.
 *
 * @returns null for an arm of another kind.
 */
export function generalSixFromArm(arm: SerialArm): GeneralSixGeometry | null {
  if (arm.joints.length !== 6) return null;
  const axes = axesAtZero(arm) as SixAxes;
  const [axis1, axis2, axis3, axis4, axis5] = axes;
  if (Math.abs(dot(axis1.along, axis2.along)) > ROUNDING || skew(axis2.along, axis3.along) > ROUNDING) return null;
  if (skew(axis4.along, axis5.along) < LEAST_SKEW || passing(axis4, axis5) > ROUNDING) return null;

  const signs: Six = [upward(axis1.along), 1, 1, 1, 1, 1];
  const up = scale(axis1.along, signs[0]);
  const origin = footOn(axis1, axis2);
  const centre = footOn(axis4, axis5);
  let baseFromFormula: Pose<"base", "formula"> = frameOf(origin, up, axis2.along);
  if (rotate(baseFromFormula.quaternion, X)[0] < -ROUNDING)
    baseFromFormula = frameOf(origin, up, scale(axis2.along, -1));
  const [, two, three, four, five, six] = axes.map(axis => seenFrom(baseFromFormula, axis)) as SixAxes;
  const [xc, b, zc] = seenFrom(baseFromFormula, { along: Z, through: centre }).through;
  signs[1] = two.along[1] < 0 ? -1 : 1;
  signs[2] = three.along[1] < 0 ? -1 : 1;
  const upper = subtract(three.through, two.through);
  const c2 = Math.hypot(upper[0], upper[2]);
  const fore: [number, number] = [xc - three.through[0], zc - three.through[2]];
  if (c2 < 1e-6 || Math.hypot(...fore) < 1e-6) return null;
  // Upper arm upright at θ2 = 0; θ3 such that link 3 stands as the formula's frame when the joint angles are 0.
  const lean2 = Math.atan2(upper[0], upper[2]);

  const { wrist, e_m } = wristOf([xc, b, zc], six);
  const flange = flangePose(arm, new Float64Array(6));
  const baseFromWrist = compose(baseFromFormula, wrist);
  const geometry: GeneralSixGeometry = {
    kind: "general-6r",
    a1_m: clean(two.through[0]),
    b_m: clean(b),
    c2_m: c2,
    e_m,
    centre_m: [clean(fore[0]), clean(fore[1])],
    axis4: four.along,
    axis5: five.along,
    turn: wrist.quaternion,
    signs,
    offsets_rad: [0, -lean2 || 0, wrapAngle(lean2), 0, 0, 0],
    baseFromFormula,
    wristFromFlange: compose(inverse(baseFromWrist), flange),
  };
  const { position_m, angle_rad } = deviation(arm, q => generalSixFlange(geometry, q));
  return position_m < AGREES && angle_rad < AGREES ? geometry : null;
}

/**
 * The frame on axis 6 nearest to the point where axes 4 and 5 meet, z along axis 6 and x away from that point, in the
 * formula's frame; and how far it is from there, 0 where axis 6 goes through the point.
 */
function wristOf(centre: Vector3, axis6: Line): { readonly wrist: Pose<"formula", "wrist">; readonly e_m: number } {
  const nearest = addScaled(axis6.through, axis6.along, dot(subtract(centre, axis6.through), axis6.along));
  const out = subtract(nearest, centre);
  const e = norm(out);
  const meets = e < ROUNDING;
  const away = meets ? perpendicular(axis6.along) : scale(out, 1 / e);
  return { wrist: frameOf(meets ? centre : nearest, axis6.along, cross(axis6.along, away)), e_m: meets ? 0 : e };
}

/**
 * Pose of the flange by the formula, elementary turn after turn. Slow and plain: `flangePose` is the way to compute it.
 */
export function generalSixFlange(geometry: GeneralSixGeometry, q_rad: ArrayLike<number>): Pose<"base", "flange"> {
  const { a1_m, b_m, c2_m, e_m, centre_m, axis4, axis5, turn, signs, offsets_rad, baseFromFormula, wristFromFlange } =
    geometry;
  const steps: readonly Turned[] = [
    [[0, 0, 0], Z],
    [[a1_m, b_m, 0], Y],
    [[0, 0, c2_m], Y],
    [[centre_m[0], 0, centre_m[1]], axis4],
    [[0, 0, 0], axis5],
  ];
  const link5 = product(baseFromFormula, steps, signs, offsets_rad, q_rad);
  const wrist: Quaternion = multiply(turn, fromAxisAngle(Z, signs[5] * q_rad[5]! - offsets_rad[5]));
  return compose(
    compose(link5 as Pose<"base", "link">, pose<"link", "wrist">(rotate(turn, [e_m, 0, 0]), wrist)),
    wristFromFlange,
  );
}

const perpendicular = (v: Vector3): Vector3 => {
  const across = cross(v, Math.abs(v[0]) < 0.7 ? X : Y);
  return scale(across, 1 / norm(across));
};
