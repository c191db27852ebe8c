import { TextError } from "../../parser/index.ts";
import type { Cursor } from "./cursor.ts";
import type { Expression, Variable } from "./syntax.ts";

const NAME_LENGTH = 24;
/** Brackets inside brackets: more than anybody writes, less than the stack holds. */
const DEPTH = 60;

/** What stands behind a value that is no part of a longer one. */
const ALONE = new Set([",", "}", ")", "]", ""]);
const COMPARE = new Set(["==", "<>", "<", ">", "<=", ">="]);
const AND = new Set(["AND", "B_AND"]);
const EXOR = new Set(["EXOR", "B_EXOR"]);
const OR = new Set(["OR", "B_OR"]);
const SUM = new Set(["+", "-"]);
const PRODUCT = new Set(["*", "/"]);
const FRAMES = new Set([":"]);

/** Or binds least, then exor, and, not, comparison, sum, product, sign; `:` joins frames first of all. */
export function readExpression(cursor: Cursor, depth = 0): Expression {
  if (depth > DEPTH)
    throw new TextError(cursor.here, "a simpler expression", `The expression is nested more than ${DEPTH} deep.`);
  // A number alone, as nearly every value of a point is.
  if (cursor.nextKind === "number" && ALONE.has(cursor.second)) return primary(cursor, depth);
  return chain(cursor, OR, () => chain(cursor, EXOR, () => chain(cursor, AND, () => not(cursor, depth))));
}

function chain(cursor: Cursor, joins: ReadonlySet<string>, part: () => Expression): Expression {
  let left = part();
  while (joins.has(cursor.next)) {
    const { line, column } = cursor.here;
    const sign = cursor.take().toUpperCase();
    left = { kind: "binary", sign, left, right: part(), line, column };
  }
  return left;
}

function not(cursor: Cursor, depth: number): Expression {
  const { line, column } = cursor.here;
  const nots: string[] = [];
  while (cursor.next === "NOT" || cursor.next === "B_NOT") nots.push(cursor.take().toUpperCase());
  let value = chain(cursor, COMPARE, () =>
    chain(cursor, SUM, () => chain(cursor, PRODUCT, () => signed(cursor, depth))),
  );
  for (const sign of nots.reverse()) value = { kind: "unary", sign, of: value, line, column };
  return value;
}

function signed(cursor: Cursor, depth: number): Expression {
  const { line, column } = cursor.here;
  let minus = false;
  let signs = 0;
  for (; ; signs++) {
    if (cursor.accept("-")) minus = !minus;
    else if (!cursor.accept("+")) break;
  }
  const value = chain(cursor, FRAMES, () => primary(cursor, depth));
  if (signs === 0 || !minus) return value;
  return value.kind === "number"
    ? { ...value, value: -value.value }
    : { kind: "unary", sign: "-", of: value, line, column };
}

function primary(cursor: Cursor, depth: number): Expression {
  const { line, column } = cursor.here;
  switch (cursor.nextKind) {
    case "number": {
      const text = cursor.take();
      return { kind: "number", value: Number(text), whole: /^[0-9]+$/.test(text), line, column };
    }
    case "bits": {
      const text = cursor.take();
      return {
        kind: "number",
        value: parseInt(text.slice(2, -1), text[1]!.toUpperCase() === "B" ? 2 : 16),
        whole: true,
        line,
        column,
      };
    }
    case "text":
      return { kind: "text", value: cursor.take().slice(1, -1), line, column };
    case "enum":
      return { kind: "enum", value: cursor.take().toUpperCase().replace(" ", ""), line, column };
    case "word":
      return named(cursor, depth);
    default:
  }
  if (cursor.next === "{") return readAggregate(cursor, depth + 1);
  if (!cursor.accept("(")) throw cursor.unexpected("a value");
  const value = readExpression(cursor, depth + 1);
  cursor.expect(")");
  return value;
}

function named(cursor: Cursor, depth: number): Expression {
  const { line, column } = cursor.here;
  if (cursor.next === "TRUE" || cursor.next === "FALSE")
    return { kind: "bool", value: cursor.take().toUpperCase() === "TRUE", line, column };
  if (cursor.second !== "(") return readVariable(cursor, depth);
  const name = cursor.name();
  cursor.take();
  return { kind: "call", name, args: readArguments(cursor, depth), line, column };
}

/** `a,,b)` behind an opened bracket: an argument left out is undefined. */
export function readArguments(cursor: Cursor, depth = 0): (Expression | undefined)[] {
  const args: (Expression | undefined)[] = [];
  if (cursor.accept(")")) return args;
  do args.push(cursor.next === "," || cursor.next === ")" ? undefined : readExpression(cursor, depth + 1));
  while (cursor.accept(","));
  cursor.expect(")");
  return args;
}

/** `{TYPE: NAME value,NAME value}`; the type and its colon may be missing. */
function readAggregate(cursor: Cursor, depth: number): Expression {
  if (depth > DEPTH)
    throw new TextError(cursor.here, "a simpler value", `The value is nested more than ${DEPTH} deep.`);
  const { line, column } = cursor.here;
  cursor.expect("{");
  const type = cursor.nextKind === "word" && cursor.second === ":" ? cursor.name() : undefined;
  if (type !== undefined) cursor.take();
  const fields: [string, Expression][] = [];
  const met = new Set<string>();
  if (cursor.next !== "}") {
    do {
      const at = cursor.here;
      let name = cursor.name("the name of a component");
      if (cursor.accept("[")) {
        if (cursor.nextKind === "number") name += `[${cursor.take()}]`;
        cursor.expect("]");
      }
      if (met.has(name)) throw new TextError(at, "every component once", `Component ${name} is given twice.`);
      met.add(name);
      fields.push([name, readExpression(cursor, depth)]);
    } while (cursor.accept(","));
  }
  cursor.expect("}");
  return { kind: "aggregate", type, fields, line, column };
}

/** A name with indices and members, as on the left of an assignment. */
export function readVariable(cursor: Cursor, depth = 0): Variable {
  const { line, column } = cursor.here;
  const parts: { name: string; indices: Expression[] }[] = [];
  do {
    const at = cursor.here;
    const name = cursor.name("the name of a variable");
    const indices: Expression[] = [];
    checkName(name, at);
    if (cursor.accept("[")) {
      if (cursor.next !== "]") {
        do if (cursor.next !== "," && cursor.next !== "]") indices.push(readExpression(cursor, depth + 1));
        while (cursor.accept(","));
      }
      cursor.expect("]");
    }
    parts.push({ name, indices });
  } while (cursor.accept("."));
  return { kind: "variable", parts, line, column };
}

/** @throws {TextError} for a name that is too long. */
export function checkName(name: string, at: { readonly line: number; readonly column: number }): void {
  if (name.length > NAME_LENGTH && !name.startsWith("$"))
    throw new TextError(
      at,
      `a name of at most ${NAME_LENGTH} characters`,
      `The name "${name}" has ${name.length} characters; KRL takes ${NAME_LENGTH}.`,
    );
}
