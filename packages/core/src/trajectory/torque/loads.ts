import { dynamicsModel, type DynamicsModel, type DynamicsOptions, type Payload } from "../../dynamics/model.ts";
import type { Program } from "../../program/program.ts";
import { everyStep } from "../../program/walk.ts";
import type { Robot } from "../../model/robot.ts";
import type { Pose } from "../../spatial/pose.ts";
import type { Plan } from "../plan.ts";

export interface LoadOptions {
  /** What the flange carries before the first payload step: the tool. Nothing by default. */
  readonly payload?: Payload;
  /** How the robot stands; upright by default. */
  readonly worldFromBase?: Pose<"world", "base">;
}

/** What is needed to judge torques of a robot, or why they cannot be judged. */
export type TorqueModel =
  | {
      readonly kind: "known";
      /** Greatest torque of each joint [N m; N of a slide]; Infinity where it is not published. */
      readonly limits_Nm: Float64Array;
      /** The arm with that load; the same load twice gives the same model. */
      readonly carrying: (payload: Payload | undefined) => DynamicsModel;
    }
  | { readonly kind: "unknown"; readonly sentence: string };

/** Row X-10: unknown where masses or all torque limits are not published, never a guess. */
export function torqueModel(robot: Robot, worldFromBase?: Pose<"world", "base">): TorqueModel {
  const options: DynamicsOptions = worldFromBase === undefined ? {} : { worldFromBase };
  const bare = dynamicsModel(robot, options);
  if (bare.kind === "unknown") return bare;
  const limits_Nm = Float64Array.from(robot.arm.joints, ({ limits }) => limits.torque_Nm ?? Number.POSITIVE_INFINITY);
  if (!limits_Nm.some(Number.isFinite))
    return {
      kind: "unknown",
      sentence: `The torques of ${robot.name} cannot be judged: what its joints can give is not published.`,
    };
  const models = new Map<Payload, DynamicsModel>();
  const carrying = (payload: Payload | undefined): DynamicsModel => {
    if (payload === undefined) return bare.model;
    let model = models.get(payload);
    if (model === undefined) {
      const answer = dynamicsModel(robot, { ...options, payload });
      model = answer.kind === "known" ? answer.model : bare.model;
      models.set(payload, model);
    }
    return model;
  };
  return { kind: "known", limits_Nm, carrying };
}

/** What the flange carries in each segment of a plan: payload steps count from their own segment on. */
export function loadsAlong(
  plan: Plan,
  program: Pick<Program, "steps" | "routines">,
  first?: Payload,
): readonly (Payload | undefined)[] {
  const steps = new Map<string, Payload>();
  for (const step of everyStep(program)) if (step.type === "payload") steps.set(step.id, step);
  let carried = first;
  return plan.segments.map(({ step }) => (carried = steps.get(step) ?? carried));
}
