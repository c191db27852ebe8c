import { del, get, keys, set } from "idb-keyval";
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
import { keepDocument, openKept } from "./stores/autosave.ts";
import { CellLibrary, setLibrary, type KeyValueStore } from "./stores/library.ts";
import { notify } from "./stores/notices.ts";
import { keepPresent, onKeepFacts } from "./stores/opening.ts";
import { keepPreferences } from "./stores/preferences.ts";
import { words } from "./words/index.ts";
import { presentFacts } from "./live/present-facts.ts";
import { onStop } from "./stores/stop.ts";

const browserStore: KeyValueStore = {
  get: key => get(key),
  set: (key, value) => set(key, value),
  keys: () => keys(),
  delete: key => del(key),
};
/** Not from `crypto.randomUUID`, which a page on a plain network address does not have. */
const newCellId = (): string =>
  Array.from(crypto.getRandomValues(new Uint8Array(9)), byte => byte.toString(36).padStart(2, "0")).join("");

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
  const library = new CellLibrary(browserStore, () => Date.now(), newCellId);
  setLibrary(library);
  onKeepFacts(presentFacts);
  keepDocument(
    browserStore,
    {
      after: (ms, act) => {
        const timer = setTimeout(act, ms);
        return () => clearTimeout(timer);
      },
    },
    library,
  );
  document.addEventListener("visibilitychange", () => {
    if (document.visibilityState !== "hidden") return;
    keepPresent();
    library.flush().catch(() => undefined); // The next save says why nothing is kept; here nobody looks.
  });
  // Languages, controllers and recording are a part of the page that the first sight of it does not wait for.
  void library
    .load()
    // Without a library the cell that was open is still read.
    .catch((trouble: unknown) =>
      notify("warn", words.file.noLibrary(trouble instanceof Error ? trouble.message : String(trouble))),
    )
    .then(() => openKept(browserStore, library))
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
