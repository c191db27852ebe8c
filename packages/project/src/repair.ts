import type { CellDocument } from "./document.ts";

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
