import { expect, test } from "vitest";
import {
  boxMesh,
  mergeMeshes,
  pose,
  seededRandom,
  shapeDeviation,
  sphereMesh,
  transformMesh,
  type TriangleMesh,
} from "../index.ts";

const measured = (
  drawn: readonly TriangleMesh[],
  truth: TriangleMesh,
): { readonly trueOutsideDrawn_m: number; readonly drawnOutsideTrue_m: number } =>
  shapeDeviation(drawn, truth, 4000, seededRandom(4));

test("a ball in a box: the corners stand out by (√3 − 1) r, the ball nowhere", () => {
  const ball = sphereMesh(0.1, 64, 32);
  const box = boxMesh([0.2, 0.2, 0.2]);
  const found = measured([box], ball);
  expect(found.trueOutsideDrawn_m).toBeLessThan(1e-6);
  expect(found.drawnOutsideTrue_m).toBeGreaterThan(0.065);
  expect(found.drawnOutsideTrue_m).toBeLessThanOrEqual(0.1 * (Math.sqrt(3) - 1) + 1e-3);
  expect(measured([ball], box).trueOutsideDrawn_m).toBeCloseTo(found.drawnOutsideTrue_m, 2);
});

test("a part that was forgotten, and one too many, are found with their distance", () => {
  const box = boxMesh([0.2, 0.2, 0.2]);
  const aside = transformMesh(boxMesh([0.02, 0.02, 0.02]), pose([0.2, 0, 0]));
  expect(measured([box], mergeMeshes([{ mesh: box }, { mesh: aside }])).trueOutsideDrawn_m).toBeCloseTo(0.11, 2);
  expect(measured([box, aside], box).drawnOutsideTrue_m).toBeCloseTo(0.11, 2);
});

test("solids that overlap count as one, on either side, and an opening is closed", () => {
  const left = transformMesh(boxMesh([0.2, 0.1, 0.1]), pose([-0.05, 0, 0]));
  const right = transformMesh(boxMesh([0.2, 0.1, 0.1]), pose([0.05, 0, 0]));
  const whole = boxMesh([0.3, 0.1, 0.1]);
  const both = mergeMeshes([{ mesh: left }, { mesh: right }]);
  for (const found of [measured([left, right], whole), measured([whole], both)]) {
    expect(found.trueOutsideDrawn_m).toBeLessThan(1e-6);
    expect(found.drawnOutsideTrue_m).toBeLessThan(1e-6);
  }
  const open: TriangleMesh = { positions: whole.positions, indices: whole.indices.slice(6) };
  expect(measured([whole], open).drawnOutsideTrue_m).toBeLessThan(1e-6);
});
