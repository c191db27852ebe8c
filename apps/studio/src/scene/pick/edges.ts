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
import { type CellDocument, type ObjectRecord, type Shape, shapeMesh } from "@twincell/project";
import { traceStore, type TraceState } from "../../stores/trace.ts";
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

/** The nearest edge under a ray, of all that is not a wall. */
export function nearestEdge(
  document: CellDocument,
  ray: Ray,
  depth_m: number,
  tolerance_rad: number,
): { readonly object: ObjectRecord; readonly pick: EdgePick } | null {
  let best: { readonly object: ObjectRecord; readonly pick: EdgePick } | null = null;
  for (const object of document.objects) {
    if (object.role === "wall") continue;
    const pick = edgeUnder(object, ray, depth_m, tolerance_rad);
    if (pick && (!best || pick.distance_m < best.pick.distance_m)) best = { object, pick };
  }
  return best;
}

/** Shows the edges that a press would take; null shows none. */
export function hoverEdges(object: string | null, edges: readonly ChosenEdge[]): void {
  const { hovered } = traceStore.getState();
  if (object === null) {
    if (hovered) traceStore.setState({ hovered: null });
    return;
  }
  const polyline = edges.flatMap(edge => edge.polyline);
  if (hovered?.object !== object || JSON.stringify(hovered.polyline) !== JSON.stringify(polyline))
    traceStore.setState({ hovered: { object, polyline } });
}

/** Takes edges to be traced; those that are all taken already are put back. */
export function takeEdges(edges: readonly ChosenEdge[]): void {
  const { chosen } = traceStore.getState();
  const same = (a: ChosenEdge) => (b: ChosenEdge) => a.object === b.object && a.edge === b.edge;
  const all = edges.every(edge => chosen.some(same(edge)));
  const kept = chosen.filter(edge => !edges.some(same(edge)));
  traceStore.setState({ chosen: all ? kept : [...kept, ...edges] });
}
