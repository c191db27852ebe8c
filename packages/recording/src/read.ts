import { crc32 } from "@foxglove/crc";
import { hasMcapPrefix, McapStreamReader, Opcode } from "@mcap/core";
import { positionsOffset } from "./joint-state.ts";
import { RUN_METADATA, TOPICS } from "./recorder.ts";
import { eventFrom, stateFrom, type RobotState, type RunEvent } from "./state.ts";
import { utf8Text } from "./text.ts";

/** A recording laid out for scrubbing. Plain data: it crosses a worker's border by structured clone. */
export interface RecordingData {
  /** Id of the robot. */
  readonly robot: string;
  readonly robotName: string;
  readonly program: string;
  readonly cell: string;
  /** Wall clock at time 0, nanoseconds since 1970. */
  readonly startedAt_ns: bigint;
  readonly joints: number;
  /** n times [s], never falling, the first 0. */
  readonly times_s: Float64Array;
  /** n × joints angles, row by row. */
  readonly q_rad: Float64Array;
  readonly sequences: Uint32Array;
  /** Index into `states` of each sample. */
  readonly stateOf: Uint32Array;
  readonly states: readonly RobotState[];
  readonly events: readonly RunEvent[];
  /** False when the file ends before its index: the run was cut off. */
  readonly complete: boolean;
  /** Places where bytes were damaged and a chunk was left out. */
  readonly damaged: number;
}
export type Read = { readonly kind: "read"; readonly data: RecordingData } | { readonly kind: "not-a-recording"; readonly sentence: string };

const RECORD_HEAD = 1 + 8;
/** Start, end, size, checksum, length of the (empty) compression name, length of the records. */
const CHUNK_HEAD = 8 + 8 + 8 + 4 + 4 + 8;

/** Reads a recording, whole, cut off anywhere or damaged: what is lost is the chunk that is not whole, and no more. */
export function readRecording(bytes: Uint8Array): Read {
  if (!hasMcapPrefix(new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength))) {
    return { kind: "not-a-recording", sentence: bytes.length === 0 ? "The file is empty." : "The file does not begin like an MCAP file." };
  }
  const run = collector();
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let at = 8, damaged = 0, complete = false, packed = "";
  while (!complete && at + RECORD_HEAD <= bytes.length) {
    const opcode = view.getUint8(at), length = Number(view.getBigUint64(at + 1, true)), end = at + RECORD_HEAD + length;
    let sound = opcode >= 1 && opcode <= Opcode.MAX && end <= bytes.length;
    if (sound && opcode === Opcode.CHUNK) {
      // A chunk whose lengths do not agree is damaged, even if its checksum holds: it would swallow what follows.
      sound = chunkShaped(bytes, view, at) && run.chunk(bytes, view, at + RECORD_HEAD);
      packed ||= compressionOf(bytes, view, at + RECORD_HEAD, end);
    } else if (sound) {
      // A record that is, or holds, something shaped like a chunk has a wrong opcode or a wrong length.
      sound = !chunkShaped(bytes, view, at) && nextChunk(bytes, view, at + 1, end) === end;
      complete = sound && opcode === Opcode.FOOTER && hasMcapPrefix(new DataView(bytes.buffer, bytes.byteOffset + end, bytes.length - end));
    }
    if (sound) { at = end; continue; }
    const next = nextChunk(bytes, view, at + 1, bytes.length);
    // What is cut off at the end is an unfinished chunk, not a damaged one.
    if (next < bytes.length || opcode < 1 || opcode > Opcode.MAX || end <= bytes.length) damaged++;
    at = next;
  }
  if (packed !== "") return { kind: "not-a-recording", sentence: `The file's chunks are packed with ${packed}; recordings of runs are not packed.` };
  return run.finish(complete, damaged);
}

/** Start of the next record before `until` that looks like a chunk of ours; `until` when there is none. */
function nextChunk(bytes: Uint8Array, view: DataView, from: number, until: number): number {
  for (let at = bytes.indexOf(Opcode.CHUNK, from); at >= 0 && at < until; at = bytes.indexOf(Opcode.CHUNK, at + 1)) if (chunkShaped(bytes, view, at)) return at;
  return until;
}

/** The lengths of a chunk agree with each other, whatever its opcode says. */
function chunkShaped(bytes: Uint8Array, view: DataView, at: number): boolean {
  const body = at + RECORD_HEAD;
  if (body + CHUNK_HEAD > bytes.length) return false;
  const size = view.getUint32(body + 16, true);
  return view.getUint32(at + 1, true) === CHUNK_HEAD + size && view.getUint32(at + 5, true) === 0
    && view.getUint32(body + 28, true) === 0 && view.getUint32(body + 32, true) === size && body + CHUNK_HEAD + size <= bytes.length;
}

/** Name of a packing that other writers use on chunks; "" for none. */
function compressionOf(bytes: Uint8Array, view: DataView, body: number, end: number): string {
  const length = body + CHUNK_HEAD <= end ? view.getUint32(body + 28, true) : 0;
  const name = length > 0 && length <= 8 ? String.fromCharCode(...bytes.subarray(body + 32, body + 32 + length)) : "";
  return /^(lz4|zstd)$/.test(name) ? name : "";
}

const TWO_32 = 2 ** 32;
/** Channel, sequence, log time, publish time. */
const MESSAGE_HEAD = 2 + 4 + 8 + 8;

