/** Where a law of motion is at τ = t/T: share of the way, its first and its second derivative by τ. */
export interface LawPoint {
  value: number;
  speed: number;
  acceleration: number;
}

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
export interface RestProfile {
  readonly times_s: Float64Array;
  readonly place: Float64Array;
  readonly speed: Float64Array;
}

/**
 * Trapezoid of speed: the fastest way over `distance` from rest to rest.
 *
 * @param stretch  ≥ 1: everything takes that much longer along the same shape, so both limits are kept with room.
 */
export function trapezoid(distance: number, maxSpeed: number, maxAcceleration: number, stretch = 1): RestProfile {
  const ramp = Math.min(maxSpeed / maxAcceleration, Math.sqrt(distance / maxAcceleration));
  const top = ramp * maxAcceleration;
  const ramped = (top * ramp) / 2;
  const cruise = Math.max(0, (distance - 2 * ramped) / top);
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

/**
 * Trapezoid of speed with its corners rounded: the fastest way over `distance` from rest to rest with limited jerk.
 * Between its knots the jerk is constant, so a cubic through places and speeds is exact.
 *
 *   ramp to v:  t = v/a + a/j (or 2 √(v/j) where a is not reached),  way = v t / 2
 *
 * @param stretch  ≥ 1: everything takes that much longer along the same shape, so all limits are kept with room.
 */
export function sCurve(
  distance: number,
  maxSpeed: number,
  maxAcceleration: number,
  maxJerk: number,
  stretch = 1,
): RestProfile {
  const bendable = (maxAcceleration * maxAcceleration) / maxJerk;
  let v = maxSpeed;
  if (distance < v * rampTime_s(v, maxAcceleration, maxJerk)) {
    const k = maxAcceleration / maxJerk;
    v = (maxAcceleration / 2) * (Math.sqrt(k * k + (4 * distance) / maxAcceleration) - k);
    if (v < bendable) v = Math.cbrt((distance * distance * maxJerk) / 4);
  }
  const bend = v < bendable ? Math.sqrt(v / maxJerk) : maxAcceleration / maxJerk;
  const hold = v < bendable ? 0 : v / maxAcceleration - bend;
  const cruise = Math.max(0, distance / v - 2 * bend - hold);
  const pieces = [bend, hold, bend, cruise, bend, hold, bend];
  const jerks = [1, 0, -1, 0, -1, 0, 1];
  const times: number[] = [0];
  const place: number[] = [0];
  const speed: number[] = [0];
  let t = 0;
  let p = 0;
  let s = 0;
  let a = 0;
  for (let i = 0; i < pieces.length; i++) {
    const h = pieces[i]!;
    const j = jerks[i]! * maxJerk;
    p += h * (s + h * (a / 2 + (h * j) / 6));
    s += h * (a + (h * j) / 2);
    a += h * j;
    t += h;
    if (h <= 1e-12 * t) continue;
    times.push(t * stretch);
    place.push(p);
    speed.push(s / stretch);
  }
  place[place.length - 1] = distance;
  speed[speed.length - 1] = 0;
  return { times_s: Float64Array.from(times), place: Float64Array.from(place), speed: Float64Array.from(speed) };
}

/** Seconds from standstill to a speed. */
const rampTime_s = (speed: number, acceleration: number, jerk: number): number =>
  speed >= (acceleration * acceleration) / jerk
    ? speed / acceleration + acceleration / jerk
    : 2 * Math.sqrt(speed / jerk);

/** Seconds the rounded trapezoid takes. */
export const sCurveTime_s = (distance: number, maxSpeed: number, maxAcceleration: number, maxJerk: number): number =>
  sCurve(distance, maxSpeed, maxAcceleration, maxJerk).times_s.at(-1)!;
