import { TextError } from "../faults.ts";
import type { TokenCursor } from "./cursor.ts";
import type { Argument, Expression } from "./tree.ts";

/** How a language writes expressions. */
export interface ExpressionRules {
  /** Binding strength of signs between two values; a higher one binds first. All join from left to right. */
  readonly binary: Readonly<Record<string, number>>;
  /** Binding strength of what stands before a value. */
  readonly prefix: Readonly<Record<string, number>>;
  readonly constants: Readonly<Record<string, number | boolean>>;
  /** Words that can stand before a list, as `p` in `p[…]`. */
  readonly tags: readonly string[];
  /** Brackets around an index: `[]` or `{}`. */
  readonly index: "[" | "{";
  readonly components: boolean;
  /** Words that are no value. */
  readonly reserved: ReadonlySet<string>;
  /** Reads the arguments of a call behind its opening bracket, up to and with the closing one. */
  readonly args: (cursor: TokenCursor, depth: number) => readonly Argument[];
}

const JOINING = { or: 1, and: 2 } as const;
const COMPUTING = { "<": 4, ">": 4, "<=": 4, ">=": 4, "+": 5, "-": 5, "*": 6, "/": 6 } as const;
/** Binding strength where values are compared as in C. */
export const BINDS_AS_C: ExpressionRules["binary"] = { ...JOINING, xor: 1, "==": 4, "!=": 4, ...COMPUTING, "%": 6 };
/** Binding strength where values are compared as in BASIC. */
export const BINDS_AS_BASIC: ExpressionRules["binary"] = {
  ...JOINING,
  "=": 4,
  "<>": 4,
  ...COMPUTING,
  div: 6,
  mod: 6,
};

/** Brackets inside brackets: more than anybody writes, less than the stack holds. */
const DEPTH = 40;

/** @throws {TextError} where no expression of the language stands. */
export function readExpression(cursor: TokenCursor, rules: ExpressionRules, depth = 0, least = 0): Expression {
  if (depth > DEPTH)
    throw new TextError(cursor.here, "a simpler expression", `The expression is nested more than ${DEPTH} deep.`);
  let left = readPrefix(cursor, rules, depth);
  for (;;) {
    const sign = cursor.next;
    if (sign === "," || sign === ")" || sign === "]") return left;
    const strength = cursor.kind === "text" || !Object.hasOwn(rules.binary, sign) ? undefined : rules.binary[sign];
    if (strength === undefined || strength <= least) return left;
    const { line, column } = cursor.here;
    cursor.advance();
    left = { kind: "binary", sign, left, right: readExpression(cursor, rules, depth + 1, strength), line, column };
  }
}

function readPrefix(cursor: TokenCursor, rules: ExpressionRules, depth: number): Expression {
  const sign = cursor.next;
  if (cursor.kind !== "text" && cursor.kind !== "number" && Object.hasOwn(rules.prefix, sign)) {
    const { line, column } = cursor.here;
    const strength = rules.prefix[sign]!;
    cursor.advance();
    const of = readExpression(cursor, rules, depth + 1, strength);
    // A number with its minus is a number.
    if (sign === "-" && of.kind === "number") return { kind: "number", value: -of.value, line, column };
    return sign === "+" ? of : { kind: "unary", sign, of, line, column };
  }
  return readSuffix(cursor, rules, depth, readPrimary(cursor, rules, depth));
}

function readPrimary(cursor: TokenCursor, rules: ExpressionRules, depth: number): Expression {
  const { line, column } = cursor.here;
  switch (cursor.kind) {
    case "number": {
      const value = Number(cursor.raw);
      if (!Number.isFinite(value))
        throw new TextError(cursor.here, "a number that can be held", `${cursor.raw} is too large.`);
      cursor.advance();
      return { kind: "number", value, line, column };
    }
    case "text": {
      const value = cursor.raw;
      cursor.advance();
      return { kind: "text", value, line, column };
    }
    case "word":
      return readWord(cursor, rules, depth);
    case "sign":
      break;
    case "line-end":
    case "end":
      throw cursor.unexpected("a value");
  }
  if (cursor.accept("(")) {
    const value = readExpression(cursor, rules, depth + 1);
    cursor.expect(")");
    return value;
  }
  if (cursor.next === "[") return readList(cursor, rules, depth, "");
  throw cursor.unexpected("a value");
}

function readWord(cursor: TokenCursor, rules: ExpressionRules, depth: number): Expression {
  const { line, column } = cursor.here;
  const name = cursor.next;
  if (rules.tags.includes(name) && cursor.second === "[") {
    cursor.advance();
    return { ...readList(cursor, rules, depth, name), line, column };
  }
  if (Object.hasOwn(rules.constants, name)) {
    const value = rules.constants[name]!;
    cursor.advance();
    return typeof value === "number" ? { kind: "number", value, line, column } : { kind: "truth", value, line, column };
  }
  if (rules.reserved.has(name)) throw cursor.unexpected("a value");
  cursor.advance();
  if (!cursor.accept("(")) return { kind: "variable", name, line, column };
  return { kind: "call", name, args: rules.args(cursor, depth + 1), line, column };
}

function readList(cursor: TokenCursor, rules: ExpressionRules, depth: number, tag: string): Expression {
  const { line, column } = cursor.here;
  cursor.expect("[");
  const items: Expression[] = [];
  if (!cursor.accept("]")) {
    do items.push(readExpression(cursor, rules, depth + 1));
    while (cursor.accept(","));
    cursor.expect("]");
  }
  return { kind: "list", tag, items, line, column };
}

/** Indices and components behind a value. */
function readSuffix(cursor: TokenCursor, rules: ExpressionRules, depth: number, value: Expression): Expression {
  let of = value;
  for (;;) {
    if (cursor.kind !== "sign") return of;
    if (cursor.next === rules.index) {
      const { line, column } = cursor.here;
      cursor.advance();
      const indices = [readExpression(cursor, rules, depth + 1)];
      while (cursor.accept(",")) indices.push(readExpression(cursor, rules, depth + 1));
      cursor.expect(rules.index === "[" ? "]" : "}");
      of = { kind: "index", of, indices, line, column };
    } else if (rules.components && cursor.next === ".") {
      const { line, column } = cursor.here;
      cursor.advance();
      const name = cursor.name("the name of a component");
      of =
        of.kind === "variable" && cursor.accept("(")
          ? { kind: "call", name: `${of.name}.${name}`, args: rules.args(cursor, depth + 1), line, column }
          : { kind: "component", of, name, line, column };
    } else return of;
  }
}
