const TURN = 2 * Math.PI;

export const radians = (angle_deg: number): number => (angle_deg * Math.PI) / 180;
export const degrees = (angle_rad: number): number => (angle_rad * 180) / Math.PI;
export const millimetres = (length_m: number): number => length_m * 1000;
export const metres = (length_mm: number): number => length_mm / 1000;

/** The same angle in (−π, π]. */
export function wrapAngle(angle_rad: number): number {
  if (angle_rad > -Math.PI && angle_rad <= Math.PI) return angle_rad;
  const wrapped = angle_rad - TURN * Math.floor((angle_rad + Math.PI) / TURN);
  return wrapped <= -Math.PI ? wrapped + TURN : wrapped > Math.PI ? wrapped - TURN : wrapped;
}
