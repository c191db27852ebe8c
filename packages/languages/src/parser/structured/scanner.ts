import type { TextPlace } from "@twincell/core";
import { TextError } from "../faults.ts";
import { plainText } from "../lines.ts";

export type TokenKind = "word" | "number" | "text" | "sign" | "line-end" | "end";
/** What a comment says, without its sign. */
export interface Comment extends TextPlace {
  readonly text: string;
}

/** What tells one language from another before its grammar begins. */
export interface Lexicon {
  /** Begins a comment that ends with its line. */
  readonly comment: string;
  /** Characters that enclose a text; a doubled one inside stands for itself where `doubled` is true. */
  readonly quotes: string;
  readonly doubled: boolean;
  /** Signs, longer ones before shorter ones that begin like them. */
  readonly signs: readonly string[];
  /** Whether the end of a line ends a statement; inside brackets it never does. */
  readonly lineEnds: boolean;
  /** A word, with the flag `y`, where it is more than letters, digits and `_`. */
  readonly word?: RegExp;
}

/** A line longer than this is nobody's program; it also bounds how much a statement can hold. */
const LINE_LENGTH = 4096;
const NUMBER = /(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[Ee][+-]?[0-9]+)?/y;
const BLANK = 32;
const DOT = 46;
const LETTER = 1;
const DIGIT = 2;
const LINE_END = 3;
/** The sort of each ASCII character: a large text is looked at by numbers, not by patterns. */
const SORTS = Uint8Array.from({ length: 128 }, (_, code) => {
  const letter = String.fromCharCode(code);
  return /[A-Za-z_]/.test(letter) ? LETTER : /[0-9]/.test(letter) ? DIGIT : /[\r\n]/.test(letter) ? LINE_END : 0;
});
const isDigitCode = (code: number): boolean => code < 128 && SORTS[code] === DIGIT;
const isWordCode = (code: number): boolean => code < 128 && (SORTS[code] === LETTER || SORTS[code] === DIGIT);

/**
 * The tokens of a text one after the other: `next` puts the token into these fields. Lines may end in CR LF, LF or CR.
 */
export class Scanner {
  kind: TokenKind = "line-end";
  raw = "";
  tokenLine = 1;
  tokenColumn = 1;
  private readonly text: string;
  private readonly lexicon: Lexicon;
  private readonly signs = new Map<string, readonly string[]>();
  private at = 0;
  private line = 1;
  private lineStart = 0;
  private depth = 0;
  /** Comments that have been passed and not yet been taken. */
  private readonly comments: Comment[] = [];

  constructor(text: string, lexicon: Lexicon) {
    this.text = plainText(text);
    this.lexicon = lexicon;
    for (const sign of lexicon.signs) this.signs.set(sign[0]!, [...(this.signs.get(sign[0]!) ?? []), sign]);
  }

  /** Forgets open brackets, so that reading can go on behind a fault. */
  recover(): void {
    this.depth = 0;
  }

  /** Takes the first comment that stands before that line. */
  commentBefore(line: number): Comment | undefined {
    const first = this.comments[0];
    return first !== undefined && first.line < line ? this.comments.shift() : undefined;
  }

  private tooLong(line: number, column: number): never {
    this.skipLine();
    throw new TextError(
      { line, column },
      `a line of at most ${LINE_LENGTH} characters`,
      `Line ${line} has more than ${LINE_LENGTH} characters.`,
    );
  }

  private number(from: number): void {
    NUMBER.lastIndex = from;
    const number = NUMBER.exec(this.text)![0];
    this.at += number.length;
    this.found("number", number);
  }

  private word(from: number): void {
    const { text } = this;
    while (this.at < text.length && isWordCode(text.charCodeAt(this.at))) this.at++;
    this.found("word", text.slice(from, this.at));
  }

  /** A word as this language alone spells it. */
  private wordOfLexicon(from: number): string | undefined {
    const { word } = this.lexicon;
    if (word === undefined) return undefined;
    word.lastIndex = from;
    return word.exec(this.text)?.[0];
  }

  /** @throws {TextError} at a character that has no meaning in the language; the character is then behind. */
  next(): void {
    const { text, lexicon } = this;
    const { length } = text;
    for (;;) {
      while (this.at < length && text.charCodeAt(this.at) === BLANK) this.at++;
      const from = this.at;
      const column = from - this.lineStart + 1;
      const { line } = this;
      this.tokenLine = line;
      this.tokenColumn = column;
      if (from >= length) return this.found("end", "");
      const code = text.charCodeAt(from);
      const sort = code < 128 ? SORTS[code]! : 0;
      if (column > LINE_LENGTH && sort !== LINE_END) this.tooLong(line, column);
      const word = sort === DIGIT || sort === LINE_END ? undefined : this.wordOfLexicon(from);
      if (word !== undefined) {
        this.at += word.length;
        return this.found("word", word);
      }
      if (sort === LETTER) return this.word(from);
      if (sort === DIGIT || (code === DOT && isDigitCode(text.charCodeAt(from + 1)))) return this.number(from);
      if (sort === LINE_END) {
        this.newLine(text[from]!);
        if (lexicon.lineEnds && this.depth === 0) return this.found("line-end", "");
        continue;
      }
      const letter = text[from]!;
      if (letter === lexicon.comment) {
        this.skipLine();
        this.comments.push({ text: text.slice(from + 1, this.at).trim(), line, column });
        continue;
      }
      if (lexicon.quotes.includes(letter)) return this.found("text", this.quoted(letter, { line, column }));
      return this.sign(letter, line, column);
    }
  }

  private found(kind: TokenKind, raw: string): void {
    this.kind = kind;
    this.raw = raw;
  }

  private sign(letter: string, line: number, column: number): void {
    const { text } = this;
    const choice = this.signs.get(letter);
    const sign =
      choice === undefined || (choice.length === 1 && choice[0]!.length === 1)
        ? choice?.[0]
        : choice.find(each => text.startsWith(each, this.at));
    if (sign === undefined) {
      const whole = String.fromCodePoint(text.codePointAt(this.at)!);
      this.at += whole.length;
      throw new TextError(
        { line, column },
        "a name, a number or a sign of the language",
        `The character "${whole}" has no meaning here.`,
      );
    }
    this.at += sign.length;
    if (sign === "(" || sign === "[" || sign === "{") this.depth++;
    if ((sign === ")" || sign === "]" || sign === "}") && this.depth > 0) this.depth--;
    this.found("sign", sign);
  }

  private newLine(letter: string): void {
    this.at += letter === "\r" && this.text[this.at + 1] === "\n" ? 2 : 1;
    this.line++;
    this.lineStart = this.at;
  }

  private skipLine(): void {
    while (this.at < this.text.length && this.text[this.at] !== "\n" && this.text[this.at] !== "\r") this.at++;
  }

  private quoted(quote: string, place: TextPlace): string {
    const { text } = this;
    let value = "";
    let at = this.at + 1;
    for (;;) {
      const letter = text[at];
      if (letter === undefined || letter === "\n" || letter === "\r") {
        this.at = at;
        throw new TextError(
          place,
          `a ${quote} at the end of the text`,
          `The text that begins in column ${place.column} is not closed in its line.`,
        );
      }
      if (letter === quote && !(this.lexicon.doubled && text[at + 1] === quote)) break;
      if (letter === quote) at++;
      value += letter;
      at++;
    }
    this.at = at + 1;
    return value;
  }
}
