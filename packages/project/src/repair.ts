import { applyRepair, shiftedPose, type Program, type Repair } from "@twincell/core";
import { followObjects, placeFrame } from "./attach.ts";
import { isTextProgram, type CellDocument } from "./document.ts";

/** The objects that are moved with a frame: the one it is attached to, and those of its group. */
export function objectsOfFrame(cell: CellDocument, frame: string): readonly string[] {
  const id = cell.frames.find(each => each.name === frame)?.attachedTo?.object;
  const object = cell.objects.find(each => each.id === id);
  if (object === undefined) return [];
  const { group } = object;
  return group === undefined ? [object.id] : cell.objects.filter(each => each.group === group).map(each => each.id);
}

/** What a person calls what stands in a frame: its object, or the frame itself. */
export function nameOfFrame(cell: CellDocument, frame: string): string {
  const [id] = objectsOfFrame(cell, frame);
  return cell.objects.find(each => each.id === id)?.name ?? frame;
}

/**
 * The cell with a repair of one of its programs: its steps, and the object, frame or robot that is moved with them. A
 * program that is not there, or is a text, changes nothing.
 *
 * @param step  the step the repair was offered for.
 */
export function repairCell(cell: CellDocument, program: string, step: string, repair: Repair): CellDocument {
  const found = cell.programs.find(each => each.name === program);
  if (found === undefined || isTextProgram(found)) return cell;
  const { moveFrame, moveBase } = repair;
  const objects = new Set(moveFrame === undefined ? [] : objectsOfFrame(cell, moveFrame.frame));
  // An attached frame follows its object, in every program; another one is moved with the points taught in it.
  const { moveFrame: _frame, ...steps } = repair;
  const after: Program = applyRepair(found, step, objects.size > 0 ? steps : repair);
  let so: CellDocument =
    after === found ? cell : { ...cell, programs: cell.programs.with(cell.programs.indexOf(found), after) };
  if (moveFrame !== undefined && objects.size > 0)
    so = followObjects({
      ...so,
      objects: so.objects.map(object =>
        objects.has(object.id)
          ? { ...object, worldFromObject: shiftedPose(object.worldFromObject, moveFrame.by_m) }
          : object,
      ),
    });
  else if (moveFrame !== undefined) {
    const frame = so.frames.find(each => each.name === moveFrame.frame);
    if (frame !== undefined) so = placeFrame(so, frame.name, shiftedPose(frame.worldFromFrame, moveFrame.by_m));
  }
  if (moveBase === undefined) return so;
  return { ...so, robot: { ...so.robot, worldFromBase: shiftedPose(so.robot.worldFromBase, moveBase.by_m) } };
}
