import { flangePose } from "../kinematics/forward.ts";
import { compose, identity, inverse, pose, type Pose } from "../spatial/pose.ts";
import { angleBetween, fromAxisAngle, multiply, rotate, type Quaternion } from "../spatial/quaternion.ts";
import { wrapAngle } from "../spatial/units.ts";
import { addScaled, cross, dot, norm, subtract, type Vector3 } from "../spatial/vector.ts";
import type { SerialArm } from "../model/arm.ts";
import { axesAtZero, clean, deviation, distanceFrom, product, type Line, type Turned } from "./axes.ts";
import type { OrthoParallelGeometry } from "../model/robot.ts";

/**
 * Lengths below this are taken for 0, directions this close for the same: rounding of dimensions as files give them.
 */
const ROUNDING = 1e-9;
/** The formula must meet the arm at every tried posture this closely [m, rad]. */
const VERIFIED = 1e-9;
const Y: Vector3 = [0, 1, 0];
const Z: Vector3 = [0, 0, 1];
type Six = [number, number, number, number, number, number];
type SixAxes = [Line, Line, Line, Line, Line, Line];

/**
 * The seven lengths, zeros and turning senses of an arm whose inverse the closed form knows: axis 1 upright through the
 * base's origin, axes 2 and 3 parallel and level, axes 4, 5, 6 through one point, 4 square to 3. Read off the joint
 * axes with all angles 0, then held against forward kinematics at 40 random postures to 1e-9.
 *
 * Of equivalent sets the one with a1 ≥ 0, c2, c3 > 0, c4 ≥ 0 and small zeros of the wrist is taken.
 *
 * @returns null for an arm of another kind, or with a base turned or moved away from axis 1.
 * @see OrthoParallelGeometry; Brandstötter, Angerer, Hofbaur 2014.
 */
export function orthoParallelFromArm(arm: SerialArm): OrthoParallelGeometry | null {
  if (arm.joints.length !== 6) return null;
  const axes = axesAtZero(arm) as SixAxes;
  const wrist = wristCentreOf(axes);
  if (wrist === undefined) return null;
  const [axis1, axis2, axis3, axis4, axis5, axis6] = axes;
  const signs: Six = [1, 1, 1, 1, 1, 1];
  const zeros: Six = [0, 0, 0, 0, 0, 0];

  signs[0] = Math.sign(axis1.along[2]);
  zeros[0] = headingOf(axis2);
  const heading = fromAxisAngle(Z, zeros[0]);
  const inArm = (v: Vector3): Vector3 => rotate([-heading[0], -heading[1], -heading[2], heading[3]], v);
  signs[1] = Math.sign(inArm(axis2.along)[1]);
  signs[2] = Math.sign(inArm(axis3.along)[1]);

  // Upper arm and forearm in the plane of the arm: x ahead, z up; an angle counts from z towards x.
  const [x2, , z2] = inArm(axis2.through);
  const [x3, , z3] = inArm(axis3.through);
  const [xw, b, zw] = inArm(wrist);
  const c2 = Math.hypot(x3 - x2, z3 - z2);
  if (c2 < ROUNDING) return null;
  zeros[1] = Math.atan2(x3 - x2, z3 - z2);
  const forward4 = inArm(axis4.along);
  const along4 = forward4[0] * (xw - x3) + forward4[2] * (zw - z3);
  signs[3] = along4 < 0 ? -1 : 1;
  const lean = Math.atan2(signs[3] * forward4[0], signs[3] * forward4[2]);
  const c3 = Math.abs(along4);
  const a2 = Math.cos(lean) * (xw - x3) - Math.sin(lean) * (zw - z3);
  if (c3 < ROUNDING) return null;
  zeros[2] = wrapAngle(lean - zeros[1]);

  // Wrist, seen from the forearm: axis 5 = s5 · Rz(θ4) ŷ, axis 6 = s6 · Rz(θ4) Ry(θ5) ẑ.
  const forearm = multiply(heading, fromAxisAngle(Y, lean));
  const inForearm = (v: Vector3): Vector3 => rotate([-forearm[0], -forearm[1], -forearm[2], forearm[3]], v);
  const flange = flangePose(arm, new Float64Array(6));
  const outwards = dot(subtract(flange.position, wrist), axis6.along);
  signs[5] = outwards < -ROUNDING ? -1 : 1;
  const bend = inForearm(axis5.along);
  signs[4] = bend[1] < -ROUNDING ? -1 : 1;
  zeros[3] = Math.atan2(-signs[4] * bend[0], signs[4] * bend[1]);
  const hand = multiply(forearm, fromAxisAngle(Z, zeros[3]));
  const tip = rotate([-hand[0], -hand[1], -hand[2], hand[3]], axis6.along);
  zeros[4] = Math.atan2(signs[5] * tip[0], signs[5] * tip[2]);
  const straight = multiply(hand, fromAxisAngle(Y, zeros[4]));
  zeros[5] = spinOf(straight, flange.quaternion);

  const c4 = Math.abs(outwards);
  const end = multiply(straight, fromAxisAngle(Z, zeros[5]));
  const formulaFlange: Pose<"base", "formula"> = pose(addScaled(wrist, rotate(end, Z), c4), end);
  const geometry: OrthoParallelGeometry = {
    kind: "ortho-parallel",
    a1_m: clean(x2),
    a2_m: clean(a2),
    b_m: clean(b),
    c1_m: clean(z2),
    c2_m: c2,
    c3_m: c3,
    c4_m: clean(c4),
    offsets_rad: [-zeros[0] || 0, -zeros[1] || 0, -zeros[2] || 0, -zeros[3] || 0, -zeros[4] || 0, -zeros[5] || 0],
    signs,
    formulaFromFlange: tidy(compose(inverse(formulaFlange), flange)),
  };
  return agrees(arm, geometry) ? geometry : null;
}

