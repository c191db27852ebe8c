import { conveyorPalletCell } from "@twincell/project";
import { expect, test } from "vitest";
import { cellStore } from "../../stores/cell.ts";
import { physicsStore } from "../../stores/physics.ts";
import { soundStore } from "../../stores/sound.ts";
import type { FromPhysics, PhysicsFrame, ToPhysics } from "../../workers/physics-messages.ts";
import { tick } from "../jog/jog-frames.ts";
import { theLive } from "../live.ts";
import { physicsNow, playOrHold, startPhysics } from "./physics.ts";

test("M-22 a held piece is seen and heard; one advance is under way at a time; another document puts everything back", () => {
  const asked: ToPhysics[] = [];
  let hear: (message: FromPhysics) => void = () => undefined;
  const stop = startPhysics(() => ({
    post: message => {
      asked.push(message);
    },
    listen: listen => {
      hear = listen;
    },
    close: () => undefined,
  }));
  cellStore.setState({ document: conveyorPalletCell() });
  const q_rad = Float64Array.from([0.1, -1.5, 1.5, -1.5, -1.5, 0]);
  const frame = (t_s: number, signal: "free" | "held"): PhysicsFrame => ({
    t_s,
    q_rad,
    parts: new Float64Array(7),
    opening_m: 0.06,
    grasp: [signal],
    tripped: Uint8Array.of(1),
    people: new Float64Array(),
    step: "s5",
  });
  physicsStore.setState({ on: true });
  playOrHold();
  expect(asked.map(({ kind }) => kind)).toEqual(["start"]);
  const { edition } = asked[0]!;
  const grips = soundStore.getState().played.grip;
  hear({ kind: "ready", edition, parts: ["box-1"], assumptions: [], frame: frame(0, "free") });
  tick(1000);
  tick(1016);
  tick(1033);
  expect(asked.filter(({ kind }) => kind === "advance").length).toBe(1);
  hear({
    kind: "frame",
    edition,
    state: "running",
    stopped: false,
    frame: frame(0.1, "held"),
    said: ["“Box 1” is held."],
    why: "",
  });
  expect(soundStore.getState().played.grip).toBe(grips + 1);
  expect(physicsNow()?.grasp[0]).toBe("held");
  expect(theLive().q_rad[0]).toBe(0.1);
  expect(physicsStore.getState()).toMatchObject({
    status: "running",
    tripped: ["photo-cell"],
    said: ["“Box 1” is held."],
  });
  cellStore.setState({ document: conveyorPalletCell() });
  expect(physicsNow()).toBeNull();
  expect(physicsStore.getState().status).toBe("idle");
  stop();
});
