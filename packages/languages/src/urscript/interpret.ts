import {
  blockEntryPoints,
  constantsOf,
  mainScript,
  type BlockReader,
  type Script,
} from "../parser/structured/index.ts";
import { readSource } from "./read/grammar.ts";
import { keptThreads } from "./read/threads.ts";
import { Machine, speaksUrScript } from "./run/machine.ts";

/**
 * Executes and reads URScript: one program `def … end` with the routines inside it, or the statements of a bare script.
 */
export const { interpret: interpretUrScript, parse: parseUrScript }: BlockReader = blockEntryPoints({
  name: "URScript",
  speaks: speaksUrScript,
  read: readSource,
  notExecuted: keptThreads,
  script(source, robot, worldFromBase) {
    const constants = constantsOf(source.main, source.routines.values());
    const script: Script<Machine> = mainScript(
      source,
      (declared, signals) => new Machine(source, constants, robot, worldFromBase, declared, signals),
    );
    return { ...script, run: (machine: Machine) => machine.start(source.main) };
  },
});
