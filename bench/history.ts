import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { robotById, seededRandom, type JointSample, type Robot } from "@twincell/core";
import { createArchive, createRunRecorder, openHistory, type ByteSink, type Compact } from "@twincell/recording";
import { zstd } from "@twincell/recording/zstd";
import { recordingsFolder } from "@twincell/server";
import { figure, type Bench, type Figure } from "./figure.ts";

const HZ = 100;
const DAY_S = 86_400;
const counting = (): ByteSink => {
  let position = 0;
  return {
    write(bytes) {
      position += bytes.length;
    },
    get position() {
      return position;
    },
  };
};

/** What one robot's day weighs, in chunks as an archive writes them, and how long it takes to find a moment of it. */
export const run: Bench = async () => {
  const robot = robotById("ur10e");
  if (!robot) throw new Error("The library has no ur10e.");
  const packing = await zstd();
  return [
    ...sizeOf(
      "history/moving",
      robot,
      { packing },
      1800,
      (k, j) => 0.3 * j + (0.8 + 0.1 * j) * Math.sin(((0.5 + 0.13 * j) * k) / HZ + j),
      "every joint moves all the time, 100 Hz; budget 600",
    ),
    ...sizeOf("history/standing", robot, { packing }, 3600, (_, j) => 0.3 * j, "100 Hz; budget 60"),
    ...sizeOf(
      "history/standing-noise",
      robot,
      { packing, still: 5e-5 },
      3600,
      (k, j) => 0.3 * j + 2e-5 * noise(k, j),
      "encoders that flicker by 2e-5 rad, stillness band 5e-5 rad; budget 60",
    ),
    ...(await seeking(robot, { packing })),
  ];
};

const CYCLE = 30 * HZ;
const PAUSE = 4 * HZ;
/**
 * A whole day at 100 Hz on the disk, in files of an hour, cycles of 30 s with an alarm in one of fifty; then any moment
 * of it.
 */
async function seeking(robot: Robot, compact: Compact): Promise<Figure[]> {
  const folder = mkdtempSync(join(tmpdir(), "twincell-day-"));
  const port = recordingsFolder(folder);
  try {
    let k = 0;
    const archive = createArchive(port, {
      robot,
      cell: "bench",
      program: "bench",
      compact,
      clock_ns: () => 1_795_000_000_000_000_000n + BigInt(k) * BigInt(1e9 / HZ),
    });
    const q_rad = new Float64Array(robot.arm.joints.length);
    const begun_ms = performance.now();
    const sample = {
      sequence: 0,
      time_s: 0,
      q_rad,
      moving: true,
      mode: "automatic",
      safety: "normal",
      override: 1,
      gripperClosed: false,
      step: "a",
      message: "",
    } as { -readonly [K in keyof JointSample]: JointSample[K] };
    for (; k < DAY_S * HZ; k++) {
      const inCycle = k % CYCLE;
      const cycle = Math.floor(k / CYCLE);
      const t_s = Math.min(inCycle, CYCLE - PAUSE) / HZ;
      sample.sequence = k;
      sample.time_s = k / HZ;
      sample.moving = inCycle < CYCLE - PAUSE;
      sample.step = inCycle < 1000 ? "a" : inCycle < 2000 ? "b" : "c";
      sample.safety = cycle % 50 === 49 && inCycle >= CYCLE - PAUSE ? "protective-stop" : "normal";
      for (let j = 0; j < q_rad.length; j++)
        q_rad[j] = 0.3 * j + 0.9 * Math.sin((2 * Math.PI * (j + 1) * t_s * HZ) / (CYCLE - PAUSE));
      archive.record(sample);
    }
    archive.close();
    const made_s = (performance.now() - begun_ms) / 1000;
    const opening_ms: number[] = [];
    const seek_ms: number[] = [];
    const alarm_ms: number[] = [];
    const random = seededRandom(17);
    let wrong = 0;
    let marks = "";
    for (let round = 0; round < 5; round++) {
      const from_ms = performance.now();
      const opened = await openHistory(port, compact);
      if (opened.kind !== "history") throw new Error(opened.sentence);
      const { history } = opened;
      opening_ms.push(performance.now() - from_ms);
      marks = `${history.stretches.length} files, ${history.cycles.length} cycles, ${history.marks.length} marks`;
      for (let i = 0; i < 200; i++) {
        const to_s = random() * history.duration_s;
        const sought_ms = performance.now();
        const moment = await history.at(to_s);
        seek_ms.push(performance.now() - sought_ms);
        if (!moment.recorded || Math.abs(moment.sequence / HZ - to_s) > 1) wrong++;
      }
      const alarmFrom_ms = performance.now();
      const alarm = history.lastAlarm(history.duration_s);
      if (!alarm || (await history.at(alarm.at_s)).state.safety !== "protective-stop") wrong++;
      alarm_ms.push(performance.now() - alarmFrom_ms);
    }
    const bytes = (await port.list()).reduce((sum, file) => sum + file.bytes, 0);
    return [
      figure(
        "history/day",
        "MB",
        [bytes / 1e6],
        `24 h in cycles of 30 s, 26 of them in motion; ${marks}; made in ${made_s.toFixed(0)} s`,
      ),
      figure("history/open", "ms", opening_ms, "24 h in files of an hour"),
      figure("history/seek", "ms", seek_ms, "any moment of 24 h at 100 Hz, from the disk; budget 100"),
      figure("history/last-alarm", "ms", alarm_ms, "found and looked at"),
      figure("history/wrong", "moments", [wrong], "budget 0"),
    ];
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** A hash as noise, −1 … 1: the same in every run. */
function noise(k: number, j: number): number {
  let hash = Math.imul(k * 31 + j + 1, 0x9e3779b1);
  hash = Math.imul(hash ^ (hash >>> 15), 0x85ebca6b);
  return ((hash ^ (hash >>> 13)) >>> 0) / 2 ** 31 - 1;
}

function sizeOf(
  name: string,
  robot: Robot,
  compact: Compact,
  seconds: number,
  angle: (k: number, joint: number) => number,
  note: string,
): Figure[] {
  const sink = counting();
  const recorder = createRunRecorder(sink, {
    robot,
    startedAt_ns: 1_795_000_000_123_456_789n,
    program: "bench",
    cell: "bench",
    compact,
    chunk_s: 0.8,
  });
  const q_rad = new Float64Array(robot.arm.joints.length);
  const moving = name.endsWith("moving");
  const sample = {
    sequence: 0,
    time_s: 0,
    q_rad,
    moving,
    mode: "automatic" as const,
    safety: "normal" as const,
    override: 1,
    gripperClosed: false,
    step: "a",
    message: "",
  } satisfies JointSample;
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
    figure(`${name}-day`, "MB", [(sink.position * DAY_S) / seconds / 1e6], note),
    figure(`${name}-write`, "msg/s", [Math.round((seconds * HZ) / took_s)]),
  ];
}
