import type { PathPiece, Vector3 } from "@twincell/core";
import { expect, test } from "vitest";
import { pathUnder } from "./path-under.ts";

const piece = (step: string, from_s: number, to_s: number, ...points: Vector3[]): PathPiece => ({
  step,
  verdict: "ok",
  from_s,
  to_s,
  points,
});
const path = [
  piece("a", 0, 2, [0, 0, 1], [1, 0, 1], [2, 0, 1]),
  piece("b", 2, 4, [2, 0, 1], [2, 2, 1]),
  piece("lost", 4, 4, [2, 2, 1], [5, 2, 1]),
];
const down = (x: number, y: number) => ({ origin: [x, y, 3] as Vector3, direction: [0, 0, -1] as Vector3 });

test("the step and the moment of the path under the pointer; none where the path is further off than the tolerance", () => {
  expect(pathUnder(path, down(0.5, 0.01), 0.02)).toEqual({ step: "a", at_s: 0.5 });
  expect(pathUnder(path, down(2.01, 1), 0.02)).toEqual({ step: "b", at_s: 3 });
  expect(pathUnder(path, down(4, 2), 0.02)).toEqual({ step: "lost", at_s: 4 });
  expect(pathUnder(path, down(0.5, 0.1), 0.02)).toBeUndefined();
});

test("what lies behind the eye is not under the pointer", () => {
  expect(pathUnder(path, { origin: [0.5, 0, 0], direction: [0, 0, -1] }, 0.1)).toBeUndefined();
});
