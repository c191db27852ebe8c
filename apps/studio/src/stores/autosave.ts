import { edgeTraceCell, saveDocument, type CellDocument } from "@twincell/project";
import { openSaved } from "./catalogue.ts";
import { words } from "../messages/index.ts";
import { cellStore } from "./cell.ts";
import { showDocument } from "./document.ts";
import type { Keeper } from "./keeper.ts";
import { libraryStore, type CellLibrary } from "./library.ts";
import { notify } from "./notices.ts";

export interface Clock {
  after(ms: number, act: () => void): () => void;
}

/** Two copies in turn and a pointer that is moved last: a page closed while writing leaves the other copy whole. */
const COPIES = ["twincell.cell.a", "twincell.cell.b"] as const;
const POINTER = "twincell.cell.current";
const WAIT_MS = 400;
/** The open cell goes to the library of cells when this long has gone by, and when another is opened. */
const LIBRARY_MS = 20_000;
/**
 * Which cell of the library a copy is of; written before the copy, so that the pointer never names a copy of another
 * cell.
 */
const idKey = (copy: string): string => `${copy}.id`;

/** Opens what was kept, else the newest cell of the library, else the example. Says so when a copy was damaged. */
export async function openKept(keeper: Keeper, library?: CellLibrary): Promise<void> {
  const kept = await readKept(keeper, library);
  if (cellStore.getState().document !== null) return;
  libraryStore.setState({ current: kept.id });
  showDocument(kept.document);
  cellStore.setState({ saving: { kind: "saved" } });
  if (kept.damaged) notify("warn", kept.found ? words.file.damaged : words.file.lost);
}

interface Kept {
  readonly document: CellDocument;
  readonly id: string;
  readonly found: boolean;
  readonly damaged: boolean;
}
async function readKept(keeper: Keeper, library?: CellLibrary): Promise<Kept> {
  let damaged = false;
  const fresh = library?.newId() ?? "";
  try {
    const pointer = await keeper.get(POINTER);
    const order = pointer === COPIES[1] ? [COPIES[1], COPIES[0]] : COPIES;
    for (const key of order) {
      const text = await keeper.get(key);
      if (text === undefined) continue;
      const opened = typeof text === "string" ? await openSaved(text) : null;
      if (opened?.kind === "opened") {
        const id = await keeper.get(idKey(key));
        return { document: opened.document, id: typeof id === "string" ? id : fresh, found: true, damaged };
      }
      damaged = true;
    }
    const newest = libraryStore.getState().cells?.find(cell => cell.trashed_ms === null);
    const stored = newest && library ? await library.fetch(newest.id) : null;
    if (newest && stored?.kind === "opened") return { document: stored.document, id: newest.id, found: true, damaged };
  } catch {
    damaged = true; // a browser that forbids storage: the example opens, and the first save says why nothing is kept
  }
  return { document: edgeTraceCell(), id: fresh, found: false, damaged };
}

/** Keeps the document shortly after every change. What could not be kept stays open and is said in one sentence. */
export function keepDocument(keeper: Keeper, clock: Clock, library?: CellLibrary): () => void {
  let next = 0;
  let cancel: (() => void) | null = null;
  let writing = false;
  let told = "";
  let toLibrary: (() => void) | null = null;
  const write = async (): Promise<void> => {
    const { document } = cellStore.getState();
    const { current } = libraryStore.getState();
    if (!document || writing) return;
    writing = true;
    cellStore.setState({ saving: { kind: "saving" } });
    const key = COPIES[next % COPIES.length]!;
    try {
      // The cell that was open before has to be in the library before its copy here is written over.
      await library?.flush();
      if (library) await keeper.set(idKey(key), current);
      await keeper.set(key, saveDocument(document));
      await keeper.set(POINTER, key);
      next++;
      told = "";
      if (library) putSoon(library);
      cellStore.setState(state => ({ saving: { kind: state.document === document ? "saved" : "unsaved" } }));
    } catch (problem) {
      const full = problem instanceof Error && problem.name === "QuotaExceededError";
      const sentence = full
        ? words.file.fullDisk
        : words.file.noKeep(problem instanceof Error ? problem.message : String(problem));
      cellStore.setState({ saving: { kind: "problem", sentence } });
      if (told !== sentence) notify("bad", sentence, full ? words.file.fullDiskHint : words.file.noKeepHint);
      told = sentence;
    }
    writing = false;
    if (cellStore.getState().saving.kind === "unsaved") later();
  };
  const putSoon = (into: CellLibrary): void => {
    toLibrary ??= clock.after(LIBRARY_MS, () => {
      toLibrary = null;
      const { document } = cellStore.getState();
      // A failure here is told by the next save: what could not be written waits in the library.
      if (document) into.put(libraryStore.getState().current, document).catch(() => later());
    });
  };
  const later = (): void => {
    cancel?.();
    cancel = clock.after(WAIT_MS, () => {
      cancel = null;
      void write();
    });
  };
  void keeper.get(POINTER).then(
    pointer => {
      if (pointer === COPIES[0]) next = 1;
    },
    () => undefined,
  );
  const stop = cellStore.subscribe((now, before) => {
    if (now.document !== before.document && now.saving.kind !== "saved") later();
  });
  return () => {
    stop();
    cancel?.();
    toLibrary?.();
  };
}
