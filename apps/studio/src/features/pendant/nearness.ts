const NEAR_RAD = (10 * Math.PI) / 180;
/** Row L-39: near is within 10° of a limit. */
export function nearness(value: number, lower: number, upper: number): "" | "near" | "bad" {
  const left = Math.min(value - lower, upper - value);
  return left < 0.0005 ? "bad" : left < NEAR_RAD ? "near" : "";
}
