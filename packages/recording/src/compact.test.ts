import { zstdDecompressSync } from "node:zlib";
import { robotById, seededRandom, type JointSample } from "@twincell/core";
import { McapIndexedReader } from "@mcap/core";
import { expect, test } from "vitest";
import {
  createRunRecorder,
  memorySink,
  QUANTUM,
  readRecording,
  TOPICS,
  type Note,
  type RecordingData,
  type RunHeader,
} from "./index.ts";
import { frameContentSize } from "./packing.ts";
import { zstd } from "./zstd/index.ts";

const robot = robotById("staubli_rx90l")!;
const n = robot.arm.joints.length;
const packing = await zstd();
const startedAt_ns = 1_795_237_199_999_999_123n;
const header: RunHeader = { robot, startedAt_ns, program: "Palette", cell: "Zelle 2", compact: { packing } };
const still = {
  moving: false,
  mode: "automatic" as const,
  safety: "normal" as const,
  override: 1,
  gripperClosed: false,
  step: "",
  message: "",
};
const moved = (k: number, moving = true): JointSample => ({
  ...still,
  moving,
  sequence: k,
  time_s: 0.01 * k,
  q_rad: Float64Array.from({ length: n }, (_, j) => Math.sin(0.004 * k * (j + 1))),
});
const dataOf = (bytes: Uint8Array): RecordingData => {
  const read = readRecording(bytes, packing);
  if (read.kind !== "read") throw new Error(read.sentence);
  return read.data;
};
/** The angles in force at a time: those of the last sample at or before it. */
function anglesAt(data: RecordingData, at_s: number): Float64Array {
  let i = data.times_s.findLastIndex(time_s => time_s <= at_s + 1e-9);
  i = Math.max(i, 0);
  return data.q_rad.subarray(i * n, (i + 1) * n);
}

test("X-43 a compact recording keeps every joint to 1e-6 rad and every time as it was", () => {
  const sink = memorySink();
  const recorder = createRunRecorder(sink, header);
  for (let k = 0; k < 3000; k++) recorder.record(moved(k));
  recorder.finish();
  const data = dataOf(sink.bytes());
  expect(data.complete).toBe(true);
  expect(data.times_s.length).toBe(3000);
  for (let k = 0; k < 3000; k++) {
    expect(data.times_s[k]).toBeCloseTo(0.01 * k, 9);
    moved(k).q_rad.forEach((q, j) => {
      if (!(Math.abs(data.q_rad[k * n + j]! - q) <= QUANTUM / 2)) throw new Error(`Sample ${k}, joint ${j + 1}.`);
    });
  }
  expect(QUANTUM).toBeLessThan(1e-6);
});

test("a standing robot costs its first and last sample of each chunk, and the moment it starts again is exact", () => {
  const sink = memorySink();
  const recorder = createRunRecorder(sink, header);
  const standing = moved(0, false);
  const q_rad = standing.q_rad;
  for (let k = 0; k < 5000; k++) recorder.record({ ...standing, sequence: k, time_s: 0.01 * k });
  const starts = Float64Array.from(q_rad, q => q + 0.001);
  for (let k = 5000; k < 5010; k++)
    recorder.record({ ...standing, q_rad: starts, moving: true, sequence: k, time_s: 0.01 * k });
  recorder.finish();
  const data = dataOf(sink.bytes());
  expect(data.times_s.length).toBeLessThan(120);
  const rises = data.times_s[data.stateOf.findIndex(index => data.states[index]!.moving)]!;
  expect(rises).toBeCloseTo(50, 9);
  // The last moment of standing is there too: nothing is drawn as a slow creep.
  expect(data.times_s.some(time_s => Math.abs(time_s - 49.99) < 1e-9)).toBe(true);
  const random = seededRandom(4);
  for (let i = 0; i < 200; i++)
    anglesAt(data, 49.98 * random()).forEach((q, j) => {
      expect(Math.abs(q - q_rad[j]!)).toBeLessThanOrEqual(QUANTUM / 2);
    });
});

