import { fromMatrix, type Pose } from "@twincell/core";
import { rotationRows, type Matrix } from "../../parser/index.ts";

export type Six = readonly [x: number, y: number, z: number, o: number, a: number, t: number];

export const NULL: Matrix = { r: [1, 0, 0, 0, 1, 0, 0, 0, 1], p: [0, 0, 0] };
const MM = 1000;
const DEG = Math.PI / 180;

/** TRANS(x, y, z, o, a, t) in mm and degrees:  R = Rz(o) · Ry(a) · Rz(t). */
export function trans([x, y, z, o, a, t]: Six): Matrix {
  const co = Math.cos(o * DEG);
  const so = Math.sin(o * DEG);
  const ca = Math.cos(a * DEG);
  const sa = Math.sin(a * DEG);
  const ct = Math.cos(t * DEG);
  const st = Math.sin(t * DEG);
  return {
    r: [
      co * ca * ct - so * st,
      -co * ca * st - so * ct,
      co * sa,
      so * ca * ct + co * st,
      -so * ca * st + co * ct,
      so * sa,
      -sa * ct,
      sa * st,
      ca,
    ],
    p: [x, y, z],
  };
}

/** A turn about one axis [°]. */
export function about(axis: "x" | "y" | "z", angle_deg: number): Matrix {
  const c = Math.cos(angle_deg * DEG);
  const s = Math.sin(angle_deg * DEG);
  const r =
    axis === "x"
      ? [1, 0, 0, 0, c, -s, 0, s, c]
      : axis === "y"
        ? [c, 0, s, 0, 1, 0, -s, 0, c]
        : [c, -s, 0, s, c, 0, 0, 0, 1];
  return { r, p: [0, 0, 0] };
}

/** The six numbers of a place, a from 0° to 180°; where o and t turn about one axis, t is 0. */
export function sixOf({ r, p }: Matrix): Six {
  const flat = Math.hypot(r[2]!, r[5]!);
  const a = Math.atan2(flat, r[8]!) / DEG;
  if (flat < 1e-9) return [...p, Math.atan2(-r[1]!, r[4]!) / DEG, a, 0];
  return [...p, Math.atan2(r[5]!, r[2]!) / DEG, a, Math.atan2(r[7]!, -r[6]!) / DEG];
}

/** The same place moved along the axes that it is given in [mm]. */
export const shifted = ({ r, p }: Matrix, x: number, y: number, z: number): Matrix => ({
  r,
  p: [p[0] + x, p[1] + y, p[2] + z],
});

/**
 * FRAME: origin in the fourth point, x along from the first to the second, y on the side of the third. Undefined when
 * they do not span a plane.
 */
export function frameOf(a: Matrix, b: Matrix, c: Matrix, origin: Matrix): Matrix | undefined {
  const x = unit(minus(b.p, a.p));
  const z = x === undefined ? undefined : unit(cross(x, minus(c.p, a.p)));
  if (x === undefined || z === undefined) return undefined;
  const y = cross(z, x);
  return { r: [x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]], p: origin.p };
}

type Triple = readonly [number, number, number];
const minus = (a: Triple, b: Triple): Triple => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a: Triple, b: Triple): Triple => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
function unit(v: Triple): Triple | undefined {
  const length = Math.hypot(...v);
  return length < 1e-6 ? undefined : [v[0] / length, v[1] / length, v[2] / length];
}

/** In metres and as a quaternion, for the rest of the world. */
export const toPose = <Into extends string = string, From extends string = string>({
  r,
  p,
}: Matrix): Pose<Into, From> => ({ position: [p[0] / MM, p[1] / MM, p[2] / MM], quaternion: fromMatrix(r) });

export const fromPose = ({ position: [x, y, z], quaternion }: Pose): Matrix => ({
  r: rotationRows(quaternion),
  p: [x * MM, y * MM, z * MM],
});
