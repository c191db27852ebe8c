// Lofts around a voxel solid: boxes are halved where that saves most, then every box becomes rings along its best axis.
import type { Voxels } from "./voxels.ts";

/** Half-open ranges of cells along x, y, z. */
type Box = readonly [number, number, number, number, number, number];
/** u0, u1, v0, v1 and four corner radii [cells]; a layer of a box. */
interface Layer {
  readonly u0: number;
  readonly u1: number;
  readonly v0: number;
  readonly v1: number;
  readonly r: readonly [number, number, number, number];
}
interface Chunk {
  readonly box: Box;
  readonly axis: number;
  readonly cost: number;
  readonly worst: number;
}

/** w, u0, u1, v0, v1, corner radii at (u0,v0), (u1,v0), (u1,v1), (u0,v1) [mm]. */
export type FittedRing = number[];
export interface FittedLoft {
  readonly along: "x" | "y" | "z";
  readonly rings: FittedRing[];
  readonly free: readonly [boolean, boolean];
}

/** A half is at least this many coarse cells thick, and two halves must save this much. */
const THINNEST = 3;
const WORTH = 0.97;
/** How far castings reach into one another where one was cut in two [fine cells]. */
const OVERLAP = 1;

const strides = ({ count }: Voxels): [number, number, number] => [count[1] * count[2], count[2], 1];

export function fitLofts(
  coarse: Voxels,
  fine: Voxels,
  most: number,
  enough_m: number,
  tolerance_m: number,
): FittedLoft[] {
  const whole = shrink(coarse, [0, coarse.count[0], 0, coarse.count[1], 0, coarse.count[2]]);
  let chunks = [best(coarse, whole)];
  const dead = new Set<Chunk>();
  while (chunks.length < most) {
    const open = chunks.filter(chunk => !dead.has(chunk) && chunk.worst * coarse.pitch_m > enough_m);
    if (open.length === 0) break;
    const worst = open.reduce((a, b) => (a.cost > b.cost ? a : b));
    const halves = split(coarse, worst);
    if (halves === undefined) {
      dead.add(worst);
      continue;
    }
    chunks = [...chunks.filter(chunk => chunk !== worst), ...halves];
  }
  const scale = coarse.pitch_m / fine.pitch_m;
  return chunks.flatMap(({ box, axis }) => {
    const moved = box.map((cell, i) =>
      Math.round(((coarse.origin[i >> 1]! - fine.origin[i >> 1]!) / coarse.pitch_m + cell) * scale),
    );
    const grown = moved.map((cell, i) => Math.min(fine.count[i >> 1]!, Math.max(0, cell))) as unknown as Box;
    return loftsOf(fine, shrink(fine, grown), axis, tolerance_m);
  });
}

function best(voxels: Voxels, box: Box): Chunk {
  return [0, 1, 2]
    .map(axis => ({ box, axis, ...costOf(voxels, box, axis) }))
    .reduce((a, b) => (a.cost <= b.cost ? a : b));
}

function split(voxels: Voxels, chunk: Chunk): [Chunk, Chunk] | undefined {
  let found: [Chunk, Chunk] | undefined;
  let least = chunk.cost * WORTH;
  for (let axis = 0; axis < 3; axis++) {
    for (let at = chunk.box[2 * axis]! + THINNEST; at <= chunk.box[2 * axis + 1]! - THINNEST; at++) {
      const low = [...chunk.box];
      const high = [...chunk.box];
      low[2 * axis + 1] = at;
      high[2 * axis] = at;
      const a = best(voxels, shrink(voxels, low as unknown as Box));
      const b = best(voxels, shrink(voxels, high as unknown as Box));
      if (a.cost + b.cost < least) {
        least = a.cost + b.cost;
        found = [a, b];
      }
    }
  }
  return found;
}

function shrink(voxels: Voxels, box: Box): Box {
  const out = [Infinity, -Infinity, Infinity, -Infinity, Infinity, -Infinity];
  const [sx, sy] = strides(voxels);
  for (let x = box[0]; x < box[1]; x++)
    for (let y = box[2]; y < box[3]; y++)
      for (let z = box[4]; z < box[5]; z++) {
        if (voxels.solid[x * sx + y * sy + z] !== 1) continue;
        out[0] = Math.min(out[0]!, x);
        out[1] = Math.max(out[1]!, x + 1);
        out[2] = Math.min(out[2]!, y);
        out[3] = Math.max(out[3]!, y + 1);
        out[4] = Math.min(out[4]!, z);
        out[5] = Math.max(out[5]!, z + 1);
      }
  return out[0] === Infinity ? [0, 0, 0, 0, 0, 0] : (out as unknown as Box);
}

