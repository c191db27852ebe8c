import type { TextPlace } from "@twincell/core";
import { TextError } from "./faults.ts";
import { plainText } from "./lines.ts";
import { lineTokens, type Token, type TokenRules } from "./tokens.ts";

/** What a language makes of one line. */
export interface LineRules<Kind extends string> {
  readonly tokens: TokenRules<Kind>;
  /** Longer than any line of the language; it also bounds how deep an expression can be. */
  readonly longest: number;
  /** What the language calls a line: "statement", "instruction". */
  readonly called: string;
}

const TYPOGRAPHIC = /[^ -~]/;

/** Walks over the tokens of one line. Words compare without regard to case. */
export class LineCursor<Kind extends string> {
  private readonly tokens: readonly Token<Kind>[];
  private readonly upper: readonly string[];
  private readonly end: TextPlace;
  private readonly called: string;
  private at = 0;

  /**
   * @throws {TextError} at a character that has no meaning in the language, or when the line is too long for anybody.
   */
  constructor(text: string, line: number, { tokens, longest, called }: LineRules<Kind>) {
    if (text.length > longest)
      throw new TextError(
        { line, column: longest + 1 },
        `a line of at most ${longest} characters`,
        `Line ${line} has ${text.length} characters.`,
      );
    this.tokens = lineTokens(TYPOGRAPHIC.test(text) ? plainText(text) : text, line, tokens);
    this.upper = this.tokens.map(token => token.text.toUpperCase());
    this.end = { line, column: text.length + 1 };
    this.called = called;
  }

  get here(): TextPlace {
    return this.tokens[this.at] ?? this.end;
  }
  get done(): boolean {
    return this.at >= this.tokens.length;
  }
  /** The next token in upper case, or "" at the end. */
  get next(): string {
    return this.upper[this.at] ?? "";
  }
  get nextKind(): Kind | "end" {
    return this.tokens[this.at]?.kind ?? "end";
  }
  /** The token after the next, in upper case. */
  get second(): string {
    return this.upper[this.at + 1] ?? "";
  }
  get secondKind(): Kind | "end" {
    return this.tokens[this.at + 1]?.kind ?? "end";
  }

  /** The next token as it stands. */
  take(): string {
    const token = this.tokens[this.at];
    if (token === undefined) throw this.unexpected(`more of the ${this.called}`);
    this.at++;
    return token.text;
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
    if (!this.done) throw this.unexpected(`the end of the ${this.called}`);
  }

  skip(): void {
    this.at = this.tokens.length;
  }

  unexpected(expected: string): TextError {
    const token = this.tokens[this.at];
    return new TextError(
      this.here,
      expected,
      token === undefined
        ? `The line ends where ${expected} is expected.`
        : `"${token.text}" stands where ${expected} is expected.`,
    );
  }
}
