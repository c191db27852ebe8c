import { flangePose, linkPoses } from "../kinematics/forward.ts";
import { seededRandom } from "../random.ts";
import { compose, identity, pose, type Pose } from "../spatial/pose.ts";
import { angleBetween, fromAxisAngle, fromMatrix, rotate, type Quaternion } from "../spatial/quaternion.ts";
import { addScaled, cross, distance, dot, norm, scale, subtract, type Vector3 } from "../spatial/vector.ts";
import type { SerialArm } from "../model/arm.ts";

/** A joint axis in the base, all angles 0. */
export interface Line {
  readonly along: Vector3;
  readonly through: Vector3;
}

export function axesAtZero(arm: SerialArm): Line[] {
  const links = Array.from({ length: arm.joints.length + 1 }, () => identity<"base", "link">());
  linkPoses(arm, new Float64Array(arm.joints.length), links);
  return arm.joints.map(({ axis }, i) => ({
    along: rotate(links[i + 1]!.quaternion, axis),
    through: links[i + 1]!.position,
  }));
}

export const distanceFrom = (line: Line, point: Vector3): number =>
  norm(cross(subtract(point, line.through), line.along));

/** How far two directions are from parallel: the sine of the angle between them. */
export const skew = (a: Vector3, b: Vector3): number => norm(cross(a, b));

/** The point of line `a` that is nearest to line `b`; for parallel lines the one beside the point `b` is given by. */
export function footOn(a: Line, b: Line): Vector3 {
  const between = subtract(b.through, a.through);
  const cosine = dot(a.along, b.along);
  const sine2 = 1 - cosine * cosine;
  const along = dot(between, a.along);
  if (sine2 < 1e-12) return addScaled(a.through, a.along, along);
  return addScaled(a.through, a.along, (along - cosine * dot(between, b.along)) / sine2);
}

/** Smallest distance of two lines. */
export const passing = (a: Line, b: Line): number => distanceFrom(b, footOn(a, b));

/** The same line seen from a frame. */
export function seenFrom(frame: Pose, line: Line): Line {
  const back: Quaternion = [-frame.quaternion[0], -frame.quaternion[1], -frame.quaternion[2], frame.quaternion[3]];
  return { along: rotate(back, line.along), through: rotate(back, subtract(line.through, frame.position)) };
}

/** A frame with z and y as near as can be to two directions square to each other. */
export function frameOf<Into extends string, From extends string>(
  origin: Vector3,
  z: Vector3,
  y: Vector3,
): Pose<Into, From> {
  const across = addScaled(y, z, -dot(y, z));
  const length = norm(across);
  const yy = scale(across, 1 / length);
  const x = cross(yy, z);
  return pose<Into, From>(origin, fromMatrix([x[0], yy[0], z[0], x[1], yy[1], z[1], x[2], yy[2], z[2]]));
}

/** Up in the base where the axis has an up. */
export const upward = (axis: Vector3): number => (axis[2] < -1e-6 ? -1 : 1);

/** −0 and rounding to 0. */
export const clean = (length_m: number): number => (Math.abs(length_m) < 1e-12 ? 0 : length_m);

export type Turned = readonly [moved: Vector3, about: Vector3];

/** The product of moves and turns of a formula, elementary step after step. Slow and plain. */
export function product(
  start: Pose,
  steps: readonly Turned[],
  signs: readonly number[],
  offsets_rad: readonly number[],
  q_rad: ArrayLike<number>,
): Pose {
  const running: Pose = pose([...start.position], [...start.quaternion]);
  steps.forEach(([moved, about], j) => {
    compose(running, pose(moved, fromAxisAngle(about, signs[j]! * q_rad[j]! - offsets_rad[j]!)), running);
  });
  return running;
}

const TRIED_POSTURES = 40;

/** The largest distance [m] and angle [rad] between an arm's flange and a formula's over 40 random postures, seed 6. */
export function deviation(
  arm: SerialArm,
  formula: (q_rad: ArrayLike<number>) => Pose,
): { readonly position_m: number; readonly angle_rad: number } {
  const random = seededRandom(6);
  const n = arm.joints.length;
  const q = new Float64Array(n);
  let position_m = 0;
  let angle_rad = 0;
  for (let tried = 0; tried < TRIED_POSTURES; tried++) {
    for (let j = 0; j < n; j++) q[j] = 2 * Math.PI * (random() - 0.5);
    const a = flangePose(arm, q);
    const b = formula(q);
    position_m = Math.max(position_m, distance(a.position, b.position));
    angle_rad = Math.max(angle_rad, angleBetween(a.quaternion, b.quaternion));
  }
  return { position_m, angle_rad };
}
