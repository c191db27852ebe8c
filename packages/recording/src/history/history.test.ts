import { robotById, seededRandom, type JointSample } from "@twincell/core";
import { describe, expect, test } from "vitest";
import {
  createArchive,
  createRunRecorder,
  expired,
  fileName,
  fileTime_ms,
  memoryFiles,
  memorySink,
  openHistory,
  QUANTUM,
  type ArchivePort,
  type History,
  type Keeping,
} from "../index.ts";
import { zstd } from "../zstd/index.ts";

const robot = robotById("ur10e")!;
const n = robot.arm.joints.length;
const packing = await zstd();
const START_NS = 1_795_237_199_999_999_123n;
/** A robot that goes round in cycles of 20 s, each of four steps, with an alarm in every fifth. */
function sampleAt(k: number): JointSample {
  const t_s = 0.01 * k;
  const inCycle = t_s % 20;
  const cycle = Math.floor(t_s / 20);
  const alarm = cycle % 5 === 4 && inCycle >= 7 && inCycle < 9;
  return {
    sequence: k,
    time_s: 1000 + t_s,
    q_rad: Float64Array.from(
      { length: n },
      (_, j) => (1 + 0.001 * cycle) * Math.sin(((2 * Math.PI * inCycle) / 20) * (j + 1)),
    ),
    moving: !alarm,
    mode: "automatic",
    safety: alarm ? "protective-stop" : "normal",
    override: 1,
    gripperClosed: inCycle > 10,
    step: `s${1 + Math.floor(inCycle / 5)}`,
    message: alarm ? `Contact in cycle ${cycle}.` : "",
    signals: new Map<string, boolean | number>([
      ["part", inCycle > 10],
      ["count", cycle],
    ]),
  };
}
/** The stream recorded file after file, as a source with its own clock gives it. */
function recorded(samples: number, keeping: Partial<Keeping> = {}, port: ArchivePort = memoryFiles()) {
  let k = 0;
  const archive = createArchive(port, {
    robot,
    cell: "Cell",
    program: "Palette",
    compact: { packing },
    clock_ns: () => START_NS + BigInt(k) * 10_000_000n,
    keeping,
  });
  archive.note("cell", { name: "Cell", version: "v1" });
  for (; k < samples; k++) archive.record(sampleAt(k));
  return { port, archive };
}
async function opened(port: ArchivePort): Promise<History> {
  const it = await openHistory(port, { packing });
  if (it.kind !== "history") throw new Error(it.sentence);
  return it.history;
}

