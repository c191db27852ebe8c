import { hold, release, releaseAll } from "./runtime/jog/pressed-inputs.ts";
import { linkMeter } from "./runtime/run/link-meter.ts";
import { stationLive } from "./runtime/robot/stations.ts";
import { showJoints, theLive, touchingNow } from "./runtime/live.ts";
import { physicsNow } from "./runtime/physics/physics.ts";
import { playheadNow } from "./runtime/history/playhead.ts";
import { shownRobot } from "./runtime/robot/drawn-robots.ts";
import { orientationPresetStore } from "./stores/aids.ts";
import { buildStore } from "./stores/build.ts";
import { bindingStore } from "./stores/bindings.ts";
import { cellStore } from "./stores/cell.ts";
import { commandStore, runCommand } from "./stores/commands.ts";
import { connectionStore } from "./stores/connection.ts";
import { controlStore } from "./stores/control.ts";
import { dialogStore } from "./stores/dialogs.ts";
import { commit, redo, showDocument, undo } from "./stores/document.ts";
import { gamepadStore } from "./stores/gamepad.ts";
import { headsetStore } from "./stores/headset.ts";
import { historyStore } from "./stores/history.ts";
import { jogStore } from "./stores/jog.ts";
import { lessonStore } from "./stores/lesson.ts";
import { mateStore } from "./stores/mate.ts";
import { markerViewStore } from "./stores/marker-view.ts";
import { noticeStore } from "./stores/notices.ts";
import { openCellText } from "./stores/opening.ts";
import { offlineStore } from "./stores/offline.ts";
import { physicsStore } from "./stores/physics.ts";
import { playStore } from "./stores/play.ts";
import { foreignStore } from "./stores/foreign.ts";
import { languageStore } from "./stores/languages.ts";
import { postStore } from "./stores/post.ts";
import { rigStore } from "./stores/rig.ts";
import { roomStore } from "./stores/room.ts";
import { seek } from "./stores/seek.ts";
import { selectionStore } from "./stores/selection.ts";
import { cardOf, shapeStore } from "./stores/shapes.ts";
import { soundStore } from "./stores/sound.ts";
import { stationStore } from "./stores/stations.ts";
import { surfaceStore } from "./stores/surface.ts";
import { textStore } from "./stores/text.ts";
import { togetherStore } from "./stores/together.ts";
import { traceStore } from "./stores/trace.ts";
import { videoStore } from "./stores/video.ts";
import { viewStore } from "./stores/view.ts";
import { watchStore } from "./stores/watch.ts";

/** What the browser's console and tests can reach: every store, the live state, and the commands by name. */
const twincell = {
  stores: {
    aidStore: orientationPresetStore,
    bindingStore,
    buildStore,
    cellStore,
    commandStore,
    connectionStore,
    controlStore,
    dialogStore,
    foreignStore,
    gamepadStore,
    headsetStore,
    historyStore,
    jogStore,
    languageStore,
    lessonStore,
    mateStore,
    markerViewStore,
    noticeStore,
    offlineStore,
    physicsStore,
    playStore,
    postStore,
    rigStore,
    roomStore,
    selectionStore,
    shapeStore,
    soundStore,
    stationStore,
    surfaceStore,
    textStore,
    togetherStore,
    traceStore,
    videoStore,
    viewStore,
    watchStore,
  },
  live: {
    now: theLive,
    shown: shownRobot,
    touching: touchingNow,
    showJoints,
    hold,
    release,
    releaseAll,
    playhead: playheadNow,
    physics: physicsNow,
    link: linkMeter,
    station: stationLive,
  },
  document: { commit, undo, redo, show: showDocument, open: openCellText },
  importCard: cardOf,
  run: runCommand,
  seek,
};
export type Twincell = typeof twincell;
declare global {
  interface Window {
    twincell: Twincell;
  }
}
export const exposeStores = (): void => {
  window.twincell = twincell;
};
