import { Refusal } from "../refusal.ts";

/** A 4 × 4 matrix row by row; the last row is 0 0 0 1. */
export type Matrix4 = readonly number[];
export const UNMOVED: Matrix4 = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

export function times(a: Matrix4, b: Matrix4): Matrix4 {
  return Array.from({ length: 16 }, (_, i) =>
    [0, 1, 2, 3].reduce((sum, k) => sum + a[4 * (i >> 2) + k]! * b[4 * k + (i & 3)]!, 0),
  );
}
export const moved = (x: number, y: number, z: number): Matrix4 => [1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1];
export const scaled = (x: number, y: number, z: number): Matrix4 => [x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, 0, 0, 0, 1];

/** More corners than this are refused: instances of instances multiply. */
const MOST = 60_000_000;

/** Triangles of many parts, each set down by its own matrix. */
export class Soup {
  private readonly positions: number[] = [];
  private readonly indices: number[] = [];

  /** Adds a part; its winding is turned where its matrix mirrors. @param triangles  indices into `points`. */
  add(points: ArrayLike<number>, triangles: ArrayLike<number>, m: Matrix4): void {
    const first = this.positions.length / 3;
    if (this.positions.length + points.length > MOST || this.indices.length + triangles.length > MOST)
      throw new Refusal(`The parts of the file make more than ${MOST / 3} corners.`);
    for (let at = 0; at + 2 < points.length; at += 3) {
      const x = points[at]!;
      const y = points[at + 1]!;
      const z = points[at + 2]!;
      for (let r = 0; r < 3; r++)
        this.positions.push(m[4 * r]! * x + m[4 * r + 1]! * y + m[4 * r + 2]! * z + m[4 * r + 3]!);
    }
    const mirrored =
      m[0]! * (m[5]! * m[10]! - m[6]! * m[9]!) -
        m[1]! * (m[4]! * m[10]! - m[6]! * m[8]!) +
        m[2]! * (m[4]! * m[9]! - m[5]! * m[8]!) <
      0;
    for (let at = 0; at + 2 < triangles.length; at += 3) {
      this.indices.push(
        first + triangles[at]!,
        first + triangles[at + (mirrored ? 2 : 1)]!,
        first + triangles[at + (mirrored ? 1 : 2)]!,
      );
    }
  }
  mesh(): { readonly positions: Float64Array; readonly indices: Uint32Array } {
    if (this.indices.length === 0) throw new Refusal("The file holds no faces.");
    return { positions: Float64Array.from(this.positions), indices: Uint32Array.from(this.indices) };
  }
}

/** Strips and fans as triangles. @param corners  indices in the order of the file. */
export function triangleRun(kind: "strip" | "fan", corners: ArrayLike<number>): number[] {
  const indices: number[] = [];
  for (let i = 0; i + 2 < corners.length; i++) {
    if (kind === "fan") indices.push(corners[0]!, corners[i + 1]!, corners[i + 2]!);
    else indices.push(corners[i]!, corners[i + (i % 2 === 0 ? 1 : 2)]!, corners[i + (i % 2 === 0 ? 2 : 1)]!);
  }
  return indices;
}

/** “2 lines, 1 camera were passed over.” or nothing. */
export function passedOver(skipped: ReadonlyMap<string, number>): string[] {
  const list = [...skipped].map(([what, count]) => `${count} ${what}${count === 1 ? "" : "s"}`).join(", ");
  return list === "" ? [] : [`${list} passed over: only surfaces are read.`];
}
