import { holds, type Condition, type SignalLine, type Signals } from "@twincell/core";
import { rememberMap } from "../../parser/index.ts";
import type { Expression } from "../../parser/structured/index.ts";
import type { Value } from "./values.ts";

/** Functions that read a line, with the kind of line each reads. */
export const KIND_OF_FUNCTION: Readonly<Record<string, SignalLine["kind"]>> = {
  testdi: "digital-in",
  dinput: "digital-in",
  doutput: "digital-out",
  ainput: "analogue-in",
  aoutput: "analogue-out",
};
/** Instructions that wait for a line, with the kind of line each waits for. */
export const KIND_OF_WAIT: Readonly<Record<string, SignalLine["kind"]>> = {
  waitdi: "digital-in",
  waitdo: "digital-out",
  waitai: "analogue-in",
  waitao: "analogue-out",
};

/**
 * The lines of the controller. They are names of its configuration, so a program only shows by its use what they are.
 */
export class Lines {
  private readonly table: Record<string, SignalLine>;
  private readonly signals: Signals | undefined;
  private readonly spelt: (name: string) => string;
  private readonly isFree: (name: string) => boolean;
  private readonly outputs = new Map<string, boolean | number>();

  /**
   * @param table   lines by name; filled as they are met.
   * @param isFree  whether a name is that of no datum.
   */
  constructor(
    table: Record<string, SignalLine>,
    signals: Signals | undefined,
    spelt: (name: string) => string,
    isFree: (name: string) => boolean,
  ) {
    this.table = table;
    this.signals = signals;
    this.spelt = spelt;
    this.isFree = isFree;
  }

  /** The line of that name, which is of that kind from its first use on. */
  line(name: string, kind: SignalLine["kind"]): string {
    const spelt = this.spelt(name);
    this.table[spelt] ??= { kind };
    return spelt;
  }

  /** What a name is worth that is a line which was spoken of before; undefined for any other. */
  level(name: string): Value | undefined {
    const spelt = this.spelt(name);
    return Object.hasOwn(this.table, spelt) ? Number(this.read(spelt)) : undefined;
  }

  /** What is said of a name from outside, if anything. */
  given(name: string): boolean | number | undefined {
    return this.signals?.read(name);
  }

  /** What the program wrote itself counts before what is outside. */
  read(line: string): boolean | number {
    const value = this.outputs.get(line) ?? this.signals?.read(line);
    if (!this.table[line]!.kind.startsWith("digital")) return Number(value ?? 0);
    return value === true || (typeof value === "number" && value !== 0);
  }

  write(line: string, value: boolean | number): void {
    this.outputs.set(line, value);
  }
  holds(when: Condition): boolean {
    return holds(when, this);
  }

  /** The condition of one line that an expression is: `di1=1`, `NOT TestDI(di1)`, `AInput(ai1)>5`. */
  condition(expression: Expression, evaluate: (of: Expression) => Value): Condition | undefined {
    if (expression.kind === "unary" && expression.sign === "not") {
      const inner = this.condition(expression.of, evaluate);
      return inner !== undefined && "is" in inner ? { signal: inner.signal, is: !inner.is } : undefined;
    }
    if (expression.kind === "call" && expression.name === "testdi") {
      const signal = this.lineOf(expression);
      return signal === undefined ? undefined : { signal, is: true };
    }
    return this.comparison(expression, evaluate);
  }

  /** A line that is compared with a number. */
  private comparison(expression: Expression, evaluate: (of: Expression) => Value): Condition | undefined {
    if (expression.kind !== "binary" || !["=", "<>", "<", ">"].includes(expression.sign)) return undefined;
    const { sign, left, right } = expression;
    // A bare name is a line when it is nothing else and is compared with a number.
    if (
      left.kind === "variable" &&
      (!this.isFree(left.name) || (right.kind !== "number" && (right.kind !== "variable" || this.isFree(right.name))))
    )
      return undefined;
    const signal = this.lineOf(left);
    const value = right.kind === "number" || right.kind === "variable" ? evaluate(right) : undefined;
    if (signal === undefined || typeof value !== "number") return undefined;
    if (sign === ">" || sign === "<") return sign === ">" ? { signal, above: value } : { signal, below: value };
    return value === 0 || value === 1 ? { signal, is: (value === 1) === (sign === "=") } : undefined;
  }

  private lineOf(expression: Expression): string | undefined {
    if (expression.kind === "variable") return this.line(expression.name, "digital-in");
    if (expression.kind !== "call" || !Object.hasOwn(KIND_OF_FUNCTION, expression.name)) return undefined;
    const name = expression.args[0]?.value;
    return name?.kind === "variable" ? this.line(name.name, KIND_OF_FUNCTION[expression.name]!) : undefined;
  }

  /** Remembers what was written; the answer brings it back. */
  remember(): () => void {
    return rememberMap(this.outputs);
  }
}
