import type { TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";

/** Longer than any statement. */
const LINE_LENGTH = 4096;
/** Larger than any length, angle or time that means something. */
const MOST = 1e9;
const BLANK = 32;
const COMMA = 44;
const SEMICOLON = 59;
const WORD = /[A-Za-z_][A-Za-z0-9_]*/y;
const NUMBER = /[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[Ee][-+]?[0-9]+)?/y;
const TEXT = /"((?:[^"]|"")*)"/y;
const COMMENT = /\{([^}]*)\}/y;

/**
 * Walks over one line. Blanks, commas and semicolons only part what stands beside them; words compare without regard to
 * case.
 */
export class Cursor {
  private readonly text: string;
  private readonly line: number;
  private at = 0;
  /** The word that was looked at last, in upper case, and where: a line asks for many words before the one it has. */
  private seenAt = -1;
  private seen = "";

  /** @throws {TextError} when the line is too long for anybody. */
  constructor(text: string, line: number) {
    if (text.length > LINE_LENGTH)
      throw new TextError(
        { line, column: LINE_LENGTH + 1 },
        `a line of at most ${LINE_LENGTH} characters`,
        `Line ${line} has ${text.length} characters.`,
      );
    this.text = text;
    this.line = line;
    this.skipBlanks();
  }

  get here(): TextPlace {
    return { line: this.line, column: this.at + 1 };
  }
  get done(): boolean {
    return this.at >= this.text.length;
  }
  /** Whether a number stands here. */
  get atNumber(): boolean {
    return this.peek(NUMBER) !== undefined;
  }
  get atComment(): boolean {
    return this.text[this.at] === "{";
  }
  /** The word that stands here in upper case, or "". */
  get word(): string {
    if (this.seenAt !== this.at) {
      this.seenAt = this.at;
      this.seen = this.done ? "" : (this.peek(WORD)?.toUpperCase() ?? "");
    }
    return this.seen;
  }

  /** Goes past the word when it is that one. */
  accept(word: string): boolean {
    if (this.word !== word) return false;
    this.pass(word.length);
    return true;
  }

  expect(word: string): void {
    if (!this.accept(word)) throw this.unexpected(word);
  }

  /** The one of these words that stands here. */
  oneOf<W extends string>(words: readonly W[]): W {
    const { word } = this;
    const found = words.find(each => each === word);
    if (found === undefined) throw this.unexpected(words.join(" or "));
    this.pass(found.length);
    return found;
  }

  number(what: string, nth = 1, count = 1): number {
    const { at } = this;
    const text = this.match(NUMBER);
    if (text === undefined) throw this.unexpected(count === 1 ? what : `${what} ${nth} of ${count}`);
    const value = Number(text);
    if (!(Math.abs(value) <= MOST))
      throw new TextError(
        { line: this.line, column: at + 1 },
        `${what} of at most ${MOST}`,
        `The number ${text} is larger than anything a robot reaches.`,
      );
    return value;
  }

  numbers(count: number, what: string): number[] {
    const values: number[] = [];
    for (let i = 1; i <= count; i++) values.push(this.number(what, i, count));
    return values;
  }

  /** A bare word, or a text in quotes in which a doubled quote stands for one. */
  name(what: string): string {
    const name = this.match(WORD) ?? this.quoted();
    if (name === undefined) throw this.unexpected(what);
    return name;
  }

  /** What stands between braces. */
  comment(): string {
    const text = this.peek(COMMENT);
    if (text === undefined)
      throw new TextError(this.here, "a } at the end of the comment", "The comment is not closed in its line.");
    this.match(COMMENT);
    return text.slice(1, -1).trim();
  }

  percent(): boolean {
    if (this.text[this.at] !== "%") return false;
    this.pass(1);
    return true;
  }

  expectEnd(): void {
    if (!this.done) throw this.unexpected("the end of the line");
  }

  unexpected(expected: string): TextError {
    const rest = this.text.slice(this.at);
    const next = /^(?:[A-Za-z0-9_.+-]+|"[^"]*"?|[^])/u.exec(rest)?.[0];
    return new TextError(
      this.here,
      expected,
      next === undefined
        ? `The line ends where ${expected} is expected.`
        : `${next.startsWith('"') ? next : `"${next}"`} stands where ${expected} is expected.`,
    );
  }

  private quoted(): string | undefined {
    return this.match(TEXT)?.slice(1, -1).replaceAll('""', '"');
  }

  private peek(pattern: RegExp): string | undefined {
    pattern.lastIndex = this.at;
    return pattern.exec(this.text)?.[0];
  }

  private match(pattern: RegExp): string | undefined {
    const found = this.peek(pattern);
    if (found === undefined) return undefined;
    this.pass(found.length);
    return found;
  }

  private pass(length: number): void {
    this.at += length;
    this.skipBlanks();
  }

  private skipBlanks(): void {
    for (
      let code = this.text.charCodeAt(this.at);
      code === BLANK || code === COMMA || code === SEMICOLON;
      code = this.text.charCodeAt(this.at)
    )
      this.at++;
  }
}
