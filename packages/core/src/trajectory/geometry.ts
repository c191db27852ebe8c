import type { Pose } from "../spatial/pose.ts";
import {
  angleBetween,
  conjugate,
  fromAxisAngle,
  multiply,
  rotate,
  slerp,
  type Quaternion,
} from "../spatial/quaternion.ts";
import { addScaled, cross, distance, dot, norm, normalize, subtract, type Vector3 } from "../spatial/vector.ts";

/** Where the tool only turns, one radian counts as this much path [m]: at 0.25 m/s it turns with 2.5 rad/s. */
export const TURN_M_PER_RAD = 0.1;

/** Straight TCP line, orientation along the great circle. */
export interface Line {
  readonly kind: "line";
  readonly from: Pose;
  readonly to: Pose;
  readonly turn: Vector3;
  readonly length: number;
}
/** Circle: centre + r (cos φ u + sin φ v), orientation along the great circle from start to end. */
export interface Arc {
  readonly kind: "arc";
  readonly from: Pose;
  readonly to: Pose;
  readonly turn: Vector3;
  readonly length: number;
  readonly centre: Vector3;
  readonly u: Vector3;
  readonly v: Vector3;
  readonly radius: number;
  readonly angle: number;
}
/** Cubic Hermite position and cubic Bézier rotation with given twists (per unit of s) at both ends. */
export interface Curve {
  readonly kind: "curve";
  readonly from: Pose;
  readonly to: Pose;
  readonly length: number;
  readonly v0: Vector3;
  readonly v1: Vector3;
  readonly c1: Quaternion;
  readonly c2: Quaternion;
}
/** A path of the TCP in the base, s from 0 to length; |dp/ds| ≤ 1 on lines and arcs. */
export type PosePath = Line | Arc | Curve;

/** Rotation vector from a to b in the directions both are seen in [rad]. */
export function turnBetween(a: Quaternion, b: Quaternion): Vector3 {
  const r = multiply(b, conjugate(a));
  const angle = angleBetween(a, b);
  const sine = Math.sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
  const factor = sine < 1e-12 ? 0 : (r[3] < 0 ? -angle : angle) / sine;
  return [r[0] * factor, r[1] * factor, r[2] * factor];
}

/** The rotation vector's rotation, put before `q`. */
function turned(q: Quaternion, turn: Vector3, factor: number): Quaternion {
  const angle = norm(turn);
  return angle * Math.abs(factor) < 1e-15 ? [...q] : multiply(fromAxisAngle(normalize(turn), angle * factor), q);
}

export function linePath(from: Pose, to: Pose): Line {
  const turn = turnBetween(from.quaternion, to.quaternion);
  return {
    kind: "line",
    from,
    to,
    turn,
    length: Math.max(distance(from.position, to.position), TURN_M_PER_RAD * norm(turn)),
  };
}

/** The circle from `from` through `via` to `to`; undefined when the three points lie on a line. */
export function arcPath(from: Pose, via: Vector3, to: Pose): Arc | undefined {
  const a = subtract(via, from.position);
  const b = subtract(to.position, from.position);
  const normal = cross(a, b);
  const area2 = dot(normal, normal);
  if (area2 < 1e-12 * dot(a, a) * dot(b, b) || area2 === 0) return undefined;
  // Circumcentre − start = ( |b|² n × a + |a|² b × n ) / 2 |n|²,  n = a × b.
  const centre: Vector3 = [...from.position];
  addScaled(centre, cross(normal, a), dot(b, b) / (2 * area2), centre);
  addScaled(centre, cross(b, normal), dot(a, a) / (2 * area2), centre);
  const u = subtract(from.position, centre);
  const radius = norm(u);
  normalize(u, u);
  const v = cross(normalize(normal), u);
  const out = subtract(to.position, centre);
  const raw = Math.atan2(dot(out, v), dot(out, u));
  const angle = raw > 0 ? raw : raw + 2 * Math.PI;
  const turn = turnBetween(from.quaternion, to.quaternion);
  return {
    kind: "arc",
    from,
    to,
    turn,
    centre,
    u,
    v,
    radius,
    angle,
    length: Math.max(radius * angle, TURN_M_PER_RAD * norm(turn)),
  };
}

/** @param twist0 @param twist1  velocity and angular velocity per unit of s at both ends. */
export function curvePath(
  from: Pose,
  twist0: ArrayLike<number>,
  to: Pose,
  twist1: ArrayLike<number>,
  length: number,
): Curve {
  const w0: Vector3 = [twist0[3]!, twist0[4]!, twist0[5]!];
  const w1: Vector3 = [twist1[3]!, twist1[4]!, twist1[5]!];
  return {
    kind: "curve",
    from,
    to,
    length,
    v0: [twist0[0]!, twist0[1]!, twist0[2]!],
    v1: [twist1[0]!, twist1[1]!, twist1[2]!],
    c1: turned(from.quaternion, w0, length / 3),
    c2: turned(to.quaternion, w1, -length / 3),
  };
}

