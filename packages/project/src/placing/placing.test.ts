import { compose, fromAxisAngle, inverse, pose, posesAgree, rotate, type Pose, type Vector3 } from "@twincell/core";
import fc from "fast-check";
import { expect, test } from "vitest";
import type { ObjectRecord } from "../document.ts";
import { aligned, circularPattern, linearPattern, mirrored, movedWith, scaledShape } from "./arrange.ts";
import { boundsOfAll, shapeBounds, worldBounds } from "./bounds.ts";
import { clearanceBetween, measured } from "./measure.ts";
import { snapBox, toGrid } from "./snap.ts";

const number = fc.double({ min: -3, max: 3, noNaN: true });
const anyPose = fc
  .tuple(number, number, number, number, number, number)
  .map(([x, y, z, a, b, c]) => pose<"world", "object">([x, y, z], fromAxisAngle(unit([a, b, c + 0.1]), a + b + c)));
const unit = (v: Vector3): Vector3 => {
  const size = Math.hypot(...v);
  return size < 1e-6 ? [0, 0, 1] : [v[0] / size, v[1] / size, v[2] / size];
};
const box = (id: string, at: Vector3, size_m: Vector3 = [0.2, 0.4, 0.6]): ObjectRecord => ({
  id,
  name: id,
  role: "furniture",
  worldFromObject: pose(at),
  shape: { kind: "box", size_m },
  color: "#888888",
});

test("what is moved with a pivot keeps its pose relative to it", () => {
  fc.assert(
    fc.property(anyPose, anyPose, anyPose, (object, a, b) => {
      const before = a as Pose as Pose<"world", "pivot">;
      const after = b as Pose as Pose<"world", "pivot">;
      const moved = movedWith(object, before, after);
      expect(posesAgree(compose(inverse(after), moved), compose(inverse(before), object), 1e-9, 1e-9)).toBe(true);
    }),
    { seed: 7, numRuns: 200 },
  );
});

test("a box 4 mm above the floor and 3 mm beside a table comes to lie on the floor, flush with the table; along an axis that is not asked for it stays", () => {
  const table = { name: "Table", bounds: worldBounds(box("t", [1, 0, 0.5]).shape, pose([1, 0, 0.5])) };
  const at: Vector3 = [0.797, 0.123, 0.304];
  const moved = box("b", at);
  const { add_m, snapped } = snapBox(at, worldBounds(moved.shape, moved.worldFromObject), {
    axes: [0, 2],
    grid_m: 0.05,
    tolerance_m: 0.01,
    targets: [table],
  });
  expect(add_m[0]).toBeCloseTo(0.003, 9);
  expect(add_m[1]).toBe(0);
  expect(add_m[2]).toBeCloseTo(-0.004, 9);
  expect(snapped.map(({ axis, kind, name }) => [axis, kind, name])).toEqual([
    [0, "face", "Table"],
    [2, "floor", ""],
  ]);
});

test("where nothing is near, the grid counts; farther than the tolerance nothing attracts", () => {
  const at: Vector3 = [0.512, -0.237, 2];
  const moved = box("b", at);
  const bounds = worldBounds(moved.shape, moved.worldFromObject);
  const options = { axes: [0, 1] as const, tolerance_m: 0.01, targets: [] };
  const grid = snapBox(at, bounds, { ...options, grid_m: 0.05 });
  expect(at[0] + grid.add_m[0]).toBeCloseTo(0.5, 9);
  expect(at[1] + grid.add_m[1]).toBeCloseTo(-0.25, 9);
  expect(snapBox(at, bounds, { ...options, grid_m: 0 })).toEqual({ add_m: [0, 0, 0], snapped: [] });
  expect(toGrid(0.123, 0)).toBe(0.123);
});

test("a box along the world's axes holds every corner of a turned one", () => {
  const turned = pose<"world", "object">([1, 2, 3], fromAxisAngle([0, 0, 1], Math.PI / 4));
  const { lower, upper } = worldBounds({ kind: "box", size_m: [1, 1, 1] }, turned);
  expect(upper[0] - lower[0]).toBeCloseTo(Math.SQRT2, 9);
  expect(upper[2] - lower[2]).toBeCloseTo(1, 9);
  expect(boundsOfAll([])).toBeUndefined();
  expect(boundsOfAll([box("a", [0, 0, 0]), box("b", [2, 0, 0])])!.upper[0]).toBeCloseTo(2.1, 9);
});

