import { TextError } from "../../parser/index.ts";
import type { Cursor } from "./cursor.ts";
import type { Expression, Variable } from "./syntax.ts";

/** Names longer than this are not V+. */
const NAME_LENGTH = 15;
/** Brackets inside brackets: more than anybody writes, less than the stack holds. */
const DEPTH = 60;

const COMPARE = new Set(["==", "<>", "<", ">", "<=", ">="]);
const CONSTANTS: Readonly<Record<string, number>> = { TRUE: -1, FALSE: 0, ON: -1, OFF: 0, PI: Math.PI };
/** Written without brackets. */
const BARE = new Set(["NULL", "HERE", "DEST", "RANDOM"]);

/** Or and xor bind least, then and, not, comparison, sum, product, sign, power; `:` joins locations first of all. */
export function readExpression(cursor: Cursor, depth = 0): Expression {
  if (depth > DEPTH)
    throw new TextError(cursor.here, "a simpler expression", `The expression is nested more than ${DEPTH} deep.`);
  return chain(
    cursor,
    word => word === "OR" || word === "XOR",
    () =>
      chain(
        cursor,
        word => word === "AND",
        () => not(cursor, depth),
      ),
  );
}

function chain(cursor: Cursor, joins: (word: string) => boolean, part: () => Expression): Expression {
  let left = part();
  while (joins(cursor.next)) {
    const { line, column } = cursor.here;
    const sign = cursor.take().toUpperCase();
    left = { kind: "binary", sign, left, right: part(), line, column };
  }
  return left;
}

function not(cursor: Cursor, depth: number): Expression {
  const { line, column } = cursor.here;
  let nots = 0;
  while (cursor.accept("NOT")) nots++;
  let value = chain(
    cursor,
    word => COMPARE.has(word),
    () =>
      chain(
        cursor,
        word => word === "+" || word === "-",
        () =>
          chain(
            cursor,
            word => word === "*" || word === "/" || word === "MOD",
            () => signed(cursor, depth),
          ),
      ),
  );
  for (; nots > 0; nots--) value = { kind: "unary", sign: "NOT", of: value, line, column };
  return value;
}

function signed(cursor: Cursor, depth: number): Expression {
  const { line, column } = cursor.here;
  const signs: ("-" | "+")[] = [];
  for (;;) {
    if (cursor.accept("-")) signs.push("-");
    else if (cursor.accept("+")) signs.push("+");
    else break;
  }
  let value = power(cursor, depth);
  for (const sign of signs.reverse()) value = { kind: "unary", sign, of: value, line, column };
  return value;
}

function power(cursor: Cursor, depth: number): Expression {
  const left = compound(cursor, depth);
  const { line, column } = cursor.here;
  return cursor.accept("**")
    ? { kind: "binary", sign: "**", left, right: compound(cursor, depth), line, column }
    : left;
}

function compound(cursor: Cursor, depth: number): Expression {
  const { line, column } = cursor.here;
  const parts = [primary(cursor, depth)];
  // A colon at the end of the line closes a VALUE list.
  while (cursor.next === ":" && cursor.second !== "") {
    cursor.take();
    parts.push(primary(cursor, depth));
  }
  return parts.length === 1 ? parts[0]! : { kind: "compound", parts, line, column };
}

function primary(cursor: Cursor, depth: number): Expression {
  const { line, column } = cursor.here;
  if (cursor.nextKind === "number") return { kind: "number", value: Number(cursor.take()), line, column };
  if (cursor.nextKind === "text") return { kind: "text", value: cursor.take().slice(1, -1), line, column };
  if (cursor.accept("(")) {
    const value = readExpression(cursor, depth + 1);
    cursor.expect(")");
    return value;
  }
  if (cursor.nextKind !== "word") throw cursor.unexpected("a value");
  const word = cursor.next;
  const constant = CONSTANTS[word];
  if (constant !== undefined) {
    cursor.take();
    return { kind: "number", value: constant, line, column };
  }
  if (BARE.has(word) && cursor.second !== "[") {
    cursor.take();
    return { kind: "call", name: word, args: [], line, column };
  }
  if (cursor.second === "(") {
    cursor.take();
    cursor.take();
    return {
      kind: "call",
      name: word,
      args: word === "SHIFT" ? shiftArguments(cursor, depth) : callArguments(cursor, depth),
      line,
      column,
    };
  }
  return readVariable(cursor, depth);
}

/** `a, , b)`: an argument left out is undefined. */
function callArguments(cursor: Cursor, depth: number): (Expression | undefined)[] {
  const args: (Expression | undefined)[] = [];
  if (cursor.accept(")")) return args;
  do args.push(cursor.next === "," || cursor.next === ")" ? undefined : readExpression(cursor, depth + 1));
  while (cursor.accept(","));
  cursor.expect(")");
  return args;
}

/** `a BY dx, dy, dz)` */
function shiftArguments(cursor: Cursor, depth: number): (Expression | undefined)[] {
  const location = readExpression(cursor, depth + 1);
  cursor.expect("BY");
  return [location, ...callArguments(cursor, depth)];
}

/** A name with its indices, as on the left of an assignment. */
export function readVariable(cursor: Cursor, depth = 0): Variable {
  const { line, column } = cursor.here;
  if (cursor.nextKind !== "word") throw cursor.unexpected("the name of a variable");
  const name = cursor.take().toLowerCase();
  checkName(name.replace(/^[$#]/, ""), { line, column });
  const indices: Expression[] = [];
  if (cursor.accept("[")) {
    if (cursor.next !== "]")
      do indices.push(readExpression(cursor, depth + 1));
      while (cursor.accept(","));
    cursor.expect("]");
  }
  return { kind: "variable", name, indices, line, column };
}

/** @throws {TextError} for a name that is too long. */
export function checkName(name: string, at: { readonly line: number; readonly column: number }): void {
  if (name.length > NAME_LENGTH)
    throw new TextError(
      at,
      `a name of at most ${NAME_LENGTH} characters`,
      `The name "${name}" has ${name.length} characters; V+ takes ${NAME_LENGTH}.`,
    );
}
