import type { Vector3 } from "@twincell/core";
import type { PanelPlace } from "../../stores/headset.ts";

/** A panel is read from this near and this far [m]: from farther its letters would be too small. */
export const NEAREST_M = 0.5;
export const FARTHEST_M = 1.4;
/** Its upper edge: never at the feet, never over the head [m over the floor of the room]. */
export const LOWEST_M = 0.75;
export const HIGHEST_M = 1.9;
/** Turned up or down to the eyes by this at most, so that its lines still look level [rad]. */
export const MOST_TILT_RAD = (20 * Math.PI) / 180;

/**
 * Where a panel stands that was let go: where the hand left it, brought within reading distance of the eyes and turned
 * to them. Room coordinates, y up.
 */
export function settledPlace(at: Readonly<Vector3>, eye: Readonly<Vector3>): PanelPlace {
  const x = at[0] - eye[0];
  const z = at[2] - eye[2];
  const away_m = Math.hypot(x, z);
  // Exactly over or under the eyes there is no way to go: straight ahead then.
  const [wayX, wayZ] = away_m < 1e-6 ? [0, -1] : [x / away_m, z / away_m];
  const stands_m = Math.min(FARTHEST_M, Math.max(NEAREST_M, away_m));
  const y = Math.min(HIGHEST_M, Math.max(LOWEST_M, at[1]));
  return {
    at: [eye[0] + stands_m * wayX, y, eye[2] + stands_m * wayZ],
    turn_rad: Math.atan2(-wayX, -wayZ),
    tilt_rad: Math.max(-MOST_TILT_RAD, Math.min(MOST_TILT_RAD, -Math.atan2(eye[1] - y, stands_m))),
  };
}
