import type { Pose } from "@twincell/core";
import { UseFault } from "./usage.ts";

const isRecord = (value: unknown): value is Record<string, unknown> => typeof value === "object" && value !== null && !Array.isArray(value);
const isFinite = (value: unknown): value is number => typeof value === "number" && Number.isFinite(value);

/** `{"q":[…]}` with one finite angle per joint. */
export function jointsOf(value: unknown, line: number, joints: number, robot: string): number[] {
  const q = isRecord(value) ? value["q"] : undefined;
  if (!Array.isArray(q)) throw new UseFault(`Line ${line} wants {"q":[…]}.`);
  if (q.length !== joints) throw new UseFault(`Line ${line}: ${robot} has ${joints} joints but ${q.length} angles were given.`);
  const wrong = q.findIndex(angle => !isFinite(angle));
  if (wrong >= 0) throw new UseFault(`Line ${line}: the angle of joint ${wrong + 1} is not a finite number.`);
  return q as number[];
}

/** POSE: `{"position":[x,y,z],"quaternion":[x,y,z,w]}`. The quaternion is brought to length 1. */
export function poseOf(value: unknown, line: number): Pose {
  const tuple = (name: string, count: number): number[] => {
    const given = isRecord(value) ? value[name] : undefined;
    if (!Array.isArray(given) || given.length !== count || !given.every(isFinite)) throw new UseFault(`Line ${line} wants "${name}" as ${count} finite numbers.`);
    return given;
  };
  const [x, y, z] = tuple("position", 3), q = tuple("quaternion", 4);
  const length = Math.hypot(q[0]!, q[1]!, q[2]!, q[3]!);
  if (Math.abs(length - 1) > 1e-3) throw new UseFault(`Line ${line}: the quaternion has length ${length.toPrecision(4)}; a rotation has length 1.`);
  return { position: [x!, y!, z!], quaternion: [q[0]! / length, q[1]! / length, q[2]! / length, q[3]! / length] };
}
