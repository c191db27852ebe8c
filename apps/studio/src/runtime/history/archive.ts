import type { ByteSink } from "@twincell/recording";
import { createStore, delMany, get, keys, set, type UseStore } from "idb-keyval";
import type { RunRecord } from "../../stores/history.ts";

/** Where runs are kept: the browser's database, or memory in tests. */
export interface RunStorage {
  set(key: string, value: unknown): Promise<void>;
  get(key: string): Promise<unknown>;
  keys(): Promise<readonly string[]>;
  remove(keys: readonly string[]): Promise<void>;
}

export function browserRunStorage(): RunStorage {
  let store: UseStore | undefined;
  const opened = (): UseStore => (store ??= createStore("twincell-runs", "runs"));
  return {
    set: (key, value) => set(key, value, opened()),
    get: key => get<unknown>(key, opened()),
    keys: async () => (await keys(opened())).map(String),
    remove: wanted => delMany([...wanted], opened()),
  };
}

const META = "meta:";
const PIECE = "piece:";
const pieceKey = (id: string, n: number): string => `${PIECE}${id}:${String(n).padStart(8, "0")}`;

/** One run on its way to the shelf, piece by piece: a page that closes loses only the piece under way. */
export interface RunFile {
  readonly sink: ByteSink;
  /** Tells the shelf how the run stands. */
  note(record: RunRecord): void;
  /** Resolves when everything handed over so far is kept, with the sentence of the first trouble, or null. */
  settled(): Promise<string | null>;
}

export function openRunFile(runStorage: RunStorage, id: string): RunFile {
  let position = 0;
  let pieces = 0;
  let problem: string | null = null;
  let last: Promise<void> = Promise.resolve();
  const keep = (key: string, value: unknown): void => {
    last = last
      .then(() => runStorage.set(key, value))
      .catch((reason: unknown) => {
        problem ??= isFull(reason)
          ? "The browser has no room left for this recording."
          : `The recording could not be kept: ${reason instanceof Error ? reason.message : String(reason)}.`;
      });
  };
  return {
    sink: {
      get position() {
        return position;
      },
      write(bytes) {
        if (problem !== null) throw new Error(problem);
        position += bytes.length;
        keep(pieceKey(id, pieces++), bytes.slice());
      },
    },
    note(record) {
      keep(META + id, record);
    },
    async settled() {
      await last;
      return problem;
    },
  };
}

const isFull = (reason: unknown): boolean => reason instanceof Error && reason.name === "QuotaExceededError";

/** All runs on the shelf, newest first. One that never ended was cut off. */
export async function listRuns(runStorage: RunStorage): Promise<RunRecord[]> {
  const metas = (await runStorage.keys()).filter(key => key.startsWith(META));
  const records = await Promise.all(metas.map(key => runStorage.get(key) as Promise<RunRecord>));
  return records
    .map(record => (record.ending === "running" ? { ...record, ending: "cut-off" as const } : record))
    .sort((a, b) => b.startedAt.localeCompare(a.startedAt));
}

/** The file of a run. */
export async function runBlob(runStorage: RunStorage, id: string): Promise<Blob> {
  const wanted = (await runStorage.keys()).filter(key => key.startsWith(`${PIECE}${id}:`)).sort();
  return new Blob(await Promise.all(wanted.map(key => runStorage.get(key) as Promise<Uint8Array<ArrayBuffer>>)), {
    type: "application/octet-stream",
  });
}

/** Runs older than this go; while all together weigh more than that, the oldest go. */
export const KEEP_RUNS = { days: 90, bytes: 1_000_000_000 } as const;
const DAY_MS = 86_400_000;

/** Removes what is kept no longer; the newest run always stays. @returns how many went. */
export async function tidyRuns(runStorage: RunStorage, now_ms: number): Promise<number> {
  const [newest, ...older] = await listRuns(runStorage);
  let bytes = newest?.bytes ?? 0;
  let gone = 0;
  for (const run of older) {
    bytes += run.bytes;
    if (bytes <= KEEP_RUNS.bytes && now_ms - Date.parse(run.startedAt) <= KEEP_RUNS.days * DAY_MS) continue;
    await removeRun(runStorage, run.id);
    gone++;
  }
  return gone;
}

export async function removeRun(runStorage: RunStorage, id: string): Promise<void> {
  await runStorage.remove(
    (await runStorage.keys()).filter(key => key === META + id || key.startsWith(`${PIECE}${id}:`)),
  );
}
