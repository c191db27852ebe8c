import type { CellDocument } from "@twincell/project";
import { Box3, Mesh, type Object3D, type PerspectiveCamera, Vector3 } from "three";

/** What a person wants to see of the cell: robot, tool and objects, without walls. Scene coordinates. */
export function contentBounds(root: Object3D, document: CellDocument, out = new Box3()): Box3 {
  const walls = new Set(document.objects.filter(object => object.role === "wall").map(object => object.id));
  out.makeEmpty();
  root.updateWorldMatrix(true, true);
  for (const child of root.children) {
    if ((child.userData.thing === undefined && child.userData.station !== true) || walls.has(child.name)) continue;
    child.traverse(object => {
      if (!(object instanceof Mesh)) return;
      object.geometry.computeBoundingBox();
      out.union(box.copy(object.geometry.boundingBox).applyMatrix4(object.matrixWorld));
    });
  }
  if (out.isEmpty()) out.set(new Vector3(-0.6, 0, -0.6), new Vector3(0.6, 1.6, 0.6));
  return out;
}
const box = new Box3();

/**
 * How far from the middle of a box the camera must be, looking along `direction`, for all eight corners to be inside
 * the picture. The margin leaves room for what lies over its rim.
 */
export function fitDistance(bounds: Box3, direction: Vector3, camera: PerspectiveCamera, margin = 1.17): number {
  const forward = direction.clone().normalize();
  const up = Math.abs(forward.y) > 0.999 ? new Vector3(0, 0, -1) : new Vector3(0, 1, 0);
  const right = new Vector3().crossVectors(forward, up).normalize();
  const above = new Vector3().crossVectors(right, forward);
  const tall = Math.tan((camera.fov * Math.PI) / 360);
  const wide = tall * camera.aspect;
  const centre = bounds.getCenter(new Vector3());
  let distance = 0;
  for (let corner = 0; corner < 8; corner++) {
    const at = new Vector3(
      corner & 1 ? bounds.max.x : bounds.min.x,
      corner & 2 ? bounds.max.y : bounds.min.y,
      corner & 4 ? bounds.max.z : bounds.min.z,
    ).sub(centre);
    const depth = at.dot(forward);
    distance = Math.max(distance, Math.abs(at.dot(right)) / wide - depth, Math.abs(at.dot(above)) / tall - depth);
  }
  return distance * margin;
}
