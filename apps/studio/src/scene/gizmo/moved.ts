import type { Pose, Vector3 } from "@twincell/core";
import {
  movedWith,
  placeFrame,
  scaledShape,
  snapBox,
  worldBounds,
  type CellDocument,
  type ObjectRecord,
  type Snapped,
  type SnapTarget,
} from "@twincell/project";
import { selectedObjects, type SelectionState, type Thing } from "../../stores/selection.ts";

/** What the handles are at, as it stood when the drag began. */
export interface Taken {
  readonly worldFromPivot: Pose<"world", "pivot">;
  readonly objects: readonly ObjectRecord[];
  /** A frame or the robot, when it is one of those. */
  readonly thing: Thing | null;
  /** What it can be put flush with. */
  readonly targets: readonly SnapTarget[];
}

const unlocked = (document: CellDocument, ids: readonly string[]): readonly ObjectRecord[] =>
  ids.flatMap(id => document.objects.filter(object => object.id === id && object.locked !== true));

/** What of the selection may be moved; null for nothing: nothing is selected, or it is locked. */
export function takenOf(document: CellDocument, selection: SelectionState): Taken | null {
  const { selected } = selection;
  if (!selected) return null;
  const objects = unlocked(document, selectedObjects(selection));
  const moving = new Set(objects.map(({ id }) => id));
  const targets = document.objects
    .filter(object => !moving.has(object.id) && object.hidden !== true)
    .map(({ name, shape, worldFromObject }) => ({ name, bounds: worldBounds(shape, worldFromObject) }));
  const at = (pose: Pose): Pose<"world", "pivot"> => ({
    position: [...pose.position],
    quaternion: [...pose.quaternion],
  });
  if (selected.kind === "object") {
    const [first] = objects;
    return first ? { worldFromPivot: at(first.worldFromObject as Pose), objects, thing: null, targets } : null;
  }
  if (selected.kind === "frame") {
    const frame = document.frames.find(({ name }) => name === selected.name);
    return frame && frame.locked !== true
      ? { worldFromPivot: at(frame.worldFromFrame as Pose), objects: [], thing: selected, targets }
      : null;
  }
  if (selected.kind === "robot" || selected.kind === "link")
    return { worldFromPivot: at(document.robot.worldFromBase as Pose), objects: [], thing: { kind: "robot" }, targets };
  return null;
}

/**
 * Where the pivot comes to lie when it is moved to `after` along these axes of the world, with everything that it takes
 * along.
 */
export function snapped(
  taken: Taken,
  after: Pose<"world", "pivot">,
  options: { readonly axes: readonly (0 | 1 | 2)[]; readonly grid_m: number; readonly tolerance_m: number },
): { readonly add_m: Vector3; readonly onto: readonly Snapped[] } {
  const boxes = taken.objects.map(({ shape, worldFromObject }) =>
    worldBounds(shape, movedWith(worldFromObject, taken.worldFromPivot, after)),
  );
  const [first, ...rest] = boxes;
  const place = after.position;
  const bounds = rest.reduce(
    (all, { lower, upper }) => ({
      lower: all.lower.map((value, k) => Math.min(value, lower[k]!)) as Vector3,
      upper: all.upper.map((value, k) => Math.max(value, upper[k]!)) as Vector3,
    }),
    first ?? { lower: [...place] as Vector3, upper: [...place] as Vector3 },
  );
  const { add_m, snapped: onto } = snapBox([...place] as Vector3, bounds, { ...options, targets: taken.targets });
  return { add_m, onto };
}

/** The cell with everything moved, turned and scaled as the pivot was. */
export function withMoved(
  document: CellDocument,
  taken: Taken,
  after: Pose<"world", "pivot">,
  scale: Vector3,
): CellDocument {
  if (taken.thing?.kind === "frame")
    return placeFrame(document, taken.thing.name, after as Pose as Pose<"world", "frame">);
  if (taken.thing?.kind === "robot")
    return { ...document, robot: { ...document.robot, worldFromBase: after as Pose as Pose<"world", "base"> } };
  const before = new Map(taken.objects.map(object => [object.id, object]));
  const scales = scale.some(value => value !== 1);
  return {
    ...document,
    objects: document.objects.map(object => {
      const was = before.get(object.id);
      if (was === undefined) return object;
      return {
        ...object,
        worldFromObject: movedWith(was.worldFromObject, taken.worldFromPivot, after),
        ...(scales ? { shape: scaledShape(was.shape, scale) } : {}),
      };
    }),
  };
}
