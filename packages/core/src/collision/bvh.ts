import type { TriangleMesh } from "../mesh/mesh.ts";

/** Triangles a leaf holds at most: measured best between 2 and 8 on robot links against a jig. */
export const LEAF_TRIANGLES = 4;
const BINS = 16;
const ROUNDING_M = 1e-12;

/**
 * A tree of axis-aligned boxes over the triangles of one mesh, in the mesh's own frame, flat in memory.
 * Node 0 is the root; the first child of an inner node follows it.
 */
export interface Bvh {
  /** 6 numbers a node: centre x, y, z and half lengths x, y, z [m]. */
  readonly boxes: Float64Array;
  /** No point of a node's box is farther than this from the origin of the frame [m]. */
  readonly reaches: Float64Array;
  /** 2 numbers a node: second child and 0, or in a leaf first triangle and number of triangles. */
  readonly links: Int32Array;
  /** 9 numbers a triangle, in the order of the leaves, each beginning with its longest edge [m]. */
  readonly corners: Float64Array;
  /** 4 numbers a triangle: centre and radius of the smallest ball around it [m]. */
  readonly balls: Float64Array;
  /** How far the third corner is from the longest edge: a triangle lies inside that edge's capsule [m]. */
  readonly heights: Float64Array;
  /** Which triangle of the mesh each was. */
  readonly source: Uint32Array;
  /** Levels below the root. */
  readonly depth: number;
}

/**
 * Builds the tree top down by the surface-area heuristic on 16 bins. Triangles without area hold no surface of their
 * own and are left out. An empty mesh gives a root leaf without triangles and a box that nothing overlaps.
 *
 * @see Wald, On fast construction of SAH-based bounding volume hierarchies, IEEE RT 2007.
 */
export function buildBvh(mesh: TriangleMesh): Bvh {
  const builder = new Builder(mesh);
  builder.split(0, builder.count, 0);
  return builder.finish();
}

class Builder {
  readonly #mesh: TriangleMesh;
  readonly #order: Uint32Array;
  /** 6 numbers a triangle of the mesh: lower and upper corner of its box. */
  readonly #extents: Float64Array;
  readonly #boxes: number[] = [];
  readonly #links: number[] = [];
  readonly #box = new Float64Array(6);
  readonly #centres = new Float64Array(6);
  readonly #binBoxes = new Float64Array(6 * BINS);
  readonly #binCounts = new Int32Array(BINS);
  readonly #rightCosts = new Float64Array(BINS);
  readonly count: number;
  #depth = 0;

  constructor(mesh: TriangleMesh) {
    const triangles = mesh.indices.length / 3;
    const extents = new Float64Array(6 * triangles);
    const order: number[] = [];
    for (let t = 0; t < triangles; t++) {
      if (hasArea(mesh, t)) order.push(t);
      for (let k = 0; k < 3; k++) {
        const a = mesh.positions[3 * mesh.indices[3 * t]! + k]!;
        const b = mesh.positions[3 * mesh.indices[3 * t + 1]! + k]!;
        const c = mesh.positions[3 * mesh.indices[3 * t + 2]! + k]!;
        extents[6 * t + k] = Math.min(a, b, c);
        extents[6 * t + 3 + k] = Math.max(a, b, c);
      }
    }
    this.#mesh = mesh;
    this.#extents = extents;
    this.#order = Uint32Array.from(order);
    this.count = order.length;
  }

  /** Appends the subtree over order[from … to). */
  split(from: number, to: number, level: number): void {
    const node = this.#links.length / 2;
    this.#depth = Math.max(this.#depth, level);
    this.#measure(from, to);
    this.#appendBox();
    this.#links.push(from, to - from);
    if (to - from <= 1) return;
    const middle = this.#partition(from, to);
    if (middle < 0) return;
    this.split(from, middle, level + 1);
    this.#links[2 * node] = this.#links.length / 2;
    this.#links[2 * node + 1] = 0;
    this.split(middle, to, level + 1);
  }

