import type { TriangleMesh } from "./mesh.ts";
import { fromBase64, toBase64 } from "./base64.ts";

/** An imported mesh as a saved cell holds it. */
export interface EncodedMesh {
  /** Little-endian float32, metres, x y z of each vertex, in base64. */
  readonly positions: string;
  /** Little-endian uint32, three of each triangle, in base64. */
  readonly indices: string;
}
export type DecodedMesh =
  | { readonly kind: "mesh"; readonly mesh: TriangleMesh }
  | { readonly kind: "not-a-mesh"; readonly sentence: string };

/** Positions are rounded to single precision: 0.06 µm at 1 m. */
export function encodeMesh(mesh: TriangleMesh): EncodedMesh {
  const positions = new DataView(new ArrayBuffer(mesh.positions.length * 4));
  for (let i = 0; i < mesh.positions.length; i++) positions.setFloat32(i * 4, mesh.positions[i]!, true);
  const indices = new DataView(new ArrayBuffer(mesh.indices.length * 4));
  for (let i = 0; i < mesh.indices.length; i++) indices.setUint32(i * 4, mesh.indices[i]!, true);
  return { positions: toBase64(new Uint8Array(positions.buffer)), indices: toBase64(new Uint8Array(indices.buffer)) };
}

/** The mesh, when it is one: whole numbers of vertices and triangles, every coordinate finite, every index in range. */
export function decodeMesh(encoded: EncodedMesh): DecodedMesh {
  const positionBytes = fromBase64(encoded.positions);
  const indexBytes = fromBase64(encoded.indices);
  if (positionBytes === undefined) return refuse("The positions of the mesh are not base64.");
  if (indexBytes === undefined) return refuse("The indices of the mesh are not base64.");
  if (positionBytes.length % 12 !== 0)
    return refuse(`The positions of the mesh are ${positionBytes.length} bytes long; a vertex takes 12.`);
  if (indexBytes.length % 12 !== 0)
    return refuse(`The indices of the mesh are ${indexBytes.length} bytes long; a triangle takes 12.`);
  const positions = new Float64Array(positionBytes.length / 4);
  const indices = new Uint32Array(indexBytes.length / 4);
  const positionView = new DataView(positionBytes.buffer);
  const indexView = new DataView(indexBytes.buffer);
  for (let i = 0; i < positions.length; i++) {
    const value = positionView.getFloat32(i * 4, true);
    if (!Number.isFinite(value))
      return refuse(`Vertex ${Math.floor(i / 3) + 1} of the mesh has a coordinate that is not a number.`);
    positions[i] = value;
  }
  const vertices = positions.length / 3;
  for (let i = 0; i < indices.length; i++) {
    const index = indexView.getUint32(i * 4, true);
    if (index >= vertices)
      return refuse(`Triangle ${Math.floor(i / 3) + 1} of the mesh names vertex ${index + 1} of ${vertices}.`);
    indices[i] = index;
  }
  return { kind: "mesh", mesh: { positions, indices } };
}

const refuse = (sentence: string): DecodedMesh => ({ kind: "not-a-mesh", sentence });
