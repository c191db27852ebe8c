import "./know-robots.ts";
import { catalogue } from "@twincell/recording";
import { zstd } from "@twincell/recording/zstd";
import { blobFiles } from "../runtime/history/recordings.ts";
import type { FromRecordingReader, ToRecordingReader } from "./recording-messages.ts";

addEventListener("message", ({ data: file }: MessageEvent<ToRecordingReader>) => {
  const answer = (said: FromRecordingReader["said"]): void => {
    postMessage({ name: file.name, said } satisfies FromRecordingReader);
  };
  zstd()
    .then(packing => catalogue(blobFiles([file]), { name: file.name, bytes: file.blob.size }, packing))
    .then(answer, (problem: unknown) => {
      answer({
        kind: "not-a-recording",
        sentence: `The recording cannot be read: ${problem instanceof Error ? problem.message : String(problem)}.`,
      });
    });
});
