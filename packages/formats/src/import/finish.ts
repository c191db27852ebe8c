import { censusOfEdges, meshBounds, weldMesh, type TriangleMesh, type Vector3 } from "@twincell/core";
import { Refusal } from "../refusal.ts";
import { hexOf, type Imported, type ImportedPart, type RawPart, type RawParts, type Rgb } from "./part.ts";
import { guessUnit } from "./unit.ts";

/** Corners nearer than this fraction of a part's size are one: files keep seven digits. */
const WELD = 2e-7;
/** Coordinates beyond this are mistakes: squares and volumes of them lose their digits. */
const LARGEST = 1e9;
/**
 * What parts without a colour wear: a single one the first, several one after the other, so that they are told apart.
 */
const OWN_COLORS: readonly Rgb[] = (
  [
    [154, 167, 176],
    [196, 164, 108],
    [122, 156, 138],
    [168, 132, 148],
    [120, 146, 184],
    [186, 142, 118],
    [142, 138, 176],
    [160, 168, 122],
  ] as const
).map(([r, g, b]) => [r / 255, g / 255, b / 255]);

export interface FinishOptions {
  /** Metres per unit as a person says. */
  readonly metresPerUnit?: number | undefined;
}

/** Welds, counts, colours and brings to metres what a reader found. @throws {Refusal} where nothing sound is left. */
export function finishImport(name: string, raw: RawParts, { metresPerUnit }: FinishOptions = {}): Imported {
  const fixes = [...raw.notes];
  let trianglesInFile = 0;
  let notFinite = 0;
  let withoutArea = 0;
  let sound: RawPart[] = [];
  for (const part of sameTogether(raw.parts)) {
    trianglesInFile += part.mesh.indices.length / 3;
    const finite = withFiniteCorners(part.mesh);
    notFinite += (part.mesh.indices.length - finite.indices.length) / 3;
    const { mesh, dropped } = weldMesh(finite, extentOf([finite]) * WELD);
    withoutArea += dropped;
    if (mesh.indices.length > 0) sound.push({ ...part, mesh });
  }
  if (sound.length === 0) throw new Refusal("No triangle of the file has an area and finite coordinates.");
  if (notFinite > 0) fixes.push(`${plural(notFinite, "triangle")} with coordinates that are not numbers left out.`);
  if (withoutArea > 0) fixes.push(`${plural(withoutArea, "triangle")} without area left out.`);
  const bare = sound.filter(({ color }) => color === undefined).length;
  if (bare > 0) {
    fixes.push(
      `The file gives ${bare === 1 ? "1 part" : `${bare} parts`} no colour; ours ${bare === 1 ? "is" : "are"} used.`,
    );
    let next = 0;
    sound = sound.map(part => (part.color ? part : { ...part, color: OWN_COLORS[next++ % OWN_COLORS.length] }));
  }
  const { open, crowded } = edgesOf(sound);
  if (open > 0)
    fixes.push(`The surface is open along ${plural(open, "edge")}: inside and outside are not certain there.`);
  if (crowded > 0)
    fixes.push(`More than two triangles, or triangles of opposite winding, meet in ${plural(crowded, "edge")}.`);
  const unit = guessUnit(raw.format, longestOf(sound), raw.statedUnit_m, metresPerUnit);
  const parts = sound.map(
    (part, i): ImportedPart => ({
      name: part.name !== "" ? part.name : sound.length === 1 ? name : `part ${i + 1}`,
      path: part.path,
      color: hexOf(part.color ?? OWN_COLORS[0]!),
      mesh: scaledMesh(part.mesh, unit.metresPerUnit),
    }),
  );
  return imported(name, raw.format, parts, unit, trianglesInFile, { open, crowded }, fixes);
}

function imported(
  name: string,
  format: Imported["report"]["format"],
  parts: readonly ImportedPart[],
  unit: Imported["unit"],
  trianglesInFile: number,
  { open, crowded }: { readonly open: number; readonly crowded: number },
  fixes: readonly string[],
): Imported {
  const { lower, upper } = boundsOf(parts.map(({ mesh }) => mesh));
  return {
    kind: "imported",
    name,
    parts,
    unit,
    report: {
      format,
      trianglesInFile,
      triangles: sumOf(parts, ({ mesh }) => mesh.indices.length / 3),
      vertices: sumOf(parts, ({ mesh }) => mesh.positions.length / 3),
      parts: parts.length,
      materials: new Set(parts.map(({ color }) => color)).size,
      openEdges: open,
      crowdedEdges: crowded,
      lower_m: lower,
      upper_m: upper,
      size_m: [upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]],
      fixes,
    },
  };
}

