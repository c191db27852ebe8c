import { MOST_WHOLE, partsOf, withLeaves, type Expression, type Value } from "./expression.ts";

/** What names are worth now; undefined is not known. */
export interface ExpressionValues {
  variable(name: string): Value | undefined;
  signal(name: string): Value | undefined;
}

export type Evaluated =
  | { readonly kind: "value"; readonly value: Value }
  | { readonly kind: "unknown" }
  | { readonly kind: "failed"; readonly sentence: string };

const UNKNOWN: Evaluated = { kind: "unknown" };
const failed = (sentence: string): Evaluated => ({ kind: "failed", sentence });

/**
 * What an expression is worth. Always answers: a division by zero, a root of a negative number or a whole number beyond
 * ±2³¹ is a failure with a sentence. What depends on a value that is not known is unknown, unless the rest decides:
 * `false and x` is false.
 */
export function evaluate(expression: Expression, values: ExpressionValues): Evaluated {
  if (typeof expression !== "object") return { kind: "value", value: expression };
  if ("value" in expression) return { kind: "value", value: expression.value };
  if ("variable" in expression) return known(values.variable(expression.variable));
  if ("signal" in expression) return known(values.signal(expression.signal));
  if ("op" in expression && (expression.op === "and" || expression.op === "or"))
    return joined(expression.op, expression.of, values);
  const parts: Value[] = [];
  let isKnown = true;
  for (const part of partsOf(expression)) {
    const answer = evaluate(part, values);
    if (answer.kind === "failed") return answer;
    if (answer.kind === "unknown") isKnown = false;
    else parts.push(answer.value);
  }
  if (!isKnown) return UNKNOWN;
  const value = "op" in expression ? operated(expression.op, parts) : applied(expression.call, parts.map(numberOf));
  if (typeof value === "string") return failed(value);
  if (typeof value === "number" && !Number.isFinite(value)) return failed("A number grew beyond all bounds.");
  if (typeof value === "number" && Number.isInteger(value) && parts.every(isWhole) && Math.abs(value) > MOST_WHOLE)
    return failed(`A whole number went beyond ±${MOST_WHOLE}.`);
  return { kind: "value", value };
}

const isWhole = (value: Value): boolean => typeof value === "boolean" || Number.isInteger(value);
const known = (value: Value | undefined): Evaluated => (value === undefined ? UNKNOWN : { kind: "value", value });
/** A digital line beside a number counts as 0 or 1, a number as yes when it is not 0. */
const numberOf = (value: Value): number => (typeof value === "number" ? value : value ? 1 : 0);
const truthOf = (value: Value): boolean => (typeof value === "boolean" ? value : value !== 0);

/** The right side is not looked at where the left one decides. */
function joined(op: "and" | "or", [a, b]: readonly Expression[], values: ExpressionValues): Evaluated {
  const decides = op === "or";
  const left = evaluate(a!, values);
  if (left.kind === "failed") return left;
  if (left.kind === "value" && truthOf(left.value) === decides) return { kind: "value", value: decides };
  const right = evaluate(b!, values);
  if (right.kind === "failed") return right;
  if (right.kind === "value" && truthOf(right.value) === decides) return { kind: "value", value: decides };
  return left.kind === "unknown" || right.kind === "unknown" ? UNKNOWN : { kind: "value", value: !decides };
}

/** The value, or the sentence of why there is none. */
function operated(op: Extract<Expression, { readonly op: unknown }>["op"], parts: readonly Value[]): Value | string {
  const [first, second = first] = parts as readonly [Value, Value?];
  const a = numberOf(first);
  const b = numberOf(second);
  switch (op) {
    case "not":
      return !truthOf(first);
    case "and":
      return truthOf(first) && truthOf(second);
    case "or":
      return truthOf(first) || truthOf(second);
    case "neg":
      return 0 - a;
    case "+":
      return a + b;
    case "-":
      return a - b;
    case "*":
      return a * b;
    case "/":
    case "div":
    case "mod":
      return b === 0 ? "A number is divided by zero." : divided(op, a, b);
    default:
      return compared(op, a, b);
  }
}

/** Adding 0 makes a zero of a negative number the ordinary zero. */
const divided = (op: "/" | "div" | "mod", a: number, b: number): number =>
  op === "/" ? a / b : (op === "div" ? Math.trunc(a / b) : a % b) + 0;

function compared(op: "=" | "<>" | "<" | "<=" | ">" | ">=", a: number, b: number): boolean {
  switch (op) {
    case "=":
      return a === b;
    case "<>":
      return a !== b;
    case "<":
      return a < b;
    case "<=":
      return a <= b;
    case ">":
      return a > b;
    case ">=":
      return a >= b;
  }
}

function applied(
  call: Extract<Expression, { readonly call: unknown }>["call"],
  parts: readonly number[],
): Value | string {
  const [a, b = a] = parts as readonly [number, number?];
  switch (call) {
    case "abs":
      return Math.abs(a);
    case "min":
      return Math.min(a, b);
    case "max":
      return Math.max(a, b);
    case "sqrt":
      return a < 0 ? "The root of a negative number is asked for." : Math.sqrt(a);
    case "sin":
      return Math.sin(a);
    case "cos":
      return Math.cos(a);
    case "trunc":
      return Math.trunc(a) + 0;
  }
}

/** The expression with variables as their values; those that are not known stay. */
export const withValues = (expression: Expression, variable: ExpressionValues["variable"]): Expression =>
  withLeaves(expression, leaf =>
    typeof leaf === "object" && "variable" in leaf ? (variable(leaf.variable) ?? leaf) : leaf,
  );
