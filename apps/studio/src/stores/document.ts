import {
  createHistory,
  followObjects,
  selectedProgram,
  selectedText,
  withStepPrograms,
  type CellDocument,
  type History,
  type ObjectRecord,
  type TextProgram,
  type ToolRecord,
} from "@twincell/project";
import { robotById, type Pose, type Program, type Robot } from "@twincell/core";
import { cellStore } from "./cell.ts";
import { notify } from "./notices.ts";
import { knowRobotFile, ownFileOf } from "./own-robots.ts";

let history: History | null = null;

/** Who else edits the open cell, as far as the document has to know. */
export interface Sharing {
  /** The sentence of why this person may not make that change, or null. */
  refuses(before: CellDocument, after: CellDocument): string | null;
  /** Another cell is opened: this one is not edited together any more. */
  ended(): void;
}
let sharing: Sharing | null = null;

/**
 * From here on the open cell is one that others edit too: what comes from them is another history of it. Null: it is
 * this browser's own again, with the undo of one.
 */
export function shareHistory(next: History, by: Sharing): void;
export function shareHistory(next: null, by: null): void;
export function shareHistory(next: History | null, by: Sharing | null): void {
  sharing = by;
  if (next !== null) publish(next);
  else if (history !== null) publish(createHistory(history.document));
}

/** A robot that the cell brings is known before anybody looks at the cell, also when undo brings it back. */
function knowRobot({ robot: { id, file } }: CellDocument): void {
  if (file !== undefined && ownFileOf(id) !== file) knowRobotFile(file);
}

function publish(next: History): void {
  knowRobot(next.document);
  const changed = next.document !== history?.document;
  history = next;
  cellStore.setState(state => ({
    document: next.document,
    undo: next.undoLabels,
    redo: next.redoLabels,
    saving: changed ? { kind: "unsaved" } : state.saving,
  }));
}

/** Shows another document; undo starts afresh. */
export function showDocument(document: CellDocument): void {
  const before = sharing;
  sharing = null;
  before?.ended();
  publish(createHistory(inStep(document)));
}

/**
 * Attached frames stand where their objects are, and programs carry the tools and frames of the cell, so that each can
 * be checked, exported and run by itself.
 */
export function inStep(changed: CellDocument): CellDocument {
  const document = followObjects(changed);
  const tools = Object.fromEntries(document.tools.map(tool => [tool.name, tool.flangeFromTcp]));
  const frames = Object.fromEntries(document.frames.map(frame => [frame.name, frame.worldFromFrame]));
  return withStepPrograms(document, program => {
    // Inside a pallet step the name of a pallet means its places: a frame of that name stays out.
    const free = Object.fromEntries(Object.entries(frames).filter(([name]) => !Object.hasOwn(program.pallets, name)));
    return agrees(program.tools, tools) && agrees(program.frames, free)
      ? program
      : { ...program, tools: { ...program.tools, ...tools }, frames: { ...program.frames, ...free } };
  });
}
const agrees = (has: Readonly<Record<string, Pose>>, wants: Readonly<Record<string, Pose>>): boolean =>
  Object.entries(wants).every(
    ([name, pose]) => has[name] === pose || JSON.stringify(has[name]) === JSON.stringify(pose),
  );

/**
 * The only way to change the document. `change` returns the new document, or the same one when there is nothing to do.
 * Says whether anything changed. Commits that follow each other with the same `gesture` are one undo step.
 */
export function commit(label: string, change: (document: CellDocument) => CellDocument, gesture?: string): boolean {
  if (!history) return false;
  const after = inStep(change(history.document));
  if (after === history.document) return false;
  const why = sharing?.refuses(history.document, after) ?? null;
  if (why !== null) {
    notify("warn", why);
    return false;
  }
  publish(history.commit(label, after, gesture));
  return true;
}

/** Takes the last change back and returns its label; null when there is none. */
export function undo(): string | null {
  const label = history?.undoLabels[0];
  if (!history || label === undefined) return null;
  publish(history.undo());
  return label;
}
export function redo(): string | null {
  const label = history?.redoLabels[0];
  if (!history || label === undefined) return null;
  publish(history.redo());
  return label;
}

export const robotOf = (document: CellDocument | null): Robot | null =>
  document ? (robotById(document.robot.id) ?? null) : null;
/** What the texts of the cell do, step by step, for the robot they were executed on. */
const executed = new WeakMap<
  TextProgram,
  { readonly robot: CellDocument["robot"]; readonly program: Program | null }
>();

/**
 * Keeps what a text does once it has been executed: from then on it is planned, checked and played like taught steps.
 */
export function keepExecuted(text: TextProgram, robot: CellDocument["robot"], program: Program | null): void {
  executed.set(text, { robot, program });
  cellStore.setState(({ executions }) => ({ executions: executions + 1 }));
}

/**
 * The program being worked on: taught steps, or the steps that a vendor's text does; null until that has been executed.
 */
export function programOf(document: CellDocument | null): Program | null {
  if (!document) return null;
  const steps = selectedProgram(document);
  if (steps) return steps;
  const text = selectedText(document);
  const known = text === undefined ? undefined : executed.get(text);
  return known?.robot === document.robot ? known.program : null;
}
/** The vendor's text being worked on; null while a program of steps is. */
export const textOf = (document: CellDocument | null): TextProgram | null =>
  document ? (selectedText(document) ?? null) : null;
export const toolOf = (document: CellDocument | null): ToolRecord | null =>
  document?.tools.find(tool => tool.name === document.tool) ?? null;
export const objectOf = (document: CellDocument | null, id: string): ObjectRecord | null =>
  document?.objects.find(object => object.id === id) ?? null;
export const theProgram = (): Program | null => programOf(cellStore.getState().document);
export const theRobot = (): Robot | null => robotOf(cellStore.getState().document);

/** The document with its current program changed. */
export function withProgram(document: CellDocument, change: (program: Program) => Program): CellDocument {
  // Steps of a text are what it does: they change with the text alone.
  const before = selectedProgram(document);
  if (!before) return document;
  const after = change(before);
  return after === before
    ? document
    : { ...document, programs: document.programs.map(program => (program === before ? after : program)) };
}
export function withObject(
  document: CellDocument,
  id: string,
  change: (object: ObjectRecord) => ObjectRecord,
): CellDocument {
  const objects = document.objects.map(object => (object.id === id ? change(object) : object));
  return objects.every((object, i) => object === document.objects[i]) ? document : { ...document, objects };
}
/** Pose of the tool tip on the flange; the flange itself without a tool. */
export function flangeFromTcpOf(document: CellDocument | null): Pose<"flange", "tcp"> {
  return toolOf(document)?.flangeFromTcp ?? { position: [0, 0, 0], quaternion: [0, 0, 0, 1] };
}

const WORLD: Pose<"world", "frame"> = { position: [0, 0, 0], quaternion: [0, 0, 0, 1] };
/** The frame jogging and read-outs count in. A user frame that is not there counts as the world. */
export function worldFromFrameOf(
  document: CellDocument | null,
  frame: "world" | "base" | "user",
  userFrame: string,
): Pose<"world", "frame"> {
  if (!document || frame === "world") return WORLD;
  if (frame === "base")
    return { position: document.robot.worldFromBase.position, quaternion: document.robot.worldFromBase.quaternion };
  return (
    document.frames.find(record => record.name === userFrame)?.worldFromFrame ??
    document.frames[0]?.worldFromFrame ??
    WORLD
  );
}
