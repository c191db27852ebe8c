import type { OrthoParallelGeometry } from "../../model/robot.ts";
import { base, shoulder, upperArm } from "./articulated-lower.ts";
import { elbow, flange, forearm, knuckle } from "./articulated-upper.ts";
import type { LinkDesign } from "./link-shape.ts";
import { standing } from "./standing.ts";

/** The seven links of an upright six-axis arm in castings, drawn from its seven lengths. */
export function articulatedArm(geometry: OrthoParallelGeometry): LinkDesign[] {
  const at = standing(geometry);
  return [base(at), shoulder(at), upperArm(at), elbow(at), forearm(at), knuckle(at), flange(at)];
}
