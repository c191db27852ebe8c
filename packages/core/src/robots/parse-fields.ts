import { Reader } from "../json/reader.ts";
import { pose, type Pose } from "../spatial/pose.ts";
import { fromEulerAngles } from "../spatial/turns.ts";
import type { Vector3 } from "../spatial/vector.ts";

/** `xyz_m` and `rpy_rad` of an object, R = Rz(yaw) Ry(pitch) Rx(roll); both 0 when left out. */
export function placed<Into extends string, From extends string>(
  reader: Reader,
  value: unknown,
  path: string,
  what: string,
): Pose<Into, From> | undefined {
  const file = reader.object(value, path, what);
  if (file === undefined) return undefined;
  const xyz =
    file.xyz_m === undefined ? [0, 0, 0] : reader.numbers(file.xyz_m, `${path}.xyz_m`, `the place of ${what}`, "m", 3);
  const rpy =
    file.rpy_rad === undefined
      ? [0, 0, 0]
      : reader.numbers(file.rpy_rad, `${path}.rpy_rad`, `the turn of ${what}`, "rad", 3);
  if (xyz === undefined || rpy === undefined) return undefined;
  return pose<Into, From>(
    xyz as Vector3,
    rpy.every(angle => angle === 0) ? [0, 0, 0, 1] : fromEulerAngles("zyx", rpy[2]!, rpy[1]!, rpy[0]!),
  );
}

/** Texts by their names: quantity → where it comes from. */
export function textsOf(reader: Reader, value: unknown, path: string): Record<string, string> {
  const fields = reader.object(value, path, "sources") ?? {};
  return Object.fromEntries(
    Object.entries(fields).flatMap(([key, text]) => {
      const read = reader.text(text, `${path}.${key}`, `the source of ${key}`);
      return read === undefined ? [] : [[key, read]];
    }),
  );
}
