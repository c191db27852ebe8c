import { partsOf, type Expression, type Unit, type ValueType } from "./expression.ts";

/** Exponents of m, s, kg and rad. */
type Dimension = readonly [number, number, number, number];
const NONE: Dimension = [0, 0, 0, 0];
const OF_UNIT: Readonly<Record<Unit, Dimension>> = {
  m: [1, 0, 0, 0],
  s: [0, 1, 0, 0],
  kg: [0, 0, 1, 0],
  rad: [0, 0, 0, 1],
  "m/s": [1, -1, 0, 0],
  "rad/s": [0, -1, 0, 1],
};
const SYMBOLS = ["m", "s", "kg", "rad"] as const;

/** "any": a line that is not connected yet, which may be on or off or have a level. */
type Inferred =
  | { readonly type: "bool" }
  | { readonly type: "int" }
  | { readonly type: "num"; readonly of: Dimension }
  | { readonly type: "any" };

/** What names in an expression mean; undefined for one that means nothing. */
export interface ExpressionScope {
  variable(name: string): ValueType | undefined;
  /** "unknown": the line may be connected later. */
  signal(name: string): "digital" | "analogue" | "unknown" | undefined;
}

/** `at`: the way to the part that is wrong, as places in `of`. */
export interface TypeFault {
  readonly kind: "fault";
  readonly at: readonly number[];
  readonly sentence: string;
}
export type Typed = { readonly kind: "typed" } | TypeFault;

class Mismatch extends Error {
  readonly at: readonly number[];
  constructor(at: readonly number[], sentence: string) {
    super(sentence);
    this.at = at;
  }
}

/**
 * Whether an expression gives a value of that type: names exist, sides agree in kind and unit. Whole numbers count as
 * numbers, never the other way round.
 */
export function checkType(expression: Expression, wanted: ValueType, scope: ExpressionScope): Typed {
  try {
    const got = infer(expression, scope, []);
    if (accepts(wanted, got)) return { kind: "typed" };
    return { kind: "fault", at: [], sentence: `It is ${shown(got)}; here ${shown(inferredOf(wanted))} is wanted.` };
  } catch (cause) {
    if (!(cause instanceof Mismatch)) throw cause;
    return { kind: "fault", at: cause.at, sentence: cause.message };
  }
}

/** What sort of value an expression gives, if its names and units are right. */
export function typeOf(expression: Expression, scope: ExpressionScope): "bool" | "int" | "num" | "any" | undefined {
  try {
    return infer(expression, scope, []).type;
  } catch (cause) {
    if (!(cause instanceof Mismatch)) throw cause;
    return undefined;
  }
}

const inferredOf = (type: ValueType): Inferred =>
  type.type === "num" ? { type: "num", of: type.unit === undefined ? NONE : OF_UNIT[type.unit] } : { type: type.type };

function accepts(wanted: ValueType, got: Inferred): boolean {
  if (got.type === "any") return true;
  if (wanted.type !== "num") return wanted.type === got.type;
  return isNumber(got) && sameDimension(dimension(got), wanted.unit === undefined ? NONE : OF_UNIT[wanted.unit]);
}

const isNumber = (type: Inferred): boolean => type.type !== "bool";
const isBool = (type: Inferred): boolean => type.type === "bool" || type.type === "any";
const dimension = (type: Inferred): Dimension => (type.type === "num" ? type.of : NONE);
const sameDimension = (a: Dimension, b: Dimension): boolean => a.every((power, i) => power === b[i]);

function shown(type: Inferred): string {
  switch (type.type) {
    case "bool":
      return "yes or no";
    case "int":
      return "a whole number";
    case "any":
      return "a line";
    case "num":
      return sameDimension(type.of, NONE) ? "a number without a unit" : `a number in ${unitOf(type.of)}`;
  }
}

function unitOf(powers: Dimension): string {
  const part = (sign: 1 | -1): string =>
    SYMBOLS.flatMap((symbol, i) => {
      const power = powers[i]! * sign;
      return power > 0 ? [power === 1 ? symbol : `${symbol}^${power}`] : [];
    }).join("·");
  const below = part(-1);
  return below === "" ? part(1) : `${part(1) || "1"}/${below}`;
}

