import { shapeMesh, type Shape } from "@twincell/project";
import type { BufferGeometry } from "three";
import { RoundedBoxGeometry } from "three/examples/jsm/geometries/RoundedBoxGeometry.js";
import { meshGeometry } from "../mesh-geometry.ts";

/** How a shape is drawn: true to size; the edges of boxes slightly bevelled so that they catch the light. */
export function shapeGeometry(shape: Shape): BufferGeometry {
  if (shape.kind !== "box") return meshGeometry(shapeMesh(shape));
  const [x, y, z] = shape.size_m;
  return new RoundedBoxGeometry(x, y, z, 2, Math.min(0.0025, Math.min(x, y, z) * 0.12));
}
