import type { Refusal } from "@twincell/core";
import { inDegrees } from "../refusals.ts";

export const deviates = (name: string, by_rad: number, limit_rad: number): Refusal => ({
  code: "twin.deviation", sentence: `${name} is ${inDegrees(by_rad)} from where it should be; more than ${inDegrees(limit_rad)} is said aloud.`,
  hint: "Look whether something holds it, or whether another program runs.",
});
export const notEmitted = (language: string, sentence: string, hint: string): Refusal => ({ code: "station.not-emitted", sentence: `${language} cannot say this program: ${sentence}`, hint });
