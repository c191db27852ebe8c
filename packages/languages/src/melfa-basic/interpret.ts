import { sectionForLanguage } from "@twincell/core";
import { basicEntryPoints } from "../parser/basic/index.ts";
import { readMelfa } from "./read/grammar.ts";
import { MelfaMachine } from "./run/machine.ts";

/** Reads and executes MELFA-BASIC: the program up to its End, the routines behind it, and its positions. */
export const { interpret: interpretMelfa, parse: parseMelfa } = basicEntryPoints({
  name: "MELFA-BASIC",
  speaks: robot => sectionForLanguage(robot, "melfa-basic") !== undefined,
  read: readMelfa,
  machine: stage => new MelfaMachine(stage),
});
