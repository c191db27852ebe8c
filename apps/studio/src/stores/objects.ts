import type { ObjectRecord } from "@twincell/project";
import { words } from "../messages/index.ts";
import { cellStore } from "./cell.ts";
import { commit, objectOf, withObject } from "./document.ts";
import { select } from "./selection.ts";

/** How far beside the first a copy of an object stands [m]. */
const COPY_OFFSET_M = 0.1;

const theObject = (id: string): ObjectRecord | null => objectOf(cellStore.getState().document, id);

/** Another name; an empty one changes nothing. */
export function renameObject(id: string, name: string): boolean {
  const wanted = name.trim();
  if (wanted === "") return false;
  return commit(words.undo.rename, document =>
    withObject(document, id, object => (object.name === wanted ? object : { ...object, name: wanted })),
  );
}

/**
 * A copy beside the first, under a name and id that are free; it is selected. @returns its id, or null when there is
 * none.
 */
export function duplicateObject(id: string): string | null {
  const { document } = cellStore.getState();
  const object = theObject(id);
  if (!document || !object) return null;
  const stem = object.name.replace(/ \d+$/, "");
  const name = firstFree(2, n => `${stem} ${n}`, new Set(document.objects.map(each => each.name)));
  const copy = firstFree(2, n => `${id}-${n}`, new Set(document.objects.map(each => each.id)));
  const [x, y, z] = object.worldFromObject.position;
  const free: ObjectRecord = { ...object };
  delete (free as { locked?: true }).locked; // A copy is there to be moved.
  commit(words.undo.duplicate, before => ({
    ...before,
    objects: [
      ...before.objects,
      {
        ...free,
        id: copy,
        name,
        worldFromObject: { ...object.worldFromObject, position: [x + COPY_OFFSET_M, y + COPY_OFFSET_M, z] as const },
      },
    ],
  }));
  select({ kind: "object", id: copy });
  return copy;
}
/** Copies of an object at these poses, each under a name and id of its own; one undo step. @returns their ids. */
export function addCopies(
  id: string,
  label: string,
  poses: (object: ObjectRecord) => readonly ObjectRecord["worldFromObject"][],
): readonly string[] {
  const ids: string[] = [];
  commit(label, before => {
    const object = before.objects.find(each => each.id === id);
    if (!object) return before;
    const stem = object.name.replace(/ \d+$/, "");
    const names = new Set(before.objects.map(each => each.name));
    const taken = new Set(before.objects.map(each => each.id));
    const { locked: _, ...free } = object;
    const copies = poses(object).map((worldFromObject): ObjectRecord => {
      const name = firstFree(2, n => `${stem} ${n}`, names);
      const copy = firstFree(2, n => `${id}-${n}`, taken);
      names.add(name);
      taken.add(copy);
      ids.push(copy);
      return { ...free, id: copy, name, worldFromObject };
    });
    return copies.length === 0 ? before : { ...before, objects: [...before.objects, ...copies] };
  });
  return ids;
}

/** From now on these are selected and moved together. */
export const groupObjects = (ids: readonly string[]): boolean =>
  commit(words.undo.group, before => {
    const group = firstFree(
      1,
      n => `Group ${n}`,
      new Set(before.objects.flatMap(object => (object.group === undefined ? [] : [object.group]))),
    );
    return {
      ...before,
      objects: before.objects.map(object => (ids.includes(object.id) ? { ...object, group } : object)),
    };
  });
export const ungroupObjects = (ids: readonly string[]): boolean =>
  commit(words.undo.ungroup, before => ({
    ...before,
    objects: before.objects.map(object => {
      if (!ids.includes(object.id) || object.group === undefined) return object;
      const { group: _, ...alone } = object;
      return alone;
    }),
  }));

function firstFree(from: number, make: (n: number) => string, taken: ReadonlySet<string>): string {
  for (let n = from; ; n++) if (!taken.has(make(n))) return make(n);
}

/** A hidden object is not drawn; checks and physics still know it. */
export const toggleHidden = (id: string): boolean => toggle(id, "hidden", words.undo.hide, words.undo.show);
/** A locked object is not picked in the 3D view. */
export const toggleLocked = (id: string): boolean => toggle(id, "locked", words.undo.lock, words.undo.unlock);

function toggle(id: string, field: "hidden" | "locked", on: string, off: string): boolean {
  const object = theObject(id);
  if (!object) return false;
  return commit(object[field] ? off : on, document =>
    withObject(document, id, before => {
      const { [field]: set, ...without } = before;
      return set ? without : { ...before, [field]: true };
    }),
  );
}

export const deleteObject = (id: string): boolean => deleteObjects([id]);
export function deleteObjects(ids: readonly string[]): boolean {
  const done = commit(words.undo.deleteObject, before =>
    before.objects.some(object => ids.includes(object.id))
      ? { ...before, objects: before.objects.filter(object => !ids.includes(object.id)) }
      : before,
  );
  if (done) select(null);
  return done;
}
