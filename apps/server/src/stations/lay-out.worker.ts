import { parentPort } from "node:worker_threads";
import { prepareJob } from "@twincell/controllers";
import { addCatalogue, addOwnRobot, robotById } from "@twincell/core";
import { CATALOGUE } from "@twincell/core/catalogue";
import { dialectById } from "@twincell/languages";
import type { PrepareJobAnswer, PrepareJobRequest } from "./lay-out-messages.ts";

addCatalogue(CATALOGUE);
parentPort!.on(
  "message",
  ({ id, robot: robotId, own, dialect: dialectId, program, start_rad, worldFromBase, cell }: PrepareJobRequest) => {
    const answer = (message: PrepareJobAnswer): void => {
      parentPort!.postMessage(message);
    };
    try {
      if (own) addOwnRobot(own);
      const robot = robotById(robotId);
      const dialect = dialectId === null ? undefined : dialectById(dialectId);
      if (!robot) throw new Error(`There is no robot “${robotId}” in the library.`);
      answer({
        id,
        laid: prepareJob({
          program,
          robot,
          start_rad,
          ...(worldFromBase ? { worldFromBase } : {}),
          ...(cell ? { cell } : {}),
          ...(dialect ? { dialect } : {}),
        }),
      });
    } catch (problem) {
      answer({ id, trouble: problem instanceof Error ? problem.message : String(problem) });
    }
  },
);
