import { compose, identity, inverse, type Pose } from "@twincell/core";
import type { JogFrame } from "../../stores/jog.ts";
import { fixedXyz } from "./fixed-xyz.ts";

/** In which frame a jog frame is read out: joint and tool jogging are read in the world. */
export const readFrame = (frame: JogFrame): "world" | "base" | "user" =>
  frame === "base" || frame === "user" ? frame : "world";

const frameFromWorld = identity<"frame", "world">();
const frameFromTcp = identity<"frame", "tcp">();
const angles = new Float64Array(3);

/** x y z [m] and rx ry rz [rad] of the TCP in a frame; allocates nothing. */
export function readTcp(
  worldFromTcp: Pose<"world", "tcp">,
  worldFromFrame: Pose<"world", "frame">,
  out: Float64Array,
): Float64Array {
  inverse(worldFromFrame, frameFromWorld);
  compose(frameFromWorld, worldFromTcp, frameFromTcp);
  out[0] = frameFromTcp.position[0];
  out[1] = frameFromTcp.position[1];
  out[2] = frameFromTcp.position[2];
  fixedXyz(frameFromTcp.quaternion, angles);
  out[3] = angles[0]!;
  out[4] = angles[1]!;
  out[5] = angles[2]!;
  return out;
}
/** Angle left to the nearer limit as a fraction of half the range, 0 at a limit, 1 in the middle. */
export const marginFraction = (q: number, lower: number, upper: number): number =>
  Math.min(q - lower, upper - q) / ((upper - lower) / 2);
