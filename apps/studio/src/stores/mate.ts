import type { Pose } from "@twincell/core";
import { groupOf, matedPose, movedWith, withObjects, type ObjectRecord } from "@twincell/project";
import { createStore } from "zustand/vanilla";
import { words } from "../messages/index.ts";
import { cellStore } from "./cell.ts";
import { commit, objectOf } from "./document.ts";
import { notify } from "./notices.ts";
import type { PickedSurface } from "./surface.ts";

/** The two picks of a mate, and how the first object was put to the second. */
export interface MateState {
  readonly moving: PickedSurface | null;
  readonly fixed: PickedSurface | null;
  readonly flipped: boolean;
  readonly offset_m: number;
  /** The objects that moved, as they stood before: every change of the mate begins there. */
  readonly before: readonly ObjectRecord[];
}
const NOTHING: MateState = { moving: null, fixed: null, flipped: false, offset_m: 0, before: [] };
export const mateStore = createStore<MateState>(() => NOTHING);
export const clearMate = (): void => mateStore.setState(NOTHING);

/** The first pick is on what moves, the second on where it goes; a third begins anew. */
export function pickToMate(surface: PickedSurface): void {
  const { moving, fixed } = mateStore.getState();
  const { document } = cellStore.getState();
  if (!document) return;
  if (moving === null || fixed !== null) {
    if (objectOf(document, surface.object)?.locked === true) notify("info", words.mate.locked);
    else mateStore.setState({ ...NOTHING, moving: surface });
    return;
  }
  const ids = groupOf(document, moving.object);
  if (ids.includes(surface.object)) {
    notify("info", words.mate.same);
    return;
  }
  if ((moving.feature.kind === "plane") !== (surface.feature.kind === "plane")) {
    notify("info", words.mate.differ, words.mate.differHint);
    return;
  }
  const before = document.objects.filter(({ id }) => ids.includes(id));
  mateStore.setState({ fixed: surface, before });
  apply(true);
}

/** Turned round, or farther off: the mate that was just made is made anew. */
export function changeMate(change: Partial<Pick<MateState, "flipped" | "offset_m">>, done: boolean): void {
  mateStore.setState(change);
  apply(done);
}

function apply(done: boolean): void {
  const { moving, fixed, flipped, offset_m, before } = mateStore.getState();
  const first = before.find(({ id }) => id === moving?.object);
  if (!moving || !fixed || !first) return;
  const mated = matedPose(first.worldFromObject, moving.feature, fixed.feature, { flipped, offset_m });
  if (mated.kind !== "mated") return;
  const pivot = first.worldFromObject as Pose as Pose<"world", "pivot">;
  const target = mated.worldFromObject as Pose as Pose<"world", "pivot">;
  commit(
    words.mate.undo,
    document =>
      withObjects(
        document,
        before.map(object => ({
          ...(objectOf(document, object.id) ?? object),
          worldFromObject: movedWith(object.worldFromObject, pivot, target),
        })),
      ),
    done ? undefined : "mate",
  );
}
