/** Nearer to the middle than this nothing moves. */
const DEAD = 0.14;
/** So much nearer to one axis the other is left out: a thumb does not go straight. */
const STRAIGHT = 0.28;

/**
 * How far a finger holds a pad out of its middle, −1 … 1 each way: nothing near the middle, all at the rim, and along
 * one axis alone where it is nearly so.
 */
export function deflection(x: number, y: number): readonly [number, number] {
  const far = Math.hypot(x, y);
  if (!(far > DEAD)) return [0, 0];
  const amount = Math.min(1, (far - DEAD) / (1 - DEAD)) / far;
  const [right, up] = [x * amount, y * amount];
  if (Math.abs(x) < STRAIGHT * Math.abs(y)) return [0, Math.sign(y) * Math.hypot(right, up)];
  if (Math.abs(y) < STRAIGHT * Math.abs(x)) return [Math.sign(x) * Math.hypot(right, up), 0];
  return [right, up];
}
