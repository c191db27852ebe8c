import type { Vector3 as WorldVector } from "@twincell/core";
import { inverse, transformPoint } from "@twincell/core";
import type { CellDocument, MeasuredPoint } from "@twincell/project";
import { type Intersection, type Object3D, Vector3 } from "three";
import type { Thing } from "../../stores/selection.ts";
import { toWorld } from "../world-space.ts";
import { edgesOf } from "./edges.ts";

const normal = new Vector3();

/** The spot under the pointer; a corner or an edge of the object within `near_m` of it is taken instead. */
export function measurePoint(
  document: CellDocument,
  { hit, holder }: { readonly hit: Intersection; readonly holder: Object3D },
  near_m: number,
): MeasuredPoint {
  const at_m = toWorld(hit.point, [0, 0, 0]);
  const face = hit.face
    ? toWorld(normal.copy(hit.face.normal).transformDirection(hit.object.matrixWorld), [0, 0, 0])
    : undefined;
  const thing: Thing | undefined = holder.userData.thing;
  const object = thing?.kind === "object" ? document.objects.find(({ id }) => id === thing.id) : undefined;
  const found = { at_m, ...(face ? { normal: face } : {}) };
  if (!object) return found;
  const local = transformPoint(inverse(object.worldFromObject), at_m);
  const snapped = nearest(
    edgesOf(object.shape).chains.map(({ points }) => points),
    local,
    near_m,
  );
  // At a corner or an edge several faces meet: none of them has the angle.
  return snapped
    ? { at_m: transformPoint(object.worldFromObject, snapped), object: object.id }
    : { ...found, object: object.id };
}

/** The nearest corner of these lines, else the nearest spot on one of them; undefined when all are farther away. */
function nearest(
  lines: readonly (readonly WorldVector[])[],
  [x, y, z]: WorldVector,
  near_m: number,
): WorldVector | undefined {
  const from = (point: WorldVector): number => Math.hypot(point[0] - x, point[1] - y, point[2] - z);
  let corner: WorldVector | undefined;
  let spot: WorldVector | undefined;
  for (const line of lines)
    for (const [i, point] of line.entries()) {
      if (from(point) < Math.min(near_m, corner ? from(corner) : Infinity)) corner = point;
      const before = line[i - 1];
      if (!before) continue;
      const along = point.map((value, k) => value - before[k]!) as WorldVector;
      const squared = along[0] ** 2 + along[1] ** 2 + along[2] ** 2;
      const share = ((x - before[0]) * along[0] + (y - before[1]) * along[1] + (z - before[2]) * along[2]) / squared;
      const t = Math.min(1, Math.max(0, share));
      const at: WorldVector = [before[0] + t * along[0], before[1] + t * along[1], before[2] + t * along[2]];
      if (from(at) < Math.min(near_m, spot ? from(spot) : Infinity)) spot = at;
    }
  return corner ?? spot;
}
