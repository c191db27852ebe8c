import { withRobots } from "../hire.ts";
import { openHistory, type FilePort, type OpenedHistory } from "@twincell/recording";
import { zstd } from "@twincell/recording/zstd";
import type { FromRecordingReader, ToRecordingReader } from "../../workers/recording-messages.ts";

/** A recording as the browser holds it: nothing of it is read before it is looked at. */
export interface RecordingFile {
  readonly name: string;
  readonly blob: Blob;
}
/** Opens recordings as one history. */
export type OpenRecordings = (files: readonly RecordingFile[]) => Promise<OpenedHistory>;

export function blobFiles(files: readonly RecordingFile[]): FilePort {
  const byName = new Map(files.map(({ name, blob }) => [name, blob]));
  return {
    list: () => Promise.resolve([...byName].map(([name, blob]) => ({ name, bytes: blob.size }))),
    async read(name, from, length) {
      const blob = byName.get(name);
      if (!blob) throw new Error(`there is no file ${name}`);
      return new Uint8Array(await blob.slice(from, from + length).arrayBuffer());
    },
  };
}

/** Opens them here. What takes time is the index of a file that has none. */
export const openHere: OpenRecordings = async files => openHistory(blobFiles(files), { packing: await zstd() });

/** Finds what is in each file away from the page, in a worker that lives as long as the reading. */
export const openInWorker: OpenRecordings = async files => {
  const worker = withRobots(
    new Worker(new URL("../../workers/recording.worker.ts", import.meta.url), { type: "module" }),
  );
  const waiting = new Map<string, (said: FromRecordingReader["said"]) => void>();
  worker.addEventListener("message", ({ data }: MessageEvent<FromRecordingReader>) => {
    waiting.get(data.name)?.(data.said);
  });
  worker.addEventListener("error", event => {
    const sentence = `The recording cannot be read: ${event.message || "the reader stopped without saying why"}.`;
    for (const settle of waiting.values()) settle({ kind: "not-a-recording", sentence });
  });
  try {
    return await openHistory(blobFiles(files), {
      packing: await zstd(),
      catalogue: ({ name }) =>
        new Promise(resolve => {
          waiting.set(name, resolve);
          worker.postMessage({ name, blob: files.find(file => file.name === name)!.blob } satisfies ToRecordingReader);
        }),
    });
  } finally {
    worker.terminate();
  }
};
