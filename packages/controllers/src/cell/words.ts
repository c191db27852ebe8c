import type { Refusal } from "@twincell/core";

const mm = (metres: number): string => `${Math.max(0, Math.round(metres * 1000))} mm`;
const YIELD_HINT = "Wait until the other robot is out of the way, or change who goes first: the one opened first does.";

export const wouldStandNear = (name: string, other: string, distance_m: number, kept_m: number): Refusal => ({
  code: "cell.target",
  sentence: `At the target ${name} would be ${mm(distance_m)} from ${other}; ${mm(kept_m)} are kept between robots.`,
  hint: `Move ${other} away first, or choose another target.`,
  value: distance_m,
  limit: kept_m,
});
export const cameNearRobot = (
  name: string,
  other: string,
  distance_m: number,
  kept_m: number,
  yields: boolean,
): Refusal => ({
  code: yields ? "cell.yields" : "cell.near",
  sentence: yields
    ? `${name} would have come within ${mm(distance_m)} of ${other}, which moves and goes first, and was stopped; ${mm(kept_m)} are kept.`
    : `${name} would have come within ${mm(distance_m)} of ${other} and was stopped; ${mm(kept_m)} are kept between robots.`,
  hint: yields ? YIELD_HINT : `Move ${other} away, or move another way round.`,
  value: distance_m,
  limit: kept_m,
});
