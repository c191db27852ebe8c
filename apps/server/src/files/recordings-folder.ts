import { closeSync, mkdirSync, openSync, writeSync } from "node:fs";
import { createHash } from "node:crypto";
import { open, readdir, rm, rmdir, stat } from "node:fs/promises";
import { basename, dirname, join } from "node:path";
import { expired, fileTime_ms, KEEPING, type ArchivePort, type FilePort, type FileSink } from "@twincell/recording";

/** What the operating system says, in words. */
const WHY: Readonly<Record<string, string>> = {
  ENOSPC: "the disk is full",
  EDQUOT: "the quota of this user is used up",
  EACCES: "this user may not write there",
  EPERM: "this user may not write there",
  EROFS: "the disk can only be read",
  EEXIST: "a file of that name is already there",
  ENOTDIR: "a part of the path is a file, not a folder",
  EISDIR: "it is a folder",
};
/** The operating system's reason why nothing could be written, in words; null for what is no such reason. */
export function diskWords(problem: unknown): string | null {
  const code = problem instanceof Error && "code" in problem ? String(problem.code) : "";
  return WHY[code] ?? null;
}
const inWords = (problem: unknown): Error => {
  const code = problem instanceof Error && "code" in problem ? String(problem.code) : "";
  return new Error(WHY[code] ?? (problem instanceof Error ? problem.message : String(problem)));
};

/**
 * A new file. Its bytes are with the operating system when `write` returns, so that only a crash of the machine itself
 * can lose them.
 */
export function newFile(path: string): FileSink {
  let file: number;
  let position = 0;
  try {
    mkdirSync(dirname(path), { recursive: true });
    file = openSync(path, "wx");
  } catch (problem) {
    throw inWords(problem);
  }
  return {
    get position() {
      return position;
    },
    write(bytes) {
      try {
        for (let at = 0; at < bytes.length; ) at += writeSync(file, bytes, at);
      } catch (problem) {
        throw inWords(problem);
      }
      position += bytes.length;
    },
    close() {
      closeSync(file);
    },
  };
}

async function readPart(path: string, from: number, length: number): Promise<Uint8Array> {
  const file = await open(path);
  try {
    const out = new Uint8Array(Math.max(0, Math.min(length, (await file.stat()).size - from)));
    for (let at = 0; at < out.length; ) {
      const { bytesRead } = await file.read(out, at, out.length - at, from + at);
      if (bytesRead === 0) return out.subarray(0, at);
      at += bytesRead;
    }
    return out;
  } finally {
    await file.close();
  }
}

/** The recordings of a folder; it is made when the first one is begun. */
export function recordingsFolder(folder: string): ArchivePort {
  return {
    async list() {
      const names = (await readdir(folder).catch(() => [])).filter(name => name.endsWith(".mcap")).sort();
      const files = await Promise.all(
        names.map(async name => ({ name, found: await stat(join(folder, name)).catch(() => null) })),
      );
      return files.flatMap(({ name, found }) => (found?.isFile() ? [{ name, bytes: found.size }] : []));
    },
    read: (name, from, length) => readPart(join(folder, basename(name)), from, length),
    create: name => newFile(join(folder, basename(name))),
    remove: name => rm(join(folder, basename(name)), { force: true }),
  };
}

/** Names that a disk of any system takes as they are, whatever other case it knows. */
const PLAIN = /^[a-z0-9_][a-z0-9_-]{0,59}$/;
/** Names of devices on Windows. */
const DEVICE = /^(con|prn|aux|nul|com\d|lpt\d)$/;

/** The folder of a robot's recordings among those of the others, by its id: never outside, never another one's. */
export function recordingFolderOf(id: string): string {
  if (PLAIN.test(id) && !DEVICE.test(id)) return id;
  const letters = id
    .slice(0, 60)
    .replace(/[^\w-]/g, "_")
    .replace(/^-/, "_");
  return `${letters}-${createHash("sha256").update(id).digest("hex").slice(0, 12)}`;
}

/**
 * Deletes what is too old or empty among the recordings of robots that are not recorded now, and folders of theirs that
 * are empty: one that never comes back leaves nothing for ever. Files that are not recordings stay, and so do their
 * folders.
 *
 * @param recorded  names of folders that are written to; their own archive keeps them tidy.
 */
export async function tidyRecordings(folder: string, recorded: ReadonlySet<string>, now_ms: number): Promise<void> {
  const entries = await readdir(folder, { withFileTypes: true }).catch((problem: unknown) => {
    if (problem instanceof Error && "code" in problem && problem.code === "ENOENT") return [];
    throw problem;
  });
  for (const entry of entries) {
    if (!entry.isDirectory() || recorded.has(entry.name)) continue;
    const place = join(folder, entry.name);
    const port = recordingsFolder(place);
    const files = await port.list();
    const empty = files.filter(({ name, bytes }) => bytes === 0 && !Number.isNaN(fileTime_ms(name)));
    const old = expired(files, KEEPING, now_ms);
    for (const name of [...old, ...empty.map(({ name }) => name)]) await port.remove(name);
    if ((await readdir(place)).length === 0) await rmdir(place);
  }
}

/** One recording by itself. */
export function recordingFile(path: string): FilePort {
  return {
    list: async () => [{ name: basename(path), bytes: (await stat(path)).size }],
    read: (_, from, length) => readPart(path, from, length),
  };
}
