import type { RunFacts, Samples } from "../decode.ts";
import { createDecoder } from "../decode.ts";
import type { Cycle, Mark, Minute } from "../digest.ts";
import { chunkShape } from "../layout.ts";
import type { Packing } from "../packing.ts";
import type { RobotState } from "../state.ts";
import { catalogue, type Catalogued, type CatalogueFile } from "./catalogue.ts";
import type { FilePort, StoredFile } from "./port.ts";

/** Everything about one instant: enough to look at it, or to go on from it. */
export interface Moment {
  /** When, in seconds since the start of the history. */
  readonly t_s: number;
  /** Angles of the last sample at or before it. */
  readonly q_rad: Float64Array;
  readonly sequence: number;
  readonly state: RobotState;
  /** The lines in and out, as far as any was ever written. */
  readonly signals: Readonly<Record<string, boolean | number>>;
  /** False when nothing was recorded then: this is how it stood before. */
  readonly recorded: boolean;
}
/** What one file of the history is, on the history's time. */
export interface Stretch {
  readonly name: string;
  readonly from_s: number;
  readonly to_s: number;
  readonly bytes: number;
  readonly program: string;
  readonly cell: string;
  readonly complete: boolean;
  readonly damaged: number;
}

/**
 * Hours and days of one robot, in any number of files, of which only what is looked at is read. Times count from its
 * first sample.
 */
export interface History
  extends Pick<RunFacts, "robot" | "robotName" | "program" | "cell" | "startedAt_ns" | "joints"> {
  readonly duration_s: number;
  readonly stretches: readonly Stretch[];
  readonly marks: readonly Mark[];
  readonly cycles: readonly Cycle[];
  /** Summed up minute by minute; `minute` counts from the start of the history. */
  readonly minutes: readonly Minute[];
  /** What could not be read, in words; empty when all is well. */
  readonly troubles: readonly string[];
  /** That instant, if the part of the file it is in was read before; allocates little and waits for nothing. */
  peek(t_s: number): Moment | null;
  /** That instant. Rejects when a file is gone. */
  at(t_s: number): Promise<Moment>;
  /** Part after part of all that was recorded from … to; times count from the start of the history. */
  samples(from_s: number, to_s: number): AsyncGenerator<Samples & { readonly offset_s: number }, void>;
  /** The last alarm before that time, or null. */
  lastAlarm(before_s: number): Mark | null;
}
export type OpenedHistory =
  | { readonly kind: "history"; readonly history: History }
  | { readonly kind: "not-a-recording"; readonly sentence: string };

export interface HistoryOptions {
  readonly packing?: Packing;
  /** Opens one file by its index; somebody may do it elsewhere, in a worker. */
  readonly catalogue?: (file: StoredFile) => Promise<Catalogued>;
  /** Id of the robot that is meant where several were recorded; the one of the newest file when left out. */
  readonly robot?: string;
}

/** Slices that are kept for going back and forth: some minutes of a moving robot. */
const KEPT = 256;
/** Where samples are further apart nothing was recorded. */
const GAP_S = 1.5;

/** Opens all recordings of a place as one history. A file that cannot be read is named and left out. */
export async function openHistory(port: FilePort, options: HistoryOptions = {}): Promise<OpenedHistory> {
  const files: CatalogueFile[] = [];
  const problems: string[] = [];
  for (const stored of await port.list()) {
    const read = await (options.catalogue?.(stored) ?? catalogue(port, stored, options.packing));
    if (read.kind === "file") files.push(read.file);
    else problems.push(`${stored.name}: ${read.sentence}`);
  }
  files.sort((a, b) =>
    a.facts.startedAt_ns < b.facts.startedAt_ns ? -1 : a.facts.startedAt_ns > b.facts.startedAt_ns ? 1 : 0,
  );
  const wanted = options.robot ?? files.at(-1)?.facts.robot;
  const ours = files.filter(
    ({ facts }) =>
      facts.robot === wanted && facts.joints === files.findLast(each => each.facts.robot === wanted)!.facts.joints,
  );
  for (const { name, facts } of files)
    if (facts.robot !== wanted) problems.push(`${name} is of another robot, ${facts.robotName || facts.robot}.`);
  const [first] = ours;
  if (!first)
    return {
      kind: "not-a-recording",
      sentence:
        problems.length === 1 ? problems[0]!.replace(/^[^:]*: /, "") : (problems[0] ?? "There is no recording here."),
    };
  for (const { name, complete, damaged } of ours) {
    if (damaged > 0)
      problems.push(`${name} is damaged in ${damaged} ${damaged === 1 ? "place" : "places"}; the rest of it is here.`);
    else if (!complete) problems.push(`${name} was cut off; it is here up to its last second.`);
  }
  return { kind: "history", history: historyOf(port, ours, problems, options.packing) };
}

interface Slice {
  readonly samples: Samples;
  readonly offset_s: number;
}

