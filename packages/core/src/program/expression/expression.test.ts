import { describe, expect, test } from "vitest";
import { seededRandom, type Random } from "../../random.ts";
import { emptyProgram } from "../program.ts";
import { parseProgram } from "../parse.ts";
import { evaluate } from "./evaluate.ts";
import { FUNCTIONS, type Expression, type Value, type ValueType } from "./expression.ts";
import { parseExpression } from "./parse.ts";
import { printExpression } from "./print.ts";
import { checkType, type ExpressionScope } from "./typing.ts";

const VARIABLES: Readonly<Record<string, ValueType>> = {
  count: { type: "int" },
  ready: { type: "bool" },
  height: { type: "num", unit: "m" },
  turn: { type: "num", unit: "rad" },
  share: { type: "num" },
};
const scope: ExpressionScope = {
  variable: name => VARIABLES[name],
  signal: name =>
    name === "part_there" || name === "box 2" ? "digital" : name === "pressure" ? "analogue" : undefined,
};
const NUM: ValueType = { type: "num" };
const typed = (text: string, wanted: ValueType): Expression => {
  const answer = parseExpression(text, wanted, scope);
  if (answer.kind === "fault") throw new Error(`${answer.at}+${answer.length}: ${answer.sentence}`);
  return answer.expression;
};
const worth = (text: string, wanted: ValueType, values: Readonly<Record<string, Value>> = {}): unknown => {
  const answer = evaluate(typed(text, wanted), { variable: name => values[name], signal: name => values[name] });
  return answer.kind === "value" ? answer.value : answer;
};

describe("expressions as text", () => {
  test("what a person types becomes the tree that the program keeps", () => {
    expect(typed("count + 1 < 9 and not part_there", { type: "bool" })).toEqual({
      op: "and",
      of: [
        { op: "<", of: [{ op: "+", of: [{ variable: "count" }, 1] }, 9] },
        { op: "not", of: [{ signal: "part_there" }] },
      ],
    });
    expect(typed('"box 2" or ready', { type: "bool" })).toEqual({
      op: "or",
      of: [{ signal: "box 2" }, { variable: "ready" }],
    });
    expect(typed("3 * 40 mm", { type: "num", unit: "m" })).toEqual({ op: "*", of: [3, { value: 0.04, unit: "m" }] });
  });

  test("products come before sums, sums before comparisons, and sides are read from the left", () => {
    expect(worth("2 + 3 * 4 - 1", NUM)).toBe(13);
    expect(worth("10 - 4 - 3", NUM)).toBe(3);
    expect(worth("-2 * -3", NUM)).toBe(6);
    expect(worth("not false and false", { type: "bool" })).toBe(false);
    expect(worth("7 div 2 + 7 mod 4", { type: "int" })).toBe(6);
    expect(worth("-7 div 2", { type: "int" })).toBe(-3);
    expect(worth("-7 mod 4", { type: "int" })).toBe(-3);
    expect(worth("sin(30 deg)", NUM)).toBeCloseTo(0.5, 15);
    expect(worth("max(abs(-3), 2)", { type: "int" })).toBe(3);
  });

  test.each([
    ["count +", 7, 1, /a value is missing/],
    ["count < 9 and heigth > 2 mm", 14, 6, /no variable and no signal “heigth”/],
    ["height + 3", 0, 10, /one unit; here are a number in m and a whole number/],
    ["ready and count", 10, 5, /“and” joins what is yes or no; this is a whole number/],
    ["(count < 9", 10, 1, /closing bracket/],
    ["1 < count < 9", 10, 1, /join them by “and”/],
    ["sin(3) < 1", 4, 1, /takes an angle/],
    ["share = 0.5", 0, 11, /Compare other numbers by < or >/],
    ["count ! 3", 6, 1, /means nothing/],
    ["power(2) < 3", 0, 5, /no function “power”/],
    ["min(1) < 3", 0, 3, /takes two values; here are 1/],
    ["count", 0, 5, /a whole number; here yes or no is wanted/],
  ])("“%s” is refused at its characters", (text, at, length, sentence) => {
    const wanted: ValueType = text.startsWith("height") ? { type: "num", unit: "m" } : { type: "bool" };
    expect(parseExpression(text, wanted, scope)).toMatchObject({
      kind: "fault",
      at,
      length,
      sentence: expect.stringMatching(sentence),
    });
  });

  test("10,000 drawn expressions read back from their text to the very same tree", () => {
    const random = seededRandom(21);
    for (let i = 0; i < 10_000; i++) {
      const type = drawnType(random);
      const expression = drawn(random, type, 0);
      expect(checkType(expression, type, scope), printExpression(expression)).toEqual({ kind: "typed" });
      const text = printExpression(expression);
      expect(parseExpression(text, type, scope), text).toEqual({ kind: "expression", expression });
    }
  });

  test("of 10,000 expressions with one unit or kind exchanged, every one that changes it is refused", () => {
    const random = seededRandom(22);
    let refused = 0;
    for (let i = 0; i < 10_000; i++) {
      // height is a length: adding or comparing anything else to it is an error of units.
      const wrong = drawn(random, pick(random, [{ type: "int" }, { type: "num", unit: "rad" }, { type: "num" }]), 2);
      const right = drawn(random, { type: "num", unit: "m" }, 2);
      const op = pick(random, ["+", "-"] as const);
      const both: Expression = random() < 0.5 ? { op, of: [right, wrong] } : { op, of: [wrong, right] };
      if (checkType(both, { type: "num", unit: "m" }, scope).kind === "fault") refused++;
    }
    expect(refused).toBe(10_000);
  });

  test("100,000 damaged texts are answered, never thrown at", () => {
    const random = seededRandom(23);
    const signs = [
      "(",
      ")",
      "and",
      "or",
      "not",
      "<",
      "+",
      "-",
      "*",
      "count",
      "3",
      "mm",
      '"',
      ",",
      "°",
      ".",
      "\\",
      "min",
    ];
    for (let i = 0; i < 100_000; i++) {
      const text = Array.from({ length: 1 + Math.floor(random() * 12) }, () => pick(random, signs)).join(
        random() < 0.5 ? " " : "",
      );
      const answer = parseExpression(text, { type: "bool" }, scope);
      if (answer.kind === "fault") {
        expect(answer.at).toBeGreaterThanOrEqual(0);
        expect(answer.at).toBeLessThanOrEqual(text.length);
        expect(answer.sentence).not.toBe("");
      }
    }
    const deep = `${"(".repeat(900)}1${")".repeat(900)} < 2`;
    expect(parseExpression(deep, { type: "bool" }, scope)).toMatchObject({ kind: "fault" });
    expect(parseExpression(`${"not ".repeat(400)}ready`, { type: "bool" }, scope)).toMatchObject({ kind: "fault" });
  });
});