test("noise inside the stillness band is kept as standing, motion beyond it is not lost", () => {
  const sink = memorySink();
  const recorder = createRunRecorder(sink, { ...header, compact: { packing, still: 4e-5 } });
  const random = seededRandom(9);
  const at = (k: number): Float64Array =>
    Float64Array.from({ length: n }, (_, j) => j + 2e-5 * (2 * random() - 1) + (k >= 1000 ? 0.01 : 0));
  for (let k = 0; k < 2000; k++) recorder.record({ ...still, sequence: k, time_s: 0.01 * k, q_rad: at(k) });
  recorder.finish();
  const data = dataOf(sink.bytes());
  expect(data.times_s.length).toBeLessThan(60);
  for (const [at_s, more] of [
    [9.9, 0],
    [10.005, 0.01],
    [19, 0.01],
  ] as const)
    anglesAt(data, at_s).forEach((q, j) => {
      expect(Math.abs(q - j - more)).toBeLessThan(8.1e-5);
    });
});

test("T-54 commands, lines, alarms, people, latencies, loads and the cell's version are there again, each under its schema", async () => {
  const sink = memorySink();
  const recorder = createRunRecorder(sink, header);
  recorder.note("cell", { name: "Zelle 2", version: "a1b2" });
  recorder.record({ ...moved(0), signals: new Map() });
  recorder.record({
    ...moved(1),
    signals: new Map<string, boolean | number>([
      ["part", true],
      ["level", 2.5],
    ]),
  });
  recorder.note("operator", { who: "Anna", action: "mode", detail: "manual" });
  recorder.note("command", {
    name: "move",
    by: "studio",
    outcome: "refused",
    sentence: "Joint 3 would turn to 150.0°; its limit is 140.0°.",
    target: [1, 2, 3],
  });
  recorder.record({
    ...moved(2),
    safety: "protective-stop",
    message: "Kollision – Achse 2",
    signals: new Map<string, boolean | number>([
      ["part", false],
      ["level", 2.5],
    ]),
  });
  recorder.note("latency", {
    stage: "state",
    direction: "from-robot",
    samples: 500,
    median_ms: 1.2,
    p99_ms: 4,
    worst_ms: 9,
  });
  recorder.note("load", { torque_Nm: [1, 2, 3, 4, 5, 6], current_A: [], temperature_C: [40, 41, 42, 43, 44, 45] });
  recorder.event("info", "Fertig.");
  recorder.record(moved(3));
  recorder.finish();
  const data = dataOf(sink.bytes());
  const kinds = (kind: Note["kind"]) => data.notes.filter(note => note.kind === kind);
  expect(kinds("cell")).toEqual([{ at_s: 0, kind: "cell", name: "Zelle 2", version: "a1b2" }]);
  expect(kinds("io")).toEqual([
    { at_s: 0.01, kind: "io", signals: { part: true, level: 2.5 } },
    { at_s: 0.02, kind: "io", signals: { part: false, level: 2.5 } },
  ]);
  expect(kinds("alarm")).toEqual([
    {
      at_s: 0.02,
      kind: "alarm",
      code: "safety.protective-stop",
      active: true,
      sentence: "Kollision – Achse 2",
      hint: "",
    },
    { at_s: 0.03, kind: "alarm", code: "safety.protective-stop", active: false, sentence: "Back to normal.", hint: "" },
  ]);
  expect(kinds("operator")).toMatchObject([{ who: "Anna", action: "mode", detail: "manual" }]);
  expect(kinds("command")).toMatchObject([{ name: "move", by: "studio", outcome: "refused", target: [1, 2, 3] }]);
  expect(kinds("latency")).toMatchObject([{ stage: "state", direction: "from-robot", samples: 500, p99_ms: 4 }]);
  expect(kinds("load")).toMatchObject([
    { torque_Nm: [1, 2, 3, 4, 5, 6], current_A: [], temperature_C: [40, 41, 42, 43, 44, 45] },
  ]);

  // The library's reader with Node's own zstd, neither of them ours.
  const bytes = sink.bytes();
  const indexed = await McapIndexedReader.Initialize({
    readable: {
      size: () => Promise.resolve(BigInt(bytes.length)),
      read: (offset, size) => Promise.resolve(bytes.slice(Number(offset), Number(offset + size))),
    },
    decompressHandlers: { zstd: buffer => zstdDecompressSync(buffer) },
  });
  const seen = new Set<string>();
  for await (const message of indexed.readMessages({ validateCrcs: true })) {
    const channel = indexed.channelsById.get(message.channelId)!;
    seen.add(channel.topic);
    if (channel.messageEncoding !== "json") continue;
    const schema = JSON.parse(new TextDecoder().decode(indexed.schemasById.get(channel.schemaId)!.data)) as {
      title: string;
      properties: Record<string, unknown>;
    };
    const said = JSON.parse(new TextDecoder().decode(message.data)) as Record<string, unknown>;
    expect(Object.keys(said).sort(), channel.topic).toEqual(Object.keys(schema.properties).sort());
  }
  expect([...seen].sort()).toEqual(TOPICS.map(({ topic }) => topic).sort());
});

