import type { TriangleMesh } from "../mesh/mesh.ts";
import { meshBounds } from "../mesh/measure.ts";
import { weldMesh } from "../mesh/weld.ts";
import { distance, dot, type Vector3 } from "../spatial/vector.ts";
import { fromVertex, nextInTriangle, topologyOf, toVertex, triangleOf, type Topology } from "./topology.ts";

/**
 * A run of sharp edges between two corners, or a closed one: what a person calls one edge of a part. Mesh frame,
 * metres.
 */
export interface EdgeChain {
  readonly id: number;
  /** n + 1 points of n segments; a closed chain ends where it begins. */
  readonly points: readonly Vector3[];
  /** Outward unit normal of the face on the left of each segment, seen from outside and along the chain. */
  readonly left: readonly Vector3[];
  /** The face on the right; at an open border there is none and the left normal stands in. */
  readonly right: readonly Vector3[];
  readonly closed: boolean;
  /** An outer edge, an inner edge (a weld seam), or the rim of an open shell. */
  readonly kind: "convex" | "concave" | "border";
  readonly length_m: number;
  /** Half-edges of the topology, in order. */
  readonly halfEdges: readonly number[];
}

/** All sharp edges of a mesh. */
export interface FeatureEdges {
  readonly topology: Topology;
  readonly chains: readonly EdgeChain[];
  /** Chain of each half-edge, or −1 where the surface is smooth. */
  readonly chainOf: Int32Array;
  /** Open rims and edges where more than two triangles meet; both are edges of chains with kind "border". */
  readonly open: number;
  readonly crowded: number;
}

export interface FeatureOptions {
  /** Chains are split where the line turns by more than this [rad]. The dihedral threshold when absent. */
  readonly corner_rad?: number;
  /** Corners nearer than this are one [m]. A millionth of the part's size when absent. */
  readonly weld_m?: number;
}

/**
 * Finds the edges where the surface bends by more than `dihedral_rad` (angle between neighbouring outward normals,
 * 0 = flat), joined into chains. A chain ends where the number of sharp edges in a corner is not two, where the line
 * turns by more than `corner_rad`, and nowhere else.
 */
export function featureEdges(mesh: TriangleMesh, dihedral_rad: number, options: FeatureOptions = {}): FeatureEdges {
  const { lower, upper } = meshBounds(mesh);
  const extent = mesh.indices.length > 0 ? distance(lower, upper) : 0;
  const topology = topologyOf(weldMesh(mesh, options.weld_m ?? extent * 1e-6).mesh);
  const sharp = sharpHalfEdges(topology, Math.cos(dihedral_rad));
  const turnCosine = Math.cos(options.corner_rad ?? dihedral_rad);
  const atVertex = edgesAtVertices(topology, sharp);
  const chainOf = new Int32Array(topology.twins.length).fill(-1);
  const chains: EdgeChain[] = [];
  const isCorner = (into: number): boolean => onward(topology, atVertex, into, turnCosine) < 0;
  const collect = (start: number): void => {
    const halfEdges: number[] = [];
    for (let h = start; h >= 0 && chainOf[h] === -1; h = onward(topology, atVertex, h, turnCosine)) {
      halfEdges.push(h);
      chainOf[h] = chains.length;
      if (topology.twins[h]! >= 0) chainOf[topology.twins[h]!] = chains.length;
    }
    chains.push(chainFrom(topology, chains.length, halfEdges, !isCorner(halfEdges.at(-1)!)));
  };
  // First the chains that begin in a corner, then what is left: closed ones without any.
  for (const h of sharp) if (chainOf[h] === -1 && beginsInCorner(topology, atVertex, h, turnCosine)) collect(h);
  for (const h of sharp) if (chainOf[h] === -1) collect(h);
  return { topology, chains, chainOf, open: topology.open, crowded: topology.crowded };
}

