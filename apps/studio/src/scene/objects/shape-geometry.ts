import type { TriangleMesh } from "@twincell/core";
import type { Shape } from "@twincell/project";
import { type BufferGeometry, CylinderGeometry, LatheGeometry, Vector2 } from "three";
import { RoundedBoxGeometry } from "three/examples/jsm/geometries/RoundedBoxGeometry.js";
import { meshGeometry } from "../mesh-geometry.ts";

/** How a shape is drawn: true to size, edges slightly bevelled so that they catch the light. */
export function shapeGeometry(shape: Shape): BufferGeometry {
  switch (shape.kind) {
    case "box": {
      const [x, y, z] = shape.size_m;
      return new RoundedBoxGeometry(x, y, z, 2, Math.min(0.0025, Math.min(x, y, z) * 0.12));
    }
    case "cylinder": return new CylinderGeometry(shape.radius_m, shape.radius_m, shape.height_m, 48).rotateX(Math.PI / 2).translate(0, 0, shape.height_m / 2);
    case "revolved": {
      const profile = shape.profile_m.map(([radius_m, z_m]) => new Vector2(radius_m, z_m));
      return new LatheGeometry(profile, 32).rotateX(Math.PI / 2);
    }
    case "mesh": return meshGeometry(decodedMesh(shape));
  }
}

const bytes = (base64: string): ArrayBuffer => Uint8Array.from(atob(base64), letter => letter.charCodeAt(0)).buffer;

/** The mesh of a saved shape: little-endian float32 positions, uint32 indices. */
export const decodedMesh = (shape: Extract<Shape, { readonly kind: "mesh" }>): TriangleMesh => ({
  positions: Float64Array.from(new Float32Array(bytes(shape.positions))), indices: new Uint32Array(bytes(shape.indices)),
});
