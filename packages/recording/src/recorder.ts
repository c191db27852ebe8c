import type { JointSample, Refusal, Robot } from "@twincell/core";
import { crc32Final, crc32Init, crc32Update } from "@foxglove/crc";
import { McapRecordBuilder, Opcode, type Channel, type ChunkIndex, type Schema } from "@mcap/core";
import { OpenChunk } from "./chunk.ts";
import { JOINT_STATE_SCHEMA, jointStateTemplate } from "./joint-state.ts";
import type { ByteSink } from "./sink.ts";
import { copyState, EVENT_SCHEMA, LEVELS, sameState, STATE_SCHEMA, type EventLevel, type RobotState } from "./state.ts";
import { utf8Bytes } from "./text.ts";

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
}

export interface RunRecorder {
  /** Allocates nothing while a chunk is open. */
  record(sample: JointSample): void;
  event(kind: string, sentence: string, level?: EventLevel): void;
  /** Closes the open chunk now, so that a crash after this costs nothing before it. */
  flush(): void;
  /** Writes the index that makes the file quick to open. Nothing is recorded after it. */
  finish(): void;
  readonly samples: number;
  /** Why recording ended early: the sink took no more. What was written until then can be read. */
  readonly problem: Refusal | null;
}

export const CHANNELS = { joints: 0, state: 1, events: 2 } as const;
export const TOPICS = ["/joint_states", "/robot_state", "/events"] as const;
/** Key of the channel metadata and name of the metadata record that say which run this is. */
export const RUN_METADATA = "twincell.run";

/**
 * Records a run to MCAP. Every chunk repeats schemas, channels and the state of the robot, so each can be read without
 * the others: whatever happens to the file, a damaged or missing chunk costs itself and nothing else.
 */
