import { manualScheduler, robotById, seededRandom, type JointSample } from "@twincell/core";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { describe, expect, test } from "vitest";
import {
  createRunRecorder,
  memorySink,
  openRecording,
  readRecording,
  type ByteSink,
  type RecordedRun,
  type RecordingData,
  type RunHeader,
} from "./index.ts";

const robot = robotById("staubli_rx90l")!;
const n = robot.arm.joints.length;
const startedAt_ns = 1_795_237_199_999_999_123n;
const header: RunHeader = {
  robot,
  startedAt_ns,
  program: "Edge trace",
  cell: "Zelle 1 – α",
  chunkBytes: 4096,
  chunk_s: 1,
};

type Mutable = { -readonly [K in keyof JointSample]: JointSample[K] };
/** A run of `count` samples each 4 ms; samples are lent and spoiled, as a controller may do. */
function aRun(count: number, sink = memorySink(), options: Partial<RunHeader> = {}) {
  const recorder = createRunRecorder(sink, { ...header, ...options });
  const random = seededRandom(7);
  const written: Mutable[] = [];
  for (let k = 0; k < count; k++) {
    const sample: Mutable = {
      sequence: k + 100,
      time_s: 5 + 0.004 * k,
      q_rad: Float64Array.from({ length: n }, () => 6 * random() - 3),
      moving: k % 50 > 10,
      mode: k > count / 2 ? "manual" : "automatic",
      safety: k > 0.9 * count ? "guard-stop" : "normal",
      override: k % 300 > 150 ? 0.5 : 1,
      gripperClosed: k % 200 > 100,
      step: `step ${Math.floor(k / 70)}`,
      message: k > 0.9 * count ? "Schutztür offen – „Halt“ 🙂" : "",
    };
    written.push({ ...sample, q_rad: Float64Array.from(sample.q_rad) });
    recorder.record(sample);
    sample.q_rad.fill(NaN);
    sample.step = "spoiled";
    if (k === 40) recorder.event("info", "Ein Ereignis — mit Umlaut.");
    if (k === 60) recorder.event("stop", "The robot was stopped.", "warning");
  }
  return { sink, recorder, written };
}
const dataOf = (bytes: Uint8Array): RecordingData => {
  const read = readRecording(bytes);
  if (read.kind !== "read") throw new Error(read.sentence);
  return read.data;
};
function opened(bytes: Uint8Array, scheduler = manualScheduler()): RecordedRun {
  const it = openRecording(bytes, { scheduler });
  if (it.kind !== "recording") throw new Error(it.sentence);
  return it.recording;
}
/** Every sample that was read is one that was written, bit for bit, in order. */
function expectSubsequence(data: RecordingData, written: readonly JointSample[]): void {
  const byNumber = new Map(written.map(sample => [sample.sequence, sample]));
  data.times_s.forEach((time_s, i) => {
    const sample = byNumber.get(data.sequences[i]!)!;
    const state = data.states[data.stateOf[i]!]!;
    const same =
      Math.abs(time_s - (sample.time_s - 5)) < 1e-9 &&
      (i === 0 || data.sequences[i]! > data.sequences[i - 1]!) &&
      sample.q_rad.every((q, j) => data.q_rad[i * n + j] === q) &&
      state.moving === sample.moving &&
      state.mode === sample.mode &&
      state.safety === sample.safety &&
      state.override === sample.override &&
      state.gripperClosed === sample.gripperClosed &&
      state.step === sample.step &&
      state.message === sample.message;
    if (!same) throw new Error(`Sample ${i} was not recorded like that.`);
  });
}
/** How many samples each whole chunk holds and where it ends in the file. */
function chunksOf(bytes: Uint8Array): { start: number; end: number; samples: number }[] {
  const chunks: { start: number; end: number; samples: number }[] = [];
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  for (let at = 8; at + 9 < bytes.length; ) {
    const end = at + 9 + Number(view.getBigUint64(at + 1, true));
    if (bytes[at] === 6) {
      const reader = new McapStreamReader({ noMagicPrefix: true });
      reader.append(bytes.subarray(at, end));
      let samples = 0;
      for (let record = reader.nextRecord(); record; record = reader.nextRecord())
        if (record.type === "Message" && record.channelId === 0) samples++;
      chunks.push({ start: at, end, samples });
    }
    at = end;
  }
  return chunks;
}

