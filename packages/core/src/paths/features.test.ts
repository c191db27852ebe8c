import { describe, expect, test } from "vitest";
import {
  boxMesh,
  cylinderMesh,
  extrudedMesh,
  mergeMeshes,
  norm,
  pose,
  radians,
  sphereMesh,
  type TriangleMesh,
  type Vector3,
} from "../index.ts";
import { edgeLoop, edgeNearPoint, edgeNearRay, featureEdges } from "./index.ts";

const THRESHOLD = radians(30);
/** The same surface as a file stores it: every triangle with its own corners. */
const loose = (mesh: TriangleMesh): TriangleMesh => ({
  positions: Float64Array.from(
    Array.from(mesh.indices).flatMap(i => Array.from(mesh.positions.slice(3 * i, 3 * i + 3))),
  ),
  indices: Uint32Array.from(mesh.indices.keys()),
});
/** An L seen from the side: one inner edge. */
const step = extrudedMesh(
  [
    [0, 0],
    [2, 0],
    [2, 1],
    [1, 1],
    [1, 2],
    [0, 2],
  ],
  0,
  1,
);

describe("feature edges", () => {
  test("a carton has twelve, straight, outer, each with its two faces", () => {
    const { chains, open, crowded } = featureEdges(loose(boxMesh([0.4, 0.3, 0.2])), THRESHOLD);
    expect([open, crowded]).toEqual([0, 0]);
    expect(chains.length).toBe(12);
    expect(chains.reduce((sum, chain) => sum + chain.length_m, 0)).toBeCloseTo(4 * 0.9, 12);
    for (const chain of chains) {
      expect(chain.kind).toBe("convex");
      expect(chain.closed).toBe(false);
      const along = chain.points[1]!.map((v, k) => v - chain.points[0]![k]!) as Vector3;
      const [l, r] = [chain.left[0]!, chain.right[0]!];
      expect(l[0] * r[0] + l[1] * r[1] + l[2] * r[2]).toBeCloseTo(0, 12);
      // For an outer edge left × right runs along the chain.
      const turn: Vector3 = [l[1] * r[2] - l[2] * r[1], l[2] * r[0] - l[0] * r[2], l[0] * r[1] - l[1] * r[0]];
      expect(turn.map((v, k) => v * norm(along) - along[k]!).every(v => Math.abs(v) < 1e-12)).toBe(true);
    }
  });

  test("a cylinder has two closed ones, a ball none", () => {
    const { chains } = featureEdges(cylinderMesh(0.1, 0.3, 48), THRESHOLD);
    expect(chains.map(({ closed, points }) => [closed, points.length])).toEqual([
      [true, 49],
      [true, 49],
    ]);
    expect(chains[0]!.points[0]).toEqual(chains[0]!.points.at(-1));
    expect(featureEdges(sphereMesh(0.1, 64, 32), THRESHOLD).chains).toEqual([]);
  });

  test("a finer threshold sees the facets", () => {
    expect(featureEdges(cylinderMesh(0.1, 0.3, 12), radians(20)).chains.length).toBe(12 + 24);
  });

  test("the inner edge of a step is concave, the rest convex", () => {
    const { chains } = featureEdges(step, THRESHOLD);
    expect(chains.length).toBe(18);
    expect(chains.filter(chain => chain.kind === "concave").map(chain => chain.points[0]!.slice(0, 2))).toEqual([
      [1, 1],
    ]);
  });

  test("an edge cut by extra corners of the tessellation stays one chain", () => {
    const halves = mergeMeshes([{ mesh: boxMesh([1, 1, 1]) }]);
    const p = Array.from(halves.positions);
    const indices: number[] = [];
    const middle = new Map<string, number>();
    const half = (a: number, b: number): number => {
      const key = `${Math.min(a, b)} ${Math.max(a, b)}`;
      const known = middle.get(key);
      if (known !== undefined) return known;
      middle.set(key, p.length / 3);
      for (let k = 0; k < 3; k++) p.push((p[3 * a + k]! + p[3 * b + k]!) / 2);
      return p.length / 3 - 1;
    };
    for (let t = 0; t < halves.indices.length; t += 3) {
      const [a, b, c] = [halves.indices[t]!, halves.indices[t + 1]!, halves.indices[t + 2]!];
      const [ab, bc, ca] = [half(a, b), half(b, c), half(c, a)];
      indices.push(a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca);
    }
    const { chains } = featureEdges({ positions: Float64Array.from(p), indices: Uint32Array.from(indices) }, THRESHOLD);
    expect(chains.map(chain => chain.points.length)).toEqual(Array.from({ length: 12 }, () => 3));
  });

  test("the rim of an open shell is reported as border", () => {
    const box = boxMesh([1, 1, 1]);
    const { chains, open } = featureEdges({ positions: box.positions, indices: box.indices.slice(3) }, THRESHOLD);
    expect(open).toBe(3);
    expect(chains.filter(chain => chain.kind === "border").length).toBeGreaterThan(0);
  });
});

