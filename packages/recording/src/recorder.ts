import type { JointSample, Refusal, Robot } from "@twincell/core";
import type { Channel, Schema } from "@mcap/core";
import { OpenChunk } from "./chunk.ts";
import { createDigester, type Digest, type OpenCycle } from "./digest.ts";
import { jointStateTemplate } from "./joint-state.ts";
import { mcapFile, recordsOf } from "./mcap-file.ts";
import type { Note, NoteKind, Notes } from "./notes.ts";
import type { Packing } from "./packing.ts";
import type { ByteSink } from "./sink.ts";
import { copyState, LEVELS, sameState, type EventLevel, type RobotState } from "./state.ts";
import { utf8Bytes } from "./text.ts";
import { CHANNEL, DIGEST_METADATA, RUN_METADATA, TOPICS } from "./topics.ts";

export interface RunHeader {
  readonly robot: Robot;
  /** Wall clock at the first sample, nanoseconds since 1970. */
  readonly startedAt_ns: bigint;
  readonly program: string;
  readonly cell: string;
  /** A chunk is closed when it holds this much … */
  readonly chunkBytes?: number;
  /** … or spans this much time: what a crash can cost. */
  readonly chunk_s?: number;
  /** For hours and days; left out, every sample is kept as it is. */
  readonly compact?: Compact;
  /** The cycle that was under way when the file before this one ended; its times count from the start of this file. */
  readonly cycle?: OpenCycle | null;
}

/** Joints are kept to 2⁻²⁰ rad (or m): below 10⁻⁶, and the rest of the number is zeros that pack to nothing. */
export const QUANTUM = 2 ** -20;

export interface Compact {
  readonly packing: Packing;
  /**
   * Of samples in which no joint leaves this band about the last one kept, and nothing else changes, only the first and
   * the last of each chunk are kept [rad, or m]. By default half a quantum, so that nothing is lost but repetition.
   */
  readonly still?: number;
}

export interface RunRecorder {
  /** Allocates nothing while a chunk is open. */
  record(sample: JointSample): void;
  event(kind: string, sentence: string, level?: EventLevel): void;
  /**
   * Commands, alarms, what people did, latencies, loads, the cell's version. Lines in and out come with the samples.
   */
  note<K extends NoteKind>(kind: K, what: Notes[K]): void;
  /** Closes the open chunk now, so that a crash after this costs nothing before it. */
  flush(): void;
  /** Writes the index that makes the file quick to open. Nothing is recorded after it. */
  finish(): void;
  readonly samples: number;
  /** Time of the last sample since the first [s]. */
  readonly duration_s: number;
  /** The cycle that is under way, for the file that follows. */
  readonly cycle: OpenCycle | null;
  /** Why recording ended early: the sink took no more. What was written until then can be read. */
  readonly problem: Refusal | null;
}

/** In a compact recording schemas and channels are repeated this often; elsewhere in every chunk. */
const REPEAT_NS = 60e9;

/**
 * Records a run to MCAP. Every chunk begins with the state of the robot and its lines, so each can be read without the
 * others: whatever happens to the file, a damaged or missing chunk costs itself and nothing else.
 */
