import { del, get, keys, set } from "idb-keyval";
import { startCommands } from "./commands/index.ts";
import { startSounds } from "./features/sounds/sounds.ts";
import { startBaseMap } from "./runtime/planning/base-map.ts";
import { startChecking } from "./runtime/planning/checking.ts";
import { watchCollisions } from "./runtime/collision/collision.ts";
import { startFollowing } from "./runtime/robot/follow.ts";
import { tick } from "./runtime/jog/jog-frames.ts";
import { endInterpolation } from "./runtime/jog/joint-interpolation.ts";
import { startHandPath } from "./runtime/jog/hand-path.ts";
import { startOffline } from "./runtime/offline.ts";
import { releaseAll } from "./runtime/jog/pressed-inputs.ts";
import { startJogging } from "./runtime/jog/jogger.ts";
import { hold, startPhysics } from "./runtime/physics/physics.ts";
import { pause, startPlayhead } from "./runtime/history/playhead.ts";
import { startRepairing } from "./runtime/planning/repairing.ts";
import { lookForSession } from "./runtime/session.ts";
import { startPreview } from "./runtime/planning/preview.ts";
import { startTexts } from "./runtime/text-program.ts";
import { cellStore } from "./stores/cell.ts";
import { keepDocument, openKept } from "./stores/autosave.ts";
import { loadCatalogue } from "./stores/catalogue.ts";
import type { KeyValueStore } from "./stores/keeper.ts";
import { CellLibrary, setLibrary } from "./stores/library.ts";
import { notify } from "./stores/notices.ts";
import { keepPresent, onKeepFacts } from "./stores/opening.ts";
import { loadRobotFiles } from "./stores/own-robots.ts";
import { keepPreferences } from "./stores/preferences.ts";
import { words } from "./messages/index.ts";
import { presentFacts } from "./runtime/present-facts.ts";
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
  void lookForSession();
  startFollowing();
  startPlayhead();
  startPhysics();
  startJogging();
  startHandPath();
  startPreview();
  startSounds();
  for (const bringToRest of [releaseAll, endInterpolation, pause, hold]) onStop(bringToRest);
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
    .catch((problem: unknown) =>
      notify("warn", words.file.noLibrary(problem instanceof Error ? problem.message : String(problem))),
    )
    .then(() => loadRobotFiles(browserStore))
    .catch((problem: unknown) =>
      notify("warn", words.own.notLoaded(problem instanceof Error ? problem.message : String(problem))),
    )
    .then(() => openKept(browserStore, library))
    .then(() => joinFromAddress())
    // The cell of this browser is open all the same.
    .catch((problem: unknown) => notify("bad", problem instanceof Error ? problem.message : String(problem)))
    .then(() => import("./runtime/robot/cell-control.ts"))
    .then(({ startCellControl }) => {
      startCellControl();
      return loadCatalogue();
    })
    .catch((fault: unknown) =>
      notify("warn", words.robots.noCatalogue(fault instanceof Error ? fault.message : String(fault))),
    );
  startOffline(async () => {
    keepPresent();
    await library.flush();
    await saved();
  });
  watchCollisions();
  startTexts();
  const checking = startChecking();
  startRepairing();
  startBaseMap();
  startCommands(checking);
  const beat = (now_ms: number): void => {
    tick(now_ms);
    requestAnimationFrame(beat);
  };
  requestAnimationFrame(beat);
}

/** A page whose address names a cell of its server opens it: `?cell=` to edit it, `?watch=` by a read-only link. */
async function joinFromAddress(): Promise<void> {
  const { searchParams } = new URL(location.href);
  const watch = searchParams.get("watch");
  const cell = watch ?? searchParams.get("cell");
  if (cell === null) return;
  const { joinCell } = await import("./runtime/together.ts");
  await joinCell(cell, browserStore, watch !== null);
}

/** Resolves when everything that was done is on the disk; rejects where it cannot be kept. */
function saved(): Promise<void> {
  return new Promise((resolve, reject) => {
    const look = (): boolean => {
      const { saving } = cellStore.getState();
      if (saving.kind === "saved") resolve();
      else if (saving.kind === "problem") reject(new Error(saving.sentence));
      else return false;
      return true;
    };
    if (look()) return;
    const stop = cellStore.subscribe(() => {
      if (look()) stop();
    });
  });
}
