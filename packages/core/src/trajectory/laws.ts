/** Where a law of motion is at τ = t/T: share of the way, its first and its second derivative by τ. */
export interface LawPoint { value: number; speed: number; acceleration: number }

/**
 * The cubic of the lead-through paper, from rest to rest:
 *
 *   π(τ) = 3τ² − 2τ³,   π̇ ≤ 1.5 at τ = ½,   π̈ = ±6 at the ends
 *
 * A cubic Hermite curve with both end speeds 0 is exactly this law: a move that follows it needs two nodes.
 */
export function cubicLaw(tau: number, out: LawPoint = { value: 0, speed: 0, acceleration: 0 }): LawPoint {
  const t = tau < 0 ? 0 : tau > 1 ? 1 : tau;
  out.value = t * t * (3 - 2 * t);
  out.speed = 6 * t * (1 - t);
  out.acceleration = 6 - 12 * t;
  return out;
}

/** Rest to rest in one dimension: knots of time, place and speed, with constant acceleration between them. */
export interface RestProfile { readonly times_s: Float64Array; readonly place: Float64Array; readonly speed: Float64Array }

/**
 * Trapezoid of speed: the fastest way over `distance` from rest to rest.
 *
 * @param stretch  ≥ 1: everything takes that much longer along the same shape, so both limits are kept with room.
 */
export function trapezoid(distance: number, maxSpeed: number, maxAcceleration: number, stretch = 1): RestProfile {
  const ramp = Math.min(maxSpeed / maxAcceleration, Math.sqrt(distance / maxAcceleration));
  const top = ramp * maxAcceleration, ramped = (top * ramp) / 2, cruise = Math.max(0, (distance - 2 * ramped) / top);
  const k = stretch;
  // Without cruising the two middle knots are one.
  return cruise > 1e-9 * ramp
    ? {
        times_s: Float64Array.of(0, ramp * k, (ramp + cruise) * k, (2 * ramp + cruise) * k),
        place: Float64Array.of(0, ramped, distance - ramped, distance),
        speed: Float64Array.of(0, top / k, top / k, 0),
      }
    : {
        times_s: Float64Array.of(0, ramp * k, 2 * ramp * k),
        place: Float64Array.of(0, distance / 2, distance),
        speed: Float64Array.of(0, top / k, 0),
      };
}

/** Seconds the trapezoid takes. */
export const trapezoidTime_s = (distance: number, maxSpeed: number, maxAcceleration: number): number =>
  distance >= (maxSpeed * maxSpeed) / maxAcceleration
    ? distance / maxSpeed + maxSpeed / maxAcceleration
    : 2 * Math.sqrt(distance / maxAcceleration);