describe("history", () => {
  test("X-43 hours in many files are one history: any instant is what was recorded then", async () => {
    const { port, archive } = recorded(60_000, { file_s: 120 });
    archive.close();
    const history = await opened(port);
    const random = seededRandom(5);
    expect(history.stretches.length).toBe(5);
    expect(history.duration_s).toBeCloseTo(599.99, 1);
    expect(history.troubles).toEqual([]);
    for (let i = 0; i < 300; i++) {
      const moment = await history.at(random() * 599.9);
      const k = moment.sequence;
      const sample = sampleAt(k);
      expect(Math.abs(moment.t_s - 0.01 * k)).toBeLessThan(0.02);
      expect(moment).toMatchObject({
        recorded: true,
        state: { step: sample.step, safety: sample.safety, gripperClosed: sample.gripperClosed },
        signals: Object.fromEntries(sample.signals!),
      });
      sample.q_rad.forEach((q, j) => {
        expect(Math.abs(moment.q_rad[j]! - q)).toBeLessThanOrEqual(QUANTUM / 2);
      });
      expect(history.peek(moment.t_s)).toEqual(moment);
    }
  });

  test("jump to the last alarm, and the one before", async () => {
    const { port, archive } = recorded(40_000, { file_s: 90 });
    archive.close();
    const history = await opened(port);
    const last = history.lastAlarm(history.duration_s)!;
    expect(last).toMatchObject({ kind: "alarm", code: "safety.protective-stop", sentence: "Contact in cycle 19." });
    expect(last.at_s).toBeCloseTo(19 * 20 + 7, 1);
    expect((await history.at(last.at_s)).state.safety).toBe("protective-stop");
    expect(history.lastAlarm(last.at_s)).toMatchObject({ sentence: "Contact in cycle 14." });
    expect(history.lastAlarm(50)).toBeNull();
  });

  test("cycles begin with the first step, also across the border of two files", async () => {
    const { port, archive } = recorded(40_000, { file_s: 90 });
    archive.close();
    const { cycles } = await opened(port);
    expect(cycles.length).toBe(20);
    cycles.forEach((cycle, i) => {
      expect(cycle.from_s).toBeCloseTo(20 * i, 1);
      expect(cycle.to_s).toBeCloseTo(i < 19 ? 20 * (i + 1) : 399.99, 1);
      expect(cycle.ending).toBe(i < 19 ? "again" : "open");
    });
  });

  test("a file that was cut off is there up to its end, and the rest with it", async () => {
    const { port } = recorded(20_000, { file_s: 60 });
    // Nobody closed the archive: the last file has no index.
    const history = await opened(port);
    const last = history.stretches.at(-1)!;
    expect(last.complete).toBe(false);
    expect(history.troubles).toEqual([`${last.name} was cut off; it is here up to its last second.`]);
    expect(200 - history.duration_s).toBeLessThan(1);
    expect(history.cycles.length).toBe(10);
    expect(history.marks.filter(mark => mark.kind === "alarm").map(mark => mark.sentence)).toEqual([
      "Contact in cycle 4.",
      "Contact in cycle 9.",
    ]);
  });

  test("what was not recorded is said: a moment in a gap is the one before it", async () => {
    const port = memoryFiles();
    for (const [name, start_s] of [
      ["a.mcap", 0],
      ["b.mcap", 100],
    ] as const) {
      const recorder = createRunRecorder(port.create(name), {
        robot,
        startedAt_ns: BigInt(start_s) * 1_000_000_000n,
        program: "",
        cell: "",
      });
      for (let k = 0; k < 200; k++) recorder.record(sampleAt(k));
      recorder.finish();
    }
    const history = await opened(port);
    expect(history.duration_s).toBeCloseTo(101.99, 6);
    expect(await history.at(1)).toMatchObject({ recorded: true, sequence: 100 });
    expect(await history.at(50)).toMatchObject({ recorded: false, sequence: 199 });
    expect(await history.at(100.5)).toMatchObject({ recorded: true, sequence: 50 });
  });

  test("files that are no recordings, damaged, or of another robot are named and left out", async () => {
    const { port, archive } = recorded(3000);
    archive.close();
    const good = archive.file;
    const bytes = await port.read(good, 0, 1e9);
    const other = memorySink();
    const recorder = createRunRecorder(other, {
      robot: robotById("staubli_rx90l")!,
      startedAt_ns: 5n,
      program: "",
      cell: "",
    });
    recorder.record({ ...sampleAt(0), q_rad: new Float64Array(6) });
    recorder.finish();
    const torn = bytes.slice();
    torn.fill(0x5a, Math.floor(torn.length / 2), Math.floor(torn.length / 2) + 3000);
    const all = memoryFiles([
      ["empty.mcap", new Uint8Array(0)],
      ["letter.mcap", new TextEncoder().encode("Dear Sir or Madam")],
      ["other.mcap", other.bytes()],
      ["torn.mcap", torn.subarray(0, torn.length - 30)],
    ]);
    const history = await opened(all);
    expect(history.troubles).toEqual([
      "empty.mcap: The file is empty.",
      "letter.mcap: The file does not begin like an MCAP file.",
      "other.mcap is of another robot, Stäubli RX90L.",
      "torn.mcap is damaged in 1 place; the rest of it is here.",
    ]);
    expect((await history.at(1)).sequence).toBe(100);
    expect(await openHistory(memoryFiles())).toEqual({
      kind: "not-a-recording",
      sentence: "There is no recording here.",
    });
    expect(await openHistory(memoryFiles([["x", new TextEncoder().encode("Dear Sir or Madam")]]))).toEqual({
      kind: "not-a-recording",
      sentence: "The file does not begin like an MCAP file.",
    });
  });

  test("any bytes at all: a history or one sentence, in bounded time", async () => {
    const { port, archive } = recorded(500);
    archive.close();
    const bytes = await port.read(archive.file, 0, 1e9);
    const random = seededRandom(33);
    for (let i = 0; i < 300; i++) {
      const spoilt = bytes.slice(0, i % 3 === 0 ? Math.floor(random() * bytes.length) : bytes.length);
      for (let flips = 1 + Math.floor(random() * 6); flips > 0; flips--)
        spoilt[8 + Math.floor(random() * (spoilt.length - 8))] = Math.floor(random() * 256);
      const it = await openHistory(memoryFiles([["a.mcap", spoilt]]), { packing });
      if (it.kind === "not-a-recording") {
        expect(it.sentence).toMatch(/\.$/);
        continue;
      }
      const moment = await it.history.at(random() * 5);
      const truth = sampleAt(moment.sequence);
      if (moment.recorded)
        moment.q_rad.forEach((q, j) => {
          expect(Math.abs(q - truth.q_rad[j]!)).toBeLessThanOrEqual(QUANTUM / 2);
        });
    }
  }, 30_000);
});