test("three boxes are flush with the first at their lower faces; the first does not move", () => {
  const all = [box("a", [0, 0, 0.3]), box("b", [1, 0.2, 0.1], [1, 1, 0.2]), box("c", [2, -3, 2], [0.1, 0.1, 0.1])];
  const after = aligned(all, 2, "lower");
  for (const object of after) expect(worldBounds(object.shape, object.worldFromObject).lower[2]).toBeCloseTo(0, 9);
  expect(after[0]).toBe(all[0]);
  for (const object of aligned(all, 1, "middle")) expect(object.worldFromObject.position[1]).toBeCloseTo(0, 9);
});

test("mirrored twice an object stands where it stood; a point of its x–z plane goes to its mirror image", () => {
  fc.assert(
    fc.property(anyPose, fc.constantFrom(0, 1, 2), number, (object, axis, at_m) => {
      const once = mirrored(object, axis as 0 | 1 | 2, at_m);
      expect(posesAgree(mirrored(once, axis as 0 | 1 | 2, at_m), object, 1e-9, 1e-7)).toBe(true);
      const there = (of: Pose<"world", "object">): Vector3 => {
        const out = rotate(of.quaternion, [0.3, 0, 0.7]);
        return [out[0] + of.position[0], out[1] + of.position[1], out[2] + of.position[2]];
      };
      const before = there(object);
      before[axis] = 2 * at_m - before[axis]!;
      there(once).forEach((value, k) => expect(value).toBeCloseTo(before[k]!, 9));
    }),
    { seed: 11, numRuns: 200 },
  );
});

test("patterns: five in a row 100 mm apart; six on a circle, each turned by 60° towards the middle", () => {
  const row = linearPattern(pose([1, 2, 3]), 5, [0.1, 0, 0]);
  expect(row.map(({ position }) => Number(position[0].toFixed(9)))).toEqual([1, 1.1, 1.2, 1.3, 1.4]);
  const circle = circularPattern(pose([1, 0, 0.5]), 6, [0, 0], Math.PI / 3);
  expect(circle).toHaveLength(6);
  for (const each of circle) {
    expect(Math.hypot(each.position[0], each.position[1])).toBeCloseTo(1, 9);
    const outward = rotate(each.quaternion, [1, 0, 0]);
    expect(outward[0]).toBeCloseTo(each.position[0], 9);
    expect(each.position[2]).toBe(0.5);
  }
});

test("a scaled shape is as many times as long: box, cylinder, revolved and mesh", () => {
  expect(scaledShape({ kind: "box", size_m: [1, 2, 3] }, [2, 3, 4])).toEqual({ kind: "box", size_m: [2, 6, 12] });
  expect(scaledShape({ kind: "cylinder", radius_m: 1, height_m: 2 }, [2, 2, 0.5])).toEqual({
    kind: "cylinder",
    radius_m: 2,
    height_m: 1,
  });
  const cone = scaledShape(
    {
      kind: "revolved",
      profile_m: [
        [0.1, 0],
        [0.2, 1],
      ],
    },
    [2, 2, 3],
  );
  expect(shapeBounds(cone).upper[2]).toBeCloseTo(3, 9);
});

test("distance, its share along every axis, and the angle of two faces", () => {
  const { distance_m, delta_m, angle_rad } = measured(
    { at_m: [1, 2, 3], normal: [0, 0, 1] },
    { at_m: [1.3, 2, 2.6], normal: [1, 0, 0] },
  );
  expect(distance_m).toBeCloseTo(0.5, 9);
  expect(delta_m.map(value => Number(value.toFixed(9)))).toEqual([0.3, 0, -0.4]);
  expect(angle_rad).toBeCloseTo(Math.PI / 2, 9);
  expect(measured({ at_m: [0, 0, 0] }, { at_m: [0, 0, 0] }).angle_rad).toBeNull();
});

test("M-07 two parts 50 mm apart are that far apart; pushed into one another, or one inside the other, they interfere", () => {
  const a = box("a", [0, 0, 0]);
  const apart = clearanceBetween(a, box("b", [0.25, 0, 0]));
  expect(apart.distance_m).toBeCloseTo(0.05, 9);
  expect(apart.from_m[0]).toBeCloseTo(0.1, 9);
  expect(apart.to_m[0]).toBeCloseTo(0.15, 9);
  expect(clearanceBetween(a, box("b", [0.19, 0.1, 0.1])).distance_m).toBe(0);
  expect(clearanceBetween(a, box("b", [0, 0, 0], [0.01, 0.01, 0.01])).distance_m).toBe(0);
});
