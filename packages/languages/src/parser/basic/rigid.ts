import { fromMatrix, type Pose } from "@twincell/core";

/** A place as the first three rows of its matrix, [mm] in the fourth column. */
export type Rigid = readonly number[];
export type Six = readonly [x: number, y: number, z: number, aboutX: number, aboutY: number, aboutZ: number];

export const NOWHERE: Rigid = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];
const DEG = Math.PI / 180;
const MM = 1000;

/** x, y, z [mm] and turns about the fixed x, y and z, one after the other [°]:  R = Rz(c) · Ry(b) · Rx(a). */
export function rigid([x, y, z, a, b, c]: Six): Rigid {
  const [ca, cb, cc] = [a, b, c].map(angle => Math.cos(angle * DEG)) as [number, number, number];
  const [sa, sb, sc] = [a, b, c].map(angle => Math.sin(angle * DEG)) as [number, number, number];
  return [
    cc * cb,
    cc * sb * sa - sc * ca,
    cc * sb * ca + sc * sa,
    x,
    sc * cb,
    sc * sb * sa + cc * ca,
    sc * sb * ca - cc * sa,
    y,
    -sb,
    cb * sa,
    cb * ca,
    z,
  ];
}

/** The six numbers of a place, b from −90° to 90°; where a and c turn about one axis, a is 0. */
export function sixNumbers(m: Rigid): Six {
  const level = Math.hypot(m[0]!, m[4]!);
  const b = Math.atan2(-m[8]!, level) / DEG;
  const at = [m[3]!, m[7]!, m[11]!] as const;
  if (level < 1e-9) return [...at, 0, b, Math.atan2(-m[1]!, m[5]!) / DEG];
  return [...at, Math.atan2(m[9]!, m[10]!) / DEG, b, Math.atan2(m[4]!, m[0]!) / DEG];
}

/** The place b, seen from a. */
export function on(a: Rigid, b: Rigid): Rigid {
  return Array.from({ length: 12 }, (_, i) => {
    const row = i - (i % 4);
    const column = i % 4;
    return (
      a[row]! * b[column]! +
      a[row + 1]! * b[4 + column]! +
      a[row + 2]! * b[8 + column]! +
      (column === 3 ? a[row + 3]! : 0)
    );
  });
}

export function back(m: Rigid): Rigid {
  const along = (i: number): number => -(m[i]! * m[3]! + m[4 + i]! * m[7]! + m[8 + i]! * m[11]!);
  return [m[0]!, m[4]!, m[8]!, along(0), m[1]!, m[5]!, m[9]!, along(1), m[2]!, m[6]!, m[10]!, along(2)];
}

/** The same place moved along the axes that it is given in [mm]. */
export const moved = (m: Rigid, x: number, y: number, z: number): Rigid =>
  m
    .with(3, m[3]! + x)
    .with(7, m[7]! + y)
    .with(11, m[11]! + z);

/** In metres and as a quaternion, for the rest of the world. */
export const asPose = <Into extends string = string, From extends string = string>(m: Rigid): Pose<Into, From> => ({
  position: [m[3]! / MM, m[7]! / MM, m[11]! / MM],
  quaternion: fromMatrix(m.filter((_, i) => i % 4 < 3)),
});

export function ofPose({ position: [x, y, z], quaternion: [i, j, k, r] }: Pose): Rigid {
  const half = (a: number, b: number): number => 2 * a * b;
  return [
    1 - half(j, j) - half(k, k),
    half(i, j) - half(k, r),
    half(i, k) + half(j, r),
    x * MM,
    half(i, j) + half(k, r),
    1 - half(i, i) - half(k, k),
    half(j, k) - half(i, r),
    y * MM,
    half(i, k) - half(j, r),
    half(j, k) + half(i, r),
    1 - half(i, i) - half(j, j),
    z * MM,
  ];
}
