import {
  fromAxisAngle,
  pose,
  rotate,
  transformPoint,
  inverse,
  type Pose,
  type SurfaceFeature,
  type Vector3,
} from "@twincell/core";
import fc from "fast-check";
import { expect, test } from "vitest";
import { matedPose, type MateOptions } from "./mate.ts";

const number = fc.double({ min: -2, max: 2, noNaN: true });
const direction = fc
  .tuple(number, number, number)
  .filter(v => Math.hypot(...v) > 0.1)
  .map(v => v.map(value => value / Math.hypot(...v)) as Vector3);
const point = fc.tuple(number, number, number).map(v => [...v] as Vector3);
const standing = fc
  .tuple(point, direction, number)
  .map(([at, axis, turn]) => pose<"world", "object">(at, fromAxisAngle(axis, turn)));
/** Where a feature of an object is after the object moved. */
const carried = (feature: SurfaceFeature, before: Pose, after: Pose): SurfaceFeature => ({
  ...feature,
  center_m: transformPoint(after, transformPoint(inverse(before), feature.center_m)),
  axis: rotate(after.quaternion, rotate(inverse(before).quaternion, feature.axis)),
});
const mated = (object: Pose<"world", "object">, a: SurfaceFeature, b: SurfaceFeature, options?: MateOptions) => {
  const answer = matedPose(object, a, b, options);
  if (answer.kind !== "mated") throw new Error(answer.kind);
  return carried(a, object as Pose, answer.worldFromObject as Pose);
};
const along = (a: SurfaceFeature, b: SurfaceFeature): number =>
  a.center_m.reduce((sum, value, k) => sum + (value - b.center_m[k]!) * b.axis[k]!, 0);
const cosine = (a: SurfaceFeature, b: SurfaceFeature): number =>
  a.axis.reduce((sum, value, k) => sum + value * b.axis[k]!, 0);
const away = (a: SurfaceFeature, b: SurfaceFeature): number =>
  Math.hypot(...a.center_m.map((value, k) => value - b.center_m[k]! - along(a, b) * b.axis[k]!));

test("faces come to look at each other with the picked points together, or the same way when flipped, as far apart as asked", () => {
  fc.assert(
    fc.property(standing, point, direction, point, direction, number, (object, at, n, to, m, offset_m) => {
      const fixed: SurfaceFeature = { kind: "plane", center_m: to, axis: m };
      const facing = mated(object, { kind: "plane", center_m: at, axis: n }, fixed, { offset_m });
      expect(cosine(facing, fixed)).toBeCloseTo(-1, 9);
      expect(along(facing, fixed)).toBeCloseTo(offset_m, 9);
      expect(away(facing, fixed)).toBeLessThan(1e-9);
      const flush = mated(object, { kind: "plane", center_m: at, axis: n }, fixed, { flipped: true });
      expect(cosine(flush, fixed)).toBeCloseTo(1, 9);
      expect(along(flush, fixed)).toBeCloseTo(0, 9);
    }),
    { seed: 5, numRuns: 100 },
  );
});

test("axes come to lie on one line by the smaller turn; along it the object stays; two rims also meet", () => {
  fc.assert(
    fc.property(standing, point, direction, point, direction, (object, at, n, to, m) => {
      const shaft: SurfaceFeature = {
        kind: "cylinder",
        center_m: at,
        axis: n,
        radius_m: 0.01,
        length_m: 1,
        inside: false,
      };
      const bore: SurfaceFeature = { ...shaft, center_m: to, axis: m, inside: true };
      const before = along(shaft, bore);
      const inside = mated(object, shaft, bore);
      expect(away(inside, bore)).toBeLessThan(1e-9);
      expect(along(inside, bore)).toBeCloseTo(before, 9);
      expect(Math.sign(cosine(inside, bore))).toBe(cosine(shaft, bore) < 0 ? -1 : 1);
      expect(Math.abs(cosine(inside, bore))).toBeCloseTo(1, 9);
      const rim: SurfaceFeature = { kind: "circle", center_m: at, axis: n, radius_m: 0.01 };
      const other: SurfaceFeature = { ...rim, center_m: to, axis: m };
      const met = mated(object, rim, other, { offset_m: 0.02 });
      expect(away(met, other)).toBeLessThan(1e-9);
      expect(along(met, other)).toBeCloseTo(0.02, 9);
    }),
    { seed: 6, numRuns: 100 },
  );
});

test("a face and an axis do not mate", () => {
  const plane: SurfaceFeature = { kind: "plane", center_m: [0, 0, 0], axis: [0, 0, 1] };
  const rim: SurfaceFeature = { kind: "circle", center_m: [0, 0, 0], axis: [0, 0, 1], radius_m: 0.1 };
  expect(matedPose(pose(), plane, rim).kind).toBe("no-mate");
});