describe("picking", () => {
  const carton = featureEdges(boxMesh([0.4, 0.3, 0.2]), THRESHOLD);

  test("the edge nearest to a point within the tolerance", () => {
    const pick = edgeNearPoint(carton, [0.1, 0.148, 0.099], 0.01)!;
    expect(pick.point.map(v => Math.round(v * 1e9) / 1e9)).toEqual([0.1, 0.15, 0.1]);
    expect(pick.distance_m).toBeCloseTo(Math.hypot(0.002, 0.001), 12);
    expect(edgeNearPoint(carton, [0, 0, 0.1], 0.01)).toBeUndefined();
  });

  test("the edge under a ray, not the hidden one behind it", () => {
    const beam = { beam_m: 0.001, opening_rad: radians(1) };
    const down: Vector3 = [0, 0, -1];
    expect(edgeNearRay(carton, [0.05, 0.1505, 1], down, beam)!.point[2]).toBeCloseTo(0.1, 12);
    expect(edgeNearRay(carton, [0.05, 0, 1], down, beam)).toBeUndefined();
    const up: Vector3 = [0, 0, 1];
    expect(edgeNearRay(carton, [0.05, 0.1505, -1], up, { ...beam, depth_m: 0.9 })!.point[2]).toBeCloseTo(-0.1, 12);
    expect(edgeNearRay(carton, [0.05, 0.1505, 1], up, beam)).toBeUndefined();
  });

  test("N-53 the four top edges from any one of them, counter-clockwise seen from above", () => {
    for (const x of [-0.2, 0.2]) {
      const { chain } = edgeNearPoint(carton, [x, 0, 0.1], 0.001)!;
      const { chains, faceNormal } = edgeLoop(carton, chain, [0, 0, 1]);
      expect(faceNormal).toEqual([0, 0, 1]);
      expect(chains.length).toBe(4);
      expect(chains[0]!.chain).toBe(chain);
      let area = 0;
      const ends = chains.map(
        ({ chain: { points }, reversed }) =>
          (reversed ? [points.at(-1)!, points[0]!] : [points[0]!, points.at(-1)!]) as [Vector3, Vector3],
      );
      ends.forEach(([a, b], i) => {
        expect(ends[(i + 1) % 4]![0]).toEqual(b);
        expect(a[2]).toBeCloseTo(0.1, 12);
        area += (a[0] * b[1] - a[1] * b[0]) / 2;
      });
      expect(area).toBeCloseTo(0.12, 12);
    }
  });

  test("seen from the side, the same edge bounds the side face", () => {
    const { chain } = edgeNearPoint(carton, [0.2, 0, 0.1], 0.001)!;
    expect(edgeLoop(carton, chain, [1, 0, 0]).faceNormal).toEqual([1, 0, 0]);
  });

  test("a round rim is a loop of one closed chain; the inner outline of a hole does not run into the outer", () => {
    const can = featureEdges(cylinderMesh(0.1, 0.3, 48), THRESHOLD);
    const { chain } = edgeNearPoint(can, [0.1, 0, 0.15], 0.001)!;
    expect(edgeLoop(can, chain, [0, 0, 1]).chains).toEqual([{ chain, reversed: chain.left[0]![2] < 0.5 }]);
    const both = featureEdges(
      mergeMeshes([{ mesh: boxMesh([1, 1, 1]) }, { mesh: boxMesh([1, 1, 1]), pose: pose([3, 0, 0]) }]),
      THRESHOLD,
    );
    const pick = edgeNearPoint(both, [3.5, 0, 0.5], 0.001)!;
    for (const { chain: part } of edgeLoop(both, pick.chain, [0, 0, 1]).chains)
      for (const point of part.points) expect(point[0]).toBeGreaterThan(2);
  });
});
