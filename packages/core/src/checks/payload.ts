import { everyStep } from "../program/walk.ts";
import { startOf, type CheckScene } from "./scene.ts";

/**
 * Loads beyond what the robot lifts (rows X-07, N-09).
 *
 * @returns steps whose load cannot be judged, because no source states the payload of the robot.
 */
export function checkPayload(scene: CheckScene): ReadonlySet<string> {
  const { payload_kg, name } = scene.robot;
  const payloadMax_kg = scene.robot.payloadMax_kg ?? payload_kg;
  const unjudged = new Set<string>();
  for (const step of everyStep(scene.program)) {
    if (step.type !== "payload") continue;
    if (payload_kg === undefined || payloadMax_kg === undefined) {
      if (step.mass_kg > 0) unjudged.add(step.id);
      continue;
    }
    const base = { value: step.mass_kg, unit: "kg", at_s: startOf(scene, step.id), repairs: [] } as const;
    if (step.mass_kg > payloadMax_kg) {
      scene.add(step.id, "bad", {
        ...base,
        code: "payload.too-heavy",
        limit: payloadMax_kg,
        sentence: `The load is ${step.mass_kg} kg; the ${name} lifts at most ${payloadMax_kg} kg.`,
      });
    } else if (step.mass_kg > payload_kg) {
      scene.add(step.id, "warn", {
        ...base,
        code: "payload.reduced-speed",
        limit: payload_kg,
        sentence: `The load is ${step.mass_kg} kg; above ${payload_kg} kg the ${name} moves at reduced speed.`,
      });
    }
  }
  return unjudged;
}
