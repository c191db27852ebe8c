import { emptyCell, openDocument, type CellDocument } from "@twincell/project";
import { words } from "../messages/index.ts";
import { cellStore } from "./cell.ts";
import { showDocument } from "./document.ts";
import { libraryStore, theLibrary, type CellFacts, type Fetched } from "./library.ts";
import { dismissAll, notify } from "./notices.ts";
import { select } from "./selection.ts";

/** What is known of the open cell beside its document; the scene and the check give their share. */
let factsNow: () => CellFacts = () => ({});
export const onKeepFacts = (facts: () => CellFacts): void => {
  factsNow = facts;
};
/** Remembers the open cell as it is now for the library of cells. */
export function keepPresent(): void {
  const { document } = cellStore.getState();
  const { current } = libraryStore.getState();
  if (document && current !== "") theLibrary()?.remember(current, document, factsNow());
}
/**
 * Opens another cell, under a new id unless it is one of the library. The one that was open is kept first: it is
 * remembered here and written before anything of the new one is.
 */
export function openCell(document: CellDocument, id?: string): void {
  keepPresent();
  const library = theLibrary();
  library?.flush().catch(() => undefined); // It goes on waiting, and the next save says why.
  libraryStore.setState({ current: id ?? library?.newId() ?? "" });
  select(null);
  dismissAll();
  showDocument(document);
}
/** Opens a saved cell. Nothing changes when the text is not one; then one sentence says why. */
export function openCellText(text: string, name: string): boolean {
  const opened = openDocument(text);
  switch (opened.kind) {
    case "opened":
      openCell(opened.document);
      notify(
        "done",
        words.file.opened(opened.document.name),
        opened.lifted.length > 0 ? words.file.lifted(opened.lifted.join(" ")) : undefined,
      );
      return true;
    case "too-new":
      notify("bad", words.file.tooNew(opened.version, opened.newest), words.file.tooNewHint);
      return false;
    case "not-a-cell":
      notify(
        "bad",
        words.file.notCell(name, opened.why[0] ?? ""),
        opened.why.length > 1 ? words.check.more(opened.why.length - 1) : words.file.notCellHint,
      );
      return false;
  }
}
const notRead = (problem: unknown): Fetched => ({
  kind: "missing",
  sentence: words.file.noKeep(problem instanceof Error ? problem.message : String(problem)),
});
/** Moves a cell to the trash. The open one makes place for the newest other, or for an empty one. */
export async function trashCell(id: string): Promise<void> {
  const library = theLibrary();
  if (!library) return;
  if (id === libraryStore.getState().current) {
    const next = libraryStore.getState().cells?.find(cell => cell.id !== id && cell.trashed_ms === null);
    if (!next || !(await openStored(next.id))) openCell(emptyCell());
  }
  await library.flush();
  await library.trash(id);
}

/**
 * Opens a cell of the library, or one of its versions; the version becomes its newest state once it is changed or left.
 */
export async function openStored(id: string, version?: number): Promise<boolean> {
  const library = theLibrary();
  if (!library) return false;
  if (id === libraryStore.getState().current && version === undefined) return true;
  keepPresent();
  const found = await library.fetch(id, version).catch(notRead);
  if (found.kind === "missing") {
    notify("bad", found.sentence, words.file.notCellHint);
    return false;
  }
  openCell(found.document, id);
  library.beginVersion(id);
  notify("done", words.file.opened(found.document.name));
  return true;
}
