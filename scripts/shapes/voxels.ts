// A link as little cubes: what is not reached from outside is solid, so that holes and doubled walls in a mesh do not
// matter.
import { meshBounds, type TriangleMesh } from "@twincell/core";

export interface Voxels {
  readonly pitch_m: number;
  /** Corner of cell 0, 0, 0 [m]. */
  readonly origin: readonly [number, number, number];
  readonly count: readonly [number, number, number];
  readonly solid: Uint8Array;
  /** Distance of every cell from the solid [cells]; 0 inside. */
  readonly away: Float32Array;
}

export function voxelsOf(mesh: TriangleMesh, pitch_m: number): Voxels {
  const { lower, upper } = meshBounds(mesh);
  const origin = [0, 1, 2].map(k => lower[k]! - 2 * pitch_m) as [number, number, number];
  const count = [0, 1, 2].map(k => Math.ceil((upper[k]! - lower[k]!) / pitch_m) + 5) as [number, number, number];
  const [nx, ny, nz] = count;
  const wall = new Uint8Array(nx * ny * nz);
  const p = mesh.positions;
  for (let t = 0; t < mesh.indices.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map(k => 3 * mesh.indices[t + k]!) as [number, number, number];
    const edge = (i: number, j: number): number =>
      Math.hypot(p[i]! - p[j]!, p[i + 1]! - p[j + 1]!, p[i + 2]! - p[j + 2]!);
    const steps = Math.max(1, Math.ceil(Math.max(edge(a, b), edge(b, c), edge(c, a)) / (0.45 * pitch_m)));
    for (let i = 0; i <= steps; i++)
      for (let j = 0; j <= steps - i; j++) {
        const u = i / steps;
        const v = j / steps;
        const w = 1 - u - v;
        const at = [0, 1, 2].map(k =>
          Math.floor((w * p[a + k]! + u * p[b + k]! + v * p[c + k]! - origin[k]!) / pitch_m),
        );
        wall[(at[0]! * ny + at[1]!) * nz + at[2]!] = 1;
      }
  }
  const solid = new Uint8Array(wall.length).fill(1);
  const queue = new Int32Array(wall.length);
  let head = 0;
  let tail = 0;
  const reach = (x: number, y: number, z: number): void => {
    if (x < 0 || y < 0 || z < 0 || x >= nx || y >= ny || z >= nz) return;
    const cell = (x * ny + y) * nz + z;
    if (wall[cell] === 1 || solid[cell] === 0) return;
    solid[cell] = 0;
    queue[tail++] = cell;
  };
  reach(0, 0, 0);
  while (head < tail) {
    const cell = queue[head++]!;
    const z = cell % nz;
    const y = ((cell - z) / nz) % ny;
    const x = ((cell - z) / nz - y) / ny;
    reach(x - 1, y, z);
    reach(x + 1, y, z);
    reach(x, y - 1, z);
    reach(x, y + 1, z);
    reach(x, y, z - 1);
    reach(x, y, z + 1);
  }
  return { pitch_m, origin, count, solid, away: distances(solid, count) };
}

/** Exact distance transform, one axis after the other (Felzenszwalb, Huttenlocher 2012). */
function distances(solid: Uint8Array, [nx, ny, nz]: readonly [number, number, number]): Float32Array {
  const far = 1e6;
  const d = Float32Array.from(solid, cell => (cell === 1 ? 0 : far));
  const longest = Math.max(nx, ny, nz);
  const f = new Float64Array(longest);
  const v = new Int32Array(longest);
  const z = new Float64Array(longest + 1);
  const line = (start: number, step: number, n: number): void => {
    for (let i = 0; i < n; i++) f[i] = d[start + i * step]!;
    let k = 0;
    v[0] = 0;
    z[0] = -Infinity;
    z[1] = Infinity;
    for (let q = 1; q < n; q++) {
      let s = 0;
      for (;;) {
        s = (f[q]! + q * q - (f[v[k]!]! + v[k]! * v[k]!)) / (2 * q - 2 * v[k]!);
        if (s > z[k]! || k === 0) break;
        k--;
      }
      if (s > z[k]!) k++;
      v[k] = q;
      z[k] = k === 0 ? -Infinity : s;
      z[k + 1] = Infinity;
    }
    k = 0;
    for (let q = 0; q < n; q++) {
      while (z[k + 1]! < q) k++;
      d[start + q * step] = (q - v[k]!) ** 2 + f[v[k]!]!;
    }
  };
  for (let x = 0; x < nx; x++) for (let y = 0; y < ny; y++) line((x * ny + y) * nz, 1, nz);
  for (let x = 0; x < nx; x++) for (let k = 0; k < nz; k++) line(x * ny * nz + k, nz, ny);
  for (let y = 0; y < ny; y++) for (let k = 0; k < nz; k++) line(y * nz + k, ny * nz, nx);
  return d.map(Math.sqrt);
}
