import type { Pose, Vector3 } from "@twincell/core";

/** Row N-42: the close camera stands 0.5, 0.5, 0.1 m from the TCP (y counted to the side where the person stands). */
export const CLOSE_OFFSET_M: Readonly<Vector3> = [0.5, -0.5, 0.1];
const AWAY_M = Math.hypot(CLOSE_OFFSET_M[0], CLOSE_OFFSET_M[1]);
/** Where it stands seen from above: unit vector away from the TCP. */
const FREE_SIDE: Readonly<Vector3> = [CLOSE_OFFSET_M[0] / AWAY_M, CLOSE_OFFSET_M[1] / AWAY_M, 0];
/** An axis nearer to the vertical than this [sine] lies in every upright plane. */
const UPRIGHT = 1e-6;

/**
 * To which side of the TCP the camera stands. With an orientation aid it is a calibre (row N-46): it stands in the
 * upright plane of the aid, on the person's side, so that a tool at the aid's orientation is parallel to the upright
 * edges of the picture whatever the tilt, and one that leans is seen to lean.
 *
 * @param orientationPresetAxis  unit vector in the world, or null when no aid is chosen.
 * @param out      unit vector without height; written and returned.
 */
export function closeCameraSide(aidAxis: Readonly<Vector3> | null, out: Vector3): Vector3 {
  const x = aidAxis?.[0] ?? 0;
  const y = aidAxis?.[1] ?? 0;
  const level = Math.hypot(x, y);
  const free = level < UPRIGHT;
  const sign = x * FREE_SIDE[0] + y * FREE_SIDE[1] < 0 ? -1 : 1;
  out[0] = free ? FREE_SIDE[0] : (sign * x) / level;
  out[1] = free ? FREE_SIDE[1] : (sign * y) / level;
  out[2] = 0;
  return out;
}

/**
 * Where the close camera stands; it looks at the TCP.
 *
 *   level:   tcp + d · (cos t · side, sin t)            at the TCP's height for t = 0 (row N-45)
 *   offset:  tcp + offset, lifted the same way by t     exactly the offset for t = 0 without an aid (row N-42)
 *
 * @param tilt_rad  0 looks horizontally, π/2 straight down (row N-44).
 * @param side      of `closeCameraSide`.
 * @param out       written and returned; allocates nothing.
 */
export function closeCameraPosition(
  worldFromTcp: Pose<"world", "tcp">,
  placement: "level" | "offset",
  tilt_rad: number,
  side: Readonly<Vector3>,
  out: Vector3,
): Vector3 {
  const level = AWAY_M * Math.cos(tilt_rad);
  const tcp = worldFromTcp.position;
  out[0] = tcp[0] + side[0] * level;
  out[1] = tcp[1] + side[1] * level;
  out[2] = tcp[2] + AWAY_M * Math.sin(tilt_rad) + (placement === "offset" ? CLOSE_OFFSET_M[2] : 0);
  return out;
}

/** What is up in the picture. Straight down there is no "up" but the way the camera came from. */
export function closeCameraUp(tilt_rad: number, side: Readonly<Vector3>, out: Vector3): Vector3 {
  out[0] = -side[0] * Math.sin(tilt_rad);
  out[1] = -side[1] * Math.sin(tilt_rad);
  out[2] = Math.cos(tilt_rad);
  return out;
}
