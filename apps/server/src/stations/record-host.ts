import { join } from "node:path";
import type { Scheduler } from "@twincell/core";
import type { RobotServer } from "@twincell/protocol";
import { createArchive, type ArchivePort } from "@twincell/recording";
import { zstd } from "@twincell/recording/zstd";
import { recordingFolderOf, recordingsFolder, tidyRecordings } from "../files/recordings-folder.ts";
import { recordStations, type StationRecorder } from "./recorder.ts";

const TICK_S = 0.1;
/** What robots left that are gone is looked through so often. */
const TIDY_S = 3600;

interface Surroundings {
  readonly files: (folder: string) => ArchivePort;
  /** Wall clock, nanoseconds since 1970. */
  readonly clock_ns: () => bigint;
}

/**
 * Records every station of that host to a folder of its own, file after file, until it is closed. When a station can't
 * be recorded everybody who looks at it is told once, and once more when it goes on.
 */
export async function recordServer(
  host: RobotServer,
  folder: string,
  scheduler: Scheduler,
  onTrouble: (sentence: string) => void,
  { files, clock_ns }: Surroundings = { files: recordingsFolder, clock_ns: () => BigInt(Date.now()) * 1_000_000n },
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
      onTrouble(sentence, about) {
        onTrouble(sentence);
        if (about) host.notice(about.station, about.why);
      },
      archive: (station, robot) =>
        createArchive(files(join(folder, recordingFolderOf(station.id))), {
          robot,
          cell: station.name,
          program: "",
          compact: { packing },
          clock_ns,
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
  const tidy = (): void => {
    tidyRecordings(folder, new Set(recorder.recording.map(recordingFolderOf)), Number(clock_ns() / 1_000_000n)).catch(
      (problem: unknown) => {
        onTrouble(`Old recordings stay: ${problem instanceof Error ? problem.message : String(problem)}.`);
      },
    );
  };
  tidy();
  const stopTidying = scheduler.every(TIDY_S, tidy);
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
      stopTidying();
      commander.leave();
      recorder.close();
    },
  };
}
