/**
 * Squared distance of a point from a triangle [m²]: the distance of the plane where the foot of the point is inside,
 * else that of the nearest side.
 *
 * @param limit  a squared distance; a triangle whose plane is not nearer is answered with Infinity.
 */
export function triangleDistanceOfPoint(
  positions: ArrayLike<number>,
  corners: readonly [number, number, number],
  [px, py, pz]: readonly [number, number, number],
  limit: number,
): number {
  const [a, b, c] = corners.map(vertex => 3 * vertex) as [number, number, number];
  const ux = positions[b]! - positions[a]!;
  const uy = positions[b + 1]! - positions[a + 1]!;
  const uz = positions[b + 2]! - positions[a + 2]!;
  const vx = positions[c]! - positions[a]!;
  const vy = positions[c + 1]! - positions[a + 1]!;
  const vz = positions[c + 2]! - positions[a + 2]!;
  const nx = uy * vz - uz * vy;
  const ny = uz * vx - ux * vz;
  const nz = ux * vy - uy * vx;
  const nn = nx * nx + ny * ny + nz * nz;
  if (nn === 0) return Infinity;
  const wx = px - positions[a]!;
  const wy = py - positions[a + 1]!;
  const wz = pz - positions[a + 2]!;
  const height = wx * nx + wy * ny + wz * nz;
  const plane = (height * height) / nn;
  if (plane >= limit) return Infinity;
  // Barycentric coordinates of the foot: |n|² times the shares of the corners b and c.
  const shareB = (wy * vz - wz * vy) * nx + (wz * vx - wx * vz) * ny + (wx * vy - wy * vx) * nz;
  const shareC = (uy * wz - uz * wy) * nx + (uz * wx - ux * wz) * ny + (ux * wy - uy * wx) * nz;
  if (shareB >= 0 && shareC >= 0 && shareB + shareC <= nn) return plane;
  return Math.min(
    side(positions, a, b, px, py, pz),
    side(positions, b, c, px, py, pz),
    side(positions, c, a, px, py, pz),
  );
}

function side(p: ArrayLike<number>, a: number, b: number, px: number, py: number, pz: number): number {
  const ux = p[b]! - p[a]!;
  const uy = p[b + 1]! - p[a + 1]!;
  const uz = p[b + 2]! - p[a + 2]!;
  const wx = px - p[a]!;
  const wy = py - p[a + 1]!;
  const wz = pz - p[a + 2]!;
  const length2 = ux * ux + uy * uy + uz * uz;
  const t = length2 === 0 ? 0 : Math.min(1, Math.max(0, (wx * ux + wy * uy + wz * uz) / length2));
  return (wx - t * ux) ** 2 + (wy - t * uy) ** 2 + (wz - t * uz) ** 2;
}
