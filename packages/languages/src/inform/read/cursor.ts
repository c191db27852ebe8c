import { LineCursor, type LineRules } from "../../parser/index.ts";

type Kind = "word" | "number" | "text" | "label" | "sign";
const RULES: LineRules<Kind> = {
  longest: 1024,
  called: "instruction",
  tokens: [
    [null, / +/y],
    [null, /'.*/y],
    [null, /\/\/.*/y],
    ["text", /"[^"]*"/y],
    ["label", /\*[A-Za-z0-9_-]+/y],
    ["word", /\$?[A-Za-z_][A-Za-z0-9_#]*/y],
    ["number", /-?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)/y],
    ["sign", /<>|<=|>=|[-=<>():,+*/[\]]/y],
  ],
};

/** Walks over the tokens of one instruction. */
export class Cursor extends LineCursor<Kind> {
  private readonly text: string;

  constructor(text: string, line: number) {
    super(text, line, RULES);
    this.text = text;
  }

  number(what = "a number"): number {
    if (this.nextKind !== "number") throw this.unexpected(what);
    return Number(this.take());
  }

  /** `TAG=number`, when it is that tag. */
  tag(name: string): number | undefined {
    if (this.next !== name || this.second !== "=") return undefined;
    this.take();
    this.take();
    return this.number(`the number of ${name}`);
  }

  /** What is left of the line, as it stands. It is then behind. */
  rest(): string {
    const text = this.done ? "" : this.text.slice(this.here.column - 1);
    this.skip();
    return text;
  }

  /** What is left of the line up to the next blank, as it stands: names of jobs hold more than letters. */
  name(what: string): string {
    const from = this.here.column - 1;
    const match = /^[^\s'"=,()]+/.exec(this.text.slice(from))?.[0];
    if (match === undefined) throw this.unexpected(what);
    while (!this.done && this.here.column - 1 < from + match.length) this.take();
    return match;
  }
}