describe("recording", () => {
  test("T-54 what was recorded is read back bit for bit, with states and events", () => {
    const { sink, recorder, written } = aRun(2000);
    recorder.finish();
    const data = dataOf(sink.bytes());
    expect(data).toMatchObject({
      robot: robot.id,
      robotName: robot.name,
      program: "Edge trace",
      cell: "Zelle 1 – α",
      startedAt_ns,
      joints: 6,
      complete: true,
      damaged: 0,
    });
    expect(data.times_s.length).toBe(2000);
    expectSubsequence(data, written);
    expect(data.events).toEqual([
      { at_s: 0.16, kind: "info", level: "info", sentence: "Ein Ereignis — mit Umlaut." },
      { at_s: 0.24, kind: "stop", level: "warning", sentence: "The robot was stopped." },
    ]);
  });

  test("T-54 travelling back: at any time the pose is the one in the log", () => {
    const { sink, recorder, written } = aRun(1000);
    recorder.finish();
    const run = opened(sink.bytes());
    const random = seededRandom(3);
    let seen: JointSample | null = null;
    run.onSample(lent => {
      seen = lent;
    });
    const angles = new Float64Array(n);
    for (let i = 0; i < 500; i++) {
      const to_s = random() * 4.2 - 0.1;
      run.timeline.seek(to_s);
      const index = Math.min(Math.max(Math.floor(to_s / 0.004 + 1e-9), 0), 999);
      const sample = written[index]!;
      expect(seen).toMatchObject({
        sequence: sample.sequence,
        step: sample.step,
        mode: sample.mode,
        gripperClosed: sample.gripperClosed,
      });
      expect(seen!.q_rad).toEqual(sample.q_rad);
      expect(run.anglesAt(to_s, angles)).toEqual(sample.q_rad);
    }
    expect(run.duration_s).toBeCloseTo(3.996, 9);
    run.anglesAt(0.006, angles, "interpolate");
    angles.forEach((q, j) => expect(q).toBeCloseTo((written[1]!.q_rad[j]! + written[2]!.q_rad[j]!) / 2, 6));
  });

  test("plays at any speed, backwards too, and pauses at the end", () => {
    const { sink, recorder } = aRun(1000);
    recorder.finish();
    const scheduler = manualScheduler();
    const run = opened(sink.bytes(), scheduler);
    run.timeline.play();
    scheduler.advance(1);
    expect(run.position_s).toBeCloseTo(1, 1);
    run.timeline.setSpeed(2);
    scheduler.advance(1);
    expect(run.position_s).toBeCloseTo(3, 1);
    scheduler.advance(1);
    expect(run.playing).toBe(false);
    expect(run.position_s).toBe(run.duration_s);
    run.timeline.setSpeed(-1);
    run.timeline.play();
    scheduler.advance(1);
    expect(run.position_s).toBeCloseTo(run.duration_s - 1, 1);
    run.timeline.pause();
    const stood = run.position_s;
    scheduler.advance(1);
    expect(run.position_s).toBe(stood);
    run.timeline.setSpeed(1);
    run.timeline.seek(run.duration_s);
    run.timeline.play();
    scheduler.advance(0.1);
    expect(run.position_s).toBeLessThan(0.2);
    run.close();
  });

  test("the library's own readers agree, and its checksums hold", async () => {
    const { sink, recorder } = aRun(1500);
    recorder.finish();
    const bytes = sink.bytes();
    const reader = new McapStreamReader({ validateCrcs: true });
    reader.append(bytes);
    let streamed = 0;
    for (let record = reader.nextRecord(); record; record = reader.nextRecord())
      if (record.type === "Message") streamed++;
    expect(reader.done()).toBe(true);

    const indexed = await McapIndexedReader.Initialize({
      readable: {
        size: () => Promise.resolve(BigInt(bytes.length)),
        read: (offset, size) => Promise.resolve(bytes.slice(Number(offset), Number(offset + size))),
      },
    });
    expect(indexed.statistics?.messageCount).toBe(BigInt(streamed));
    expect([...indexed.channelsById.values()].map(channel => channel.topic)).toEqual([
      "/joint_states",
      "/robot_state",
      "/events",
      "/alarms",
    ]);
    expect(indexed.metadataIndexes.map(index => index.name)).toEqual(["twincell.run", "twincell.digest"]);
    for await (const metadata of indexed.readMetadata({ name: "twincell.run" }))
      expect(metadata.metadata.get("robot")).toBe(robot.id);
    let last = 0n;
    let joints = 0;
    for await (const message of indexed.readMessages({ topics: ["/joint_states"] })) {
      expect(message.logTime).toBeGreaterThanOrEqual(last);
      last = message.logTime;
      const stamp = new DataView(message.data.buffer, message.data.byteOffset + 4);
      expect(stamp.getUint32(4, true)).toBeLessThan(1e9);
      expect(BigInt(stamp.getInt32(0, true)) * 1_000_000_000n + BigInt(stamp.getUint32(4, true))).toBe(last);
      joints++;
    }
    expect(joints).toBe(1500);
    expect(last).toBe(startedAt_ns + 1499n * 4_000_000n);
  });

  test("a file cut anywhere loses the open chunk and nothing else", () => {
    const { sink, recorder, written } = aRun(200);
    recorder.finish();
    const bytes = sink.bytes();
    const chunks = chunksOf(bytes);
    const random = seededRandom(11);
    expect(chunks.length).toBeGreaterThan(5);
    const cuts = [
      ...chunks.flatMap(({ start, end }) => [start - 1, start, start + 1, start + 9, end - 1, end, end + 1]),
      ...Array.from({ length: 100 }, () => Math.floor(random() * bytes.length)),
      bytes.length - 1,
      bytes.length - 20,
    ];
    for (const cut of cuts) {
      const whole = chunks.filter(({ end }) => end <= cut).reduce((sum, { samples }) => sum + samples, 0);
      const read = readRecording(bytes.slice(0, cut));
      if (whole === 0) {
        expect(read.kind).toBe("not-a-recording");
        continue;
      }
      if (read.kind !== "read") throw new Error(`Cut at ${cut}: ${read.sentence}`);
      expect(read.data.times_s.length, `cut at ${cut}`).toBe(whole);
      expect(read.data.complete).toBe(false);
      expect(read.data.damaged).toBe(0);
      expectSubsequence(read.data, written);
    }
  });

  test("a flipped byte anywhere costs at most the chunk it is in, and never gives a wrong angle", () => {
    const { sink, recorder, written } = aRun(300);
    recorder.finish();
    const bytes = sink.bytes();
    const chunks = chunksOf(bytes);
    const random = seededRandom(5);
    const most = Math.max(...chunks.map(({ samples }) => samples));
    const places = [
      ...chunks.flatMap(({ start }) => Array.from({ length: 60 }, (_, i) => start + i)),
      ...Array.from({ length: 300 }, () => 8 + Math.floor(random() * (bytes.length - 8))),
    ];
    for (const place of places) {
      const damaged = bytes.slice();
      damaged[place]! ^= 1 << Math.floor(random() * 8);
      const read = readRecording(damaged);
      if (read.kind !== "read") throw new Error(`Flipped at ${place}: ${read.sentence}`);
      expect(read.data.times_s.length, `flipped at ${place}`).toBeGreaterThanOrEqual(300 - most);
      if (read.data.times_s.length < 300) expect(read.data.damaged === 1 || !read.data.complete).toBe(true);
      expectSubsequence(read.data, written);
    }
  });

  test("a second is the most that is in danger: chunks close by time as well as by size", () => {
    const sizes: number[] = [];
    const sink: ByteSink = {
      write(bytes) {
        sizes.push(bytes.length);
      },
      position: 0,
    };
    const recorder = createRunRecorder(sink, { ...header, chunkBytes: 1 << 20 });
    const q_rad = new Float64Array(n);
    const before = sizes.length;
    for (let k = 0; k < 1000; k++)
      recorder.record({
        sequence: k,
        time_s: 0.004 * k,
        q_rad,
        moving: false,
        mode: "automatic",
        safety: "normal",
        override: 1,
        gripperClosed: false,
        step: "",
        message: "",
      });
    expect(sizes.slice(before).filter(size => size > 10_000).length).toBe(3);
  });

  test("a full disk ends the recording with one sentence, and what was written opens", () => {
    const kept = memorySink();
    const small: ByteSink = {
      write(bytes) {
        if (kept.position + bytes.length > 30_000) throw new Error("the disk is full.");
        kept.write(bytes);
      },
      get position() {
        return kept.position;
      },
    };
    const { recorder, written } = aRun(1000, {
      ...small,
      get position() {
        return kept.position;
      },
      bytes: () => kept.bytes(),
    });
    recorder.finish();
    expect(recorder.problem).toMatchObject({ code: "recording.no-room" });
    expect(recorder.problem?.sentence).toMatch(/^Recording ended after \d+ bytes: the disk is full\.$/);
    const data = dataOf(kept.bytes());
    expect(data.times_s.length).toBeGreaterThan(50);
    expect(data.complete).toBe(false);
    expectSubsequence(data, written);
  });

  test("a clock that jumps back does not make the file run backwards", () => {
    const sink = memorySink();
    const recorder = createRunRecorder(sink, header);
    [0, 0.1, 0.05, 0.2].forEach((time_s, sequence) =>
      recorder.record({
        sequence,
        time_s,
        q_rad: new Float64Array(n),
        moving: false,
        mode: "automatic",
        safety: "normal",
        override: 1,
        gripperClosed: false,
        step: "",
        message: "",
      }),
    );
    recorder.finish();
    expect([...dataOf(sink.bytes()).times_s]).toEqual([0, 0.1, 0.1, 0.2]);
  });

  test("what is no recording is said so", () => {
    const { sink, recorder } = aRun(0);
    const scheduler = manualScheduler();
    const sentence = (bytes: Uint8Array): string => {
      const it = openRecording(bytes, { scheduler, robot: () => undefined });
      return it.kind === "not-a-recording" ? it.sentence : "opened";
    };
    expect(sentence(new Uint8Array(0))).toBe("The file is empty.");
    expect(sentence(Uint8Array.from("hello, world".repeat(9), c => c.charCodeAt(0)))).toBe(
      "The file does not begin like an MCAP file.",
    );
    recorder.finish();
    expect(sentence(sink.bytes())).toBe("The recording ends before its first sample.");
    const full = aRun(10);
    full.recorder.finish();
    expect(sentence(full.sink.bytes())).toBe("The recording is of Stäubli RX90L, a robot that is not known here.");
    const random = seededRandom(1);
    for (let i = 0; i < 200; i++) {
      const noise = Uint8Array.from({ length: 300 }, () => Math.floor(random() * 256));
      noise.set([137, 77, 67, 65, 80, 48, 13, 10]);
      expect(readRecording(noise).kind).toBe("not-a-recording");
    }
  });
});
