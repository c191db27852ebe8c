import { crc32 } from "@foxglove/crc";
import { McapStreamReader, Opcode } from "@mcap/core";
import { openCycleFrom, type OpenCycle } from "./digest.ts";
import { positionsOffset } from "./joint-state.ts";
import { RECORD_HEAD, type ChunkShape } from "./layout.ts";
import { noteFrom, type Note, type NoteKind } from "./notes.ts";
import type { Packing } from "./packing.ts";
import { eventFrom, sameState, stateFrom, type RobotState, type RunEvent } from "./state.ts";
import { utf8Bytes, utf8Text } from "./text.ts";
import { CHANNEL, TOPICS } from "./topics.ts";

/** What a recording says of itself. */
export interface RunFacts {
  /** Id of the robot. */
  readonly robot: string;
  readonly robotName: string;
  readonly program: string;
  readonly cell: string;
  /** Wall clock at time 0, nanoseconds since 1970. */
  readonly startedAt_ns: bigint;
  readonly joints: number;
  /** The cycle that was under way when the file before this one ended. */
  readonly cycle: OpenCycle | null;
}
/** Samples laid out for scrubbing. Plain data: it crosses a worker's border by structured clone. */
export interface Samples {
  /** n times [s] since the start of the recording, never falling. */
  readonly times_s: Float64Array;
  /** n × joints angles, row by row. */
  readonly q_rad: Float64Array;
  readonly sequences: Uint32Array;
  /** Index into `states` of each sample. */
  readonly stateOf: Uint32Array;
  readonly states: readonly RobotState[];
  readonly events: readonly RunEvent[];
  readonly notes: readonly Note[];
}

const TWO_32 = 2 ** 32;
/** Channel, sequence, log time, publish time. */
const MESSAGE_HEAD = 2 + 4 + 8 + 8;
const MOST_JOINTS = 64;
const KINDS = new Map<number, NoteKind>(
  Object.entries(CHANNEL).flatMap(([kind, id]) =>
    kind === "joints" || kind === "state" || kind === "events" ? [] : [[id, kind as NoteKind] as const],
  ),
);
const TOPIC_IDS: ReadonlyMap<string, number> = new Map(TOPICS.map(({ topic }, id) => [topic, id]));

/** Facts from the metadata of a recording of ours; null when it is none. */
export function factsFrom(metadata: ReadonlyMap<string, string>): RunFacts | null {
  const started = metadata.get("started_at_ns") ?? "";
  const names = json(Uint8Array.from(metadata.get("joints") ?? "[]", letter => letter.charCodeAt(0)));
  const robot = metadata.get("robot");
  if (robot === undefined || !Array.isArray(names) || names.length > MOST_JOINTS) return null;
  return {
    robot,
    robotName: metadata.get("robot_name") ?? "",
    program: metadata.get("program") ?? "",
    cell: metadata.get("cell") ?? "",
    startedAt_ns: /^\d{1,19}$/.test(started) ? BigInt(started) : 0n,
    joints: names.length,
    cycle: openCycleFrom(json(utf8Bytes(metadata.get("cycle") ?? ""))),
  };
}

export type Taken = "taken" | "damaged" | "unreadable" | "no-run-yet";

