import type { TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Cursor } from "./cursor.ts";
import { checkName, readExpression } from "./expression.ts";
import type { Declaration, Expression, Parameter, SignalDeclaration } from "./syntax.ts";

/** Types whose declaration needs no DECL. */
const SIMPLE = new Set(["INT", "REAL", "BOOL", "CHAR"]);
/** Structures of the controller, which older programs declare without it too. */
const STRUCTURES = new Set(["FRAME", "POS", "E3POS", "E6POS", "AXIS", "E3AXIS", "E6AXIS"]);
/** Words that declare something which has no effect on where the robot goes. */
const QUIET = new Set(["EXT", "EXTFCT", "STRUC", "ENUM", "IMPORT"]);

/** The declarations of a line, or undefined when it declares nothing. Goes past them. */
export function readDeclarations(cursor: Cursor): Declaration[] | undefined {
  if (cursor.second === "=") return undefined;
  if (QUIET.has(cursor.next)) {
    cursor.skip();
    return [];
  }
  const global = cursor.next === "GLOBAL" && cursor.second !== "INTERRUPT";
  if (global) {
    cursor.take();
    if (QUIET.has(cursor.next)) {
      cursor.skip();
      return [];
    }
  }
  if (global) cursor.accept("CONST");
  const spelled = cursor.accept("DECL");
  const isPlain = SIMPLE.has(cursor.next) || (STRUCTURES.has(cursor.next) && cursor.secondKind === "word");
  if (!spelled && !isPlain) return global ? [] : undefined;
  const isGlobal = cursor.accept("GLOBAL") || global;
  cursor.accept("CONST");
  if (QUIET.has(cursor.next)) {
    cursor.skip();
    return [];
  }
  const type = cursor.name("a type");
  const list: Declaration[] = [];
  do list.push(readDeclared(cursor, type, isGlobal));
  while (cursor.accept(","));
  cursor.expectEnd();
  return list;
}

function readDeclared(cursor: Cursor, type: string, isGlobal: boolean): Declaration {
  const { line, column } = cursor.here;
  const name = cursor.name("the name of a variable");
  const index: Expression[] = [];
  checkName(name, { line, column });
  const isArray = cursor.accept("[");
  if (isArray) {
    // The parameter of a routine is declared with empty places: `T[,]`.
    do if (cursor.next !== "," && cursor.next !== "]") index.push(readExpression(cursor));
    while (cursor.accept(","));
    cursor.expect("]");
  }
  const value = cursor.accept("=") ? readExpression(cursor) : undefined;
  return { type, name, isGlobal, isArray, index, value, line, column };
}

const LINES: Readonly<Record<string, Exclude<SignalDeclaration["wire"], "variable">>> = {
  $IN: "in",
  $OUT: "out",
  $ANIN: "analogue-in",
  $ANOUT: "analogue-out",
};

/**
 * `SIGNAL NAME $OUT[n]`, `SIGNAL NAME $OUT[n] TO $OUT[m]`, or another name for a system variable.
 *
 * @throws {TextError}
 */
export function readSignal(cursor: Cursor): SignalDeclaration {
  cursor.take();
  const { line, column } = cursor.here;
  const name = cursor.name("the name of a signal");
  checkName(name, { line, column });
  const at = cursor.here;
  const variable = cursor.name("$IN, $OUT, $ANIN or $ANOUT");
  const wire = LINES[variable];
  if (wire === undefined) {
    if (!variable.startsWith("$"))
      throw new TextError(
        at,
        "$IN, $OUT, $ANIN or $ANOUT",
        `Signal ${name} is tied to no line of the controller that is known here.`,
      );
    const index = cursor.accept("[") ? `[${address(cursor)}]` : "";
    if (index !== "") cursor.expect("]");
    cursor.skip();
    return { name, wire: "variable", address: 0, variable: variable + index, line, column };
  }
  cursor.expect("[");
  const first = address(cursor);
  cursor.expect("]");
  if (!cursor.accept("TO")) {
    cursor.expectEnd();
    return { name, wire, address: first, line, column };
  }
  const toAt = cursor.here;
  if (LINES[cursor.name(variable)] !== wire)
    throw new TextError(toAt, variable, `The group ${name} goes over lines of one kind.`);
  cursor.expect("[");
  const last = address(cursor);
  cursor.expect("]");
  cursor.expectEnd();
  if (last < first || last - first >= MOST_LINES || wire.startsWith("analogue"))
    throw new TextError(toAt, `up to ${MOST_LINES} digital lines in a row`, `The group ${name} is no row of lines.`);
  return { name, wire, address: first, last, line, column };
}

/** The lines that one number can stand for. */
const MOST_LINES = 32;

function address(cursor: Cursor): number {
  const place = cursor.here;
  if (cursor.nextKind !== "number") throw cursor.unexpected("the number of a line");
  const number = Number(cursor.take());
  if (!Number.isInteger(number) || number < 1)
    throw new TextError(place, "a number from 1", `The controller has no line ${number}.`);
  return number;
}

/** `NAME( a :IN, b :OUT )`, with the type of the result before the name of a function. */
export function readHeader(
  cursor: Cursor,
  isFunction: boolean,
): { readonly name: string; readonly place: TextPlace; readonly parameters: readonly Parameter[] } {
  if (isFunction) {
    cursor.name("the type of the result");
    // CHAR[32]: a text of so many signs.
    if (cursor.accept("[")) {
      if (cursor.nextKind === "number") cursor.take();
      cursor.expect("]");
    }
  }
  const place = cursor.here;
  const name = cursor.name("the name of the routine");
  const parameters: Parameter[] = [];
  checkName(name, place);
  if (cursor.accept("(") && !cursor.accept(")")) {
    do {
      const parameter = cursor.name("a parameter");
      if (cursor.accept("[")) {
        while (cursor.accept(","));
        cursor.expect("]");
      }
      let out = true;
      if (cursor.accept(":")) {
        const way = cursor.name("IN or OUT");
        out = way !== "IN";
      }
      parameters.push({ name: parameter, out });
    } while (cursor.accept(","));
    cursor.expect(")");
  }
  cursor.expectEnd();
  return { name, place, parameters };
}
