import { conveyorPalletCell, edgeTraceCell, emptyCell, saveDocument } from "@twincell/project";
import { DIALECTS } from "@twincell/languages";
import { useEffect, useRef, useState } from "react";
import { cellStore } from "../../stores/cell.ts";
import { registerCommands } from "../../stores/commands.ts";
import { notify } from "../../stores/notices.ts";
import { openCell } from "../../stores/opening.ts";
import { openDialog } from "../../stores/dialogs.ts";
import { objectOf } from "../../stores/document.ts";
import { selectionStore } from "../../stores/selection.ts";
import { cardOf, shapeStore } from "../../stores/shapes.ts";
import { IMPORT_ENDINGS } from "@twincell/formats";
import { download } from "../../ui/download.ts";
import { words } from "../../words/index.ts";
import { droppedFiles } from "./dropped.ts";
import { openFiles } from "./openFile.ts";
import "./files.css";

const KINDS = [
  ".json",
  ".mcap",
  ".txt",
  ".zip",
  ".mtl",
  ".bin",
  ...IMPORT_ENDINGS.map(ending => `.${ending}`),
  ...new Set(DIALECTS.flatMap(({ extensions }) => extensions)),
].join();

/** Save, open and drop. */
export function Files() {
  const input = useRef<HTMLInputElement>(null);
  const [over, setOver] = useState(false);
  useEffect(
    () =>
      registerCommands([
        {
          id: "file.save",
          group: "file",
          words: words.commands.save,
          keys: ["Mod+S"],
          can: () => cellStore.getState().document !== null,
          run: saveFile,
        },
        {
          id: "file.load",
          group: "file",
          words: words.commands.load,
          keys: ["Mod+O"],
          run: () => input.current?.click(),
        },
        { id: "file.example", group: "file", words: words.commands.example, run: () => openCell(edgeTraceCell()) },
        {
          id: "file.conveyor",
          group: "file",
          words: words.commands.conveyor,
          run: () => openCell(conveyorPalletCell()),
        },
        {
          id: "file.shapes",
          group: "edit",
          words: words.shapes.command,
          can: () => importOfSelected() !== null,
          run: showImport,
        },
        { id: "file.new", group: "file", words: words.commands.fresh, run: () => openCell(emptyCell()) },
      ]),
    [],
  );
  useEffect(() => {
    const hasFiles = (event: DragEvent): boolean => event.dataTransfer?.types.includes("Files") ?? false;
    const drag = (event: DragEvent): void => {
      if (hasFiles(event)) {
        event.preventDefault();
        setOver(true);
      }
    };
    const leave = (event: DragEvent): void => {
      if (event.relatedTarget === null) setOver(false);
    };
    const drop = (event: DragEvent): void => {
      if (!hasFiles(event)) return;
      event.preventDefault();
      setOver(false);
      void droppedFiles(event.dataTransfer).then(openFiles);
    };
    window.addEventListener("dragover", drag);
    window.addEventListener("dragleave", leave);
    window.addEventListener("drop", drop);
    return () => {
      window.removeEventListener("dragover", drag);
      window.removeEventListener("dragleave", leave);
      window.removeEventListener("drop", drop);
    };
  }, []);
  return (
    <>
      <input
        ref={input}
        type="file"
        multiple
        accept={KINDS}
        hidden
        aria-label={words.commands.load}
        data-file-input
        onChange={event => {
          const files = [...(event.currentTarget.files ?? [])].map(file => ({ path: file.name, file }));
          if (files.length > 0) void openFiles(files);
          event.currentTarget.value = "";
        }}
      />
      {over && (
        <div className="drop-veil" aria-hidden>
          <p>{words.file.drop}</p>
        </div>
      )}
    </>
  );
}

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
