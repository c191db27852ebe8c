import { compose, inverse, pose, type Pose, type Robot } from "@twincell/core";
import { fixed } from "../../emitter/index.ts";

/** A micrometre, and a millionth of a radian. */
const DECIMALS = 6;
export const num = (value: number): string => fixed(value, DECIMALS);

/** The base of the robot as the controller counts it. */
export const controllerFromBase = ({ baseFromVendorWorld }: Robot): Pose<"controller", "base"> =>
  compose(pose<"controller", "vendor-world">(), inverse(baseFromVendorWorld));

/**
 * p[x, y, z, rx, ry, rz]: metres, and axis times angle. An axis can be written two ways round; near half a turn the one
 * whose largest component is positive is taken, so that the same pose is always the same text.
 */
export function poseText({ position, quaternion: [x, y, z, w] }: Pose): string {
  const sine = Math.hypot(x, y, z);
  let factor = 0;
  if (sine > 1e-12) {
    const largest = [x, y, z].reduce((a, b) => (Math.abs(b) > Math.abs(a) + 1e-6 ? b : a), 0);
    const isHalfTurn = Math.abs(w) < 1e-5;
    const sign = isHalfTurn ? Math.sign(largest) : w < 0 ? -1 : 1;
    factor = (2 * sign * Math.atan2(sine, sign * w)) / sine;
  } else factor = 2 * Math.sign(w);
  return `p[${[...position, x * factor, y * factor, z * factor].map(num).join(", ")}]`;
}

export const listText = (values: ArrayLike<number>): string => `[${Array.from(values, num).join(", ")}]`;
