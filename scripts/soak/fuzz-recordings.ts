/**
 * Damaged recordings for the reader of histories: node --expose-gc scripts/soak/fuzz-recordings.ts [INPUTS] [SEED]. No
 * exception, no input that keeps it busy for a second, no wrong angle at a moment it calls recorded, no growth of
 * memory. The result is kept beside this file.
 */
import { writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { robotById, seededRandom, type JointSample } from "@twincell/core";
import { createRunRecorder, memoryFiles, memorySink, openHistory } from "@twincell/recording";
import { zstd } from "@twincell/recording/zstd";

const INPUTS = Number(process.argv[2] ?? 100_000);
const SEED = Number(process.argv[3] ?? 1);
const robot = robotById("ur10e")!;
const packing = await zstd();
const random = seededRandom(SEED);
const collect = (): number => {
  (globalThis as { gc?: () => void }).gc?.();
  return process.memoryUsage().rss / 1e6;
};
const sampleAt = (k: number): JointSample => ({
  sequence: k,
  time_s: k / 100,
  q_rad: Float64Array.from({ length: 6 }, (_, j) => Math.sin(k / 40 + j)),
  moving: true,
  mode: "automatic",
  safety: k % 70 > 60 ? "guard-stop" : "normal",
  override: 1,
  gripperClosed: false,
  step: `s${Math.floor(k / 50)}`,
  message: "",
  signals: new Map([["part", k % 30 > 15]]),
});
const files = [{ packing }, undefined].map(compact => {
  const sink = memorySink();
  const recorder = createRunRecorder(sink, {
    robot,
    startedAt_ns: 1_795_000_000_000_000_000n,
    program: "p",
    cell: "c",
    chunk_s: 0.3,
    ...(compact ? { compact } : {}),
  });
  for (let k = 0; k < 300; k++) recorder.record(sampleAt(k));
  recorder.event("done", "The run is done.");
  recorder.finish();
  return sink.bytes();
});

let opened = 0;
let refused = 0;
let wrong = 0;
let worst_ms = 0;
const began_ms = performance.now();
let before_MB = 0;
for (let i = 0; i < INPUTS; i++) {
  if (i === Math.min(2000, INPUTS >> 1)) before_MB = collect();
  const whole = files[i % 2]!;
  const spoilt = whole.slice(0, i % 3 === 0 ? Math.floor(random() * whole.length) : whole.length);
  // Mostly in the lengths and heads at both ends, where it hurts most.
  for (let flips = 1 + Math.floor(random() * 8); flips > 0; flips--) {
    const at =
      random() < 0.3
        ? spoilt.length - Math.floor(random() * Math.min(spoilt.length, 2000)) - 1
        : 8 + Math.floor(random() * Math.max(1, spoilt.length - 8));
    if (at >= 0 && at < spoilt.length) spoilt[at] = random() < 0.3 ? 255 : Math.floor(random() * 256);
  }
  if (i % 7 === 0) spoilt.copyWithin(Math.floor(random() * spoilt.length), Math.floor(random() * spoilt.length));
  const from_ms = performance.now();
  const it = await openHistory(memoryFiles([["a.mcap", spoilt]]), { packing });
  if (it.kind === "history") {
    opened++;
    const moment = await it.history.at(3 * random());
    const truth = sampleAt(moment.sequence);
    if (
      moment.recorded &&
      !(moment.sequence < 300 && moment.q_rad.every((q, j) => Math.abs(q - truth.q_rad[j]!) < 1e-6))
    )
      wrong++;
  } else {
    refused++;
    if (!it.sentence.endsWith(".")) wrong++;
  }
  worst_ms = Math.max(worst_ms, performance.now() - from_ms);
}
const report = {
  what: "histories opened and looked at from damaged files",
  date: new Date().toISOString(),
  machine: `${cpus().length} × ${cpus()[0]?.model ?? "unknown"}`,
  seed: SEED,
  inputs: INPUTS,
  opened,
  refused,
  wrong,
  exceptions: 0,
  worst_ms: Math.round(worst_ms),
  grown_MB: Math.round(collect() - before_MB),
  took_s: Math.round((performance.now() - began_ms) / 1000),
};
writeFileSync(new URL("fuzz-recordings.json", import.meta.url), `${JSON.stringify(report, null, 2)}\n`);
process.stdout.write(`${JSON.stringify(report)}\n`);
