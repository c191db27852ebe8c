import { notify } from "../../stores/notices.ts";
import { loadCatalogue } from "../../stores/catalogue.ts";
import { openCellText } from "../../stores/opening.ts";
import { importText } from "../../stores/importing.ts";
import { importShapes, type FileAt } from "../../runtime/mesh-import.ts";
import { endingOf, IMPORT_ENDINGS, mayBeRobot } from "@twincell/formats";
import { DIALECTS } from "@twincell/languages";
import { words } from "../../messages/index.ts";
import { openDemonstration } from "../../runtime/planning/demonstrating.ts";
import { openTextFiles } from "../../runtime/open-text.ts";

/** Whether files with that ending are programs of a robot language. */
const isProgram = (kind: string): boolean =>
  DIALECTS.some(({ extensions }) => extensions.some(each => each.toLowerCase() === `.${kind}`));

/**
 * Opens a chosen or dropped file by what it is. Whatever is wrong with it is one sentence; what was open stays open.
 */
export async function openFile(file: File): Promise<void> {
  const kind = /\.([a-z0-9]+)$/i.exec(file.name)?.[1]?.toLowerCase() ?? "";
  try {
    if (kind === "mcap") await (await import("../../runtime/robot/cell-control.ts")).openRecordingFiles([file]);
    else if (kind === "json") {
      await loadCatalogue();
      openCellText(await file.text(), file.name);
    } else if (isShape(file.name)) await importShapes([{ path: file.name, file }]);
    else if (kind === "csv") openDemonstration(await file.text(), file.name);
    else if (isProgram(kind) && kind !== "txt") await openTexts([file]);
    else if (kind === "txt") {
      const [fault] = importText(await file.text(), file.name);
      if (fault !== undefined) notify("bad", words.file.notCell(file.name, fault), words.file.notCellHint);
    } else notify("bad", words.file.unknownKind(file.name), words.file.unknownHint);
  } catch (problem) {
    notify("bad", words.file.unreadable(file.name), problem instanceof Error ? problem.message : undefined);
  }
}

/** Program files that are opened together are one program: a module and its data list. */
async function openTexts(files: readonly File[]): Promise<void> {
  openTextFiles(
    await Promise.all(files.map(async file => ({ name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) }))),
  );
}

/** Shapes, robot descriptions and archives of them. */
const isShape = (name: string): boolean => [...IMPORT_ENDINGS, "zip"].includes(endingOf(name));

/** Robot files and D-H tables share their endings with cells, programs and demonstrations: their first lines tell. */
async function robotsAmong(files: readonly FileAt[]): Promise<readonly FileAt[]> {
  const tables = files.filter(({ file }) => !isShape(file.name));
  const starts = await Promise.all(
    tables.map(async ({ file }) => new Uint8Array(await file.slice(0, 4096).arrayBuffer())),
  );
  return tables.filter(({ file }, i) => mayBeRobot(file.name, starts[i]!));
}

/**
 * Opens what was chosen or dropped at once: recordings together, as one history; program files together, as one
 * program; shapes together with the files beside them, which they may name; everything else one by one.
 */
export async function openFiles(files: readonly FileAt[]): Promise<void> {
  const robots = await robotsAmong(files);
  if (robots.length > 0) {
    await importShapes(robots);
    return;
  }
  const recordings = files.filter(({ file }) => /\.mcap$/i.test(file.name)).map(({ file }) => file);
  const hasShapes = files.some(({ file }) => isShape(file.name));
  const texts = files
    .map(({ file }) => file)
    .filter(({ name }) => {
      const kind = /\.([a-z0-9]+)$/i.exec(name)?.[1]?.toLowerCase() ?? "";
      return kind !== "txt" && isProgram(kind);
    });
  const others = files.filter(({ file }) => !recordings.includes(file) && !texts.includes(file));
  try {
    if (hasShapes) await importShapes(others);
    if (texts.length > 0) await openTexts(texts);
  } catch (problem) {
    notify(
      "bad",
      words.file.unreadable(files[0]?.file.name ?? ""),
      problem instanceof Error ? problem.message : undefined,
    );
  }
  if (!hasShapes) for (const { file } of others) await openFile(file);
  if (recordings.length > 0) await (await import("../../runtime/robot/cell-control.ts")).openRecordingFiles(recordings);
}
