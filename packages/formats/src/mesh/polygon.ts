import { triangulate, type Point2 } from "@twincell/core";

/** Faces with more corners than this are refused: cutting them takes time that grows with the square. */
export const MAX_CORNERS = 2000;

/** Adds a face to `indices` as triangles of the same winding. @param corners  three or more indices of vertices. */
export function addPolygon(corners: readonly number[], positions: ArrayLike<number>, indices: number[]): void {
  if (corners.length === 3) {
    indices.push(corners[0]!, corners[1]!, corners[2]!);
    return;
  }
  for (const corner of triangulate(flattened(corners, positions))) indices.push(corners[corner]!);
}

/** The face seen along its Newell normal, counter-clockwise: dropping the normal's largest axis keeps it simple. */
function flattened(corners: readonly number[], positions: ArrayLike<number>): Point2[] {
  const normal = [0, 0, 0];
  corners.forEach((corner, i) => {
    const next = corners[(i + 1) % corners.length]!;
    for (let k = 0; k < 3; k++) {
      const u = (k + 1) % 3;
      const v = (k + 2) % 3;
      normal[k]! +=
        positions[3 * corner + u]! * positions[3 * next + v]! - positions[3 * next + u]! * positions[3 * corner + v]!;
    }
  });
  const size = normal.map(Math.abs);
  const axis = size.indexOf(Math.max(...size));
  const u = (axis + 1) % 3;
  const v = (axis + 2) % 3;
  const forward = normal[axis]! >= 0;
  return corners.map(corner => {
    const [x, y] = [positions[3 * corner + u]!, positions[3 * corner + v]!];
    return forward ? [x, y] : [y, x];
  });
}
