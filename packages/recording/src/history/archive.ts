import type { JointSample, Refusal, Robot } from "@twincell/core";
import type { OpenCycle } from "../digest.ts";
import type { NoteKind, Notes } from "../notes.ts";
import { createRunRecorder, type Compact, type RunRecorder } from "../recorder.ts";
import type { EventLevel } from "../state.ts";
import { expired, fileName, KEEPING, type Keeping } from "./keeping.ts";
import type { ArchivePort, FileSink } from "./port.ts";

export interface ArchiveOptions {
  readonly robot: Robot;
  readonly cell: string;
  readonly program: string;
  readonly compact: Compact;
  /** Wall clock, nanoseconds since 1970. */
  readonly clock_ns: () => bigint;
  readonly keeping?: Partial<Keeping>;
}

/** Records for as long as it is open, file after file. */
export interface Archive {
  record(sample: JointSample): void;
  event(kind: string, sentence: string, level?: EventLevel): void;
  note<K extends NoteKind>(kind: K, what: Notes[K]): void;
  /** To be called a few times a second: keeps what waits although no sample comes, and deletes what is too old. */
  tick(): Promise<void>;
  close(): void;
  readonly file: string;
  /** Files that were deleted because they were too old or too many. */
  readonly deleted: number;
  /**
   * Why nothing is recorded now; the same from the first failure until recording goes on, which is tried every
   * `RETRY_S`.
   */
  readonly problem: Refusal | null;
}

/** A crash costs less than a second: the open chunk, one sample and the writing of it. */
const CHUNK_S = 0.8;
const SILENT_NS = 900_000_000n;
/** A place that takes nothing is tried again after so long: a full disk gets no file a sample [s]. */
export const RETRY_S = 2;
const TIDY_EVERY_NS = 60_000_000_000n;

export function createArchive(port: ArchivePort, options: ArchiveOptions): Archive {
  const { robot, cell, program, compact, clock_ns } = options;
  const keeping: Keeping = { ...KEEPING, ...options.keeping };
  let recorder: RunRecorder | null = null;
  let sink: FileSink | null = null;
  let file = "";
  let ended_ns = 0n;
  let began_ns = 0n;
  let seenAt = 0;
  let seen_ns = 0n;
  let tidied_ns = 0n;
  let deleted = 0;
  let cycle: OpenCycle | null = null;
  let version: Notes["cell"] | null = null;
  let problem: Refusal | null = null;
  let retry_ns = 0n;
  /** Files that were begun and took nothing. */
  const empty: string[] = [];
  let closed = false;

  function open(): RunRecorder {
    const now_ns = clock_ns();
    // Two files never share a moment, whatever the wall clock does.
    const before_ns = began_ns;
    began_ns = now_ns > ended_ns ? now_ns : ended_ns;
    if (cycle) cycle = { ...cycle, from_s: cycle.from_s - Number(began_ns - before_ns) / 1e9 };
    file = fileName(Number(began_ns / 1_000_000n), robot.id);
    sink = port.create(file);
    recorder = createRunRecorder(sink, {
      robot,
      startedAt_ns: began_ns,
      program,
      cell,
      compact,
      chunk_s: CHUNK_S,
      cycle,
    });
    cycle = null;
    if (version) recorder.note("cell", version);
    return recorder;
  }
  function end(): void {
    if (!recorder || !sink) return;
    const { duration_s } = recorder;
    ({ cycle } = recorder);
    recorder.finish();
    sink.close();
    // What is begun while its place takes nothing holds nothing that could be read.
    if (sink.position === 0 || (problem && recorder.problem)) empty.push(file);
    if (recorder.problem) fail(recorder.problem);
    // The next millisecond: names of files count in them.
    ended_ns = began_ns + BigInt(Math.ceil(duration_s * 1000) + 1) * 1_000_000n;
    recorder = null;
    sink = null;
  }
  /** Nothing is recorded until the next try; what went wrong first is what is said. */
  function fail(why: Refusal): void {
    problem ??= why;
    retry_ns = clock_ns() + BigInt(RETRY_S * 1e9);
  }
  /** The recorder under way; null when there is no room, or it is over. */
  function current(): RunRecorder | null {
    if (closed) return null;
    if (recorder && (recorder.duration_s >= keeping.file_s || sink!.position >= keeping.file_bytes)) end();
    if (recorder) return recorder;
    if (problem && clock_ns() < retry_ns) return null;
    let began: RunRecorder;
    try {
      began = open();
    } catch (reason) {
      fail({
        code: "recording.no-file",
        sentence: `No recording can be begun: ${reason instanceof Error ? reason.message : "its place takes none"}.`,
        hint: "Make room, or choose another folder.",
      });
      return null;
    }
    if (began.problem) {
      end();
      return null;
    }
    return began;
  }
  /** Hands something to the recorder; one whose place took no more is ended, so that the next begins a new file. */
  function hand(give: (to: RunRecorder) => void): void {
    const to = current();
    if (!to) return;
    give(to);
    if (to.problem) end();
    else if (problem && sink && sink.position > 0) {
      // Its head was written, but a chunk is what fills a disk.
      to.flush();
      if (to.problem) end();
      else problem = null;
    }
  }

  return {
    get file() {
      return file;
    },
    get deleted() {
      return deleted;
    },
    get problem() {
      return problem ?? recorder?.problem ?? null;
    },
    record(sample) {
      hand(to => {
        to.record(sample);
      });
    },
    event(kind, sentence, level) {
      hand(to => {
        to.event(kind, sentence, level);
      });
    },
    note(kind, what) {
      if (kind === "cell") version = what as Notes["cell"];
      hand(to => {
        to.note(kind, what);
      });
    },
    async tick() {
      const now_ns = clock_ns();
      for (let name = empty.pop(); name !== undefined; name = empty.pop()) await port.remove(name);
      // A source that fell silent closes no chunk by its samples.
      if (sink && sink.position !== seenAt) {
        seenAt = sink.position;
        seen_ns = now_ns;
      } else if (recorder && now_ns - seen_ns >= SILENT_NS) {
        recorder.flush();
        seen_ns = now_ns;
      }
      if (now_ns - tidied_ns < TIDY_EVERY_NS && tidied_ns !== 0n) return;
      tidied_ns = now_ns;
      for (const name of expired(await port.list(), keeping, Number(now_ns / 1_000_000n), file)) {
        await port.remove(name);
        deleted++;
      }
    },
    close() {
      end();
      closed = true;
    },
  };
}
