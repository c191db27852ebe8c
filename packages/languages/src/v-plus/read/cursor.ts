import { LineCursor, type LineRules } from "../../parser/index.ts";

type Kind = "word" | "number" | "text" | "sign";
const RULES: LineRules<Kind> = {
  longest: 1024,
  called: "statement",
  tokens: [
    [null, / +/y],
    [null, /;.*/y],
    ["word", /[$#]?[A-Za-z][A-Za-z0-9_.]*/y],
    ["number", /(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[Ee][+-]?[0-9]+)?/y],
    ["text", /"[^"]*"/y],
    ["sign", /==|<>|<=|>=|\*\*|[-+*/=<>()[\],:]/y],
  ],
};

/** Walks over the tokens of one line. */
export class Cursor extends LineCursor<Kind> {
  constructor(text: string, line: number) {
    super(text, line, RULES);
  }
}
