import type { TextPlace } from "@twincell/core";
import { TextError, lineTokens, plainText, type Token, type TokenRules } from "../../text/index.ts";

type Kind = "word" | "enum" | "number" | "bits" | "text" | "sign";
const RULES: TokenRules<Kind> = [
  // Most frequent first.
  ["word", /[A-Za-z_$][A-Za-z0-9_$]*/y],
  [null, / +/y],
  ["number", /(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[Ee][+-]?[0-9]+)?/y],
  ["sign", /==|<>|<=|>=|[-+*/=<>()[\]{},:.]/y],
  [null, /;.*/y],
  ["enum", /#[A-Za-z_$][A-Za-z0-9_$]*/y],
  ["bits", /'[BbHh][0-9A-Fa-f]+'/y],
  ["text", /"[^"]*"/y],
];

/** Longer than any line of code; comments of inline forms may be longer. It also bounds how deep an expression can be. */
const LINE_LENGTH = 4096;

const TYPOGRAPHIC = /[^ -~]/;

/** Walks over the tokens of one line. Words compare without regard to case. */
export class Cursor {
  private readonly tokens: readonly Token<Kind>[];
  private readonly upper: readonly string[];
  private readonly end: TextPlace;
  private at = 0;

  /** @throws {TextError} at a character that has no meaning in KRL, or when the line is too long for anybody. */
  constructor(text: string, line: number) {
    if (text.length > LINE_LENGTH) throw new TextError({ line, column: LINE_LENGTH + 1 }, `a line of at most ${LINE_LENGTH} characters`, `Line ${line} has ${text.length} characters.`);
    this.tokens = lineTokens(TYPOGRAPHIC.test(text) ? plainText(text) : text, line, RULES);
    this.upper = this.tokens.map(token => token.text.toUpperCase());
    this.end = { line, column: text.length + 1 };
  }

  get here(): TextPlace { return this.tokens[this.at] ?? this.end; }
  get done(): boolean { return this.at >= this.tokens.length; }
  /** The next token in upper case, or "" at the end. */
  get next(): string { return this.upper[this.at] ?? ""; }
  get nextKind(): Kind | "end" { return this.tokens[this.at]?.kind ?? "end"; }
  /** The token after the next, in upper case. */
  get second(): string { return this.upper[this.at + 1] ?? ""; }
  get secondKind(): Kind | "end" { return this.tokens[this.at + 1]?.kind ?? "end"; }

  /** The next token as it stands. */
  take(): string {
    const token = this.tokens[this.at];
    if (token === undefined) throw this.unexpected("more of the statement");
    this.at++;
    return token.text;
  }

  /** A name in upper case, as KRL compares them. */
  name(what = "a name"): string {
    if (this.nextKind !== "word") throw this.unexpected(what);
    return this.take().toUpperCase();
  }

  /** Goes past the token when it is that one. */
  accept(text: string): boolean {
    if (this.next !== text) return false;
    this.at++;
    return true;
  }

  expect(text: string): void {
    if (!this.accept(text)) throw this.unexpected(`"${text}"`);
  }

  expectEnd(): void {
    if (!this.done) throw this.unexpected("the end of the statement");
  }

  skip(): void { this.at = this.tokens.length; }

  unexpected(expected: string): TextError {
    const token = this.tokens[this.at];
    return new TextError(this.here, expected, token === undefined
      ? `The line ends where ${expected} is expected.`
      : `"${token.text}" stands where ${expected} is expected.`);
  }
}
