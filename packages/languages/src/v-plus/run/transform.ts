import { fromMatrix, type Pose } from "@twincell/core";

/** A V+ transformation: rotation as nine numbers row by row, translation in mm. */
export interface Transform {
  readonly kind: "transform";
  readonly r: readonly number[];
  readonly p_mm: readonly [number, number, number];
}

const turn = (angle_deg: number): readonly [cosine: number, sine: number] => {
  // Quarter turns are exact, so that a tool straight down is straight down.
  const quarter = ((angle_deg % 360) + 360) % 360;
  if (quarter === 0) return [1, 0];
  if (quarter === 90) return [0, 1];
  if (quarter === 180) return [-1, 0];
  if (quarter === 270) return [0, -1];
  return [Math.cos((angle_deg / 180) * Math.PI), Math.sin((angle_deg / 180) * Math.PI)];
};

/** TRANS(x, y, z, yaw, pitch, roll): R = Rz(yaw) · Ry(pitch) · Rz(roll), multiplied out. */
export function fromTrans(
  x_mm: number,
  y_mm: number,
  z_mm: number,
  yaw_deg: number,
  pitch_deg: number,
  roll_deg: number,
): Transform {
  const [cy, sy] = turn(yaw_deg);
  const [cp, sp] = turn(pitch_deg);
  const [cr, sr] = turn(roll_deg);
  return {
    kind: "transform",
    r: [
      cy * cp * cr - sy * sr,
      -cy * cp * sr - sy * cr,
      cy * sp,
      sy * cp * cr + cy * sr,
      -sy * cp * sr + cy * cr,
      sy * sp,
      -sp * cr,
      sp * sr,
      cp,
    ],
    p_mm: [x_mm, y_mm, z_mm],
  };
}

export const NULL_TRANSFORM: Transform = fromTrans(0, 0, 0, 0, 0, 0);

/** The six components that DECOMPOSE writes. With pitch 0 or 180 only yaw ± roll is defined: roll is 0 then. */
export function components({ r, p_mm }: Transform): [number, number, number, number, number, number] {
  const sine = Math.hypot(r[2]!, r[5]!);
  const pitch = Math.atan2(sine, r[8]!);
  const flat = sine < 1e-9;
  const yaw = flat ? Math.atan2(r[3]!, r[4]!) : Math.atan2(r[5]!, r[2]!);
  const roll = flat ? 0 : Math.atan2(r[7]!, -r[6]!);
  const deg = (angle: number): number => (angle / Math.PI) * 180;
  return [p_mm[0], p_mm[1], p_mm[2], deg(yaw), deg(pitch), deg(roll)];
}

/** a:b */
export function times(a: Transform, b: Transform): Transform {
  const r: number[] = [];
  for (let i = 0; i < 9; i += 3)
    for (let j = 0; j < 3; j++) r.push(a.r[i]! * b.r[j]! + a.r[i + 1]! * b.r[3 + j]! + a.r[i + 2]! * b.r[6 + j]!);
  const along = (row: number): number => a.r[row]! * b.p_mm[0] + a.r[row + 1]! * b.p_mm[1] + a.r[row + 2]! * b.p_mm[2];
  return { kind: "transform", r, p_mm: [a.p_mm[0] + along(0), a.p_mm[1] + along(3), a.p_mm[2] + along(6)] };
}

/** INVERSE(a) */
export function inverted({ r, p_mm }: Transform): Transform {
  const back = (column: number): number =>
    -(r[column]! * p_mm[0] + r[column + 3]! * p_mm[1] + r[column + 6]! * p_mm[2]);
  return {
    kind: "transform",
    r: [r[0]!, r[3]!, r[6]!, r[1]!, r[4]!, r[7]!, r[2]!, r[5]!, r[8]!],
    p_mm: [back(0), back(1), back(2)],
  };
}

/** SHIFT(a BY dx, dy, dz): along the axes of the world. */
export const shifted = ({ r, p_mm }: Transform, x: number, y: number, z: number): Transform => ({
  kind: "transform",
  r,
  p_mm: [p_mm[0] + x, p_mm[1] + y, p_mm[2] + z],
});

/** RX, RY and RZ. */
export function about(axis: "x" | "y" | "z", angle_deg: number): Transform {
  const [c, s] = turn(angle_deg);
  const r =
    axis === "x"
      ? [1, 0, 0, 0, c, -s, 0, s, c]
      : axis === "y"
        ? [c, 0, s, 0, 1, 0, -s, 0, c]
        : [c, -s, 0, s, c, 0, 0, 0, 1];
  return { kind: "transform", r, p_mm: [0, 0, 0] };
}

/**
 * FRAME(o, x, xy, at): x axis from the origin of `o` to that of `x`, y towards `xy`, origin that of `at`.
 * Undefined when the three points lie on a line.
 */
export function frameOf(o: Transform, x: Transform, xy: Transform, at: Transform): Transform | undefined {
  const ex = unit(minus(x.p_mm, o.p_mm));
  const ez = ex && unit(crossed(ex, minus(xy.p_mm, o.p_mm)));
  if (ex === undefined || ez === undefined) return undefined;
  const ey = crossed(ez, ex);
  return {
    kind: "transform",
    r: [ex[0]!, ey[0]!, ez[0]!, ex[1]!, ey[1]!, ez[1]!, ex[2]!, ey[2]!, ez[2]!],
    p_mm: at.p_mm,
  };
}

const minus = (a: readonly number[], b: readonly number[]): number[] => [a[0]! - b[0]!, a[1]! - b[1]!, a[2]! - b[2]!];
const crossed = (a: readonly number[], b: readonly number[]): number[] => [
  a[1]! * b[2]! - a[2]! * b[1]!,
  a[2]! * b[0]! - a[0]! * b[2]!,
  a[0]! * b[1]! - a[1]! * b[0]!,
];
function unit(a: readonly number[]): number[] | undefined {
  const length = Math.hypot(...a);
  return length < 1e-9 ? undefined : a.map(x => x / length);
}

/** In metres and as a quaternion, for the rest of the world. */
export function toPose<Into extends string = string, From extends string = string>({
  r,
  p_mm,
}: Transform): Pose<Into, From> {
  return { position: [p_mm[0] / 1000, p_mm[1] / 1000, p_mm[2] / 1000], quaternion: fromMatrix(r) };
}

export function fromPose({ position: [x, y, z], quaternion: [a, b, c, w] }: Pose): Transform {
  return {
    kind: "transform",
    // biome-ignore format: table of numbers
    r: [
      1 - 2 * (b * b + c * c), 2 * (a * b - c * w), 2 * (a * c + b * w),
      2 * (a * b + c * w), 1 - 2 * (a * a + c * c), 2 * (b * c - a * w),
      2 * (a * c - b * w), 2 * (b * c + a * w), 1 - 2 * (a * a + b * b),
    ],
    p_mm: [x * 1000, y * 1000, z * 1000],
  };
}