describe("keeping", () => {
  test("names of files say when: every day of four hundred years there and back", () => {
    for (let day = -20_000; day < 130_000; day += 7) {
      const ms = day * 86_400_000 + 45_296_789;
      expect(fileName(ms, "ur10e")).toBe(`${new Date(ms).toISOString().replace(/[:.]/g, "-")}_ur10e.mcap`);
      expect(fileTime_ms(fileName(ms, "kuka kr/6"))).toBe(ms);
    }
  });

  test("the old go by age, the oldest by size, the open one and strangers' files never", () => {
    const hour = 3_600_000;
    const now = Date.UTC(2026, 10, 22, 12);
    const at = (hours: number): string => fileName(now - hours * hour, "ur10e");
    const files = [
      { name: "holiday.mcap", bytes: 9e9 },
      ...[1, 2, 30, 800].map(hours => ({ name: at(hours), bytes: 100 })),
    ];
    const week = { keep_s: 7 * 86_400, keep_bytes: 1e9 };
    expect(expired(files, week, now)).toEqual([at(800)]);
    expect(expired(files, { ...week, keep_bytes: 250 }, now)).toEqual([at(800), at(30)]);
    expect(expired(files, { keep_s: 0, keep_bytes: 0 }, now, at(1))).toEqual([at(800), at(30), at(2)]);
  });

  test("an archive that runs keeps to its limits, and says how much it deleted", async () => {
    let now_ns = START_NS;
    const port = memoryFiles();
    const archive = createArchive(port, {
      robot,
      cell: "",
      program: "",
      compact: { packing },
      clock_ns: () => now_ns,
      keeping: { file_s: 60, keep_s: 300, keep_bytes: 1e9 },
    });
    for (let k = 0; k < 60_000; k++) {
      now_ns = START_NS + BigInt(k) * 10_000_000n;
      archive.record(sampleAt(k));
      if (k % 100 === 0) await archive.tick();
    }
    archive.close();
    const history = await opened(port);
    expect(archive.deleted).toBe(4);
    expect(history.duration_s).toBeGreaterThan(299);
    expect(history.duration_s).toBeLessThan(421);
  });

  test("a source that falls silent loses nothing of what it said", async () => {
    let now_ns = START_NS;
    const port = memoryFiles();
    const archive = createArchive(port, { robot, cell: "", program: "", compact: { packing }, clock_ns: () => now_ns });
    for (let k = 0; k < 130; k++) {
      now_ns += 10_000_000n;
      archive.record(sampleAt(k));
    }
    for (let i = 0; i < 20; i++) {
      now_ns += 100_000_000n;
      await archive.tick();
    }
    expect((await opened(port)).duration_s).toBeCloseTo(1.29, 6);
  });

  test("a full disk, on which files can still be begun, gets no empty files: it is tried now and then, and recording goes on when there is room", async () => {
    let full = false;
    let now_ns = START_NS;
    let begun = 0;
    const kept = memoryFiles();
    const port: ArchivePort = {
      ...kept,
      create(name) {
        begun++;
        const sink = kept.create(name);
        return {
          get position() {
            return sink.position;
          },
          close() {
            sink.close();
          },
          write(bytes) {
            if (full) throw Object.assign(new Error("the disk is full"), { code: "ENOSPC" });
            sink.write(bytes);
          },
        };
      },
    };
    const archive = createArchive(port, { robot, cell: "", program: "", compact: { packing }, clock_ns: () => now_ns });
    const problems = new Set<string>();
    // A minute and a half, 50 s of it with a full disk.
    for (let k = 0; k < 9000; k++) {
      full = k >= 2000 && k < 7000;
      now_ns += 10_000_000n;
      archive.record(sampleAt(k));
      if (archive.problem) problems.add(archive.problem.sentence);
      if (k % 10 === 0) await archive.tick();
      if (k === 6900) expect(archive.problem).not.toBeNull();
    }
    expect(archive.problem).toBeNull();
    archive.close();
    await archive.tick();
    expect([...problems]).toEqual([expect.stringMatching(/^Recording ended after \d+ bytes: the disk is full$/)]);
    expect(begun).toBeLessThanOrEqual(2 + 50 / 2);
    const files = await kept.list();
    expect(files.length).toBe(2);
    expect(files.every(({ bytes }) => bytes > 1000)).toBe(true);
    const history = await opened(port);
    expect((await history.at(15)).recorded).toBe(true);
    expect((await history.at(45)).recorded).toBe(false);
    expect((await history.at(80)).recorded).toBe(true);
  });

  test("a place that is full is said once, and recording goes on in a new file when there is room", async () => {
    let full = false;
    let now_ns = START_NS;
    const kept = memoryFiles();
    const port: ArchivePort = {
      ...kept,
      create(name) {
        if (full) throw new Error("the disk is full");
        const sink = kept.create(name);
        return {
          get position() {
            return sink.position;
          },
          close() {
            sink.close();
          },
          write(bytes) {
            if (full) throw new Error("the disk is full");
            sink.write(bytes);
          },
        };
      },
    };
    const archive = createArchive(port, { robot, cell: "", program: "", compact: { packing }, clock_ns: () => now_ns });
    for (let k = 0; k < 1500; k++) {
      full = k >= 500 && k < 1000;
      now_ns += 10_000_000n;
      archive.record(sampleAt(k));
      if (k === 900) expect(archive.problem?.sentence).toMatch(/the disk is full/);
    }
    archive.close();
    const history = await opened(port);
    expect(history.stretches.length).toBe(2);
    expect((await history.at(2)).recorded).toBe(true);
    expect((await history.at(7)).recorded).toBe(false);
    expect((await history.at(14)).recorded).toBe(true);
  });
});
