import type { Pose } from "@twincell/core";
import { UseFault } from "./usage.ts";

const isRecord = (value: unknown): value is Record<string, unknown> =>
  typeof value === "object" && value !== null && !Array.isArray(value);
const isFinite = (value: unknown): value is number => typeof value === "number" && Number.isFinite(value);

/** `{"q":[…]}` of that line with one finite angle per joint. */
export const jointsOf = (value: unknown, line: number, joints: number, robot: string): number[] =>
  jointsAt(value, `Line ${line}`, joints, robot);

/** As `jointsOf`, for a value that is found elsewhere than on a line. */
export function jointsAt(value: unknown, where: string, joints: number, robot: string): number[] {
  const q = isRecord(value) ? value["q"] : undefined;
  if (!Array.isArray(q)) throw new UseFault(`${where} wants {"q":[…]}.`);
  if (q.length !== joints)
    throw new UseFault(`${where}: ${robot} has ${joints} joints but ${q.length} angles were given.`);
  const wrong = q.findIndex(angle => !isFinite(angle));
  if (wrong >= 0) throw new UseFault(`${where}: the angle of joint ${wrong + 1} is not a finite number.`);
  return q as number[];
}

/** POSE of that line: `{"position":[x,y,z],"quaternion":[x,y,z,w]}`. The quaternion is brought to length 1. */
export const poseOf = (value: unknown, line: number): Pose => poseAt(value, `Line ${line}`);

/** As `poseOf`, for a value that is found elsewhere than on a line. */
export function poseAt(value: unknown, where: string): Pose {
  const tuple = (name: string, count: number): number[] => {
    const given = isRecord(value) ? value[name] : undefined;
    if (!Array.isArray(given) || given.length !== count || !given.every(isFinite))
      throw new UseFault(`${where} wants "${name}" as ${count} finite numbers.`);
    return given;
  };
  const [x, y, z] = tuple("position", 3);
  const q = tuple("quaternion", 4);
  const length = Math.hypot(q[0]!, q[1]!, q[2]!, q[3]!);
  if (Math.abs(length - 1) > 1e-3)
    throw new UseFault(`${where}: the quaternion has length ${length.toPrecision(4)}; a rotation has length 1.`);
  return { position: [x!, y!, z!], quaternion: [q[0]! / length, q[1]! / length, q[2]! / length, q[3]! / length] };
}