/** Half-edges of sharp edges: both sides of an edge between two triangles, the one side of a border. */
function sharpHalfEdges({ twins, normals }: Topology, cosine: number): number[] {
  const sharp: number[] = [];
  for (let h = 0; h < twins.length; h++) {
    const twin = twins[h]!;
    if (twin < 0) {
      sharp.push(h);
      continue;
    }
    const a = 3 * triangleOf(h);
    const b = 3 * triangleOf(twin);
    if (normals[a]! * normals[b]! + normals[a + 1]! * normals[b + 1]! + normals[a + 2]! * normals[b + 2]! < cosine)
      sharp.push(h);
  }
  return sharp;
}

/**
 * For every vertex, the sharp half-edges that leave it; an edge whose other side is missing counts as leaving both
 * ends.
 */
type AtVertex = ReadonlyMap<number, readonly number[]>;

function edgesAtVertices(topology: Topology, sharp: readonly number[]): AtVertex {
  const at = new Map<number, number[]>();
  const add = (vertex: number, h: number): void => {
    const list = at.get(vertex);
    if (list) list.push(h);
    else at.set(vertex, [h]);
  };
  for (const h of sharp) {
    add(fromVertex(topology, h), h);
    if (topology.twins[h]! < 0) add(toVertex(topology, h), h);
  }
  return at;
}

/** The half-edge that continues `into` past its end, or −1 in a corner. */
function onward(topology: Topology, atVertex: AtVertex, into: number, turnCosine: number): number {
  const vertex = toVertex(topology, into);
  const here = atVertex.get(vertex)!;
  if (here.length !== 2) return -1;
  const next = here.find(h => h !== into && h !== topology.twins[into] && fromVertex(topology, h) === vertex);
  if (next === undefined || topology.twins[next]! < 0 !== topology.twins[into]! < 0) return -1;
  return dot(direction(topology, into), direction(topology, next)) < turnCosine ? -1 : next;
}

function beginsInCorner(topology: Topology, atVertex: AtVertex, h: number, turnCosine: number): boolean {
  const here = atVertex.get(fromVertex(topology, h))!;
  if (here.length !== 2) return true;
  const other = here.find(g => g !== h)!;
  const before = topology.twins[other]! >= 0 ? topology.twins[other]! : other;
  return toVertex(topology, before) !== fromVertex(topology, h) || onward(topology, atVertex, before, turnCosine) !== h;
}

export function vertexPoint(topology: Topology, vertex: number): Vector3 {
  const p = topology.mesh.positions;
  return [p[3 * vertex]!, p[3 * vertex + 1]!, p[3 * vertex + 2]!];
}

function direction(topology: Topology, h: number): Vector3 {
  const a = vertexPoint(topology, fromVertex(topology, h));
  const b = vertexPoint(topology, toVertex(topology, h));
  const length = distance(a, b);
  return [(b[0] - a[0]) / length, (b[1] - a[1]) / length, (b[2] - a[2]) / length];
}

export function faceNormal(topology: Topology, h: number): Vector3 {
  const t = 3 * triangleOf(h);
  return [topology.normals[t]!, topology.normals[t + 1]!, topology.normals[t + 2]!];
}

function chainFrom(topology: Topology, id: number, halfEdges: readonly number[], closed: boolean): EdgeChain {
  const points = halfEdges.map(h => vertexPoint(topology, fromVertex(topology, h)));
  points.push(vertexPoint(topology, toVertex(topology, halfEdges.at(-1)!)));
  const left = halfEdges.map(h => faceNormal(topology, h));
  const right = halfEdges.map(h => faceNormal(topology, topology.twins[h]! >= 0 ? topology.twins[h]! : h));
  let length_m = 0;
  for (let i = 1; i < points.length; i++) length_m += distance(points[i - 1]!, points[i]!);
  return { id, points, left, right, closed, kind: kindOf(topology, halfEdges[0]!), length_m, halfEdges };
}

/** Convex: the far corner of the triangle across lies below the plane of this one. */
function kindOf(topology: Topology, h: number): EdgeChain["kind"] {
  const twin = topology.twins[h]!;
  if (twin < 0) return "border";
  const across = vertexPoint(topology, toVertex(topology, nextInTriangle(twin)));
  const here = vertexPoint(topology, fromVertex(topology, h));
  return dot(faceNormal(topology, h), [across[0] - here[0], across[1] - here[1], across[2] - here[2]]) < 0
    ? "convex"
    : "concave";
}
