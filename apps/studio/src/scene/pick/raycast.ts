import {
  type BufferGeometry,
  FrontSide,
  type Intersection,
  Matrix4,
  type Mesh,
  type Object3D,
  Ray,
  type Raycaster,
} from "three";
import { MeshBVH } from "three-mesh-bvh";

const trees = new WeakMap<BufferGeometry, MeshBVH>();
const objectFromWorld = new Matrix4();
const local = new Ray();

/**
 * Raycasts through a tree of triangles that is built on the first look; only the nearest hit counts. For
 * `mesh.raycast`.
 */
export function raycastByTree(this: Mesh, raycaster: Raycaster, found: Intersection[]): void {
  let tree = trees.get(this.geometry);
  if (!tree) trees.set(this.geometry, (tree = new MeshBVH(this.geometry, { indirect: true })));
  local.copy(raycaster.ray).applyMatrix4(objectFromWorld.copy(this.matrixWorld).invert());
  const hit = tree.raycastFirst(local, FrontSide);
  if (!hit) return;
  hit.point.applyMatrix4(this.matrixWorld);
  found.push({ ...hit, distance: raycaster.ray.origin.distanceTo(hit.point), object: this });
}

/** The nearest visible thing on the ray: the mesh hit and the ancestor that carries `userData.thing`. */
export function nearestThing(
  raycaster: Raycaster,
  root: Object3D,
): { readonly hit: Intersection; readonly holder: Object3D } | null {
  for (const hit of raycaster.intersectObject(root, true)) {
    let holder: Object3D | null = null;
    let seen = true;
    for (let object: Object3D | null = hit.object; object; object = object.parent) {
      if (!object.visible || object.userData.unpickable === true) {
        seen = false;
        break;
      }
      if (!holder && object.userData.thing !== undefined) holder = object;
    }
    if (seen && holder) return { hit, holder };
  }
  return null;
}
