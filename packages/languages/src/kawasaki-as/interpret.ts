import { sectionForLanguage } from "@twincell/core";
import { blockEntryPoints, constantsOf, mainScript, type BlockReader } from "../parser/structured/index.ts";
import { readSource } from "./read/grammar.ts";
import { Machine } from "./run/machine.ts";

/**
 * Executes and reads AS: the first program of the text that no other one calls, with the locations that stand in the
 * text's own lists.
 */
export const { interpret: interpretAs, parse: parseAs }: BlockReader = blockEntryPoints({
  name: "AS",
  speaks: robot => sectionForLanguage(robot, "kawasaki-as") !== undefined,
  read: readSource,
  notExecuted: ({ kept }) => kept,
  script(source, robot, worldFromBase) {
    const constants = constantsOf(source.main, source.routines.values());
    return mainScript(
      source,
      (declared, signals, notices) =>
        new Machine({ source, constants, robot, worldFromBase, declared, signals, notices }),
    );
  },
});
