import {
  emptyCell,
  EXAMPLES,
  isTextProgram,
  modelsOf,
  saveDocument,
  type CellDocument,
  type ModelFacts,
} from "@twincell/project";
import { robotById } from "@twincell/core";
import { createStore } from "zustand/vanilla";
import { openSaved } from "./catalogue.ts";
import type { KeyValueStore } from "./keeper.ts";
import { inStep } from "./document.ts";

/** A state of a cell one can go back to. */
export interface CellVersion {
  readonly number: number;
  readonly begun_ms: number;
  readonly saved_ms: number;
}
export type CellVerdict = "ok" | "warn" | "bad" | "unknown";
/** What is known of a cell beside its document. */
export interface CellFacts {
  /** A small picture as a data URL. */
  readonly thumbnail?: string;
  readonly verdict?: CellVerdict;
  readonly findings?: number;
}
export interface StoredCell extends CellFacts {
  readonly id: string;
  readonly name: string;
  readonly robot: string;
  /** As it was called when the cell was kept: a robot from a file is known only while its cell is open. */
  readonly robotName?: string;
  readonly saved_ms: number;
  /** When it was moved to the trash; null while it is not there. */
  readonly trashed_ms: number | null;
  /** Oldest first. */
  readonly versions: readonly CellVersion[];
  /** Names of its programs, points, objects, frames and tools, for the search. */
  readonly names: readonly string[];
  /** What its objects are, weigh and do, for the search over models; missing in what earlier releases kept. */
  readonly models?: readonly ModelFacts[];
}
export interface LibraryState {
  /** Newest first; null until they were read. */
  readonly cells: readonly StoredCell[] | null;
  /** Id of the cell that is open. */
  readonly current: string;
}
export const libraryStore = createStore<LibraryState>(() => ({ cells: null, current: "" }));

const CONTENT = "twincell.library.cell.";
const FACTS = "twincell.library.facts.";
/** Edits within this time of the first one are one version. */
const VERSION_MS = 10 * 60_000;
const MAX_VERSIONS = 30;
/** How long a cell stays in the trash. */
export const TRASH_MS = 30 * 24 * 3_600_000;

export type Fetched =
  | { readonly kind: "opened"; readonly document: CellDocument }
  | { readonly kind: "missing"; readonly sentence: string };

/**
 * All cells of this browser. Each version is a text under a key of its own and each cell has a record of its own, so
 * that a page closed in the middle of a write can spoil nothing but that write. A content is written before the record
 * that names it; a record that is missing or damaged is made anew from the contents. What waits to be written stays in
 * memory until it was.
 */
export class CellLibrary {
  readonly #store: KeyValueStore;
  readonly #now_ms: () => number;
  readonly #newId: () => string;
  readonly #cells = new Map<string, StoredCell>();
  /**
   * What each cell held when it was last written, and cells written since this page was opened: these go on with their
   * version.
   */
  readonly #written = new Map<string, string>();
  readonly #waiting = new Map<string, { readonly document: CellDocument; readonly facts: CellFacts }>();
  #queue: Promise<unknown> = Promise.resolve();

  constructor(store: KeyValueStore, now_ms: () => number, newId: () => string) {
    this.#store = store;
    this.#now_ms = now_ms;
    this.#newId = newId;
  }
  newId(): string {
    return this.#newId();
  }
  cell(id: string): StoredCell | undefined {
    return this.#cells.get(id);
  }

  /** Reads what there is, mends records and empties the trash of what has been there for 30 days. */
  load(): Promise<void> {
    return this.#inTurn(async () => {
      const keys = (await this.#store.keys()).filter(key => typeof key === "string");
      const numbers = new Map<string, number[]>();
      for (const key of keys) {
        const found = key.startsWith(CONTENT) ? /^(.+)\.(\d+)$/.exec(key.slice(CONTENT.length)) : null;
        if (found) numbers.set(found[1]!, [...(numbers.get(found[1]!) ?? []), Number(found[2])]);
      }
      for (const [id, found] of numbers) {
        found.sort((a, b) => a - b);
        const cell = await this.#readFacts(id, found);
        if (cell.trashed_ms !== null && this.#now_ms() - cell.trashed_ms > TRASH_MS) await this.#destroy(cell);
        else this.#cells.set(id, cell);
      }
      this.#publish();
    });
  }

