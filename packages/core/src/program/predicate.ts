import { linesOf, variablesOf, withLineNames, type Expression } from "./expression/expression.ts";
import { printExpression, nameInText } from "./expression/print.ts";
import type { Condition, Predicate, Step } from "./program.ts";

/** The same condition as an expression. */
export function expressionOf(when: Predicate): Expression {
  if ("expression" in when) return when.expression;
  const line: Expression = { signal: when.signal };
  if ("is" in when) return when.is ? line : { op: "not", of: [line] };
  return "above" in when ? { op: ">", of: [line, when.above] } : { op: "<", of: [line, when.below] };
}

/**
 * The simplest condition that says the same: one line where the expression is about one line, so that every controller
 * can say it.
 *
 * @param isDigital  whether that line is on or off.
 */
export function predicateOf(expression: Expression, isDigital: (signal: string) => boolean): Predicate {
  const simple = (part: Expression): string | undefined =>
    typeof part === "object" && "signal" in part ? part.signal : undefined;
  const line = simple(expression);
  if (line !== undefined && isDigital(line)) return { signal: line, is: true };
  if (typeof expression === "object" && "op" in expression) {
    const [a, b] = expression.of;
    const signal = simple(a);
    if (signal !== undefined && expression.op === "not" && isDigital(signal)) return { signal, is: false };
    if (signal !== undefined && typeof b === "number" && !isDigital(signal)) {
      if (expression.op === ">") return { signal, above: b };
      if (expression.op === "<") return { signal, below: b };
    }
  }
  return { expression };
}

/** Names of the lines that a condition looks at. */
export const predicateLines = (when: Predicate): readonly string[] =>
  "expression" in when ? [...linesOf(when.expression)] : [when.signal];

/** Names of the variables that a condition looks at. */
export const predicateVariables = (when: Predicate): ReadonlySet<string> =>
  "expression" in when ? variablesOf(when.expression) : new Set();

export const isCondition = (when: Predicate): when is Condition => !("expression" in when);

/** What a condition looks at, for sentences: “the signal “x”” or the expression itself. */
export const predicateWords = (when: Predicate): string =>
  "expression" in when ? `“${printExpression(when.expression)}”` : `the signal “${when.signal}”`;

/** The whole condition in one line. */
export const predicateText = (when: Predicate): string =>
  "expression" in when
    ? printExpression(when.expression)
    : "is" in when
      ? `${when.is ? "" : "not "}${nameInText(when.signal)}`
      : printExpression(expressionOf(when));

/** The same with other names for its lines. */
export function withPredicateLines<P extends Predicate>(when: P, nameOf: (signal: string) => string): P;
export function withPredicateLines(when: Predicate, nameOf: (signal: string) => string): Predicate {
  return "expression" in when
    ? { expression: withLineNames(when.expression, nameOf) }
    : { ...when, signal: nameOf(when.signal) };
}

/** Whether the robot goes past a step without stopping: a remark, or what is computed without looking at a line. */
export const isPassedOver = (step: Step): boolean =>
  step.type === "comment" || (step.type === "assign" && linesOf(step.to).size === 0);

/** The expressions a step holds by itself, without the steps inside it. */
export function* expressionsOf(step: Step): Generator<Expression, void> {
  switch (step.type) {
    case "assign":
      yield step.to;
      return;
    case "call":
      yield* Object.values(step.arguments ?? {});
      return;
    case "if":
    case "while":
    case "wait-for":
      yield expressionOf(step.when);
  }
}
