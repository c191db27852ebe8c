import type { TriangleMesh } from "@twincell/core";
import { resolveFile } from "../files/resolve.ts";
import { folderOf, joinPath, nameOf, type FileSource } from "../files/source.ts";
import { readMesh } from "../mesh/read-mesh.ts";
import type { PlacedShape } from "./chain.ts";

/** Meshes of a robot's shapes, each read once. */
export interface LoadedMeshes {
  readonly meshOf: (reference: string) => TriangleMesh | undefined;
  /** References whose mesh is not there or is not understood. */
  readonly missing: readonly string[];
  /** What is missing, was found elsewhere or was passed over, one sentence each. */
  readonly notes: readonly string[];
}

/**
 * Loads the meshes that shapes of a chain name: `chain.shapes` to draw it, `solidShapes(chain)` to check it. A missing
 * one is listed, and the rest is loaded all the same.
 *
 * @param path  of the robot file, where its references start from.
 */
export function loadMeshes(shapes: readonly PlacedShape[], path: string, files: FileSource): LoadedMeshes {
  const meshes = new Map<string, TriangleMesh>();
  const missing: string[] = [];
  const notes: string[] = [];
  const seen = new Set<string>();
  for (const {
    shape: { geometry },
  } of shapes) {
    if (geometry.kind !== "mesh" || seen.has(geometry.reference)) continue;
    const { reference } = geometry;
    const found = resolveFile(reference, path, files);
    seen.add(reference);
    if (found.kind === "missing") {
      missing.push(reference);
      notes.push(found.sentence);
      continue;
    }
    if (found.note !== undefined) notes.push(found.note);
    // RViz and MoveIt heed a COLLADA file's unit and pass over its up axis: robots are drawn with that in mind.
    const answer = readMesh(
      found.path,
      files.read(found.path) ?? new Uint8Array(),
      address => files.read(joinPath(folderOf(found.path), address)),
      "z",
    );
    if (answer.kind === "read") meshes.set(reference, answer.mesh);
    else {
      missing.push(reference);
      notes.push(
        `${nameOf(found.path)}${answer.line === undefined ? "" : `, line ${answer.line}`}: ${answer.sentence}`,
      );
    }
  }
  return { meshOf: reference => meshes.get(reference), missing, notes };
}
