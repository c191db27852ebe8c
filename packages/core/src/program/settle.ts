import { palletSlot } from "./pallet.ts";
import { compose, type Pose } from "../spatial/pose.ts";
import type { Program, Step, Target } from "./program.ts";
import { withLists } from "./walk.ts";

/**
 * A target that counts from the places of a pallet, but stands outside the pallet's step, stays where it is at the
 * first place. So a step can be dragged out of its pallet, and the program still means something.
 */
export function settled(program: Program): Program {
  if (Object.keys(program.pallets).length === 0) return program;
  const firsts = new Map(
    Object.entries(program.pallets).map(([name, pallet]) => [
      name,
      palletSlot(pallet, { layer: 0, row: 0, column: 0 }),
    ]),
  );
  const moved = (target: Target, open: readonly string[]): Target => {
    const frameFromPlace = "frame" in target && !open.includes(target.frame) ? firsts.get(target.frame) : undefined;
    if (frameFromPlace === undefined || !("frame" in target)) return target;
    return {
      ...target,
      frame: program.pallets[target.frame]!.frame,
      pose: compose(frameFromPlace, target.pose as Pose as Pose<"place", "tcp">),
    };
  };
  const list = (steps: readonly Step[], open: readonly string[]): readonly Step[] => {
    const after = steps.map((step): Step => {
      if (step.type === "move") {
        const target = moved(step.target, open);
        const via = step.via === undefined ? undefined : moved(step.via, open);
        if (target === step.target && via === step.via) return step;
        return via === undefined ? { ...step, target } : { ...step, target, via };
      }
      const inner = step.type === "pallet" ? [...open, step.pallet] : open;
      return withLists(step, inside => list(inside, inner));
    });
    return after.every((step, i) => step === steps[i]) ? steps : after;
  };
  const steps = list(program.steps, []);
  const routines = Object.fromEntries(
    Object.entries(program.routines).map(([name, inside]) => [name, list(inside, [])]),
  );
  const same = Object.entries(routines).every(([name, inside]) => inside === program.routines[name]);
  return same && steps === program.steps
    ? program
    : { ...program, steps, routines: same ? program.routines : routines };
}
