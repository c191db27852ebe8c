// A small renderer for contact sheets: triangles, depth, one light. No browser needed.
import { deflateSync } from "node:zlib";

export interface Painted {
  readonly positions: Float64Array;
  readonly indices: Uint32Array;
  readonly rgb: readonly [number, number, number];
}

/** Parallel view of painted meshes from a direction (azimuth, elevation), filling a square of that many pixels. */
export function view(
  meshes: readonly Painted[],
  size: number,
  azimuth: number,
  elevation: number,
  span_m: number,
  centre: readonly [number, number, number],
): Uint8Array {
  const ss = 2;
  const n = size * ss;
  const depth = new Float32Array(n * n).fill(-1e9);
  const pixels = new Float32Array(n * n * 3).fill(0.93);
  const ca = Math.cos(azimuth);
  const sa = Math.sin(azimuth);
  const ce = Math.cos(elevation);
  const se = Math.sin(elevation);
  const right = [-sa, ca, 0];
  const towards = [ca * ce, sa * ce, se];
  const up = [-ca * se, -sa * se, ce];
  const dot = (a: readonly number[], x: number, y: number, z: number): number => a[0]! * x + a[1]! * y + a[2]! * z;
  const light = [
    0.5 * right[0]! + 0.5 * up[0]! + 0.7 * towards[0]!,
    0.5 * right[1]! + 0.5 * up[1]! + 0.7 * towards[1]!,
    0.5 * up[2]! + 0.7 * towards[2]!,
  ];
  for (const { positions: p, indices, rgb } of meshes) {
    for (let t = 0; t < indices.length; t += 3) {
      const c = [0, 1, 2].map(k => {
        const i = 3 * indices[t + k]!;
        const x = p[i]! - centre[0];
        const y = p[i + 1]! - centre[1];
        const z = p[i + 2]! - centre[2];
        return [
          (dot(right, x, y, z) / span_m + 0.5) * n,
          (0.5 - dot(up, x, y, z) / span_m) * n,
          dot(towards, x, y, z),
          x,
          y,
          z,
        ];
      });
      const [a, b, d] = c as [number[], number[], number[]];
      const e = [b[3]! - a[3]!, b[4]! - a[4]!, b[5]! - a[5]!];
      const f = [d[3]! - a[3]!, d[4]! - a[4]!, d[5]! - a[5]!];
      const nx = e[1]! * f[2]! - e[2]! * f[1]!;
      const ny = e[2]! * f[0]! - e[0]! * f[2]!;
      const nz = e[0]! * f[1]! - e[1]! * f[0]!;
      const len = Math.hypot(nx, ny, nz) || 1;
      const facing = dot(towards, nx, ny, nz) < 0 ? -1 : 1;
      const lit = Math.max(0, (facing * dot(light, nx, ny, nz)) / len);
      const shade = 0.3 + 0.7 * lit;
      const area = (b[0]! - a[0]!) * (d[1]! - a[1]!) - (b[1]! - a[1]!) * (d[0]! - a[0]!);
      if (Math.abs(area) < 1e-9) continue;
      const x0 = Math.max(0, Math.floor(Math.min(a[0]!, b[0]!, d[0]!)));
      const x1 = Math.min(n - 1, Math.ceil(Math.max(a[0]!, b[0]!, d[0]!)));
      const y0 = Math.max(0, Math.floor(Math.min(a[1]!, b[1]!, d[1]!)));
      const y1 = Math.min(n - 1, Math.ceil(Math.max(a[1]!, b[1]!, d[1]!)));
      for (let y = y0; y <= y1; y++)
        for (let x = x0; x <= x1; x++) {
          const px = x + 0.5;
          const py = y + 0.5;
          const w1 = ((px - a[0]!) * (d[1]! - a[1]!) - (py - a[1]!) * (d[0]! - a[0]!)) / area;
          const w2 = ((b[0]! - a[0]!) * (py - a[1]!) - (b[1]! - a[1]!) * (px - a[0]!)) / area;
          if (w1 < 0 || w2 < 0 || w1 + w2 > 1) continue;
          const z = a[2]! + w1 * (b[2]! - a[2]!) + w2 * (d[2]! - a[2]!);
          const at = y * n + x;
          if (z <= depth[at]!) continue;
          depth[at] = z;
          for (let k = 0; k < 3; k++) pixels[3 * at + k] = rgb[k]! * shade;
        }
    }
  }
  const out = new Uint8Array(size * size * 3);
  for (let y = 0; y < size; y++)
    for (let x = 0; x < size; x++)
      for (let k = 0; k < 3; k++) {
        let sum = 0;
        for (let j = 0; j < ss; j++)
          for (let i = 0; i < ss; i++) sum += pixels[3 * ((y * ss + j) * n + x * ss + i) + k]!;
        out[3 * (y * size + x) + k] = Math.min(255, 255 * Math.sqrt(Math.max(0, sum / ss / ss)));
      }
  return out;
}

/** Square pictures in rows, as a PNG. */
export function sheet(rows: readonly (readonly Uint8Array[])[], size: number): Uint8Array {
  const width = size * Math.max(...rows.map(row => row.length));
  const height = size * rows.length;
  const raw = new Uint8Array((3 * width + 1) * height).fill(255);
  for (let y = 0; y < height; y++) raw[y * (3 * width + 1)] = 0;
  rows.forEach((row, j) => {
    row.forEach((tile, i) => {
      for (let y = 0; y < size; y++)
        raw.set(tile.subarray(3 * size * y, 3 * size * (y + 1)), (j * size + y) * (3 * width + 1) + 1 + 3 * size * i);
    });
  });
  const chunk = (name: string, data: Uint8Array): Uint8Array => {
    const out = new Uint8Array(12 + data.length);
    const v = new DataView(out.buffer);
    v.setUint32(0, data.length);
    out.set(new TextEncoder().encode(name), 4);
    out.set(data, 8);
    v.setUint32(8 + data.length, crc(out.subarray(4, 8 + data.length)));
    return out;
  };
  const head = new Uint8Array(13);
  const v = new DataView(head.buffer);
  v.setUint32(0, width);
  v.setUint32(4, height);
  head.set([8, 2, 0, 0, 0], 8);
  return Buffer.concat([
    Uint8Array.of(137, 80, 78, 71, 13, 10, 26, 10),
    chunk("IHDR", head),
    chunk("IDAT", deflateSync(raw)),
    chunk("IEND", new Uint8Array()),
  ]);
}

function crc(bytes: Uint8Array): number {
  let c = ~0;
  for (const byte of bytes) {
    c ^= byte;
    for (let k = 0; k < 8; k++) c = c & 1 ? (c >>> 1) ^ 0xedb88320 : c >>> 1;
  }
  return ~c >>> 0;
}
