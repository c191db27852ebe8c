import type { Refusal } from "@twincell/core";
import { inDegrees } from "../refusals.ts";

export const deviates = (name: string, by_rad: number, limit_rad: number): Refusal => ({
  code: "twin.deviation",
  sentence: `${name} is ${inDegrees(by_rad)} from where it should be; more than ${inDegrees(limit_rad)} is said aloud.`,
  hint: "Look whether something holds it, or whether another program runs.",
});
export const notEmitted = (language: string, sentence: string, hint: string): Refusal => ({
  code: "station.not-emitted",
  sentence: `${language} cannot say this program: ${sentence}`,
  hint,
});
export const didNotBegin = (name: string, within_s: number): Refusal => ({
  code: "group.not-begun",
  sentence: `${name} did not begin to move within ${within_s} s of the common start.`,
  hint: "Look what its pendant says; nobody of the group goes on.",
});
export const stoppedWith = (name: string, other: string, why: Refusal): Refusal => ({
  code: "group.stopped",
  sentence: `${name} was stopped with ${other}, with which it was started: ${why.sentence}`,
  hint: why.hint,
});
export const movedMeanwhile = (name: string): Refusal => ({
  code: "station.moved",
  sentence: `${name} was moved while its program was being planned.`,
  hint: "Let it stand, then send the program again.",
});
export const stoppedMeanwhile = (name: string): Refusal => ({
  code: "station.stopped",
  sentence: `${name} was stopped while its program was being planned: the program does not begin.`,
  hint: "Send the program again when the robot may move.",
});

export const disconnected = (name: string): Refusal => ({
  code: "guard.disconnected",
  sentence: `${name} was disconnected.`,
  hint: "Connect it, then confirm that motion is wanted.",
});

/** Said when a robot is connected that nobody gave a cell. */
export const noCell = (name: string): Refusal => ({
  code: "station.no-cell",
  sentence: `${name} is kept from itself only: no cell was given, so tables, walls and tools are not known to its guard.`,
  hint: "Give it the cell it stands in before it moves.",
});
