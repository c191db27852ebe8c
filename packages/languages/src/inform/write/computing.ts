import { type Expression, type Program, type Step } from "@twincell/core";
import { UnsupportedStep, called } from "../../emitter/index.ts";
import type { Controller } from "./controller.ts";

type Operation = Extract<Expression, { readonly op: unknown }>;
const WORDS = { "+": "ADD", "-": "SUB", "*": "MUL", div: "DIV" } as const;
const SIGNS = ["=", "<>", "<", "<=", ">", ">="] as const;
type Sign = (typeof SIGNS)[number];
const OPPOSITE: Readonly<Record<Sign, Sign>> = { "=": "<>", "<>": "=", "<": ">=", ">=": "<", ">": "<=", "<=": ">" };

/**
 * What a program computes, in INFORM: one instruction an operation, and decisions as jumps. Variables are double
 * integers; yes is 1 and no is 0.
 */
export class Computing {
  private readonly program: Program;
  private readonly controller: Controller;
  private readonly add: (line: string, step: string) => void;
  private readonly label: () => string;
  private step: Step = { id: "", type: "stop" };
  /** Variables for what is computed on the way, from instruction to instruction. */
  private readonly spare: string[];
  private inUse = 0;

  constructor(
    program: Program,
    controller: Controller,
    spare: string[],
    label: () => string,
    add: (line: string, step: string) => void,
  ) {
    this.program = program;
    this.controller = controller;
    this.spare = spare;
    this.label = label;
    this.add = add;
  }

  assign(step: Extract<Step, { type: "assign" }>): void {
    this.begin(step);
    const { to } = step;
    const variable = this.controller.named(step.variable);
    if (typeof to === "boolean") return this.say(`SET ${variable} ${to ? 1 : 0}`);
    // The common way to count.
    const isCounting =
      typeof to === "object" &&
      "op" in to &&
      to.op === "+" &&
      to.of[1] === 1 &&
      typeof to.of[0] === "object" &&
      "variable" in to.of[0] &&
      to.of[0].variable === step.variable;
    if (isCounting) return this.say(`INC ${variable}`);
    this.say(`SET ${variable} ${this.whole(to)}`);
  }

  /** Jumps to the label unless the condition holds. */
  unless(condition: Expression, label: string, step: Step): void {
    this.begin(step);
    this.jump(condition, false, label);
  }

  private begin(step: Step): void {
    this.step = step;
    this.inUse = 0;
  }

  private say(line: string): void {
    this.add(line, this.step.id);
  }

  private cannot(what: string): never {
    throw new UnsupportedStep(
      this.step.id,
      `${called(this.step)} computes with ${what}, which is not written in INFORM.`,
      "Compute with whole numbers, or export in another language.",
    );
  }

  private jump(condition: Expression, when: boolean, label: string): void {
    if (typeof condition === "boolean") {
      if (condition === when) this.say(`JUMP ${label}`);
      return;
    }
    if (typeof condition !== "object") return this.cannot("a number as a condition");
    if ("signal" in condition) {
      const line = this.program.signals[condition.signal];
      if (line?.kind.startsWith("digital") !== true) return this.cannot(`the line ${condition.signal}`);
      const word = line.kind === "digital-in" ? "IN" : "OT";
      return this.say(`JUMP ${label} IF ${word}#(${line.address})=${when ? "ON" : "OFF"}`);
    }
    if ("variable" in condition)
      return this.say(`JUMP ${label} IF ${this.controller.named(condition.variable)}=${when ? 1 : 0}`);
    if (!("op" in condition)) return this.cannot("this function");
    this.operation(condition, when, label);
  }

  private operation(condition: Operation, when: boolean, label: string): void {
    const { op } = condition;
    const [a, b] = condition.of as readonly [Expression, Expression];
    if (op === "not") return this.jump(a, !when, label);
    if (op === "and" || op === "or") {
      // One side alone decides, or both must.
      if ((op === "and") === when) {
        const past = this.label();
        this.jump(a, !when, past);
        this.jump(b, when, label);
        return this.say(past);
      }
      this.jump(a, when, label);
      return this.jump(b, when, label);
    }
    const sign = SIGNS.find(each => each === op);
    if (sign === undefined) return this.cannot(`“${op}”`);
    if (this.isTruth(a)) return this.jump(sameTruth(sign, a, b), when, label);
    const left = this.variableOf(a);
    this.say(`JUMP ${label} IF ${left}${when ? sign : OPPOSITE[sign]}${this.whole(b)}`);
  }

  private isTruth(expression: Expression): boolean {
    if (typeof expression === "boolean") return true;
    if (typeof expression !== "object") return false;
    if ("signal" in expression) return true;
    if ("variable" in expression) return this.program.variables?.[expression.variable]?.type === "bool";
    return "op" in expression && ["and", "or", "not", ...SIGNS].includes(expression.op);
  }

  /** A whole number as it stands in an instruction. */
  private whole(expression: Expression): string {
    return typeof expression === "number" && Number.isInteger(expression) && expression >= 0
      ? String(expression)
      : this.variableOf(expression);
  }

  /** The variable that holds a whole number; instructions before it compute it. */
  private variableOf(expression: Expression): string {
    if (typeof expression === "number") {
      if (!Number.isInteger(expression)) return this.cannot("numbers that are not whole");
      const own = this.fresh();
      if (expression >= 0) this.say(`SET ${own} ${expression}`);
      else for (const line of [`SET ${own} 0`, `SUB ${own} ${-expression}`]) this.say(line);
      return own;
    }
    if (typeof expression !== "object" || "value" in expression || "signal" in expression)
      return this.cannot("numbers that are not whole");
    if ("variable" in expression) {
      const type = this.program.variables?.[expression.variable]?.type;
      return type === "int" ? this.controller.named(expression.variable) : this.cannot("numbers that are not whole");
    }
    if ("call" in expression) return this.cannot(`“${expression.call}”`);
    return this.computed(expression);
  }

  private computed(expression: Operation): string {
    const { op } = expression;
    const [a, b] = expression.of as readonly [Expression, Expression];
    if (op === "neg") return this.computed({ op: "-", of: [0, a] });
    const own = this.fresh();
    this.say(`SET ${own} ${this.whole(a)}`);
    const by = this.whole(b);
    if (op === "mod") {
      const times = this.fresh();
      for (const line of [`SET ${times} ${own}`, `DIV ${times} ${by}`, `MUL ${times} ${by}`, `SUB ${own} ${times}`])
        this.say(line);
      return own;
    }
    const word = (WORDS as Partial<Record<typeof op, string>>)[op];
    if (word === undefined) return this.cannot(`“${op}”`);
    this.say(`${word} ${own} ${by}`);
    return own;
  }

  private fresh(): string {
    const known = this.spare[this.inUse++];
    if (known !== undefined) return known;
    const made = this.controller.variable("D");
    this.spare.push(made);
    return made;
  }
}

const sameTruth = (sign: Sign, a: Expression, b: Expression): Expression => {
  const not = (of: Expression): Expression => ({ op: "not", of: [of] });
  const [other, opposite] = sign === "=" ? [b, not(b)] : [not(b), b];
  return {
    op: "or",
    of: [
      { op: "and", of: [a, other] },
      { op: "and", of: [not(a), opposite] },
    ],
  };
};
