import { doubleArea, triangulate, type Point2 } from "@twincell/core";

/** Corners nearer to a straight line than this count as lying on it [m²]. */
const FLAT_M2 = 1e-12;

const turn = (a: Point2, b: Point2, c: Point2): number => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);

/** Whether a counter-clockwise outline has no corner that points inwards. */
export const isConvex = (outline: readonly Point2[]): boolean =>
  outline.every((a, i) => turn(a, outline[(i + 1) % outline.length]!, outline[(i + 2) % outline.length]!) >= -FLAT_M2);

/**
 * A simple outline cut into convex pieces: its triangles, put together again wherever two that share an edge stay
 * convex. Not always the least number of pieces; at most four times as many.
 *
 * @see Hertel, Mehlhorn, Fast triangulation of simple polygons, FCT 1983.
 */
export function convexPieces(outline: readonly Point2[]): Point2[][] {
  const cut = triangulate(outline);
  const pieces: number[][] = [];
  for (let t = 0; t < cut.length; t += 3) {
    const piece = [cut[t]!, cut[t + 1]!, cut[t + 2]!];
    if (Math.abs(doubleArea(piece.map(i => outline[i]!))) > FLAT_M2) pieces.push(piece);
  }
  for (let merged = true; merged; ) {
    merged = false;
    for (let i = 0; i < pieces.length && !merged; i++)
      for (let j = i + 1; j < pieces.length && !merged; j++) {
        const union = joined(pieces[i]!, pieces[j]!);
        if (union === undefined || !isConvex(union.map(k => outline[k]!))) continue;
        pieces[i] = union;
        pieces.splice(j, 1);
        merged = true;
      }
  }
  return pieces.map(piece => piece.map(i => outline[i]!));
}

/** Two counter-clockwise rings of corners joined along the edge they share. */
function joined(a: readonly number[], b: readonly number[]): number[] | undefined {
  for (let i = 0; i < a.length; i++) {
    const from = a[i]!;
    const to = a[(i + 1) % a.length]!;
    const j = b.findIndex((corner, k) => corner === to && b[(k + 1) % b.length] === from);
    if (j < 0) continue;
    const ring: number[] = [];
    for (let k = 0; k < a.length; k++) ring.push(a[(i + 1 + k) % a.length]!);
    // From `to` all round a to `from`, then the corners of b between them.
    for (let k = 2; k < b.length; k++) ring.push(b[(j + k) % b.length]!);
    return ring;
  }
  return undefined;
}
