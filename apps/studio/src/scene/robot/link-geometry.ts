import { type LinkPart, type LinkShape, linkShapes, type Robot } from "@twincell/core";
import type { BufferGeometry } from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { meshGeometry } from "../mesh-geometry.ts";
import { giveSurface, type PartSurfaces, partSurfaces, type Surface } from "./materials.ts";

/** One draw call: all parts of a link. The time of a frame goes by the number of these, not by their triangles. */
export interface LinkDrawing {
  readonly link: number;
  readonly name: string;
  readonly geometry: BufferGeometry;
}

/** Plastic and paint of other people's files: their colour on a casting without varnish. */
const surfaceOf = ({ material, color }: LinkPart, surfaces: PartSurfaces): Surface =>
  color === undefined ? surfaces[material] : { ...surfaces[material], color, clearcoat: 0.15 };

function drawing(shape: LinkShape, surfaces: PartSurfaces): LinkDrawing {
  const geometries = shape.parts.map(part => {
    const geometry = meshGeometry(part.mesh);
    giveSurface(geometry, surfaceOf(part, surfaces));
    return geometry;
  });
  return { link: shape.link, name: shape.name, geometry: mergeGeometries(geometries) };
}

export function linkDrawings(robot: Robot): LinkDrawing[] {
  const surfaces = partSurfaces(robot.paint);
  return linkShapes(robot)
    .filter(shape => shape.parts.length > 0)
    .map(shape => drawing(shape, surfaces));
}
