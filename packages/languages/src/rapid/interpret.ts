import { blockEntryPoints, changedNames, routineScript, type BlockReader } from "../parser/structured/index.ts";
import { readSource } from "./read/grammar.ts";
import { Machine } from "./run/machine.ts";

/**
 * Robots whose controllers speak RAPID. Their joint angles are those of the library: none is coupled, turned round or
 * counted from elsewhere.
 */
const SPEAKS: ReadonlySet<string> = new Set(["abb_irb120", "abb_crb15000_5_95"]);

/** Executes and reads RAPID: PROC main, or the only routine of the text. */
export const { interpret: interpretRapid, parse: parseRapid }: BlockReader = blockEntryPoints({
  name: "RAPID",
  speaks: ({ id }) => SPEAKS.has(id),
  read: readSource,
  script(source, robot, worldFromBase) {
    const changing = changedNames(
      [...source.routines.values()].map(({ body }) => body),
      source.routines,
    );
    return routineScript(
      source.title,
      (declared, signals) => new Machine(source, changing, robot, worldFromBase, declared, signals),
    );
  },
});
