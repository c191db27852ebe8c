import { expect, test } from "vitest";
import { boxMesh, meshBounds, transformMesh, type Vector3 } from "@twincell/core";
import {
  emptyCell,
  openDocument,
  placeParts,
  rescaledObjects,
  importedFrom,
  withObjects,
  saveDocument,
  shapeMesh,
  type CellDocument,
} from "./index.ts";

const part = (name: string, size: Vector3, at: Vector3) => ({
  name,
  color: "#336699",
  mesh: transformMesh(boxMesh(size), { position: at, quaternion: [0, 0, 0, 1] }),
});
const cellOf = (parts: readonly ReturnType<typeof part>[]): CellDocument => ({
  ...emptyCell(),
  objects: placeParts(parts, "jig.step", new Set(["base"])),
});
const sizeOf = (cell: CellDocument, i: number): readonly number[] => {
  const { lower, upper } = meshBounds(shapeMesh(cell.objects[i]!.shape));
  return upper.map((value, k) => value - lower[k]!);
};

test("parts stand on the floor as in the file, keep names and colours, and get ids of their own", () => {
  const cell = cellOf([part("base", [0.4, 0.2, 0.1], [5, 5, 5]), part("base", [0.1, 0.1, 0.1], [5.1, 5, 5.1])]);
  expect(cell.objects.map(({ id, color }) => [id, color])).toEqual([
    ["base 2", "#336699"],
    ["base 3", "#336699"],
  ]);
  const [a, b] = cell.objects.map(object => object.worldFromObject.position);
  expect(a![2]).toBeCloseTo(0, 9);
  [0.1, 0, 0.1].forEach((step, k) => expect(b![k]! - a![k]!).toBeCloseTo(step, 9));
  expect(openDocument(saveDocument(cell)).kind).toBe("opened");
});

test("a unit that was taken wrongly is put right afterwards: sizes and distances of all parts of the file times 1000", () => {
  const small = cellOf([
    part("a", [0.012, 0.01, 0.003], [0, 0, 0]),
    part("b", [0.001, 0.001, 0.001], [0.004, 0, 0.002]),
  ]);
  const right = withObjects(small, rescaledObjects(importedFrom(small, "jig.step"), 1000));
  [12, 10, 3].forEach((side, k) => expect(sizeOf(right, 0)[k]).toBeCloseTo(side, 4));
  const gap = (cell: CellDocument): number =>
    cell.objects[1]!.worldFromObject.position[2] - cell.objects[0]!.worldFromObject.position[2];
  expect(gap(right)).toBeCloseTo(1000 * gap(small), 6);
  expect(Math.min(...right.objects.map(object => object.worldFromObject.position[2]))).toBeCloseTo(0, 9);
  expect(importedFrom(small, "other.stl")).toEqual([]);
});
