import type { TextPlace } from "@twincell/core";
import { NotGiven, TextError, compared, computed } from "../../parser/index.ts";
import type { Expression, Variable } from "../read/syntax.ts";
import { NULL_TRANSFORM, about, frameOf, fromTrans, inverted, shifted, times, type Transform } from "./transform.ts";

/** Joint values in V+ degrees. */
export interface Precision {
  readonly kind: "precision";
  readonly joints_deg: readonly number[];
}
export type Value = number | string | Transform | Precision;

/** Where values come from while a program runs. */
export interface Memory {
  read(key: string): Value | undefined;
  /** State of a digital signal; `name` is that of the variable that holds the number, if one does. */
  signal(number: number, name: string | undefined): boolean;
  /** The tool now (HERE) and at the end of the motion under way (DEST), in the world of the program. */
  here(at: TextPlace): Transform;
  /**
   * Whether a variable lives in the controller and in none of the files; only where a text is executed as it is.
   */
  isMissing(key: string): boolean;
  /** What stands for a number or a text that only the controller has; undefined where that is refused. */
  inPlaceOf(variable: Variable, key: string): Value | undefined;
  /** A line that goes by the name of a variable which holds its number in the controller. */
  named(variable: string): boolean;
  /** Where the tool is when the joints have these values. */
  reached(precision: Precision): Transform;
  readonly joints: number;
}

const TRUE = -1;
const truth = (yes: boolean): number => (yes ? TRUE : 0);

/** Reals of the controller are single precision. */
const real = Math.fround;

export function evaluate(expression: Expression, memory: Memory): Value {
  switch (expression.kind) {
    case "number":
      return real(expression.value);
    case "text":
      return expression.value;
    case "variable": {
      const key = keyOf(expression, memory);
      const value = memory.read(key) ?? memory.inPlaceOf(expression, key);
      if (value === undefined)
        throw new TextError(expression, "a variable that has a value", `"${expression.name}" has no value yet.`);
      return value;
    }
    case "unary": {
      const value = number(expression.of, memory);
      return expression.sign === "NOT" ? truth(value === 0) : expression.sign === "-" ? -value : value;
    }
    case "binary":
      return binary(expression, memory);
    case "compound":
      // A variable in brackets of its own.
      if (expression.parts.length === 1) return evaluate(expression.parts[0]!, memory);
      return expression.parts.map(part => transform(part, memory)).reduce(times);
    case "call":
      return call(expression, memory);
  }
}

/** The name under which a variable or an element of an array is kept. */
export function keyOf(variable: Variable, memory: Memory, plus = 0): string {
  if (variable.indices.length === 0) return variable.name;
  const indices = variable.indices.map(index => Math.trunc(number(index, memory)));
  indices[indices.length - 1]! += plus;
  const odd = indices.findIndex(index => index < 0 || index > 32767);
  if (odd >= 0)
    throw new TextError(
      variable,
      "an index from 0 to 32767",
      `Index ${indices[odd]} of "${variable.name}" is outside 0 to 32767.`,
    );
  return `${variable.name}[${indices.join(",")}]`;
}

export function number(expression: Expression, memory: Memory): number {
  const value = evaluate(expression, memory);
  if (typeof value !== "number")
    throw new TextError(expression, "a number", `A ${kindOf(value)} stands where a number is expected.`);
  return value;
}

/** A place that only the controller has is no number that may be taken as 0. */
function given(expression: Expression, memory: Memory): void {
  const of = expression.kind === "compound" && expression.parts.length === 1 ? expression.parts[0]! : expression;
  if (of.kind === "variable" && memory.isMissing(keyOf(of, memory)))
    throw new NotGiven(of, "a location", `${of.name} is in none of the files`);
}

export function transform(expression: Expression, memory: Memory): Transform {
  given(expression, memory);
  const value = evaluate(expression, memory);
  if (typeof value === "number" || typeof value === "string" || value.kind === "precision") {
    throw new TextError(
      expression,
      "a transformation",
      `A ${kindOf(value)} stands where a transformation is expected.`,
    );
  }
  return value;
}

