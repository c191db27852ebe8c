import { sectionForLanguage } from "@twincell/core";
import { basicEntryPoints } from "../parser/basic/index.ts";
import { readSpel } from "./read/grammar.ts";
import { SpelMachine } from "./run/machine.ts";

/** Reads and executes SPEL+: `main` and the functions that it calls. */
export const { interpret: interpretSpel, parse: parseSpel } = basicEntryPoints({
  name: "SPEL+",
  speaks: robot => sectionForLanguage(robot, "spel") !== undefined,
  read: readSpel,
  machine: stage => new SpelMachine(stage),
});