  /** Keeps a state of a cell. A cell that is an example as it came, and was not kept before, is not worth it. */
  put(id: string, document: CellDocument, facts: CellFacts = {}): Promise<void> {
    this.#waiting.set(id, { document, facts });
    return this.flush();
  }
  /** Remembers a state to be kept; `flush` writes it. */
  remember(id: string, document: CellDocument, facts: CellFacts = {}): void {
    this.#waiting.set(id, { document, facts });
  }
  /** Writes what waits. What could not be written goes on waiting, and the promise fails. */
  flush(): Promise<void> {
    return this.#inTurn(async () => {
      for (const [id, wanted] of this.#waiting) {
        await this.#write(id, wanted.document, wanted.facts);
        if (this.#waiting.get(id) === wanted) this.#waiting.delete(id);
      }
    });
  }

  /** The newest readable state of a cell, or one of its versions. */
  async fetch(id: string, version?: number): Promise<Fetched> {
    await this.flush();
    const cell = this.#cells.get(id);
    if (!cell) return { kind: "missing", sentence: "This cell is no longer there." };
    const wanted = version === undefined ? cell.versions.map(each => each.number).reverse() : [version];
    for (const number of wanted) {
      const text = await this.#store.get(contentKey(id, number));
      const opened = typeof text === "string" ? await openSaved(text) : null;
      if (opened?.kind === "opened") return { kind: "opened", document: opened.document };
    }
    return { kind: "missing", sentence: `“${cell.name}” could not be read.` };
  }
  /** A copy under a name of its own. @returns its id, or null when there is nothing to copy. */
  async duplicate(id: string): Promise<string | null> {
    const found = await this.fetch(id);
    if (found.kind !== "opened") return null;
    const copy = this.#newId();
    const taken = new Set([...this.#cells.values()].map(cell => cell.name));
    let name = `${found.document.name} copy`;
    for (let n = 2; taken.has(name); n++) name = `${found.document.name} copy ${n}`;
    const { thumbnail, verdict, findings } = this.#cells.get(id) ?? {};
    await this.put(copy, { ...found.document, name }, given({ thumbnail, verdict, findings }));
    return copy;
  }
  /** Gives a cell that is not open another name. */
  async rename(id: string, name: string): Promise<void> {
    const found = await this.fetch(id);
    if (found.kind === "opened") await this.put(id, { ...found.document, name });
  }
  /** What is kept of a cell from now on is a version of its own. */
  beginVersion(id: string): void {
    this.#written.delete(id);
  }
  trash(id: string): Promise<void> {
    return this.#mark(id, this.#now_ms());
  }
  putBack(id: string): Promise<void> {
    return this.#mark(id, null);
  }

  #mark(id: string, trashed_ms: number | null): Promise<void> {
    return this.#inTurn(async () => {
      const cell = this.#cells.get(id);
      if (cell) await this.#record({ ...cell, trashed_ms });
    });
  }
  async #write(id: string, document: CellDocument, facts: CellFacts): Promise<void> {
    const before = this.#cells.get(id);
    const text = saveDocument(document);
    if (!before && isExample(document, text)) return;
    const now_ms = this.#now_ms();
    const last = before?.versions.at(-1);
    const written = this.#written.get(id);
    if (written === text && before?.trashed_ms === null) {
      if (Object.keys(facts).length > 0) await this.#record({ ...before, ...facts });
      return;
    }
    // A version begun by an earlier visit is never written over.
    const goesOn = last !== undefined && written !== undefined && now_ms - last.begun_ms < VERSION_MS;
    const version: CellVersion = goesOn
      ? { ...last, saved_ms: now_ms }
      : { number: (last?.number ?? 0) + 1, begun_ms: now_ms, saved_ms: now_ms };
    await this.#store.set(contentKey(id, version.number), text);
    this.#written.set(id, text);
    const versions = [...(before?.versions ?? []).filter(each => each.number !== version.number), version];
    const kept = versions.slice(-MAX_VERSIONS);
    await this.#record({
      ...before,
      ...facts,
      ...described(document),
      id,
      saved_ms: now_ms,
      trashed_ms: null,
      versions: kept,
    });
    for (const old of versions.slice(0, -MAX_VERSIONS)) await this.#store.delete(contentKey(id, old.number));
  }
  async #record(cell: StoredCell): Promise<void> {
    this.#cells.set(cell.id, cell);
    this.#publish();
    await this.#store.set(FACTS + cell.id, JSON.stringify(cell));
  }
  async #readFacts(id: string, numbers: readonly number[]): Promise<StoredCell> {
    const known = storedCell(await this.#store.get(FACTS + id));
    const versions = numbers.map(
      (number): CellVersion =>
        known?.versions.find(version => version.number === number) ?? {
          number,
          begun_ms: known?.saved_ms ?? 0,
          saved_ms: known?.saved_ms ?? 0,
        },
    );
    if (known && known.versions.at(-1)?.number === numbers.at(-1)) return { ...known, id, versions };
    for (const number of [...numbers].reverse()) {
      const text = await this.#store.get(contentKey(id, number));
      const opened = typeof text === "string" ? await openSaved(text) : null;
      if (opened?.kind !== "opened") continue;
      const saved_ms = known?.saved_ms ?? 0;
      return { ...known, ...described(opened.document), id, saved_ms, trashed_ms: known?.trashed_ms ?? null, versions };
    }
    return known
      ? { ...known, id, versions }
      : { id, name: id, robot: "", saved_ms: 0, trashed_ms: null, versions, names: [] };
  }
  async #destroy(cell: StoredCell): Promise<void> {
    for (const { number } of cell.versions) await this.#store.delete(contentKey(cell.id, number));
    await this.#store.delete(FACTS + cell.id);
  }
  #publish(): void {
    const cells = [...this.#cells.values()].sort((a, b) => b.saved_ms - a.saved_ms || (a.id < b.id ? -1 : 1));
    libraryStore.setState({ cells });
  }
  /** One after the other; one that fails keeps none from coming after it. */
  #inTurn<T>(act: () => Promise<T>): Promise<T> {
    const turn = this.#queue.then(act, act);
    this.#queue = turn.catch(() => undefined);
    return turn;
  }
}

