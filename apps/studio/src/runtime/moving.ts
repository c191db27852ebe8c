import { controlStore } from "../stores/control.ts";
import { dialogStore } from "../stores/dialogs.ts";
import { physicsStore } from "../stores/physics.ts";
import { playStore } from "../stores/play.ts";
import { selectionStore } from "../stores/selection.ts";
import { stationStore } from "../stores/stations.ts";
import { traceStore } from "../stores/trace.ts";
import { isGliding } from "./jog/joint-interpolation.ts";
import { isAnyHeld } from "./jog/pressed-inputs.ts";

/** Whether anything moves that STOP would bring to rest: the program, a jogged or led robot, a controller. */
export const anythingMoves = (): boolean =>
  playStore.getState().playing ||
  physicsStore.getState().status === "running" ||
  controlStore.getState().running ||
  stationStore.getState().stations.some(({ running }) => running) ||
  isAnyHeld() ||
  isGliding();

/** Whether Esc has something to leave: a dialog, the trace tool, a selection. */
const somethingToLeave = (): boolean =>
  dialogStore.getState().open !== null || traceStore.getState().active || selectionStore.getState().selected !== null;

/** Two presses of Esc within this time stop everything, when there was nothing to leave. */
const TWICE_MS = 600;

/**
 * What Esc means, press by press: while something moves it stops; otherwise it leaves one level and stops nothing.
 * Pressed twice with nothing to leave it stops all the same: a robot may move of which nothing is known here.
 */
export function escapeRule(): (now_ms: number) => "stop" | "leave" {
  let last_ms = -Infinity;
  return now_ms => {
    const again = now_ms - last_ms < TWICE_MS;
    last_ms = -Infinity;
    if (anythingMoves()) return "stop";
    if (somethingToLeave()) return "leave";
    if (again) return "stop";
    last_ms = now_ms;
    return "leave";
  };
}
