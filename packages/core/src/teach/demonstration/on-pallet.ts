import { palletCount, type Pallet } from "../../program/pallet.ts";
import { distance } from "../../spatial/vector.ts";
import { compose, inverse, type Pose } from "../../spatial/pose.ts";
import { freshStepId } from "../../program/edit.ts";
import type { Program, Step } from "../../program/program.ts";

export type RepeatedOnPallet =
  | { readonly kind: "program"; readonly program: Program; readonly places: number }
  | { readonly kind: "refused"; readonly sentence: string };

/**
 * One shown pick-and-place becomes one for every place of a pallet (row M-54): points nearer to where the gripper
 * closed stay where they are, points nearer to where it opened are done in the frame of the place. The shown place is
 * the pallet's first.
 *
 * @param program  a program of moves with one closing and one opening of the gripper; moves are poses, not joint
 *   angles.
 * @param name     of the pallet, which no frame has.
 */
export function repeatOnPallet(program: Program, name: string, pallet: Pallet): RepeatedOnPallet {
  const refused = (sentence: string): RepeatedOnPallet => ({ kind: "refused", sentence });
  if (Object.hasOwn(program.frames, name) || Object.hasOwn(program.pallets, name))
    return refused(`The program has a frame or pallet “${name}” already.`);
  const grips = program.steps.flatMap((step, i) => (step.type === "gripper" ? [{ closed: step.closed, i }] : []));
  const picks = grips.findIndex(({ closed }) => closed);
  const picked = grips[picks];
  const placed = grips[picks + 1];
  if (!picked || !placed || placed.closed || grips.length > picks + 2)
    return refused("One closing and then one opening of the gripper are needed: one pick and one place.");
  const worldFromPlace = worldPose(program, pallet.frame, pallet.origin);
  if (!worldFromPlace) return refused(`There is no frame “${pallet.frame}”.`);
  const placeFromWorld = inverse(worldFromPlace);
  const worlds = program.steps.map(step =>
    step.type === "move" && "pose" in step.target ? worldPose(program, step.target.frame, step.target.pose) : undefined,
  );
  const wrong = program.steps.find((step, i) => step.type === "move" && !worlds[i]);
  if (wrong)
    return refused(`Step ${wrong.id} is no pose in a known frame: only such can be moved to the other places.`);
  const pickedAt = worlds.findLast((pose, i) => pose && i < picked.i);
  const placedAt = worlds.findLast((pose, i) => pose && i < placed.i);
  if (!pickedAt || !placedAt) return refused("There is no move before the gripper closes.");
  const steps = program.steps.map((step, i): Step => {
    const world = worlds[i];
    if (step.type !== "move" || !world || !("pose" in step.target)) return step;
    const belongsToPick = distance(world.position, pickedAt.position) <= distance(world.position, placedAt.position);
    if (belongsToPick) return step;
    const pose: Pose<string, "tcp"> = compose(placeFromWorld, world);
    return { ...step, target: { pose: pose as Pose<"frame", "tcp">, frame: name, tool: step.target.tool } };
  });
  return {
    kind: "program",
    places: palletCount(pallet),
    program: {
      ...program,
      pallets: { ...program.pallets, [name]: pallet },
      steps: [{ id: freshStepId(program, "pallet-"), type: "pallet", pallet: name, steps }],
    },
  };
}

/** A pose in a frame of the program, seen in the world. */
function worldPose<From extends string>(
  program: Program,
  frame: string,
  pose: Pose<"frame", From>,
): Pose<"world", From> | undefined {
  if (frame === "world") return pose as Pose<string, From> as Pose<"world", From>;
  const worldFromFrame = program.frames[frame];
  return worldFromFrame && compose(worldFromFrame, pose);
}
