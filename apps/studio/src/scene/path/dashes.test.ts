import type { Vector3 } from "@twincell/core";
import { expect, test } from "vitest";
import { dashes, stations } from "./dashes.ts";

const corner: Vector3[] = [
  [0, 0, 0],
  [0.1, 0, 0],
  [0.1, 0.1, 0],
];
const drawn = (pieces: readonly number[]): number => {
  let sum = 0;
  for (let i = 0; i < pieces.length; i += 6)
    sum += Math.hypot(pieces[i + 3]! - pieces[i]!, pieces[i + 4]! - pieces[i + 1]!, pieces[i + 5]! - pieces[i + 2]!);
  return sum;
};

test("a solid line is the polyline itself", () => {
  const out: number[] = [];
  dashes(corner, [], out);
  expect(out).toEqual([0, 0, 0, 0.1, 0, 0, 0.1, 0, 0, 0.1, 0.1, 0]);
});

test("a dashed line draws its share and carries on around the corner", () => {
  const out: number[] = [];
  dashes(corner, [0.03, 0.01], out);
  expect(drawn(out)).toBeCloseTo(0.15, 9);
  expect(out.slice(12, 18).map(x => Math.round(x * 1e6) / 1e6)).toEqual([0.08, 0, 0, 0.1, 0, 0]); // the third dash begins before the corner
});

test("symbols stand at equal distances, and a short stretch has one", () => {
  const out: number[] = [];
  stations(corner, 0.05, out);
  expect(out.length / 3).toBe(4);
  const one: number[] = [];
  stations(
    [
      [0, 0, 0],
      [0.001, 0, 0],
    ],
    0.05,
    one,
  );
  expect(one.length / 3).toBe(1);
});
