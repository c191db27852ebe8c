import {
  branchOf,
  compose,
  everyStep,
  flangePose,
  identity,
  inverse,
  posesAgree,
  robotById,
  withLists,
  type Pose,
  type Program,
  type Step,
  type Target,
} from "@twincell/core";
import { isTextProgram, type CellDocument, type FrameRecord } from "./document.ts";

/*
 * Frames belong to the object they are attached to and move with it. Traced edges and taught points do so through such
 * a frame: their targets are poses in it, so that programs, checks and exports need to know nothing of objects.
 */

/**
 * Every attached frame where its object is now: worldFromFrame = worldFromObject · objectFromFrame, in the cell and in
 * its programs. A frame whose object is gone stays where it is and is attached to nothing. The very same cell when all
 * stand there.
 */
export function followObjects(cell: CellDocument): CellDocument {
  const objects = new Map(cell.objects.map(object => [object.id, object.worldFromObject]));
  const moved = new Map<string, Pose<"world", "frame">>();
  const frames = cell.frames.map((frame): FrameRecord => {
    const { attachedTo, ...free } = frame;
    if (attachedTo === undefined) return frame;
    const worldFromObject = objects.get(attachedTo.object);
    if (worldFromObject === undefined) return free;
    const worldFromFrame = compose(worldFromObject, attachedTo.objectFromFrame);
    if (same(worldFromFrame, frame.worldFromFrame)) return frame;
    moved.set(frame.name, worldFromFrame);
    return { ...frame, worldFromFrame };
  });
  if (frames.every((frame, i) => frame === cell.frames[i])) return cell;
  const programs = cell.programs.map(program => {
    if (isTextProgram(program)) return program;
    const own = [...moved].filter(
      ([name]) => Object.hasOwn(program.frames, name) && !Object.hasOwn(program.pallets, name),
    );
    return own.length === 0 ? program : { ...program, frames: { ...program.frames, ...Object.fromEntries(own) } };
  });
  return { ...cell, frames, programs };
}

/**
 * Attaches a frame where it stands; `object` null takes it off. A frame or object that is not there changes nothing and
 * returns the very same cell.
 */
export function attachFrame(cell: CellDocument, name: string, object: string | null): CellDocument {
  const worldFromObject = cell.objects.find(each => each.id === object)?.worldFromObject;
  if (!cell.frames.some(frame => frame.name === name) || (object !== null && worldFromObject === undefined))
    return cell;
  return {
    ...cell,
    frames: cell.frames.map((frame): FrameRecord => {
      if (frame.name !== name) return frame;
      const { attachedTo: before, ...free } = frame;
      if (before === undefined && object === null) return frame;
      return object === null || worldFromObject === undefined
        ? free
        : {
            ...free,
            attachedTo: { object, objectFromFrame: compose(inverse(worldFromObject), frame.worldFromFrame) },
          };
    }),
  };
}

/**
 * A frame at another place of the world; one that is attached stays attached, there. A frame that is not there changes
 * nothing.
 */
export function placeFrame(cell: CellDocument, name: string, worldFromFrame: Pose<"world", "frame">): CellDocument {
  if (!cell.frames.some(frame => frame.name === name)) return cell;
  return {
    ...cell,
    frames: cell.frames.map((frame): FrameRecord => {
      if (frame.name !== name) return frame;
      const { attachedTo } = frame;
      const object = cell.objects.find(each => each.id === attachedTo?.object);
      return attachedTo === undefined || object === undefined
        ? { ...frame, worldFromFrame }
        : {
            ...frame,
            worldFromFrame,
            attachedTo: { ...attachedTo, objectFromFrame: compose(inverse(object.worldFromObject), worldFromFrame) },
          };
    }),
  };
}

/** How many steps and pallets of the cell's programs count from a frame; what a text says is its own. */
export function usesOfFrame(cell: CellDocument, name: string): number {
  let uses = 0;
  for (const program of cell.programs) {
    if (isTextProgram(program)) continue;
    for (const pallet of Object.values(program.pallets)) if (pallet.frame === name) uses++;
    // The name of a pallet means its places, not the frame.
    if (Object.hasOwn(program.pallets, name)) continue;
    for (const step of everyStep(program)) {
      if (step.type !== "move") continue;
      if ([step.target, step.via].some(target => target && "frame" in target && target.frame === name)) uses++;
    }
  }
  return uses;
}

/** The cell and its programs without a frame; the very same cell where something counts from it, or where it is not. */
export function removeFrame(cell: CellDocument, name: string): CellDocument {
  if (!cell.frames.some(frame => frame.name === name) || usesOfFrame(cell, name) > 0) return cell;
  return {
    ...cell,
    frames: cell.frames.filter(frame => frame.name !== name),
    programs: cell.programs.map(program => {
      if (isTextProgram(program) || !Object.hasOwn(program.frames, name)) return program;
      const { [name]: _gone, ...frames } = program.frames;
      return { ...program, frames };
    }),
  };
}

