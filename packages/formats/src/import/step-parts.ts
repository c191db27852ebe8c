import { Refusal } from "../refusal.ts";
import type { RawPart, RawParts, Rgb } from "./part.ts";

/** What occt-import-js answers, as far as it is used here; lengths in the unit that was asked for. */
export interface OcctResult {
  readonly success: boolean;
  readonly root?: OcctNode;
  readonly meshes?: readonly OcctMesh[];
}
export interface OcctNode {
  readonly name: string;
  readonly meshes: readonly number[];
  readonly children: readonly OcctNode[];
}
export interface OcctMesh {
  readonly name: string;
  readonly color?: readonly number[] | null;
  readonly brep_faces?: readonly {
    readonly first: number;
    readonly last: number;
    readonly color?: readonly number[] | null;
  }[];
  readonly attributes: { readonly position: { readonly array: ArrayLike<number> } };
  readonly index: { readonly array: ArrayLike<number> };
}

/**
 * How finely curved faces become triangles: far from the true surface at most so much [mm] and so much turned [rad].
 */
export const STEP_FINENESS = { linearDeflection: 0.05, angularDeflection: 0.3 } as const;
/** What occt-import-js is asked: millimetres, so that the answer's unit is known. */
export const STEP_PARAMETERS = {
  linearUnit: "millimeter",
  linearDeflectionType: "absolute_value",
  ...STEP_FINENESS,
} as const;

/** The name that the kernel gives to what has none. */
const NAMELESS = /^Open CASCADE STEP translator|^$|^COMPOUND$|^SOLID$/;

/**
 * Parts of a STEP file with their place in the assembly and their colours; faces of another colour become a part of
 * their own.
 *
 * @throws {Refusal} where the kernel read nothing.
 */
export function stepParts(result: OcctResult): RawParts {
  const { root, meshes = [] } = result;
  if (!result.success || !root) throw new Refusal("The file is no STEP file that the CAD kernel can read.");
  const parts: RawPart[] = [];
  const visit = (node: OcctNode, path: readonly string[]): void => {
    const here = NAMELESS.test(node.name) ? path : [...path, node.name];
    for (const index of node.meshes) {
      const mesh = meshes[index];
      if (mesh) parts.push(...partsOf(mesh, here));
    }
    for (const child of node.children) visit(child, here);
  };
  visit(root, []);
  if (parts.length === 0) throw new Refusal("The STEP file holds no solid or surface.");
  const { linearDeflection, angularDeflection } = STEP_FINENESS;
  return {
    format: "STEP",
    parts,
    statedUnit_m: 0.001,
    notes: [
      `Curved faces became triangles that stand at most ${linearDeflection} mm off, and turn at most ${angularDeflection} rad from one to the next.`,
    ],
  };
}

const colorOf = (color: readonly number[] | null | undefined): Rgb | undefined =>
  color && color.length >= 3 ? [color[0]!, color[1]!, color[2]!] : undefined;

function partsOf(mesh: OcctMesh, path: readonly string[]): RawPart[] {
  const positions = Float64Array.from(mesh.attributes.position.array);
  const groups = new Map<string, { readonly color: Rgb | undefined; readonly indices: number[] }>();
  const groupOf = (color: Rgb | undefined): number[] => {
    const key = color?.join() ?? "";
    const group = groups.get(key) ?? { color, indices: [] };
    groups.set(key, group);
    return group.indices;
  };
  const index = mesh.index.array;
  const adapters = mesh.brep_faces ?? [];
  const colorOfTriangle = new Array<Rgb | undefined>(index.length / 3).fill(colorOf(mesh.color));
  for (const { first, last, color } of adapters) {
    const own = colorOf(color);
    if (own) for (let t = first; t <= last; t++) colorOfTriangle[t] = own;
  }
  for (let t = 0; t < index.length / 3; t++)
    groupOf(colorOfTriangle[t]).push(index[3 * t]!, index[3 * t + 1]!, index[3 * t + 2]!);
  const name = NAMELESS.test(mesh.name) ? (path.at(-1) ?? "") : mesh.name;
  return [...groups.values()].map(({ color, indices }) => ({
    name,
    path: path.at(-1) === name ? path.slice(0, -1) : path,
    color,
    mesh: { positions, indices: Uint32Array.from(indices) },
  }));
}
