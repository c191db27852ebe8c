import { parentPort } from "node:worker_threads";
import { layOut } from "@twincell/controllers";
import { robotById } from "@twincell/core";
import { dialectById } from "@twincell/languages";
import type { FromLayOut, ToLayOut } from "./lay-out-messages.ts";

parentPort!.on(
  "message",
  ({ id, robot: robotId, dialect: dialectId, program, start_rad, worldFromBase, cell }: ToLayOut) => {
    const answer = (message: FromLayOut): void => {
      parentPort!.postMessage(message);
    };
    try {
      const robot = robotById(robotId);
      const dialect = dialectId === null ? undefined : dialectById(dialectId);
      if (!robot) throw new Error(`There is no robot “${robotId}” in the library.`);
      answer({
        id,
        laid: layOut({
          program,
          robot,
          start_rad,
          ...(worldFromBase ? { worldFromBase } : {}),
          ...(cell ? { cell } : {}),
          ...(dialect ? { dialect } : {}),
        }),
      });
    } catch (trouble) {
      answer({ id, trouble: trouble instanceof Error ? trouble.message : String(trouble) });
    }
  },
);
