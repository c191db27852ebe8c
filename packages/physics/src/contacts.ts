import { linkName, type PhysicalScene } from "@twincell/core";
import type { Engine, MjData, MjModel } from "./engine.ts";

/** Solids may be this far inside one another at the start: the weight of heavy parts presses soft contacts in [m]. */
export const OVERLAP_M = 0.002;

export interface Touch {
  readonly a: string;
  readonly b: string;
  readonly depth_m: number;
  readonly force_N: number;
}

/** Who touches whom now, by the names a person gave. For a look now and then: it reads one contact after the other. */
export function touches(engine: Engine, model: MjModel, data: MjData, scene: PhysicalScene): Touch[] {
  const found: Touch[] = [];
  const contacts = data.contact;
  const six = new engine.DoubleBuffer(6);
  for (let i = 0; i < contacts.size(); i++) {
    const contact = contacts.get(i)!;
    if (contact.exclude === 0) {
      engine.mj_contactForce(model, data, i, six);
      const force = six.GetView() as Float64Array;
      found.push({
        a: ownerOf(model, contact.geom1, scene),
        b: ownerOf(model, contact.geom2, scene),
        depth_m: Math.max(0, -contact.dist),
        force_N: Math.sqrt(force[0]! ** 2 + force[1]! ** 2 + force[2]! ** 2),
      });
    }
    contact.delete();
  }
  contacts.delete();
  six.delete();
  return found;
}

export const deepestOverlap = (engine: Engine, model: MjModel, data: MjData, scene: PhysicalScene): Touch | undefined =>
  touches(engine, model, data, scene).reduce<Touch | undefined>(
    (deepest, touch) => (deepest === undefined || touch.depth_m > deepest.depth_m ? touch : deepest),
    undefined,
  );

/**
 * The name of what a geom belongs to, found by the body that carries it: bodies stand in the order they were written.
 */
function ownerOf(model: MjModel, geom: number, scene: PhysicalScene): string {
  const body = (model.geom_bodyid as Int32Array)[geom]!;
  const still = scene.objects.filter(({ role, belt }) => role === "fixture" && belt === undefined);
  if (body === 0) return "Floor";
  let at = body - 1;
  if (at < still.length) return still[at]!.name;
  at -= still.length;
  const links = scene.robot.arm.joints.length + 1;
  if (at < links) return linkName(at);
  at -= links + 1;
  if (scene.gripper !== undefined) {
    if (at < 3) return scene.gripper.name;
    at -= 3;
  }
  const belts = scene.objects.filter(({ role, belt }) => role === "fixture" && belt !== undefined);
  if (at < belts.length) return belts[at]!.name;
  at -= belts.length;
  return scene.objects.filter(({ role }) => role === "part")[at]?.name ?? "Person";
}
