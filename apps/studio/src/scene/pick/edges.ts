import {
  type EdgePick,
  edgeLoop,
  edgeNearRay,
  type FeatureEdges,
  featureEdges,
  inverse,
  rotate,
  SHARP_RAD,
  conjugate,
  transformPoint,
  type Vector3,
} from "@twincell/core";
import { type ObjectRecord, type Shape, shapeMesh } from "@twincell/project";
import type { TraceState } from "../../stores/trace.ts";
import type { Ray } from "../handle/drag-maths.ts";

const known = new WeakMap<Shape, FeatureEdges>();

/** The sharp edges of a shape, found once. */
export function edgesOf(shape: Shape): FeatureEdges {
  let edges = known.get(shape);
  if (!edges) known.set(shape, (edges = featureEdges(shapeMesh(shape), SHARP_RAD)));
  return edges;
}

/** The edge under a ray with a tolerance that is an angle, `pixels` wide on the screen. */
export function edgeUnder(
  object: ObjectRecord,
  ray: Ray,
  depth_m: number,
  tolerance_rad: number,
): EdgePick | undefined {
  const objectFromWorld = inverse(object.worldFromObject);
  const origin = transformPoint(objectFromWorld, ray.origin);
  const direction = rotate(objectFromWorld.quaternion, ray.direction);
  return edgeNearRay(edgesOf(object.shape), origin, direction, { beam_m: 1e-4, opening_rad: tolerance_rad, depth_m });
}

export type ChosenEdge = TraceState["chosen"][number];

/** The edge, or with `loop` all edges around the more upward of its two faces, in order, seen in the world. */
export function chosenEdges(object: ObjectRecord, pick: EdgePick, loop: boolean): ChosenEdge[] {
  const inWorld = (points: readonly Vector3[]): Vector3[] =>
    points.map(point => transformPoint(object.worldFromObject, point));
  if (!loop) return [{ object: object.id, edge: pick.chain.id, polyline: inWorld(pick.chain.points) }];
  const up = rotate(conjugate(object.worldFromObject.quaternion), [0, 0, 1]);
  return edgeLoop(edgesOf(object.shape), pick.chain, up, pick.segment).chains.map(({ chain, reversed }) => ({
    object: object.id,
    edge: chain.id,
    polyline: inWorld(reversed ? chain.points.toReversed() : chain.points),
  }));
}
