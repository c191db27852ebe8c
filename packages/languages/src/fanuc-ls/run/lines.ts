import { holds, type Condition, type SignalLine, type Signals, type TextPlace } from "@twincell/core";
import { TextError, rememberMap } from "../../parser/index.ts";
import type { Expression } from "../../parser/structured/index.ts";

const KINDS: Readonly<Record<string, SignalLine["kind"]>> = {
  di: "digital-in",
  ri: "digital-in",
  ui: "digital-in",
  si: "digital-in",
  do: "digital-out",
  ro: "digital-out",
  uo: "digital-out",
  so: "digital-out",
  ai: "analogue-in",
  gi: "analogue-in",
  ao: "analogue-out",
  go: "analogue-out",
  // Flags and markers that programs share: set from outside as lines are.
  f: "digital-in",
  m: "digital-in",
};
/** Lines that the neutral program has numbers for; others go by their names. */
const NUMBERED = new Set(["di", "do", "ai", "ao"]);

/** Whether DI[n] and its like are lines, by the word before the bracket. */
export const isLineWord = (word: string): boolean => Object.hasOwn(KINDS, word);
/** The kind of line a word of them means. */
export const kindOfLine = (word: string): SignalLine["kind"] => KINDS[word]!;

/** DI[n], RO[n] … GO[n]: their names in the neutral program, what they read, and conditions of one of them. */
export class Lines {
  private readonly table: Record<string, SignalLine>;
  private readonly signals: Signals | undefined;
  private readonly spelt: (key: string) => string;
  private readonly outputs = new Map<string, boolean | number>();

  /** @param table  lines by name; filled as they are met. */
  constructor(table: Record<string, SignalLine>, signals: Signals | undefined, spelt: (key: string) => string) {
    this.table = table;
    this.signals = signals;
    this.spelt = spelt;
  }

  /** The name of DI[3] and its like: its comment in the listing where it has one. */
  line(word: string, number: number, at: TextPlace): string {
    if (!Number.isInteger(number) || number < 1)
      throw new TextError(at, "the number of a line", `There is no line ${word.toUpperCase()}[${number}].`);
    const key = `${word}${number}`;
    const kind = kindOfLine(word);
    const numbered = NUMBERED.has(word);
    const known = numbered
      ? Object.entries(this.table).find(([, line]) => line.kind === kind && line.address === number)?.[0]
      : undefined;
    if (known !== undefined) return known;
    const wanted = numbered ? this.spelt(key) : `${word.toUpperCase()}[${number}]`;
    const name = Object.hasOwn(this.table, wanted) && numbered ? `${word.toUpperCase()}[${number}]` : wanted;
    this.table[name] ??= numbered ? { kind, address: number } : { kind };
    return name;
  }

  /** What the program wrote itself counts before what is outside. */
  read(line: string): boolean | number {
    const value = this.outputs.get(line) ?? this.signals?.read(line);
    return this.isDigital(line) ? value === true || (typeof value === "number" && value !== 0) : Number(value ?? 0);
  }
  write(line: string, value: boolean | number): void {
    this.outputs.set(line, value);
  }
  holds(when: Condition): boolean {
    return holds(when, this);
  }

  /** The condition of one line that an expression is: `DI[1]`, `!DI[1]`, `DI[1]=ON`, `AI[1]>5`; else undefined. */
  condition(expression: Expression, numberOf: (of: Expression) => number): Condition | undefined {
    if (expression.kind === "unary" && expression.sign === "!") {
      const inner = this.condition(expression.of, numberOf);
      return inner !== undefined && "is" in inner ? { signal: inner.signal, is: !inner.is } : undefined;
    }
    if (expression.kind === "index") {
      const signal = this.lineIn(expression, numberOf);
      return signal !== undefined && this.isDigital(signal) ? { signal, is: true } : undefined;
    }
    if (expression.kind !== "binary") return undefined;
    const { sign, left, right } = expression;
    const signal = this.lineIn(left, numberOf);
    if (signal === undefined || (right.kind !== "truth" && right.kind !== "number")) return undefined;
    if (right.kind === "truth")
      return sign === "=" || sign === "<>" ? { signal, is: right.value === (sign === "=") } : undefined;
    if (sign !== "<" && sign !== ">") return undefined;
    return sign === ">" ? { signal, above: right.value } : { signal, below: right.value };
  }

  private lineIn(expression: Expression, numberOf: (of: Expression) => number): string | undefined {
    return expression.kind === "index" && expression.of.kind === "variable" && isLineWord(expression.of.name)
      ? this.line(expression.of.name, numberOf(expression.indices[0]!), expression)
      : undefined;
  }
  private isDigital(line: string): boolean {
    return this.table[line]!.kind.startsWith("digital");
  }

  /** Remembers what was written; the answer brings it back. */
  remember(): () => void {
    return rememberMap(this.outputs);
  }
}
