import fc from "fast-check";
import { expect, test } from "vitest";
import {
  boxMesh,
  cylinderMesh,
  dot,
  extrudedMesh,
  featureEdges,
  fromAxisAngle,
  mergeMeshes,
  pose,
  revolvedMesh,
  rotate,
  SHARP_RAD,
  sphereMesh,
  surfaceFeatureAt,
  transformMesh,
  transformPoint,
  type Pose,
  type TriangleMesh,
  type Vector3,
} from "../index.ts";

const at = (mesh: TriangleMesh, point: Vector3, near_m = 0.005) =>
  surfaceFeatureAt(featureEdges(mesh, SHARP_RAD), point, near_m);
/** A ring: outer radius 50 mm, bore 20 mm, 30 mm high. */
const RING = revolvedMesh(
  [
    [0.02, 0],
    [0.05, 0],
    [0.05, 0.03],
    [0.02, 0.03],
  ],
  48,
  { ring: true },
);

test("a shaft and a bore, wherever the part stands: axis to 1e-6, radius and middle to a micrometre, the bore told from the shaft", () => {
  const number = fc.double({ min: -2, max: 2, noNaN: true });
  fc.assert(
    fc.property(fc.tuple(number, number, number), fc.tuple(number, number, number), number, (to, about, turn) => {
      const axis: Vector3 = [about[0], about[1], about[2] + 3];
      const size = Math.hypot(...axis);
      const placed = pose(to, fromAxisAngle(axis.map(value => value / size) as Vector3, turn)) as Pose;
      const mesh = transformMesh(RING, placed);
      const along = rotate(placed.quaternion, [0, 0, 1]);
      for (const [radius, inside] of [
        [0.05, false],
        [0.02, true],
      ] as const) {
        const angle = Math.PI / 48;
        const flat = radius * Math.cos(angle);
        const point: Vector3 = [flat * Math.cos(angle), flat * Math.sin(angle), 0.011];
        const found = at(mesh, transformPoint(placed, point));
        if (found?.kind !== "cylinder") throw new Error(found?.kind ?? "nothing");
        expect(found.inside).toBe(inside);
        expect(Math.abs(found.radius_m - radius)).toBeLessThan(1e-6);
        expect(found.length_m).toBeCloseTo(0.03, 6);
        expect(Math.abs(dot(found.axis, along))).toBeGreaterThan(1 - 1e-12);
        const middle = transformPoint(placed, [0, 0, 0.015]);
        found.center_m.forEach((value, k) => expect(Math.abs(value - middle[k]!)).toBeLessThan(1e-6));
      }
    }),
    { seed: 3, numRuns: 40 },
  );
});

test("the rim of a hole is a circle within reach of it, and a plane farther off", () => {
  const near = at(RING, [0.022, 0, 0.03], 0.003);
  expect(near?.kind).toBe("circle");
  if (near?.kind !== "circle") return;
  expect(near.radius_m).toBeCloseTo(0.02, 9);
  expect(near.center_m[2]).toBeCloseTo(0.03, 9);
  expect(near.axis).toEqual([0, 0, 1]);
  const far = at(RING, [0.035, 0, 0.03], 0.003);
  expect(far?.kind).toBe("plane");
  expect(far?.axis).toEqual([0, 0, 1]);
  const under = at(RING, [0.035, 0, 0], 0.003);
  expect(under?.axis[2]).toBeCloseTo(-1, 12);
});

test("a slot's round end is a cylinder, its flank beside it a plane; a fillet does not make its face round", () => {
  const end = Array.from({ length: 13 }, (_, i) => -Math.PI / 2 + (i * Math.PI) / 12);
  const outline = [
    ...end.map(angle => [0.1 + 0.02 * Math.cos(angle), 0.02 * Math.sin(angle)] as const),
    ...end.map(angle => [-0.1 - 0.02 * Math.cos(angle), -0.02 * Math.sin(angle)] as const),
  ];
  const slot = extrudedMesh(outline, 0, 0.01);
  const tip = at(slot, [0.12, 0, 0.005], 0.001);
  expect(tip?.kind).toBe("cylinder");
  if (tip?.kind === "cylinder") {
    expect(tip.radius_m).toBeCloseTo(0.02, 6);
    expect(tip.center_m[0]).toBeCloseTo(0.1, 6);
  }
  const flank = at(slot, [0, 0.02, 0.005], 0.001);
  expect(flank?.kind).toBe("plane");
  expect(flank?.axis[1]).toBeCloseTo(1, 9);
});

test("boxes and balls have no axis: what is picked there is a plane; a mesh without triangles has nothing", () => {
  expect(at(boxMesh([0.2, 0.2, 0.2]), [0.1, 0.03, 0.02])).toEqual({
    kind: "plane",
    center_m: [0.1, 0.03, 0.02],
    axis: [1, 0, 0],
  });
  expect(at(sphereMesh(0.1, 48, 24), [0.1, 0, 0.003])?.kind).toBe("plane");
  expect(at({ positions: new Float64Array(0), indices: new Uint32Array(0) }, [0, 0, 0])).toBeUndefined();
});

test("in a part of several bodies the body that was pointed at answers", () => {
  const apart = pose([0.5, 0, 0], fromAxisAngle([1, 0, 0], Math.PI / 2)) as Pose;
  const both = mergeMeshes([{ mesh: cylinderMesh(0.03, 0.2, 32) }, { mesh: cylinderMesh(0.01, 0.1, 32), pose: apart }]);
  const found = at(both, [0.51, -0.03, 0]);
  expect(found?.kind === "cylinder" && found.radius_m).toBeCloseTo(0.01, 6);
  expect(found?.axis[1]).toBeCloseTo(1, 9);
});
