import { hold, playOrHold, resume } from "../runtime/physics/physics.ts";
import { pause, playheadNow, playOrPause } from "../runtime/history/playhead.ts";
import type { Command } from "../stores/commands.ts";
import { physicsStore } from "../stores/physics.ts";
import { playStore } from "../stores/play.ts";
import { seek } from "../stores/seek.ts";
import { select } from "../stores/selection.ts";
import { words } from "../messages/index.ts";

const can = (): boolean => (playStore.getState().plan?.duration_s ?? 0) > 0;

export const playCommands = (): readonly Command[] => [
  {
    id: "play.toggle",
    group: "play",
    words: words.commands.play,
    keys: ["Space"],
    can,
    run: () => (physicsStore.getState().on ? playOrHold() : playOrPause()),
  },
  { id: "play.physics", group: "play", words: words.commands.physics, run: togglePhysics },
  {
    id: "play.resume",
    group: "play",
    words: words.commands.resume,
    can: () => physicsStore.getState().status === "stopped",
    run: resume,
  },
  { id: "play.step", group: "play", words: words.commands.stepOn, keys: ["ArrowRight"], can, run: () => toStep(1) },
  { id: "play.back", group: "play", words: words.commands.stepBack, keys: ["ArrowLeft"], can, run: () => toStep(-1) },
  { id: "play.faster", group: "play", words: words.commands.faster, run: () => changeSpeed(0.1) },
  { id: "play.slower", group: "play", words: words.commands.slower, run: () => changeSpeed(-0.1) },
  { id: "play.start", group: "play", words: words.commands.start, keys: ["Home"], can, run: () => seek(0) },
];

/** By a tenth, within 0 … 100 %. */
function changeSpeed(by: number): void {
  playStore.setState(({ speed }) => ({ speed: Math.min(1, Math.max(0, Math.round(10 * (speed + by)) / 10)) }));
}

/** Another way to play: what was playing stands still. */
function togglePhysics(): void {
  pause();
  hold();
  physicsStore.setState(({ on }) => ({ on: !on }));
}

/** To the next or the previous end of a step. */
function toStep(by: 1 | -1): void {
  const { plan } = playStore.getState();
  const now = playheadNow();
  if (!plan) return;
  const ends = new Map(plan.segments.map(segment => [segment.step, segment.start_s + segment.duration_s]));
  const found =
    by > 0 ? [...ends].find(([, end]) => end > now + 1e-6) : [...ends].findLast(([, end]) => end < now - 1e-6);
  seek(found?.[1] ?? (by > 0 ? plan.duration_s : 0));
  if (found) select({ kind: "step", id: found[0] });
}
