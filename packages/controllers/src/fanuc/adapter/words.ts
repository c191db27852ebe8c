import type { Refusal } from "@twincell/core";
import { rmiErrorWords } from "../codec/rmi.ts";

export const refusal = (code: string, sentence: string, hint: string): Refusal => ({ code, sentence, hint });
export const noAnswer = (sentence: string): Refusal =>
  refusal("link.refused", sentence, "Look at the address, the cable, and whether option R912 is on the controller.");
export const closedHere = refusal(
  "link.closed",
  "The connection was closed while the robot moved.",
  "Connect again, then command the move again.",
);
export const said = (id: number, hint: string): Refusal =>
  refusal("fanuc.refused", `The controller refused: ${rmiErrorWords(id)}.`, hint);
export const AT_PENDANT = "Look at the messages on its pendant, reset the robot, then command the move again.";
