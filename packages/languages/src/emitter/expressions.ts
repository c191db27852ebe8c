import {
  initialOf,
  linesOf,
  typeOf,
  type BinaryOperator,
  type Expression,
  type ExpressionScope,
  type FunctionName,
  type Program,
  type Step,
  type Unit,
  type Variable,
} from "@twincell/core";
import { UnsupportedStep, called } from "./cannot.ts";

/** How a language writes what a program computes. */
export interface ExpressionWords {
  readonly truth: readonly [no: string, yes: string];
  readonly number: (value: number) => string;
  readonly variable: (name: string) => string;
  /** A variable asked whether it is yes, where it is kept as a number. */
  readonly truthVariable?: (name: string) => string;
  /** A line read as yes or no, or as a level. */
  readonly line: (signal: string, step: Step, isDigital: boolean) => string;
  readonly not: (inner: string) => string;
  /** Signs of operators; a function where more than a sign is written. Missing ones are refused. */
  readonly signs: Partial<Record<BinaryOperator, string | ((a: string, b: string) => string)>>;
  readonly calls: Partial<Record<FunctionName, (...parts: string[]) => string>>;
  /** Brackets that group. */
  readonly brackets?: readonly [open: string, close: string];
  /** Quantities in the controller's own units: 1000 where lengths are in mm. */
  readonly scale: Partial<Record<Unit, number>>;
  /** A number that must not be taken for a whole one. */
  readonly real?: (text: string) => string;
  /** Whether yes and no are compared like numbers: `a = b`. */
  readonly comparesTruth?: boolean;
}

/** Most controllers count in mm and degrees. */
export const PENDANT_UNITS: ExpressionWords["scale"] = {
  m: 1000,
  rad: 180 / Math.PI,
  "m/s": 1000,
  "rad/s": 180 / Math.PI,
};

/** The signs of a BASIC. */
export const BASIC_SIGNS: ExpressionWords["signs"] = {
  and: " AND ",
  or: " OR ",
  "=": "=",
  "<>": "<>",
  "<": "<",
  "<=": "<=",
  ">": ">",
  ">=": ">=",
  "+": "+",
  "-": "-",
  "*": "*",
  "/": "/",
  div: " DIV ",
  mod: " MOD ",
};

/** The first value of a variable as its declaration says it. */
export function initialText(variable: Variable, words: ExpressionWords): string {
  const value = initialOf(variable);
  return typeof value === "boolean" ? words.truth[value ? 1 : 0] : quantity(value, unitOf(variable), words);
}

const unitOf = (variable: Variable): Unit | undefined => (variable.type === "num" ? variable.unit : undefined);

function quantity(value: number, unit: Unit | undefined, words: ExpressionWords): string {
  const scaled = unit === undefined ? value : value * (words.scale[unit] ?? 1);
  return words.number(Number(scaled.toPrecision(12)));
}

/**
 * An expression in the words of a language. What is inside another operation stands in brackets, so that no two
 * controllers read it differently.
 *
 * @throws {UnsupportedStep} for what the language has no word for.
 */
export const expressionText = (expression: Expression, words: ExpressionWords, program: Program, step: Step): string =>
  new Writing(words, program, step).text(expression, false);

class Writing {
  private readonly words: ExpressionWords;
  private readonly program: Program;
  private readonly step: Step;

  constructor(words: ExpressionWords, program: Program, step: Step) {
    this.words = words;
    this.program = program;
    this.step = step;
  }

