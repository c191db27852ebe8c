import { meshVolume, type PhysicalObject, type PhysicalScene, type Refusal } from "@twincell/core";
import { solidMass, solidMesh } from "./solid-geoms.ts";
import { partMass } from "./scene.ts";

/** Below this nothing is a solid any more [m³, kg]. */
const LEAST_M3 = 1e-12;
const LEAST_KG = 1e-6;

const refusal = (
  code: string,
  sentence: string,
  hint: string,
  numbers: { value?: number; limit?: number } = {},
): Refusal => ({ code: `physics.${code}`, sentence, hint, ...numbers });

/** What keeps a scene from being simulated, before the engine sees it: the first of its faults, or undefined. */
export function judgeScene(scene: PhysicalScene): Refusal | undefined {
  const n = scene.robot.arm.joints.length;
  if (scene.q_rad.length !== n)
    return refusal(
      "joints",
      `${scene.robot.name} has ${n} joints but ${scene.q_rad.length} angles were given.`,
      "Pass one angle per joint of the chosen robot, base first.",
    );
  if (!scene.q_rad.every(Number.isFinite))
    return refusal(
      "number",
      `A joint angle of ${scene.robot.name} is not a number.`,
      "Look at the posture at the start.",
    );
  const { step_s } = scene;
  if (step_s !== undefined && !(step_s >= 1e-5 && step_s <= 0.01))
    return refusal("step", `A step of ${step_s} s is not between 0.00001 s and 0.01 s.`, "Take 0.002 s.");
  for (const object of scene.objects) {
    const fault = judgeObject(object);
    if (fault) return fault;
  }
  return undefined;
}

function judgeObject(object: PhysicalObject): Refusal | undefined {
  const {
    name,
    shape,
    worldFromObject: { position, quaternion },
    friction,
    belt,
  } = object;
  if (![...position, ...quaternion].every(Number.isFinite))
    return refusal("number", `The place of “${name}” is not a number.`, "Put it somewhere in the cell.");
  if (shape.kind === "mesh" && !shape.mesh.positions.every(Number.isFinite))
    return refusal("number", `A corner of “${name}” is not a number.`, "Import its mesh again.");
  if (friction !== undefined && !(friction >= 0 && friction <= 10))
    return refusal(
      "friction",
      `The friction of “${name}” is ${friction}; it lies between 0 and 10.`,
      "Dry surfaces have 0.2 to 1.",
      { value: friction, limit: 10 },
    );
  if (belt !== undefined && ![...belt.direction, belt.speed_mps].every(Number.isFinite))
    return refusal("number", `The speed of the belt “${name}” is not a number.`, "Give it a direction and a speed.");
  const solid =
    shape.kind === "mesh" || shape.kind === "revolved" ? meshVolume(solidMesh(shape)) : solidMass(shape).volume_m3;
  if (!(solid > LEAST_M3))
    return refusal(
      "hollow",
      `“${name}” encloses no volume: it is not a solid.`,
      "Close its mesh, or give it a thickness.",
      { value: solid },
    );
  if (object.role !== "part") return undefined;
  const mass_kg = partMass(object);
  if (!(mass_kg >= LEAST_KG && Number.isFinite(mass_kg)))
    return refusal(
      "massless",
      `“${name}” weighs ${mass_kg} kg: what falls and is carried needs a mass.`,
      "Give it a mass in kg, or let it follow from its volume.",
      { value: mass_kg, limit: LEAST_KG },
    );
  return undefined;
}

/** What a scene rests on that nobody measured, one sentence each; shown beside its results. */
export function assumptionsOf(scene: PhysicalScene, driven: boolean): string[] {
  const guessed = scene.objects
    .filter(({ role, mass_kg, density_kgm3 }) => role === "part" && mass_kg === undefined && density_kgm3 === undefined)
    .map(({ name }) => name);
  const slippery = scene.objects.some(({ friction }) => friction === undefined);
  return [
    ...(guessed.length > 0 ? [`The mass of ${guessed.join(", ")} follows from the volume at 500 kg/m³.`] : []),
    ...(slippery ? ["Surfaces that say nothing have a friction of 0.6."] : []),
    ...(driven
      ? ["Joints have no friction of their own and no play."]
      : ["The arm is moved as told, whatever it touches: its torques are unknown."]),
  ];
}
