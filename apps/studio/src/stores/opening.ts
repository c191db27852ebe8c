import { openDocument, type CellDocument } from "@twincell/project";
import { words } from "../words/index.ts";
import { showDocument } from "./document.ts";
import { notify } from "./notices.ts";
import { select } from "./selection.ts";

/** Opens another cell; what was taught before is already kept. */
export function openCell(document: CellDocument): void {
  select(null);
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
