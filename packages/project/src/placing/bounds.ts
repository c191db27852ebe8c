import { meshBounds, transformPoint, type Bounds, type Pose, type TriangleMesh, type Vector3 } from "@twincell/core";
import type { ObjectRecord, Shape } from "../document.ts";
import { shapeMesh } from "../mesh/shape.ts";

const meshes = new WeakMap<Shape, TriangleMesh>();
function meshOf(shape: Shape): TriangleMesh {
  const mesh = meshes.get(shape) ?? shapeMesh(shape);
  meshes.set(shape, mesh);
  return mesh;
}

/** The smallest box along the axes of the object's own frame [m]. */
export const shapeBounds = (shape: Shape): Bounds => meshBounds(meshOf(shape));

/** The smallest box along the axes of the world around an object that stands at `worldFromObject` [m]. */
export function worldBounds(shape: Shape, worldFromObject: Pose<"world", "object">): Bounds {
  const { positions, indices } = meshOf(shape);
  const lower: Vector3 = [Infinity, Infinity, Infinity];
  const upper: Vector3 = [-Infinity, -Infinity, -Infinity];
  const place: Vector3 = [0, 0, 0];
  for (const vertex of indices) {
    for (let k = 0; k < 3; k++) place[k] = positions[3 * vertex + k]!;
    transformPoint(worldFromObject as Pose, place, place);
    for (let k = 0; k < 3; k++) {
      lower[k] = Math.min(lower[k]!, place[k]!);
      upper[k] = Math.max(upper[k]!, place[k]!);
    }
  }
  return { lower, upper };
}

/** The box around several objects, along the axes of the world; undefined for none. */
export function boundsOfAll(objects: readonly ObjectRecord[]): Bounds | undefined {
  const [first, ...rest] = objects.map(object => worldBounds(object.shape, object.worldFromObject));
  if (first === undefined) return undefined;
  return rest.reduce(
    (all, { lower, upper }) => ({
      lower: all.lower.map((value, k) => Math.min(value, lower[k]!)) as Vector3,
      upper: all.upper.map((value, k) => Math.max(value, upper[k]!)) as Vector3,
    }),
    first,
  );
}
