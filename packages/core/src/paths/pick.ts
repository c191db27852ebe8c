import { addScaled, distance, dot, subtract, type Vector3 } from "../spatial/vector.ts";
import { faceNormal, type EdgeChain, type FeatureEdges } from "./features.ts";
import { nextInTriangle } from "./topology.ts";

/** The spot of an edge that was meant. */
export interface EdgePick {
  readonly chain: EdgeChain;
  /** Nearest point of the chain, mesh frame [m]. */
  readonly point: Vector3;
  readonly segment: number;
  /** From what was pointed with to the edge [m]. */
  readonly distance_m: number;
}

/** The edge nearest to a point (a touch, a hand, a hit of the mouse), if one is within `tolerance_m`. */
export function edgeNearPoint(features: FeatureEdges, point: Vector3, tolerance_m: number): EdgePick | undefined {
  let best: EdgePick | undefined;
  for (const chain of features.chains)
    for (let segment = 0; segment + 1 < chain.points.length; segment++) {
      const a = chain.points[segment]!;
      const along = subtract(chain.points[segment + 1]!, a);
      const spot = addScaled(a, along, clamp(dot(subtract(point, a), along) / dot(along, along)));
      const distance_m = distance(point, spot);
      if (distance_m <= (best?.distance_m ?? tolerance_m)) best = { chain, point: spot, segment, distance_m };
    }
  return best;
}

export interface RayTolerance {
  /** Half width of the beam at its start [m] and its opening [rad]: a pixel or a shaky hand is an angle. */
  readonly beam_m: number;
  readonly opening_rad: number;
  /** Where the ray meets the surface [m]; edges farther than that plus the beam are hidden and not taken. */
  readonly depth_m?: number;
}

/** Edges as well aimed at as this, in beam widths, are told apart by who is nearer to the viewer. */
const AS_GOOD = 0.25;

/** The best aimed-at edge inside the beam, the nearer one of equals. `direction` is a unit vector. */
export function edgeNearRay(
  features: FeatureEdges,
  origin: Vector3,
  direction: Vector3,
  tolerance: RayTolerance,
): EdgePick | undefined {
  const inside: { readonly pick: EdgePick; readonly aim: number; readonly depth: number }[] = [];
  for (const chain of features.chains)
    for (let segment = 0; segment + 1 < chain.points.length; segment++) {
      const point = closestToRay(origin, direction, chain.points[segment]!, chain.points[segment + 1]!);
      const depth = dot(subtract(point, origin), direction);
      const distance_m = distance(point, addScaled(origin, direction, depth));
      const beam = tolerance.beam_m + Math.max(0, depth) * Math.tan(tolerance.opening_rad);
      if (depth < 0 || depth > (tolerance.depth_m ?? Infinity) + beam || distance_m > beam) continue;
      inside.push({ pick: { chain, point, segment, distance_m }, aim: distance_m / beam, depth });
    }
  const bestAim = inside.reduce((least, { aim }) => Math.min(least, aim), Infinity);
  let best: (typeof inside)[number] | undefined;
  for (const candidate of inside)
    if (candidate.aim <= bestAim + AS_GOOD && candidate.depth < (best?.depth ?? Infinity)) best = candidate;
  return best?.pick;
}

const clamp = (t: number): number => Math.min(1, Math.max(0, t));

/** The point of segment a–b nearest to the line of the ray. */
function closestToRay(origin: Vector3, direction: Vector3, a: Vector3, b: Vector3): Vector3 {
  const along = subtract(b, a);
  const from = subtract(a, origin);
  const uu = dot(along, along);
  const uv = dot(along, direction);
  const area = uu - uv * uv;
  const t = area > 1e-14 * uu ? clamp((uv * dot(from, direction) - dot(from, along)) / area) : 0;
  return addScaled(a, along, t);
}

/** Chains around one face, in order; a reversed one is run from its end to its beginning. */
export interface EdgeLoop {
  readonly chains: readonly { readonly chain: EdgeChain; readonly reversed: boolean }[];
  /** Outward normal of the face beside the picked segment. */
  readonly faceNormal: Vector3;
}

/**
 * The edges around the face beside `chain` whose outward normal points most along `prefer` (up, or towards the viewer):
 * counter-clockwise seen from outside, beginning with `chain`. The four top edges of a carton from any one of them.
 */
export function edgeLoop(features: FeatureEdges, chain: EdgeChain, prefer: Vector3, segment = 0): EdgeLoop {
  const { topology, chainOf } = features;
  const here = chain.halfEdges[segment]!;
  const twin = topology.twins[here]!;
  const start =
    twin >= 0 && dot(faceNormal(topology, twin), prefer) > dot(faceNormal(topology, here), prefer) ? twin : here;
  const chains: { chain: EdgeChain; reversed: boolean }[] = [];
  let h = start;
  do {
    const owner = features.chains[chainOf[h]!]!;
    const last = chains.at(-1);
    if (last?.chain !== owner) chains.push({ chain: owner, reversed: !owner.halfEdges.includes(h) });
    // Turn about the end of h inside the face until the next sharp edge.
    let next = nextInTriangle(h);
    while (chainOf[next] === -1) next = nextInTriangle(topology.twins[next]!);
    h = next;
  } while (h !== start);
  if (chains.length > 1 && chains.at(-1)!.chain === chains[0]!.chain) chains.pop();
  return { chains, faceNormal: faceNormal(topology, start) };
}
