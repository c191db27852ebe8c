import type { TextPlace } from "@twincell/core";
import { TextError, compared, computed } from "../../parser/index.ts";
import type { Expression, Variable } from "../read/syntax.ts";
import { componentsOf, frameOf, inverted, times, type Frame } from "./frames.ts";

export interface Structure {
  readonly kind: "structure";
  readonly type: string | undefined;
  readonly fields: ReadonlyMap<string, Value>;
}
export type Value =
  | { readonly kind: "number"; readonly value: number; readonly whole: boolean }
  | { readonly kind: "bool"; readonly value: boolean }
  | { readonly kind: "text" | "enum"; readonly value: string }
  | Structure;

export const whole = (value: number): Value => ({ kind: "number", value, whole: true });
/** Reals of the controller are single precision. */
export const real = (value: number): Value => ({ kind: "number", value: Math.fround(value), whole: false });
export const bool = (value: boolean): Value => ({ kind: "bool", value });

/** Where values come from while a program runs. */
export interface Memory {
  /** @param key  name with its indices, `P[1]`. */
  read(key: string, at: TextPlace): Value | undefined;
  call(name: string, args: readonly (Expression | undefined)[], at: TextPlace): Value;
  /** Takes a name that nothing declares, where a condition stands, for an input: whether it is one now. */
  takeForInput(variable: Variable): boolean;
}

const KINDS = { number: "number", bool: "BOOL", text: "text", enum: "constant", structure: "structure" } as const;

export function evaluate(expression: Expression, memory: Memory): Value {
  switch (expression.kind) {
    case "number":
      return expression.whole ? whole(expression.value) : real(expression.value);
    case "bool":
      return bool(expression.value);
    case "text":
    case "enum":
      return { kind: expression.kind, value: expression.value };
    case "aggregate":
      return {
        kind: "structure",
        type: expression.type,
        fields: new Map(expression.fields.map(([name, value]) => [name, evaluate(value, memory)])),
      };
    case "variable":
      return readPath(expression, memory);
    case "unary":
      return unary(expression, memory);
    case "binary":
      return binary(expression, memory);
    case "call":
      return callFunction(expression, memory);
  }
}

/** The name under which the first part of a variable is kept. */
export function keyOf({ parts: [first], ...at }: Variable, memory: Memory): string {
  return indexed(first!.name, first!.indices, memory, at);
}

/** A name with its indices worked out: `BLOCK[3]`. */
export function indexed(name: string, indices: readonly Expression[], memory: Memory, at: TextPlace): string {
  if (indices.length === 0) return name;
  return `${name}[${indices
    .map(index => {
      const value = numberOf(index, memory);
      if (!Number.isInteger(value) || value < 0)
        throw new TextError(at, "an index from 1", `Index ${value} of "${name}" is no place of an array.`);
      return value;
    })
    .join(",")}]`;
}

function readPath(variable: Variable, memory: Memory): Value {
  const key = keyOf(variable, memory);
  let value = memory.read(key, variable);
  if (value === undefined)
    throw new TextError(
      variable,
      "a variable that has a value",
      `"${key}" has no value here. If it is declared in the data list, put the .dat behind the .src.`,
    );
  for (const { name, indices } of variable.parts.slice(1)) {
    if (value.kind !== "structure")
      throw new TextError(variable, "a structure", `A ${KINDS[value.kind]} has no component ${name}.`);
    const field: Value | undefined = value.fields.get(indexed(name, indices, memory, variable));
    if (field === undefined)
      throw new TextError(variable, "a component that has a value", `"${key}" has no component ${name}.`);
    value = field;
  }
  return value;
}

export function numberOf(expression: Expression, memory: Memory): number {
  const value = evaluate(expression, memory);
  if (value.kind !== "number")
    throw new TextError(expression, "a number", `A ${KINDS[value.kind]} stands where a number is expected.`);
  return value.value;
}

export function boolOf(expression: Expression, memory: Memory): boolean {
  if (expression.kind === "variable" && expression.parts.length === 1) memory.takeForInput(expression);
  const value = evaluate(expression, memory);
  if (value.kind !== "bool")
    throw new TextError(expression, "TRUE or FALSE", `A ${KINDS[value.kind]} stands where a condition is expected.`);
  return value.value;
}

export function structureOf(expression: Expression, memory: Memory): Structure {
  const value = evaluate(expression, memory);
  if (value.kind !== "structure")
    throw new TextError(expression, "a position", `A ${KINDS[value.kind]} stands where a position is expected.`);
  return value;
}

/** A component of a structure, or undefined when it is left out. */
export function component({ fields }: Structure, name: string): number | undefined {
  const value = fields.get(name);
  return value?.kind === "number" ? value.value : undefined;
}

const PARTS = ["X", "Y", "Z", "A", "B", "C"] as const;

/** The frame that a structure says; what is left out is taken from `present`. */
export function toFrame(structure: Structure, present: Frame | undefined, at: TextPlace): Frame {
  const missing = PARTS.find(part => component(structure, part) === undefined);
  if (missing !== undefined && present === undefined)
    throw new TextError(at, "a frame with X, Y, Z, A, B and C", `The frame has no component ${missing}.`);
  const kept = missing === undefined ? undefined : componentsOf(present!);
  const [x, y, z, a, b, c] = PARTS.map((part, i) => component(structure, part) ?? kept![i]!);
  return frameOf(x!, y!, z!, a!, b!, c!);
}

