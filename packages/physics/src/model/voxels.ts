import { buildSolid, meshBounds, pairScratch, pointInside, type TriangleMesh, type Vector3 } from "@twincell/core";

export interface Cuboid {
  readonly center_m: Vector3;
  readonly size_m: Vector3;
}

/**
 * A concave mesh as boxes: cells of a grid whose middle lies inside, put together along x, then y, then z where rows
 * are equal. No hull closes a hole (row L-72); the surface is met to half a cell.
 *
 * @param cells  along the longest side.
 */
export function voxelBoxes(
  mesh: TriangleMesh,
  cells: number,
): { readonly boxes: readonly Cuboid[]; readonly cell_m: number } {
  const { lower, upper } = meshBounds(mesh);
  const solid = buildSolid(mesh);
  const scratch = pairScratch();
  const extent = [upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]];
  const cell_m = Math.max(...extent) / cells;
  const counts = extent.map(length => Math.max(1, Math.round(length / cell_m)));
  const size = extent.map((length, k) => length / counts[k]!);
  const [nx, ny, nz] = counts as [number, number, number];
  const filled = new Uint8Array(nx * ny * nz);
  const at = (x: number, y: number, z: number): number => x + nx * (y + ny * z);
  for (let z = 0; z < nz; z++)
    for (let y = 0; y < ny; y++)
      for (let x = 0; x < nx; x++) {
        filled[at(x, y, z)] = pointInside(
          solid,
          lower[0] + (x + 0.5) * size[0]!,
          lower[1] + (y + 0.5) * size[1]!,
          lower[2] + (z + 0.5) * size[2]!,
          scratch,
        )
          ? 1
          : 0;
      }
  const boxes: Cuboid[] = [];
  for (let z = 0; z < nz; z++)
    for (let y = 0; y < ny; y++)
      for (let x = 0; x < nx; x++) {
        if (filled[at(x, y, z)] === 0) continue;
        let dx = 1;
        let dy = 1;
        let dz = 1;
        const full = (toX: number, toY: number, toZ: number): boolean => {
          for (let k = z; k < z + toZ; k++)
            for (let j = y; j < y + toY; j++)
              for (let i = x; i < x + toX; i++) if (filled[at(i, j, k)] === 0) return false;
          return true;
        };
        while (x + dx < nx && full(dx + 1, dy, dz)) dx++;
        while (y + dy < ny && full(dx, dy + 1, dz)) dy++;
        while (z + dz < nz && full(dx, dy, dz + 1)) dz++;
        for (let k = z; k < z + dz; k++) for (let j = y; j < y + dy; j++) filled.fill(0, at(x, j, k), at(x + dx, j, k));
        boxes.push({
          center_m: [
            lower[0] + (x + dx / 2) * size[0]!,
            lower[1] + (y + dy / 2) * size[1]!,
            lower[2] + (z + dz / 2) * size[2]!,
          ],
          size_m: [dx * size[0]!, dy * size[1]!, dz * size[2]!],
        });
      }
  return { boxes, cell_m };
}
