import type { Pose } from "@twincell/core";

/** A RAPID pose: mm, and a quaternion w, x, y, z. */
export interface Frame {
  readonly mm: readonly [number, number, number];
  readonly wxyz: readonly [number, number, number, number];
}

export const NOTHING: Frame = { mm: [0, 0, 0], wxyz: [1, 0, 0, 0] };

const product = ([a, b, c, d]: Frame["wxyz"], [e, f, g, h]: Frame["wxyz"]): Frame["wxyz"] => [
  a * e - b * f - c * g - d * h,
  a * f + b * e + c * h - d * g,
  a * g - b * h + c * e + d * f,
  a * h + b * g - c * f + d * e,
];

/** v turned by q:  q v q*. */
export function turned(q: Frame["wxyz"], [x, y, z]: Frame["mm"]): Frame["mm"] {
  const [, i, j, k] = product(product(q, [0, x, y, z]), [q[0], -q[1], -q[2], -q[3]]);
  return [i, j, k];
}

/** PoseMult(a, b) */
export function times(a: Frame, b: Frame): Frame {
  const [x, y, z] = turned(a.wxyz, b.mm);
  return { mm: [a.mm[0] + x, a.mm[1] + y, a.mm[2] + z], wxyz: product(a.wxyz, b.wxyz) };
}

/** PoseInv(a) */
export function inverted({ mm, wxyz: [w, x, y, z] }: Frame): Frame {
  const back: Frame["wxyz"] = [w, -x, -y, -z];
  const [a, b, c] = turned(back, mm);
  return { mm: [-a, -b, -c], wxyz: back };
}

/** OrientZYX(z, y, x):  Rz · Ry · Rx, degrees. */
export function orientZyx(z_deg: number, y_deg: number, x_deg: number): Frame["wxyz"] {
  const half = (angle_deg: number): readonly [number, number] => [
    Math.cos((angle_deg / 360) * Math.PI),
    Math.sin((angle_deg / 360) * Math.PI),
  ];
  const [cz, sz] = half(z_deg);
  const [cy, sy] = half(y_deg);
  const [cx, sx] = half(x_deg);
  return product(product([cz, 0, 0, sz], [cy, 0, sy, 0]), [cx, sx, 0, 0]);
}

/** EulerZYX of a quaternion, in degrees: x, y, z. */
export function eulerZyx([w, x, y, z]: Frame["wxyz"]): readonly [x: number, y: number, z: number] {
  const deg = (angle: number): number => (angle / Math.PI) * 180;
  return [
    deg(Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))),
    deg(Math.asin(Math.max(-1, Math.min(1, 2 * (w * y - z * x))))),
    deg(Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))),
  ];
}

/** Of length 1, or undefined for one that is none: RAPID takes a thousandth of difference. */
export function normal([w, x, y, z]: Frame["wxyz"]): Frame["wxyz"] | undefined {
  const size = Math.hypot(w, x, y, z);
  return Math.abs(size - 1) > 1e-3 ? undefined : [w / size, x / size, y / size, z / size];
}

/** In metres, x y z w, for the rest of the world. */
export const toPose = <Into extends string, From extends string>({
  mm,
  wxyz: [w, x, y, z],
}: Frame): Pose<Into, From> => ({ position: [mm[0] / 1000, mm[1] / 1000, mm[2] / 1000], quaternion: [x, y, z, w] });
export const fromPose = ({ position: [x, y, z], quaternion: [a, b, c, d] }: Pose): Frame => ({
  mm: [x * 1000, y * 1000, z * 1000],
  wxyz: [d, a, b, c],
});
