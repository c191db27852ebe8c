import {
  freeToolName,
  partById,
  partObject,
  toolOfPart,
  withNewTool,
  worldBounds,
  type CellDocument,
  type PartKind,
  type PartNumbers,
} from "@twincell/project";
import { pose, type Vector3 } from "@twincell/core";
import { words } from "../messages/index.ts";
import { partName } from "../messages/phrases.ts";
import { cellStore } from "../stores/cell.ts";
import { commit } from "../stores/document.ts";
import { notify } from "../stores/notices.ts";
import { select } from "../stores/selection.ts";

/** Where a part comes when no place is shown: beside what stands there already, never into it. */
const GAP_M = 0.2;
const GRID_M = 0.05;

function freePlace(document: CellDocument): Vector3 {
  let x_m = 0.8;
  for (const { role, shape, worldFromObject } of document.objects)
    if (role !== "wall") x_m = Math.max(x_m, worldBounds(shape, worldFromObject).upper[0] + GAP_M);
  return [x_m, 0, 0];
}

/** A tool of the library comes to the flange; what was taught keeps its tool until that is exchanged. */
function mountTool(kind: PartKind, document: CellDocument): string | null {
  const name = freeToolName(document, partName(kind.id));
  const tool = toolOfPart(kind, name);
  if (!tool || !commit(words.undo.place(name), before => withNewTool(before, tool))) return null;
  select({ kind: "tool" });
  notify(
    "done",
    words.tools.mounted(name),
    document.tool === "flange" ? undefined : words.tools.mountedHint(document.tool),
  );
  return name;
}

/**
 * Puts a part of the library into the cell, standing on what is at that place, and selects it.
 *
 * @param at_m  the middle of its footprint in the world; a free place beside the others when left out.
 * @returns its id, or null when there is no cell or no such part.
 */
export function placePart(part: string, at_m?: Vector3, numbers: PartNumbers = {}): string | null {
  const kind = partById(part);
  const { document } = cellStore.getState();
  if (!kind || !document) return null;
  if (kind.tool !== undefined && at_m === undefined) return mountTool(kind, document);
  const name = partName(part);
  const names = new Set(document.objects.map(object => object.name));
  const ids = new Set(document.objects.map(object => object.id));
  let n = 1;
  while (names.has(n === 1 ? name : `${name} ${n}`) || ids.has(`${part}-${n}`)) n++;
  const id = `${part}-${n}`;
  const object = partObject(kind, { id, name: n === 1 ? name : `${name} ${n}` }, pose(), numbers);
  const size = worldBounds(object.shape, object.worldFromObject);
  const free = freePlace(document);
  const place: Vector3 = at_m ?? [Math.ceil((free[0] - size.lower[0]) / GRID_M) * GRID_M, 0, 0];
  commit(words.undo.place(name), before => ({
    ...before,
    objects: [...before.objects, { ...object, worldFromObject: pose(place) }],
  }));
  select({ kind: "object", id });
  return id;
}
