import type { Pose } from "@twincell/core";

/** x, y, z [mm] and a unit quaternion w, x, y, z: a transformation as it is computed with here. */
export interface Trsf {
  readonly mm: readonly [number, number, number];
  readonly wxyz: readonly [number, number, number, number];
}

export const NOTHING: Trsf = { mm: [0, 0, 0], wxyz: [1, 0, 0, 0] };

const product = ([a, b, c, d]: Trsf["wxyz"], [e, f, g, h]: Trsf["wxyz"]): Trsf["wxyz"] => [
  a * e - b * f - c * g - d * h,
  a * f + b * e + c * h - d * g,
  a * g - b * h + c * e + d * f,
  a * h + b * g - c * f + d * e,
];
const turned = (q: Trsf["wxyz"], [x, y, z]: Trsf["mm"]): Trsf["mm"] => {
  const [, i, j, k] = product(product(q, [0, x, y, z]), [q[0], -q[1], -q[2], -q[3]]);
  return [i, j, k];
};

/** Turned by rx about x, then by ry about the new y, then by rz about the newest z. */
export function fromSix([x, y, z, rx, ry, rz]: readonly number[]): Trsf {
  const half = (angle_deg: number): readonly [number, number] => [
    Math.cos((angle_deg * Math.PI) / 360),
    Math.sin((angle_deg * Math.PI) / 360),
  ];
  const [cx, sx] = half(rx!);
  const [cy, sy] = half(ry!);
  const [cz, sz] = half(rz!);
  return { mm: [x!, y!, z!], wxyz: product(product([cx, sx, 0, 0], [cy, 0, sy, 0]), [cz, 0, 0, sz]) };
}

/** x, y, z, rx, ry, rz of a transformation; with ry at ±90 only the sum of rx and rz is determined, and rz is 0. */
export function toSix({ mm, wxyz: [w, x, y, z] }: Trsf): readonly number[] {
  const deg = (angle: number): number => (angle / Math.PI) * 180;
  const m00 = 1 - 2 * (y * y + z * z);
  const m01 = 2 * (x * y - w * z);
  const m02 = 2 * (x * z + w * y);
  const m12 = 2 * (y * z - w * x);
  const m22 = 1 - 2 * (x * x + y * y);
  const level = Math.hypot(m00, m01);
  if (level < 1e-9) {
    const m10 = 2 * (x * y + w * z);
    const m11 = 1 - 2 * (x * x + z * z);
    return [...mm, deg(Math.atan2(m10, m11)) * Math.sign(m02), deg(Math.atan2(m02, level)), 0];
  }
  return [...mm, deg(Math.atan2(-m12, m22)), deg(Math.atan2(m02, level)), deg(Math.atan2(-m01, m00))];
}

export function times(a: Trsf, b: Trsf): Trsf {
  const [x, y, z] = turned(a.wxyz, b.mm);
  return { mm: [a.mm[0] + x, a.mm[1] + y, a.mm[2] + z], wxyz: product(a.wxyz, b.wxyz) };
}

export function inverted({ mm, wxyz: [w, x, y, z] }: Trsf): Trsf {
  const back: Trsf["wxyz"] = [w, -x, -y, -z];
  const [a, b, c] = turned(back, mm);
  return { mm: [-a, -b, -c], wxyz: back };
}

export const toPose = <Into extends string, From extends string>({
  mm,
  wxyz: [w, x, y, z],
}: Trsf): Pose<Into, From> => ({ position: [mm[0] / 1000, mm[1] / 1000, mm[2] / 1000], quaternion: [x, y, z, w] });
export const fromPose = ({ position: [x, y, z], quaternion: [a, b, c, d] }: Pose): Trsf => ({
  mm: [x * 1000, y * 1000, z * 1000],
  wxyz: [d, a, b, c],
});
