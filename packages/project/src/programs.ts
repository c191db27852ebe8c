import { emptyProgram, type Program } from "@twincell/core";
import { isTextProgram, type CellDocument, type CellProgram } from "./document.ts";
import type { TextProgram } from "./text-program.ts";

/*
 * A cell stores several programs, one of them selected (row T-71). Each edit takes a cell and returns another; a name
 * that does not exist changes nothing and returns the very same cell.
 */

const selected = (cell: CellDocument): CellProgram | undefined =>
  cell.programs.find(program => program.name === cell.program);

/** The program of steps being worked on, and the one that runs; undefined while a text is. */
export function selectedProgram(cell: CellDocument): Program | undefined {
  const program = selected(cell);
  return program === undefined || isTextProgram(program) ? undefined : program;
}

/** The text being worked on; undefined while a program of steps is. */
export function selectedText(cell: CellDocument): TextProgram | undefined {
  const program = selected(cell);
  return program !== undefined && isTextProgram(program) ? program : undefined;
}

/** The programs of steps, in their order. */
export const stepPrograms = (cell: CellDocument): readonly Program[] =>
  cell.programs.filter((program): program is Program => !isTextProgram(program));

/** The cell with each program of steps changed, texts as they are; the very same cell when none changed. */
export function withStepPrograms(cell: CellDocument, change: (program: Program) => Program): CellDocument {
  const programs = cell.programs.map(program => (isTextProgram(program) ? program : change(program)));
  return programs.every((program, i) => program === cell.programs[i]) ? cell : { ...cell, programs };
}

/** The cell with the selected text changed; the very same cell when it is not a text or nothing changed. */
export function withSelectedText(cell: CellDocument, change: (program: TextProgram) => TextProgram): CellDocument {
  const before = selectedText(cell);
  const after = before === undefined ? undefined : change(before);
  return before === undefined || after === undefined || after === before
    ? cell
    : { ...cell, programs: cell.programs.map(program => (program === before ? after : program)) };
}

export const selectProgram = (cell: CellDocument, name: string): CellDocument =>
  name === cell.program || !cell.programs.some(program => program.name === name) ? cell : { ...cell, program: name };

/** Stores a program and selects it. A name that is taken gets a number. */
export function addProgram(cell: CellDocument, program: CellProgram = emptyProgram(cell.robot.id)): CellDocument {
  const name = freeName(cell, program.name);
  return { ...cell, programs: [...cell.programs, { ...program, name }], program: name };
}

/** A copy of a program, selected. */
export function duplicateProgram(cell: CellDocument, name: string): CellDocument {
  const program = cell.programs.find(each => each.name === name);
  return program === undefined ? cell : addProgram(cell, program);
}

export function renameProgram(cell: CellDocument, name: string, wanted: string): CellDocument {
  const plain = wanted.trim();
  const at = cell.programs.findIndex(program => program.name === name);
  if (at < 0 || plain === "" || plain === name) return cell;
  const free = freeName(cell, plain);
  const renamed: CellDocument = {
    ...cell,
    programs: cell.programs.with(at, { ...cell.programs[at]!, name: free }),
    program: cell.program === name ? free : cell.program,
  };
  // What was said about its steps goes with them.
  return cell.comments === undefined
    ? renamed
    : {
        ...renamed,
        comments: cell.comments.map(each => (each.program === name ? { ...each, program: free } : each)),
      };
}

/** Takes a program out; its neighbour is selected. A cell keeps at least one: the last becomes an empty one. */
export function removeProgram(cell: CellDocument, name: string): CellDocument {
  const at = cell.programs.findIndex(program => program.name === name);
  if (at < 0) return cell;
  const left = cell.programs.toSpliced(at, 1);
  const programs: readonly CellProgram[] = left.length > 0 ? left : [emptyProgram(cell.robot.id)];
  return {
    ...cell,
    programs,
    program: cell.program === name ? programs[Math.min(at, programs.length - 1)]!.name : cell.program,
  };
}

function freeName(cell: CellDocument, wanted: string): string {
  const taken = new Set(cell.programs.map(program => program.name));
  for (let i = 1; ; i++) {
    const name = i === 1 ? wanted : `${wanted} ${i}`;
    if (!taken.has(name)) return name;
  }
}
