import { boxMesh, cylinderMesh, sphereMesh, type TriangleMesh, type Vector3 } from "@twincell/core";

/** What a piece looks like; the studio has a paint for each. */
export type PartMaterial =
  | "paint-yellow"
  | "paint-grey"
  | "paint-blue"
  | "aluminium"
  | "steel"
  | "rubber"
  | "wood"
  | "cardboard"
  | "tape"
  | "glass"
  | "red"
  | "black"
  | "fabric-orange"
  | "fabric-dark"
  | "skin"
  | "white";

/** One simple solid of a part, in the part's frame: z up, origin in the middle of its footprint on the floor [m]. */
export type PartPiece = {
  readonly material: PartMaterial;
  readonly at_m: Vector3;
  /**
   * "drawn": too thin or too small to collide with. "solid": collides and is not drawn, as the panel of a wire fence.
   */
  readonly only?: "drawn" | "solid";
} & (
  | { readonly kind: "box"; readonly size_m: Vector3; readonly turn_rad?: number }
  | { readonly kind: "cylinder"; readonly radius_m: number; readonly length_m: number; readonly axis: 0 | 1 | 2 }
  | { readonly kind: "ball"; readonly radius_m: number }
);

type Extra = Partial<Pick<PartPiece, "only">> & { readonly turn_rad?: number };
/** A box about its middle. */
export const box = (material: PartMaterial, at_m: Vector3, size_m: Vector3, extra: Extra = {}): PartPiece => ({
  kind: "box",
  material,
  at_m,
  size_m,
  ...extra,
});
/** A cylinder about its middle, along an axis. */
export const rod = (
  material: PartMaterial,
  at_m: Vector3,
  axis: 0 | 1 | 2,
  radius_m: number,
  length_m: number,
  extra: Partial<Pick<PartPiece, "only">> = {},
): PartPiece => ({ kind: "cylinder", material, at_m, axis, radius_m, length_m, ...extra });
export const ball = (material: PartMaterial, at_m: Vector3, radius_m: number): PartPiece => ({
  kind: "ball",
  material,
  at_m,
  radius_m,
});

/** So many numbers from the first to the last, evenly. */
export const spread = (count: number, first: number, last: number): readonly number[] =>
  Array.from({ length: count }, (_, i) =>
    count === 1 ? (first + last) / 2 : first + ((last - first) * i) / (count - 1),
  );

/** The same piece at the four corners of a rectangle about the middle. */
export const corners = (x_m: number, y_m: number, make: (x: number, y: number) => readonly PartPiece[]): PartPiece[] =>
  [-1, 1].flatMap(sx => [-1, 1].flatMap(sy => [...make(sx * x_m, sy * y_m)]));

/** Flat faces of a round piece per turn. */
const FACES = 20;

function pieceMesh(piece: PartPiece): TriangleMesh {
  const mesh =
    piece.kind === "box"
      ? boxMesh(piece.size_m)
      : piece.kind === "ball"
        ? sphereMesh(piece.radius_m, FACES, FACES / 2)
        : cylinderMesh(piece.radius_m, piece.length_m, FACES);
  const positions = Float64Array.from(mesh.positions);
  for (let i = 0; i < positions.length; i += 3) {
    let [x, y, z] = [positions[i]!, positions[i + 1]!, positions[i + 2]!];
    // From along z to along the axis, by turning: the winding stays outward.
    if (piece.kind === "cylinder" && piece.axis === 0) [x, y, z] = [z, x, y];
    if (piece.kind === "cylinder" && piece.axis === 1) [x, y, z] = [y, z, x];
    if (piece.kind === "box" && piece.turn_rad !== undefined) {
      const [c, s] = [Math.cos(piece.turn_rad), Math.sin(piece.turn_rad)];
      [x, y] = [c * x - s * y, s * x + c * y];
    }
    positions[i] = x + piece.at_m[0];
    positions[i + 1] = y + piece.at_m[1];
    positions[i + 2] = z + piece.at_m[2];
  }
  return { positions, indices: mesh.indices };
}

/** The solid of a part: its pieces that collide, one beside the other, each closed. */
export function solidOf(pieces: readonly PartPiece[]): TriangleMesh {
  const meshes = pieces.filter(({ only }) => only !== "drawn").map(pieceMesh);
  const positions = new Float64Array(meshes.reduce((sum, mesh) => sum + mesh.positions.length, 0));
  const indices = new Uint32Array(meshes.reduce((sum, mesh) => sum + mesh.indices.length, 0));
  let vertex = 0;
  let index = 0;
  for (const mesh of meshes) {
    positions.set(mesh.positions, 3 * vertex);
    for (let i = 0; i < mesh.indices.length; i++) indices[index + i] = mesh.indices[i]! + vertex;
    vertex += mesh.positions.length / 3;
    index += mesh.indices.length;
  }
  return { positions, indices };
}
