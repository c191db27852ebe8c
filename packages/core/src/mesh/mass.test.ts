import { expect, test } from "vitest";
import { boxMesh, fromAxisAngle, massProperties, pose, sphereMesh, torusMesh, transformMesh } from "../index.ts";

test("a box away from the origin weighs and turns as the formulas say", () => {
  const {
    volume_m3: v,
    center_m,
    inertia_m5,
  } = massProperties(transformMesh(boxMesh([0.2, 0.3, 0.5]), pose([1, -2, 0.5])));
  expect(v).toBeCloseTo(0.03, 12);
  [1, -2, 0.5].forEach((value, k) => {
    expect(center_m[k]).toBeCloseTo(value, 10);
  });
  [(v * (0.09 + 0.25)) / 12, (v * (0.04 + 0.25)) / 12, (v * (0.04 + 0.09)) / 12, 0, 0, 0].forEach((value, k) => {
    expect(inertia_m5[k]).toBeCloseTo(value, 10);
  });
});

test("turned by 45° about z, a slab has a product of inertia with the sign of the matrix", () => {
  const { volume_m3: v, inertia_m5 } = massProperties(
    transformMesh(boxMesh([1, 0.2, 0.1]), pose([0, 0, 0], fromAxisAngle([0, 0, 1], Math.PI / 4))),
  );
  const along = (v * (0.04 + 0.01)) / 12;
  const across = (v * (1 + 0.01)) / 12;
  expect(inertia_m5[0]).toBeCloseTo((along + across) / 2, 10);
  expect(inertia_m5[3]).toBeCloseTo((along - across) / 2, 10);
});

test("round solids come near theirs from below, and a flat sheet weighs nothing", () => {
  const ball = massProperties(sphereMesh(1, 96, 48));
  const torus = massProperties(torusMesh(1, 0.2, 96, 48));
  expect(ball.volume_m3 / ((4 / 3) * Math.PI)).toBeGreaterThan(0.995);
  expect(ball.inertia_m5[2] / ((8 / 15) * Math.PI)).toBeGreaterThan(0.99);
  expect(torus.volume_m3 / (2 * Math.PI ** 2 * 0.04)).toBeGreaterThan(0.99);
  expect(
    massProperties({ positions: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0), indices: Uint32Array.of(0, 1, 2) })
      .volume_m3,
  ).toBe(0);
});
