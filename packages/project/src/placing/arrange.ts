import {
  compose,
  encodeMesh,
  fromAxisAngle,
  inverse,
  multiply,
  pose,
  rotate,
  type Pose,
  type Vector3,
} from "@twincell/core";
import type { CellDocument, ObjectRecord, Shape } from "../document.ts";
import { shapeMesh } from "../mesh/shape.ts";
import { worldBounds } from "./bounds.ts";

export type Axis = 0 | 1 | 2;

/** Ids of an object and of all of its group, the object first. */
export function groupOf({ objects }: CellDocument, id: string): readonly string[] {
  const group = objects.find(object => object.id === id)?.group;
  if (group === undefined) return [id];
  return [id, ...objects.filter(object => object.group === group && object.id !== id).map(object => object.id)];
}

/**
 * An object that turned and moved with a pivot: worldFromObject' = worldFromPivot' · worldFromPivot⁻¹ ·
 * worldFromObject.
 */
export function movedWith(
  worldFromObject: Pose<"world", "object">,
  before: Pose<"world", "pivot">,
  after: Pose<"world", "pivot">,
): Pose<"world", "object"> {
  return compose(after, compose(inverse(before), worldFromObject));
}

const shifted = (object: ObjectRecord, axis: Axis, by_m: number): ObjectRecord => {
  const position: Vector3 = [...object.worldFromObject.position] as Vector3;
  position[axis] += by_m;
  return { ...object, worldFromObject: { ...object.worldFromObject, position } };
};

/**
 * All objects flush with the first of them, along one axis of the world: at their lower or upper faces, or by their
 * middles.
 */
export function aligned(
  objects: readonly ObjectRecord[],
  axis: Axis,
  side: "lower" | "middle" | "upper",
): readonly ObjectRecord[] {
  const at = ({ shape, worldFromObject }: ObjectRecord): number => {
    const { lower, upper } = worldBounds(shape, worldFromObject);
    return side === "lower" ? lower[axis] : side === "upper" ? upper[axis] : (lower[axis] + upper[axis]) / 2;
  };
  const [first] = objects;
  if (first === undefined) return objects;
  const wanted = at(first);
  return objects.map(object => {
    const by_m = wanted - at(object);
    return Math.abs(by_m) < 1e-12 ? object : shifted(object, axis, by_m);
  });
}

/**
 * The pose of an object behind a mirror that stands square to an axis of the world at `at_m`. Place and heading are
 * mirrored; the shape is not: a shape that is the same on both sides of its own x–z plane comes out as its mirror
 * image, any other as itself, turned.
 */
export function mirrored(worldFromObject: Pose<"world", "object">, axis: Axis, at_m: number): Pose<"world", "object"> {
  const position: Vector3 = [...worldFromObject.position] as Vector3;
  position[axis] = 2 * at_m - position[axis];
  // The reflection M R with the object's y turned over: M R diag(1, −1, 1) is a rotation again.
  const flip = (v: Vector3): Vector3 => {
    const out: Vector3 = [...v];
    out[axis] = -out[axis];
    return out;
  };
  const x = flip(rotate(worldFromObject.quaternion, [1, 0, 0]));
  const z = flip(rotate(worldFromObject.quaternion, [0, 0, 1]));
  return { position, quaternion: fromAxes(x, z) };
}

/** The turn whose x and z axes are these: about z first, then what is missing for z. */
function fromAxes(x: Vector3, z: Vector3): [number, number, number, number] {
  const y: Vector3 = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]];
  return fromColumns(x, y, z);
}

/** Shepperd's method for the turn with these columns. */
function fromColumns(x: Vector3, y: Vector3, z: Vector3): [number, number, number, number] {
  const trace = x[0] + y[1] + z[2];
  if (trace > 0) {
    const s = 2 * Math.sqrt(trace + 1);
    return [(y[2] - z[1]) / s, (z[0] - x[2]) / s, (x[1] - y[0]) / s, s / 4];
  }
  if (x[0] > y[1] && x[0] > z[2]) {
    const s = 2 * Math.sqrt(1 + x[0] - y[1] - z[2]);
    return [s / 4, (y[0] + x[1]) / s, (z[0] + x[2]) / s, (y[2] - z[1]) / s];
  }
  if (y[1] > z[2]) {
    const s = 2 * Math.sqrt(1 + y[1] - x[0] - z[2]);
    return [(y[0] + x[1]) / s, s / 4, (z[1] + y[2]) / s, (z[0] - x[2]) / s];
  }
  const s = 2 * Math.sqrt(1 + z[2] - x[0] - y[1]);
  return [(z[0] + x[2]) / s, (z[1] + y[2]) / s, s / 4, (x[1] - y[0]) / s];
}

/** Poses of a row: the first where it stands, each next one `step_m` farther along the axes of the world. */
export const linearPattern = (
  worldFromObject: Pose<"world", "object">,
  count: number,
  step_m: Vector3,
): readonly Pose<"world", "object">[] =>
  Array.from({ length: count }, (_, i) => ({
    position: worldFromObject.position.map((value, k) => value + i * step_m[k]!) as Vector3,
    quaternion: worldFromObject.quaternion,
  }));

/** Poses of a circle about an upright axis through `centre_m`: each next one turned by `step_rad`, with its heading. */
export const circularPattern = (
  worldFromObject: Pose<"world", "object">,
  count: number,
  centre_m: readonly [number, number],
  step_rad: number,
): readonly Pose<"world", "object">[] =>
  Array.from({ length: count }, (_, i) => {
    const turn = fromAxisAngle([0, 0, 1], i * step_rad);
    const [x, y, z] = worldFromObject.position;
    const out = rotate(turn, [x - centre_m[0], y - centre_m[1], 0]);
    return pose<"world", "object">(
      [centre_m[0] + out[0], centre_m[1] + out[1], z],
      multiply(turn, worldFromObject.quaternion),
    );
  });

/**
 * A shape that is so many times as long along its own axes. What is round stays round: its radius takes the mean of x
 * and y.
 */
export function scaledShape(shape: Shape, [x, y, z]: Vector3): Shape {
  const round = (x + y) / 2;
  switch (shape.kind) {
    case "box":
      return { kind: "box", size_m: [shape.size_m[0] * x, shape.size_m[1] * y, shape.size_m[2] * z] };
    case "cylinder":
      return { kind: "cylinder", radius_m: shape.radius_m * round, height_m: shape.height_m * z };
    case "revolved":
      return { kind: "revolved", profile_m: shape.profile_m.map(([r, height]) => [r * round, height * z] as const) };
    // The numbers of a part say how large it is.
    case "part":
      return shape;
    case "mesh": {
      const mesh = shapeMesh(shape);
      const positions = Float64Array.from(mesh.positions, (value, i) => value * [x, y, z][i % 3]!);
      return { ...shape, ...encodeMesh({ positions, indices: mesh.indices }) };
    }
  }
}
