import { fromUrVector, toUrVector, compose, inverse, type Pose, type Quaternion } from "@twincell/core";

/** A controller's pose as a turn and a place. */
export interface Placed {
  readonly r: Quaternion;
  readonly p: readonly number[];
}

export const matrixOf = (six: readonly number[]): Placed => ({
  r: fromUrVector(six[3]!, six[4]!, six[5]!),
  p: six.slice(0, 3),
});
export const poseOf = <A extends string, B extends string>({ r, p }: Placed): Pose<A, B> => ({
  position: [p[0]!, p[1]!, p[2]!],
  quaternion: [...r],
});
export const placedOf = ({ position, quaternion }: Pose): Placed => ({ r: [...quaternion], p: [...position] });
/** x y z and a rotation vector. */
export function sixOf({ r, p }: Placed): number[] {
  const [x, y, z] = toUrVector(r);
  return [p[0]!, p[1]!, p[2]!, x, y, z];
}
/** a · b */
export const times = (a: Placed, b: Placed): Placed => placedOf(compose(poseOf<"a", "b">(a), poseOf<"b", "c">(b)));
export const inverted = (a: Placed): Placed => placedOf(inverse(poseOf<"a", "b">(a)));

/** The controller's base is the robot's turned by half a turn about z. */
export const HALF_TURN: Placed = { r: [0, 0, 1, 0], p: [0, 0, 0] };
