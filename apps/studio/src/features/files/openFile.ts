import { notify } from "../../stores/notices.ts";
import { openCellText } from "../../stores/opening.ts";
import { importText } from "../../stores/importing.ts";
import { importMesh } from "../../live/mesh-import.ts";
import { DIALECTS } from "@twincell/languages";
import { words } from "../../words/index.ts";
import { openTextFiles } from "../text/open-text.ts";

/** Whether files with that ending are programs of a robot language. */
const isProgram = (kind: string): boolean =>
  DIALECTS.some(({ extensions }) => extensions.some(each => each.toLowerCase() === `.${kind}`));

/** Opens a chosen or dropped file by what it is. Whatever is wrong with it is one sentence; what was open stays open. */
export async function openFile(file: File): Promise<void> {
  const kind = /\.([a-z0-9]+)$/i.exec(file.name)?.[1]?.toLowerCase() ?? "";
  try {
    if (kind === "mcap") await (await import("../../live/cell-control.ts")).openRecordingFiles([file]);
    else if (kind === "json") openCellText(await file.text(), file.name);
    else if (kind === "stl" || kind === "obj" || kind === "ply")
      await importMesh(file.name, kind, new Uint8Array(await file.arrayBuffer()));
    else if (isProgram(kind) && kind !== "txt") await openTexts([file]);
    else if (kind === "txt") {
      const [fault] = importText(await file.text(), file.name);
      if (fault !== undefined) notify("bad", words.file.notCell(file.name, fault), words.file.notCellHint);
    } else notify("bad", words.file.unknownKind(file.name), words.file.unknownHint);
  } catch (trouble) {
    notify("bad", words.file.unreadable(file.name), trouble instanceof Error ? trouble.message : undefined);
  }
}

/** Program files that are opened together are one program: a module and its data list. */
async function openTexts(files: readonly File[]): Promise<void> {
  openTextFiles(
    await Promise.all(files.map(async file => ({ name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) }))),
  );
}

/** Opens what was chosen or dropped at once: recordings together, as one history, program files as one program, the rest one by one. */
export async function openFiles(files: readonly File[]): Promise<void> {
  const recordings = files.filter(({ name }) => /\.mcap$/i.test(name));
  const texts = files.filter(({ name }) => {
    const kind = /\.([a-z0-9]+)$/i.exec(name)?.[1]?.toLowerCase() ?? "";
    return kind !== "txt" && isProgram(kind);
  });
  for (const file of files) if (!recordings.includes(file) && !texts.includes(file)) await openFile(file);
  if (texts.length > 0) await openTexts(texts);
  if (recordings.length > 0) await (await import("../../live/cell-control.ts")).openRecordingFiles(recordings);
}
