import { robotById, type JointSample } from "@twincell/core";
import { createRunRecorder, readRecording, type ByteSink } from "@twincell/recording";
import { figure, type Bench } from "./figure.ts";

const MESSAGES = 200_000;
const ROUNDS = 9;

/**
 * Joint samples recorded per second, one thread, to memory: 6 axes, state changes every half second, 128 KiB chunks
 * with checksums and indexes. One file of the last round is read back and every sample counted: a lost one is a fault.
 */
export const run: Bench = () => {
  const robot = robotById("staubli_rx90l");
  if (!robot) throw new Error("The library has no staubli_rx90l.");
  const rates: number[] = [];
  let file = new Uint8Array(0);
  for (let round = 0; round < ROUNDS; round++) {
    const pieces: Uint8Array[] = [];
    let position = 0;
    const sink: ByteSink = {
      write(bytes) {
        pieces.push(bytes);
        position += bytes.length;
      },
      get position() {
        return position;
      },
    };
    const q_rad = new Float64Array(6);
    const sample = {
      sequence: 0,
      time_s: 0,
      q_rad,
      moving: true,
      mode: "automatic" as const,
      safety: "normal" as const,
      override: 1,
      gripperClosed: false,
      step: "a",
      message: "",
    };
    const begun_ms = performance.now();
    const recorder = createRunRecorder(sink, {
      robot,
      startedAt_ns: 1_795_000_000_123_456_789n,
      program: "bench",
      cell: "bench",
    });
    for (let k = 0; k < MESSAGES; k++) {
      sample.sequence = k;
      sample.time_s = 0.001 * k;
      if (k % 500 === 0) sample.step = k % 1000 === 0 ? "a" : "b";
      for (let j = 0; j < 6; j++) q_rad[j] = 1e-6 * k * (j + 1);
      recorder.record(sample satisfies JointSample);
    }
    recorder.finish();
    rates.push(MESSAGES / ((performance.now() - begun_ms) / 1000));
    file = new Uint8Array(position);
    let at = 0;
    for (const piece of pieces) {
      file.set(piece, at);
      at += piece.length;
    }
  }
  let lost = 0;
  const readRates = Array.from({ length: ROUNDS }, () => {
    const begun_ms = performance.now();
    const read = readRecording(file);
    const seconds = (performance.now() - begun_ms) / 1000;
    lost = Math.max(lost, MESSAGES - (read.kind === "read" ? read.data.times_s.length : 0));
    return Math.round(MESSAGES / seconds);
  });
  return Promise.resolve([
    figure(
      "record/write",
      "msg/s",
      rates.map(Math.round),
      "budget 500,000; mcap Python 0.39 M, foxglove-sdk (Rust) 1.27 M",
    ),
    figure("record/lost", "msg", [lost]),
    figure("record/read", "msg/s", readRates),
    figure("record/size", "B/msg", [file.length / MESSAGES]),
  ]);
};
