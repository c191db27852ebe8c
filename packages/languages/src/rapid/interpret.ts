import { sectionForLanguage } from "@twincell/core";
import { blockEntryPoints, changedNames, routineScript, type BlockReader } from "../parser/structured/index.ts";
import { readSource } from "./read/grammar.ts";
import { Machine } from "./run/machine.ts";

/** Executes and reads RAPID: PROC main, or the only routine of the text. */
export const { interpret: interpretRapid, parse: parseRapid }: BlockReader = blockEntryPoints({
  name: "RAPID",
  speaks: robot => sectionForLanguage(robot, "rapid") !== undefined,
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
