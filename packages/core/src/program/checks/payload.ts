import { everyStep } from "../walk.ts";
import { startOf, type CheckScene } from "./scene.ts";

/** Loads beyond what the robot lifts (rows X-07, N-09). A robot whose payload is not published is not judged. */
export function checkPayload(scene: CheckScene): void {
  const { payload_kg, payloadMax_kg, name } = scene.robot;
  if (!(payloadMax_kg > 0)) return;
  for (const step of everyStep(scene.program)) {
    if (step.type !== "payload") continue;
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
}
