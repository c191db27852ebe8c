import { explainReach } from "../kinematics/explain.ts";
import { solveAll } from "../kinematics/inverse.ts";
import { span } from "../kinematics/span.ts";
import type { Reach } from "../kinematics/reach.ts";
import { blends } from "../trajectory/moves.ts";
import { explainStop } from "../trajectory/stop.ts";
import type { Finding } from "./verdict.ts";
import { reachRepairs } from "./repairs.ts";
import { startOf, type CheckScene } from "./scene.ts";

/**
 * Targets and paths the arm cannot get to: too far, too near, no posture inside the limits, no circle, no way through.
 */
export function checkReach(scene: CheckScene): void {
  for (const { move, stop, at_s } of scene.layout.obstacles) {
    const stuck = explainStop(stop, move, scene.robot);
    if (stop.kind === "goal") {
      scene.add(move.step.id, "bad", reachFinding(stop.goal.reach, at_s, reachRepairs(scene, move, stop.goal.reach)));
      continue;
    }
    if (stop.kind === "path" && stop.stop.kind === "out-of-reach") {
      // Why the target cannot be reached says more than the step; if it can, then why the place on the way cannot.
      const target = solveAll(scene.robot, move.baseFromFlange);
      const reach = away(target) ? target : solveAll(scene.robot, stop.stop.goal);
      if (away(reach)) {
        const finding = reachFinding(reach, at_s, reachRepairs(scene, move, reach));
        scene.add(
          move.step.id,
          "bad",
          reach === target ? finding : { ...finding, sentence: `${percent(stop.share)} ${finding.sentence}` },
        );
        continue;
      }
    }
    scene.add(move.step.id, "bad", {
      code: stuck.code,
      value: "share" in stop ? stop.share : 0,
      limit: 1,
      unit: "1",
      at_s,
      sentence: stuck.sentence,
      repairs: reachRepairs(scene, move),
    });
  }
  // A blend cuts the corner: the target itself is never visited, yet it was taught and must be reachable.
  for (const move of scene.layout.moves.values()) {
    if (
      !blends(move.step) ||
      move.q_rad !== undefined ||
      move.step.path === "ptp" ||
      scene.robot.family.kind === "general"
    )
      continue;
    const { distance_m, nearest_m, farthest_m } = span(scene.robot, move.baseFromFlange);
    if (distance_m <= farthest_m && distance_m >= nearest_m) continue;
    const reach = solveAll(scene.robot, move.baseFromFlange);
    if (away(reach))
      scene.add(
        move.step.id,
        "bad",
        reachFinding(reach, startOf(scene, move.step.id), reachRepairs(scene, move, reach)),
      );
  }
}

const away = (reach: Reach): boolean =>
  reach.kind === "too-far" || reach.kind === "too-near" || reach.kind === "beyond-workspace";

const percent = (share: number): string => `At ${Math.round(share * 100)} % of the way:`;

function reachFinding(reach: Reach, at_s: number, repairs: Finding["repairs"]): Finding {
  const base = { at_s, sentence: explainReach(reach), repairs };
  switch (reach.kind) {
    case "too-far":
      return { ...base, code: "reach.too-far", value: reach.reach_m + reach.beyond_m, limit: reach.reach_m, unit: "m" };
    case "too-near":
      return {
        ...base,
        code: "reach.too-near",
        value: reach.nearest_m - reach.inside_m,
        limit: reach.nearest_m,
        unit: "m",
      };
    case "beyond-workspace":
      return { ...base, code: "reach.beyond-workspace", value: reach.distance_m, limit: reach.declared_m, unit: "m" };
    case "outside-limits":
      return {
        ...base,
        code: "limits.joint",
        joint: reach.joint,
        value: reach.wanted_rad,
        limit: reach.limit_rad,
        unit: "rad",
      };
    case "not-so-turned":
      return { ...base, code: "reach.not-so-turned", value: reach.short_rad, limit: 0, unit: "rad" };
    case "reached":
    case "no-solver":
    case "not-a-pose":
      return { ...base, code: `reach.${reach.kind}`, value: 0, limit: 0, unit: "1" };
  }
}
