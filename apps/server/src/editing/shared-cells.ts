import { randomBytes } from "node:crypto";
import { mkdir, readFile, rename, rm, writeFile } from "node:fs/promises";
import { join } from "node:path";
import type { CommandOutcome, Scheduler } from "@twincell/core";
import { openDocument, saveDocument, type CellDocument } from "@twincell/project";
import { createEditingRoom, type EditingRoom } from "@twincell/project/sharing";
import { refused } from "@twincell/protocol";
import type { DocumentFolder } from "../api/documents.ts";

/** A cell is written so long after a change at the latest [s]. */
const KEPT_EACH_S = 0.5;
/** What is written before the bytes of a shared document: format, version and the epoch of its editors. */
const HEAD = /^twincell\.shared-cell 1 ([0-9a-f]{32})\n/;
const FOLDER = "editing";
const MOST_ROOMS = 100;
/** How a connection ends: the server goes away and may come back; or there is nothing to come back to, as 410 says. */
const GOES_AWAY = 1001;
const REMOVED = 4410;

/** One cell that people edit together, for one who comes in. */
export interface OpenRoom {
  readonly room: EditingRoom;
  /** Called when they go: a cell that nobody edits is closed once it is kept. */
  leave(): void;
}
/** The cells of the data folder as people edit them together. */
export interface SharedCells {
  /** @param ended  told when the cell is taken away under its editors. */
  open(name: string, ended: (why: string, code: number) => void): Promise<OpenRoom | CommandOutcome>;
  /** Somebody wrote the cell by the API: whoever edits it gets that as a change. */
  written(name: string, document: unknown): void;
  removed(name: string): Promise<void>;
  /** Keeps everything; nobody edits afterwards. */
  close(): Promise<void>;
}
export interface SharedCellsOptions {
  readonly folder: string | undefined;
  readonly cells: DocumentFolder;
  readonly scheduler: Scheduler;
  readonly say: (sentence: string) => void;
}

interface Kept {
  readonly room: EditingRoom;
  readonly editors: Set<(why: string, code: number) => void>;
  changed: boolean;
  busy: boolean;
  /** Writing, one after the other. */
  writing: Promise<void>;
  told: string;
}

