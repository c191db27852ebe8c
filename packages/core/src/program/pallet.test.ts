import { describe, expect, test } from "vitest";
import { palletCount, palletIndices, palletSlots, type Pallet } from "./pallet.ts";

const pallet: Pallet = {
  frame: "world",
  origin: { position: [1, 2, 3], quaternion: [1, 0, 0, 0] },
  rowEnd: [1.2, 2, 3],
  columnEnd: [1.1, 2.4, 3.02],
  rows: 3,
  columns: 3,
  layers: 1,
  layer_m: 0,
};
const places = (changes: Partial<Pallet> = {}): number[][] =>
  palletSlots({ ...pallet, ...changes }).map(({ position }) => position.map(x => Math.round(x * 1e9) / 1e9));
const order = (changes: Partial<Pallet>): string =>
  Array.from(palletIndices({ ...pallet, ...changes }), ({ row, column }) => `${row}${column}`).join(" ");

describe("pallet patterns", () => {
  test("M-54 nine places by three corner points, rows first; the corners are met and the skew is kept", () => {
    // biome-ignore format: table of numbers
    expect(places()).toEqual([
      [1, 2, 3], [1.1, 2, 3], [1.2, 2, 3],
      [1.05, 2.2, 3.01], [1.15, 2.2, 3.01], [1.25, 2.2, 3.01],
      [1.1, 2.4, 3.02], [1.2, 2.4, 3.02], [1.3, 2.4, 3.02],
    ]);
    expect(palletSlots(pallet).every(({ quaternion }) => quaternion.join() === "1,0,0,0")).toBe(true);
  });

  test("layers stack along z of the frame, upwards or downwards", () => {
    const two = places({ layers: 2, layer_m: -0.05 });
    expect(two.length).toBe(18);
    expect(two.slice(9)).toEqual(places().map(([x, y, z]) => [x, y, Math.round((z! - 0.05) * 1e9) / 1e9]));
  });

  test("shifted rows stand half a pitch further, with one place fewer, inside the corners", () => {
    const shifted = places({ interleave: "odd-rows-shifted" });
    expect(shifted.length).toBe(8);
    expect(palletCount({ ...pallet, interleave: "odd-rows-shifted" })).toBe(8);
    expect(shifted.slice(3, 5)).toEqual([
      [1.1, 2.2, 3.01],
      [1.2, 2.2, 3.01],
    ]);
  });

  test("the order is along rows or columns, with or without turning round", () => {
    expect(order({ rows: 2 })).toBe("00 01 02 10 11 12");
    expect(order({ rows: 2, order: "rows-zigzag" })).toBe("00 01 02 12 11 10");
    expect(order({ rows: 2, order: "columns" })).toBe("00 10 01 11 02 12");
    expect(order({ rows: 2, order: "columns-zigzag" })).toBe("00 10 11 01 02 12");
    expect(order({ order: "columns", interleave: "odd-rows-shifted" })).toBe("00 10 20 01 11 21 02 22");
  });

  test("a single row or place needs no corner", () => {
    expect(places({ rows: 1, columns: 1, columnEnd: [9, 9, 9], rowEnd: [9, 9, 9] })).toEqual([[1, 2, 3]]);
    expect(places({ rows: 1, columnEnd: [9, 9, 9] })).toEqual([
      [1, 2, 3],
      [1.1, 2, 3],
      [1.2, 2, 3],
    ]);
  });

  test("every order visits every place once", () => {
    for (const orders of ["rows", "columns", "rows-zigzag", "columns-zigzag"] as const) {
      for (const interleave of ["none", "odd-rows-shifted"] as const) {
        const each = { ...pallet, rows: 4, columns: 5, layers: 2, layer_m: 0.1, order: orders, interleave };
        expect(new Set(Array.from(palletIndices(each), index => JSON.stringify(index))).size).toBe(palletCount(each));
      }
    }
  });
});
