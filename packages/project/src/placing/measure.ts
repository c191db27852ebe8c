import {
  buildSolid,
  compose,
  distance,
  dot,
  inverse,
  pairScratch,
  rigidFromPose,
  solidDistance,
  subtract,
  transformPoint,
  type Pose,
  type Vector3,
} from "@twincell/core";
import type { ObjectRecord } from "../document.ts";
import { shapeMesh } from "../mesh/shape.ts";

/** A picked point of the world, with the outward normal of the face it lies on and the object it belongs to. */
export interface MeasuredPoint {
  readonly at_m: Vector3;
  readonly normal?: Vector3;
  readonly object?: string;
}
export interface Measured {
  readonly distance_m: number;
  readonly delta_m: Vector3;
  /** Between the two faces as seen from inside the material: 180° for faces of one plane, 90° at the edge of a box. */
  readonly angle_rad: number | null;
}

/** Distance, its share along each axis of the world, and the angle of the two faces. */
export function measured(a: MeasuredPoint, b: MeasuredPoint): Measured {
  const angle = a.normal && b.normal ? Math.acos(Math.min(1, Math.max(-1, dot(a.normal, b.normal)))) : null;
  return {
    distance_m: distance(a.at_m, b.at_m),
    delta_m: subtract(b.at_m, a.at_m),
    angle_rad: angle === null ? null : Math.PI - angle,
  };
}

/** How near two objects come, and where: 0 when they interfere, one wholly inside the other included. */
export interface Clearance {
  readonly distance_m: number;
  readonly from_m: Vector3;
  readonly to_m: Vector3;
}

/** The exact distance of the surfaces of two objects where they stand (row M-07). */
export function clearanceBetween(a: ObjectRecord, b: ObjectRecord): Clearance {
  const solids = [a, b].map(object => buildSolid(shapeMesh(object.shape)));
  const aFromB = rigidFromPose(compose(inverse(a.worldFromObject), b.worldFromObject) as Pose);
  const out = new Float64Array(6);
  const distance_m = solidDistance(solids[0]!, solids[1]!, aFromB, FARTHEST_M, pairScratch(), out);
  const world = (i: number): Vector3 => transformPoint(a.worldFromObject as Pose, [out[i]!, out[i + 1]!, out[i + 2]!]);
  return { distance_m, from_m: world(0), to_m: world(3) };
}
/** No cell is larger [m]. */
const FARTHEST_M = 1000;
