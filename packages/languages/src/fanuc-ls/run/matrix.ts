import type { Pose } from "@twincell/core";

/** A pose as a controller computes with it: rows of the rotation, and mm. */
export interface Matrix {
  readonly rows: readonly (readonly [number, number, number])[];
  readonly mm: readonly [number, number, number];
}

export const NOTHING: Matrix = {
  rows: [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
  mm: [0, 0, 0],
};

/** X, Y, Z, W, P, R: turned by W about x, then by P about the y and by R about the z that stay where they are. */
export function fromSix([x, y, z, w, p, r]: readonly number[]): Matrix {
  const turn = (angle_deg: number): readonly [number, number] => {
    const angle = (angle_deg * Math.PI) / 180;
    return [Math.cos(angle), Math.sin(angle)];
  };
  const [cw, sw] = turn(w!);
  const [cp, sp] = turn(p!);
  const [cr, sr] = turn(r!);
  return {
    mm: [x!, y!, z!],
    rows: [
      [cr * cp, cr * sp * sw - sr * cw, cr * sp * cw + sr * sw],
      [sr * cp, sr * sp * sw + cr * cw, sr * sp * cw - cr * sw],
      [-sp, cp * sw, cp * cw],
    ],
  };
}

/** X, Y, Z, W, P, R of a pose, W 0 where P is upright. */
export function toSix({ rows: [a, b, c], mm }: Matrix): readonly number[] {
  const deg = (y: number, x: number): number => (Math.atan2(y, x) * 180) / Math.PI;
  const flat = Math.hypot(a![0], b![0]);
  const p = deg(-c![0], flat);
  return flat < 1e-9 ? [...mm, 0, p, deg(-a![1], b![1])] : [...mm, deg(c![1], c![2]), p, deg(b![0], a![0])];
}

const times3 = (rows: Matrix["rows"], [x, y, z]: readonly [number, number, number]): [number, number, number] => {
  const [a, b, c] = rows;
  return [a![0] * x + a![1] * y + a![2] * z, b![0] * x + b![1] * y + b![2] * z, c![0] * x + c![1] * y + c![2] * z];
};
const column = (rows: Matrix["rows"], i: 0 | 1 | 2): readonly [number, number, number] => [
  rows[0]![i],
  rows[1]![i],
  rows[2]![i],
];

export function times(a: Matrix, b: Matrix): Matrix {
  const [x, y, z] = times3(a.rows, b.mm);
  const [i, j, k] = ([0, 1, 2] as const).map(n => times3(a.rows, column(b.rows, n)));
  return {
    mm: [a.mm[0] + x, a.mm[1] + y, a.mm[2] + z],
    rows: ([0, 1, 2] as const).map(n => [i![n], j![n], k![n]] as const),
  };
}

export function inverted({ rows, mm }: Matrix): Matrix {
  const back = ([0, 1, 2] as const).map(n => column(rows, n));
  const [x, y, z] = times3(back, mm);
  return { rows: back, mm: [-x, -y, -z] };
}

/** In metres with a quaternion, for the rest of the world. */
export function toPose<Into extends string, From extends string>({
  rows: [a, b, c],
  mm: [x, y, z],
}: Matrix): Pose<Into, From> {
  const [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = [a!, b!, c!];
  const four = [1 + xx + yy + zz, 1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz];
  const most = four.indexOf(Math.max(...four));
  const s = 2 * Math.sqrt(four[most]!);
  const wxyz =
    most === 0
      ? [s / 4, (zy - yz) / s, (xz - zx) / s, (yx - xy) / s]
      : most === 1
        ? [(zy - yz) / s, s / 4, (xy + yx) / s, (xz + zx) / s]
        : most === 2
          ? [(xz - zx) / s, (xy + yx) / s, s / 4, (yz + zy) / s]
          : [(yx - xy) / s, (xz + zx) / s, (yz + zy) / s, s / 4];
  return { position: [x / 1000, y / 1000, z / 1000], quaternion: [wxyz[1]!, wxyz[2]!, wxyz[3]!, wxyz[0]!] };
}

export function fromPose({ position: [x, y, z], quaternion: [i, j, k, w] }: Pose): Matrix {
  return {
    mm: [x * 1000, y * 1000, z * 1000],
    // biome-ignore format: table of numbers
    rows: [
      [1 - 2 * (j * j + k * k), 2 * (i * j - k * w), 2 * (i * k + j * w)],
      [2 * (i * j + k * w), 1 - 2 * (i * i + k * k), 2 * (j * k - i * w)],
      [2 * (i * k - j * w), 2 * (j * k + i * w), 1 - 2 * (i * i + j * j)],
    ],
  };
}

/** The place moved by a distance [mm] along the axes that it is given in. */
export const moved = ({ rows, mm }: Matrix, [x, y, z]: readonly [number, number, number]): Matrix => ({
  rows,
  mm: [mm[0] + x, mm[1] + y, mm[2] + z],
});
