import { showMode, viewStore } from "../../stores/view.ts";
import { theHistory } from "../robot/cell-control.ts";
import { showJoints, theLive } from "../live.ts";

/** From now on the past is shown; what is returned goes back to now: the mode as it was, the robot as it stands. */
export function beginLookingBack(): () => void {
  const { mode } = viewStore.getState();
  const stood_rad = Float64Array.from(theLive().q_rad);
  showMode("history");
  return () => {
    theHistory.pause();
    if (mode === "history") return;
    showMode(mode);
    // Another robot may have come meanwhile; then there is nothing to go back to.
    if (theLive().q_rad.length === stood_rad.length) showJoints(stood_rad);
  };
}
