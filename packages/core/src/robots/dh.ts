import { linkPoses } from "../kinematics/forward.ts";
import { compose, identity, inverse, pose, type Pose } from "../spatial/pose.ts";
import { fromAxisAngle, fromMatrix, rotate } from "../spatial/quaternion.ts";
import { wrapAngle } from "../spatial/units.ts";
import { addScaled, cross, dot, norm, scale, subtract, type Vector3 } from "../spatial/vector.ts";
import type { Joint, JointLimits, SerialArm } from "../model/arm.ts";
import { isSlide } from "../model/slide.ts";

/**
 * Whose Denavit–Hartenberg parameters:
 *
 *   standard (1955, Paul)    T_i = Rz(θ_i) · Tz(d_i) · Tx(a_i) · Rx(α_i)
 *   modified (Craig)         T_i = Rx(α_i) · Tx(a_i) · Rz(θ_i) · Tz(d_i)        row i holds Craig's a_{i−1} and α_{i−1}
 *
 * with θ_i = sense_i · q_i + thetaOffset_i; of a row that slides θ_i = thetaOffset_i, and d_i grows by sense_i · q_i.
 */
export type DhConvention = "standard" | "modified";

export interface DhRow {
  readonly a_m: number;
  readonly alpha_rad: number;
  readonly d_m: number;
  readonly thetaOffset_rad: number;
  /** −1 where a positive joint angle turns the left way about z, or a positive slide goes down it. */
  readonly sense: 1 | -1;
  /** The joint moves along z and not about it. */
  readonly slides?: true;
}

/** baseFromFlange = baseFromFirst · Π T_i · lastFromFlange. The two outer poses take what no row can say. */
export interface DhTable {
  readonly convention: DhConvention;
  readonly rows: readonly DhRow[];
  readonly baseFromFirst: Pose<"base", "first">;
  readonly lastFromFlange: Pose<"last", "flange">;
}

const X: Vector3 = [1, 0, 0];
const Z: Vector3 = [0, 0, 1];
const turnX = (angle_rad: number): Pose => pose([0, 0, 0], fromAxisAngle(X, angle_rad));
const turnZ = (angle_rad: number): Pose => pose([0, 0, 0], fromAxisAngle(Z, angle_rad));

/**
 * The arm of a D-H table. Its joints turn about z or slide along it, −z where the sense is −1, of frames laid as the
 * convention lays them.
 *
 * @param joints  name and limits of every row, in order.
 */
export function armFromDh(
  name: string,
  table: DhTable,
  joints: readonly { readonly name: string; readonly limits: JointLimits }[],
): SerialArm {
  let waiting: Pose = table.baseFromFirst;
  const built = table.rows.map((row, i): Joint => {
    const along = pose([row.a_m, 0, row.d_m]);
    const given = joints[i]!;
    const before = table.convention === "modified" ? compose(turnX(row.alpha_rad), along) : identity();
    const parentFromJoint = compose(compose(waiting, before), turnZ(row.thetaOffset_rad)) as Pose<"parent", "joint">;
    waiting = table.convention === "modified" ? identity() : compose(along, turnX(row.alpha_rad));
    return {
      name: given.name,
      ...(row.slides === true ? { kind: "prismatic" as const } : {}),
      limits: given.limits,
      axis: [0, 0, row.sense],
      parentFromJoint,
    };
  });
  return {
    name,
    joints: built,
    lastJointFromFlange: compose(waiting, table.lastFromFlange as Pose) as Pose<"joint", "flange">,
  };
}

interface Line {
  readonly along: Vector3;
  readonly through: Vector3;
}
/** A frame being laid: its x axis, and a point that axis leaves from. */
interface Normal {
  readonly x: Vector3;
  readonly from: Vector3;
  readonly to: Vector3;
}

/** Directions closer than this are parallel: rounding, not construction. */
const PARALLEL = 1e-11;
/** Lines closer than this [m] meet. */
const MEETS = 1e-12;

/**
 * The D-H table of an arm. The first frame stands on axis 1 where it is nearest the base, turned as the base; the rest
 * of it stays in `baseFromFirst` (identity for an arm whose axis 1 is the base's z). The last frame goes to the flange
 * where the flange lies on the last axis (modified) or anywhere (standard); `lastFromFlange` is what remains.
 *
 * Forward kinematics of the table and of the arm agree to 1e-12 m and rad unless two neighbouring axes are inclined by
 * less than a thousandth of a degree: their common normal is then kilometres away, and the numbers of the table with
 * it.
 *
 * @see Craig, Introduction to Robotics, ch. 3; Denavit, Hartenberg, J. Appl. Mech. 1955.
 */