export function createRunRecorder(sink: ByteSink, header: RunHeader): RunRecorder {
  const { robot, startedAt_ns, compact } = header;
  const n = robot.arm.joints.length;
  const chunkBytes = header.chunkBytes ?? 128 * 1024;
  const chunk_ns = (header.chunk_s ?? 1) * 1e9;
  const still = compact ? Math.max(compact.still ?? 0, QUANTUM / 2) : -1;
  const names = robot.arm.joints.map(joint => joint.name);
  const template = jointStateTemplate(robot.frames.base, names);
  const start_s = Number(startedAt_ns / 1_000_000_000n);
  const start_ns = Number(startedAt_ns % 1_000_000_000n);
  const run = new Map([
    ["version", "2"],
    ["robot", robot.id],
    ["robot_name", robot.name],
    ["program", header.program],
    ["cell", header.cell],
    ["started_at_ns", startedAt_ns.toString()],
    ["joints", JSON.stringify(names)],
    ...(header.cycle ? [["cycle", JSON.stringify(header.cycle)] as const] : []),
  ]);
  const schemas: Schema[] = TOPICS.map(({ schema }, i) => ({
    id: i + 1,
    name: schema.name,
    encoding: schema.encoding,
    data: utf8Bytes(schema.text),
  }));
  const channels: Channel[] = TOPICS.map(({ topic, messageEncoding }, id) => ({
    id,
    schemaId: id + 1,
    topic,
    messageEncoding,
    metadata: run,
  }));
  const declarations = channels.map((channel, id) =>
    recordsOf(builder => {
      builder.writeSchema(schemas[id]!);
      builder.writeChannel(channel);
    }),
  );
  const declaredAt_ns = channels.map(() => -Infinity);

  const chunk = new OpenChunk(chunkBytes + 8192, channels.length, startedAt_ns);
  const file = mcapFile(sink, { schemas, channels });
  const digester = createDigester(n, header.cycle ?? null);
  const kept = new Float64Array(n);
  const seen = new Float64Array(n);
  let state: RobotState | null = null;
  let stateBytes = new Uint8Array(0);
  let io: ReadonlyMap<string, boolean | number> | null = null;
  let ioBytes = new Uint8Array(0);
  let firstSample_s = NaN;
  let now_ns = 0;
  let opened_ns = 0;
  let samples = 0;
  let keptOne = false;
  let opening = false;
  let held_ns = -1;
  let heldSequence = 0;
  let finished = false;

  function put(channel: number, sequence: number, data: Uint8Array, at_ns = now_ns): number {
    if (chunk.length === 0 && !opening) {
      opening = true;
      opened_ns = at_ns;
      if (!compact) declaredAt_ns.fill(-Infinity);
      if (state && channel !== CHANNEL.state) put(CHANNEL.state, 0, stateBytes, at_ns);
      if (io && channel !== CHANNEL.io) put(CHANNEL.io, 0, ioBytes, at_ns);
      opening = false;
    }
    if (at_ns - declaredAt_ns[channel]! >= REPEAT_NS) {
      declaredAt_ns[channel] = at_ns;
      chunk.raw(declarations[channel]!);
    }
    const at = chunk.message(channel, sequence, at_ns, data.length);
    chunk.bytes.set(data, at);
    file.counts[channel]!++;
    return at;
  }
  function putJoints(sequence: number, at_ns: number, q: ArrayLike<number>): void {
    const at = put(CHANNEL.joints, sequence, template.bytes, at_ns);
    const { view } = chunk;
    const nanoseconds = start_ns + (at_ns % 1e9);
    const carry = nanoseconds >= 1e9 ? 1 : 0;
    view.setInt32(at + template.stampAt, start_s + Math.floor(at_ns / 1e9) + carry, true);
    view.setUint32(at + template.stampAt + 4, nanoseconds - carry * 1e9, true);
    for (let i = 0; i < n; i++) view.setFloat64(at + template.positionsAt + 8 * i, q[i]!, true);
  }
  /** The last of the samples that were alike: where they ended is known by it. */
  function putHeld(): void {
    if (held_ns < 0) return;
    const at_ns = held_ns;
    held_ns = -1;
    putJoints(heldSequence, at_ns, kept);
    keptOne = true;
  }

  function flush(): void {
    putHeld();
    if (chunk.length === 0) return;
    file.chunk(chunk.close(sink.position, compact?.packing));
    keptOne = false;
  }
  const flushWhenFull = (): void => {
    if (chunk.length >= chunkBytes || (chunk.length > 0 && now_ns - opened_ns >= chunk_ns)) flush();
  };
  const json = (value: unknown): Uint8Array<ArrayBuffer> => new Uint8Array(utf8Bytes(JSON.stringify(value)));

  function note<K extends NoteKind>(kind: K, what: Notes[K]): void {
    putHeld();
    put(CHANNEL[kind], file.counts[CHANNEL[kind]]!, json(what));
    digester.note({ ...what, at_s: now_ns / 1e9, kind } as Note);
    flushWhenFull();
  }

  file.begin({ name: RUN_METADATA, metadata: run });
  return {
    get samples() {
      return samples;
    },
    get duration_s() {
      return now_ns / 1e9;
    },
    get problem() {
      return file.problem;
    },
    get cycle() {
      return digester.open;
    },
    record(sample) {
      if (finished || file.problem) return;
      if (samples++ === 0) firstSample_s = sample.time_s;
      // A clock that jumps back must not make the file run backwards: readers search it by time.
      const at_ns = Math.round((sample.time_s - firstSample_s) * 1e9);
      if (at_ns > now_ns) now_ns = at_ns;
      flushWhenFull();
      const before = state?.safety ?? "normal";
      let changed = false;
      if (!state || !sameState(state, sample)) {
        putHeld();
        state = copyState(sample);
        stateBytes = json(state);
        put(CHANNEL.state, 0, stateBytes);
        changed = true;
      }
      if (
        sample.signals !== undefined &&
        !(io && sameLines(io, sample.signals)) &&
        (io !== null || sample.signals.size > 0)
      ) {
        putHeld();
        io = new Map(sample.signals);
        ioBytes = json({ signals: Object.fromEntries(io) });
        put(CHANNEL.io, 0, ioBytes);
        changed = true;
      }
      if (compact) for (let i = 0; i < n; i++) seen[i] = Math.round(sample.q_rad[i]! / QUANTUM) * QUANTUM;
      const q = compact ? seen : sample.q_rad;
      digester.sample(now_ns / 1e9, q, sample);
      if (keptOne && !changed && still >= 0 && within(kept, q, still)) {
        held_ns = now_ns;
        heldSequence = sample.sequence;
      } else {
        putHeld();
        putJoints(sample.sequence, now_ns, q);
        kept.set(q);
        keptOne = true;
      }
      if (sample.safety !== before) {
        const active = sample.safety !== "normal";
        note("alarm", {
          code: `safety.${active ? sample.safety : before}`,
          active,
          sentence: active ? sample.message || SAFETY_WORDS[sample.safety] : "Back to normal.",
          hint: "",
        });
      }
    },
    event(kind, sentence, level = "info") {
      if (finished || file.problem) return;
      putHeld();
      const at_ns = startedAt_ns + BigInt(now_ns);
      const timestamp = { sec: Number(at_ns / 1_000_000_000n), nsec: Number(at_ns % 1_000_000_000n) };
      put(
        CHANNEL.events,
        file.counts[CHANNEL.events]!,
        utf8Bytes(
          JSON.stringify({ timestamp, level: LEVELS[level], message: sentence, name: kind, file: "", line: 0 }),
        ),
      );
      digester.event(now_ns / 1e9, kind, level, sentence);
      flushWhenFull();
    },
    note(kind, what) {
      if (finished || file.problem) return;
      note(kind, what);
    },
    flush,
    finish() {
      if (finished) return;
      flush();
      finished = true;
      const digest: Digest = digester.result();
      file.end([{ name: DIGEST_METADATA, metadata: new Map([["json", JSON.stringify(digest)]]) }]);
    },
  };
}

const SAFETY_WORDS = {
  normal: "",
  "guard-stop": "The guard stopped the robot.",
  "protective-stop": "The robot is in a protective stop.",
  "emergency-stop": "The robot is in an emergency stop.",
} as const;

/** Every joint is within the band about where it was kept. */
function within(kept: Float64Array, q: ArrayLike<number>, band: number): boolean {
  for (let i = 0; i < kept.length; i++) if (!(Math.abs(q[i]! - kept[i]!) <= band)) return false;
  return true;
}
function sameLines(a: ReadonlyMap<string, boolean | number>, b: ReadonlyMap<string, boolean | number>): boolean {
  if (a.size !== b.size) return false;
  for (const [name, value] of a) if (b.get(name) !== value) return false;
  return true;
}