  finish(): Bvh {
    const corners = new Float64Array(9 * this.count);
    const balls = new Float64Array(4 * this.count);
    const heights = new Float64Array(this.count);
    for (let i = 0; i < this.count; i++) {
      this.#copyCorners(this.#order[i]!, corners, 9 * i);
      heights[i] = boundTriangle(corners, 9 * i, balls, 4 * i);
    }
    const boxes = Float64Array.from(this.#boxes);
    const reaches = new Float64Array(boxes.length / 6);
    for (let n = 0; n < reaches.length; n++) {
      const far = [0, 1, 2].map(k => Math.abs(boxes[6 * n + k]!) + boxes[6 * n + 3 + k]!);
      reaches[n] = Math.hypot(far[0]!, far[1]!, far[2]!);
    }
    return {
      boxes,
      reaches,
      links: Int32Array.from(this.#links),
      corners,
      balls,
      heights,
      source: this.#order,
      depth: this.#depth,
    };
  }

  /** Writes a triangle's corners, turned so that its longest edge comes first. */
  #copyCorners(triangle: number, out: Float64Array, at: number): void {
    const { positions, indices } = this.#mesh;
    const from = (c: number): number => 3 * indices[3 * triangle + (c % 3)]!;
    let longest = -1;
    let first = 0;
    for (let c = 0; c < 3; c++) {
      const a = from(c);
      const b = from(c + 1);
      const length = Math.hypot(
        positions[b]! - positions[a]!,
        positions[b + 1]! - positions[a + 1]!,
        positions[b + 2]! - positions[a + 2]!,
      );
      if (length > longest) {
        longest = length;
        first = c;
      }
    }
    for (let c = 0; c < 3; c++) for (let k = 0; k < 3; k++) out[at + 3 * c + k] = positions[from(first + c) + k]!;
  }

  #measure(from: number, to: number): void {
    emptyBox(this.#box, 0);
    emptyBox(this.#centres, 0);
    for (let i = from; i < to; i++) {
      const e = 6 * this.#order[i]!;
      growBox(this.#box, 0, this.#extents, e);
      for (let k = 0; k < 3; k++) {
        const middle = this.#extents[e + k]! + this.#extents[e + 3 + k]!;
        if (middle < this.#centres[k]!) this.#centres[k] = middle;
        if (middle > this.#centres[3 + k]!) this.#centres[3 + k] = middle;
      }
    }
  }

  #appendBox(): void {
    const box = this.#box;
    if (box[0]! > box[3]!) {
      this.#boxes.push(0, 0, 0, -Infinity, -Infinity, -Infinity);
      return;
    }
    for (let k = 0; k < 3; k++) this.#boxes.push((box[k]! + box[3 + k]!) / 2);
    // Half lengths grow by more than rounding errors of a cell's size, so that no box loses its own corner.
    for (let k = 0; k < 3; k++) this.#boxes.push((box[3 + k]! - box[k]!) / 2 + ROUNDING_M);
  }

  /** Sorts order[from … to) about the cheapest of all bin borders; −1 when staying a leaf is cheaper. */
  #partition(from: number, to: number): number {
    const count = to - from;
    const whole = surface(this.#box, 0);
    let best = Infinity;
    let bestAxis = -1;
    let bestBin = 0;
    for (let axis = 0; axis < 3; axis++) {
      const low = this.#centres[axis]!;
      const width = this.#centres[3 + axis]! - low;
      if (!(width > 0)) continue;
      const cost = this.#sweep(from, to, axis, low, BINS / width);
      if (cost.cost < best) {
        best = cost.cost;
        bestAxis = axis;
        bestBin = cost.bin;
      }
    }
    if (bestAxis < 0) return count > LEAF_TRIANGLES ? (from + to) >> 1 : -1;
    if (count <= LEAF_TRIANGLES && best >= (count - 0.5) * whole) return -1;
    const low = this.#centres[bestAxis]!;
    const perBin = BINS / (this.#centres[3 + bestAxis]! - low);
    let i = from;
    let j = to - 1;
    while (i <= j) {
      if (this.#bin(this.#order[i]!, bestAxis, low, perBin) <= bestBin) {
        i++;
        continue;
      }
      const swap = this.#order[i]!;
      this.#order[i] = this.#order[j]!;
      this.#order[j--] = swap;
    }
    return i;
  }

  #bin(triangle: number, axis: number, low: number, perBin: number): number {
    const middle = this.#extents[6 * triangle + axis]! + this.#extents[6 * triangle + 3 + axis]!;
    return Math.min(BINS - 1, Math.floor((middle - low) * perBin));
  }

  #sweep(from: number, to: number, axis: number, low: number, perBin: number): { cost: number; bin: number } {
    const boxes = this.#binBoxes;
    const counts = this.#binCounts.fill(0);
    for (let b = 0; b < BINS; b++) emptyBox(boxes, 6 * b);
    for (let i = from; i < to; i++) {
      const b = this.#bin(this.#order[i]!, axis, low, perBin);
      counts[b]!++;
      growBox(boxes, 6 * b, this.#extents, 6 * this.#order[i]!);
    }
    const running = new Float64Array(6);
    let below = 0;
    emptyBox(running, 0);
    for (let b = BINS - 1; b > 0; b--) {
      growBox(running, 0, boxes, 6 * b);
      below += counts[b]!;
      this.#rightCosts[b - 1] = below > 0 ? below * surface(running, 0) : Infinity;
    }
    let cost = Infinity;
    let bin = 0;
    below = 0;
    emptyBox(running, 0);
    for (let b = 0; b < BINS - 1; b++) {
      growBox(running, 0, boxes, 6 * b);
      below += counts[b]!;
      const here = below > 0 ? below * surface(running, 0) + this.#rightCosts[b]! : Infinity;
      if (here < cost) {
        cost = here;
        bin = b;
      }
    }
    return { cost, bin };
  }
}

/**
 * Writes the smallest ball around a triangle that begins with its longest edge: over that edge, or through all three
 * corners where that one leaves the third outside. Returns the triangle's height over the edge.
 */
function boundTriangle(corners: Float64Array, t: number, balls: Float64Array, at: number): number {
  const ax = corners[t]!;
  const ay = corners[t + 1]!;
  const az = corners[t + 2]!;
  const ux = corners[t + 3]! - ax;
  const uy = corners[t + 4]! - ay;
  const uz = corners[t + 5]! - az;
  const vx = corners[t + 6]! - ax;
  const vy = corners[t + 7]! - ay;
  const vz = corners[t + 8]! - az;
  // Centre a + s u + w v, equally far from a, a + u and a + v; w = 0 when the third corner sees the edge at 90° or
  // more.
  const uu = ux * ux + uy * uy + uz * uz;
  const uv = ux * vx + uy * vy + uz * vz;
  const vv = vx * vx + vy * vy + vz * vz;
  const area = uu * vv - uv * uv;
  const acute = vv - uv > 0 && area > 1e-12 * uu * vv;
  const w = acute ? Math.max(0, (uu * (vv - uv)) / (2 * area)) : 0;
  const s = w > 0 ? (vv * (uu - uv)) / (2 * area) : 0.5;
  const cx = s * ux + w * vx;
  const cy = s * uy + w * vy;
  const cz = s * uz + w * vz;
  const far = Math.max(
    cx * cx + cy * cy + cz * cz,
    (cx - ux) ** 2 + (cy - uy) ** 2 + (cz - uz) ** 2,
    (cx - vx) ** 2 + (cy - vy) ** 2 + (cz - vz) ** 2,
  );
  balls[at] = ax + cx;
  balls[at + 1] = ay + cy;
  balls[at + 2] = az + cz;
  balls[at + 3] = Math.sqrt(far) + ROUNDING_M;
  const px = uy * vz - uz * vy;
  const py = uz * vx - ux * vz;
  const pz = ux * vy - uy * vx;
  return Math.sqrt((px * px + py * py + pz * pz) / uu) + ROUNDING_M;
}

function hasArea({ positions: p, indices }: TriangleMesh, t: number): boolean {
  const a = 3 * indices[3 * t]!;
  const b = 3 * indices[3 * t + 1]!;
  const c = 3 * indices[3 * t + 2]!;
  const ux = p[b]! - p[a]!;
  const uy = p[b + 1]! - p[a + 1]!;
  const uz = p[b + 2]! - p[a + 2]!;
  const vx = p[c]! - p[a]!;
  const vy = p[c + 1]! - p[a + 1]!;
  const vz = p[c + 2]! - p[a + 2]!;
  return uy * vz - uz * vy !== 0 || uz * vx - ux * vz !== 0 || ux * vy - uy * vx !== 0;
}

function emptyBox(box: Float64Array, at: number): void {
  for (let k = 0; k < 3; k++) {
    box[at + k] = Infinity;
    box[at + 3 + k] = -Infinity;
  }
}

function growBox(box: Float64Array, at: number, by: Float64Array, from: number): void {
  for (let k = 0; k < 3; k++) {
    if (by[from + k]! < box[at + k]!) box[at + k] = by[from + k]!;
    if (by[from + 3 + k]! > box[at + 3 + k]!) box[at + 3 + k] = by[from + 3 + k]!;
  }
}

function surface(box: Float64Array, at: number): number {
  const x = box[at + 3]! - box[at]!;
  const y = box[at + 4]! - box[at + 1]!;
  const z = box[at + 5]! - box[at + 2]!;
  return x * y + y * z + z * x;
}