export function dhFromArm(arm: SerialArm, convention: DhConvention): DhTable {
  const axes = axesAtZero(arm);
  const flange = flangeAtZero(arm);
  const first = axes[0]!;
  const last = axes.at(-1)!;
  const foot = addScaled(first.through, first.along, -dot(first.through, first.along));
  const x0 = square(X, first.along) ?? square([0, 1, 0], first.along) ?? X;
  const normals: Normal[] = [{ x: x0, from: foot, to: foot }];
  axes.slice(1).forEach((axis, i) => {
    normals.push(normalBetween(axes[i]!, axis, normals[i]!));
  });
  const flangeZ: Line = { along: rotate(flange.quaternion, Z), through: flange.position };
  const ends = convention === "standard" ? flangeZ : last;
  normals.push(lastNormal(last, ends, flange, normals.at(-1)!));

  const rows = axes.map((axis, i): DhRow => {
    const before = normals[i]!;
    const after = normals[i + 1]!;
    const own = convention === "standard" ? after : before;
    const other = convention === "standard" ? (axes[i + 1] ?? flangeZ) : axis;
    const here = convention === "standard" ? axis : (axes[i - 1] ?? axis);
    return {
      a_m: clean(dot(subtract(own.to, own.from), own.x)),
      alpha_rad: clean(turnAbout(own.x, here.along, other.along)),
      d_m: clean(dot(subtract(after.from, before.to), axis.along)),
      thetaOffset_rad: clean(turnAbout(axis.along, before.x, after.x)),
      sense: 1,
      ...(isSlide(arm.joints[i]!) ? { slides: true as const } : {}),
    };
  });
  const baseFromFirst = frame<"base", "first">(foot, x0, first.along);
  const end = normals.at(-1)!;
  const baseFromLast = frame<"base", "last">(end.to, end.x, ends.along);
  return { convention, rows, baseFromFirst, lastFromFlange: tidy(compose(inverse(baseFromLast), flange)) };
}

/** The common normal of two axes, from the first to the second; along parallel axes it stays where it comes from. */
function normalBetween(axis: Line, next: Line, before: Normal): Normal {
  const across = cross(axis.along, next.along);
  const sine = norm(across);
  const between = subtract(next.through, axis.through);
  if (sine < PARALLEL) {
    const from = before.to;
    const over = subtract(next.through, from);
    const beside = addScaled(over, axis.along, -dot(over, axis.along));
    const width = norm(beside);
    return width < MEETS
      ? { x: before.x, from, to: from }
      : { x: scale(beside, 1 / width), from, to: addScaled(from, beside, 1) };
  }
  const unit = scale(across, 1 / sine);
  const gap = dot(between, unit);
  const from = addScaled(axis.through, axis.along, dot(cross(between, next.along), across) / (sine * sine));
  // Where the axes meet the normal may point both ways: the way that turns less from the one before.
  const x =
    Math.abs(gap) < MEETS ? (dot(unit, before.x) < -1e-9 ? scale(unit, -1) : unit) : scale(unit, Math.sign(gap));
  return { x, from, to: addScaled(from, unit, Math.abs(gap) < MEETS ? 0 : gap) };
}

/**
 * The last frame: at the flange itself when its z lies on the last axis, else at the common normal with the flange's z.
 */
function lastNormal(last: Line, ends: Line, flange: Pose, before: Normal): Normal {
  const z = rotate(flange.quaternion, Z);
  const away = subtract(flange.position, last.through);
  const beside = addScaled(away, last.along, -dot(away, last.along));
  const x = rotate(flange.quaternion, X);
  const onAxis = addScaled(last.through, last.along, dot(away, last.along));
  const isParallel = norm(cross(z, last.along)) < PARALLEL;
  if (isParallel && norm(beside) < MEETS) return { x, from: onAxis, to: onAxis };
  if (ends === last) return { x: before.x, from: before.to, to: before.to };
  if (isParallel) return { x: scale(beside, 1 / norm(beside)), from: onAxis, to: flange.position };
  return normalBetween(last, ends, before);
}

function axesAtZero(arm: SerialArm): Line[] {
  return framesAtZero(arm)
    .slice(1)
    .map(({ position, quaternion }, i) => ({ along: rotate(quaternion, arm.joints[i]!.axis), through: position }));
}
const flangeAtZero = (arm: SerialArm): Pose<"base", "flange"> =>
  compose(framesAtZero(arm).at(-1) as Pose, arm.lastJointFromFlange as Pose) as Pose<"base", "flange">;
function framesAtZero(arm: SerialArm): Pose<"base", "link">[] {
  const links = Array.from({ length: arm.joints.length + 1 }, () => identity<"base", "link">());
  linkPoses(arm, new Float64Array(arm.joints.length), links);
  return links;
}

/** The part of a direction square to an axis, of length 1; undefined when nothing is left. */
function square(direction: Vector3, axis: Vector3): Vector3 | undefined {
  const rest = addScaled(direction, axis, -dot(direction, axis));
  const length = norm(rest);
  return length < 1e-6 ? undefined : scale(rest, 1 / length);
}

/** Angle from one direction to another about an axis square to both [rad]. */
const turnAbout = (axis: Vector3, from: Vector3, to: Vector3): number =>
  wrapAngle(Math.atan2(dot(cross(from, to), axis), dot(from, to)));

function frame<Into extends string, From extends string>(origin: Vector3, x: Vector3, z: Vector3): Pose<Into, From> {
  const y = cross(z, x);
  return pose<Into, From>(origin, fromMatrix([x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]]));
}

/** −0 and rounding to 0. */
const clean = (value: number): number => (Math.abs(value) < 1e-14 ? 0 : value);
function tidy(lastFromFlange: Pose<"last", "flange">): Pose<"last", "flange"> {
  const {
    position: [x, y, z],
    quaternion: [i, j, k, w],
  } = lastFromFlange;
  return pose([clean(x), clean(y), clean(z)], [clean(i), clean(j), clean(k), clean(w)]);
}
