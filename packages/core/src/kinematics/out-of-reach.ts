import type { GeneralSixGeometry, Robot } from "../model/robot.ts";
import type { Pose } from "../spatial/pose.ts";
import { CONDITION, evaluate, generalSixScratch, MARGIN, THETA6, wantWrist } from "./general-six.ts";
import type { Reach } from "./reach.ts";
import { span } from "./span.ts";

/**
 * Why no branch exists: the wrist lies beyond the stretched or inside the folded arm, or cannot be turned as wanted
 * there.
 */
export function outOfReach(robot: Robot, baseFromFlange: Pose<"base", "flange">): Reach {
  const { farthest_m, nearest_m, distance_m } = span(robot, baseFromFlange);
  const family = robot.family;
  if (distance_m > farthest_m) return { kind: "too-far", beyond_m: distance_m - farthest_m, reach_m: farthest_m };
  if (distance_m < nearest_m || family.kind === "ortho-parallel")
    return { kind: "too-near", inside_m: nearest_m - distance_m, nearest_m };
  if (family.kind === "general-6r") return { kind: "not-so-turned", short_rad: shortOfTurn(family, baseFromFlange) };
  return { kind: "no-solver", because: `No posture of ${robot.name} was found for this pose.` };
}

const SAMPLES = 360;

/**
 * The least change of the angle between axes 4 and 5, over all θ6 and all four ways of standing, that would make the
 * pose possible.
 */
function shortOfTurn(family: GeneralSixGeometry, baseFromFlange: Pose<"base", "flange">): number {
  const scratch = generalSixScratch();
  const { axis4: u, axis5: h } = family;
  const built = u[0] * h[0] + u[1] * h[1] + u[2] * h[2];
  wantWrist(family, baseFromFlange, scratch);
  let least = Math.PI;
  for (let i = 0; i < SAMPLES; i++) {
    for (let way = 0; way < 4; way++) {
      scratch.at[THETA6] = (2 * Math.PI * i) / SAMPLES;
      evaluate(family, way < 2 ? 1 : -1, way % 2 === 0 ? 1 : -1, scratch);
      if (scratch.at[MARGIN]! < 0) continue;
      const turned = Math.acos(Math.max(-1, Math.min(1, scratch.at[CONDITION]! + built)));
      least = Math.min(least, Math.abs(turned - Math.acos(Math.max(-1, Math.min(1, built)))));
    }
  }
  return least;
}