/** Working memory of `posePoint` and `poseTwist`. */
export interface GeometryScratch {
  readonly a: Quaternion;
  readonly b: Quaternion;
  readonly c: Quaternion;
  readonly before: Pose;
  readonly after: Pose;
}
export const geometryScratch = (): GeometryScratch => ({
  a: [0, 0, 0, 1],
  b: [0, 0, 0, 1],
  c: [0, 0, 0, 1],
  before: { position: [0, 0, 0], quaternion: [0, 0, 0, 1] },
  after: { position: [0, 0, 0], quaternion: [0, 0, 0, 1] },
});

/** Pose at s. A little outside 0 … length the curve goes on smoothly. */
export function posePoint(path: PosePath, s: number, out: Pose, scratch: GeometryScratch): void {
  const u = path.length > 0 ? s / path.length : 0;
  const from = path.from;
  const to = path.to;
  const p = out.position;
  switch (path.kind) {
    case "line":
      for (let i = 0; i < 3; i++) p[i] = from.position[i]! + (to.position[i]! - from.position[i]!) * u;
      slerp(from.quaternion, to.quaternion, u, out.quaternion);
      return;
    case "arc": {
      const c = Math.cos(path.angle * u) * path.radius;
      const d = Math.sin(path.angle * u) * path.radius;
      for (let i = 0; i < 3; i++) p[i] = path.centre[i]! + path.u[i]! * c + path.v[i]! * d;
      slerp(from.quaternion, to.quaternion, u, out.quaternion);
      return;
    }
    case "curve": {
      const u2 = u * u;
      const u3 = u2 * u;
      const h01 = 3 * u2 - 2 * u3;
      const h10 = (u3 - 2 * u2 + u) * path.length;
      const h11 = (u3 - u2) * path.length;
      for (let i = 0; i < 3; i++)
        p[i] = from.position[i]! * (1 - h01) + to.position[i]! * h01 + path.v0[i]! * h10 + path.v1[i]! * h11;
      const { a, b, c } = scratch;
      slerp(from.quaternion, path.c1, u, a);
      slerp(path.c1, path.c2, u, b);
      slerp(path.c2, to.quaternion, u, c);
      slerp(a, b, u, a);
      slerp(b, c, u, b);
      slerp(a, b, u, out.quaternion);
    }
  }
}

/** Velocity and angular velocity per unit of s, in base directions. @param out 6 numbers. */
export function poseTwist(path: PosePath, s: number, out: Float64Array, scratch: GeometryScratch): void {
  const L = path.length;
  const { from, to } = path;
  switch (path.kind) {
    case "line":
      for (let i = 0; i < 3; i++) {
        out[i] = (to.position[i]! - from.position[i]!) / L;
        out[3 + i] = path.turn[i]! / L;
      }
      return;
    case "arc": {
      const phi = (path.angle * s) / L;
      const c = Math.cos(phi);
      const d = Math.sin(phi);
      const rate = (path.radius * path.angle) / L;
      for (let i = 0; i < 3; i++) {
        out[i] = (path.v[i]! * c - path.u[i]! * d) * rate;
        out[3 + i] = path.turn[i]! / L;
      }
      return;
    }
    case "curve": {
      const u = s / L;
      const step = 1e-5 * L;
      const h01 = (6 * (u - u * u)) / L;
      const h10 = 1 - 4 * u + 3 * u * u;
      const h11 = 3 * u * u - 2 * u;
      for (let i = 0; i < 3; i++)
        out[i] = (to.position[i]! - from.position[i]!) * h01 + path.v0[i]! * h10 + path.v1[i]! * h11;
      posePoint(path, s - step, scratch.before, scratch);
      posePoint(path, s + step, scratch.after, scratch);
      conjugate(scratch.before.quaternion, scratch.a);
      multiply(scratch.after.quaternion, scratch.a, scratch.a);
      const sign = scratch.a[3] < 0 ? -1 : 1;
      for (let i = 0; i < 3; i++) out[3 + i] = (sign * scratch.a[i]!) / step;
    }
  }
}

/** Moves a twist's velocity to the point `offset` away on the same body: v + ω × offset. */
export function shiftTwist(twist: Float64Array, offset: Vector3): void {
  const w: Vector3 = [twist[3]!, twist[4]!, twist[5]!];
  const extra = cross(w, offset);
  for (let i = 0; i < 3; i++) twist[i]! += extra[i]!;
}

/** The TCP-to-flange offset seen in base directions. */
export const offsetInBase = (baseFromTcp: Pose, tcpFromFlange: Pose, out: Vector3 = [0, 0, 0]): Vector3 =>
  rotate(baseFromTcp.quaternion, tcpFromFlange.position, out);