/** Puts the messages of chunk after chunk into arrays that grow. Times are read without a bigint each. */
export function createDecoder(packing: Packing | undefined, known: RunFacts | null = null, capacity = 1024) {
  const topics = new Map(TOPICS.map((_, id) => [id, id]));
  let facts: RunFacts | null = null;
  let startHigh = 0;
  let startLow = 0;
  let joints = 0;
  let n = 0;
  let alikeLength = -1;
  let alikeOffset = -1;
  let times_s = new Float64Array(capacity);
  let q_rad = new Float64Array(0);
  let sequences = new Uint32Array(capacity);
  let stateOf = new Uint32Array(capacity);
  const states: RobotState[] = [];
  const events: RunEvent[] = [];
  const notes: Note[] = [];
  let lastIo = "";
  if (known) begin(known);

  function begin(of: RunFacts): void {
    facts = of;
    startHigh = Number(of.startedAt_ns >> 32n);
    startLow = Number(of.startedAt_ns & 0xffffffffn);
    ({ joints } = of);
    q_rad = new Float64Array(times_s.length * joints);
  }
  function grow(): void {
    const larger = <T extends Float64Array | Uint32Array>(from: T, to: T): T => {
      to.set(from);
      return to;
    };
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
    const topic = TOPIC_IDS.get(read.topic);
    if (topic === undefined) topics.delete(read.id);
    else topics.set(read.id, topic);
    if (!facts && topic === CHANNEL.joints) {
      const of = factsFrom(read.metadata);
      if (of) begin(of);
    }
  }
  function state(next: RobotState): void {
    const last = states.at(-1);
    if (!last || !sameState(last, next)) states.push(next);
  }
  function message(bytes: Uint8Array, view: DataView, from: number, until: number): void {
    const topic = topics.get(view.getUint16(from, true));
    const data = from + MESSAGE_HEAD;
    const at_s =
      ((view.getUint32(from + 10, true) - startHigh) * TWO_32 + (view.getUint32(from + 6, true) - startLow)) / 1e9;
    if (topic === CHANNEL.joints) {
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
    } else if (topic === CHANNEL.state) state(stateFrom(json(bytes.subarray(data, until))));
    else if (topic === CHANNEL.events) events.push(eventFrom(json(bytes.subarray(data, until)), at_s));
    else if (topic !== undefined) {
      const kind = KINDS.get(topic)!;
      const note = noteFrom(kind, json(bytes.subarray(data, until)), at_s);
      if (note.kind === "io") {
        const said = JSON.stringify(note.signals);
        if (said === lastIo) return;
        lastIo = said;
      }
      notes.push(note);
    }
  }
  function records(bytes: Uint8Array, view: DataView, from: number, until: number): Taken {
    // Without its run a chunk cannot be placed in time; a later chunk may bring it.
    if (!facts && !declaresRun(view, from, until)) return "no-run-yet";
    for (let at = from; at + RECORD_HEAD <= until; ) {
      const opcode = view.getUint8(at);
      const next = at + RECORD_HEAD + view.getUint32(at + 1, true) + TWO_32 * view.getUint32(at + 5, true);
      if (next > until) break;
      if (opcode === Opcode.CHANNEL) channel(bytes.subarray(at, next));
      else if (opcode === Opcode.MESSAGE && facts && next - at >= RECORD_HEAD + MESSAGE_HEAD)
        message(bytes, view, at + RECORD_HEAD, next);
      at = next;
    }
    return facts ? "taken" : "no-run-yet";
  }
  function declaresRun(view: DataView, from: number, until: number): boolean {
    for (let at = from; at + RECORD_HEAD <= until; ) {
      const next = at + RECORD_HEAD + view.getUint32(at + 1, true) + TWO_32 * view.getUint32(at + 5, true);
      if (view.getUint8(at) === Opcode.CHANNEL && next <= until) return true;
      at = next;
    }
    return false;
  }

  return {
    get facts() {
      return facts;
    },
    /** Takes what the file says of itself outside its chunks. */
    run(metadata: ReadonlyMap<string, string>): void {
      const of = facts ? null : factsFrom(metadata);
      if (of) begin(of);
    },
    /** Takes all of one chunk, or nothing: its checksum says whether it is what was written. */
    chunk(bytes: Uint8Array, view: DataView, at: number, shape: ChunkShape): Taken {
      const from = at + shape.recordsAt;
      if (shape.packing === "") {
        if (shape.checksum !== crc32(bytes.subarray(from, from + shape.size))) return "damaged";
        return records(bytes, view, from, from + shape.size);
      }
      if (shape.packing !== packing?.name) return "unreadable";
      const unpacked = packing.unpack(bytes.subarray(from, from + shape.recordsLength), shape.size);
      if (!unpacked || shape.checksum !== crc32(unpacked)) return "damaged";
      return records(
        unpacked,
        new DataView(unpacked.buffer, unpacked.byteOffset, unpacked.byteLength),
        0,
        unpacked.length,
      );
    },
    samples(): Samples {
      if (states.length === 0) states.push(stateFrom(null));
      return {
        times_s: times_s.slice(0, n),
        q_rad: q_rad.slice(0, n * joints),
        sequences: sequences.slice(0, n),
        stateOf: stateOf.slice(0, n),
        states,
        events,
        notes,
      };
    },
  };
}

/** What the bytes say in JSON; null when they are not JSON. */
export function json(data: Uint8Array): unknown {
  try {
    const value: unknown = JSON.parse(utf8Text(data));
    return value;
  } catch {
    return null;
  }
}
