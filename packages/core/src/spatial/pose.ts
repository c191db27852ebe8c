import { conjugate, multiply, rotate, type Quaternion } from "./quaternion.ts";
import type { Vector3 } from "./vector.ts";

declare const frames: unique symbol;

/**
 * Where frame `From` is, seen in frame `Into`:  p_into = R(quaternion) · p_from + position.
 * A variable is named for both (`worldFromBase`), and the type checks that inner names cancel when two are composed.
 */
export interface Pose<Into extends string = string, From extends string = string> {
  readonly [frames]?: readonly [Into, From];
  /** Origin of From seen in Into [m]. */
  readonly position: Vector3;
  /** x, y, z, w. */
  readonly quaternion: Quaternion;
}

export function identity<Into extends string = string, From extends string = string>(): Pose<Into, From> {
  return { position: [0, 0, 0], quaternion: [0, 0, 0, 1] };
}

export function pose<Into extends string = string, From extends string = string>(
  position: Vector3 = [0, 0, 0],
  quaternion: Quaternion = [0, 0, 0, 1],
): Pose<Into, From> {
  return { position, quaternion };
}

/** aFromC = aFromB · bFromC. `out` may be either input. */
export function compose<A extends string, B extends string, C extends string>(
  aFromB: Pose<A, B>,
  bFromC: Pose<NoInfer<B>, C>,
  out: Pose<NoInfer<A>, NoInfer<C>> = identity(),
): Pose<A, C> {
  const px = aFromB.position[0];
  const py = aFromB.position[1];
  const pz = aFromB.position[2];
  rotate(aFromB.quaternion, bFromC.position, out.position);
  out.position[0] += px;
  out.position[1] += py;
  out.position[2] += pz;
  multiply(aFromB.quaternion, bFromC.quaternion, out.quaternion);
  return out;
}

/** bFromA = aFromB⁻¹. `out` may be the input. */
export function inverse<A extends string, B extends string>(
  aFromB: Pose<A, B>,
  out: Pose<NoInfer<B>, NoInfer<A>> = identity(),
): Pose<B, A> {
  conjugate(aFromB.quaternion, out.quaternion);
  rotate(out.quaternion, aFromB.position, out.position);
  out.position[0] = -out.position[0];
  out.position[1] = -out.position[1];
  out.position[2] = -out.position[2];
  return out;
}

/** p_into = intoFromFrom · p_from. `out` may be the point. */
export function transformPoint(intoFromFrom: Pose, point: Vector3, out: Vector3 = [0, 0, 0]): Vector3 {
  rotate(intoFromFrom.quaternion, point, out);
  out[0] += intoFromFrom.position[0];
  out[1] += intoFromFrom.position[1];
  out[2] += intoFromFrom.position[2];
  return out;
}

/** Copies `from` into `out`. */
export function copyPose<A extends string, B extends string>(
  from: Pose<A, B>,
  out: Pose<NoInfer<A>, NoInfer<B>> = identity(),
): Pose<A, B> {
  for (let i = 0; i < 3; i++) out.position[i] = from.position[i]!;
  for (let i = 0; i < 4; i++) out.quaternion[i] = from.quaternion[i]!;
  return out;
}

/** Whether two poses differ by less than a distance [m] and an angle [rad, up to π]. Cheaper than measuring both. */
export function posesAgree(a: Pose, b: Pose, within_m: number, within_rad: number): boolean {
  const p = a.position;
  const o = b.position;
  const q = a.quaternion;
  const r = b.quaternion;
  const dx = p[0] - o[0];
  const dy = p[1] - o[1];
  const dz = p[2] - o[2];
  if (!(dx * dx + dy * dy + dz * dz < within_m * within_m)) return false;
  // The vector part of a⁻¹ b is as long as the sine of half the angle.
  const x = q[3] * r[0] - q[0] * r[3] - q[1] * r[2] + q[2] * r[1];
  const y = q[3] * r[1] + q[0] * r[2] - q[1] * r[3] - q[2] * r[0];
  const z = q[3] * r[2] - q[0] * r[1] + q[1] * r[0] - q[2] * r[3];
  const limit = within_rad < 1e-3 ? within_rad / 2 : Math.sin(within_rad / 2);
  return x * x + y * y + z * z < limit * limit;
}
