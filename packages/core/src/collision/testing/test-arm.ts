import {
  boxMesh,
  pose,
  transformMesh,
  type CellGeometry,
  type CellObject,
  type Joint,
  type SerialArm,
  type TriangleMesh,
  type Vector3,
} from "../../index.ts";

const LIMITS = { lower_rad: -4, upper_rad: 4, speed_rad_s: 1, acceleration_rad_s2: 1 };
const joint = (name: string, at: Vector3): Joint => ({
  name,
  parentFromJoint: pose(at),
  axis: [0, 0, 1],
  limits: LIMITS,
});

/** Three links of 1 m turning about parallel z axes in the plane z = 0: every distance can be worked out by hand. */
export const planarArm: SerialArm = {
  name: "three bars",
  joints: [joint("a", [0, 0, 0]), joint("b", [1, 0, 0]), joint("c", [1, 0, 0])],
  lastJointFromFlange: pose([1, 0, 0]),
};
/** A bar from the joint to 1 m along x, 40 mm square, ends 10 mm short of both. */
export const bar = transformMesh(boxMesh([0.98, 0.04, 0.04]), pose([0.5, 0, 0]));
export const post = boxMesh([0.05, 0.05, 0.05]);

export const box = (id: string, position: Vector3, size_m: Vector3): CellObject => ({
  id,
  name: id,
  mesh: boxMesh(size_m),
  worldFromObject: pose(position),
});

export function planarCell(
  objects: readonly CellObject[],
  more: Partial<CellGeometry> = {},
  link: TriangleMesh = bar,
): CellGeometry {
  return {
    worldFromBase: pose(),
    objects,
    allowedPairs: [],
    shapeError_m: 0,
    links: [{ link: 0, name: "post", mesh: post }, ...[1, 2, 3].map(i => ({ link: i, name: `bar ${i}`, mesh: link }))],
    ...more,
  };
}
