import { basicEntryPoints } from "../parser/basic/index.ts";
import { readMelfa } from "./read/grammar.ts";
import { MelfaMachine, hasMelfa } from "./run/machine.ts";

/** Reads and executes MELFA-BASIC: the program up to its End, the routines behind it, and its positions. */
export const { interpret: interpretMelfa, parse: parseMelfa } = basicEntryPoints({
  name: "MELFA-BASIC",
  speaks: ({ id }) => hasMelfa(id),
  read: readMelfa,
  machine: stage => new MelfaMachine(stage),
});
