import { robotById, type JointSample, type Robot } from "@twincell/core";
import { createRunRecorder, type ByteSink, type Compact } from "@twincell/recording";
import { zstd } from "@twincell/recording/zstd";
import { figure, type Bench, type Figure } from "./figure.ts";

const HZ = 100, DAY_S = 86_400;
const counting = (): ByteSink => {
  let position = 0;
  return { write(bytes) { position += bytes.length; }, get position() { return position; } };
};

/** What one robot's day weighs and how long it takes to find a moment of it. */
export const run: Bench = async () => {
  const robot = robotById("ur10e");
  if (!robot) throw new Error("The library has no ur10e.");
  const packing = await zstd();
  return [
    ...sizeOf("history/moving", robot, { packing }, 1800, (k, j) => 0.3 * j + (0.8 + 0.1 * j) * Math.sin((0.5 + 0.13 * j) * k / HZ + j), "every joint moves all the time, 100 Hz; budget 600"),
    ...sizeOf("history/standing", robot, { packing }, 3600, (_, j) => 0.3 * j, "100 Hz; budget 60"),
    ...sizeOf("history/standing-noise", robot, { packing, still: 5e-5 }, 3600, (k, j) => 0.3 * j + 2e-5 * noise(k, j), "encoders that flicker by 2e-5 rad, stillness band 5e-5 rad; budget 60"),
  ];
};

/** A hash as noise, −1 … 1: the same in every run. */
function noise(k: number, j: number): number {
  let hash = Math.imul(k * 31 + j + 1, 0x9e3779b1);
  hash = Math.imul(hash ^ (hash >>> 15), 0x85ebca6b);
  return ((hash ^ (hash >>> 13)) >>> 0) / 2 ** 31 - 1;
}

function sizeOf(name: string, robot: Robot, compact: Compact, seconds: number, angle: (k: number, joint: number) => number, note: string): Figure[] {
  const sink = counting(), recorder = createRunRecorder(sink, { robot, startedAt_ns: 1_795_000_000_123_456_789n, program: "bench", cell: "bench", compact });
  const q_rad = new Float64Array(robot.arm.joints.length), moving = name.endsWith("moving");
  const sample = { sequence: 0, time_s: 0, q_rad, moving, mode: "automatic" as const, safety: "normal" as const, override: 1, gripperClosed: false, step: "a", message: "" } satisfies JointSample;
  const begun_ms = performance.now();
  for (let k = 0; k < seconds * HZ; k++) {
    sample.sequence = k;
    sample.time_s = k / HZ;
    for (let j = 0; j < q_rad.length; j++) q_rad[j] = angle(k, j);
    recorder.record(sample);
  }
  recorder.finish();
  const took_s = (performance.now() - begun_ms) / 1000;
  return [
    figure(`${name}-day`, "MB", [sink.position * DAY_S / seconds / 1e6], note),
    figure(`${name}-write`, "msg/s", [Math.round(seconds * HZ / took_s)]),
  ];
}
