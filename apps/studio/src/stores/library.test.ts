import { edgeTraceCell, EXAMPLES, emptyCell, openDocument, saveDocument, type CellDocument } from "@twincell/project";
import { beforeEach, expect, test } from "vitest";
import { keepDocument, openKept, type Clock } from "./autosave.ts";
import { cellStore } from "./cell.ts";
import { commit, redo, undo } from "./document.ts";
import type { KeyValueStore } from "./keeper.ts";
import { CellLibrary, libraryStore, TRASH_MS, setLibrary } from "./library.ts";
import { noticeStore } from "./notices.ts";
import { openCell, openCellText, openStored, trashCell } from "./opening.ts";

/** Keeps texts; every write can be made to fail, or to be the last one before the page is gone. */
class Memory implements KeyValueStore {
  readonly kept = new Map<string, unknown>();
  full = false;
  /** How many more writes reach the disk; the page is closed in the middle of the next one. */
  writesLeft = Infinity;
  get(key: string): Promise<unknown> {
    return Promise.resolve(this.kept.get(key));
  }
  keys(): Promise<readonly unknown[]> {
    return Promise.resolve([...this.kept.keys()]);
  }
  set(key: string, value: unknown): Promise<void> {
    if (this.full) return Promise.reject(Object.assign(new Error("no room"), { name: "QuotaExceededError" }));
    if (this.writesLeft <= 0) return Promise.reject(new Error("the page is gone"));
    this.writesLeft--;
    this.kept.set(key, value);
    return Promise.resolve();
  }
  delete(key: string): Promise<void> {
    this.kept.delete(key);
    return Promise.resolve();
  }
}
/** Time that passes when told, with whatever is due in it. */
class Time implements Clock {
  now_ms = 1_000_000;
  readonly #due: { at_ms: number; act: () => void }[] = [];
  after(ms: number, act: () => void): () => void {
    const entry = { at_ms: this.now_ms + ms, act };
    this.#due.push(entry);
    return () => {
      const at = this.#due.indexOf(entry);
      if (at >= 0) this.#due.splice(at, 1);
    };
  }
  async pass(ms: number): Promise<void> {
    const end_ms = this.now_ms + ms;
    for (;;) {
      this.#due.sort((a, b) => a.at_ms - b.at_ms);
      const next = this.#due[0];
      if (!next || next.at_ms > end_ms) break;
      this.#due.shift();
      this.now_ms = next.at_ms;
      next.act();
      await settled();
    }
    this.now_ms = end_ms;
    await settled();
  }
}
const settled = (): Promise<void> => new Promise(done => setImmediate(done));

class Page {
  readonly library: CellLibrary;
  readonly time: Time;
  readonly #stop: () => void;
  private constructor(memory: Memory, time: Time, ids: { next: number }) {
    this.time = time;
    this.library = new CellLibrary(
      memory,
      () => time.now_ms,
      () => `cell${ids.next++}`,
    );
    setLibrary(this.library);
    this.#stop = keepDocument(memory, time, this.library);
  }
  static async open(memory: Memory, time: Time, ids: { next: number }): Promise<Page> {
    cellStore.setState({ document: null, saving: { kind: "saved" }, undo: [], redo: [] });
    libraryStore.setState({ cells: null, current: "" });
    const page = new Page(memory, time, ids);
    await page.library.load();
    await openKept(memory, page.library);
    return page;
  }
  /** The page goes without a word: nothing more is written. */
  close(): void {
    this.#stop();
    setLibrary(null);
  }
}
const shown = (): CellDocument => cellStore.getState().document!;
const rename = (name: string): boolean => commit("name", document => ({ ...document, name }));
const names = (): string[] => (libraryStore.getState().cells ?? []).map(cell => cell.name).sort();

let memory: Memory;
let time: Time;
let ids: { next: number };
let page: Page;
beforeEach(async () => {
  noticeStore.setState({ notices: [] });
  memory = new Memory();
  time = new Time();
  ids = { next: 1 };
  page = await Page.open(memory, time, ids);
});

