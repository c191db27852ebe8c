import { linkSolids, pose, robotById, type Robot } from "@twincell/core";
import { cellGeometry, type CellDocument } from "@twincell/project";
import { cellStore } from "../../stores/cell.ts";
import { notify } from "../../stores/notices.ts";
import { sound } from "../../stores/sound.ts";
import { physicsShows, physicsStore } from "../../stores/physics.ts";
import { watchStore } from "../../stores/watch.ts";
import type { FromWatcher, ToWatcher } from "../../workers/messages.ts";
import { onFrame } from "../jog/jog-frames.ts";
import { setTouching, theLive } from "../live.ts";

/** Clearance is shown below this [m]. */
const CUTOFF_M = 0.25;
const TELL_EVERY_MS = 100;

/** Who sends postures to be looked at: the worker of the page, or a double in a test. */
export interface Watcher {
  post(message: ToWatcher): void;
  listen(hear: (message: FromWatcher) => void): void;
  close(): void;
}

export function workerWatcher(): Watcher {
  const worker = new Worker(new URL("../../workers/collision.worker.ts", import.meta.url), { type: "module" });
  return {
    post: message => {
      worker.postMessage(message);
    },
    listen: hear => {
      worker.addEventListener("message", ({ data }: MessageEvent<FromWatcher>) => {
        hear(data);
      });
      worker.addEventListener("error", event => {
        hear({ kind: "trouble", sentence: `The collision check could not run: ${event.message}.` });
      });
    },
    close: () => {
      worker.terminate();
    },
  };
}

/**
 * Keeps looking at the posture on screen: one posture is under way at a time, and the newest goes next, so that a slow
 * look never makes a queue. Contacts colour what is touched and sound once when they begin (rows N-47 … N-49).
 */
export function watchCollisions(watcher: Watcher = workerWatcher()): () => void {
  let edition = 0;
  let waiting = false;
  let lookedAt = -1;
  let toldAt = 0;
  let was: ReadonlySet<string> = new Set();

  const send = (document: CellDocument | null): void => {
    const robot = document && robotById(document.robot.id);
    edition++;
    waiting = false;
    lookedAt = -1;
    if (document && robot)
      watcher.post({
        kind: "cell",
        cell: watched(physicsShows(physicsStore.getState()) ? withoutParts(document) : document, robot),
        edition,
      });
  };

  watcher.listen(message => {
    waiting = false;
    if (message.kind === "trouble") {
      notify("bad", message.sentence, "Reload the page; nothing is lost.");
      return;
    }
    if (message.edition !== edition) return;
    const now = new Set(message.contacts.flat());
    const began = message.contacts.some(([a, b]) => !was.has(`${a}\n${b}`));
    was = new Set(message.contacts.map(([a, b]) => `${a}\n${b}`));
    setTouching(now);
    if (began) sound("crash");
    const known = watchStore.getState();
    const changed =
      began || known.contacts.length !== message.contacts.length || known.touched.join() !== message.touched.join();
    if (!changed && performance.now() - toldAt < TELL_EVERY_MS) return;
    toldAt = performance.now();
    watchStore.setState({
      contacts: message.contacts,
      touched: message.touched,
      clearance_m: message.clearance_m,
      nearest: message.nearest,
      took_ms: message.took_ms,
    });
  });

  const stopFrames = onFrame(() => {
    const live = theLive();
    if (waiting || live.revision === lookedAt || edition === 0) return;
    waiting = true;
    lookedAt = live.revision;
    watcher.post({ kind: "look", q_rad: live.q_rad });
  });
  const stopDocument = cellStore.subscribe((state, before) => {
    if (state.document !== before.document && solidsDiffer(state.document, before.document)) send(state.document);
  });
  // Parts that physics moves are not where the document has them: what they touch is physics' affair.
  const stopPhysics = physicsStore.subscribe((state, before) => {
    if (physicsShows(state) !== physicsShows(before)) send(cellStore.getState().document);
  });
  send(cellStore.getState().document);
  return () => {
    stopFrames();
    stopPhysics();
    stopDocument();
    watcher.close();
  };
}

const withoutParts = (document: CellDocument): CellDocument => ({
  ...document,
  objects: document.objects.filter(({ role }) => role !== "workpiece"),
});

/** Editing a program leaves the solids as they are. */
function solidsDiffer(a: CellDocument | null, b: CellDocument | null): boolean {
  return (
    a === null ||
    b === null ||
    a.objects !== b.objects ||
    a.tools !== b.tools ||
    a.tool !== b.tool ||
    a.robot !== b.robot ||
    a.allowedPairs !== b.allowedPairs ||
    a.pairs !== b.pairs ||
    a.errors !== b.errors
  );
}

function watched(document: CellDocument, robot: Robot): Extract<ToWatcher, { kind: "cell" }>["cell"] {
  const tool = document.tools.find(candidate => candidate.name === document.tool);
  return {
    geometry: cellGeometry(document, linkSolids(robot)),
    arm: robot.arm,
    flangeFromTcp: tool?.flangeFromTcp ?? pose(),
    free_rad: robot.home_rad,
    cutoff_m: CUTOFF_M,
  };
}