export function fromFrame(frame: Frame, like?: Structure): Structure {
  const fields = new Map(like?.fields ?? []);
  for (const [i, value] of componentsOf(frame).entries())
    fields.set(PARTS[i]!, { kind: "number", value, whole: false });
  return { kind: "structure", type: like?.type ?? "FRAME", fields };
}

function unary({ sign, of, ...at }: Extract<Expression, { kind: "unary" }>, memory: Memory): Value {
  if (sign === "NOT") return bool(!boolOf(of, memory));
  const value = evaluate(of, memory);
  if (value.kind !== "number")
    throw new TextError(at, "a number", `A ${KINDS[value.kind]} stands where a number is expected.`);
  return sign === "B_NOT" ? whole(~value.value) : { ...value, value: -value.value };
}

function binary(expression: Extract<Expression, { kind: "binary" }>, memory: Memory): Value {
  const { sign } = expression;
  const isTruth = expression.right.kind === "bool" && (sign === "==" || sign === "<>");
  if (sign === "AND" || sign === "OR" || sign === "EXOR") {
    const a = boolOf(expression.left, memory);
    return bool(logic(sign, a, boolOf(expression.right, memory), expression));
  }
  if (isTruth && expression.left.kind === "variable") memory.takeForInput(expression.left);
  const left = evaluate(expression.left, memory);
  const right = evaluate(expression.right, memory);
  if (sign === ":") {
    if (left.kind !== "structure" || right.kind !== "structure")
      throw new TextError(expression, "two frames", '":" joins frames.');
    // What the last one says beyond its place (Status, Turn, external axes) stays.
    return fromFrame(
      times(toFrame(left, undefined, expression.left), toFrame(right, undefined, expression.right)),
      right,
    );
  }
  if (left.kind === "bool" && right.kind === "bool") return bool(logic(sign, left.value, right.value, expression));
  if (left.kind === right.kind && (left.kind === "enum" || left.kind === "text") && (sign === "==" || sign === "<>")) {
    return bool((left.value === (right as typeof left).value) === (sign === "=="));
  }
  if (left.kind !== "number" || right.kind !== "number")
    throw new TextError(
      expression,
      "two numbers",
      `"${sign}" joins numbers, not a ${KINDS[left.kind]} and a ${KINDS[right.kind]}.`,
    );
  return joined(expression, left, right);
}

type NumberValue = Extract<Value, { kind: "number" }>;

/** Whole numbers give whole ones. */
function joined(
  expression: Extract<Expression, { kind: "binary" }>,
  { value: a, whole: isWhole }: NumberValue,
  { value: b, whole: isAlso }: NumberValue,
): Value {
  const { sign } = expression;
  switch (sign) {
    case "B_AND":
      return whole(a & b);
    case "B_OR":
      return whole(a | b);
    case "B_EXOR":
      return whole(a ^ b);
  }
  const value = compared(sign, a, b) ?? computed(sign, a, b, expression.right);
  if (value === undefined)
    throw new TextError(expression, "an operator for numbers", `"${sign}" does not join numbers.`);
  if (typeof value === "boolean") return bool(value);
  return isWhole && isAlso ? whole(Math.trunc(value)) : real(value);
}

function logic(sign: string, a: boolean, b: boolean, at: TextPlace): boolean {
  switch (sign) {
    case "AND":
      return a && b;
    case "OR":
      return a || b;
    case "EXOR":
    case "<>":
      return a !== b;
    case "==":
      return a === b;
    default:
      throw new TextError(at, "AND, OR, EXOR, == or <>", `"${sign}" does not join conditions.`);
  }
}

const DEG = 180 / Math.PI;
const FUNCTIONS: Readonly<Record<string, readonly [count: number, apply: (...x: number[]) => number]>> = {
  ABS: [1, Math.abs],
  SQRT: [1, Math.sqrt],
  SIN: [1, x => Math.sin(x / DEG)],
  COS: [1, x => Math.cos(x / DEG)],
  TAN: [1, x => Math.tan(x / DEG)],
  ACOS: [1, x => Math.acos(x) * DEG],
  ATAN2: [2, (y, x) => Math.atan2(y, x) * DEG],
};

function callFunction(call: Extract<Expression, { kind: "call" }>, memory: Memory): Value {
  const { name, args } = call;
  if (name === "INV_POS" && args.length === 1 && args[0] !== undefined)
    return fromFrame(inverted(toFrame(structureOf(args[0], memory), undefined, args[0])));
  const known = FUNCTIONS[name];
  if (known === undefined) return memory.call(name, args, call);
  const [count, apply] = known;
  if (args.length !== count || args.includes(undefined))
    throw new TextError(
      call,
      `${count} argument${count === 1 ? "" : "s"}`,
      `${name} takes ${count} argument${count === 1 ? "" : "s"}; ${args.length} are given.`,
    );
  const value = apply(...args.map(arg => numberOf(arg!, memory)));
  if (!Number.isFinite(value)) throw new TextError(call, "a finite result", "The result is not a number.");
  return real(value);
}
