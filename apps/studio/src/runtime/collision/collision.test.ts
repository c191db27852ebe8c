import { watchCell, type Sight } from "@twincell/core";
import { edgeTraceCell } from "@twincell/project";
import { afterEach, beforeEach, expect, test } from "vitest";
import { cellStore } from "../../stores/cell.ts";
import { soundStore } from "../../stores/sound.ts";
import { watchStore } from "../../stores/watch.ts";
import type { FromWatcher, ToWatcher } from "../../workers/messages.ts";
import { watchCollisions, type Watcher } from "./collision.ts";
import { tick } from "../jog/jog-frames.ts";
import { showJoints, theLive, touchingNow } from "../live.ts";

/** Answers when told to, so that a slow worker can be played. */
function slowWatcher(): Watcher & { readonly asked: ToWatcher[]; answer(): void } {
  const asked: ToWatcher[] = [];
  let hear: (message: FromWatcher) => void = () => undefined;
  let look: ((q: ArrayLike<number>) => Sight) | undefined;
  let edition = 0;
  return {
    asked,
    post: message => {
      asked.push(message);
    },
    listen: listen => {
      hear = listen;
    },
    close: () => undefined,
    answer() {
      for (const message of asked.splice(0)) {
        if (message.kind === "cell") {
          look = watchCell(message.cell);
          edition = message.edition;
          continue;
        }
        const { contacts, touched, clearance } = look!(message.q_rad);
        hear({
          kind: "sight",
          edition,
          contacts: contacts.map(({ a, b }) => [a, b] as const),
          touched: [...touched],
          clearance_m: clearance.distance_m,
          nearest: [clearance.a, clearance.b],
          took_ms: 1,
        });
      }
    },
  };
}

const HOME = [0, -Math.PI / 2, Math.PI / 2, 0, 0, 0];
/** Arm stretched out level, swung into the wall on the left. */
const INTO_WALL = [Math.PI / 2, 0, Math.PI / 2, 0, 0, 0];
let stop = (): void => undefined;
let now_ms = 0;
const frame = (): void => {
  tick((now_ms += 16));
};
beforeEach(() => {
  cellStore.setState({ document: edgeTraceCell() });
  showJoints(HOME);
});
afterEach(() => {
  stop();
});

test("one posture is under way at a time and the newest goes next", () => {
  const watcher = slowWatcher();
  stop = watchCollisions(watcher);
  watcher.answer();
  for (let i = 0; i < 10; i++) {
    showJoints(HOME.map(q => q + i * 0.01));
    frame();
  }
  expect(watcher.asked.length).toBe(1);
  watcher.answer();
  frame();
  expect(watcher.asked.length).toBe(1);
  watcher.answer();
  frame();
  expect(watcher.asked.length).toBe(0);
});

test("N-47 N-48 N-49 a contact sounds once, names what is touched, and lets go of it again", () => {
  const watcher = slowWatcher();
  stop = watchCollisions(watcher);
  const crashes = soundStore.getState().played.crash;
  const show = (q: readonly number[]): void => {
    showJoints(q);
    frame();
    watcher.answer();
  };
  show(HOME);
  expect([...touchingNow()]).toEqual([]);
  show([1.2, 0, Math.PI / 2, 0, 0, 0]);
  show(INTO_WALL);
  show(INTO_WALL.map(q => q + 0.001));
  expect([...touchingNow()]).toContain("wall-left");
  expect(soundStore.getState().played.crash).toBe(crashes + 1);
  show(HOME);
  expect([...touchingNow()]).toEqual([]);
  expect(watchStore.getState().contacts).toEqual([]);
});

test("N-50 a contact is only an alert: what is touched stays where it stands, and the robot where it was shown", () => {
  const watcher = slowWatcher();
  const before = structuredClone(cellStore.getState().document);
  const { document } = cellStore.getState();
  stop = watchCollisions(watcher);
  showJoints(INTO_WALL);
  frame();
  watcher.answer();
  for (let i = 0; i < 60; i++) {
    showJoints(INTO_WALL.map(q => q + 0.002 * i));
    frame();
    watcher.answer();
  }
  expect([...touchingNow()]).toContain("wall-left");
  expect(cellStore.getState().document).toBe(document);
  expect(document).toEqual(before);
  expect([...theLive().q_rad]).toEqual(INTO_WALL.map(q => q + 0.002 * 59));
});
