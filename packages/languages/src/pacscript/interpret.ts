import { basicEntryPoints } from "../parser/basic/index.ts";
import { readPac } from "./read/grammar.ts";
import { PacMachine, hasPac } from "./run/machine.ts";

/** Reads and executes PacScript: `Main` and the subs that it calls. */
export const { interpret: interpretPac, parse: parsePac } = basicEntryPoints({
  name: "PacScript",
  speaks: ({ id }) => hasPac(id),
  read: readPac,
  machine: stage => new PacMachine(stage),
});