export function createSharedCells({ folder, cells, scheduler, say }: SharedCellsOptions): SharedCells {
  const open = new Map<string, Promise<Kept | CommandOutcome>>();
  const ready = new Map<string, Kept>();
  const pathOf = (name: string): string => join(folder!, FOLDER, `${name}.yjs`);

  /** The kept document of the editors, or null where there is none that can be read. */
  async function readKept(name: string): Promise<{ readonly epoch: string; readonly state: Uint8Array } | null> {
    try {
      const bytes = await readFile(pathOf(name));
      const head = HEAD.exec(bytes.subarray(0, 80).toString("latin1"));
      if (head) return { epoch: head[1]!, state: Uint8Array.from(bytes.subarray(head[0].length)) };
      say(`${pathOf(name)} is no shared document of this release: the cell is shared anew.`);
    } catch (problem) {
      if ((problem as NodeJS.ErrnoException).code !== "ENOENT") throw problem;
    }
    return null;
  }
  function roomFrom(
    kept: Awaited<ReturnType<typeof readKept>>,
    document: CellDocument,
    onChange: () => void,
    name: string,
  ): EditingRoom {
    if (kept) {
      try {
        const room = createEditingRoom({ from: kept, onChange });
        // The file is what counts: it may have been written while nobody edited.
        if (text(room.document) !== text(document)) room.replace(document);
        return room;
      } catch (problem) {
        say(`${pathOf(name)} cannot be read: ${(problem as Error).message}. The cell is shared anew.`);
      }
    }
    return createEditingRoom({ from: { document, epoch: randomBytes(16).toString("hex") }, onChange });
  }

  async function load(name: string): Promise<Kept | CommandOutcome> {
    const found = await cells.get(name);
    if (!("document" in found)) return found;
    const opened = openDocument(JSON.stringify(found.document));
    if (opened.kind !== "opened")
      return refused("documents.unreadable", `The cell “${name}” cannot be opened.`, "Write it anew with PUT.");
    const kept: Kept = {
      room: roomFrom(
        await readKept(name),
        opened.document,
        () => {
          kept.changed = true;
        },
        name,
      ),
      editors: new Set(),
      changed: true,
      busy: false,
      writing: Promise.resolve(),
      told: "",
    };
    ready.set(name, kept);
    return kept;
  }

  /** First what editors need to merge, then the cell: one of the two alone is mended when the cell is next opened. */
  async function write(name: string, kept: Kept): Promise<void> {
    kept.changed = false;
    kept.busy = true;
    const { room } = kept;
    const half = `${pathOf(name)}.${process.pid}.new`;
    try {
      await mkdir(join(folder!, FOLDER), { recursive: true });
      await writeFile(half, Buffer.concat([Buffer.from(`twincell.shared-cell 1 ${room.epoch}\n`), room.state()]), {
        flush: true,
        mode: 0o600,
      });
      await rename(half, pathOf(name));
      const outcome = await cells.put(name, JSON.parse(saveDocument(room.document)) as unknown);
      if (outcome.kind === "refused") throw new Error(outcome.why.sentence);
      kept.told = "";
    } catch (problem) {
      await rm(half, { force: true }).catch(() => undefined); // The fault itself is said below.
      kept.changed = true;
      const sentence = `The cell “${name}” cannot be kept: ${(problem as Error).message}. Its editors go on; it is tried again.`;
      if (sentence !== kept.told) say(sentence);
      kept.told = sentence;
    }
    kept.busy = false;
  }
  const keep = (name: string, kept: Kept): Promise<void> => (kept.writing = kept.writing.then(() => write(name, kept)));

  function drop(name: string, kept: Kept): void {
    if (kept.editors.size > 0 || kept.changed || kept.busy || ready.get(name) !== kept) return;
    ready.delete(name);
    open.delete(name);
    kept.room.close();
  }
  const stop = scheduler.every(KEPT_EACH_S, () => {
    for (const [name, kept] of ready) {
      if (kept.changed && !kept.busy) void keep(name, kept);
      else drop(name, kept);
    }
  });

  function end(name: string, kept: Kept, why: string, code: number): void {
    ready.delete(name);
    open.delete(name);
    for (const ended of kept.editors) ended(why, code);
    kept.room.close();
  }
  return {
    async open(name, ended) {
      if (!open.has(name) && open.size >= MOST_ROOMS)
        return refused("editing.busy", "Very many cells are being edited here.", "Try again later.");
      const opening = open.get(name) ?? load(name);
      open.set(name, opening);
      let kept: Kept | CommandOutcome;
      try {
        kept = await opening;
      } catch (problem) {
        open.delete(name);
        throw problem;
      }
      if (!("room" in kept)) {
        open.delete(name);
        return kept;
      }
      const there = kept;
      there.editors.add(ended);
      return {
        room: there.room,
        leave: () => {
          there.editors.delete(ended);
        },
      };
    },
    written(name, document) {
      const kept = ready.get(name);
      const opened = kept && openDocument(JSON.stringify(document));
      if (opened?.kind === "opened") kept!.room.replace(opened.document);
    },
    async removed(name) {
      const kept = ready.get(name);
      if (kept) {
        await kept.writing;
        end(name, kept, "This cell was removed from the server.", REMOVED);
      }
      if (folder !== undefined) await rm(pathOf(name), { force: true });
      // A write that was under way may have put it back.
      if (kept) await cells.delete(name);
    },
    async close() {
      stop();
      for (const [name, kept] of ready) {
        if (kept.changed) await keep(name, kept);
        await kept.writing;
        end(name, kept, "The server closes.", GOES_AWAY);
      }
    },
  };
}

/** A cell as text, without the program that somebody works on. */
const text = (cell: CellDocument): string => saveDocument({ ...cell, program: "" });
