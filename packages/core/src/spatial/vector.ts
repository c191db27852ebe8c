/** x, y, z. Metres unless a name says otherwise. */
export type Vector3 = [number, number, number];

export const vector = (x = 0, y = 0, z = 0): Vector3 => [x, y, z];

/** out = a + b. `out` may be either input. */
export function add(a: Vector3, b: Vector3, out: Vector3 = [0, 0, 0]): Vector3 {
  out[0] = a[0] + b[0];
  out[1] = a[1] + b[1];
  out[2] = a[2] + b[2];
  return out;
}

/** out = a − b. `out` may be either input. */
export function subtract(a: Vector3, b: Vector3, out: Vector3 = [0, 0, 0]): Vector3 {
  out[0] = a[0] - b[0];
  out[1] = a[1] - b[1];
  out[2] = a[2] - b[2];
  return out;
}

/** out = a · factor. `out` may be `a`. */
export function scale(a: Vector3, factor: number, out: Vector3 = [0, 0, 0]): Vector3 {
  out[0] = a[0] * factor;
  out[1] = a[1] * factor;
  out[2] = a[2] * factor;
  return out;
}

/** out = a + b · factor. `out` may be either input. */
export function addScaled(a: Vector3, b: Vector3, factor: number, out: Vector3 = [0, 0, 0]): Vector3 {
  out[0] = a[0] + b[0] * factor;
  out[1] = a[1] + b[1] * factor;
  out[2] = a[2] + b[2] * factor;
  return out;
}

/** out = a × b. `out` may be either input. */
export function cross(a: Vector3, b: Vector3, out: Vector3 = [0, 0, 0]): Vector3 {
  const x = a[1] * b[2] - a[2] * b[1];
  const y = a[2] * b[0] - a[0] * b[2];
  const z = a[0] * b[1] - a[1] * b[0];
  out[0] = x;
  out[1] = y;
  out[2] = z;
  return out;
}

export const dot = (a: Vector3, b: Vector3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const norm = (a: Vector3): number => Math.sqrt(dot(a, a));

export function distance(a: Vector3, b: Vector3): number {
  const x = a[0] - b[0];
  const y = a[1] - b[1];
  const z = a[2] - b[2];
  return Math.sqrt(x * x + y * y + z * z);
}

/** a / |a|. A vector shorter than 1e-300 has no direction and is returned as (0, 0, 0). */
export function normalize(a: Vector3, out: Vector3 = [0, 0, 0]): Vector3 {
  const length = norm(a);
  return scale(a, length > 1e-300 ? 1 / length : 0, out);
}

/** (1 − t) a + t b. `out` may be either input. */
export function lerp(a: Vector3, b: Vector3, t: number, out: Vector3 = [0, 0, 0]): Vector3 {
  out[0] = a[0] + (b[0] - a[0]) * t;
  out[1] = a[1] + (b[1] - a[1]) * t;
  out[2] = a[2] + (b[2] - a[2]) * t;
  return out;
}