/** Puts the messages of chunk after chunk into arrays that grow. Times are read without a bigint each. */
function collector() {
  const states: RobotState[] = [], events: RunEvent[] = [], topics = new Map<number, string>();
  let run: ReadonlyMap<string, string> | null = null, startedAt_ns = 0n, startHigh = 0, startLow = 0, joints = 0, n = 0, alikeLength = -1, alikeOffset = -1;
  let times_s = new Float64Array(1024), q_rad = new Float64Array(0), sequences = new Uint32Array(1024), stateOf = new Uint32Array(1024);

  function begin(metadata: ReadonlyMap<string, string>): void {
    run = metadata;
    const started = metadata.get("started_at_ns") ?? "";
    startedAt_ns = /^\d{1,19}$/.test(started) ? BigInt(started) : 0n;
    startHigh = Number(startedAt_ns >> 32n);
    startLow = Number(startedAt_ns & 0xffffffffn);
    joints = namesOf(metadata.get("joints")).length;
    q_rad = new Float64Array(1024 * joints);
  }
  function grow(): void {
    const larger = <T extends Float64Array | Uint32Array>(from: T, to: T): T => { to.set(from); return to; };
    times_s = larger(times_s, new Float64Array(2 * times_s.length));
    q_rad = larger(q_rad, new Float64Array(2 * q_rad.length));
    sequences = larger(sequences, new Uint32Array(2 * sequences.length));
    stateOf = larger(stateOf, new Uint32Array(2 * stateOf.length));
  }

  function channel(record: Uint8Array): void {
    const reader = new McapStreamReader({ noMagicPrefix: true });
    reader.append(record);
    const read = reader.nextRecord();
    if (read?.type !== "Channel") return;
    topics.set(read.id, read.topic);
    if (!run && read.topic === TOPICS[0] && read.metadata.has("robot")) begin(read.metadata);
  }

  function message(bytes: Uint8Array, view: DataView, from: number, until: number): void {
    const topic = topics.get(view.getUint16(from, true)), data = from + MESSAGE_HEAD;
    const at_s = ((view.getUint32(from + 10, true) - startHigh) * TWO_32 + (view.getUint32(from + 6, true) - startLow)) / 1e9;
    if (topic === TOPICS[0]) {
      // Messages of one channel are all alike; where the angles are is looked up once for each length.
      if (until - data !== alikeLength) {
        alikeLength = until - data;
        alikeOffset = positionsOffset(view, data, until, joints);
      }
      if (alikeOffset < 0) return;
      if (n === times_s.length) grow();
      for (let i = 0; i < joints; i++) q_rad[n * joints + i] = view.getFloat64(data + alikeOffset + 8 * i, true);
      times_s[n] = at_s;
      sequences[n] = view.getUint32(from + 2, true);
      stateOf[n] = Math.max(0, states.length - 1);
      n++;
    } else if (topic === TOPICS[1]) states.push(stateFrom(json(bytes.subarray(data, until))));
    else if (topic === TOPICS[2]) events.push(eventFrom(json(bytes.subarray(data, until)), at_s));
  }

  return {
    /** Takes all of one chunk, or nothing: its checksum says whether it is what was written. */
    chunk(bytes: Uint8Array, view: DataView, body: number): boolean {
      const size = view.getUint32(body + 16, true), from = body + CHUNK_HEAD, until = from + size, checksum = view.getUint32(body + 24, true);
      if (checksum !== crc32(bytes.subarray(from, until))) return false;
      for (let at = from; at + RECORD_HEAD <= until;) {
        const opcode = view.getUint8(at), next = at + RECORD_HEAD + view.getUint32(at + 1, true) + TWO_32 * view.getUint32(at + 5, true);
        if (next > until) break;
        if (opcode === Opcode.CHANNEL && !topics.has(view.getUint16(at + RECORD_HEAD, true))) channel(bytes.subarray(at, next));
        else if (opcode === Opcode.MESSAGE && run && next - at >= RECORD_HEAD + MESSAGE_HEAD) message(bytes, view, at + RECORD_HEAD, next);
        at = next;
      }
      return true;
    },
    finish(complete: boolean, damaged: number): Read {
      if (!run) return { kind: "not-a-recording", sentence: `The file is MCAP but holds no joint angles of a run (no ${TOPICS[0]} with ${RUN_METADATA}).` };
      if (n === 0) return { kind: "not-a-recording", sentence: "The recording ends before its first sample." };
      if (states.length === 0) states.push(stateFrom(null));
      return {
        kind: "read",
        data: {
          robot: run.get("robot") ?? "", robotName: run.get("robot_name") ?? "", program: run.get("program") ?? "", cell: run.get("cell") ?? "",
          startedAt_ns, joints, times_s: times_s.slice(0, n), q_rad: q_rad.slice(0, n * joints), sequences: sequences.slice(0, n),
          stateOf: stateOf.slice(0, n), states, events, complete, damaged,
        },
      };
    },
  };
}

/** What the bytes say in JSON; null when they are not JSON. */
function json(data: Uint8Array): unknown {
  try {
    const value: unknown = JSON.parse(utf8Text(data));
    return value;
  } catch {
    return null;
  }
}
function namesOf(text: string | undefined): readonly unknown[] {
  const names = json(Uint8Array.from(text ?? "[]", letter => letter.charCodeAt(0)));
  return Array.isArray(names) ? names : [];
}
