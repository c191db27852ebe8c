import { explainReach } from "../kinematics/explain.ts";
import type { Reach } from "../kinematics/reach.ts";
import type { Robot } from "../model/robot.ts";
import { jointText, movesTo } from "../model/slide.ts";
import { millimetres } from "../spatial/units.ts";
import type { Move } from "./moves.ts";
import type { RunStop } from "./run-path.ts";

/** Why a step cannot be carried out, in numbers and in words. */
export interface Stuck {
  readonly step: string;
  readonly code: string;
  readonly sentence: string;
  readonly hint: string;
  readonly reach?: Reach;
}

/** What stands in the way of a move, in words. */
export function explainStop(stop: RunStop, move: Move, robot: Robot): Stuck {
  const step = move.step.id;
  switch (stop.kind) {
    case "straight-circle":
      return {
        step,
        code: "path.circle",
        sentence: `Start, via point and target of step “${step}” lie on one line, so no circle passes through them.`,
        hint: "Move the via point off the line, or make it a straight move.",
      };
    case "limit": {
      const joint = robot.arm.joints[stop.joint - 1]!;
      return {
        step,
        code: "limits.joint",
        sentence: `At ${Math.round(stop.share * 100)} % of step “${step}” joint ${stop.joint} would ${movesTo(joint)} ${jointText(joint, stop.wanted_rad)}; its limit is ${jointText(joint, stop.limit_rad)}.`,
        hint: "Tilt or turn the tool, or choose another posture of the arm.",
      };
    }
    case "goal":
      return {
        step,
        code: `reach.${stop.goal.reach.kind}`,
        sentence: `Step “${step}”: ${explainReach(stop.goal.reach)}`,
        hint: "Bring the target nearer, or tilt the tool.",
        reach: stop.goal.reach,
      };
    case "path": {
      const [x, y, z] = stop.stop.goal.position;
      const place = `${mm(x)}, ${mm(y)}, ${mm(z)} mm`;
      const percent = Math.round(stop.share * 100);
      return stop.stop.kind === "posture-jump"
        ? {
            step,
            code: "branch.jump",
            sentence: `At ${percent} % of step “${step}” the arm would have to turn over at once, with the flange at ${place} of the base.`,
            hint: "Make it a joint move, or tilt the tool so that the wrist is not stretched out on the way.",
          }
        : {
            step,
            code: "reach.path",
            sentence: `At ${percent} % of step “${step}” the flange would be at ${place} of the base, where ${robot.name} cannot be.`,
            hint: "Bring the path nearer, or make it a joint move.",
          };
    }
  }
}

const mm = (x_m: number): string => millimetres(x_m).toFixed(1);