test("a new cell, an example and an opened file never replace what was open: it is in the library, to the last edit", async () => {
  rename("Mine");
  openCell(emptyCell()); // At once: the autosave has not seen the edit yet.
  await time.pass(500);
  expect(names()).toEqual(["Mine"]);
  rename("Second");
  openCell(edgeTraceCell());
  rename("Third");
  expect(openCellText(saveDocument({ ...emptyCell(), name: "From a file" }), "file.json")).toBe(true);
  await time.pass(30_000);
  expect(names()).toEqual(["From a file", "Mine", "Second", "Third"]);
  const mine = libraryStore.getState().cells!.find(cell => cell.name === "Mine")!;
  expect(await openStored(mine.id)).toBe(true);
  expect(shown().name).toBe("Mine");
});

test("an example as it came is not kept: looking at any of them leaves no cell behind", async () => {
  for (const { make } of EXAMPLES) openCell(make());
  openCell(emptyCell());
  openCell(edgeTraceCell());
  await time.pass(30_000);
  expect(names()).toEqual([]);
});

test("a version can be gone back to, and what stood before is a version too", async () => {
  rename("One");
  await time.pass(60_000);
  const { current } = libraryStore.getState();
  await time.pass(11 * 60_000);
  rename("Two");
  await time.pass(60_000);
  expect(page.library.cell(current)!.versions).toHaveLength(2);
  await openStored(current, 1);
  expect(shown().name).toBe("One");
  rename("One again");
  await time.pass(60_000);
  const kept: string[] = [];
  for (const { number } of page.library.cell(current)!.versions) {
    const found = await page.library.fetch(current, number);
    kept.push(found.kind === "opened" ? found.document.name : found.sentence);
  }
  expect(kept).toContain("Two");
  expect(kept.at(-1)).toBe("One again");
});

test("the trash gives a cell back for 30 days, also the one that was open, and is emptied after that", async () => {
  rename("Old fixture");
  await time.pass(30_000);
  const { current } = libraryStore.getState();
  await trashCell(current);
  expect(libraryStore.getState().current).not.toBe(current);
  await time.pass(30_000);
  expect(page.library.cell(current)!.trashed_ms).not.toBeNull();
  page.close();
  await time.pass(TRASH_MS - 3_600_000);
  page = await Page.open(memory, time, ids);
  await page.library.putBack(current);
  await openStored(current);
  expect(shown().name).toBe("Old fixture");
  await time.pass(30_000);
  await trashCell(current);
  page.close();
  await time.pass(TRASH_MS + 3_600_000);
  page = await Page.open(memory, time, ids);
  expect(page.library.cell(current)).toBeUndefined();
  expect([...memory.kept.keys()].filter(key => key.includes(`library.cell.${current}.`))).toEqual([]);
});

test("a damaged record of a cell is made anew from what the cell holds", async () => {
  rename("Mended");
  await time.pass(30_000);
  page.close();
  for (const key of memory.kept.keys()) if (key.startsWith("twincell.library.facts.")) memory.kept.set(key, "{spoilt");
  page = await Page.open(memory, time, ids);
  expect(names()).toEqual(["Mended"]);
});

test("a full disk: another cell opens, the one before waits in memory and is kept as soon as there is room", async () => {
  memory.full = true;
  rename("Waits");
  openCell(emptyCell());
  rename("Other");
  await time.pass(1000);
  expect(cellStore.getState().saving.kind).toBe("problem");
  memory.full = false;
  rename("Other one");
  await time.pass(30_000);
  expect(names()).toEqual(["Other one", "Waits"]);
});

/** Mulberry32: a seeded sequence of fractions. */
function fractions(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 4_294_967_296;
  };
}

