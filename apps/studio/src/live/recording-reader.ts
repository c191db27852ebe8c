import type { Read } from "@twincell/recording";
import type { FromRecordingReader, ToRecordingReader } from "../workers/recording-messages.ts";

/** Takes a recording apart; the bytes are given away. */
export type ReadRecording = (bytes: Uint8Array<ArrayBuffer>) => Promise<Read>;

/** Away from the page, in a worker that lives as long as the reading. */
export const readInWorker: ReadRecording = bytes => new Promise(resolve => {
  const worker = new Worker(new URL("../workers/recording.worker.ts", import.meta.url), { type: "module" });
  const end = (read: Read): void => { worker.terminate(); resolve(read); };
  worker.addEventListener("message", ({ data }: MessageEvent<FromRecordingReader>) => { end(data); });
  worker.addEventListener("error", event => { end({ kind: "not-a-recording", sentence: `The recording cannot be read: ${event.message || "the reader stopped without saying why"}.` }); });
  worker.postMessage(bytes satisfies ToRecordingReader, [bytes.buffer]);
});
