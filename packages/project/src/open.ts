import { addOwnRobot, parseProgram, publishedRobot, robotById, robotOfFile } from "@twincell/core";
import type { z } from "zod";
import { followObjects } from "./attach.ts";
import type { CellDocument, CellProgram, RobotRecord } from "./document.ts";
import { cellSchema, textProgramSchema } from "./schema.ts";
import { TEXT_PROGRAM_FORMAT } from "./text-program.ts";
import { NEWEST, lift } from "./versions.ts";

export type Opened =
  /** `lifted`: one sentence for each version the file was lifted over, to be shown. */
  | { readonly kind: "opened"; readonly document: CellDocument; readonly lifted: readonly string[] }
  | { readonly kind: "too-new"; readonly version: number; readonly newest: number }
  /** One sentence each, with the path of the place. */
  | { readonly kind: "not-a-cell"; readonly why: readonly string[] };

/** More reasons than this help nobody. */
const MOST_REASONS = 30;

/**
 * Reads a saved cell. This is the only door: behind it every number is finite and every name means something. Never
 * throws.
 */
export function openDocument(text: string): Opened {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch (cause) {
    return {
      kind: "not-a-cell",
      why: [`The file is not JSON: ${cause instanceof Error ? cause.message : "it cannot be read"}.`],
    };
  }
  return readDocument(value);
}

/** The same of a value that was JSON, or came as a message. Never throws. */
export function readDocument(value: unknown): Opened {
  if (!isRecord(value)) return { kind: "not-a-cell", why: ["The file holds no JSON object."] };
  if (value.format !== "twincell.cell") {
    return {
      kind: "not-a-cell",
      why: [`A cell says "format": "twincell.cell"; this file says ${shown(value.format)}.`],
    };
  }
  const { version } = value;
  if (typeof version !== "number" || !Number.isInteger(version) || version < 1) {
    return {
      kind: "not-a-cell",
      why: [`version: a whole number from 1 to ${NEWEST} is expected; this file says ${shown(version)}.`],
    };
  }
  if (version > NEWEST) return { kind: "too-new", version, newest: NEWEST };
  const { cell, says } = lift(value, version);
  const read = cellSchema.safeParse(cell);
  if (!read.success) return { kind: "not-a-cell", why: read.error.issues.slice(0, MOST_REASONS).map(sentence) };
  return withPrograms(read.data, says);
}

function withPrograms(cell: z.infer<typeof cellSchema>, lifted: readonly string[]): Opened {
  const why: string[] = [];
  const programs: CellProgram[] = [];
  // First, since programs are read by the joints of their robot.
  why.push(...knowOwnRobot(cell.robot));
  for (const [i, source] of cell.programs.entries()) {
    if (isRecord(source) && source.format === TEXT_PROGRAM_FORMAT) {
      const read = textProgramSchema.safeParse(source);
      if (read.success) programs.push(read.data);
      else why.push(...read.error.issues.map(issue => sentence({ ...issue, path: ["programs", i, ...issue.path] })));
      continue;
    }
    const answer = parseProgram(source);
    if (answer.kind === "program") programs.push(answer.program);
    else
      why.push(
        ...answer.faults.map(fault => `programs[${i}]${fault.path === "" ? "" : `.${fault.path}`}: ${fault.sentence}`),
      );
  }
  if (why.length === 0 && robotById(cell.robot.id) === undefined)
    why.push(`robot.id: the library has no robot called ${shown(cell.robot.id)}.`);
  why.push(
    ...twice(
      "objects",
      "id",
      cell.objects.map(object => object.id),
    ),
    ...twice(
      "tools",
      "name",
      cell.tools.map(tool => tool.name),
    ),
    ...twice(
      "frames",
      "name",
      cell.frames.map(frame => frame.name),
    ),
  );
  for (const [i, { attachedTo }] of cell.frames.entries())
    if (attachedTo !== undefined && !cell.objects.some(object => object.id === attachedTo.object))
      why.push(`frames[${i}].attachedTo.object: the cell has no object with the id ${shown(attachedTo.object)}.`);
  if (why.length === 0) {
    why.push(
      ...twice(
        "programs",
        "name",
        programs.map(program => program.name),
      ),
    );
    if (cell.tool !== "flange" && !cell.tools.some(tool => tool.name === cell.tool))
      why.push(`tool: the cell has no tool called ${shown(cell.tool)}.`);
    if (!programs.some(program => program.name === cell.program))
      why.push(`program: the cell has no program called ${shown(cell.program)}.`);
  }
  if (why.length > 0) return { kind: "not-a-cell", why: why.slice(0, MOST_REASONS) };
  return { kind: "opened", document: followObjects({ ...cell, programs }), lifted };
}

/**
 * Makes the robot that a cell brings with it known to `robotById`. Says what is wrong with it, one sentence each with
 * its place; nothing where the cell's robot is one of the library.
 */
export function knowOwnRobot({ id, file }: RobotRecord): string[] {
  if (file === undefined) return [];
  const answer = robotOfFile(file);
  if (answer.kind === "not-a-robot")
    return answer.faults.map(fault => `robot.file${fault.path === "" ? "" : `.${fault.path}`}: ${fault.sentence}`);
  if (answer.robot.id !== id)
    return [`robot.file.id: the cell's robot is ${shown(id)}; the file in it is of ${shown(answer.robot.id)}.`];
  if (publishedRobot(id) !== undefined)
    return [`robot.file.id: ${shown(id)} is a robot of the library; a robot from a file has another id.`];
  if (robotById(id) !== answer.robot) addOwnRobot(answer.robot);
  return [];
}

function twice(list: string, key: string, names: readonly string[]): string[] {
  return names.flatMap((name, i) =>
    names.indexOf(name) < i
      ? [`${list}[${i}].${key}: ${shown(name)} is already the ${key} of ${list}[${names.indexOf(name)}].`]
      : [],
  );
}

function sentence(issue: z.core.$ZodIssue): string {
  const path = issue.path.reduce<string>(
    (so, key) => (typeof key === "number" ? `${so}[${key}]` : so === "" ? String(key) : `${so}.${String(key)}`),
    "",
  );
  const said = issue.message
    .replace(/[.]$/, "")
    .replace(
      /^Invalid input: expected (.+), received (.+)$/,
      (_, wanted: string, found: string) => `expected ${wanted}, found ${found === "undefined" ? "nothing" : found}`,
    );
  return `${path === "" ? "The cell" : path}: ${said}.`;
}

function shown(value: unknown): string {
  if (value === undefined) return "nothing";
  if (Array.isArray(value)) return `a list of ${value.length}`;
  if (value !== null && typeof value === "object") return "an object";
  const text = typeof value === "string" ? JSON.stringify(value) : String(value);
  return text.length > 60 ? `${text.slice(0, 60)}…` : text;
}

const isRecord = (value: unknown): value is Record<string, unknown> =>
  typeof value === "object" && value !== null && !Array.isArray(value);
