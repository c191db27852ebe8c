import { branchOf } from "../kinematics/branch.ts";
import { flangePose } from "../kinematics/forward.ts";
import type { Robot } from "../model/robot.ts";
import { compose, identity, inverse, type Pose } from "../spatial/pose.ts";
import { palletSlot } from "./pallet.ts";
import type { Program, Target } from "./program.ts";
import { listsOf } from "./walk.ts";

type Tables = Pick<Program, "tools" | "frames" | "pallets">;

/** A frame of the program in the world; of a pallet its first place. Undefined for a name that it does not have. */
export function worldFromNamed(program: Tables, frame: string): Pose<"world", "frame"> | undefined {
  if (frame === "world") return identity();
  const pallet = Object.hasOwn(program.pallets, frame) ? program.pallets[frame] : undefined;
  if (pallet === undefined) return Object.hasOwn(program.frames, frame) ? program.frames[frame] : undefined;
  const worldFromFrame = worldFromNamed({ ...program, pallets: {} }, pallet.frame);
  const frameFromPlace = palletSlot(pallet, { layer: 0, row: 0, column: 0 });
  return worldFromFrame && (compose(worldFromFrame, frameFromPlace) as Pose<"world", string> as Pose<"world", "frame">);
}

/**
 * Where a target is in the world; one that counts from the places of a pallet at the first of them. Undefined when it
 * names a frame or a tool that the program does not have.
 */
export function worldOfTarget(
  program: Tables,
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
  target: Target,
): Pose<"world", "tcp"> | undefined {
  if (!("q" in target)) {
    const worldFromFrame = worldFromNamed(program, target.frame);
    return worldFromFrame && compose(worldFromFrame, target.pose);
  }
  const flangeFromTcp = toolNamed(program, target.tool ?? "flange");
  return flangeFromTcp && compose(compose(worldFromBase, flangePose(robot.arm, target.q)), flangeFromTcp);
}

/**
 * The same target as a pose in another frame, or relative to the places of a pallet: it stays where it is, in the same
 * posture.
 */
export function countedFrom(
  program: Tables,
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
  target: Target,
  frame: string,
): Target | undefined {
  const worldFromTcp = worldOfTarget(program, robot, worldFromBase, target);
  const worldFromFrame = worldFromNamed(program, frame);
  if (worldFromTcp === undefined || worldFromFrame === undefined) return undefined;
  const branch = "q" in target ? branchOf(robot, target.q) : target.branch;
  return {
    pose: compose(inverse(worldFromFrame), worldFromTcp),
    frame,
    tool: target.tool ?? "flange",
    ...(branch === undefined ? {} : { branch }),
  };
}

/** Names of the pallets inside whose steps a step stands, the outermost first. */
export function palletsAround({ steps, routines }: Pick<Program, "steps" | "routines">, id: string): readonly string[] {
  const search = (list: Program["steps"], open: readonly string[]): readonly string[] | undefined => {
    for (const step of list) {
      if (step.id === id) return open;
      const inner = step.type === "pallet" ? [...open, step.pallet] : open;
      for (const inside of listsOf(step)) {
        const found = search(inside, inner);
        if (found !== undefined) return found;
      }
    }
    return undefined;
  };
  return [steps, ...Object.values(routines)].map(list => search(list, [])).find(found => found !== undefined) ?? [];
}

const toolNamed = ({ tools }: Tables, name: string): Pose<"flange", "tcp"> | undefined =>
  name === "flange" ? identity() : Object.hasOwn(tools, name) ? tools[name] : undefined;