export function location(expression: Expression, memory: Memory): Transform | Precision {
  given(expression, memory);
  const value = evaluate(expression, memory);
  if (typeof value === "number" || typeof value === "string") {
    throw new TextError(expression, "a location", `A ${kindOf(value)} stands where a location is expected.`);
  }
  return value;
}

const kindOf = (value: Value): string =>
  typeof value === "number"
    ? "number"
    : typeof value === "string"
      ? "string"
      : value.kind === "precision"
        ? "precision point"
        : "transformation";

function binary(expression: Extract<Expression, { kind: "binary" }>, memory: Memory): Value {
  const { sign } = expression;
  const left = evaluate(expression.left, memory);
  const right = evaluate(expression.right, memory);
  if (typeof left === "string" && typeof right === "string") {
    if (sign === "==" || sign === "<>") return truth((left === right) === (sign === "=="));
    if (sign === "+") return left + right;
  }
  if (typeof left !== "number" || typeof right !== "number") {
    throw new TextError(
      expression,
      "two numbers",
      `"${sign}" joins numbers, not a ${kindOf(left)} and a ${kindOf(right)}.`,
    );
  }
  return joined(sign, left, right, expression);
}

function joined(sign: string, left: number, right: number, at: Extract<Expression, { kind: "binary" }>): Value {
  switch (sign) {
    case "AND":
      return truth(left !== 0 && right !== 0);
    case "OR":
      return truth(left !== 0 || right !== 0);
    case "XOR":
      return truth((left !== 0) !== (right !== 0));
  }
  const value = compared(sign, left, right) ?? computed(sign === "MOD" ? "mod" : sign, left, right, at.right);
  if (value === undefined) throw new TextError(at, "an operator", `"${sign}" is no operator.`);
  if (typeof value === "boolean") return truth(value);
  return sign === "**" ? finite(real(value), at) : real(value);
}

/** Name of the variable that a signal is called by, with or without a sign. */
export function signalName(expression: Expression): string | undefined {
  const plain = expression.kind === "unary" ? expression.of : expression;
  return plain.kind === "variable" && plain.indices.length === 0 ? plain.name : undefined;
}

type Call = Extract<Expression, { kind: "call" }>;
type Evaluate = (args: readonly Expression[], memory: Memory, call: Call) => Value;

const degrees = (angle: number): number => (angle / Math.PI) * 180;
const radians = (angle: number): number => (angle / 180) * Math.PI;
const ofNumber =
  (f: (x: number) => number): Evaluate =>
  ([x], memory, at) =>
    finite(real(f(number(x!, memory))), at);
const ofLocation =
  (f: (t: Transform) => number): Evaluate =>
  ([a], memory) =>
    real(f(transform(a!, memory)));
const extreme =
  (f: (...x: number[]) => number): Evaluate =>
  (args, memory) =>
    f(...args.map(arg => number(arg, memory)));

