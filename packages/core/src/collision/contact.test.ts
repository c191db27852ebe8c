import { describe, expect, test } from "vitest";
import { BufferAttribute, BufferGeometry, Matrix4, Quaternion as ThreeQuaternion, Vector3 as ThreeVector } from "three";
import { MeshBVH } from "three-mesh-bvh";
import {
  boxMesh,
  buildBvh,
  buildSolid,
  cylinderMesh,
  fromAxisAngle,
  inverse,
  mergeMeshes,
  pairScratch,
  pointInside,
  pose,
  revolvedMesh,
  rigidFromPose,
  scaleMesh,
  seededRandom,
  solidDistance,
  solidsTouch,
  sphereMesh,
  surfaceDistance,
  surfacesTouch,
  torusMesh,
  transformPoint,
  triangleDistance2,
  trianglesTouch,
  type Pose,
  type TriangleMesh,
  type Vector3,
} from "../index.ts";
import {
  distanceByProjection,
  meetInGeneral,
  randomMesh,
  randomPose,
  trianglesOf,
  type Triangle,
} from "./testing/oracles.ts";

const scratch = pairScratch();
const nearest = new Float64Array(6);
const flat = (triangle: Triangle): Float64Array => Float64Array.from(triangle.flat());
const touch = (a: TriangleMesh, b: TriangleMesh, aFromB: Pose = pose()): boolean =>
  solidsTouch(buildSolid(a), buildSolid(b), rigidFromPose(aFromB), scratch);
function gap(a: TriangleMesh, b: TriangleMesh, aFromB: Pose = pose(), cutoff_m = 10): number {
  scratch.witness.fill(-1);
  return solidDistance(buildSolid(a), buildSolid(b), rigidFromPose(aFromB), cutoff_m, scratch, nearest);
}

describe("two triangles", () => {
  test("meet exactly when an edge of one goes through the other (10 000 random pairs)", () => {
    const random = seededRandom(11);
    let met = 0;
    for (let i = 0; i < 10_000; i++) {
      const p = trianglesOf(randomMesh(random, 1))[0]!;
      const q = trianglesOf(randomMesh(random, 1))[0]!;
      const near = q.map(
        (corner, c) => corner.map((v, k) => v - q[0][k]! * 0.8 + p[c % 3]![k]! * 0.8) as Vector3,
      ) as unknown as Triangle;
      const answer = trianglesTouch(flat(p), 0, flat(near), 0);
      expect(answer).toBe(meetInGeneral(p, near));
      expect(trianglesTouch(flat(near), 0, flat(p), 0)).toBe(answer);
      if (answer) met++;
    }
    expect(met).toBeGreaterThan(500);
    expect(met).toBeLessThan(9500);
  });

  const P: Triangle = [
    [0, 0, 0],
    [4, 0, 0],
    [0, 4, 0],
  ];
  test.each<[string, Triangle, boolean]>([
    [
      "one corner on the face",
      [
        [1, 1, 0],
        [1, 1, 1],
        [2, 1, 1],
      ],
      true,
    ],
    [
      "corner to corner",
      [
        [0, 0, 0],
        [-1, 0, 1],
        [-1, -1, 1],
      ],
      true,
    ],
    [
      "corner on an edge",
      [
        [2, 0, 0],
        [2, -1, 1],
        [3, -1, -1],
      ],
      true,
    ],
    [
      "edges cross",
      [
        [2, -1, -1],
        [2, 1, 1],
        [2, -1, 1],
      ],
      true,
    ],
    [
      "shared edge, folded",
      [
        [0, 0, 0],
        [4, 0, 0],
        [0, 0, 4],
      ],
      true,
    ],
    ["same triangle", P, true],
    [
      "in one plane, inside",
      [
        [1, 1, 0],
        [1.5, 1, 0],
        [1, 1.5, 0],
      ],
      true,
    ],
    [
      "in one plane, around",
      [
        [-9, -9, 0],
        [30, -9, 0],
        [-9, 30, 0],
      ],
      true,
    ],
    [
      "in one plane, beside",
      [
        [5, 0, 0],
        [9, 0, 0],
        [5, 4, 0],
      ],
      false,
    ],
    [
      "in one plane, beyond the long edge",
      [
        [2.5, 2.5, 0],
        [4, 4, 0],
        [4, 2.5, 0],
      ],
      false,
    ],
    [
      "in one plane, edge to edge",
      [
        [4, 0, 0],
        [0, 4, 0],
        [4, 4, 0],
      ],
      true,
    ],
    [
      "parallel, one float above",
      [
        [1, 1, 1e-15],
        [1.5, 1, 1e-15],
        [1, 1.5, 1e-15],
      ],
      false,
    ],
    [
      "straddles the plane beside the face",
      [
        [4, 4, -1],
        [5, 4, 1],
        [4, 5, 1],
      ],
      false,
    ],
  ])("%s", (_, q, expected) => {
    expect(trianglesTouch(flat(P), 0, flat(q), 0)).toBe(expected);
    expect(trianglesTouch(flat(q), 0, flat(P), 0)).toBe(expected);
    expect(triangleDistance2(flat(P), 0, flat(q), 0, Infinity, nearest) === 0).toBe(expected);
  });

  test("their distance agrees with projecting to and fro (400 random pairs) and the points found are that far apart", () => {
    const random = seededRandom(12);
    for (let i = 0; i < 400; i++) {
      const p = trianglesOf(randomMesh(random, 1))[0]!;
      const q = trianglesOf(randomMesh(random, 1))[0]!;
      const squared = triangleDistance2(flat(p), 0, flat(q), 0, Infinity, nearest);
      const byProjection = distanceByProjection(p, q);
      // Projection only ever overestimates, and creeps where the triangles are nearly parallel.
      expect(Math.sqrt(squared)).toBeLessThanOrEqual(byProjection + 1e-12);
      expect(Math.sqrt(squared)).toBeGreaterThan(byProjection - 1e-4);
      expect(Math.hypot(nearest[0]! - nearest[3]!, nearest[1]! - nearest[4]!, nearest[2]! - nearest[5]!)).toBeCloseTo(
        Math.sqrt(squared),
        12,
      );
    }
  });
});

