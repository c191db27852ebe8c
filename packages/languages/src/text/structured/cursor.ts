import type { TextPlace } from "@twincell/core";
import { TextError } from "../faults.ts";
import { Scanner, type Comment, type Lexicon, type TextToken, type TokenKind } from "./scanner.ts";

/** Walks over the tokens of a text. `fold` gives words the form in which the language compares them. */
export class TokenCursor {
  private readonly scanner: Scanner;
  private readonly fold: (word: string) => string;
  private current: TextToken = { kind: "line-end", text: "", line: 1, column: 1 };
  private ahead: TextToken | undefined;
  private word = "";

  constructor(text: string, lexicon: Lexicon, fold: (word: string) => string) {
    this.scanner = new Scanner(text, lexicon);
    this.fold = fold;
  }

  /** Where the next token stands. */
  get here(): TextPlace { return { line: this.current.line, column: this.current.column }; }
  get kind(): TokenKind { return this.current.kind; }
  /** The next token as the language compares it; "" at the end and for a text. */
  get next(): string { return this.word; }
  /** The next token as it is written. */
  get raw(): string { return this.current.text; }
  get done(): boolean { return this.current.kind === "end"; }

  isAt(kind: TokenKind): boolean { return this.current.kind === kind; }

  /** The token after the next. */
  get second(): string {
    this.ahead ??= this.scanner.next();
    return this.ahead.kind === "word" ? this.fold(this.ahead.text) : this.ahead.kind === "text" ? "" : this.ahead.text;
  }

  /** Takes the first comment in the lines before the next token. */
  comment(): Comment | undefined { return this.scanner.commentBefore(this.current.line); }

  /** Goes on by one token. @throws {TextError} at a character without a meaning. */
  advance(): void {
    const token = this.ahead ?? this.scanner.next();
    this.ahead = undefined;
    this.current = token;
    this.word = token.kind === "word" ? this.fold(token.text) : token.kind === "text" ? "" : token.text;
  }

  /** The next token, which is left behind. */
  take(): string {
    const { word } = this;
    this.advance();
    return word;
  }

  accept(text: string): boolean {
    if (this.word !== text || this.current.kind === "end" || this.current.kind === "text") return false;
    this.advance();
    return true;
  }

  expect(text: string): void {
    if (!this.accept(text)) throw this.unexpected(`"${text}"`);
  }

  /** A name, which is left behind. */
  name(expected: string): string {
    if (this.current.kind !== "word") throw this.unexpected(expected);
    return this.take();
  }

  /** Leaves tokens behind until `isEnd` says so, faults among them too. */
  skip(isEnd: (cursor: TokenCursor) => boolean): void {
    this.scanner.recover();
    while (!this.done && !isEnd(this)) {
      try {
        this.advance();
      } catch (cause) {
        if (!(cause instanceof TextError)) throw cause;
      }
    }
  }

  unexpected(expected: string): TextError {
    const { kind, text } = this.current;
    const what = kind === "end" ? "The text ends" : kind === "line-end" ? "The line ends" : `"${text}" stands`;
    return new TextError(this.here, expected, `${what} where ${expected} is expected.`);
  }
}
