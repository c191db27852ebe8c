import { applyRepair, type ProgramChange, type Vector3 } from "@twincell/core";
import { followObjects } from "./attach.ts";
import { isTextProgram, type CellDocument } from "./document.ts";

/** The objects that are moved with a frame: the one it is attached to, and those of its group. */
export function objectsOfFrame(cell: CellDocument, frame: string): readonly string[] {
  const id = cell.frames.find(each => each.name === frame)?.attachedTo?.object;
  const object = cell.objects.find(each => each.id === id);
  if (object === undefined) return [];
  const { group } = object;
  return group === undefined ? [object.id] : cell.objects.filter(each => each.group === group).map(each => each.id);
}

/** The frames that move with a frame: those of the same objects, itself among them. */
export function framesWith(cell: CellDocument, frame: string): readonly string[] {
  const objects = objectsOfFrame(cell, frame);
  const others = cell.frames.filter(
    ({ name, attachedTo }) => name !== frame && objects.includes(attachedTo?.object ?? ""),
  );
  return [frame, ...others.map(({ name }) => name)];
}

/** What a person calls what stands in a frame: its object, or the frame itself. */
export function nameOfFrame(cell: CellDocument, frame: string): string {
  const id = cell.frames.find(each => each.name === frame)?.attachedTo?.object;
  return cell.objects.find(each => each.id === id)?.name ?? frame;
}

/** What a check offers for a step: the step as it would be, and what else has to move with it [m, in the world]. */
export interface CellChange extends ProgramChange {
  readonly moveBase?: { readonly by_m: Vector3 };
}

/**
 * The cell with a repair of one of its programs carried out: the steps changed; a part that is moved takes its group,
 * its frames and every point taught in them along; a robot that is moved leaves the points where they are. A vendor's
 * text stays as it is.
 */
export function repairCell(cell: CellDocument, program: string, step: string, change: CellChange): CellDocument {
  const { moveFrame, moveBase } = change;
  const by_m = moveFrame?.by_m;
  const objects = new Set(moveFrame === undefined ? [] : objectsOfFrame(cell, moveFrame.frame));
  const moved: CellDocument = {
    ...cell,
    programs: cell.programs.map(each =>
      isTextProgram(each) || each.name !== program ? each : applyRepair(each, step, change),
    ),
    ...(moveBase === undefined
      ? {}
      : { robot: { ...cell.robot, worldFromBase: shifted(cell.robot.worldFromBase, moveBase.by_m) } }),
    ...(by_m === undefined
      ? {}
      : {
          objects: cell.objects.map(object =>
            objects.has(object.id) ? { ...object, worldFromObject: shifted(object.worldFromObject, by_m) } : object,
          ),
          // A frame that stands by itself is moved by itself; the others follow their objects.
          frames: cell.frames.map(frame =>
            frame.name === moveFrame?.frame && frame.attachedTo === undefined
              ? { ...frame, worldFromFrame: shifted(frame.worldFromFrame, by_m) }
              : frame,
          ),
        }),
  };
  return followObjects(moved);
}

const shifted = <T extends { readonly position: Vector3 }>(pose: T, [x, y, z]: Vector3): T => ({
  ...pose,
  position: [pose.position[0] + x, pose.position[1] + y, pose.position[2] + z],
});
