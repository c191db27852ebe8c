import type { BaseSquare } from "@twincell/core";
import { Color } from "three";

/** Fewer points than this share are not worth a colour. */
const LEAST_SHARE = 0.4;
const RED = new Color("#ff6157");
const AMBER = new Color("#f0b13c");
const GREEN = new Color("#57c785");
const TEAL = new Color("#3fb8b3");

/** Red to amber by the share of the points that are reached, green where all are, teal where all have room. */
export function baseSquareColour({ reached, roomy }: BaseSquare, points: number): string | null {
  const share = points === 0 ? 0 : reached / points;
  if (share < LEAST_SHARE) return null;
  const colour =
    share < 1
      ? new Color().lerpColors(RED, AMBER, (share - LEAST_SHARE) / (1 - LEAST_SHARE))
      : new Color().lerpColors(GREEN, TEAL, roomy / points);
  return `#${colour.getHexString()}`;
}
