import { emptyProgram, type Program } from "@twincell/core";
import type { CellDocument } from "./document.ts";

/*
 * A cell stores several programs, one of them selected (row T-71). Each edit takes a cell and returns another; a name
 * that does not exist changes nothing and returns the very same cell.
 */

/** The program being worked on, and the one that runs. */
export const selectedProgram = (cell: CellDocument): Program | undefined =>
  cell.programs.find(program => program.name === cell.program);

export const selectProgram = (cell: CellDocument, name: string): CellDocument =>
  name === cell.program || !cell.programs.some(program => program.name === name) ? cell : { ...cell, program: name };

/** Stores a program and selects it. A name that is taken gets a number. */
export function addProgram(cell: CellDocument, program: Program = emptyProgram(cell.robot.id)): CellDocument {
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
  return {
    ...cell,
    programs: cell.programs.with(at, { ...cell.programs[at]!, name: free }),
    program: cell.program === name ? free : cell.program,
  };
}

/** Takes a program out; its neighbour is selected. A cell keeps at least one: the last becomes an empty one. */
export function removeProgram(cell: CellDocument, name: string): CellDocument {
  const at = cell.programs.findIndex(program => program.name === name);
  if (at < 0) return cell;
  const left = cell.programs.toSpliced(at, 1);
  const programs = left.length > 0 ? left : [emptyProgram(cell.robot.id)];
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
