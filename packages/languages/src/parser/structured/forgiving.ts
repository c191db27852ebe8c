import type { TextFault, TextPlace } from "@twincell/core";
import { TextError } from "../faults.ts";
import { TokenCursor } from "./cursor.ts";
import type { Lexicon } from "./scanner.ts";
import type { Statement } from "./tree.ts";

/** Deepest nesting of blocks: more than anybody writes, less than the stack holds. */
const DEPTH = 50;
/** A text with more faults than this is of another kind, or not one at all. */
const MOST_FAULTS = 50;

/** Reads on after a fault, so that all of a text's faults are told at once. */
export abstract class RecoveringReader {
  protected readonly cursor: TokenCursor;
  protected readonly faults: TextFault[] = [];
  private depth = 0;

  constructor(text: string, lexicon: Lexicon) {
    this.cursor = new TokenCursor(text.replace(/^\uFEFF/, ""), lexicon, word => this.folded(word));
  }

  /** A word as it is compared: in small letters, for instance, where capitals count for nothing. */
  protected abstract folded(word: string): string;

  protected get hasEnough(): boolean {
    return this.faults.length >= MOST_FAULTS;
  }

  /** What was read, or undefined after a fault, which is kept; the rest of its line is left behind. */
  protected guard<T>(read: () => T): T | undefined {
    const { depth } = this;
    try {
      return read();
    } catch (cause) {
      if (!(cause instanceof TextError)) throw cause;
      this.faults.push(cause.fault);
      this.depth = depth;
      this.restOfLine();
      return undefined;
    }
  }

  protected restOfLine(): void {
    this.cursor.skip(cursor => cursor.isAt("line-end") || this.closes(cursor.next));
  }

  /** Whether a word ends a routine wherever it stands, so that nothing open inside can go on. */
  protected closes(_word: string): boolean {
    return false;
  }

  /**
   * Reads what stands inside a block that was opened at `at`. Every way out of `read` by a fault leads through `guard`.
   */
  protected nested<T>(at: TextPlace, read: () => T): T {
    if (++this.depth > DEPTH)
      throw new TextError(at, "a simpler program", `Blocks are nested more than ${DEPTH} deep.`);
    const inside = read();
    this.depth--;
    return inside;
  }

  protected takeComments(into: Statement[]): void {
    for (let comment = this.cursor.comment(); comment !== undefined; comment = this.cursor.comment())
      into.push({ kind: "comment", ...comment });
  }

  /** Up to the next statement of a language of lines: empty lines are left behind, comments taken. */
  protected toNextLine(into: Statement[]): void {
    while (this.cursor.isAt("line-end"))
      if (
        this.guard(() => {
          this.cursor.advance();
          return true;
        }) === undefined
      )
        break;
    this.takeComments(into);
  }
}
