import { createHash, type Hash } from "node:crypto";
import { createReadStream, createWriteStream, existsSync } from "node:fs";
import { mkdir, readdir, readFile, rename, rm, stat, writeFile } from "node:fs/promises";
import { dirname, join, relative, sep } from "node:path";
import { Transform } from "node:stream";
import { pipeline } from "node:stream/promises";
import { PlainFault } from "@twincell/core";
import { z } from "zod";

const FORMAT = "twincell.backup";
const VERSION = 1;
const LIST = "backup.json";
/** Belong to the server that runs, not to what it keeps. */
const LEFT_OUT: ReadonlySet<string> = new Set(["audit.lock", "access-code.txt", "set-up-link.txt"]);
const isHalf = (name: string): boolean => name.endsWith(".new");
const list = z.object({
  format: z.literal(FORMAT),
  version: z.literal(VERSION),
  made: z.string(),
  files: z.array(z.object({ path: z.string(), bytes: z.int(), sha256: z.string().regex(/^[0-9a-f]{64}$/) })),
});
export type BackupList = z.infer<typeof list>;
const fault = (sentence: string, hint: string): PlainFault => new PlainFault("backup", sentence, hint);

async function filesUnder(folder: string): Promise<readonly string[]> {
  const entries = await readdir(folder, { recursive: true, withFileTypes: true });
  return entries
    .filter(entry => entry.isFile() && !LEFT_OUT.has(entry.name) && !isHalf(entry.name))
    .map(entry => relative(folder, join(entry.parentPath, entry.name)).split(sep).join("/"))
    .toSorted();
}
const hashing = (hash: Hash): Transform =>
  new Transform({
    transform(part: Buffer, _encoding, done) {
      hash.update(part);
      done(null, part);
    },
  });

/** How much of a file is whole while its server writes on: a log to its last line, anything else as long as it is. */
async function wholeBytes(path: string): Promise<number> {
  if (!path.endsWith(".jsonl")) return (await stat(path)).size;
  return (await readFile(path)).lastIndexOf(10) + 1;
}
async function copied(from: string, to: string, bytes: number): Promise<string> {
  const hash = createHash("sha256");
  await mkdir(dirname(to), { recursive: true });
  if (bytes === 0) await writeFile(to, "", { mode: 0o600 });
  else
    await pipeline(
      createReadStream(from, { end: bytes - 1 }),
      hashing(hash),
      createWriteStream(to, { mode: 0o600, flush: true }),
    );
  return hash.digest("hex");
}

/**
 * Copies a data folder while its server runs. Documents are written whole or not at all, recordings are whole in every
 * chunk and the audit log in every line: what is appended meanwhile belongs to the next backup. The list is written
 * last, so that a backup that was cut off is seen to be half.
 */
export async function makeBackup(data: string, to: string, made: Date): Promise<BackupList> {
  if (!existsSync(data)) throw fault(`There is no data folder ${data}.`, "Give the one of the server with --data.");
  if (existsSync(to) && (await readdir(to)).length > 0)
    throw fault(`${to} is not empty.`, "Give a folder that is not there yet.");
  const files: BackupList["files"] = [];
  for (const path of await filesUnder(data)) {
    const bytes = await wholeBytes(join(data, path));
    files.push({ path, bytes, sha256: await copied(join(data, path), join(to, "files", path), bytes) });
  }
  const made_list: BackupList = { format: FORMAT, version: VERSION, made: made.toISOString(), files };
  const half = join(to, `${LIST}.new`);
  await mkdir(to, { recursive: true });
  await writeFile(half, `${JSON.stringify(made_list, null, 2)}\n`, { flush: true });
  await rename(half, join(to, LIST));
  return made_list;
}

/** Reads every file of a backup. Throws with the first thing that is wrong with it. */
export async function checkBackup(from: string): Promise<BackupList> {
  let value: unknown;
  try {
    value = JSON.parse(await readFile(join(from, LIST), "utf8"));
  } catch {
    throw fault(`${from} is no backup, or half of one: it has no readable ${LIST}.`, "Make it anew.");
  }
  const parsed = list.safeParse(value);
  if (!parsed.success) {
    const { version } = (value ?? {}) as { readonly version?: unknown };
    throw typeof version === "number" && version > VERSION
      ? fault(`${from} is of version ${version}; this release reads version ${VERSION}.`, "Update Twincell.")
      : fault(`${from}: its ${LIST} cannot be understood.`, "Make the backup anew.");
  }
  for (const { path, bytes, sha256 } of parsed.data.files) {
    if (path.split("/").includes("..") || path.startsWith("/"))
      throw fault(`${from}: ${path} lies outside of the backup.`, "Do not use it.");
    const file = join(from, "files", path);
    const size = await stat(file).then(
      found => found.size,
      () => -1,
    );
    if (size !== bytes)
      throw fault(`${from}: ${path} has ${Math.max(0, size)} of ${bytes} bytes.`, "Make the backup anew.");
    const hash = createHash("sha256");
    for await (const part of createReadStream(file)) hash.update(part as Buffer);
    if (hash.digest("hex") !== sha256) throw fault(`${from}: ${path} was changed.`, "Use another backup.");
  }
  return parsed.data;
}

/** Puts a backup into a data folder that is not there yet: nothing that somebody made is written over. */
export async function restoreBackup(from: string, data: string): Promise<BackupList> {
  const checked = await checkBackup(from);
  if (existsSync(data) && (await readdir(data)).length > 0)
    throw fault(`${data} is not empty.`, "Move it away, or give another --data.");
  const half = `${data}.restoring`;
  await rm(half, { recursive: true, force: true });
  for (const { path, bytes } of checked.files) await copied(join(from, "files", path), join(half, path), bytes);
  await rm(data, { recursive: true, force: true });
  await mkdir(half, { recursive: true });
  await rename(half, data);
  return checked;
}
