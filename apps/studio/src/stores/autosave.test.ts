import { edgeTraceCell, emptyCell, saveDocument } from "@twincell/project";
import { beforeEach, expect, test } from "vitest";
import { keepDocument, openKept } from "./autosave.ts";
import type { Keeper } from "./keeper.ts";
import { cellStore } from "./cell.ts";
import { commit, showDocument } from "./document.ts";
import { noticeStore } from "./notices.ts";

class Memory implements Keeper {
  readonly kept = new Map<string, unknown>();
  trouble: Error | null = null;
  get(key: string): Promise<unknown> {
    return Promise.resolve(this.kept.get(key));
  }
  set(key: string, value: unknown): Promise<void> {
    if (this.trouble) return Promise.reject(this.trouble);
    this.kept.set(key, value);
    return Promise.resolve();
  }
}
const clock = () => {
  let act: (() => void) | null = null;
  return {
    after: (_ms: number, next: () => void) => {
      act = next;
      return () => {
        act = null;
      };
    },
    ring: async () => {
      act?.();
      act = null;
      for (let i = 0; i < 10; i++) await Promise.resolve();
    },
  };
};
const rename = (name: string): boolean => commit("name", document => ({ ...document, name }));

beforeEach(() => {
  cellStore.setState({ document: null, saving: { kind: "saved" }, undo: [], redo: [] });
  noticeStore.setState({ notices: [] });
});

test("what was kept comes back; the first visit opens the example", async () => {
  const memory = new Memory();
  const bell = clock();
  await openKept(memory);
  expect(cellStore.getState().document).toMatchObject({ name: edgeTraceCell().name, objects: edgeTraceCell().objects });
  const stop = keepDocument(memory, bell);
  rename("Mine");
  expect(cellStore.getState().saving.kind).toBe("unsaved");
  await bell.ring();
  expect(cellStore.getState().saving.kind).toBe("saved");
  stop();
  cellStore.setState({ document: null });
  await openKept(memory);
  expect(cellStore.getState().document?.name).toBe("Mine");
});

test("a page closed while writing leaves the earlier copy whole", async () => {
  const memory = new Memory();
  memory.kept.set("twincell.cell.a", saveDocument({ ...emptyCell(), name: "Earlier" }));
  memory.kept.set("twincell.cell.b", saveDocument({ ...emptyCell(), name: "Later" }).slice(0, 200));
  memory.kept.set("twincell.cell.current", "twincell.cell.b");
  await openKept(memory);
  expect(cellStore.getState().document?.name).toBe("Earlier");
  expect(noticeStore.getState().notices).toHaveLength(1);
});

test("a full disk is one sentence, nothing is lost, and it is kept again as soon as there is room", async () => {
  const memory = new Memory();
  const bell = clock();
  showDocument(edgeTraceCell());
  const stop = keepDocument(memory, bell);
  memory.trouble = Object.assign(new Error("no room"), { name: "QuotaExceededError" });
  rename("One");
  await bell.ring();
  rename("Two");
  await bell.ring();
  expect(cellStore.getState().saving.kind).toBe("problem");
  expect(noticeStore.getState().notices.map(notice => notice.sentence)).toEqual([
    "The browser has no room left to keep this cell.",
  ]);
  expect(cellStore.getState().document?.name).toBe("Two");
  memory.trouble = null;
  rename("Three");
  await bell.ring();
  expect(cellStore.getState().saving.kind).toBe("saved");
  stop();
});
