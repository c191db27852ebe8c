import type { TextPlace } from "@twincell/core";
import { TextError } from "../../text/index.ts";

/** Longer than any statement. */
const LINE_LENGTH = 4096;
/** Larger than any length, angle or time that means something. */
const MOST = 1e9;
const BLANK = /[ ,;]+/y, WORD = /[A-Za-z_][A-Za-z0-9_]*/y, NUMBER = /[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[Ee][-+]?[0-9]+)?/y;
const TEXT = /"((?:[^"]|"")*)"/y, COMMENT = /\{([^}]*)\}/y;

/** Walks over one line. Blanks, commas and semicolons only part what stands beside them; words compare without regard to case. */
export class Cursor {
  private readonly text: string;
  private readonly line: number;
  private at = 0;

  /** @throws {TextError} when the line is too long for anybody. */
  constructor(text: string, line: number) {
    if (text.length > LINE_LENGTH) throw new TextError({ line, column: LINE_LENGTH + 1 }, `a line of at most ${LINE_LENGTH} characters`, `Line ${line} has ${text.length} characters.`);
    this.text = text;
    this.line = line;
    this.match(BLANK);
  }

  get here(): TextPlace { return { line: this.line, column: this.at + 1 }; }
  get done(): boolean { return this.at >= this.text.length; }
  /** Whether a number stands here. */
  get atNumber(): boolean { return this.peek(NUMBER) !== undefined; }
  get atComment(): boolean { return this.text[this.at] === "{"; }
  /** The word that stands here in upper case, or "". */
  get word(): string { return this.peek(WORD)?.toUpperCase() ?? ""; }

  /** Goes past the word when it is that one. */
  accept(word: string): boolean {
    if (this.word !== word) return false;
    this.match(WORD);
    return true;
  }

  expect(word: string): void {
    if (!this.accept(word)) throw this.unexpected(word);
  }

  /** The one of these words that stands here. */
  oneOf<W extends string>(words: readonly W[]): W {
    const { word } = this, found = words.find(each => each === word);
    if (found === undefined) throw this.unexpected(words.join(" or "));
    this.match(WORD);
    return found;
  }

  number(what: string): number {
    const { here } = this, text = this.match(NUMBER);
    if (text === undefined) throw this.unexpected(what);
    const value = Number(text);
    if (!(Math.abs(value) <= MOST)) throw new TextError(here, `${what} of at most ${MOST}`, `The number ${text} is larger than anything a robot reaches.`);
    return value;
  }

  numbers(count: number, what: string): number[] {
    const values: number[] = [];
    for (let i = 1; i <= count; i++) values.push(this.number(`${what} ${i} of ${count}`));
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
    if (text === undefined) throw new TextError(this.here, "a } at the end of the comment", "The comment is not closed in its line.");
    this.match(COMMENT);
    return text.slice(1, -1).trim();
  }

  percent(): boolean {
    if (this.text[this.at] !== "%") return false;
    this.at++;
    this.match(BLANK);
    return true;
  }

  expectEnd(): void {
    if (!this.done) throw this.unexpected("the end of the line");
  }

  unexpected(expected: string): TextError {
    const rest = this.text.slice(this.at), next = /^(?:[A-Za-z0-9_.+-]+|"[^"]*"?|[^])/u.exec(rest)?.[0];
    return new TextError(this.here, expected, next === undefined ? `The line ends where ${expected} is expected.` : `${next.startsWith("\"") ? next : `"${next}"`} stands where ${expected} is expected.`);
  }

  private quoted(): string | undefined {
    return this.match(TEXT)?.slice(1, -1).replaceAll("\"\"", "\"");
  }

  private peek(pattern: RegExp): string | undefined {
    pattern.lastIndex = this.at;
    return pattern.exec(this.text)?.[0];
  }

  private match(pattern: RegExp): string | undefined {
    const found = this.peek(pattern);
    if (found === undefined) return undefined;
    this.at += found.length;
    BLANK.lastIndex = this.at;
    this.at += BLANK.exec(this.text)?.[0].length ?? 0;
    return found;
  }
}
