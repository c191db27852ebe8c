import { get, set } from "idb-keyval";
import { startCommands } from "./commands/index.ts";
import { startSounds } from "./features/sounds/sounds.ts";
import { startChecking } from "./live/checking.ts";
import { watchCollisions } from "./live/collision.ts";
import { startFollowing } from "./live/follow.ts";
import { tick } from "./live/frames.ts";
import { endGlide } from "./live/glide.ts";
import { startHandPath } from "./live/hand-path.ts";
import { releaseAll } from "./live/held.ts";
import { startJogging } from "./live/jogger.ts";
import { hold, startPhysics } from "./live/physics.ts";
import { pause, startPlayhead } from "./live/playhead.ts";
import { startPreview } from "./live/preview.ts";
import { startTexts } from "./live/text-program.ts";
import { keepDocument, openKept, type Keeper } from "./stores/autosave.ts";
import { keepPreferences } from "./stores/preferences.ts";
import { onStop } from "./stores/stop.ts";

const browserKeeper: Keeper = { get: key => get(key), set: (key, value) => set(key, value) };

/** Starts everything that lives as long as the page. Nothing here waits for the 3D view. */
export function boot(): void {
  keepPreferences(localStorage, matchMedia("(prefers-color-scheme: light)").matches);
  startFollowing();
  startPlayhead();
  startPhysics();
  startJogging();
  startHandPath();
  startPreview();
  startSounds();
  for (const bringToRest of [releaseAll, endGlide, pause, hold]) onStop(bringToRest);
  keepDocument(browserKeeper, {
    after: (ms, act) => {
      const timer = setTimeout(act, ms);
      return () => clearTimeout(timer);
    },
  });
  // Languages, controllers and recording are a part of the page that the first sight of it does not wait for.
  void openKept(browserKeeper)
    .then(() => import("./live/cell-control.ts"))
    .then(({ startCellControl }) => {
      startCellControl();
    });
  watchCollisions();
  startTexts();
  const checking = startChecking();
  startCommands(checking);
  const beat = (now_ms: number): void => {
    tick(now_ms);
    requestAnimationFrame(beat);
  };
  requestAnimationFrame(beat);
}
