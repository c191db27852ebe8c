import { LineCursor, type LineRules } from "../../parser/index.ts";

type Kind = "word" | "enum" | "number" | "bits" | "text" | "sign";
const RULES: LineRules<Kind> = {
  // Comments of inline forms are longer than any line of code.
  longest: 4096,
  called: "statement",
  tokens: [
    // Most frequent first.
    ["word", /[A-Za-z_$][A-Za-z0-9_$]*/y],
    [null, / +/y],
    ["number", /(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[Ee][+-]?[0-9]+)?/y],
    ["sign", /==|<>|<=|>=|[-+*/=<>()[\]{},:.]/y],
    [null, /;.*/y],
    ["enum", /# ?[A-Za-z_$][A-Za-z0-9_$]*/y],
    ["bits", /'[BbHh][0-9A-Fa-f]+'/y],
    ["text", /"[^"]*"/y],
  ],
};

/** Walks over the tokens of one line. */
export class Cursor extends LineCursor<Kind> {
  constructor(text: string, line: number) {
    super(text, line, RULES);
  }

  /** A name in upper case, as KRL compares them. */
  name(what = "a name"): string {
    if (this.nextKind !== "word") throw this.unexpected(what);
    return this.take().toUpperCase();
  }
}