/** Rectangle around the solid cells of a layer, each corner as round as they allow. */
function layerOf(voxels: Voxels, box: Box, axis: number, w: number): Layer | undefined {
  const iu = (axis + 1) % 3;
  const iv = (axis + 2) % 3;
  const s = strides(voxels);
  const su = s[iu]!;
  const sv = s[iv]!;
  const at = w * s[axis]!;
  let u0 = Infinity;
  let u1 = -Infinity;
  let v0 = Infinity;
  let v1 = -Infinity;
  for (let u = box[2 * iu]!; u < box[2 * iu + 1]!; u++)
    for (let v = box[2 * iv]!; v < box[2 * iv + 1]!; v++) {
      if (voxels.solid[at + u * su + v * sv] !== 1) continue;
      u0 = Math.min(u0, u);
      u1 = Math.max(u1, u + 1);
      v0 = Math.min(v0, v);
      v1 = Math.max(v1, v + 1);
    }
  if (u1 < u0) return undefined;
  const half = Math.min(u1 - u0, v1 - v0) / 2;
  const r: [number, number, number, number] = [half, half, half, half];
  for (let u = u0; u < u1; u++)
    for (let v = v0; v < v1; v++) {
      if (voxels.solid[at + u * su + v * sv] !== 1) continue;
      const left = u + 0.9 - u0;
      const right = u1 - u - 0.1;
      const low = v + 0.9 - v0;
      const high = v1 - v - 0.1;
      r[0] = Math.min(r[0], left + low + Math.sqrt(2 * left * low));
      r[1] = Math.min(r[1], right + low + Math.sqrt(2 * right * low));
      r[2] = Math.min(r[2], right + high + Math.sqrt(2 * right * high));
      r[3] = Math.min(r[3], left + high + Math.sqrt(2 * left * high));
    }
  return { u0, u1, v0, v1, r };
}

function costOf(voxels: Voxels, box: Box, axis: number): { cost: number; worst: number } {
  const iu = (axis + 1) % 3;
  const iv = (axis + 2) % 3;
  const s = strides(voxels);
  const su = s[iu]!;
  const sv = s[iv]!;
  let cost = 0;
  let worst = 0;
  for (let w = box[2 * axis]!; w < box[2 * axis + 1]!; w++) {
    const layer = layerOf(voxels, box, axis, w);
    if (layer === undefined) continue;
    const { u0, u1, v0, v1, r } = layer;
    for (let u = u0; u < u1; u++)
      for (let v = v0; v < v1; v++) {
        const away = voxels.away[w * s[axis]! + u * su + v * sv]!;
        if (away === 0) continue;
        const left = u + 0.5 - u0;
        const right = u1 - u - 0.5;
        const low = v + 0.5 - v0;
        const high = v1 - v - 0.5;
        const corner = left < right ? (low < high ? 0 : 3) : low < high ? 1 : 2;
        const radius = r[corner]!;
        const a = radius - Math.min(left, right);
        const b = radius - Math.min(low, high);
        if (a > 0 && b > 0 && a * a + b * b > radius * radius) continue;
        cost += away * away;
        worst = Math.max(worst, away);
      }
  }
  return { cost, worst };
}

