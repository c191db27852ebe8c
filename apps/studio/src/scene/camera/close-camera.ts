import type { Pose, Vector3 } from "@twincell/core";

/** Row N-42: the close camera stands 0.5, 0.5, 0.1 m from the TCP (y counted to the side where the person stands). */
export const CLOSE_OFFSET_M: Readonly<Vector3> = [0.5, -0.5, 0.1];

/**
 * Where the close camera stands; it looks at the TCP.
 *
 *   level:   tcp + d · (cos t · side, sin t)            at the TCP's height for t = 0 (row N-45)
 *   offset:  tcp + offset, lifted the same way by t     exactly the offset for t = 0 (row N-42)
 *
 * @param tilt_rad  0 looks horizontally, π/2 straight down (row N-44).
 * @param out       written and returned; allocates nothing.
 */
export function closeCameraPosition(worldFromTcp: Pose<"world", "tcp">, placement: "level" | "offset", tilt_rad: number, out: Vector3): Vector3 {
  const [dx, dy, dz] = CLOSE_OFFSET_M, side = Math.sqrt(dx * dx + dy * dy);
  const level = Math.cos(tilt_rad), tcp = worldFromTcp.position;
  out[0] = tcp[0] + dx * level;
  out[1] = tcp[1] + dy * level;
  out[2] = tcp[2] + side * Math.sin(tilt_rad) + (placement === "offset" ? dz : 0);
  return out;
}
