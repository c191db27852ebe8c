import { existsSync, mkdirSync, readFileSync, renameSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { PlainFault, type Scheduler } from "@twincell/core";

const FORMAT = "twincell.data";
/** Of the folder as a whole: which files it has and what they are called. Each file says its own version besides. */
export const DATA_VERSION = 1;
const FILE = "folder.json";
/** The last time that is known is kept this often [s]. */
const KEPT_EACH_S = 60;
/** Less is what clocks that are set by the network do [ms]. */
const SKEW_MS = 5 * 60_000;

export interface DataFolder {
  /**
   * Clock of the day that never runs back behind what this folder has seen [ms]: a clock that is set back makes no
   * token good again.
   */
  now_ms(): number;
  close(): void;
}
interface Kept {
  readonly version: number;
  readonly release: string;
  readonly seen_ms: number;
}

function read(path: string): Kept | null {
  if (!existsSync(path)) return null;
  const fault = (why: string, hint: string): PlainFault => new PlainFault("data.folder", `${path} ${why}`, hint);
  let value: { readonly format?: unknown; readonly version?: unknown; readonly release?: unknown } & {
    readonly seen_ms?: unknown;
  };
  try {
    value = JSON.parse(readFileSync(path, "utf8")) as typeof value;
  } catch (problem) {
    throw fault(
      `cannot be read: ${problem instanceof Error ? problem.message : String(problem)}.`,
      "Restore a backup (twincell backup restore), or remove the file when the folder is as it should be.",
    );
  }
  const { format, version, release, seen_ms } = value;
  if (format !== FORMAT || typeof version !== "number" || typeof seen_ms !== "number")
    throw fault("says nothing about a data folder.", "Remove it when the folder is Twincell's.");
  if (version > DATA_VERSION)
    throw fault(
      `says that the folder is of version ${version}, written by Twincell ${String(release)}; this release reads versions up to ${DATA_VERSION}.`,
      "Start that release, or restore a backup that was made before the upgrade.",
    );
  return { version, release: String(release), seen_ms };
}

/**
 * Opens a data folder: one of a later release is refused before anything in it is touched. A clock behind the last time
 * that the folder has seen is said, and counts as that time.
 */
export function openDataFolder(
  data: string,
  release: string,
  clock_ms: () => number,
  scheduler: Scheduler,
  say: (sentence: string) => void,
): DataFolder {
  const path = join(data, FILE);
  const before = read(path);
  let seen_ms = before?.seen_ms ?? 0;
  const behind_ms = seen_ms - clock_ms();
  if (behind_ms > SKEW_MS)
    say(
      `The clock of this machine is ${Math.round(behind_ms / 60_000)} min behind the last time that ${data} has seen (${new Date(seen_ms).toISOString()}): until it is set, tokens end as if it were that time, and new recordings sort before old ones.`,
    );
  const now_ms = (): number => (seen_ms = Math.max(seen_ms, clock_ms()));
  let told = false;
  const keep = (): void => {
    const kept = { format: FORMAT, version: DATA_VERSION, release, seen_ms: now_ms() };
    try {
      mkdirSync(data, { recursive: true });
      writeFileSync(`${path}.new`, `${JSON.stringify(kept)}\n`, { mode: 0o600 });
      renameSync(`${path}.new`, path);
      told = false;
    } catch (problem) {
      if (!told) say(`${path} cannot be written: ${problem instanceof Error ? problem.message : String(problem)}.`);
      told = true;
    }
  };
  keep();
  const stop = scheduler.every(KEPT_EACH_S, keep);
  return {
    now_ms,
    close() {
      stop();
      keep();
    },
  };
}
