import { encodeMesh, meshBounds, type TriangleMesh, type Vector3 } from "@twincell/core";
import type { CellDocument, ObjectRecord } from "./document.ts";
import { shapeMesh } from "./mesh/shape.ts";

/** A part of an imported file as a cell takes it: metres, z up, where the file puts it. */
export interface PartToPlace {
  readonly name: string;
  /** `#rrggbb`. */
  readonly color: string;
  readonly mesh: TriangleMesh;
}

/** Shorter imports are put down in front of the robot, longer ones (halls, scans) around it [m]. */
const BESIDE_M = 3;
const GAP_M = 0.35;

/**
 * The parts as objects of a cell. Each has its frame in the middle of its own underside, so that it turns about itself;
 * together they stand as in the file, their lowest point on the floor.
 *
 * @param file   name of the file, kept in every object.
 * @param taken  ids that are in use.
 * @param at_m   where the middle of the underside of all parts is put; in front of a robot at the origin when absent.
 */
export function placeParts(
  parts: readonly PartToPlace[],
  file: string,
  taken: ReadonlySet<string>,
  at_m?: Vector3,
): readonly ObjectRecord[] {
  const boxes = parts.map(({ mesh }) => meshBounds(mesh));
  const whole = {
    lower: [0, 1, 2].map(k => boxes.reduce((least, { lower }) => Math.min(least, lower[k]!), Infinity)),
    upper: [0, 1, 2].map(k => boxes.reduce((most, { upper }) => Math.max(most, upper[k]!), -Infinity)),
  };
  const sides = [0, 1, 2].map(k => whole.upper[k]! - whole.lower[k]!);
  const isLarge = Math.max(...sides) > BESIDE_M;
  const [x, y, z] = at_m ?? [isLarge ? 0 : GAP_M + sides[0]! / 2, 0, 0];
  const shift = [
    x - (whole.lower[0]! + whole.upper[0]!) / 2,
    y - (whole.lower[1]! + whole.upper[1]!) / 2,
    z - whole.lower[2]!,
  ];
  const ids = new Set(taken);
  return parts.map(({ name, color, mesh }, i): ObjectRecord => {
    const { lower, upper } = boxes[i]!;
    const foot = [(lower[0] + upper[0]) / 2, (lower[1] + upper[1]) / 2, lower[2]];
    const own = { positions: mesh.positions.map((value, at) => value - foot[at % 3]!), indices: mesh.indices };
    const id = freeId(name, ids);
    ids.add(id);
    return {
      id,
      name: id,
      role: "fixture",
      worldFromObject: {
        position: [foot[0]! + shift[0]!, foot[1]! + shift[1]!, foot[2]! + shift[2]!],
        quaternion: [0, 0, 0, 1],
      },
      shape: { kind: "mesh", file, ...encodeMesh(own) },
      color,
    };
  });
}

function freeId(name: string, taken: ReadonlySet<string>): string {
  let id = name;
  for (let n = 2; taken.has(id); n++) id = `${name} ${n}`;
  return id;
}

/**
 * Objects made larger or smaller together: a unit that was taken wrongly is put right. They keep where they stand to
 * each other, and the lowest of them keeps its height. Only meshes change.
 *
 * @param factor  above 0; 1000 makes metres of what was taken for millimetres.
 */
export function rescaledObjects(objects: readonly ObjectRecord[], factor: number): readonly ObjectRecord[] {
  if (objects.length === 0 || !(factor > 0) || factor === 1) return objects;
  const fixed = [0, 1, 2].map(k => {
    const values = objects.map(({ worldFromObject: { position } }) => position[k]!);
    return k === 2 ? Math.min(...values) : (Math.min(...values) + Math.max(...values)) / 2;
  });
  return objects.map((object): ObjectRecord => {
    if (object.shape.kind !== "mesh") return object;
    const { positions, indices } = shapeMesh(object.shape);
    const { position, quaternion } = object.worldFromObject;
    const moved = (k: 0 | 1 | 2): number => fixed[k]! + factor * (position[k] - fixed[k]!);
    return {
      ...object,
      worldFromObject: { position: [moved(0), moved(1), moved(2)], quaternion },
      shape: {
        kind: "mesh",
        file: object.shape.file,
        ...encodeMesh({ positions: positions.map(value => value * factor), indices }),
      },
    };
  });
}

/** The objects of a cell that came from a file. @param file  as the objects name it. */
export const importedFrom = ({ objects }: CellDocument, file: string): readonly ObjectRecord[] =>
  objects.filter(({ shape }) => shape.kind === "mesh" && shape.file === file);

/** The cell with some of its objects replaced by those of the same id; what is no longer there stays away. */
export function withObjects(document: CellDocument, changed: readonly ObjectRecord[]): CellDocument {
  const byId = new Map(changed.map(object => [object.id, object]));
  return { ...document, objects: document.objects.map(object => byId.get(object.id) ?? object) };
}
