import { mkdir, readdir, readFile, rename, rm, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { parseProgram, type CommandOutcome } from "@twincell/core";
import { refused } from "@twincell/protocol";
import { openDocument } from "@twincell/project";

const missing = (problem: unknown): boolean => (problem as NodeJS.ErrnoException).code === "ENOENT";

/** What is wrong with a document of that kind, or null. */
function faultOf(kind: "programs" | "cells", document: unknown): string | null {
  if (kind === "programs") {
    const parsed = parseProgram(document);
    if (parsed.kind === "program") return null;
    const [first] = parsed.faults;
    return `This is no program: ${first?.path ? `${first.path}: ` : ""}${first?.sentence ?? "it is empty."}`;
  }
  const opened = openDocument(JSON.stringify(document));
  if (opened.kind === "opened") return null;
  return opened.kind === "too-new"
    ? `The cell is of version ${opened.version}; this release reads versions up to ${opened.newest}.`
    : (opened.why[0] ?? "This is not a saved cell.");
}

/** Documents by name in a folder, each written whole or not at all. */
export function documentFolder(folder: string | undefined, kind: "programs" | "cells") {
  const noFolder = refused(
    "documents.no-folder",
    "This server keeps no documents: it has no data folder.",
    "Start it with --data DIR.",
  );
  const at = (name: string): string => join(folder!, kind, `${name}.json`);
  const none = (name: string): CommandOutcome =>
    refused("documents.none", `There is no “${name}” among the ${kind}.`, `GET /api/v1/${kind} lists them.`);
  return {
    async list(): Promise<readonly string[]> {
      if (folder === undefined) return [];
      try {
        const names = await readdir(join(folder, kind));
        return names
          .filter(name => name.endsWith(".json"))
          .map(name => name.slice(0, -5))
          .sort();
      } catch (problem) {
        if (missing(problem)) return [];
        throw problem;
      }
    },
    async get(name: string): Promise<{ readonly document: unknown } | CommandOutcome> {
      if (folder === undefined) return noFolder;
      try {
        return { document: JSON.parse(await readFile(at(name), "utf8")) as unknown };
      } catch (problem) {
        if (missing(problem)) return none(name);
        throw problem;
      }
    },
    async put(name: string, document: unknown): Promise<CommandOutcome> {
      if (folder === undefined) return noFolder;
      const fault = faultOf(kind, document);
      if (fault !== null) return refused("documents.unreadable", fault, "Nothing was kept.");
      await mkdir(join(folder, kind), { recursive: true });
      const half = `${at(name)}.${process.pid}.new`;
      try {
        await writeFile(half, `${JSON.stringify(document, null, 2)}\n`, { flush: true });
        await rename(half, at(name));
      } catch (problem) {
        await rm(half, { force: true });
        throw problem;
      }
      return { kind: "done" };
    },
    async delete(name: string): Promise<CommandOutcome> {
      if (folder === undefined) return noFolder;
      try {
        await rm(at(name));
        return { kind: "done" };
      } catch (problem) {
        if (missing(problem)) return none(name);
        throw problem;
      }
    },
  };
}
export type DocumentFolder = ReturnType<typeof documentFolder>;