describe("two meshes", () => {
  test("surfaces meet exactly when some pair of their triangles does (300 random pairs)", () => {
    const random = seededRandom(13);
    let met = 0;
    for (let i = 0; i < 300; i++) {
      const a = randomMesh(random, 1 + Math.floor(random() * 60));
      const b = randomMesh(random, 1 + Math.floor(random() * 60));
      const aFromB = randomPose(random, 0.9);
      const inA = trianglesOf(a);
      const moved = trianglesOf(b, aFromB);
      const expected = inA.some(p => moved.some(q => meetInGeneral(p, q)));
      expect(surfacesTouch(buildBvh(a), buildBvh(b), rigidFromPose(aFromB), scratch)).toBe(expected);
      expect(surfacesTouch(buildBvh(b), buildBvh(a), rigidFromPose(inverse(aFromB)), scratch)).toBe(expected);
      if (expected) met++;
    }
    expect(met).toBeGreaterThan(60);
    expect(met).toBeLessThan(240);
  });

  test("distance is the least over all pairs of triangles, with and without a pair to begin with, and cut off when asked", () => {
    const random = seededRandom(14);
    for (let i = 0; i < 150; i++) {
      const a = randomMesh(random, 1 + Math.floor(random() * 50));
      const b = randomMesh(random, 1 + Math.floor(random() * 50));
      const aFromB = randomPose(random, 2);
      const moved = trianglesOf(b, aFromB).map(flat);
      const inA = trianglesOf(a).map(flat);
      let expected = Infinity;
      for (const p of inA)
        for (const q of moved) expected = Math.min(expected, triangleDistance2(p, 0, q, 0, Infinity, nearest));
      expected = Math.sqrt(expected);
      const treeA = buildBvh(a);
      const treeB = buildBvh(b);
      const rigid = rigidFromPose(aFromB);
      scratch.witness.fill(-1);
      expect(surfaceDistance(treeA, treeB, rigid, 100, scratch, nearest)).toBeCloseTo(expected, 10);
      expect(surfaceDistance(treeA, treeB, rigid, 100, scratch, nearest)).toBeCloseTo(expected, 10);
      expect(Math.hypot(nearest[0]! - nearest[3]!, nearest[1]! - nearest[4]!, nearest[2]! - nearest[5]!)).toBeCloseTo(
        expected,
        10,
      );
      scratch.witness.fill(-1);
      if (expected > 0) expect(surfaceDistance(treeA, treeB, rigid, expected * 0.999, scratch, nearest)).toBe(Infinity);
    }
  });

  test("agrees with three-mesh-bvh on a torus and a tilted peg (500 poses)", () => {
    const geometry = (mesh: TriangleMesh): BufferGeometry =>
      new BufferGeometry()
        .setAttribute("position", new BufferAttribute(mesh.positions, 3))
        .setIndex(new BufferAttribute(mesh.indices.slice(), 1));
    const ring = torusMesh(0.1, 0.03, 40, 16);
    const peg = cylinderMesh(0.05, 0.4, 24);
    const theirs = geometry(peg);
    const witness = new MeshBVH(geometry(ring));
    Object.assign(theirs, { boundsTree: new MeshBVH(theirs) });
    const a = buildBvh(ring);
    const b = buildBvh(peg);
    const random = seededRandom(15);
    let met = 0;
    for (let i = 0; i < 500; i++) {
      const aFromB =
        i % 2
          ? randomPose(random, 0.2)
          : pose([0.04 * random(), 0.04 * random(), 0], fromAxisAngle([1, 0, 0], 0.3 * random()));
      const matrix = new Matrix4().compose(
        new ThreeVector(...aFromB.position),
        new ThreeQuaternion(...aFromB.quaternion),
        new ThreeVector(1, 1, 1),
      );
      const answer = surfacesTouch(a, b, rigidFromPose(aFromB), scratch);
      expect(answer).toBe(witness.intersectsGeometry(theirs, matrix));
      if (answer) met++;
    }
    expect(met).toBeGreaterThan(100);
    expect(met).toBeLessThan(400);
  });
});