  text(expression: Expression, isInside: boolean): string {
    const { words, step } = this;
    if (typeof expression === "boolean") return words.truth[expression ? 1 : 0];
    if (typeof expression === "number") return this.signed(words.number(expression), isInside);
    if ("value" in expression) return this.signed(quantity(expression.value, expression.unit, words), isInside);
    if ("variable" in expression) {
      const isTruth = this.program.variables?.[expression.variable]?.type === "bool";
      if (!isTruth || words.truthVariable === undefined) return words.variable(expression.variable);
      const text = words.truthVariable(expression.variable);
      return isInside ? this.grouped(text) : text;
    }
    if ("signal" in expression) {
      const kind = this.program.signals[expression.signal]?.kind;
      if (kind === undefined)
        throw new UnsupportedStep(
          step.id,
          `${called(step)} reads the line ${expression.signal}, which is not in the list of signals.`,
          "Add it to the list.",
        );
      const text = words.line(expression.signal, step, kind.startsWith("digital"));
      // A line that is compared is no atom.
      return isInside && /[=<>]/.test(text) ? this.grouped(text) : text;
    }
    if ("call" in expression) return this.call(expression);
    return this.operation(expression, isInside);
  }

  private signed(text: string, isInside: boolean): string {
    return isInside && text.startsWith("-") ? this.grouped(text) : text;
  }

  private grouped(text: string): string {
    const [open, close] = this.words.brackets ?? ["(", ")"];
    return `${open}${text}${close}`;
  }

  private missing(what: string): never {
    throw new UnsupportedStep(
      this.step.id,
      `${called(this.step)} computes with “${what}”, for which the language has no word.`,
      "Compute it in another way.",
    );
  }

  private call({ call, of }: Extract<Expression, { readonly call: unknown }>): string {
    const written = this.words.calls[call];
    return written === undefined ? this.missing(call) : written(...of.map(part => this.text(part, false)));
  }

  private operation(expression: Extract<Expression, { readonly op: unknown }>, isInside: boolean): string {
    const { words } = this;
    const [first] = expression.of;
    if (expression.op === "not") {
      const text = words.not(this.text(first, true));
      return isInside ? this.grouped(text) : text;
    }
    if (expression.op === "neg") return this.grouped(`0-${this.text(first, true)}`);
    const { op } = expression;
    const second = expression.of[1]!;
    if ((op === "=" || op === "<>") && words.comparesTruth !== true && this.isTruth(first))
      return this.text(sameTruth(op, first, second), isInside);
    const sign = words.signs[op];
    if (sign === undefined) return this.missing(op);
    const [a, b] = [this.text(first, true), this.text(second, true)];
    const left = op === "/" && words.real !== undefined ? words.real(a) : a;
    const text = typeof sign === "string" ? `${left}${sign}${b}` : sign(left, b);
    return isInside ? this.grouped(text) : text;
  }

  private isTruth(expression: Expression): boolean {
    return typeOf(expression, scopeOfProgram(this.program)) === "bool";
  }
}

/** `a = b` of what is yes or no, by and, or and not. */
const sameTruth = (op: "=" | "<>", a: Expression, b: Expression): Expression => {
  const not = (of: Expression): Expression => ({ op: "not", of: [of] });
  const other = op === "=" ? b : not(b);
  const opposite = op === "=" ? not(b) : b;
  return {
    op: "or",
    of: [
      { op: "and", of: [a, other] },
      { op: "and", of: [not(a), opposite] },
    ],
  };
};

/** What names mean in a lowered program: it has no parameters. */
const scopeOfProgram = (program: Program): ExpressionScope => ({
  variable: name => program.variables?.[name],
  signal: name => {
    const kind = program.signals[name]?.kind;
    return kind === undefined ? "unknown" : kind.startsWith("digital") ? "digital" : "analogue";
  },
});

/** An assignment as most languages write it. */
export const assignText = (
  step: Extract<Step, { readonly type: "assign" }>,
  sign: string,
  words: ExpressionWords,
  program: Program,
): string => `${words.variable(step.variable)}${sign}${expressionText(step.to, words, program, step)}`;

/** Lines that a step looks at in its expressions. */
export function* linesLookedAt(step: Step): Generator<string, void> {
  switch (step.type) {
    case "assign":
      yield* linesOf(step.to);
      return;
    case "if":
    case "while":
    case "wait-for":
      if ("expression" in step.when) yield* linesOf(step.when.expression);
      else yield step.when.signal;
  }
}
