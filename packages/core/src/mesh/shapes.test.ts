import { describe, expect, test } from "vitest";
import { fromAxisAngle, pose, seededRandom, type TriangleMesh } from "../index.ts";
import {
  boxMesh,
  censusOfEdges,
  cylinderMesh,
  extrudedMesh,
  isClosed,
  mergeMeshes,
  meshBounds,
  meshVolume,
  revolvedMesh,
  scaleMesh,
  sphereMesh,
  torusMesh,
  transformMesh,
  triangulate,
  weldMesh,
  type Point2,
} from "./index.ts";

/** A regular n-gon of radius 1 has area n/2 sin(2π/n): the volume of a faceted solid follows exactly. */
const gon = (n: number): number => (n / 2) * Math.sin((2 * Math.PI) / n);

describe("primitive solids are closed, outward and as large as they should be", () => {
  const cases: [string, TriangleMesh, number][] = [
    ["box", boxMesh([0.2, 0.3, 0.5]), 0.03],
    ["cylinder", cylinderMesh(0.1, 0.4, 24), 0.01 * gon(24) * 0.4],
    [
      "cone, outline from the top down",
      revolvedMesh(
        [
          [0, 0.3],
          [0.1, 0],
        ],
        16,
      ),
      (0.01 * gon(16) * 0.3) / 3,
    ],
    [
      "cup",
      revolvedMesh(
        [
          [0, 0],
          [0.1, 0],
          [0.1, 0.2],
          [0.09, 0.2],
          [0.09, 0.01],
          [0, 0.01],
        ],
        16,
      ),
      gon(16) * (0.01 * 0.2 - 0.0081 * 0.19),
    ],
    [
      "pipe",
      revolvedMesh(
        [
          [0.1, 0],
          [0.1, 1],
          [0.05, 1],
          [0.05, 0],
        ],
        12,
        { ring: true },
      ),
      gon(12) * 0.0075,
    ],
    [
      "concave prism",
      extrudedMesh(
        [
          [0, 0],
          [2, 0],
          [2, 2],
          [1, 0.5],
          [0, 2],
        ],
        -1,
        2,
      ),
      3 * 2.5,
    ],
    [
      "clockwise prism",
      extrudedMesh(
        [
          [0, 1],
          [1, 1],
          [1, 0],
          [0, 0],
        ],
        1,
        2,
      ),
      1,
    ],
  ];
  test.each(cases)("%s", (_, mesh, volume) => {
    expect(isClosed(mesh)).toBe(true);
    expect(meshVolume(mesh)).toBeCloseTo(volume, 12);
    expect(weldMesh(mesh, 1e-9)).toMatchObject({ merged: 0, dropped: 0 });
  });

  test("ball and torus come close to the round solid from inside", () => {
    const ball = sphereMesh(1, 64, 32);
    const ring = torusMesh(1, 0.2, 128, 48);
    for (const [mesh, round] of [
      [ball, (4 / 3) * Math.PI],
      [ring, 2 * Math.PI * Math.PI * 0.04],
    ] as const) {
      expect(isClosed(mesh)).toBe(true);
      expect(meshVolume(mesh)).toBeLessThan(round);
      expect(meshVolume(mesh)).toBeGreaterThan(0.99 * round);
    }
  });
});

test("parts keep their volume wherever they are put", () => {
  const turned = pose([1, -2, 3], fromAxisAngle([0, 0.6, 0.8], 1));
  const both = mergeMeshes([{ mesh: boxMesh([1, 1, 1]) }, { mesh: cylinderMesh(1, 2, 8), pose: turned }]);
  expect(meshVolume(both)).toBeCloseTo(1 + 2 * gon(8), 12);
  expect(isClosed(both)).toBe(true);
  const box = meshBounds(transformMesh(boxMesh([2, 4, 6]), pose([1, 1, 1], fromAxisAngle([0, 0, 1], Math.PI / 2))));
  [-1, 0, -2].forEach((v, k) => {
    expect(box.lower[k]).toBeCloseTo(v, 12);
  });
  [3, 2, 4].forEach((v, k) => {
    expect(box.upper[k]).toBeCloseTo(v, 12);
  });
});

test("a mirrored or scaled solid stays outward", () => {
  expect(meshVolume(scaleMesh(boxMesh([1, 2, 3]), -0.001))).toBeCloseTo(6e-9, 20);
});

test("an open shell and a doubled face are counted", () => {
  const box = boxMesh([1, 1, 1]);
  const open = { positions: box.positions, indices: box.indices.slice(3) };
  expect(censusOfEdges(open)).toEqual({ open: 3, crowded: 0 });
  const doubled = { positions: box.positions, indices: Uint32Array.of(...box.indices, ...box.indices.slice(0, 3)) };
  expect(censusOfEdges(doubled)).toEqual({ open: 0, crowded: 3 });
});

test("welding a soup of loose triangles gives the solid back", () => {
  const ball = sphereMesh(0.1, 24, 12);
  const random = seededRandom(5);
  const loose = Float64Array.from(
    Array.from(ball.indices).flatMap(i => [0, 1, 2].map(k => ball.positions[3 * i + k]! + (random() - 0.5) * 1e-7)),
  );
  const { mesh, merged, dropped } = weldMesh(
    { positions: loose, indices: Uint32Array.from(ball.indices.keys()) },
    1e-6,
  );
  expect(mesh.positions.length).toBe(ball.positions.length);
  expect([merged, dropped]).toEqual([loose.length / 3 - ball.positions.length / 3, 0]);
  expect(isClosed(mesh)).toBe(true);
});

test("a star outline is cut into triangles that cover it once", () => {
  const star: Point2[] = Array.from({ length: 14 }, (_, i) => {
    const r = i % 2 ? 0.4 : 1;
    const a = (Math.PI * i) / 7;
    return [r * Math.cos(a), r * Math.sin(a)];
  });
  for (const outline of [star, [...star].reverse()]) {
    const cut = triangulate(outline);
    let area = 0;
    for (let t = 0; t < cut.length; t += 3) {
      const [a, b, c] = [outline[cut[t]!]!, outline[cut[t + 1]!]!, outline[cut[t + 2]!]!];
      const twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
      expect(twice).toBeGreaterThan(0);
      area += twice / 2;
    }
    expect(area).toBeCloseTo(7 * 0.4 * Math.sin(Math.PI / 7), 12);
  }
});
