import { edgeTraceCell } from "@twincell/project";
import { afterEach, expect, test } from "vitest";
import { showDocument } from "../../stores/document.ts";
import { jogStore } from "../../stores/jog.ts";
import { recordMoving } from "../../stores/record.ts";
import { watchCollisions } from "../collision/collision.ts";
import { startFollowing } from "../robot/follow.ts";
import { onFrame, tick } from "./jog-frames.ts";
import { startHandPath } from "./hand-path.ts";
import { hold, releaseAll } from "./pressed-inputs.ts";
import { startJogging } from "./jogger.ts";
import { showJoints, theLive } from "../live.ts";
import { startPlayhead } from "../history/playhead.ts";
import { readTcp } from "./readout.ts";

const ends: (() => unknown)[] = [];
afterEach(() => {
  for (const end of ends.splice(0)) end();
  releaseAll();
  recordMoving(false);
});
const WORLD = { position: [0, 0, 0], quaternion: [0, 0, 0, 1] } as const;

test("N-23 a frame with everything that listens to the heartbeat costs less than 1 ms of the 16.7 ms a display has", () => {
  showDocument(edgeTraceCell());
  const nobody = { post: () => undefined, listen: () => undefined, close: () => undefined };
  const read = new Float64Array(6);
  ends.push(
    startFollowing(),
    startJogging(),
    startHandPath(),
    watchCollisions(nobody),
    onFrame(() => {
      readTcp(theLive().worldFromTcp, { position: [...WORLD.position], quaternion: [...WORLD.quaternion] }, read);
    }),
  );
  startPlayhead();
  showJoints([0, -1, 1.9, 0, 0.7, 0]);
  jogStore.setState({ frame: "world", manner: "hold", speed: 0.5, blocked: null });
  recordMoving(true);
  const took_ms: number[] = [];
  const from = theLive().revision;
  for (let i = 0, now_ms = 9e6; i < 600; i++) {
    hold("pendant", 2, i % 120 < 60 ? 1 : -1);
    hold("gamepad", 3, i % 120 < 60 ? 0.5 : -0.5);
    const begun_ms = performance.now();
    tick((now_ms += 1000 / 60));
    took_ms.push(performance.now() - begun_ms);
  }
  expect(theLive().revision - from).toBeGreaterThan(500);
  expect(took_ms.toSorted((a, b) => a - b)[300]).toBeLessThan(1);
});

test("after a pause nothing jumps, and two drivers of one frame count once", () => {
  const steps: number[] = [];
  ends.push(
    onFrame((_now, dt_s) => {
      steps.push(dt_s);
    }),
  );
  tick(1e7);
  tick(1e7 + 0.4);
  tick(1e7 + 20);
  tick(1e7 + 90_000);
  expect(steps.slice(1)).toEqual([expect.closeTo(0.02, 9), 0.1]);
});
