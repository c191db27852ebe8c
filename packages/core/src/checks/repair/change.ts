import { compose, identity, type Pose } from "../../spatial/pose.ts";
import { fromAxisAngle, rotate } from "../../spatial/quaternion.ts";
import { degrees } from "../../spatial/units.ts";
import type { Vector3 } from "../../spatial/vector.ts";

/** How a wanted pose of the tool may be changed. */
export type PoseChange =
  /** The tool turned about its own axis z. */
  | { readonly kind: "spin"; readonly angle_rad: number }
  /** The tool tilted about an axis of its xy plane that stands `axis_rad` from its x axis towards y. */
  | { readonly kind: "tilt"; readonly angle_rad: number; readonly axis_rad: number }
  /** Its tip moved, in directions of the base. */
  | { readonly kind: "shift"; readonly by_m: Vector3 };

/** What a change of this size counts as 1 when changes of different kinds are compared. */
const WHOLE = { spin_rad: Math.PI, tilt_rad: Math.PI / 6, shift_m: 0.25 } as const;

/** How large a change is, so that kinds can be compared: 180° of spin, 30° of tilt and 250 mm of shift are all 1. */
export function effortOf(change: PoseChange): number {
  switch (change.kind) {
    case "spin":
      return Math.abs(change.angle_rad) / WHOLE.spin_rad;
    case "tilt":
      return Math.abs(change.angle_rad) / WHOLE.tilt_rad;
    case "shift":
      return Math.hypot(...change.by_m) / WHOLE.shift_m;
  }
}

/** What is turned after the tool: tcpFromTurned. Undefined for a shift, which turns nothing. */
export function toolTurn(change: PoseChange): Pose<"tcp", "tcp"> | undefined {
  switch (change.kind) {
    case "spin":
      return { position: [0, 0, 0], quaternion: fromAxisAngle([0, 0, 1], change.angle_rad) };
    case "tilt":
      return {
        position: [0, 0, 0],
        quaternion: fromAxisAngle([Math.cos(change.axis_rad), Math.sin(change.axis_rad), 0], change.angle_rad),
      };
    case "shift":
      return undefined;
  }
}

/** The pose with the change made: baseFromTcp · turn, or baseFromTcp moved. */
export function changedPose(
  baseFromTcp: Pose<"base", "tcp">,
  change: PoseChange,
  out: Pose<"base", "tcp"> = identity(),
): Pose<"base", "tcp"> {
  const turn = toolTurn(change);
  if (turn !== undefined) return compose(baseFromTcp, turn, out);
  if (change.kind !== "shift") return out;
  for (let i = 0; i < 3; i++) out.position[i] = baseFromTcp.position[i]! + change.by_m[i]!;
  for (let i = 0; i < 4; i++) out.quaternion[i] = baseFromTcp.quaternion[i]!;
  return out;
}

const deg = (angle_rad: number): string => `${degrees(angle_rad).toFixed(1)}°`;
/** Directions this near to straight ones are called by their names [rad]. */
const STRAIGHT_RAD = 0.06;

/** “Tilt the tool by 9.0° about its x axis.” */
export function turnWords(change: Exclude<PoseChange, { kind: "shift" }>): string {
  if (change.kind === "spin") return `Turn the tool by ${deg(change.angle_rad)} about its own axis.`;
  const quarter = Math.round(change.axis_rad / (Math.PI / 2));
  if (Math.abs(change.axis_rad - quarter * (Math.PI / 2)) > STRAIGHT_RAD)
    return `Tilt the tool by ${deg(change.angle_rad)} about an axis ${deg(change.axis_rad)} from its x axis.`;
  const side = ((quarter % 4) + 4) % 4;
  const sign = side === 0 || side === 1 ? 1 : -1;
  return `Tilt the tool by ${deg(sign * change.angle_rad)} about its ${side % 2 === 0 ? "x" : "y"} axis.`;
}

/**
 * “160 mm towards the robot”, “20 mm up” or “+120 mm in x and −35 mm in y”.
 *
 * @param by_m  in the world. @param place_m  where the thing stands, seen from the robot, in the world's directions.
 */
export function shiftWords(by_m: Vector3, place_m: Vector3): string {
  const [x, y, z] = by_m;
  const flat = Math.hypot(x, y);
  if (flat < 1e-9) return `${mm(Math.abs(z))} ${z > 0 ? "up" : "down"}`;
  if (Math.abs(z) < 1e-9) {
    const away = Math.atan2(place_m[1], place_m[0]);
    const off = Math.atan2(y, x) - away;
    const turned = Math.atan2(Math.sin(off), Math.cos(off));
    if (Math.abs(turned) < STRAIGHT_RAD) return `${mm(flat)} away from the robot`;
    if (Math.abs(turned) > Math.PI - STRAIGHT_RAD) return `${mm(flat)} towards the robot`;
  }
  return axisWords(by_m);
}

/** “+120 mm in x and −35 mm in y”. */
export function axisWords(by_m: Vector3): string {
  const parts = (["x", "y", "z"] as const).flatMap((axis, i) =>
    Math.abs(by_m[i]!) < 5e-4 ? [] : [`${by_m[i]! < 0 ? "−" : "+"}${mm(Math.abs(by_m[i]!))} in ${axis}`],
  );
  return parts.length > 1 ? `${parts.slice(0, -1).join(", ")} and ${parts.at(-1)}` : (parts[0] ?? mm(0));
}
const mm = (length_m: number): string => `${(length_m * 1000).toFixed(length_m < 0.01 ? 1 : 0)} mm`;

/** A vector of the base in directions of the world. */
export const inWorld = (worldFromBase: Pose<"world", "base">, vector: Vector3): Vector3 =>
  rotate(worldFromBase.quaternion, vector);
