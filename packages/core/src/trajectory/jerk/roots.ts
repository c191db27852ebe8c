/** Steps of Newton's method; from the right side of a convex function it never needs as many. */
const MOST_STEPS = 60;

/** Coefficients c[0] + c[1] x + … + c[4] x⁴ at x. */
const value = (c: Float64Array, x: number): number => (((c[4]! * x + c[3]!) * x + c[2]!) * x + c[1]!) * x + c[0]!;
const slope = (c: Float64Array, x: number): number => ((4 * c[4]! * x + 3 * c[3]!) * x + 2 * c[2]!) * x + c[1]!;
const bend = (c: Float64Array, x: number): number => (12 * c[4]! * x + 6 * c[3]!) * x + 2 * c[2]!;

/**
 * All real roots of a polynomial of fourth degree at most in [low, high], rising. Between its inflection points a curve
 * is convex or concave, so it has two roots there at most, and Newton's method from the outside meets each without
 * a leap.
 *
 * @param c    five coefficients, lowest degree first.
 * @param out  receives the roots from index `at` on.
 * @returns    index behind the last root.
 */
export function rootsWithin(c: Float64Array, low: number, high: number, out: Float64Array, at: number): number {
  if (!(high > low)) return high === low && Math.abs(value(c, low)) <= rounding(c, low) ? put(out, at, low) : at;
  // c″ = 12 c4 x² + 6 c3 x + 2 c2
  const a = 6 * c[4]!;
  const b = 3 * c[3]!;
  const root2 = b * b - 4 * a * c[2]!;
  let first = high;
  let second = high;
  if (a !== 0 && root2 > 0) {
    const k = -(b + (b < 0 ? -1 : 1) * Math.sqrt(root2)) / 2;
    const p = k / a;
    const q = k !== 0 ? c[2]! / k : p;
    first = Math.min(p, q);
    second = Math.max(p, q);
  } else if (a === 0 && b !== 0) first = second = -c[2]! / b;
  let from = low;
  let next = at;
  if (first > low && first < high) {
    next = rootsOfArc(c, from, first, out, next, at);
    from = first;
  }
  if (second > from && second < high) {
    next = rootsOfArc(c, from, second, out, next, at);
    from = second;
  }
  return rootsOfArc(c, from, high, out, next, at);
}

/** How far from 0 the value at a root may be for rounding. */
const rounding = (c: Float64Array, x: number): number =>
  1e-13 *
  (Math.abs(c[0]!) +
    Math.abs(c[1]! * x) +
    Math.abs(c[2]! * x * x) +
    Math.abs(c[3]! * x * x * x) +
    Math.abs(c[4]! * x * x * x * x));

function put(out: Float64Array, at: number, x: number): number {
  out[at] = x;
  return at + 1;
}

/** Roots where the curve bends one way only; a root on a border that the arc before has found is not found again. */
function rootsOfArc(c: Float64Array, low: number, high: number, out: Float64Array, at: number, start: number): number {
  const fl = value(c, low);
  const fh = value(c, high);
  const middle = bend(c, (low + high) / 2);
  const up = middle >= 0 ? 1 : -1;
  let next = at;
  if (Math.abs(fl) <= rounding(c, low)) {
    if (!(next > start && out[next - 1] === low)) next = put(out, next, low);
    if (slope(c, low) * up >= 0) return next;
    return fh * up > 0 ? put(out, next, newton(c, high, low, high)) : next;
  }
  if (Math.abs(fh) <= rounding(c, high)) {
    if (slope(c, high) * up > 0 && fl * up > 0) next = put(out, next, newton(c, low, low, high));
    return put(out, next, high);
  }
  if (fl * fh < 0) return put(out, next, newton(c, fl * up > 0 ? low : high, low, high));
  if (fl * up < 0 || slope(c, low) * up >= 0 || slope(c, high) * up <= 0) return next;
  const bottom = turningPoint(c, low, high, up);
  if (value(c, bottom) * up > 0) return next;
  next = put(out, next, newton(c, low, low, bottom));
  return put(out, next, newton(c, high, bottom, high));
}

/** From an end where value and bend have the same sign the steps go towards the root and never past it. */
function newton(c: Float64Array, from: number, low: number, high: number): number {
  let x = from;
  for (let step = 0; step < MOST_STEPS; step++) {
    const s = slope(c, x);
    if (s === 0) return x;
    const to = Math.min(high, Math.max(low, x - value(c, x) / s));
    if (Math.abs(to - x) <= 2e-16 * Math.abs(x)) return to;
    x = to;
  }
  return x;
}

/** Where the slope, which rises (up = 1) or falls (−1) all the way, is 0: by halving, the last digits do not matter. */
function turningPoint(c: Float64Array, from: number, to: number, up: number): number {
  let low = from;
  let high = to;
  for (let step = 0; step < MOST_STEPS && high - low > 1e-15 * (Math.abs(low) + Math.abs(high)); step++) {
    const middle = (low + high) / 2;
    if (slope(c, middle) * up < 0) low = middle;
    else high = middle;
  }
  return (low + high) / 2;
}
