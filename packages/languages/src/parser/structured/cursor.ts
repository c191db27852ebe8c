import type { TextPlace } from "@twincell/core";
import { TextError } from "../faults.ts";
import { Scanner, type Comment, type Lexicon, type TokenKind } from "./scanner.ts";

/**
 * Walks over the tokens of a text. `fold` gives words the form in which the language compares them. Going on allocates
 * nothing.
 */
export class TokenCursor {
  /** The next token: its sort, as it is written, and as the language compares it ("" at the end and for a text). */
  kind: TokenKind = "line-end";
  raw = "";
  next = "";
  private line = 1;
  private column = 1;
  private readonly scanner: Scanner;
  private readonly fold: (word: string) => string;
  private isAhead = false;

  constructor(text: string, lexicon: Lexicon, fold: (word: string) => string) {
    this.scanner = new Scanner(text, lexicon);
    this.fold = fold;
  }

  /** Where the next token stands. */
  get here(): TextPlace {
    return { line: this.line, column: this.column };
  }
  get done(): boolean {
    return this.kind === "end";
  }
  isAt(kind: TokenKind): boolean {
    return this.kind === kind;
  }

  /** The token after the next. */
  get second(): string {
    if (!this.isAhead) this.scanner.next();
    this.isAhead = true;
    return this.folded();
  }

  /** Takes the first comment in the lines before the next token. */
  comment(): Comment | undefined {
    return this.scanner.commentBefore(this.line);
  }

  /** Goes on by one token. @throws {TextError} at a character without a meaning. */
  advance(): void {
    const { scanner } = this;
    if (!this.isAhead) scanner.next();
    this.isAhead = false;
    this.kind = scanner.kind;
    this.raw = scanner.raw;
    this.line = scanner.tokenLine;
    this.column = scanner.tokenColumn;
    this.next = this.folded();
  }

  private folded(): string {
    const { kind, raw } = this.scanner;
    return kind === "word" ? this.fold(raw) : kind === "text" ? "" : raw;
  }

  /** The next token, which is left behind. */
  take(): string {
    const { next } = this;
    this.advance();
    return next;
  }

  accept(text: string): boolean {
    if (this.next !== text || this.kind === "end" || this.kind === "text") return false;
    this.advance();
    return true;
  }

  expect(text: string): void {
    if (!this.accept(text)) throw this.unexpected(`"${text}"`);
  }

  /** A name, which is left behind. */
  name(expected: string): string {
    if (this.kind !== "word") throw this.unexpected(expected);
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
    const { kind, raw } = this;
    const what = kind === "end" ? "The text ends" : kind === "line-end" ? "The line ends" : `"${raw}" stands`;
    return new TextError(this.here, expected, `${what} where ${expected} is expected.`);
  }
}
