import { sectionForLanguage } from "@twincell/core";
import { basicEntryPoints } from "../parser/basic/index.ts";
import { readPac } from "./read/grammar.ts";
import { PacMachine } from "./run/machine.ts";

/** Reads and executes PacScript: `Main` and the subs that it calls. */
export const { interpret: interpretPac, parse: parsePac } = basicEntryPoints({
  name: "PacScript",
  speaks: robot => sectionForLanguage(robot, "pacscript") !== undefined,
  read: readPac,
  machine: stage => new PacMachine(stage),
});
