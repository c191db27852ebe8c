import { isOwnRobot } from "@twincell/core";
import { Worker } from "node:worker_threads";
import type { PreparedJob, PrepareJob } from "@twincell/controllers";
import type { PrepareJobAnswer, PrepareJobRequest } from "./lay-out-messages.ts";

/** What came of a program that could not even be looked at. */
const failed = (problem: string): PreparedJob => {
  const why = {
    code: "station.lay-out",
    sentence: `The program could not be planned: ${problem}`,
    hint: "Send it again; if it stays so, start the server anew.",
  };
  return { plan: null, stuck: why, findings: [], bad: [], carried: [], corners: [], files: null, unwritten: why };
};

/**
 * Lays programs out in a thread of its own, one after the other, so that no link of a station waits for a plan. The
 * thread is made when it is first wanted, made again after it has died, and keeps no process alive.
 */
export function prepareJobInWorker(): { readonly layOut: PrepareJob; close(): void } {
  const waiting = new Map<number, (laid: PreparedJob) => void>();
  let worker: Worker | null = null;
  let count = 0;
  const end = (why: string): void => {
    worker = null;
    for (const tell of waiting.values()) tell(failed(why));
    waiting.clear();
  };
  function started(): Worker {
    if (worker) return worker;
    const mine = (worker = new Worker(new URL("./lay-out.worker.ts", import.meta.url)));
    mine.unref();
    mine.on("message", (message: PrepareJobAnswer) => {
      const tell = waiting.get(message.id);
      waiting.delete(message.id);
      tell?.("laid" in message ? message.laid : failed(message.trouble));
    });
    mine.on("error", problem => {
      if (worker === mine) end(problem.message);
    });
    mine.on("exit", () => {
      if (worker === mine) end("its thread ended.");
    });
    return mine;
  }
  return {
    layOut: ({ program, robot, start_rad, worldFromBase, cell, dialect }) =>
      new Promise(resolve => {
        const id = count++;
        waiting.set(id, resolve);
        started().postMessage({
          id,
          robot: robot.id,
          own: isOwnRobot(robot) ? robot : null,
          dialect: dialect?.id ?? null,
          program,
          start_rad,
          worldFromBase: worldFromBase ?? null,
          cell: cell ?? null,
        } satisfies PrepareJobRequest);
      }),
    close() {
      void worker?.terminate();
      end("the server is closing.");
    },
  };
}
