import type { Vector3 as WorldVector } from "@twincell/core";
import type { Vector3 } from "three";

/**
 * three's y-up scene to the z-up world: the only place where the two meet, besides the rotated group that holds the
 * world.
 */
export function toWorld(scene: Vector3, out: WorldVector): WorldVector {
  out[0] = scene.x;
  out[1] = -scene.z;
  out[2] = scene.y;
  return out;
}
export const toScene = (world: Readonly<WorldVector>, out: Vector3): Vector3 => out.set(world[0], world[2], -world[1]);