/**
 * Attaches taught points (a traced edge is all steps of its group) where they stand: each target becomes a pose in a
 * hidden frame of the object. Joint angles become the pose they reach, with their branch; targets at the places of a
 * pallet stay.
 *
 * @param steps  ids of moves of that program.
 */
export function attachSteps(
  cell: CellDocument,
  programName: string,
  steps: readonly string[],
  object: string,
): CellDocument {
  const program = cell.programs.find(each => each.name === programName);
  const record = cell.objects.find(each => each.id === object);
  const robot = robotById(cell.robot.id);
  if (program === undefined || isTextProgram(program) || record === undefined || robot === undefined) return cell;
  const known = cell.frames.find(
    frame => frame.attachedTo?.object === object && same(frame.attachedTo.objectFromFrame, identity()),
  );
  const name = known?.name ?? freeFrameName(cell, record.name);
  const worldFromFrame: Pose<"world", "frame"> = { ...(record.worldFromObject as Pose as Pose<"world", "frame">) };
  const wanted = new Set(steps);
  const attached = (target: Target): Target => {
    const worldFromTcp = worldFromTarget(cell, program, target);
    if (worldFromTcp === undefined) return target;
    const pose = compose(inverse(worldFromFrame), worldFromTcp);
    if (!("q" in target)) return { ...target, frame: name, pose };
    const branch = branchOf(robot, target.q);
    return { pose, frame: name, tool: target.tool ?? "flange", ...(branch === undefined ? {} : { branch }) };
  };
  const list = (inside: readonly Step[]): readonly Step[] =>
    inside.map((step): Step => {
      if (step.type !== "move") return withLists(step, list);
      if (!wanted.has(step.id)) return step;
      return {
        ...step,
        target: attached(step.target),
        ...(step.via === undefined ? {} : { via: attached(step.via) }),
      };
    });
  const tools = Object.fromEntries(cell.tools.map(tool => [tool.name, tool.flangeFromTcp]));
  const after: Program = {
    ...program,
    tools: { ...tools, ...program.tools },
    frames: { ...program.frames, [name]: worldFromFrame },
    steps: list(program.steps),
    routines: Object.fromEntries(Object.entries(program.routines).map(([key, inside]) => [key, list(inside)])),
  };
  return {
    ...cell,
    frames:
      known === undefined
        ? [...cell.frames, { name, worldFromFrame, hidden: true, attachedTo: { object, objectFromFrame: identity() } }]
        : cell.frames,
    programs: cell.programs.map(each => (each === program ? after : each)),
  };
}

/** The object a target is attached to: that of its frame. */
export const objectOfTarget = (cell: CellDocument, target: Target): string | undefined =>
  "q" in target ? undefined : cell.frames.find(frame => frame.name === target.frame)?.attachedTo?.object;

/** Where a target puts the tool; undefined for the places of a pallet. */
function worldFromTarget(cell: CellDocument, program: Program, target: Target): Pose<"world", "tcp"> | undefined {
  if (!("q" in target)) {
    if (Object.hasOwn(program.pallets, target.frame)) return undefined;
    const worldFromFrame = target.frame === "world" ? identity<"world", "frame">() : program.frames[target.frame];
    return worldFromFrame === undefined ? undefined : compose(worldFromFrame, target.pose);
  }
  const robot = robotById(cell.robot.id)!;
  // Joint angles without a tool are those of the flange, whichever tool the cell uses now.
  const tool = target.tool ?? "flange";
  const flangeFromTcp =
    program.tools[tool] ?? cell.tools.find(each => each.name === tool)?.flangeFromTcp ?? identity<"flange", "tcp">();
  return compose(compose(cell.robot.worldFromBase, flangePose(robot.arm, target.q)), flangeFromTcp);
}

function freeFrameName(cell: CellDocument, wanted: string): string {
  const taken = new Set([
    "world",
    ...cell.frames.map(frame => frame.name),
    ...cell.programs.flatMap(program =>
      isTextProgram(program) ? [] : [...Object.keys(program.pallets), ...Object.keys(program.frames)],
    ),
  ]);
  for (let i = 1; ; i++) {
    const name = i === 1 ? wanted : `${wanted} ${i}`;
    if (!taken.has(name)) return name;
  }
}

/** Nearer than this two poses are one: composing and inverting rounds [m, rad]. */
const SAME = 1e-12;
const same = (a: Pose, b: Pose): boolean => posesAgree(a, b, SAME, SAME);
