import { censusOfEdges, meshBounds, weldMesh, type TriangleMesh, type Vector3 } from "@twincell/core";

/** What a mesh was read from, as reports name it. */
export const MESH_FORMATS = [
  "STL (binary)",
  "STL (ASCII)",
  "OBJ",
  "PLY (binary)",
  "PLY (ASCII)",
  "COLLADA",
  "glTF",
  "GLB",
] as const;

/** What was read, what was mended, and what a person should know. */
export interface MeshReport {
  readonly format: (typeof MESH_FORMATS)[number];
  /** Triangles in the file, before any were removed. */
  readonly triangles: number;
  readonly vertices: number;
  /** Triangles removed because they have no area, and because a coordinate is not a finite number. */
  readonly withoutArea: number;
  readonly notFinite: number;
  /** Edges with one triangle, and with more than two or with neighbours of opposite winding. */
  readonly openEdges: number;
  readonly crowdedEdges: number;
  /** Size of the box around it, in the file's units. */
  readonly size: Vector3;
  /** Factor that most likely turns the file's units into metres: 1 or 0.001. */
  readonly likelyScale: 1 | 0.001;
  readonly warnings: readonly string[];
}

/** A mesh in the file's own units: multiply by `report.likelyScale` or by what the user says. */
export interface MeshRead {
  readonly kind: "read";
  readonly mesh: TriangleMesh;
  readonly report: MeshReport;
}

/** Corners nearer than this part of the size are one: files keep seven digits. */
const WELD = 2e-7;
/** Anything longer than this in "metres" is taken to be in millimetres. */
const LONGEST_M = 10;

/** Welds what a reader collected, counts and warns. `soup` may hold NaN. */
export function finishMesh(format: MeshReport["format"], soup: TriangleMesh, warnings: string[]): MeshRead {
  const finite = withFiniteCorners(soup);
  const notFinite = (soup.indices.length - finite.indices.length) / 3;
  const rough = meshBounds(finite);
  const extent = finite.indices.length > 0 ? Math.hypot(...sizeOf(rough.lower, rough.upper)) : 0;
  const { mesh, dropped } = weldMesh(finite, extent * WELD);
  const { open, crowded } = censusOfEdges(mesh);
  const { lower, upper } = meshBounds(mesh);
  const size = mesh.indices.length > 0 ? sizeOf(lower, upper) : ([0, 0, 0] as Vector3);
  const longest = Math.max(...size);
  if (notFinite > 0) warnings.push(`${plural(notFinite, "triangle")} with coordinates that are not numbers left out.`);
  if (dropped > 0) warnings.push(`${plural(dropped, "triangle")} without area left out.`);
  if (open > 0) warnings.push(`The surface is open along ${plural(open, "edge")}: inside and outside are not certain.`);
  if (crowded > 0)
    warnings.push(`More than two triangles, or triangles of opposite winding, meet in ${plural(crowded, "edge")}.`);
  const likelyScale = longest > LONGEST_M ? 0.001 : 1;
  if (likelyScale !== 1)
    warnings.push(
      `The part would be ${longest.toPrecision(3)} m long; its numbers are probably millimetres (scale 0.001).`,
    );
  return {
    kind: "read",
    mesh,
    report: {
      format,
      triangles: soup.indices.length / 3,
      vertices: mesh.positions.length / 3,
      withoutArea: dropped,
      notFinite,
      openEdges: open,
      crowdedEdges: crowded,
      size,
      likelyScale,
      warnings,
    },
  };
}

const plural = (count: number, noun: string): string => `${count} ${noun}${count === 1 ? "" : "s"}`;
const sizeOf = (lower: Vector3, upper: Vector3): Vector3 => [
  upper[0] - lower[0],
  upper[1] - lower[1],
  upper[2] - lower[2],
];
/** Squares of coordinates must stay finite. */
const LARGEST = 1e150;

function withFiniteCorners(mesh: TriangleMesh): TriangleMesh {
  const sound = new Uint8Array(mesh.positions.length / 3);
  for (let v = 0; v < sound.length; v++) {
    const x = mesh.positions[3 * v]!;
    const y = mesh.positions[3 * v + 1]!;
    const z = mesh.positions[3 * v + 2]!;
    sound[v] = Math.abs(x) < LARGEST && Math.abs(y) < LARGEST && Math.abs(z) < LARGEST ? 1 : 0;
  }
  if (!sound.includes(0)) return mesh;
  const kept: number[] = [];
  for (let t = 0; t < mesh.indices.length; t += 3) {
    const a = mesh.indices[t]!;
    const b = mesh.indices[t + 1]!;
    const c = mesh.indices[t + 2]!;
    if (sound[a] && sound[b] && sound[c]) kept.push(a, b, c);
  }
  return { positions: mesh.positions, indices: Uint32Array.from(kept) };
}
