import { everyIn, type Program, type Refusal, type RobotController, type Robot, type Step } from "@twincell/core";
import type { AdapterMotion, ControllerAdapter } from "./adapter.ts";
import { noPayload, noSearch, noSpline, unsayable } from "./words.ts";

const PATHS = { ptp: "joints", lin: "line", circ: "arc" } as const satisfies Record<string, AdapterMotion["path"]>;

/** Why that step cannot be told over the connection of an adapter, wherever the robot stands; null when it can. */
export function stepRefusal(step: Step, adapter: ControllerAdapter, robot: Robot): Refusal | null {
  switch (step.type) {
    case "move":
      if (step.path === "spline") return noSpline(robot);
      if (step.until !== undefined) return noSearch(robot);
      return adapter.cannotSay({ path: PATHS[step.path], acceleration: step.acceleration?.ratio ?? 1 });
    case "set":
      return adapter.cannotSay({ kind: "signal", signal: step.signal, value: step.to });
    case "gripper":
      return adapter.cannotSay({ kind: "gripper", closed: step.closed });
    case "payload":
      return adapter.setPayload ? null : noPayload(robot);
    default:
      return null;
  }
}

/** Why steps cannot all be told to a controller: every one that cannot, by the reason. Null when all can. */
export function stepsRefusal(
  steps: Iterable<Step>,
  controller: Pick<RobotController, "cannotCarryOut">,
): Refusal | null {
  const reasons = new Map<string, { readonly why: Refusal; readonly steps: string[] }>();
  for (const step of steps) {
    const why = controller.cannotCarryOut(step);
    if (why === null) continue;
    const reason = reasons.get(why.sentence) ?? { why, steps: [] };
    reasons.set(why.sentence, reason);
    if (!reason.steps.includes(step.id)) reason.steps.push(step.id);
  }
  const all = [...reasons.values()];
  return all.length === 0 ? null : unsayable(all);
}

/** Every step that a program may come to: its own, and those of the routines that it calls, each once. */
export function* reachableSteps({ steps, routines }: Pick<Program, "steps" | "routines">): Generator<Step, void> {
  const called = new Set<string>();
  const lists: (readonly Step[])[] = [steps];
  for (const list of lists)
    for (const step of everyIn(list)) {
      yield step;
      if (step.type !== "call" || called.has(step.routine)) continue;
      called.add(step.routine);
      lists.push(routines[step.routine] ?? []);
    }
}