/** Functions with the number of arguments that each takes. */
const FUNCTIONS: Readonly<Record<string, readonly [least: number, most: number, evaluate: Evaluate]>> = {
  SIN: [1, 1, ofNumber(x => Math.sin(radians(x)))],
  COS: [1, 1, ofNumber(x => Math.cos(radians(x)))],
  TAN: [1, 1, ofNumber(x => Math.tan(radians(x)))],
  ATAN2: [2, 2, ([y, x], memory) => real(degrees(Math.atan2(number(y!, memory), number(x!, memory))))],
  SQRT: [1, 1, ofNumber(Math.sqrt)],
  SQR: [1, 1, ofNumber(x => x * x)],
  ABS: [1, 1, ofNumber(Math.abs)],
  INT: [1, 1, ofNumber(Math.trunc)],
  FRACT: [1, 1, ofNumber(x => x - Math.trunc(x))],
  SIGN: [1, 1, ofNumber(x => (x < 0 ? -1 : 1))],
  MIN: [1, 15, extreme(Math.min)],
  MAX: [1, 15, extreme(Math.max)],
  DX: [1, 1, ofLocation(t => t.p_mm[0])],
  DY: [1, 1, ofLocation(t => t.p_mm[1])],
  DZ: [1, 1, ofLocation(t => t.p_mm[2])],
  DISTANCE: [
    2,
    2,
    ([a, b], memory) => {
      const p = transform(a!, memory).p_mm;
      const q = transform(b!, memory).p_mm;
      return real(Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
    },
  ],
  SIG: [
    1,
    15,
    (args, memory) =>
      truth(
        args.every(arg => {
          const plain = arg.kind === "unary" && arg.sign === "-" ? arg.of : arg;
          if (plain.kind === "variable" && memory.isMissing(keyOf(plain, memory)))
            return memory.named(plain.name) === (plain === arg);
          const signal = Math.trunc(number(arg, memory));
          return memory.signal(Math.abs(signal), signalName(arg)) === signal > 0;
        }),
      ),
  ],
  INVERSE: [1, 1, ([a], memory) => inverted(transform(a!, memory))],
  RX: [1, 1, ([angle], memory) => about("x", number(angle!, memory))],
  RY: [1, 1, ([angle], memory) => about("y", number(angle!, memory))],
  RZ: [1, 1, ([angle], memory) => about("z", number(angle!, memory))],
  FRAME: [
    4,
    4,
    ([o, x, xy, at], memory, call) => {
      const frame = frameOf(
        transform(o!, memory),
        transform(x!, memory),
        transform(xy!, memory),
        transform(at!, memory),
      );
      if (frame === undefined)
        throw new TextError(call, "three points that are not on a line", "The three points of FRAME lie on one line.");
      return frame;
    },
  ],
  NULL: [0, 0, () => NULL_TRANSFORM],
  HERE: [0, 0, (_, memory, at) => memory.here(at)],
  DEST: [0, 0, (_, memory, at) => memory.here(at)],
};

function call(expression: Call, memory: Memory): Value {
  const { name, args } = expression;
  const component = (i: number): number => (args[i] === undefined ? 0 : number(args[i], memory));
  if (name === "TRANS") {
    count(expression, 0, 6);
    return fromTrans(component(0), component(1), component(2), component(3), component(4), component(5));
  }
  if (name === "#PPOINT") {
    count(expression, 0, memory.joints);
    return { kind: "precision", joints_deg: Array.from({ length: memory.joints }, (_, i) => component(i)) };
  }
  if (name === "SHIFT") {
    count(expression, 1, 4);
    const from = args[0];
    if (from === undefined) throw new TextError(expression, "a transformation", "SHIFT has nothing to shift.");
    return shifted(transform(from, memory), component(1), component(2), component(3));
  }
  const known = FUNCTIONS[name];
  if (known === undefined)
    throw new TextError(expression, "a function of V+", `"${name}" is no function that is understood here.`);
  const [least, most, run] = known;
  count(expression, least, most);
  const given = args.filter(arg => arg !== undefined);
  if (given.length < args.length) throw new TextError(expression, "every argument", `${name} takes no empty argument.`);
  return run(given, memory, expression);
}

function count({ name, args, line, column }: Call, least: number, most: number): void {
  if (args.length >= least && args.length <= most) return;
  const wanted = least === most ? `${most}` : `${least} to ${most}`;
  throw new TextError(
    { line, column },
    `${wanted} argument${most === 1 ? "" : "s"}`,
    `${name} takes ${wanted} argument${most === 1 ? "" : "s"}; ${args.length} are given.`,
  );
}

function finite(value: number, at: Expression): number {
  if (!Number.isFinite(value)) throw new TextError(at, "a finite result", "The result is not a number.");
  return value;
}