describe("L-72 concave parts keep their hollows", () => {
  const ring = torusMesh(0.1, 0.03, 100, 50);
  const peg = cylinderMesh(0.05, 0.4, 100);

  test("a peg stands free in a ring with 20 mm around it, and with 1 mm on one side", () => {
    expect(touch(ring, peg)).toBe(false);
    expect(gap(ring, peg)).toBeCloseTo(0.02, 4);
    expect(touch(ring, peg, pose([0.019, 0, 0]))).toBe(false);
    expect(gap(ring, peg, pose([0.019, 0, 0]))).toBeCloseTo(0.001, 4);
    expect(gap(ring, peg, pose([0.019, 0, 0]), 0.0005)).toBe(Infinity);
  });

  test("a probe in a cup, in a hole and between two prongs touches nothing though the hull of the part holds it", () => {
    const probe = sphereMesh(0.01);
    const cup = revolvedMesh(
      [
        [0, 0],
        [0.05, 0],
        [0.05, 0.1],
        [0.045, 0.1],
        [0.045, 0.005],
        [0, 0.005],
      ],
      48,
    );
    expect(touch(cup, probe, pose([0, 0, 0.05]))).toBe(false);
    expect(gap(cup, probe, pose([0, 0, 0.05]))).toBeCloseTo(0.035, 3);
    expect(touch(cup, probe, pose([0, 0, 0.012]))).toBe(true);
    expect(touch(ring, probe)).toBe(false);
    const fork = mergeMeshes([
      { mesh: boxMesh([0.3, 0.05, 0.02]) },
      ...[-0.1, 0.1].map(x => ({ mesh: boxMesh([0.02, 0.3, 0.02]), pose: pose([x, 0.15, 0]) })),
    ]);
    expect(touch(fork, probe, pose([0, 0.2, 0]))).toBe(false);
    expect(touch(fork, probe, pose([0.085, 0.2, 0]))).toBe(true);
  });

  test("1 mm further in it touches; tilted far enough it touches too", () => {
    expect(touch(ring, peg, pose([0.021, 0, 0]))).toBe(true);
    expect(gap(ring, peg, pose([0.021, 0, 0]))).toBe(0);
    expect(touch(ring, peg, pose([0, 0, 0], fromAxisAngle([0, 1, 0], 0.2)))).toBe(false);
    expect(touch(ring, peg, pose([0, 0, 0], fromAxisAngle([0, 1, 0], 1)))).toBe(true);
  });
});

describe("one solid inside another is contact", () => {
  const big = boxMesh([1, 1, 1]);
  const small = sphereMesh(0.1);
  test("whichever of them is asked", () => {
    expect(touch(big, small, pose([0.1, 0.2, 0.3]))).toBe(true);
    expect(touch(small, big, pose([0.1, 0.2, 0.3]))).toBe(true);
    expect(gap(big, small, pose([0.1, 0.2, 0.3]))).toBe(0);
    expect(touch(big, small, pose([0.7, 0, 0]))).toBe(false);
    expect(gap(big, small, pose([0.7, 0, 0]))).toBeCloseTo(0.1, 12);
  });

  test("not in the hollow of a box with walls", () => {
    const hollow = mergeMeshes([
      { mesh: big },
      { mesh: { ...scaleMesh(big, -0.9), indices: scaleMesh(big, -0.9).indices.slice().reverse() } },
    ]);
    expect(touch(hollow, small)).toBe(false);
    expect(gap(hollow, small)).toBeCloseTo(0.35, 12);
  });

  test("one of two loose pieces is enough", () => {
    const pair = mergeMeshes([{ mesh: small, pose: pose([5, 0, 0]) }, { mesh: small }]);
    expect(touch(big, pair)).toBe(true);
    expect(touch(big, pair, pose([1, 0, 0]))).toBe(false);
  });

  test("in a box with one triangle missing as well", () => {
    const open = { positions: big.positions, indices: big.indices.slice(3) };
    const random = seededRandom(16);
    for (let i = 0; i < 200; i++) {
      const at = [0, 1, 2].map(() => (random() - 0.5) * 3) as Vector3;
      const clear = at.some(v => Math.abs(v) > 0.6);
      const within = at.every(v => Math.abs(v) < 0.4);
      if (clear) expect(touch(open, small, pose(at))).toBe(false);
      if (within) expect(touch(open, small, pose(at))).toBe(true);
    }
  });

  test("rays through corners and edges count once", () => {
    const centre = pose([0, 0, 0]);
    for (const mesh of [big, sphereMesh(0.5, 8, 4), cylinderMesh(0.5, 1, 4)])
      expect(touch(mesh, scaleMesh(small, 0.01), centre)).toBe(true);
  });
});

