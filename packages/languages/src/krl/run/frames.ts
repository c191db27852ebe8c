import { fromMatrix, type Pose } from "@twincell/core";

/** A KRL frame: rotation as nine numbers row by row, translation in mm. */
export interface Frame {
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

/** X, Y, Z, A, B, C: first turned by A about z, then by B about the new y, then by C about the new x. */
export function frameOf(x_mm: number, y_mm: number, z_mm: number, a_deg: number, b_deg: number, c_deg: number): Frame {
  const [ca, sa] = turn(a_deg);
  const [cb, sb] = turn(b_deg);
  const [cc, sc] = turn(c_deg);
  return {
    r: [
      ca * cb,
      ca * sb * sc - sa * cc,
      ca * sb * cc + sa * sc,
      sa * cb,
      sa * sb * sc + ca * cc,
      sa * sb * cc - ca * sc,
      -sb,
      cb * sc,
      cb * cc,
    ],
    p_mm: [x_mm, y_mm, z_mm],
  };
}

export const NULL_FRAME: Frame = frameOf(0, 0, 0, 0, 0, 0);

/** X, Y, Z, A, B, C. With B at ±90 only the sum of A and C is determined: C is 0 then. */
export function componentsOf({ r, p_mm }: Frame): [number, number, number, number, number, number] {
  const deg = (angle: number): number => (angle / Math.PI) * 180;
  const level = Math.hypot(r[0]!, r[3]!);
  const isUpright = level < 1e-9;
  const a = isUpright ? Math.atan2(-r[1]!, r[4]!) : Math.atan2(r[3]!, r[0]!);
  return [...p_mm, deg(a), deg(Math.atan2(-r[6]!, level)), isUpright ? 0 : deg(Math.atan2(r[7]!, r[8]!))];
}

/** a:b */
export function times(a: Frame, b: Frame): Frame {
  const r: number[] = [];
  for (let i = 0; i < 9; i += 3)
    for (let j = 0; j < 3; j++) r.push(a.r[i]! * b.r[j]! + a.r[i + 1]! * b.r[3 + j]! + a.r[i + 2]! * b.r[6 + j]!);
  const along = (row: number): number => a.r[row]! * b.p_mm[0] + a.r[row + 1]! * b.p_mm[1] + a.r[row + 2]! * b.p_mm[2];
  return { r, p_mm: [a.p_mm[0] + along(0), a.p_mm[1] + along(3), a.p_mm[2] + along(6)] };
}

/** INV_POS(a) */
export function inverted({ r, p_mm }: Frame): Frame {
  const back = (column: number): number =>
    -(r[column]! * p_mm[0] + r[column + 3]! * p_mm[1] + r[column + 6]! * p_mm[2]);
  return { r: [r[0]!, r[3]!, r[6]!, r[1]!, r[4]!, r[7]!, r[2]!, r[5]!, r[8]!], p_mm: [back(0), back(1), back(2)] };
}

/** In metres and as a quaternion, for the rest of the world. */
export function toPose<Into extends string = string, From extends string = string>({
  r,
  p_mm,
}: Frame): Pose<Into, From> {
  return { position: [p_mm[0] / 1000, p_mm[1] / 1000, p_mm[2] / 1000], quaternion: fromMatrix(r) };
}

export function fromPose({ position: [x, y, z], quaternion: [a, b, c, w] }: Pose): Frame {
  return {
    // biome-ignore format: table of numbers
    r: [
      1 - 2 * (b * b + c * c), 2 * (a * b - c * w), 2 * (a * c + b * w),
      2 * (a * b + c * w), 1 - 2 * (a * a + c * c), 2 * (b * c - a * w),
      2 * (a * c - b * w), 2 * (b * c + a * w), 1 - 2 * (a * a + b * b),
    ],
    p_mm: [x * 1000, y * 1000, z * 1000],
  };
}
