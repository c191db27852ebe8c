import { DIALECTS, mainOf } from "@twincell/languages";
import { addProgram, mainFileOf, textFileOf, type TextFile, type TextProgram } from "@twincell/project";
import { languageOfText } from "./planning/reading.ts";
import { cellStore } from "../stores/cell.ts";
import { commit, robotOf } from "../stores/document.ts";
import { notify } from "../stores/notices.ts";
import { select } from "../stores/selection.ts";
import { textStore } from "../stores/text.ts";
import { showMode } from "../stores/view.ts";
import { words } from "../messages/index.ts";

/** A byte that no program text has: the file is a compiled program. */
const isBinary = ({ text }: TextFile): boolean => text.slice(0, 4096).includes("\u0000");

/**
 * The chosen files together become one program of the cell, byte for byte, as one undo step. One sentence says why when
 * they do not; nothing changes then.
 */
export function openTextFiles(files: readonly { readonly name: string; readonly bytes: Uint8Array }[]): boolean {
  const { document } = cellStore.getState();
  const robot = robotOf(document);
  const kept = files.map(({ name, bytes }) => textFileOf(name, bytes));
  const [first] = kept;
  if (!document || !robot || first === undefined) return false;
  const binary = kept.find(isBinary);
  const empty = kept.find(file => file.text.trim() === "");
  if (binary) notify("bad", words.text.binary(binary.name), words.text.binaryHint);
  else if (empty) notify("bad", words.text.empty(empty.name), words.file.notCellHint);
  if (binary ?? empty) return false;
  const language = languageOfText(kept.map(file => file.text).join("\n"), first.name, robot);
  const dialect = DIALECTS.find(({ id }) => id === language);
  const main = dialect && (mainOf(dialect, kept) ?? first);
  if (!dialect || !main) {
    notify("bad", words.text.noLanguage(first.name), words.text.noLanguageHint);
    return false;
  }
  const program: TextProgram = {
    format: "twincell.text-program",
    version: 1,
    name: main.name.replace(/\.[^.]*$/, ""),
    robot: robot.id,
    language: dialect.id,
    main: main.name,
    files: kept,
  };
  if (!commit(words.undo.openText(mainFileOf(program).name), before => addProgram(before, program))) return false;
  select(null);
  textStore.setState({ layout: "side" });
  showMode("teach");
  notify("done", words.text.opened(main.name, kept.length), words.text.openedHint);
  return true;
}