describe("parts of one mesh that overlap are inside throughout", () => {
  const cube = boxMesh([1, 1, 1]);
  const crumb = sphereMesh(0.05);
  const twice = (by: Vector3): TriangleMesh => mergeMeshes([{ mesh: cube }, { mesh: cube, pose: pose(by) }]);
  const inOne = (at: Vector3, by: Vector3): boolean =>
    [[0, 0, 0], by].some(middle => at.every((v, k) => Math.abs(v - middle[k]!) < 0.5));

  test("an object wholly in the overlap of two boxes is found", () => {
    expect(touch(twice([0.6, 0, 0]), crumb, pose([0.3, 0, 0]))).toBe(true);
    expect(touch(crumb, twice([0.6, 0, 0]), pose([-0.3, 0, 0]))).toBe(true);
    expect(gap(twice([0.6, 0, 0]), crumb, pose([0.3, 0, 0]))).toBe(0);
    expect(gap(twice([0.6, 0, 0]), crumb, pose([0.3, 0, 0.8]))).toBeCloseTo(0.25, 3);
  });

  test.each<[string, Vector3]>([
    ["askew", [0.3, 0.4, 0.2]],
    ["flush on four sides", [0.5, 0, 0]],
    ["the same box twice", [0, 0, 0]],
    ["face on face", [1, 0, 0]],
    ["edge on edge", [1, 1, 0]],
  ])("%s: 400 random points are in exactly when one of the boxes holds them", (_, by) => {
    const solid = buildSolid(twice(by));
    const random = seededRandom(17);
    for (let i = 0; i < 400; i++) {
      const at: Vector3 = [random() * 3 - 1, random() * 3 - 1, random() * 3 - 1];
      expect(pointInside(solid, ...at, scratch)).toBe(inOne(at, by));
    }
  });

  test("a part turned inside out is as full as one that is not; a mesh whose triangles disagree is read by odd and even", () => {
    const outward = cube.indices;
    const inward = outward.slice().reverse();
    const mixed = outward.slice();
    mixed.set([outward[1]!, outward[0]!], 0);
    for (const indices of [inward, mixed]) {
      expect(touch({ positions: cube.positions, indices }, crumb)).toBe(true);
      expect(touch({ positions: cube.positions, indices }, crumb, pose([0.7, 0, 0]))).toBe(false);
    }
  });
});

describe("touching without going in is contact", () => {
  const cube = boxMesh([1, 1, 1]);
  test.each<[string, Vector3, boolean]>([
    ["face on face", [0, 0, 1], true],
    ["face on half a face", [0.5, 0.25, 1], true],
    ["edge on edge", [0, 1, 1], true],
    ["corner on corner", [1, 1, 1], true],
    ["a micrometre beside", [0, 0, 1.000001], false],
  ])("%s", (_, position, expected) => {
    expect(touch(cube, cube, pose(position))).toBe(expected);
    expect(gap(cube, cube, pose(position)) === 0).toBe(expected);
  });
});

test("an empty mesh touches nothing", () => {
  const nothing = { positions: new Float64Array(), indices: new Uint32Array() };
  expect(touch(nothing, boxMesh([1, 1, 1]))).toBe(false);
  expect(gap(boxMesh([1, 1, 1]), nothing)).toBe(Infinity);
});

test("the nearest points lie on the solids they belong to", () => {
  const aFromB = pose([2, 0.1, 0.2], fromAxisAngle([0, 0, 1], Math.PI / 4));
  expect(gap(boxMesh([1, 1, 1]), boxMesh([1, 1, 1]), aFromB)).toBeCloseTo(1.5 - Math.SQRT1_2, 12);
  expect(nearest[0]).toBeCloseTo(0.5, 12);
  const corner = transformPoint(aFromB, [-0.5, 0.5, 0]);
  expect(nearest[3]).toBeCloseTo(corner[0], 12);
  expect(nearest[4]).toBeCloseTo(corner[1], 12);
});
