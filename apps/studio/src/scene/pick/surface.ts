import { inverse, rotate, surfaceFeatureAt, transformPoint } from "@twincell/core";
import type { CellDocument } from "@twincell/project";
import type { Intersection, Object3D } from "three";
import type { PickedSurface } from "../../stores/surface.ts";
import type { Thing } from "../../stores/selection.ts";
import { toWorld } from "../world-space.ts";
import { edgesOf } from "./edges.ts";

/** The bore, shaft, round edge or face of the object that a ray met, in the world; null on what is no object. */
export function surfaceUnder(
  document: CellDocument,
  { hit, holder }: { readonly hit: Intersection; readonly holder: Object3D },
  near_m: number,
): PickedSurface | null {
  const thing: Thing | undefined = holder.userData.thing;
  const object = thing?.kind === "object" ? document.objects.find(({ id }) => id === thing.id) : undefined;
  if (!object) return null;
  const local = transformPoint(inverse(object.worldFromObject), toWorld(hit.point, [0, 0, 0]));
  const feature = surfaceFeatureAt(edgesOf(object.shape), local, near_m);
  if (!feature) return null;
  return {
    object: object.id,
    feature: {
      ...feature,
      center_m: transformPoint(object.worldFromObject, feature.center_m),
      axis: rotate(object.worldFromObject.quaternion, feature.axis),
    },
  };
}