/** Where axes 4, 5 and 6 meet, in the base; undefined unless axes 1 to 4 are as `orthoParallelFromArm` wants them. */
function wristCentreOf([axis1, axis2, axis3, axis4, axis5, axis6]: SixAxes): Vector3 | undefined {
  const upright =
    Math.abs(Math.abs(axis1.along[2]) - 1) < ROUNDING && Math.hypot(axis1.through[0], axis1.through[1]) < ROUNDING;
  const level =
    Math.abs(axis2.along[2]) < ROUNDING &&
    norm(cross(axis2.along, axis3.along)) < ROUNDING &&
    Math.abs(dot(axis3.along, axis4.along)) < ROUNDING;
  if (!upright || !level) return undefined;
  const wrist = meeting(axis4, axis5);
  return wrist && distanceFrom(axis6, wrist) <= ROUNDING ? wrist : undefined;
}

/**
 * θ1 at the robot's zero, from axis 2 = s2 · Rz(θ1) ŷ: of the two headings the one with the shoulder in front, else the
 * smaller.
 */
function headingOf(axis2: Line): number {
  const heading = Math.atan2(-axis2.along[0], axis2.along[1]);
  const ahead = Math.cos(heading) * axis2.through[0] + Math.sin(heading) * axis2.through[1];
  const other = ahead < -ROUNDING || (ahead < ROUNDING && Math.abs(heading) > Math.PI / 2 + ROUNDING);
  return other ? wrapAngle(heading + Math.PI) : heading;
}

/**
 * Pose of the flange by the formula, elementary turn after turn. Slow and plain: `flangePose` is the way to compute it.
 */
export function orthoParallelFlange(geometry: OrthoParallelGeometry, q_rad: ArrayLike<number>): Pose<"base", "flange"> {
  const { signs, offsets_rad, a1_m, a2_m, b_m, c1_m, c2_m, c3_m, c4_m } = geometry;
  const steps: readonly Turned[] = [
    [[0, 0, 0], Z],
    [[a1_m, b_m, c1_m], Y],
    [[0, 0, c2_m], Y],
    [[a2_m, 0, c3_m], Z],
    [[0, 0, 0], Y],
    [[0, 0, 0], Z],
  ];
  const running = product(identity(), steps, signs, offsets_rad, q_rad);
  return compose(
    compose(running as Pose<"base", "wrist">, pose<"wrist", "formula">([0, 0, c4_m])),
    geometry.formulaFromFlange,
  );
}

/** Where two lines square to each other meet; undefined when they are not square or pass each other. */
function meeting(a: Line, b: Line): Vector3 | undefined {
  if (Math.abs(dot(a.along, b.along)) > ROUNDING) return undefined;
  const point = addScaled(a.through, a.along, dot(subtract(b.through, a.through), a.along));
  return distanceFrom(b, point) < ROUNDING ? point : undefined;
}

/** Turn about z from one orientation to another where their z axes agree, else 0: the rest is the flange's own. */
function spinOf(from: Quaternion, to: Quaternion): number {
  const between = multiply([-from[0], -from[1], -from[2], from[3]], to);
  return Math.hypot(between[0], between[1]) < ROUNDING ? wrapAngle(2 * Math.atan2(between[2], between[3])) : 0;
}

function tidy(formulaFromFlange: Pose<"formula", "flange">): Pose<"formula", "flange"> {
  const isNothing =
    norm(formulaFromFlange.position) < 1e-12 && angleBetween(formulaFromFlange.quaternion, [0, 0, 0, 1]) < 1e-12;
  return isNothing ? identity() : formulaFromFlange;
}

function agrees(arm: SerialArm, geometry: OrthoParallelGeometry): boolean {
  const { position_m, angle_rad } = deviation(arm, q => orthoParallelFlange(geometry, q));
  return position_m < VERIFIED && angle_rad < VERIFIED;
}
