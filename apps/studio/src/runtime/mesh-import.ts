import type { Vector3 } from "@twincell/core";
import { importedFrom, withObjects, type ObjectRecord } from "@twincell/project";
import { cellStore } from "../stores/cell.ts";
import { closeDialog, openDialog } from "../stores/dialogs.ts";
import { commit } from "../stores/document.ts";
import { notify } from "../stores/notices.ts";
import { takeRobotFile } from "./own-robot.ts";
import { knowRobotFile } from "../stores/own-robots.ts";
import { select } from "../stores/selection.ts";
import { keepCard, shapeStore, type ShapeCard } from "../stores/shapes.ts";
import { showNumber } from "../ui/expression.ts";
import { words } from "../messages/index.ts";
import type { ShapeAnswer, ShapeRequest } from "../workers/shape-messages.ts";

/** A file that was dropped or chosen, with its place in the folder it came in. */
export interface FileAt {
  readonly path: string;
  readonly file: File;
}

let cancel: (() => void) | null = null;

/** Ends what is being read or changed: the worker goes at once, and the cell stays as it is. */
export const cancelShapes = (): void => cancel?.();

/** One request in a worker of its own: memory that a large file took goes with it. Null when a person cancelled. */
export async function askShapes(
  request: ShapeRequest,
  transfer: readonly ArrayBuffer[] = [],
): Promise<ShapeAnswer | null> {
  cancel?.();
  const worker = new Worker(new URL("../workers/shape.worker.ts", import.meta.url), { type: "module" });
  try {
    return await new Promise<ShapeAnswer | null>(resolve => {
      cancel = () => resolve(null);
      worker.addEventListener("message", ({ data }: MessageEvent<ShapeAnswer>) => resolve(data));
      worker.addEventListener("error", event => resolve({ kind: "not-understood", sentence: event.message }));
      worker.postMessage(request, [...transfer]);
    });
  } finally {
    worker.terminate();
    cancel = null;
    shapeStore.setState({ busy: null });
  }
}

/**
 * Reads shapes, robot descriptions and archives of them away from the page, puts their parts into the cell and shows
 * the report.
 */
export async function importShapes(files: readonly FileAt[], robots = true): Promise<void> {
  const name = files[0]?.file.name ?? "";
  asked = files;
  shapeStore.setState({ busy: { file: name, what: "reading" }, robot: null, shown: null });
  openDialog("shapes");
  const read = await Promise.all(
    files.map(async ({ path, file }) => ({ path, bytes: new Uint8Array(await file.arrayBuffer()) })),
  );
  const taken = cellStore.getState().document?.objects.map(({ id }) => id) ?? [];
  const answer = await askShapes(
    { kind: "import", files: read, taken, robots },
    read.map(({ bytes }) => bytes.buffer),
  );
  if (answer?.kind === "robot") {
    shapeStore.setState({ robot: answer });
    knowRobotFile(answer.file);
    openDialog("own-robot");
    return;
  }
  if (answer?.kind !== "imported") {
    closeDialog();
    if (answer === null) notify("info", words.shapes.canceled(name));
    else if (answer.kind === "not-understood")
      notify("bad", words.file.notCell(name, answer.sentence), words.file.notCellHint);
    return;
  }
  const objects = answer.files.flatMap(file => file.objects);
  commit(words.undo.addObject, document => ({ ...document, objects: [...document.objects, ...objects] }));
  for (const { file, unit, report, objects: own } of answer.files) keepCard({ file, unit, report }, own);
  const [first] = objects;
  if (first) select({ kind: "object", id: first.id });
  const triangles = answer.files.reduce((sum, { report }) => sum + report.triangles, 0);
  const isDoubtful = answer.files.some(({ unit }) => unit.certainty === "doubtful");
  notify(isDoubtful ? "warn" : "done", words.shapes.added(name, objects.length, triangles));
}

/** What the robot that is asked about was read from. */
let asked: readonly FileAt[] = [];

/** The links of the robot that is asked about become parts that stand in the cell. */
export const importAsParts = (): Promise<void> => importShapes(asked, false);

/** The robot that is asked about becomes that of the cell, and is kept in this browser for others. */
export function takeRobot(): void {
  const { robot } = shapeStore.getState();
  closeDialog();
  shapeStore.setState({ robot: null });
  if (robot) void takeRobotFile(robot.file);
}

const objectsOf = (file: string): readonly ObjectRecord[] => {
  const { document } = cellStore.getState();
  return document ? importedFrom(document, file) : [];
};

/** Says what the file counts in; everything that came from it becomes larger or smaller. One step of undo. */
export async function correctUnit(card: ShapeCard, metresPerUnit: number): Promise<void> {
  const factor = metresPerUnit / card.unit.metresPerUnit;
  shapeStore.setState({ busy: { file: card.file, what: "changing" } });
  const answer = await askShapes({ kind: "scale", objects: objectsOf(card.file), factor }, []);
  if (answer?.kind === "not-understood") notify("bad", answer.sentence);
  if (answer?.kind !== "scaled") return;
  commit(words.shapes.undoUnit, document => withObjects(document, answer.objects));
  const scaled = ([x, y, z]: Vector3): Vector3 => [x * factor, y * factor, z * factor];
  const { lower_m, upper_m, size_m } = card.report;
  const report = { ...card.report, lower_m: scaled(lower_m), upper_m: scaled(upper_m), size_m: scaled(size_m) };
  keepCard({ file: card.file, report, unit: { metresPerUnit, certainty: "chosen", sentence: "" } }, answer.objects);
  notify("done", words.shapes.corrected(card.file, `${showNumber(Math.max(...scaled(size_m)), "length", 1)} mm`));
}

/** Fewer triangles for everything that came from the file, with the deviation measured (T-49). One step of undo. */
export async function makeLight(card: ShapeCard, adapters: number): Promise<void> {
  shapeStore.setState({ busy: { file: card.file, what: "changing" } });
  const answer = await askShapes({ kind: "light", objects: objectsOf(card.file), faces: adapters }, []);
  if (answer?.kind === "not-understood") notify("bad", answer.sentence);
  if (answer?.kind !== "light") return;
  commit(words.shapes.undoLight, document => withObjects(document, answer.objects));
  keepCard({ ...card, light: answer.report }, answer.objects);
}
