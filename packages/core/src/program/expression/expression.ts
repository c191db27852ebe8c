/** What a variable or an expression is worth. Angles, lengths and times are in rad, m and s. */
export type Value = boolean | number;

/** Units in which numbers of a program are kept. */
export const UNITS = ["m", "rad", "s", "kg", "m/s", "rad/s"] as const;
export type Unit = (typeof UNITS)[number];

export const UNARY = ["not", "neg"] as const;
export const BINARY = ["or", "and", "=", "<>", "<", "<=", ">", ">=", "+", "-", "*", "/", "div", "mod"] as const;
export type UnaryOperator = (typeof UNARY)[number];
export type BinaryOperator = (typeof BINARY)[number];

/** Pure functions, with how many values they take. */
export const FUNCTIONS = { abs: 1, min: 2, max: 2, sqrt: 1, sin: 1, cos: 1, trunc: 1 } as const;
export type FunctionName = keyof typeof FUNCTIONS;
export const FUNCTION_NAMES = Object.keys(FUNCTIONS) as readonly FunctionName[];

/**
 * A closed tree: what a program computes with its variables and lines. A plain number that is whole counts as a whole
 * number; one with a unit is in that unit of SI. `div` and `mod` cut towards zero.
 */
export type Expression =
  | Value
  | { readonly value: number; readonly unit: Unit }
  | { readonly variable: string }
  | { readonly signal: string }
  | { readonly op: UnaryOperator; readonly of: readonly [Expression] }
  | { readonly op: BinaryOperator; readonly of: readonly [Expression, Expression] }
  | { readonly call: FunctionName; readonly of: readonly Expression[] };

/** bool: yes or no. int: a whole number. num: any number, with its unit if it has one. */
export type ValueType =
  | { readonly type: "bool" }
  | { readonly type: "int" }
  | { readonly type: "num"; readonly unit?: Unit };

/** A variable of a program; `initial` is its value when the program begins: no, or 0, when left out. */
export type Variable = ValueType & { readonly initial?: Value };

/** Whole numbers of every controller. */
export const MOST_WHOLE = 2_147_483_647;
/** Trees deeper, or with more parts, than this help nobody. */
export const DEEPEST_EXPRESSION = 16;
export const MOST_PARTS = 200;

export const initialOf = (variable: Variable): Value => variable.initial ?? (variable.type === "bool" ? false : 0);

/** What is directly inside an expression. */
export const partsOf = (expression: Expression): readonly Expression[] =>
  typeof expression === "object" && "of" in expression ? expression.of : [];

/** The expression and all that is inside it. */
export function* everyPart(expression: Expression): Generator<Expression, void> {
  yield expression;
  for (const part of partsOf(expression)) yield* everyPart(part);
}

/** Names of the lines that an expression reads, each once. */
export function linesOf(expression: Expression): ReadonlySet<string> {
  const names = new Set<string>();
  for (const part of everyPart(expression)) if (typeof part === "object" && "signal" in part) names.add(part.signal);
  return names;
}

/** Names of the variables that an expression reads, each once. */
export function variablesOf(expression: Expression): ReadonlySet<string> {
  const names = new Set<string>();
  for (const part of everyPart(expression))
    if (typeof part === "object" && "variable" in part) names.add(part.variable);
  return names;
}

/** The expression with its leaves put through `change`; the very same when none changed. */
export function withLeaves(expression: Expression, change: (leaf: Expression) => Expression): Expression {
  if (typeof expression !== "object" || !("of" in expression)) return change(expression);
  const of = expression.of.map(part => withLeaves(part, change));
  return of.every((part, i) => part === expression.of[i]) ? expression : ({ ...expression, of } as Expression);
}

/** The same with other names for its lines. */
export const withLineNames = (expression: Expression, nameOf: (signal: string) => string): Expression =>
  withLeaves(expression, leaf =>
    typeof leaf === "object" && "signal" in leaf ? { signal: nameOf(leaf.signal) } : leaf,
  );