describe("what an expression is worth", () => {
  test("it always answers: divisions by zero, roots and whole numbers beyond 2³¹ are failures with a sentence", () => {
    expect(worth("1 / 0 < 2", { type: "bool" })).toMatchObject({ kind: "failed" });
    expect(worth("count mod 0 < 2", { type: "bool" }, { count: 1 })).toMatchObject({ kind: "failed" });
    expect(worth("sqrt(0 - 1)", NUM)).toMatchObject({ kind: "failed" });
    expect(worth("count * count", { type: "int" }, { count: 100_000 })).toMatchObject({
      kind: "failed",
      sentence: "A whole number went beyond ±2147483647.",
    });
  });

  test("what is not known stays unknown, unless the rest decides", () => {
    expect(worth("part_there and ready", { type: "bool" }, { ready: true })).toEqual({ kind: "unknown" });
    expect(worth("part_there and ready", { type: "bool" }, { ready: false })).toBe(false);
    expect(worth("part_there or ready", { type: "bool" }, { ready: true })).toBe(true);
  });
});

test("an expression in a file is read with the place of what is wrong", () => {
  const program = {
    ...emptyProgram("staubli_rx90l"),
    version: 2,
    variables: { count: { type: "int", initial: 3 } },
    steps: [
      { id: "a", type: "assign", variable: "count", to: { op: "+", of: [{ variable: "cuont" }, 1] } },
      { id: "w", type: "while", when: { expression: { op: "<", of: [{ variable: "count" }, true] } }, steps: [] },
    ],
  };
  const answer = parseProgram(program);
  expect(answer.kind === "not-a-program" && answer.faults).toEqual([
    {
      path: "steps[0].to.of[0]",
      sentence: "In the expression of step “a”: There is no variable “cuont” here.",
    },
    {
      path: "steps[1].when.expression.of[1]",
      sentence: "In the expression of step “w”: “<” takes numbers; this is yes or no.",
    },
  ]);
});

const pick = <T>(random: Random, list: readonly T[]): T => list[Math.floor(random() * list.length)]!;

function drawnType(random: Random): ValueType {
  return pick<ValueType>(random, [{ type: "bool" }, { type: "int" }, { type: "num" }, { type: "num", unit: "m" }]);
}

/** An expression of that very type. */
function drawn(random: Random, type: ValueType, depth: number): Expression {
  const leaf = depth > 3 || random() < 0.3;
  const inner = (of: ValueType): Expression => drawn(random, of, depth + 1);
  if (type.type === "bool") {
    if (leaf)
      return pick<Expression>(random, [
        true,
        false,
        { variable: "ready" },
        { signal: "part_there" },
        { signal: "box 2" },
      ]);
    switch (Math.floor(random() * 4)) {
      case 0:
        return { op: "not", of: [inner(type)] };
      case 1:
        return { op: pick(random, ["and", "or", "=", "<>"] as const), of: [inner(type), inner(type)] };
      default: {
        const side = pick<ValueType>(random, [{ type: "int" }, { type: "num", unit: "m" }, { type: "num" }]);
        return { op: pick(random, ["<", "<=", ">", ">="] as const), of: [inner(side), inner(side)] };
      }
    }
  }
  if (type.type === "int") {
    if (leaf) return pick<Expression>(random, [{ variable: "count" }, Math.floor(random() * 2000) - 1000]);
    if (random() < 0.2) return { call: pick(random, ["abs"] as const), of: [inner(type)] };
    if (random() < 0.2) return { op: "neg", of: [inner(type)] };
    return { op: pick(random, ["+", "-", "*", "div", "mod"] as const), of: [inner(type), inner(type)] };
  }
  if (leaf) {
    if (type.unit === "rad") return pick<Expression>(random, [{ variable: "turn" }, { value: random(), unit: "rad" }]);
    if (type.unit === "m")
      return pick<Expression>(random, [{ variable: "height" }, { value: random() - 0.5, unit: "m" }]);
    return pick<Expression>(random, [
      { variable: "share" },
      { signal: "pressure" },
      Math.floor(random() * 1000) / 8 + 1 / 16,
    ]);
  }
  const call = pick(random, ["min", "max", "abs"] as const);
  if (random() < 0.2) return { call, of: Array.from({ length: FUNCTIONS[call] }, () => inner(type)) };
  if (random() < 0.2) return { op: "*", of: [inner({ type: "num" }), inner(type)] };
  return { op: pick(random, ["+", "-"] as const), of: [inner(type), inner(type)] };
}