function loftsOf(voxels: Voxels, box: Box, axis: number, tolerance_m: number): FittedLoft[] {
  const iu = (axis + 1) % 3;
  const iv = (axis + 2) % 3;
  const mm = 1000 * voxels.pitch_m;
  const along = (["x", "y", "z"] as const)[axis]!;
  const lofts: FittedLoft[] = [];
  const place = (index: number, cells: number): number => 1000 * voxels.origin[index]! + mm * cells;
  // A side at the cut of the box, where the link goes on, reaches into its neighbour; a true side is the surface
  // itself.
  const s = strides(voxels);
  const goesOn = (index: number, cell: number, other: number, w: number, from: number, to: number): boolean => {
    if (cell < 0 || cell >= voxels.count[index]!) return false;
    let solid = 0;
    for (let k = from; k < to; k++) solid += voxels.solid[w * s[axis]! + cell * s[index]! + k * s[other]!]!;
    return solid > 0.3 * (to - from);
  };
  const toRing = (w: number, { u0, u1, v0, v1, r }: Layer): FittedRing => {
    const layer = Math.floor(w);
    const low = (cut: boolean): number => (cut ? -OVERLAP : 0.25);
    return [
      place(axis, w),
      place(iu, u0 + low(goesOn(iu, u0 - 1, iv, layer, v0, v1))),
      place(iu, u1 - low(goesOn(iu, u1, iv, layer, v0, v1))),
      place(iv, v0 + low(goesOn(iv, v0 - 1, iu, layer, u0, u1))),
      place(iv, v1 - low(goesOn(iv, v1, iu, layer, u0, u1))),
      ...r.map(radius => Math.max(0, radius - 0.25) * mm),
    ];
  };
  let run: { w: number; layer: Layer }[] = [];
  const flush = (): void => {
    if (run.length * mm >= 4) {
      const smooth = run.map(({ w, layer }, i) => ({
        w,
        layer: {
          ...layer,
          r: [0, 1, 2, 3].map(c =>
            median(run.slice(Math.max(0, i - 2), i + 3).map(each => each.layer.r[c]!)),
          ) as unknown as Layer["r"],
        },
      }));
      const rings = smooth.map(({ w, layer }) => toRing(w + 0.5, layer));
      const first = run[0]!;
      const last = run.at(-1)!;
      const free = [
        isFree(voxels, axis, first.w - 1, first.layer),
        isFree(voxels, axis, last.w + 1, last.layer),
      ] as const;
      rings.unshift([place(axis, first.w + (free[0] ? 0.25 : -OVERLAP)), ...rings[0]!.slice(1)]);
      rings.push([place(axis, last.w + 1 + (free[1] ? -0.25 : OVERLAP)), ...rings.at(-1)!.slice(1)]);
      lofts.push({
        along,
        rings: distinct(simplified(rings, 1000 * tolerance_m).map(ring => ring.map(Math.round))),
        free,
      });
    }
    run = [];
  };
  for (let w = box[2 * axis]!; w < box[2 * axis + 1]!; w++) {
    const layer = layerOf(voxels, box, axis, w);
    if (layer === undefined) flush();
    else run.push({ w, layer });
  }
  flush();
  return lofts;
}

/** Rings rounded onto the same place would make a wall of no thickness. */
const distinct = (rings: readonly FittedRing[]): FittedRing[] =>
  rings.filter((ring, i) => i === 0 || ring[0] !== rings[i - 1]![0]);

const median = (values: number[]): number => values.toSorted((a, b) => a - b)[values.length >> 1]!;

/** An end counts as free when little of the link goes on behind it. */
function isFree(voxels: Voxels, axis: number, w: number, { u0, u1, v0, v1 }: Layer): boolean {
  if (w < 0 || w >= voxels.count[axis]!) return true;
  const s = strides(voxels);
  const su = s[(axis + 1) % 3]!;
  const sv = s[(axis + 2) % 3]!;
  let solid = 0;
  for (let u = u0; u < u1; u++) for (let v = v0; v < v1; v++) solid += voxels.solid[w * s[axis]! + u * su + v * sv]!;
  return solid < 0.25 * (u1 - u0) * (v1 - v0);
}

/**
 * Fewer rings, none of whose numbers is off by more than the tolerance (Douglas, Peucker 1973). Radii count a third.
 */
function simplified(rings: readonly FittedRing[], tolerance: number): FittedRing[] {
  const keep = new Set([0, rings.length - 1]);
  const walk = (a: number, b: number): void => {
    let worst = tolerance;
    let at = -1;
    for (let i = a + 1; i < b; i++) {
      const t = (rings[i]![0]! - rings[a]![0]!) / (rings[b]![0]! - rings[a]![0]!);
      for (let k = 1; k < 9; k++) {
        const off = Math.abs(rings[a]![k]! + t * (rings[b]![k]! - rings[a]![k]!) - rings[i]![k]!) * (k > 4 ? 0.3 : 1);
        if (off > worst) {
          worst = off;
          at = i;
        }
      }
    }
    if (at < 0) return;
    keep.add(at);
    walk(a, at);
    walk(at, b);
  };
  walk(0, rings.length - 1);
  return [...keep].sort((a, b) => a - b).map(i => rings[i]!);
}
