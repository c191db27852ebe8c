import { baseShift, type SuggestedBase, type Verdict } from "@twincell/core";
import { repairCell } from "@twincell/project";
import { baseMapStore } from "../../stores/base-map.ts";
import { commit } from "../../stores/document.ts";
import { notify } from "../../stores/notices.ts";
import { playStore } from "../../stores/play.ts";
import { words } from "../../messages/index.ts";
import { BackgroundSearch, workerPlanner, type Planner } from "./planner.ts";
import { question } from "./repairing.ts";

const mapping = new BackgroundSearch();

/** Makes the base position map anew after every check, while it is to be seen. */
export function startBaseMap(hire: () => Planner = workerPlanner): () => void {
  mapping.hire = hire;
  let made: Verdict | null = null;
  const follow = (): void => {
    const { on } = baseMapStore.getState();
    const { verdict, stale } = playStore.getState();
    const wanted = on && !stale ? verdict : null;
    if (wanted === null && on) {
      // The map that is there is still of use while the program is checked again.
      mapping.cancel();
      made = null;
      return;
    }
    if (wanted === made) return;
    made = wanted;
    mapping.cancel();
    if (wanted === null) baseMapStore.setState({ field: null, best: undefined, share: null });
    else make();
  };
  const stopMap = baseMapStore.subscribe(follow);
  const stopPlay = playStore.subscribe(follow);
  return () => {
    stopMap();
    stopPlay();
    mapping.cancel();
  };
}

function make(): void {
  const asked = question();
  if (asked === null) {
    baseMapStore.setState({ field: null, best: undefined, share: null });
    return;
  }
  const [x, y, z] = asked.cell.worldFromBase.position;
  baseMapStore.setState({ best: undefined, share: 0 });
  mapping.begin({ kind: "base-field", ...asked }, message => {
    switch (message.kind) {
      case "progress":
        baseMapStore.setState({ share: message.share });
        return;
      case "field-so-far":
        baseMapStore.setState({ field: message.field, from_m: [x, y, z] });
        return;
      case "base-field":
        baseMapStore.setState({ field: message.field, best: message.best, from_m: [x, y, z], share: null });
        return;
      case "trouble":
        baseMapStore.setState({ share: null });
        notify("bad", message.sentence, words.collide.troubleHint);
    }
  });
}

/** The robot stands where the map suggests, as one edit; points, parts and frames stay where they are. */
export function moveToSuggestedBase(best: SuggestedBase): void {
  const by_m = baseShift(best);
  if (commit(words.undo.moveBase, cell => repairCell(cell, cell.program, "", { moveBase: { by_m } })))
    notify("done", words.check.baseMoved);
}
