import {
  addScaled,
  compose,
  copyPose,
  cross,
  dot,
  fromAxisAngle,
  identity,
  multiply,
  normalize,
  type Pose,
  type Quaternion,
  rotate,
  subtract,
  type Vector3,
} from "@twincell/core";
import type { HandlePart } from "../interaction.ts";

/** A ray in the world; direction is a unit vector. */
export interface Ray {
  readonly origin: Vector3;
  readonly direction: Vector3;
}

/** A drag as it began. */
export interface Grip {
  readonly part: HandlePart;
  readonly worldFromTcp: Pose<"world", "tcp">;
  /** Orientation of the handle's axes. */
  readonly axes: Quaternion;
  readonly ray: Ray;
  /** From the eye into the picture: the free handle moves in the plane across it. */
  readonly view: Vector3;
}

const AXIS: Readonly<Record<"x" | "y" | "z", Vector3>> = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
/** Rings and planes seen this close to edge-on cannot be hit by the ray in a useful place. */
const EDGE_ON = 0.12;

/** Where the ray meets the plane through `point`; null when it runs along it or away from it. */
function onPlane(ray: Ray, point: Vector3, normal: Vector3): Vector3 | null {
  const towards = dot(ray.direction, normal);
  if (Math.abs(towards) < 1e-4) return null;
  const t = dot(subtract(point, ray.origin), normal) / towards;
  return t > 0 ? addScaled(ray.origin, ray.direction, t) : null;
}

/** Place along the line point + s · axis nearest to the ray. */
function alongAxis(ray: Ray, point: Vector3, axis: Vector3): number | null {
  const between = subtract(point, ray.origin);
  const skew = dot(axis, ray.direction);
  const area = 1 - skew * skew;
  return area < 1e-4 ? null : (skew * dot(ray.direction, between) - dot(axis, between)) / area;
}

/**
 * Where the tool tip should be for the pointer's present ray. Pure: the same grip and ray give the same pose, so a drag
 * never creeps.
 *
 * @param snap  grid for lengths [m] and angles [rad]; 0 for none.
 */
export function dragged(
  grip: Grip,
  ray: Ray,
  snap_m: number,
  snap_rad: number,
  out: Pose<"world", "tcp">,
): Pose<"world", "tcp"> {
  copyPose(grip.worldFromTcp, out);
  const centre = grip.worldFromTcp.position;
  const { part } = grip;
  const snapped = (value: number, grid: number): number => (grid > 0 ? Math.round(value / grid) * grid : value);
  if (part === "x" || part === "y" || part === "z") {
    const axis = rotate(grip.axes, AXIS[part]);
    const from = alongAxis(grip.ray, centre, axis);
    const to = alongAxis(ray, centre, axis);
    if (from !== null && to !== null) addScaled(centre, axis, snapped(to - from, snap_m), out.position);
  } else if (part === "rx" || part === "ry" || part === "rz") {
    const axis = rotate(grip.axes, AXIS[part === "rx" ? "x" : part === "ry" ? "y" : "z"]);
    const angle = snapped(turned(grip, ray, axis), snap_rad);
    multiply(fromAxisAngle(axis, angle), grip.worldFromTcp.quaternion, out.quaternion);
  } else {
    const normal =
      part === "free" ? grip.view : rotate(grip.axes, AXIS[part === "yz" ? "x" : part === "zx" ? "y" : "z"]);
    const from = onPlane(grip.ray, centre, normal);
    const to = onPlane(ray, centre, normal);
    if (from && to) {
      const move = subtract(to, from);
      for (let k = 0; k < 3; k++) out.position[k] = centre[k]! + snapped(move[k]!, snap_m);
    }
  }
  return out;
}

function turned(grip: Grip, ray: Ray, axis: Vector3): number {
  const centre = grip.worldFromTcp.position;
  if (Math.abs(dot(grip.view, axis)) > EDGE_ON) {
    const from = onPlane(grip.ray, centre, axis);
    const to = onPlane(ray, centre, axis);
    if (!from || !to) return 0;
    const a = normalize(subtract(from, centre));
    const b = normalize(subtract(to, centre));
    return Math.atan2(dot(cross(a, b), axis), dot(a, b));
  }
  // Seen from its edge the ring is a line: going along it turns it, as a wheel under the hand.
  const tangent = normalize(cross(axis, grip.view));
  const from = onPlane(grip.ray, centre, grip.view);
  const to = onPlane(ray, centre, grip.view);
  if (!from || !to) return 0;
  const radius = Math.max(0.02, Math.sqrt(dot(subtract(from, centre), subtract(from, centre))));
  return -dot(subtract(to, from), tangent) / radius;
}

/**
 * What of a wanted pose the hand may do: a share of its way since the grip, and nothing along locked axes of the handle
 * or of the turn (rows L-28, L-30). At the moment of the grip it is the pose of the grip, whatever the share: taking
 * the tool moves nothing (row L-29).
 *
 * @param wanted  written in place.
 */
export function restrained(
  { worldFromTcp, axes }: Pick<Grip, "worldFromTcp" | "axes">,
  share: number,
  locks: { readonly x: boolean; readonly y: boolean; readonly z: boolean; readonly turn: boolean },
  wanted: Pose<"world", "tcp">,
): Pose<"world", "tcp"> {
  const back: Quaternion = [-axes[0], -axes[1], -axes[2], axes[3]];
  const way = rotate(back, subtract(wanted.position, worldFromTcp.position));
  const own: Vector3 = [locks.x ? 0 : way[0] * share, locks.y ? 0 : way[1] * share, locks.z ? 0 : way[2] * share];
  const move = rotate(axes, own);
  for (let k = 0; k < 3; k++) wanted.position[k] = worldFromTcp.position[k]! + move[k]!;
  if (locks.turn) for (let k = 0; k < 4; k++) wanted.quaternion[k] = worldFromTcp.quaternion[k]!;
  else if (share !== 1) scaleTurn(worldFromTcp.quaternion, share, wanted.quaternion);
  return wanted;
}
/** The turn from one orientation to another, times a share; a share above 1 goes beyond. */
function scaleTurn(from: Quaternion, share: number, to: Quaternion): void {
  const turn = multiply(to, [-from[0], -from[1], -from[2], from[3]]);
  const sign = turn[3] < 0 ? -1 : 1;
  const half = Math.hypot(turn[0], turn[1], turn[2]);
  if (half < 1e-12) return;
  const axis: Vector3 = [(sign * turn[0]) / half, (sign * turn[1]) / half, (sign * turn[2]) / half];
  const angle = 2 * Math.atan2(half, sign * turn[3]);
  multiply(fromAxisAngle(axis, angle * share), from, to);
}

/**
 * A rigid grip in the hand: the tool tip keeps its place in the hand from the moment it was taken, so taking it moves
 * nothing.
 *
 *   worldFromTcp = worldFromHand · (worldFromHand₀⁻¹ · worldFromTcp₀)
 */
export function carried(
  worldFromHand: Pose<"world", "hand">,
  handFromTcp: Pose<"hand", "tcp">,
  out: Pose<"world", "tcp"> = identity(),
): Pose<"world", "tcp"> {
  return compose(worldFromHand, handFromTcp, out);
}