/** The mesh with every length multiplied. */
export const scaledMesh = (mesh: TriangleMesh, factor: number): TriangleMesh =>
  factor === 1 ? mesh : { positions: mesh.positions.map(value => value * factor), indices: mesh.indices };

/** The box around all meshes. */
export function boundsOf(meshes: readonly TriangleMesh[]): { readonly lower: Vector3; readonly upper: Vector3 } {
  const boxes = meshes.map(meshBounds);
  const along = (k: 0 | 1 | 2, of: "lower" | "upper"): number => {
    const values = boxes.map(box => box[of][k]);
    return values.reduce((a, b) => (of === "lower" ? Math.min(a, b) : Math.max(a, b)));
  };
  return {
    lower: [along(0, "lower"), along(1, "lower"), along(2, "lower")],
    upper: [along(0, "upper"), along(1, "upper"), along(2, "upper")],
  };
}

/** Meshes one after the other as a single one. */
export function joinedMesh(meshes: readonly TriangleMesh[]): TriangleMesh {
  if (meshes.length === 1) return meshes[0]!;
  const positions = new Float64Array(sumOf(meshes, mesh => mesh.positions.length));
  const indices = new Uint32Array(sumOf(meshes, mesh => mesh.indices.length));
  let first = 0;
  let corner = 0;
  for (const mesh of meshes) {
    positions.set(mesh.positions, 3 * first);
    for (const index of mesh.indices) indices[corner++] = first + index;
    first += mesh.positions.length / 3;
  }
  return { positions, indices };
}

const sumOf = <T>(list: readonly T[], value: (each: T) => number): number =>
  list.reduce((sum, each) => sum + value(each), 0);
const plural = (count: number, noun: string): string => `${count} ${noun}${count === 1 ? "" : "s"}`;

function extentOf(meshes: readonly TriangleMesh[]): number {
  const filled = meshes.filter(({ indices }) => indices.length > 0);
  if (filled.length === 0) return 0;
  const { lower, upper } = boundsOf(filled);
  return Math.hypot(upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]);
}

function longestOf(parts: readonly RawPart[]): number {
  const { lower, upper } = boundsOf(parts.map(({ mesh }) => mesh));
  return Math.max(upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]);
}

/** Pieces of one part that have the same colour are one. */
function sameTogether(parts: readonly RawPart[]): RawPart[] {
  const groups = new Map<string, RawPart[]>();
  for (const part of parts) {
    const key = JSON.stringify([part.path, part.name, part.color]);
    const group = groups.get(key) ?? [];
    group.push(part);
    groups.set(key, group);
  }
  return [...groups.values()].map(group => ({ ...group[0]!, mesh: joinedMesh(group.map(({ mesh }) => mesh)) }));
}

/** Open and crowded edges: a part whose faces wear several colours is looked at as a whole. */
function edgesOf(parts: readonly RawPart[]): { readonly open: number; readonly crowded: number } {
  const bodies = new Map<string, TriangleMesh[]>();
  for (const { path, name, mesh } of parts) {
    const key = JSON.stringify([path, name]);
    const body = bodies.get(key) ?? [];
    body.push(mesh);
    bodies.set(key, body);
  }
  let open = 0;
  let crowded = 0;
  for (const body of bodies.values()) {
    const whole = joinedMesh(body);
    const welded = body.length === 1 ? whole : weldMesh(whole, extentOf([whole]) * WELD).mesh;
    const census = censusOfEdges(welded);
    open += census.open;
    crowded += census.crowded;
  }
  return { open, crowded };
}

function withFiniteCorners({ positions, indices }: TriangleMesh): TriangleMesh {
  const isSound = (corner: number): boolean =>
    Math.abs(positions[3 * corner]!) < LARGEST &&
    Math.abs(positions[3 * corner + 1]!) < LARGEST &&
    Math.abs(positions[3 * corner + 2]!) < LARGEST;
  const kept: number[] = [];
  for (let t = 0; t < indices.length; t += 3) {
    const [a, b, c] = [indices[t]!, indices[t + 1]!, indices[t + 2]!];
    if (isSound(a) && isSound(b) && isSound(c)) kept.push(a, b, c);
  }
  return kept.length === indices.length ? { positions, indices } : { positions, indices: Uint32Array.from(kept) };
}
