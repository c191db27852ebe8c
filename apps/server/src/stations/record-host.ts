import { join } from "node:path";
import type { Scheduler } from "@twincell/core";
import type { RobotServer } from "@twincell/protocol";
import { createArchive } from "@twincell/recording";
import { zstd } from "@twincell/recording/zstd";
import { recordingsFolder } from "../files/recordings-folder.ts";
import { recordStations, type StationRecorder } from "./recorder.ts";

const TICK_S = 0.1;

/** Records every station of that host to a folder of its own, file after file, until it is closed. */
export async function recordServer(
  host: RobotServer,
  folder: string,
  scheduler: Scheduler,
  onTrouble: (sentence: string) => void,
): Promise<StationRecorder> {
  const packing = await zstd();
  const recorder: StationRecorder = recordStations(
    {
      send: text => {
        commander.hear(text);
      },
      close: () => undefined,
    },
    {
      now_s: scheduler.now_s,
      onTrouble,
      archive: (station, robot) =>
        createArchive(recordingsFolder(join(folder, station.id.replace(/[^\w-]/g, "_"))), {
          robot,
          cell: station.name,
          program: "",
          compact: { packing },
          clock_ns: () => BigInt(Date.now()) * 1_000_000n,
        }),
    },
  );
  const heard: string[] = [];
  let ready = false;
  const commander = host.join("recorder", {
    send: text => {
      if (ready) recorder.hear(text);
      else heard.push(text);
    },
    close: () => undefined,
  });
  ready = true;
  for (const text of heard) recorder.hear(text);
  const stop = scheduler.every(TICK_S, () => {
    recorder.tick().catch((problem: unknown) => {
      onTrouble(`Recordings could not be tidied: ${problem instanceof Error ? problem.message : String(problem)}.`);
    });
  });
  return {
    ...recorder,
    get recording() {
      return recorder.recording;
    },
    close() {
      stop();
      commander.leave();
      recorder.close();
    },
  };
}