function infer(expression: Expression, scope: ExpressionScope, at: readonly number[]): Inferred {
  if (typeof expression === "boolean") return { type: "bool" };
  if (typeof expression === "number") return Number.isInteger(expression) ? { type: "int" } : { type: "num", of: NONE };
  if ("value" in expression) return { type: "num", of: OF_UNIT[expression.unit] };
  if ("variable" in expression) {
    const type = scope.variable(expression.variable);
    if (type === undefined) throw new Mismatch(at, `There is no variable “${expression.variable}” here.`);
    return inferredOf(type);
  }
  if ("signal" in expression) {
    const line = scope.signal(expression.signal);
    if (line === undefined) throw new Mismatch(at, `There is no signal “${expression.signal}”.`);
    return line === "unknown" ? { type: "any" } : line === "digital" ? { type: "bool" } : { type: "num", of: NONE };
  }
  const types = partsOf(expression).map((part, i) => infer(part, scope, [...at, i]));
  return "call" in expression ? ofCall(expression.call, types, at) : ofOperator(expression.op, types, at);
}

type OperatorExpression = Extract<Expression, { readonly op: unknown }>;

function ofOperator(op: OperatorExpression["op"], types: readonly Inferred[], at: readonly number[]): Inferred {
  const [a, b = a] = types as readonly [Inferred, Inferred?];
  switch (op) {
    case "not":
    case "and":
    case "or":
      types.forEach((type, i) => {
        if (!isBool(type)) throw new Mismatch([...at, i], `“${op}” joins what is yes or no; this is ${shown(type)}.`);
      });
      return { type: "bool" };
    case "neg":
      numbers("-", types, at);
      return a;
    case "=":
    case "<>":
      return ofEquality(op, a, b, at);
    case "<":
    case "<=":
    case ">":
    case ">=":
      alike(op, types, at);
      return { type: "bool" };
    case "+":
    case "-":
      return alike(op, types, at);
    case "*":
    case "/":
      return product(op, types, at);
    case "div":
    case "mod":
      types.forEach((type, i) => {
        if (type.type !== "int")
          throw new Mismatch([...at, i], `“${op}” divides whole numbers; this is ${shown(type)}.`);
      });
      return { type: "int" };
  }
}

/** Numbers that are measured are hardly ever equal: only whole numbers and yes or no are compared so. */
function ofEquality(op: "=" | "<>", a: Inferred, b: Inferred, at: readonly number[]): Inferred {
  const alikeEnough = a.type === "any" || b.type === "any" || a.type === b.type;
  if (alikeEnough && a.type !== "num" && b.type !== "num") return { type: "bool" };
  throw new Mismatch(
    at,
    `“${op}” compares whole numbers, or what is yes or no; here are ${shown(a)} and ${shown(b)}. Compare other numbers by < or >.`,
  );
}

function ofCall(
  call: Extract<Expression, { readonly call: unknown }>["call"],
  types: readonly Inferred[],
  at: readonly number[],
): Inferred {
  numbers(call, types, at);
  const first = types[0]!;
  switch (call) {
    case "abs":
      return first;
    case "min":
    case "max":
      return alike(call, types, at);
    case "sqrt":
      return { type: "num", of: dimension(first).map(power => power / 2) as unknown as Dimension };
    case "sin":
    case "cos":
      if (!sameDimension(dimension(first), OF_UNIT.rad))
        throw new Mismatch([...at, 0], `“${call}” takes an angle; this is ${shown(first)}.`);
      return { type: "num", of: NONE };
    case "trunc":
      if (!sameDimension(dimension(first), NONE))
        throw new Mismatch([...at, 0], `“trunc” takes a number without a unit; this is ${shown(first)}.`);
      return { type: "int" };
  }
}

function numbers(what: string, types: readonly Inferred[], at: readonly number[]): void {
  types.forEach((type, i) => {
    if (!isNumber(type)) throw new Mismatch([...at, i], `“${what}” takes numbers; this is ${shown(type)}.`);
  });
}

/** Both sides are numbers in one unit; whole when both are. */
function alike(what: string, types: readonly Inferred[], at: readonly number[]): Inferred {
  numbers(what, types, at);
  const [a, b = a] = types as readonly [Inferred, Inferred?];
  if (!sameDimension(dimension(a), dimension(b)))
    throw new Mismatch(at, `“${what}” joins numbers in one unit; here are ${shown(a)} and ${shown(b)}.`);
  return a.type === "int" && b.type === "int" ? a : { type: "num", of: dimension(a) };
}

function product(op: "*" | "/", types: readonly Inferred[], at: readonly number[]): Inferred {
  numbers(op, types, at);
  const [a, b = a] = types as readonly [Inferred, Inferred?];
  if (op === "*" && a.type === "int" && b.type === "int") return a;
  const right = dimension(b);
  return {
    type: "num",
    of: dimension(a).map((power, i) => (op === "*" ? power + right[i]! : power - right[i]!)) as unknown as Dimension,
  };
}