const contentKey = (id: string, number: number): string => `${CONTENT}${id}.${number}`;
const given = (facts: { [key in keyof CellFacts]: CellFacts[key] | undefined }): CellFacts =>
  Object.fromEntries(Object.entries(facts).filter(([, value]) => value !== undefined));

const described = (document: CellDocument): Pick<StoredCell, "name" | "robot" | "robotName" | "names" | "models"> => ({
  name: document.name,
  robot: document.robot.id,
  ...(document.robot.file === undefined ? {} : { robotName: robotById(document.robot.id)?.name ?? "" }),
  names: [
    ...document.objects.map(({ name }) => name),
    ...document.frames.map(({ name }) => name),
    ...document.tools.map(({ name }) => name),
    ...document.programs.flatMap(program =>
      isTextProgram(program)
        ? [program.name]
        : [program.name, ...program.steps.flatMap(step => ("name" in step && step.name ? [step.name] : []))],
    ),
  ],
  models: modelsOf(document),
});

/** Whether nothing of an example was changed. Only the one of that name is written out: to write all takes 60 ms. */
const isExample = (document: CellDocument, text: string): boolean =>
  [...EXAMPLES.map(({ make }) => make()), emptyCell()].some(
    example => example.name === document.name && saveDocument(inStep(example)) === text,
  );

/** A record as it was written; null for anything else. */
function storedCell(text: unknown): StoredCell | null {
  if (typeof text !== "string") return null;
  try {
    const read: unknown = JSON.parse(text);
    return isStoredCell(read) ? read : null;
  } catch {
    return null; // Damaged: it is made anew from the contents.
  }
}
function isStoredCell(read: unknown): read is StoredCell {
  if (typeof read !== "object" || read === null) return false;
  const { name, robot, saved_ms, trashed_ms, versions, names } = read as Partial<Record<keyof StoredCell, unknown>>;
  return (
    typeof name === "string" &&
    typeof robot === "string" &&
    typeof saved_ms === "number" &&
    (trashed_ms === null || typeof trashed_ms === "number") &&
    Array.isArray(names) &&
    Array.isArray(versions) &&
    versions.every(
      (each: unknown) =>
        typeof each === "object" && each !== null && "number" in each && "begun_ms" in each && "saved_ms" in each,
    )
  );
}

let library: CellLibrary | null = null;
export const setLibrary = (next: CellLibrary | null): void => {
  library = next;
};
export const theLibrary = (): CellLibrary | null => library;