test("a compact file cut anywhere, or with a byte flipped anywhere, loses a chunk at most and never gives a wrong angle", () => {
  const sink = memorySink();
  const recorder = createRunRecorder(sink, { ...header, chunk_s: 0.2 });
  for (let k = 0; k < 600; k++) recorder.record(moved(k));
  recorder.finish();
  const bytes = sink.bytes();
  const random = seededRandom(21);
  const right = (data: RecordingData): void => {
    data.sequences.forEach((k, i) => {
      moved(k).q_rad.forEach((q, j) => {
        if (!(Math.abs(data.q_rad[i * n + j]! - q) <= QUANTUM / 2)) throw new Error(`Sample ${k} is wrong.`);
      });
    });
  };
  for (let i = 0; i < 150; i++) {
    const damaged = bytes.slice();
    const at = 8 + Math.floor(random() * (bytes.length - 8));
    damaged[at]! ^= 1 << Math.floor(random() * 8);
    const read = readRecording(damaged, packing);
    if (read.kind !== "read") throw new Error(`Flipped at ${at}: ${read.sentence}`);
    expect(read.data.times_s.length, `flipped at ${at}`).toBeGreaterThanOrEqual(600 - 21);
    right(read.data);

    const cut = Math.floor(random() * bytes.length);
    const part = readRecording(bytes.slice(0, cut), packing);
    if (part.kind === "read") right(part.data);
    else expect(part.sentence).toMatch(/^The (file|recording) .*\.$/);
  }
});

test("packed bytes that lie about their size ask for no memory", () => {
  const packed = packing.pack(new Uint8Array(1000).fill(7));
  expect(frameContentSize(packed)).toBe(1000);
  expect(packing.unpack(packed, 1000)).toEqual(new Uint8Array(1000).fill(7));
  expect(packing.unpack(packed, 999)).toBeNull();
  // A frame header that promises 2^62 bytes, written out from RFC 8878: magic, descriptor with 8 bytes of size, window,
  // size.
  const bomb = Uint8Array.of(0x28, 0xb5, 0x2f, 0xfd, 0xc0, 0x58, 0, 0, 0, 0, 0, 0, 0, 0x40, 1, 0, 0);
  expect(frameContentSize(bomb)).toBe(2 ** 62);
  expect(packing.unpack(bomb, 2 ** 62)).toBeNull();
  const sink = memorySink();
  const recorder = createRunRecorder(sink, header);
  recorder.record(moved(0));
  recorder.finish();
  expect(readRecording(sink.bytes())).toEqual({
    kind: "not-a-recording",
    sentence: "The file's chunks are packed with zstd, which is not read here.",
  });
});
