import { edgeTraceCell, openDocument, saveDocument, type CellDocument } from "@twincell/project";
import { words } from "../words/index.ts";
import { cellStore } from "./cell.ts";
import { showDocument } from "./document.ts";
import { notify } from "./notices.ts";

/** A place that keeps texts: the browser's database, or a double in tests. Writing may fail. */
export interface Keeper {
  get(key: string): Promise<unknown>;
  set(key: string, value: unknown): Promise<void>;
}
export interface Clock {
  after(ms: number, act: () => void): () => void;
}

/** Two copies in turn and a pointer that is moved last: a page closed while writing leaves the other copy whole. */
const COPIES = ["twincell.cell.a", "twincell.cell.b"] as const;
const POINTER = "twincell.cell.current";
const WAIT_MS = 400;

/** Opens what was kept, else the example. Says so when a copy was damaged. */
export async function openKept(keeper: Keeper): Promise<void> {
  const kept = await readKept(keeper);
  if (cellStore.getState().document !== null) return;
  showDocument(kept.document);
  cellStore.setState({ saving: { kind: "saved" } });
  if (kept.damaged) notify("warn", kept.found ? words.file.damaged : words.file.lost);
}

async function readKept(
  keeper: Keeper,
): Promise<{ readonly document: CellDocument; readonly found: boolean; readonly damaged: boolean }> {
  let damaged = false;
  try {
    const pointer = await keeper.get(POINTER);
    const order = pointer === COPIES[1] ? [COPIES[1], COPIES[0]] : COPIES;
    for (const key of order) {
      const text = await keeper.get(key);
      if (text === undefined) continue;
      const opened = typeof text === "string" ? openDocument(text) : null;
      if (opened?.kind === "opened") return { document: opened.document, found: true, damaged };
      damaged = true;
    }
  } catch {
    damaged = true; // a browser that forbids storage: the example opens, and the first save says why nothing is kept
  }
  return { document: edgeTraceCell(), found: false, damaged };
}

/** Keeps the document shortly after every change. What could not be kept stays open and is said in one sentence. */
export function keepDocument(keeper: Keeper, clock: Clock): () => void {
  let next = 0;
  let cancel: (() => void) | null = null;
  let writing = false;
  let told = "";
  const write = async (): Promise<void> => {
    const { document } = cellStore.getState();
    if (!document || writing) return;
    writing = true;
    cellStore.setState({ saving: { kind: "saving" } });
    const key = COPIES[next % COPIES.length]!;
    try {
      await keeper.set(key, saveDocument(document));
      await keeper.set(POINTER, key);
      next++;
      told = "";
      cellStore.setState(state => ({ saving: { kind: state.document === document ? "saved" : "unsaved" } }));
    } catch (trouble) {
      const full = trouble instanceof Error && trouble.name === "QuotaExceededError";
      const sentence = full
        ? words.file.fullDisk
        : words.file.noKeep(trouble instanceof Error ? trouble.message : String(trouble));
      cellStore.setState({ saving: { kind: "problem", sentence } });
      if (told !== sentence) notify("bad", sentence, full ? words.file.fullDiskHint : words.file.noKeepHint);
      told = sentence;
    }
    writing = false;
    if (cellStore.getState().saving.kind === "unsaved") later();
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
  };
}
