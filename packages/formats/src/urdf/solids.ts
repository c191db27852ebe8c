import { boxMesh, cylinderMesh, sphereMesh, transformMesh, type LinkSolid, type TriangleMesh } from "@twincell/core";
import type { PlacedShape, UrdfChain } from "./chain.ts";
import type { UrdfGeometry } from "./model.ts";

/** Where a mesh reference points: a package by name, or a path beside the robot file. */
export interface MeshPlace {
  readonly package?: string;
  readonly path: string;
}

/**
 * Takes `package://name/path`, `file:///path`, `model://name/path` and plain paths apart. `.` and `..` are resolved.
 * A path that leaves its package, or climbs above the robot file, is undefined: files elsewhere are nobody's business.
 */
export function meshPlace(reference: string): MeshPlace | undefined {
  const scheme = /^([a-z]+):\/\//.exec(reference)?.[1];
  const rest = scheme ? reference.slice(scheme.length + 3) : reference;
  const parts: string[] = [];
  for (const part of rest.replaceAll("\\", "/").split("/")) {
    if (part === "" || part === ".") continue;
    if (part === ".." && parts.pop() === undefined) return undefined;
    if (part !== "..") parts.push(part);
  }
  if (parts.length === 0) return undefined;
  if (scheme === "package" || scheme === "model") {
    const name = rest.split("/")[0]!;
    return parts[0] === name && parts.length > 1 ? { package: name, path: parts.slice(1).join("/") } : undefined;
  }
  if (scheme !== undefined && scheme !== "file") return undefined;
  return { path: (rest.startsWith("/") ? "/" : "") + parts.join("/") };
}

/** A simple shape as a mesh; a mesh reference is answered by `meshOf`. */
export function geometryMesh(
  geometry: UrdfGeometry,
  meshOf: (reference: string) => TriangleMesh | undefined,
): TriangleMesh | undefined {
  switch (geometry.kind) {
    case "box":
      return boxMesh(geometry.size_m);
    case "cylinder":
      return cylinderMesh(geometry.radius_m, geometry.length_m);
    case "sphere":
      return sphereMesh(geometry.radius_m);
    case "mesh": {
      const mesh = meshOf(geometry.reference);
      return mesh && stretched(mesh, geometry.scale);
    }
  }
}

/** The mesh with each axis times its own factor; the winding stays outward when one is mirrored. */
function stretched(mesh: TriangleMesh, factors: readonly number[]): TriangleMesh {
  if (factors.every(factor => factor === 1)) return mesh;
  const positions = mesh.positions.map((value, i) => value * factors[i % 3]!);
  if (factors[0]! * factors[1]! * factors[2]! >= 0) return { positions, indices: mesh.indices };
  return { positions, indices: mesh.indices.map((_, i, all) => all[i % 3 === 0 ? i : i % 3 === 1 ? i + 1 : i - 1]!) };
}

/** The shapes that count in collisions: a link without collision shapes is taken as it is drawn. */
export function solidShapes(chain: UrdfChain): readonly PlacedShape[] {
  const withCollision = new Set(chain.shapes.filter(({ use }) => use === "collision").map(({ name }) => name));
  return chain.shapes.filter(({ use, name }) => use === "collision" || !withCollision.has(name));
}

/**
 * The robot's solids for collision checking. A link without collision shapes is taken as it is drawn.
 *
 * @param meshOf  the mesh of a reference [m], or undefined when it is not at hand.
 */
export function urdfSolids(
  chain: UrdfChain,
  meshOf: (reference: string) => TriangleMesh | undefined,
): { readonly solids: readonly LinkSolid[]; readonly missing: readonly string[] } {
  const solids: LinkSolid[] = [];
  const missing = new Set<string>();
  for (const { link, name, armLinkFromShape, shape } of solidShapes(chain)) {
    const mesh = geometryMesh(shape.geometry, meshOf);
    if (mesh) solids.push({ link, name, mesh: transformMesh(mesh, armLinkFromShape) });
    else if (shape.geometry.kind === "mesh") missing.add(shape.geometry.reference);
  }
  return { solids, missing: [...missing] };
}
