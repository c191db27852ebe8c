import {
  compose,
  freshStepIds,
  identity,
  insertSteps,
  inverse,
  pose,
  withLists,
  type MoveStep,
  type Pose,
  type Program,
  type Speed,
  type Step,
  type Target,
} from "@twincell/core";
import { isTextProgram, type CellDocument, type FrameRecord } from "./document.ts";
import { withStepPrograms } from "./programs.ts";

/*
 * Saved poses of the tool tip ("coordinates" to those who taught with them): named frames of the cell, taken at the
 * TCP, that trajectories are made through. Programs refer to them by name, so a pose that is edited takes its moves
 * along. Each edit takes a cell and returns another; one that changes nothing returns the very same cell.
 */

/** The poses that were saved, in their order. */
export const savedCoords = (cell: CellDocument): readonly FrameRecord[] =>
  cell.frames.filter(frame => frame.saved === true);

/**
 * Row L-44: a frame where the tool tip is, under a name that is free: the wanted one, with a number where it is taken.
 */
export function addCoords(cell: CellDocument, worldFromTcp: Pose<"world", "tcp">, wanted = "Pose"): CellDocument {
  const taken = new Set([
    "world",
    ...cell.frames.map(frame => frame.name),
    ...cell.programs.flatMap(program =>
      isTextProgram(program) ? [] : [...Object.keys(program.pallets), ...Object.keys(program.frames)],
    ),
  ]);
  const plain = wanted.trim() === "" ? "Pose" : wanted.trim();
  let name = plain;
  for (let i = 2; taken.has(name); i++) name = `${plain} ${i}`;
  return { ...cell, frames: [...cell.frames, { name, worldFromFrame: placed(worldFromTcp), saved: true }] };
}

/**
 * Row L-45: a saved pose is moved, whether or not the robot reaches it: the checker says so where a program goes there.
 */
export function editCoords(cell: CellDocument, name: string, worldFromTcp: Pose<"world", "tcp">): CellDocument {
  if (!savedCoords(cell).some(frame => frame.name === name)) return cell;
  const worldFromFrame = placed(worldFromTcp);
  const moved = withStepPrograms(cell, program =>
    Object.hasOwn(program.frames, name)
      ? { ...program, frames: { ...program.frames, [name]: worldFromFrame } }
      : program,
  );
  return {
    ...moved,
    frames: cell.frames.map(frame => (frame.name === name ? edited(cell, frame, worldFromFrame) : frame)),
  };
}

/** A saved pose that is attached to an object stays attached, where it is now. */
function edited(cell: CellDocument, frame: FrameRecord, worldFromFrame: Pose<"world", "frame">): FrameRecord {
  const { attachedTo } = frame;
  const object = attachedTo === undefined ? undefined : cell.objects.find(each => each.id === attachedTo.object);
  return attachedTo === undefined || object === undefined
    ? { ...frame, worldFromFrame }
    : {
        ...frame,
        worldFromFrame,
        attachedTo: {
          object: attachedTo.object,
          objectFromFrame: compose(inverse(object.worldFromObject), worldFromFrame),
        },
      };
}

/** Row L-48: all saved poses are gone; user frames stay. Moves that went to one stay where they went, in the world. */
export function removeCoords(cell: CellDocument): CellDocument {
  const gone = new Map(savedCoords(cell).map(frame => [frame.name, frame.worldFromFrame]));
  if (gone.size === 0) return cell;
  return {
    ...withStepPrograms(cell, program => withoutFrames(program, gone)),
    frames: cell.frames.filter(frame => !gone.has(frame.name)),
  };
}

/** Of joint speed, to the first pose. */
const APPROACH: Speed = { ratio: 0.3 };

export interface TrajectoryOptions {
  readonly path?: "ptp" | "lin" | "spline";
  readonly speed?: Speed;
  readonly blend_m?: number;
  readonly tool?: string;
}

/**
 * Row L-49: the selected program goes on through saved poses, in the order of their names here. The first is come to by
 * a joint move, wherever the robot stands.
 *
 * @param names  a pose may come more than once; a name that is not saved is left out.
 */
export function trajectoryThroughCoords(
  cell: CellDocument,
  names: readonly string[],
  options: TrajectoryOptions = {},
): CellDocument {
  const known = new Map(savedCoords(cell).map(frame => [frame.name, frame.worldFromFrame]));
  const through = names.filter(name => known.has(name));
  const { path = "lin", speed = { mps: 0.1 }, blend_m = 0, tool = cell.tool } = options;
  const record = cell.tools.find(each => each.name === tool);
  if (through.length === 0) return cell;
  return withStepPrograms(cell, program => {
    if (program.name !== cell.program) return program;
    const ids = freshStepIds(program, through.length, "p");
    const steps = through.map(
      (name, i): MoveStep => ({
        id: ids[i]!,
        name,
        type: "move",
        path: i === 0 ? "ptp" : path,
        speed: i === 0 ? APPROACH : speed,
        blend_m: i === through.length - 1 ? 0 : blend_m,
        target: { pose: pose(), frame: name, tool },
      }),
    );
    const frames = Object.fromEntries(through.map(name => [name, known.get(name)!]));
    const tools =
      record === undefined || Object.hasOwn(program.tools, tool)
        ? program.tools
        : { ...program.tools, [tool]: record.flangeFromTcp };
    return insertSteps({ ...program, tools, frames: { ...program.frames, ...frames } }, program.steps.length, steps);
  });
}

function withoutFrames(program: Program, gone: ReadonlyMap<string, Pose<"world", "frame">>): Program {
  const inWorld = (target: Target): Target => {
    if (!("frame" in target) || Object.hasOwn(program.pallets, target.frame)) return target;
    const worldFromFrame = gone.get(target.frame);
    return worldFromFrame === undefined
      ? target
      : {
          ...target,
          frame: "world",
          pose: compose(compose(identity<"frame", "world">(), worldFromFrame), target.pose),
        };
  };
  const list = (steps: readonly Step[]): readonly Step[] =>
    steps.map((step): Step => {
      if (step.type !== "move") return withLists(step, list);
      return step.via === undefined
        ? { ...step, target: inWorld(step.target) }
        : { ...step, target: inWorld(step.target), via: inWorld(step.via) };
    });
  return {
    ...program,
    frames: Object.fromEntries(Object.entries(program.frames).filter(([name]) => !gone.has(name))),
    steps: list(program.steps),
    routines: Object.fromEntries(Object.entries(program.routines).map(([name, steps]) => [name, list(steps)])),
  };
}

/** A pose of its own: what is lent while jogging changes. */
const placed = ({
  position: [x, y, z],
  quaternion: [qx, qy, qz, qw],
}: Pose<"world", "tcp">): Pose<"world", "frame"> => ({ position: [x, y, z], quaternion: [qx, qy, qz, qw] });
