import { sectionForLanguage } from "@twincell/core";
import { blockEntryPoints, changedNames, routineScript, type BlockReader } from "../parser/structured/index.ts";
import { readApplication } from "./read/application.ts";
import { Machine } from "./run/machine.ts";

/** Executes and reads VAL 3: the program "start", or the first of the text, with the data that stand behind it. */
export const { interpret: interpretVal3, parse: parseVal3 }: BlockReader = blockEntryPoints({
  name: "VAL 3",
  speaks: robot => sectionForLanguage(robot, "val3") !== undefined,
  read: readApplication,
  script(application, robot, worldFromBase) {
    const changing = changedNames([...application.routines.values()].map(({ body }) => body));
    return routineScript(
      application.title,
      (declared, signals) => new Machine(application, changing, robot, worldFromBase, declared, signals),
    );
  },
});