export function createRunRecorder(sink: ByteSink, header: RunHeader): RunRecorder {
  const { robot, startedAt_ns } = header, n = robot.arm.joints.length;
  const chunkBytes = header.chunkBytes ?? 128 * 1024, chunk_ns = (header.chunk_s ?? 1) * 1e9;
  const names = robot.arm.joints.map(joint => joint.name), template = jointStateTemplate(robot.frames.base, names);
  const start_s = Number(startedAt_ns / 1_000_000_000n), start_ns = Number(startedAt_ns % 1_000_000_000n);
  const run = new Map([
    ["version", "1"], ["robot", robot.id], ["robot_name", robot.name], ["program", header.program], ["cell", header.cell],
    ["started_at_ns", startedAt_ns.toString()], ["joints", JSON.stringify(names)],
  ]);
  const schemas: Schema[] = [JOINT_STATE_SCHEMA, STATE_SCHEMA, EVENT_SCHEMA].map(({ name, encoding, text }, i) => ({ id: i + 1, name, encoding, data: utf8Bytes(text) }));
  const channels: Channel[] = ["cdr", "json", "json"].map((messageEncoding, id) => ({ id, schemaId: id + 1, topic: TOPICS[id]!, messageEncoding, metadata: run }));
  const preamble = recordsOf(builder => {
    for (const schema of schemas) builder.writeSchema(schema);
    for (const channel of channels) builder.writeChannel(channel);
  });

  const chunk = new OpenChunk(chunkBytes + 8192, channels.length, startedAt_ns), indexes: ChunkIndex[] = [];
  const counts = [0, 0, 0];
  let state: RobotState | null = null, stateBytes = new Uint8Array(0), firstSample_s = NaN, now_ns = 0, opened_ns = 0, samples = 0;
  let problem: Refusal | null = null, finished = false, crc = crc32Init(), metadataAt = 0, metadataLength = 0n;

  function write(bytes: Uint8Array, inDataSection = true): void {
    if (problem) return;
    try {
      sink.write(bytes);
    } catch (reason) {
      problem = {
        code: "recording.no-room", sentence: `Recording ended after ${sink.position} bytes: ${reason instanceof Error ? reason.message : "the place it is written to takes no more"}`,
        hint: "Make room, then start a new recording. The part written so far can be opened.",
      };
      return;
    }
    if (inDataSection) crc = crc32Update(crc, bytes);
  }

  function put(channel: number, sequence: number, data: Uint8Array): number {
    if (chunk.length === 0) {
      opened_ns = now_ns;
      chunk.raw(preamble);
      if (state && channel !== CHANNELS.state) put(CHANNELS.state, 0, stateBytes);
    }
    const at = chunk.message(channel, sequence, now_ns, data.length);
    chunk.bytes.set(data, at);
    counts[channel]!++;
    return at;
  }

  function flush(): void {
    if (chunk.length === 0) return;
    const { pieces, index } = chunk.close(sink.position);
    for (const piece of pieces) write(piece);
    if (!problem) indexes.push(index);
  }
  const flushWhenFull = (): void => { if (chunk.length >= chunkBytes || now_ns - opened_ns >= chunk_ns) flush(); };

  write(recordsOf(builder => { builder.writeMagic(); builder.writeHeader({ profile: "", library: "twincell" }); }));
  metadataAt = sink.position;
  write(recordsOf(builder => { metadataLength = builder.writeMetadata({ name: RUN_METADATA, metadata: run }); }));

  return {
    get samples() { return samples; },
    get problem() { return problem; },
    record(sample) {
      if (finished || problem) return;
      if (samples++ === 0) firstSample_s = sample.time_s;
      // A clock that jumps back must not make the file run backwards: readers search it by time.
      const at_ns = Math.round((sample.time_s - firstSample_s) * 1e9);
      if (at_ns > now_ns) now_ns = at_ns;
      flushWhenFull();
      if (!state || !sameState(state, sample)) {
        state = copyState(sample);
        stateBytes = new Uint8Array(utf8Bytes(JSON.stringify(state)));
        put(CHANNELS.state, 0, stateBytes);
      }
      const at = put(CHANNELS.joints, sample.sequence, template.bytes), { view } = chunk;
      const nanoseconds = start_ns + now_ns % 1e9, carry = nanoseconds >= 1e9 ? 1 : 0;
      view.setInt32(at + template.stampAt, start_s + Math.floor(now_ns / 1e9) + carry, true);
      view.setUint32(at + template.stampAt + 4, nanoseconds - carry * 1e9, true);
      for (let i = 0; i < n; i++) view.setFloat64(at + template.positionsAt + 8 * i, sample.q_rad[i]!, true);
    },
    event(kind, sentence, level = "info") {
      if (finished || problem) return;
      const at_ns = startedAt_ns + BigInt(now_ns);
      const timestamp = { sec: Number(at_ns / 1_000_000_000n), nsec: Number(at_ns % 1_000_000_000n) };
      put(CHANNELS.events, counts[CHANNELS.events]!, utf8Bytes(JSON.stringify({ timestamp, level: LEVELS[level], message: sentence, name: kind, file: "", line: 0 })));
      flushWhenFull();
    },
    flush,
    finish() {
      if (finished) return;
      flush();
      finished = true;
      write(recordsOf(builder => { builder.writeDataEnd({ dataSectionCrc: crc32Final(crc) }); }), false);
      const summaryStart = sink.position;
      const groups: [Opcode, (builder: McapRecordBuilder) => void][] = [
        [Opcode.SCHEMA, builder => { for (const schema of schemas) builder.writeSchema(schema); }],
        [Opcode.CHANNEL, builder => { for (const channel of channels) builder.writeChannel(channel); }],
        [Opcode.STATISTICS, builder => { builder.writeStatistics(statistics()); }],
        [Opcode.METADATA_INDEX, builder => { builder.writeMetadataIndex({ name: RUN_METADATA, offset: BigInt(metadataAt), length: metadataLength }); }],
        [Opcode.CHUNK_INDEX, builder => { for (const index of indexes) builder.writeChunkIndex(index); }],
      ];
      const summary = new McapRecordBuilder(), offsets = new McapRecordBuilder();
      for (const [groupOpcode, fill] of groups) {
        const from = summary.length;
        fill(summary);
        const groupLength = BigInt(summary.length - from);
        if (groupLength > 0n) offsets.writeSummaryOffset({ groupOpcode, groupStart: BigInt(summaryStart + from), groupLength });
      }
      const footer = { summaryStart: BigInt(summaryStart), summaryOffsetStart: BigInt(summaryStart + summary.length), summaryCrc: 0 };
      // The summary's checksum covers the footer up to the checksum itself.
      const head = recordsOf(builder => { builder.writeFooter(footer); }).subarray(0, 1 + 8 + 8 + 8);
      const summaryCrc = crc32Final(crc32Update(crc32Update(crc32Update(crc32Init(), summary.buffer), offsets.buffer), head));
      write(summary.buffer, false);
      write(offsets.buffer, false);
      write(recordsOf(builder => { builder.writeFooter({ ...footer, summaryCrc }); builder.writeMagic(); }), false);
    },
  };

  function statistics() {
    const first = indexes[0], last = indexes.at(-1);
    return {
      messageCount: BigInt(counts.reduce((sum, count) => sum + count, 0)), schemaCount: schemas.length, channelCount: channels.length,
      attachmentCount: 0, metadataCount: 1, chunkCount: indexes.length,
      messageStartTime: first?.messageStartTime ?? 0n, messageEndTime: last?.messageEndTime ?? 0n,
      channelMessageCounts: new Map(counts.map((count, id) => [id, BigInt(count)] as const)),
    };
  }
}

function recordsOf(fill: (builder: McapRecordBuilder) => void): Uint8Array {
  const builder = new McapRecordBuilder();
  fill(builder);
  return builder.buffer;
}
