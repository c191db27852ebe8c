import type { TextPlace } from "@twincell/core";
import { TextError } from "../faults.ts";
import { plainText } from "../lines.ts";

export type TokenKind = "word" | "number" | "text" | "sign" | "line-end" | "end";
/** What a comment says, without its sign. */
export interface Comment extends TextPlace { readonly text: string }
export interface TextToken extends TextPlace { readonly kind: TokenKind; readonly text: string }

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
}

/** A line longer than this is nobody's program; it also bounds how much a statement can hold. */
const LINE_LENGTH = 4096;
const NUMBER = /(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[Ee][+-]?[0-9]+)?/y;
const WORD = /[A-Za-z_][A-Za-z0-9_]*/y;

/** The tokens of a text one after the other. Lines may end in CR LF, LF or CR. */
export class Scanner {
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
  recover(): void { this.depth = 0; }

  /** Takes the first comment that stands before that line. */
  commentBefore(line: number): Comment | undefined {
    const first = this.comments[0];
    return first !== undefined && first.line < line ? this.comments.shift() : undefined;
  }

  /** @throws {TextError} at a character that has no meaning in the language; the character is then behind. */
  next(): TextToken {
    const { text, lexicon } = this;
    while (this.at < text.length) {
      const letter = text[this.at]!, place = { line: this.line, column: this.at - this.lineStart + 1 };
      if (letter === " ") { this.at++; continue; }
      if (letter === "\n" || letter === "\r") {
        this.newLine(letter);
        if (lexicon.lineEnds && this.depth === 0) return { kind: "line-end", text: "", ...place };
        continue;
      }
      if (place.column > LINE_LENGTH) { this.skipLine(); throw new TextError(place, `a line of at most ${LINE_LENGTH} characters`, `Line ${place.line} has more than ${LINE_LENGTH} characters.`); }
      if (letter === lexicon.comment) {
        const from = this.at + 1;
        this.skipLine();
        this.comments.push({ text: text.slice(from, this.at).trim(), ...place });
        continue;
      }
      if (lexicon.quotes.includes(letter)) return { kind: "text", text: this.quoted(letter, place), ...place };
      const word = this.match(WORD);
      if (word !== undefined) return { kind: "word", text: word, ...place };
      const number = this.match(NUMBER);
      if (number !== undefined) return { kind: "number", text: number, ...place };
      const sign = this.signs.get(letter)?.find(each => text.startsWith(each, this.at));
      const whole = String.fromCodePoint(text.codePointAt(this.at)!);
      this.at += sign?.length ?? whole.length;
      if (sign === undefined) throw new TextError(place, "a name, a number or a sign of the language", `The character "${whole}" has no meaning here.`);
      if (sign === "(" || sign === "[" || sign === "{") this.depth++;
      if ((sign === ")" || sign === "]" || sign === "}") && this.depth > 0) this.depth--;
      return { kind: "sign", text: sign, ...place };
    }
    return { kind: "end", text: "", line: this.line, column: this.at - this.lineStart + 1 };
  }

  private match(pattern: RegExp): string | undefined {
    pattern.lastIndex = this.at;
    const found = pattern.exec(this.text)?.[0];
    if (found !== undefined) this.at += found.length;
    return found;
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
    let value = "", at = this.at + 1;
    for (;;) {
      const letter = text[at];
      if (letter === undefined || letter === "\n" || letter === "\r") {
        this.at = at;
        throw new TextError(place, `a ${quote} at the end of the text`, `The text that begins in column ${place.column} is not closed in its line.`);
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
