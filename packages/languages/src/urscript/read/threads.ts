import type { TextFault, TextPlace } from "@twincell/core";
import { TextError, textFault } from "../../parser/index.ts";
import type { Argument, Block, Expression, Routine, Statement } from "../../parser/structured/index.ts";
import type { Source } from "./grammar.ts";
import { SILENT } from "./silent.ts";

/** Instructions that a task beside the program may have: none of them changes where the robot goes. */
const HARMLESS = /^(?:set_.*_(?:digital|analog)_out|set_flag|sleep|textmsg|run|kill|join)$/;

/** What a task or the program reads, gives values to and does. */
interface Use {
  readonly reads: Set<string>;
  readonly writes: Map<string, TextPlace>;
  /** The first instruction that may change where the robot goes. */
  moves: (TextPlace & { readonly name: string }) | undefined;
  outputs: boolean;
}

/**
 * The threads of a text: kept, named, and not executed. One that moves the robot, changes how it moves, or gives a
 * value to a variable that the program reads cannot be left out.
 *
 * @throws {TextError} at what cannot be left out.
 */
export function keptThreads({ threads, routines, main }: Source): readonly TextFault[] {
  if (threads.size === 0) return [];
  const program = use(main, routines);
  for (const routine of routines.values()) collect(routine.body, routines, program, new Set([routine.name]));
  return [...threads.values()].map(({ name, body, line, column }) => {
    const task = use(body, routines);
    if (task.moves !== undefined)
      throw new TextError(
        task.moves,
        "a thread that does not move the robot",
        `Thread ${name} does "${task.moves.name}" beside the program, which cannot be written one after the other.`,
      );
    for (const [variable, place] of task.writes)
      if (program.reads.has(variable))
        throw new TextError(
          place,
          "a variable that only the thread reads",
          `Thread ${name} changes "${variable}" at a time that nobody knows, and the program reads it.`,
        );
    const does = task.outputs ? "; the outputs that it sets stay as the program leaves them" : "";
    return textFault(
      { line, column },
      "one task",
      `Thread ${name} is shown, not executed: it does not move the robot${does}.`,
    );
  });
}

function use(block: Block, routines: ReadonlyMap<string, Routine>): Use {
  const found: Use = { reads: new Set(), writes: new Map(), moves: undefined, outputs: false };
  collect(block, routines, found, new Set());
  return found;
}

function collect(block: Block, routines: ReadonlyMap<string, Routine>, found: Use, met: Set<string>): void {
  const called = (name: string, args: readonly Argument[]): boolean => {
    for (const { value } of args) if (value !== undefined) read(value);
    const routine = routines.get(name);
    if (routine === undefined) return false;
    if (!met.has(name)) {
      met.add(name);
      collect(routine.body, routines, found, met);
    }
    return true;
  };
  const read = (expression: Expression): void => {
    switch (expression.kind) {
      case "variable":
        found.reads.add(expression.name);
        return;
      case "list":
        for (const item of expression.items) read(item);
        return;
      case "index":
        read(expression.of);
        for (const index of expression.indices) read(index);
        return;
      case "component":
      case "unary":
        return read(expression.of);
      case "binary":
        read(expression.left);
        return read(expression.right);
      case "call":
        called(expression.name, expression.args);
        return;
      default:
    }
  };
  const assigned = ({ to, value, line, column }: Extract<Statement, { kind: "assign" }>): void => {
    read(value);
    if (to.kind === "index") for (const index of to.indices) read(index);
    const name = to.kind === "variable" ? to.name : to.kind === "index" && to.of.kind === "variable" ? to.of.name : "";
    if (!found.writes.has(name)) found.writes.set(name, { line, column });
  };
  const doing = ({ name, args, line, column }: Extract<Statement, { kind: "do" }>): void => {
    if (called(name, args)) return;
    if (/_out$/.test(name)) found.outputs = true;
    if (!HARMLESS.test(name) && !SILENT.has(name) && !name.includes(".")) found.moves ??= { name, line, column };
    if (/^stop[jl]$/.test(name)) found.moves ??= { name, line, column };
  };
  for (const statement of block) {
    const { line, column } = statement;
    switch (statement.kind) {
      case "assign":
        assigned(statement);
        break;
      case "do":
        doing(statement);
        break;
      case "if":
        for (const { when, body } of statement.branches) {
          read(when);
          collect(body, routines, found, met);
        }
        if (statement.otherwise !== undefined) collect(statement.otherwise, routines, found, met);
        break;
      case "while":
        read(statement.when);
        collect(statement.body, routines, found, met);
        break;
      case "for":
        collect(statement.body, routines, found, met);
        break;
      case "wait-until":
        read(statement.when);
        break;
      case "return":
        if (statement.value !== undefined) read(statement.value);
        break;
      case "halt":
        found.moves ??= { name: "halt", line, column };
        break;
      default:
    }
  }
}
