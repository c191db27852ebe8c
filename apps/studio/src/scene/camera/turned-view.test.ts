import { Vector3 } from "three";
import { expect, test } from "vitest";
import { turnedView } from "./turned-view.ts";

test("X-31 a stick that is held turns the view once round in 4 s, at the same distance, and never over the top", () => {
  const target = new Vector3(1, 0.5, 0);
  const eye = new Vector3(4, 1.5, 2);
  const start = eye.clone();
  const distance = eye.distanceTo(target);
  for (let i = 0; i < 200; i++) turnedView(eye, target, [1, 0], 0.01);
  expect(eye.x - target.x).toBeCloseTo(target.x - start.x, 9);
  expect(eye.y).toBeCloseTo(start.y, 9);
  for (let i = 0; i < 200; i++) turnedView(eye, target, [1, 0], 0.01);
  expect(eye.distanceTo(start)).toBeLessThan(1e-9);
  for (let i = 0; i < 1000; i++) turnedView(eye, target, [0, -1], 0.01);
  expect(eye.distanceTo(target)).toBeCloseTo(distance, 9);
  expect(Math.hypot(eye.x - target.x, eye.z - target.z)).toBeCloseTo(distance * Math.sin(0.1), 9);
});
