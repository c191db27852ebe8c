import { expect, test } from "vitest";
import {
  orientationPresetAxis,
  orientationPreset,
  alignToolAxis,
  angleBetween,
  degrees,
  dot,
  fromAxisAngle,
  multiply,
  nextOrientationPreset,
  pose,
  rotate,
  type Pose,
  type Quaternion,
  type Vector3,
} from "../index.ts";

const piece: Pose<"world", "object"> = pose([0.6, -0.2, 0.3], fromAxisAngle([0, 0, 1], 0.35));
const tilted: Pose<"world", "object"> = pose([0, 0, 0], fromAxisAngle([0.6, 0, 0.8], 0.9));
const between_deg = (a: Vector3, b: Vector3): number => degrees(Math.acos(Math.min(1, Math.max(-1, dot(a, b)))));
const sides: readonly Vector3[] = [
  [1, 0, 0],
  [0, 1, 0],
  [-1, 0, 0],
  [0, -1, 0],
];
const anyOrientation: Quaternion = fromAxisAngle([0.48, 0.6, 0.64], 1.3);

test("N-52 each aid holds the tool axis 45° to the top, 45° to its side and 90° to its edge, to 0.01°", () => {
  for (const object of [piece, tilted]) {
    for (const [index, side] of sides.entries()) {
      for (const near of [undefined, anyOrientation]) {
        const toolAxis = rotate(orientationPreset(object, index, near), [0, 0, 1]);
        const up = rotate(object.quaternion, [0, 0, 1]);
        const out = rotate(object.quaternion, side);
        const edge = rotate(object.quaternion, [-side[1], side[0], 0]);
        expect(Math.abs(between_deg(toolAxis, up) - 135)).toBeLessThan(0.01); // into the piece from above
        expect(Math.abs(between_deg(toolAxis, out) - 135)).toBeLessThan(0.01); // inward across the edge
        expect(Math.abs(between_deg(toolAxis, edge) - 90)).toBeLessThan(0.01);
        expect(between_deg(toolAxis, orientationPresetAxis(object, index))).toBeLessThan(1e-5);
      }
      expect(
        between_deg(
          rotate(orientationPreset(object, index), [1, 0, 0]),
          rotate(object.quaternion, [-side[1], side[0], 0]),
        ),
      ).toBeLessThan(1e-5);
    }
  }
});

test("N-31, N-35 aids are cycled forwards and backwards", () => {
  expect([0, 1, 2, 3].map(index => nextOrientationPreset(index, 1))).toEqual([1, 2, 3, 0]);
  expect([0, 1, 2, 3].map(index => nextOrientationPreset(index, -1))).toEqual([3, 0, 1, 2]);
});

test("the turn about the tool axis is the least one from the present orientation, also from the opposite direction", () => {
  const axis: Vector3 = [0, 0.6, -0.8];
  const aligned = alignToolAxis(anyOrientation, axis);
  const least = angleBetween(anyOrientation, aligned);
  expect(degrees(least)).toBeCloseTo(between_deg(rotate(anyOrientation, [0, 0, 1]), axis), 9);
  for (let spin = -3; spin <= 3; spin += 0.25) {
    const other: Quaternion = [0, 0, 0, 1];
    const about = fromAxisAngle(axis, spin);
    expect(angleBetween(anyOrientation, alignToolAxis(multiply(about, aligned), axis, other))).toBeGreaterThanOrEqual(
      least - 1e-9,
    );
  }
  expect(rotate(alignToolAxis([0, 0, 0, 1], [0, 0, -1]), [0, 0, 1])[2]).toBeCloseTo(-1, 12);
});
