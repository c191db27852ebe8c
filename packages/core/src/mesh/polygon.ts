/** A point of a flat outline [m]. */
export type Point2 = readonly [number, number];

/** Twice the signed area: positive when the outline runs counter-clockwise. */
export function doubleArea(outline: readonly Point2[]): number {
  let sum = 0;
  for (let i = 0; i < outline.length; i++) {
    const a = outline[i]!;
    const b = outline[(i + 1) % outline.length]!;
    sum += a[0] * b[1] - a[1] * b[0];
  }
  return sum;
}

const turn = (a: Point2, b: Point2, c: Point2): number => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);

/**
 * Triangles of a simple outline by cutting ears, n − 2 of them, counter-clockwise whichever way the outline runs.
 * An outline that crosses itself still gets n − 2 triangles, the rest of them as a fan.
 */
export function triangulate(outline: readonly Point2[]): number[] {
  const left: number[] = [];
  for (let i = 0; i < outline.length; i++) left.push(doubleArea(outline) >= 0 ? i : outline.length - 1 - i);
  const triangles: number[] = [];
  for (let at = 0; left.length > 3; ) {
    const n = left.length;
    // The search goes on beside the last ear: long outlines of round faces would take n³ from the start each time.
    let tried = 0;
    while (tried < n && !isEar(outline, left, at)) {
      at = (at + 1) % n;
      tried++;
    }
    triangles.push(left[(at + n - 1) % n]!, left[at]!, left[(at + 1) % n]!);
    left.splice(at, 1);
    at = (at + 1) % left.length;
  }
  return left.length === 3 ? [...triangles, left[0]!, left[1]!, left[2]!] : triangles;
}

function isEar(outline: readonly Point2[], left: readonly number[], i: number): boolean {
  const n = left.length;
  const before = left[(i + n - 1) % n]!;
  const here = left[i]!;
  const after = left[(i + 1) % n]!;
  const a = outline[before]!;
  const b = outline[here]!;
  const c = outline[after]!;
  if (turn(a, b, c) <= 0) return false;
  return left.every(other => {
    if (other === before || other === here || other === after) return true;
    const p = outline[other]!;
    return turn(a, b, p) < 0 || turn(b, c, p) < 0 || turn(c, a, p) < 0;
  });
}
