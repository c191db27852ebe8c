import { fromAxisAngle, multiply, type Quaternion } from "./quaternion.ts";
import { wrapAngle } from "./units.ts";
import type { Vector3 } from "./vector.ts";

/**
 * Three turns one after the other, each about an axis of the frame as turned so far (intrinsic): "zyx" is Rz · Ry · Rx.
 */
export type EulerSequence =
  | "xyz"
  | "xzy"
  | "yxz"
  | "yzx"
  | "zxy"
  | "zyx"
  | "xyx"
  | "xzx"
  | "yxy"
  | "yzy"
  | "zxz"
  | "zyz";

const AXIS: Readonly<Record<string, Vector3>> = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
const INDEX: Readonly<Record<string, 0 | 1 | 2>> = { x: 0, y: 1, z: 2 };
/** Closer to the border of the middle angle than this [rad] only the sum of the outer two is determined. */
const BORDER_RAD = 1e-9;

/** R = R_first(a) · R_second(b) · R_third(c). Radians. */
export function fromEulerAngles(
  sequence: EulerSequence,
  a_rad: number,
  b_rad: number,
  c_rad: number,
  out: Quaternion = [0, 0, 0, 1],
): Quaternion {
  fromAxisAngle(AXIS[sequence[0]!]!, a_rad, out);
  multiply(out, fromAxisAngle(AXIS[sequence[1]!]!, b_rad), out);
  return multiply(out, fromAxisAngle(AXIS[sequence[2]!]!, c_rad), out);
}

/**
 * The three turns of an orientation [rad]. Outer angles in (−π, π]; the middle one in [0, π] where first and third axis
 * are the same, else in [−π/2, π/2]. Where only the sum of the outer two is determined the third is 0.
 *
 * @param q    unit quaternion. Read only.
 * @param out  receives first, second, third and is returned.
 * @see Bernardes, Viollet, Quaternion to Euler angles conversion: a direct, general and computationally efficient
 * method, PLoS ONE 17(11) 2022.
 */
export function toEulerAngles(sequence: EulerSequence, q: Quaternion, out: Vector3 = [0, 0, 0]): Vector3 {
  // The method counts turns about fixed axes: the same three in reverse order.
  const i = INDEX[sequence[2]!]!;
  const j = INDEX[sequence[1]!]!;
  const last = INDEX[sequence[0]!]!;
  const proper = i === last;
  const k = proper ? 3 - i - j : last;
  const sign = ((i - j) * (j - k) * (k - i)) / 2;
  const w = q[3];
  const qi = q[i]!;
  const qj = q[j]!;
  const qk = q[k]! * sign;
  const a = proper ? w : w - qj;
  const b = proper ? qi : qi + qk;
  const c = proper ? qj : qj + w;
  const d = proper ? qk : qk - qi;
  const middle = 2 * Math.atan2(Math.sqrt(c * c + d * d), Math.sqrt(a * a + b * b));
  const plus = Math.atan2(b, a);
  const minus = Math.atan2(d, c);
  let third = plus - minus;
  let first = plus + minus;
  if (middle < BORDER_RAD) {
    third = 0;
    first = 2 * plus;
  } else if (middle > Math.PI - BORDER_RAD) {
    third = 0;
    first = 2 * minus;
  }
  out[0] = wrapAngle(proper ? first : first * sign);
  out[1] = proper ? middle : middle - Math.PI / 2;
  out[2] = wrapAngle(third);
  return out;
}
