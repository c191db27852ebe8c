import type { Condition, SignalLine, Signals, TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Expression } from "../../parser/structured/index.ts";

/** Lines that a program speaks of, by their names in the neutral program. */
export type Lines = Record<string, SignalLine>;
type Kind = SignalLine["kind"];

/** What a function reads or writes: its kind of line and the number that its first line has. */
interface Route {
  readonly kind: Kind;
  readonly first: number;
  readonly count: number;
}
const DIGITAL: readonly (readonly [name: string, first: number, count: number])[] = [
  ["standard_digital", 0, 8],
  ["configurable_digital", 8, 8],
  ["tool_digital", 16, 2],
  ["digital", 0, 18],
];
const ANALOGUE: readonly (readonly [name: string, first: number, count: number])[] = [
  ["standard_analog", 0, 2],
  ["tool_analog", 2, 2],
  ["analog", 0, 4],
];
const DOORS = new Map<string, Route>();
for (const [names, kind] of [
  [DIGITAL, "digital"],
  [ANALOGUE, "analogue"],
] as const) {
  for (const [name, first, count] of names) {
    DOORS.set(`get_${name}_in`, { kind: `${kind}-in`, first, count });
    DOORS.set(`get_${name}_out`, { kind: `${kind}-out`, first, count });
    DOORS.set(`set_${name}_out`, { kind: `${kind}-out`, first, count });
  }
}
export const routeOf = (name: string): Route | undefined => DOORS.get(name);

const SHORT: Readonly<Record<Kind, string>> = {
  "digital-in": "DI",
  "digital-out": "DO",
  "analogue-in": "AI",
  "analogue-out": "AO",
};

/**
 * The line that a number means at that door, under the name of the variable that holds the number, else DO3 and its
 * like.
 */
export function lineAt(route: Route, number: number, named: string | undefined, lines: Lines, at: TextPlace): string {
  if (!Number.isInteger(number) || number < 0 || number >= route.count)
    throw new TextError(at, `a line from 0 to ${route.count - 1}`, `There is no line ${number} here.`);
  const address = route.first + number;
  const known = Object.entries(lines).find(([, line]) => line.kind === route.kind && line.address === address);
  if (known !== undefined) return known[0];
  const free = named !== undefined && !Object.hasOwn(lines, named) ? named : `${SHORT[route.kind]}${address}`;
  lines[free] = { kind: route.kind, address };
  return free;
}

/** A condition of one line, as the neutral program has it; undefined for any other expression. */
export function conditionOf(
  expression: Expression,
  lineOf: (call: Extract<Expression, { kind: "call" }>) => string | undefined,
  number: (of: Expression) => number | undefined,
): Condition | undefined {
  switch (expression.kind) {
    case "call": {
      const signal = lineOf(expression);
      return signal === undefined ? undefined : { signal, is: true };
    }
    case "unary": {
      const inner = expression.sign === "not" ? conditionOf(expression.of, lineOf, number) : undefined;
      return inner !== undefined && "is" in inner ? { signal: inner.signal, is: !inner.is } : undefined;
    }
    case "binary": {
      if (expression.left.kind !== "call") return undefined;
      const signal = lineOf(expression.left);
      if (signal === undefined) return undefined;
      const { sign, right } = expression;
      if (right.kind === "truth" && (sign === "==" || sign === "!="))
        return { signal, is: right.value === (sign === "==") };
      const limit = number(right);
      if (limit === undefined) return undefined;
      if (sign === ">") return { signal, above: limit };
      return sign === "<" ? { signal, below: limit } : undefined;
    }
    default:
      return undefined;
  }
}

/** What a condition says now. */
export function holds(condition: Condition, signals: Signals): boolean {
  const value = signals.read(condition.signal);
  if ("is" in condition) return (value === true || (typeof value === "number" && value !== 0)) === condition.is;
  return "above" in condition ? Number(value) > condition.above : Number(value) < condition.below;
}
