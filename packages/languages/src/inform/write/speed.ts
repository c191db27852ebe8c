import { nearestLevel, type MoveStep, type Speed } from "@twincell/core";
import { fixed } from "./location.ts";

/** Limits of VJ= [%] and V= [mm/s]. */
const SLOWEST_VJ = 0.01;
const SLOWEST_V = 0.1;
const FASTEST_V = 1500;
/** Least of ACC= and DEC= [%]. */
const SOFTEST = 20;
export const FASTEST_MPS = FASTEST_V / 1000;

export function speedText({ path, speed }: MoveStep, maxTcpSpeed_mps: number): string {
  if (path === "ptp")
    return `VJ=${fixed(Math.min(100, Math.max(SLOWEST_VJ, shareOf(speed, maxTcpSpeed_mps) * 100)), 2)}`;
  return `V=${fixed(Math.min(FASTEST_V, Math.max(SLOWEST_V, pathSpeed(speed, maxTcpSpeed_mps) * 1000)), 1)}`;
}

/** A speed of the tool is only its share of the robot's greatest on a joint motion. */
const shareOf = (speed: Speed, max_mps: number): number =>
  "ratio" in speed ? speed.ratio : "mps" in speed ? speed.mps / max_mps : 1;
export const pathSpeed = (speed: Speed, max_mps: number): number =>
  "mps" in speed ? speed.mps : "ratio" in speed ? speed.ratio * max_mps : max_mps;

export function accelerationText({ acceleration }: MoveStep): string {
  if (acceleration === undefined) return "";
  const percent = Math.min(100, Math.max(SOFTEST, Math.round(acceleration.ratio * 100)));
  return percent === 100 ? "" : ` ACC=${percent} DEC=${percent}`;
}

/** Straight paths take the radius itself, the others the level that is nearest. */
export function cornerText(path: MoveStep["path"], corner_m: number): string {
  if (!(corner_m > 0)) return " PL=0";
  return path === "lin" ? ` CR=${fixed(Math.max(0.1, corner_m * 1000), 1)}` : ` PL=${nearestLevel(corner_m)}`;
}
