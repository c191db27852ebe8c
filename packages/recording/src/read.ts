import { hasMcapPrefix, McapStreamReader, Opcode, type TypedMcapRecord } from "@mcap/core";
import { readPositions } from "./joint-state.ts";
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
      const chunk = readChunk(bytes.subarray(at, end));
      if (chunk.kind === "read") run.add(chunk.records);
      else if (chunk.compression !== "") packed = chunk.compression;
      // Its checksum does not cover the record's own length: one that is too long would swallow what follows.
      sound = chunk.kind === "read" && chunkShaped(bytes, view, at);
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

type ChunkRead = { readonly kind: "read"; readonly records: readonly TypedMcapRecord[] } | { readonly kind: "damaged"; readonly compression: string };

/** All records of one chunk, or none: its checksum says whether they are what was written. */
function readChunk(chunk: Uint8Array): ChunkRead {
  const records: TypedMcapRecord[] = [];
  let compression = "";
  try {
    const reader = new McapStreamReader({ noMagicPrefix: true, includeChunks: true });
    reader.append(chunk);
    for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
      if (record.type === "Chunk") compression = record.compression;
      else records.push(record);
    }
    return reader.bytesRemaining() === 0 ? { kind: "read", records } : { kind: "damaged", compression: "" };
  } catch (reason) {
    return { kind: "damaged", compression: reason instanceof Error && reason.message.startsWith("Unsupported compression") ? compression : "" };
  }
}

/** Puts the messages of chunk after chunk into arrays that grow. */
function collector() {
  const states: RobotState[] = [], events: RunEvent[] = [], topics = new Map<number, string>();
  let run: ReadonlyMap<string, string> | null = null, startedAt_ns = 0n, joints = 0, n = 0;
  let times_s = new Float64Array(1024), q_rad = new Float64Array(0), sequences = new Uint32Array(1024), stateOf = new Uint32Array(1024);

  function begin(metadata: ReadonlyMap<string, string>): void {
    run = metadata;
    const started = metadata.get("started_at_ns") ?? "";
    startedAt_ns = /^\d{1,20}$/.test(started) ? BigInt(started) : 0n;
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

  return {
    add(records: readonly TypedMcapRecord[]): void {
      for (const record of records) {
        if (record.type === "Channel") {
          topics.set(record.id, record.topic);
          if (!run && record.topic === TOPICS[0] && record.metadata.has("robot")) begin(record.metadata);
        } else if (record.type === "Message" && run) {
          const topic = topics.get(record.channelId), at_s = Number(record.logTime - startedAt_ns) / 1e9;
          if (topic === TOPICS[0]) {
            if (n === times_s.length) grow();
            if (!readPositions(record.data, joints, q_rad, n * joints)) continue;
            times_s[n] = at_s;
            sequences[n] = record.sequence;
            stateOf[n] = Math.max(0, states.length - 1);
            n++;
          } else if (topic === TOPICS[1]) states.push(stateFrom(json(record.data)));
          else if (topic === TOPICS[2]) events.push(eventFrom(json(record.data), at_s));
        }
      }
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
