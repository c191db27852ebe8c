import { conveyorPalletCell, edgeTraceCell, emptyCell, saveDocument } from "@twincell/project";
import { writtenProgram } from "../runtime/planning/posting.ts";
import { cellStore } from "../stores/cell.ts";
import type { Command } from "../stores/commands.ts";
import { openDialog } from "../stores/dialogs.ts";
import { notify } from "../stores/notices.ts";
import { objectOf, theProgram } from "../stores/document.ts";
import { openCell } from "../stores/opening.ts";
import { selectionStore } from "../stores/selection.ts";
import { cardOf, shapeStore } from "../stores/shapes.ts";
import { download } from "../ui/download.ts";
import { say, words } from "../messages/index.ts";

/** What a person does with whole cells; `chooseFile` lets them pick one from the disk. */
export const fileCommands = (chooseFile: () => void): readonly Command[] => [
  {
    id: "file.cells",
    group: "file",
    words: words.commands.cells,
    aliases: ["Open a cell", "Versions of a cell", "Trash"],
    keys: ["Mod+Shift+O"],
    run: () => openDialog("cells"),
  },
  {
    id: "file.save",
    group: "file",
    words: words.commands.save,
    keys: ["Mod+S"],
    can: () => cellStore.getState().document !== null,
    run: saveFile,
  },
  { id: "file.load", group: "file", words: words.commands.load, keys: ["Mod+O"], run: chooseFile },
  { id: "file.example", group: "file", words: words.commands.example, run: () => openCell(edgeTraceCell()) },
  { id: "file.conveyor", group: "file", words: words.commands.conveyor, run: () => openCell(conveyorPalletCell()) },
  {
    id: "file.shapes",
    group: "edit",
    words: words.shapes.command,
    can: () => importOfSelected() !== null,
    run: showImport,
  },
  {
    id: "export.save",
    group: "file",
    words: words.commands.exportSave,
    can: () => (theProgram()?.steps.length ?? 0) > 0,
    run: () => void saveExport(),
  },
  { id: "file.new", group: "file", words: words.commands.fresh, run: () => openCell(emptyCell()) },
];

/** The file that the selected object came from, when there is a report of it. */
function importOfSelected(): string | null {
  const { selected } = selectionStore.getState();
  const { document } = cellStore.getState();
  const shape = selected?.kind === "object" ? objectOf(document, selected.id)?.shape : undefined;
  return shape?.kind === "mesh" && cardOf(document, shape.file) ? shape.file : null;
}
function showImport(): void {
  const file = importOfSelected();
  if (file === null) return;
  shapeStore.setState({ shown: file });
  openDialog("shapes");
}

function saveFile(): void {
  const { document } = cellStore.getState();
  if (!document) return;
  const name = `${document.name.trim().replaceAll(/[^\p{L}\p{N}]+/gu, "-") || "cell"}.twincell.json`;
  download(name, new Blob([saveDocument(document)], { type: "application/json" }));
  notify("done", words.file.saved(name));
}

/** Writes the program in the language of its controller and hands its files to the browser, without a dialog. */
async function saveExport(): Promise<void> {
  const { document } = cellStore.getState();
  const program = theProgram();
  if (!document || !program) return;
  try {
    const { emitted } = await writtenProgram(program, document);
    if (emitted?.kind !== "emitted") {
      notify("bad", emitted ? say(`${emitted.sentence} ${emitted.hint}`) : words.export.cannot);
      return;
    }
    for (const { name, text } of emitted.files) download(name, new Blob([text], { type: "text/plain" }));
    const first = emitted.files[0];
    if (first) notify("done", words.headset.exported(first.name, first.lines.length));
  } catch (problem) {
    notify("bad", problem instanceof Error ? problem.message : String(problem));
  }
}