function historyOf(
  port: FilePort,
  files: readonly CatalogueFile[],
  problems: readonly string[],
  packing: Packing | undefined,
): History {
  const { facts } = files[0]!;
  const last = files.at(-1)!;
  const zero_s = files[0]!.chunks[0]!.from_s;
  const offset_s = files.map(file => Number(file.facts.startedAt_ns - facts.startedAt_ns) / 1e9 - zero_s);
  const duration_s = Math.max(...files.map((file, i) => offset_s[i]! + file.chunks.at(-1)!.to_s));
  const slices = new Map<string, Slice | Promise<Slice>>();

  /** File and chunk that hold that time, or the last before it. */
  function find(t_s: number): { readonly file: number; readonly chunk: number } {
    const file = lastAtOrBefore(files.length, i => offset_s[i]! + files[i]!.chunks[0]!.from_s, t_s);
    const { chunks } = files[file]!;
    return { file, chunk: lastAtOrBefore(chunks.length, i => offset_s[file]! + chunks[i]!.from_s, t_s) };
  }
  function keep(key: string, slice: Slice): Slice {
    slices.delete(key);
    slices.set(key, slice);
    for (const oldest of slices.keys()) {
      if (slices.size <= KEPT) break;
      slices.delete(oldest);
    }
    return slice;
  }
  function load({ file, chunk }: { file: number; chunk: number }): Promise<Slice> {
    const key = `${file}:${chunk}`;
    const known = slices.get(key);
    if (known) return Promise.resolve(known);
    const { name, chunks, facts: of } = files[file]!;
    const place = chunks[chunk]!;
    const loading = port.read(name, place.at, place.length).then(bytes => {
      const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
      const shape = chunkShape(view, 0);
      const decoder = createDecoder(packing, of, 256);
      // A part that is damaged holds nothing; what was before it is in force.
      if (shape && shape.length <= bytes.length) decoder.chunk(bytes, view, 0, shape);
      return keep(key, { samples: decoder.samples(), offset_s: offset_s[file]! });
    });
    loading.catch(() => {
      slices.delete(key);
    });
    slices.set(key, loading);
    return loading;
  }
  function moment(t_s: number, { samples, offset_s: from_s }: Slice): Moment {
    const { times_s, q_rad, stateOf, states, sequences, notes } = samples;
    const n = times_s.length;
    const index = lastAtOrBefore(n, i => times_s[i]! + from_s, t_s + 1e-9);
    const lines =
      notes.findLast(note => note.kind === "io" && note.at_s + from_s <= t_s + 1e-9) ??
      notes.find(note => note.kind === "io");
    return {
      t_s,
      q_rad: n > 0 ? q_rad.subarray(index * facts.joints, (index + 1) * facts.joints) : new Float64Array(facts.joints),
      sequence: sequences[index] ?? 0,
      state: states[stateOf[index] ?? 0]!,
      signals: lines?.kind === "io" ? lines.signals : {},
      recorded: n > 0 && t_s - (times_s[index]! + from_s) <= GAP_S,
    };
  }
  const clamped = (t_s: number): number => Math.min(Math.max(Number.isNaN(t_s) ? 0 : t_s, 0), duration_s);

  const marks = files
    .flatMap((file, i) => file.digest.marks.map(mark => ({ ...mark, at_s: mark.at_s + offset_s[i]! })))
    .sort((a, b) => a.at_s - b.at_s);
  const cycles = files
    .flatMap((file, i) => {
      // A cycle that goes on in the next file is told there, whole.
      const goesOn = (files[i + 1]?.digest.cycles[0]?.from_s ?? 0) < 0;
      return file.digest.cycles
        .filter((cycle, k, all) => !(goesOn && k === all.length - 1 && cycle.ending === "open"))
        .map(cycle => ({ ...cycle, from_s: cycle.from_s + offset_s[i]!, to_s: cycle.to_s + offset_s[i]! }));
    })
    .sort((a, b) => a.from_s - b.from_s);
  const minutes = files.flatMap((file, i) =>
    file.digest.minutes.map(minute => ({ ...minute, minute: minute.minute + offset_s[i]! / 60 })),
  );

  return {
    robot: last.facts.robot,
    robotName: last.facts.robotName,
    program: last.facts.program,
    cell: last.facts.cell,
    joints: facts.joints,
    startedAt_ns: facts.startedAt_ns + BigInt(Math.round(zero_s * 1e9)),
    duration_s,
    marks,
    cycles,
    minutes,
    troubles: problems,
    stretches: files.map((file, i) => ({
      name: file.name,
      bytes: file.bytes,
      from_s: offset_s[i]! + file.chunks[0]!.from_s,
      to_s: offset_s[i]! + file.chunks.at(-1)!.to_s,
      program: file.facts.program,
      cell: file.facts.cell,
      complete: file.complete,
      damaged: file.damaged,
    })),
    peek(t_s) {
      const at_s = clamped(t_s);
      const { file, chunk } = find(at_s);
      const slice = slices.get(`${file}:${chunk}`);
      return slice && !(slice instanceof Promise) ? moment(at_s, slice) : null;
    },
    async at(t_s) {
      const at_s = clamped(t_s);
      const place = find(at_s);
      let slice = await load(place);
      for (let { file, chunk } = place; slice.samples.times_s.length === 0 && chunk > 0; )
        slice = await load({ file, chunk: --chunk });
      return moment(at_s, slice);
    },
    async *samples(from_s, to_s) {
      for (let { file, chunk } = find(clamped(from_s)); file < files.length; file++, chunk = 0) {
        for (const { chunks } = files[file]!; chunk < chunks.length; chunk++) {
          if (offset_s[file]! + chunks[chunk]!.from_s > to_s) return;
          const { samples, offset_s: at_s } = await load({ file, chunk });
          yield { ...samples, offset_s: at_s };
        }
      }
    },
    lastAlarm: before_s => marks.findLast(mark => mark.kind === "alarm" && mark.at_s < before_s - 1e-6) ?? null,
  };
}

/** Index of the last of n rising values at or below that one; 0 when none is. */
function lastAtOrBefore(n: number, value: (i: number) => number, at: number): number {
  let low = 0;
  let high = n - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (value(middle) <= at) low = middle;
    else high = middle - 1;
  }
  return Math.max(low, 0);
}
