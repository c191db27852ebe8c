import { statSync } from "node:fs";
import { openHistory, type History } from "@twincell/recording";
import { zstd } from "@twincell/recording/zstd";
import { recordingFile, recordingsFolder } from "@twincell/server";
import { UseFault } from "./usage.ts";

/** The recording of that file, or all of that folder; what of it cannot be read is said on standard error. */
export async function readHistory(path: string, robot?: string): Promise<History> {
  const found = statSync(path, { throwIfNoEntry: false });
  if (!found) throw new UseFault(`There is no file ${path}.`);
  const opened = await openHistory(found.isDirectory() ? recordingsFolder(path) : recordingFile(path), {
    packing: await zstd(),
    ...(robot === undefined ? {} : { robot }),
  });
  if (opened.kind === "not-a-recording") throw new UseFault(`${path} is no recording. ${opened.sentence}`);
  for (const problem of opened.history.troubles) process.stderr.write(`twincell: ${problem}\n`);
  return opened.history;
}
