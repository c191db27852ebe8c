import { get, set } from "idb-keyval";
import { startCommands } from "./commands/index.ts";
import { startSounds } from "./features/sounds/sounds.ts";
import { startFollowing } from "./live/follow.ts";
import { tick } from "./live/frames.ts";
import { endGlide } from "./live/glide.ts";
import { releaseAll } from "./live/held.ts";
import { pause, startPlayhead } from "./live/playhead.ts";
import { keepDocument, openKept, type Keeper } from "./stores/autosave.ts";
import { keepPreferences } from "./stores/preferences.ts";
import { onStop } from "./stores/stop.ts";

const browserKeeper: Keeper = { get: key => get(key), set: (key, value) => set(key, value) };

/** Starts everything that lives as long as the page. Nothing here waits for the 3D view. */
export function boot(): void {
  keepPreferences(localStorage, matchMedia("(prefers-color-scheme: light)").matches);
  startCommands();
  startFollowing();
  startPlayhead();
  startSounds();
  for (const bringToRest of [releaseAll, endGlide, pause]) onStop(bringToRest);
  keepDocument(browserKeeper, { after: (ms, act) => { const timer = setTimeout(act, ms); return () => clearTimeout(timer); } });
  void openKept(browserKeeper);
  const beat = (now_ms: number): void => { tick(now_ms); requestAnimationFrame(beat); };
  requestAnimationFrame(beat);
}
