import { readRecording } from "@twincell/recording";
import type { FromRecordingReader, ToRecordingReader } from "./recording-messages.ts";

addEventListener("message", ({ data }: MessageEvent<ToRecordingReader>) => {
  let answer: FromRecordingReader;
  try {
    answer = readRecording(data);
  } catch (trouble) {
    answer = { kind: "not-a-recording", sentence: `The recording cannot be read: ${trouble instanceof Error ? trouble.message : String(trouble)}.` };
  }
  // The arrays are handed over, not copied.
  const arrays = answer.kind === "read" ? [answer.data.times_s, answer.data.q_rad, answer.data.sequences, answer.data.stateOf] : [];
  postMessage(answer, { transfer: arrays.flatMap(({ buffer }) => (buffer instanceof ArrayBuffer ? [buffer] : [])) });
});