test("10,000 random actions lose no cell: edits, other cells, trash, versions, a full disk, pages closed in the middle of a write", async () => {
  const random = fractions(20_261_123);
  const promised = new Map<string, Promised>();
  let edits = 0;
  let crashes = 0;
  const promise = (id: string, name: string): void => {
    if (name.startsWith("edit")) promised.set(id, { name, since: [] });
  };
  const remember = (): void => {
    if (cellStore.getState().saving.kind === "saved") promise(libraryStore.getState().current, shown().name);
  };
  const pick = <T>(list: readonly T[]): T | undefined => list[Math.floor(random() * list.length)];
  const actions: readonly (readonly [weight: number, act: () => Promise<void> | void])[] = [
    [40, () => void rename(`edit ${++edits}`)],
    [10, () => void undo()],
    [5, () => void redo()],
    [20, () => time.pass(500).then(remember)],
    [4, () => time.pass(25_000).then(remember)],
    [2, () => time.pass(11 * 60_000).then(remember)],
    [2, () => openCell(emptyCell())],
    [2, () => openCell(edgeTraceCell())],
    [1, () => void openCellText(saveDocument({ ...emptyCell(), name: `edit ${++edits}` }), "a file")],
    [1, () => void openCellText('{"format": "twincell.cell", ', "no cell")],
    [4, async () => void (await openStored(pick(libraryStore.getState().cells ?? [])?.id ?? "none"))],
    [
      2,
      async () => {
        const cell = pick(libraryStore.getState().cells ?? []);
        const version = cell && pick(cell.versions);
        if (cell && version) await openStored(cell.id, version.number);
      },
    ],
    [
      1,
      async () =>
        void (await page.library.duplicate(pick(libraryStore.getState().cells ?? [])?.id ?? "none").catch(expectFull)),
    ],
    [2, () => trashCell(pick(libraryStore.getState().cells ?? [])?.id ?? "none").catch(expectFull)],
    [2, () => page.library.putBack(pick(libraryStore.getState().cells ?? [])?.id ?? "none").catch(expectFull)],
    [1, () => void (memory.full = random() < 0.3)],
    [
      2,
      async () => {
        // The page goes in the middle of one of its next writes; what is then read is what reached the disk.
        remember();
        crashes++;
        memory.writesLeft = Math.floor(random() * 4);
        rename(`edit ${++edits}`);
        promised.get(libraryStore.getState().current)?.since.push(shown().name);
        if (random() < 0.5) openCell(emptyCell());
        await time.pass(500);
        page.close();
        await settled();
        memory.writesLeft = Infinity;
        memory.full = false;
        page = await Page.open(memory, time, ids);
      },
    ],
  ];
  const total = actions.reduce((sum, [weight]) => sum + weight, 0);
  for (let i = 0; i < 10_000; i++) {
    let at = random() * total;
    const [, act] = actions.find(([weight]) => (at -= weight) < 0)!;
    const before = { id: libraryStore.getState().current, name: shown().name, crashes };
    await act();
    await settled();
    const { current } = libraryStore.getState();
    // Another cell is open: the one before was kept on the way, if the disk took it.
    if (current !== before.id && crashes === before.crashes && !memory.full) promise(before.id, before.name);
    promised.get(current)?.since.push(shown().name);
    if (i % 500 === 499) await everyPromiseHolds(promised);
  }
  memory.full = false;
  rename("edit last");
  await time.pass(30_000);
  remember();
  page.close();
  page = await Page.open(memory, time, ids);
  await everyPromiseHolds(promised);
  expect(edits).toBeGreaterThan(3000);
  expect(crashes).toBeGreaterThan(100);
  expect(promised.size).toBeGreaterThan(100);
}, 120_000);

const expectFull = (problem: unknown): void => {
  expect(String(problem)).toContain("no room");
};
/** What a cell held when the studio last said it was saved, or when another was opened; and all it has held since. */
interface Promised {
  readonly name: string;
  readonly since: string[];
}
/** Every cell that was said to be saved is in the library, and its newest version is that state or a later one. */
async function everyPromiseHolds(promised: ReadonlyMap<string, Promised>): Promise<void> {
  memory.full = false;
  await page.library.flush();
  const { current } = libraryStore.getState();
  for (const [id, { name, since }] of promised) {
    if (id === current) {
      expect([name, ...since]).toContain(shown().name);
      continue;
    }
    const versions = page.library.cell(id)?.versions ?? [];
    // All of it undone again, it is an example as it came.
    if (versions.length === 0 && since.at(-1)?.startsWith("edit") === false) continue;
    expect(versions.length, `${name} (${id}) is there`).toBeGreaterThan(0);
    const opened = openDocument(String(memory.kept.get(`twincell.library.cell.${id}.${versions.at(-1)!.number}`)));
    expect(opened.kind, `the newest version of ${id} can be opened`).toBe("opened");
    if (opened.kind === "opened")
      expect([name, ...since], `${id} was promised ${name}`).toContain(opened.document.name);
  }
}
