import type { TextPlace } from "@twincell/core";
import { TextError, lineTokens, plainText, type Token, type TokenRules } from "../../text/index.ts";

type Kind = "word" | "number" | "text" | "label" | "sign";
const RULES: TokenRules<Kind> = [
  [null, / +/y],
  [null, /'.*/y],
  [null, /\/\/.*/y],
  ["text", /"[^"]*"/y],
  ["label", /\*[A-Za-z0-9_-]+/y],
  ["word", /\$?[A-Za-z_][A-Za-z0-9_#]*/y],
  ["number", /-?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)/y],
  ["sign", /<>|<=|>=|[-=<>():,+]/y],
];
/** Longer than any instruction. */
const LINE_LENGTH = 1024;

/** Walks over the tokens of one instruction. Words compare without regard to case. */
export class Cursor {
  private readonly tokens: readonly Token<Kind>[];
  private readonly text: string;
  private readonly end: TextPlace;
  private at = 0;

  /** @throws {TextError} at a character that has no meaning in INFORM, or when the line is too long for anybody. */
  constructor(text: string, line: number) {
    if (text.length > LINE_LENGTH) throw new TextError({ line, column: LINE_LENGTH + 1 }, `a line of at most ${LINE_LENGTH} characters`, `Line ${line} has ${text.length} characters.`);
    this.text = text;
    this.tokens = lineTokens(plainText(text), line, RULES);
    this.end = { line, column: text.length + 1 };
  }

  get here(): TextPlace { return this.tokens[this.at] ?? this.end; }
  get done(): boolean { return this.at >= this.tokens.length; }
  /** The next token in upper case, or "" at the end. */
  get next(): string { return this.tokens[this.at]?.text.toUpperCase() ?? ""; }
  get nextKind(): Kind | "end" { return this.tokens[this.at]?.kind ?? "end"; }
  /** The token after the next, in upper case. */
  get second(): string { return this.tokens[this.at + 1]?.text.toUpperCase() ?? ""; }

  take(): string {
    const token = this.tokens[this.at];
    if (token === undefined) throw this.unexpected("more of the instruction");
    this.at++;
    return token.text;
  }

  accept(text: string): boolean {
    if (this.next !== text) return false;
    this.at++;
    return true;
  }

  expect(text: string): void {
    if (!this.accept(text)) throw this.unexpected(`"${text}"`);
  }

  number(what = "a number"): number {
    if (this.nextKind !== "number") throw this.unexpected(what);
    return Number(this.take());
  }

  /** `TAG=number`, when it is that tag. */
  tag(name: string): number | undefined {
    if (this.next !== name || this.second !== "=") return undefined;
    this.at += 2;
    return this.number(`the number of ${name}`);
  }

  expectEnd(): void {
    if (!this.done) throw this.unexpected("the end of the instruction");
  }

  skip(): void { this.at = this.tokens.length; }

  /** What is left of the line up to the next blank, as it stands: names of jobs hold more than letters. */
  name(what: string): string {
    const from = this.here.column - 1, match = /^[^\s'"=,()]+/.exec(this.text.slice(from))?.[0];
    if (match === undefined) throw this.unexpected(what);
    while (!this.done && this.here.column - 1 < from + match.length) this.at++;
    return match;
  }

  unexpected(expected: string): TextError {
    const token = this.tokens[this.at];
    return new TextError(this.here, expected, token === undefined
      ? `The line ends where ${expected} is expected.`
      : `"${token.text}" stands where ${expected} is expected.`);
  }
}
