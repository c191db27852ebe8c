import type { Refusal } from "@twincell/core";
import { crc32Final, crc32Init, crc32Update } from "@foxglove/crc";
import {
  McapRecordBuilder,
  Opcode,
  type Channel,
  type ChunkIndex,
  type Metadata,
  type MetadataIndex,
  type Schema,
} from "@mcap/core";
import type { ByteSink } from "./sink.ts";

export interface McapFile {
  begin(metadata: Metadata): void;
  /** Writes a closed chunk. */
  chunk(closed: { readonly pieces: readonly Uint8Array[]; readonly index: ChunkIndex }): void;
  /** Writes what sums the file up, then its index. */
  end(summary: readonly Metadata[]): void;
  /** Messages of each channel; counted by whoever writes them. */
  readonly counts: number[];
  /** Why the sink took no more; nothing is written after it. */
  readonly problem: Refusal | null;
}

/** Everything of an MCAP file that is not per message: head, chunks, summary, index, checksums. */
export function mcapFile(
  sink: ByteSink,
  { schemas, channels }: { readonly schemas: readonly Schema[]; readonly channels: readonly Channel[] },
): McapFile {
  const indexes: ChunkIndex[] = [];
  const metadataIndexes: MetadataIndex[] = [];
  const counts = channels.map(() => 0);
  let problem: Refusal | null = null;
  let crc = crc32Init();

  function write(bytes: Uint8Array, inDataSection = true): void {
    if (problem) return;
    try {
      sink.write(bytes);
    } catch (reason) {
      problem = {
        code: "recording.no-room",
        sentence: `Recording ended after ${sink.position} bytes: ${reason instanceof Error ? reason.message : "the place it is written to takes no more"}`,
        hint: "Make room, then start a new recording. The part written so far can be opened.",
      };
      return;
    }
    if (inDataSection) crc = crc32Update(crc, bytes);
  }
  function writeMetadata(metadata: Metadata): void {
    const offset = BigInt(sink.position);
    let length = 0n;
    write(
      recordsOf(builder => {
        length = builder.writeMetadata(metadata);
      }),
    );
    metadataIndexes.push({ name: metadata.name, offset, length });
  }
  function statistics() {
    const first = indexes[0];
    const last = indexes.at(-1);
    return {
      messageCount: BigInt(counts.reduce((sum, count) => sum + count, 0)),
      schemaCount: used().length,
      channelCount: used().length,
      attachmentCount: 0,
      metadataCount: metadataIndexes.length,
      chunkCount: indexes.length,
      messageStartTime: first?.messageStartTime ?? 0n,
      messageEndTime: last?.messageEndTime ?? 0n,
      channelMessageCounts: new Map(
        counts.map((count, id) => [id, BigInt(count)] as const).filter(([, count]) => count > 0n),
      ),
    };
  }
  const used = (): readonly Channel[] => channels.filter(channel => counts[channel.id]! > 0);

  return {
    counts,
    get problem() {
      return problem;
    },
    begin(metadata) {
      write(
        recordsOf(builder => {
          builder.writeMagic();
          builder.writeHeader({ profile: "", library: "twincell" });
        }),
      );
      writeMetadata(metadata);
    },
    chunk({ pieces, index }) {
      for (const piece of pieces) write(piece);
      if (!problem) indexes.push(index);
    },
    end(summaries) {
      for (const metadata of summaries) writeMetadata(metadata);
      write(
        recordsOf(builder => {
          builder.writeDataEnd({ dataSectionCrc: crc32Final(crc) });
        }),
        false,
      );
      const summaryStart = sink.position;
      const groups: [Opcode, (builder: McapRecordBuilder) => void][] = [
        [
          Opcode.SCHEMA,
          builder => {
            for (const channel of used()) builder.writeSchema(schemas[channel.schemaId - 1]!);
          },
        ],
        [
          Opcode.CHANNEL,
          builder => {
            for (const channel of used()) builder.writeChannel(channel);
          },
        ],
        [
          Opcode.STATISTICS,
          builder => {
            builder.writeStatistics(statistics());
          },
        ],
        [
          Opcode.METADATA_INDEX,
          builder => {
            for (const index of metadataIndexes) builder.writeMetadataIndex(index);
          },
        ],
        [
          Opcode.CHUNK_INDEX,
          builder => {
            for (const index of indexes) builder.writeChunkIndex(index);
          },
        ],
      ];
      const summary = new McapRecordBuilder();
      const offsets = new McapRecordBuilder();
      for (const [groupOpcode, fill] of groups) {
        const from = summary.length;
        fill(summary);
        const groupLength = BigInt(summary.length - from);
        if (groupLength > 0n)
          offsets.writeSummaryOffset({ groupOpcode, groupStart: BigInt(summaryStart + from), groupLength });
      }
      const footer = {
        summaryStart: BigInt(summaryStart),
        summaryOffsetStart: BigInt(summaryStart + summary.length),
        summaryCrc: 0,
      };
      // The summary's checksum covers the footer up to the checksum itself.
      const head = recordsOf(builder => {
        builder.writeFooter(footer);
      }).subarray(0, 1 + 8 + 8 + 8);
      const summaryCrc = crc32Final(
        crc32Update(crc32Update(crc32Update(crc32Init(), summary.buffer), offsets.buffer), head),
      );
      write(summary.buffer, false);
      write(offsets.buffer, false);
      write(
        recordsOf(builder => {
          builder.writeFooter({ ...footer, summaryCrc });
          builder.writeMagic();
        }),
        false,
      );
    },
  };
}

export function recordsOf(fill: (builder: McapRecordBuilder) => void): Uint8Array {
  const builder = new McapRecordBuilder();
  fill(builder);
  return builder.buffer;
}
