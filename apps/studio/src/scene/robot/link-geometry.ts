import { type LinkShape, linkShapes, type PartMaterial, type Robot } from "@twincell/core";
import type { BufferGeometry } from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { meshGeometry } from "../mesh-geometry.ts";

/** One draw call: all parts of a link that share a material. */
export interface LinkPiece {
  readonly material: PartMaterial;
  readonly geometry: BufferGeometry;
}
export interface LinkDrawing {
  readonly link: number;
  readonly name: string;
  readonly pieces: readonly LinkPiece[];
}

function drawing(shape: LinkShape): LinkDrawing {
  const byMaterial = new Map<PartMaterial, BufferGeometry[]>();
  for (const part of shape.parts)
    byMaterial.set(part.material, [...(byMaterial.get(part.material) ?? []), meshGeometry(part.mesh)]);
  const pieces = [...byMaterial].map(([material, geometries]) => ({ material, geometry: mergeGeometries(geometries) }));
  return { link: shape.link, name: shape.name, pieces };
}

export const linkDrawings = (robot: Robot): LinkDrawing[] => linkShapes(robot).map(drawing);
