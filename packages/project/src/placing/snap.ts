import type { Bounds, Vector3 } from "@twincell/core";

/** What a moved object can be put flush with: the box around another, under its name. */
export interface SnapTarget {
  readonly name: string;
  readonly bounds: Bounds;
}

/** Onto what one axis was snapped. `at_m` is the place on that axis, for drawing. */
export interface Snapped {
  readonly axis: 0 | 1 | 2;
  readonly kind: "grid" | "floor" | "face" | "middle";
  readonly name: string;
  readonly at_m: number;
}

export interface SnapOptions {
  /** Axes of the world that the drag moves along. */
  readonly axes: readonly (0 | 1 | 2)[];
  /** Distance between the lines of the grid [m]; 0 for none. */
  readonly grid_m: number;
  /** Farther than this nothing attracts [m]. */
  readonly tolerance_m: number;
  readonly targets: readonly SnapTarget[];
}

/** The nearest multiple of the step; the value itself without a step. */
export const toGrid = (value: number, step: number): number => (step > 0 ? Math.round(value / step) * step : value);

/**
 * Where a moved box comes to lie: axis by axis flush with the floor (z = 0), with a face or the middle of another
 * object within `tolerance_m`, else on the grid. Faces that meet on two axes are an edge, on three a corner. The grid
 * counts the origin of what is moved, not its box.
 *
 * @param origin  of what is moved, in the world, before snapping [m].
 * @param bounds  of what is moved, at that place [m].
 * @returns how much to add to the place [m], and onto what every axis was snapped.
 */
export function snapBox(
  origin: Vector3,
  bounds: Bounds,
  { axes, grid_m, tolerance_m, targets }: SnapOptions,
): { readonly add_m: Vector3; readonly snapped: readonly Snapped[] } {
  const add_m: Vector3 = [0, 0, 0];
  const snapped: Snapped[] = [];
  for (const axis of axes) {
    let best: (Snapped & { readonly add: number }) | undefined;
    const offer = (kind: Snapped["kind"], name: string, from: number, to: number): void => {
      const add = to - from;
      if (Math.abs(add) <= tolerance_m && Math.abs(add) < Math.abs(best?.add ?? Infinity))
        best = { axis, kind, name, at_m: to, add };
    };
    const low = bounds.lower[axis];
    const high = bounds.upper[axis];
    if (axis === 2) offer("floor", "", low, 0);
    for (const { name, bounds: other } of targets) {
      for (const face of [other.lower[axis], other.upper[axis]]) {
        offer("face", name, low, face);
        offer("face", name, high, face);
      }
      if (axis !== 2) offer("middle", name, (low + high) / 2, (other.lower[axis] + other.upper[axis]) / 2);
    }
    if (best === undefined && grid_m > 0) {
      const at_m = toGrid(origin[axis], grid_m);
      best = { axis, kind: "grid", name: "", at_m, add: at_m - origin[axis] };
    }
    if (best === undefined) continue;
    add_m[axis] = best.add;
    snapped.push({ axis: best.axis, kind: best.kind, name: best.name, at_m: best.at_m });
  }
  return { add_m, snapped };
}
