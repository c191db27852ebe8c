import { TextError } from "../faults.ts";
import { Scanner } from "./scanner.ts";
/** Walks over the tokens of a text. `fold` gives words the form in which the language compares them. Going on allocates nothing. */
export class TokenCursor {
    /** The next token: its sort, as it is written, and as the language compares it ("" at the end and for a text). */
    kind = "line-end";
    raw = "";
    next = "";
    line = 1;
    column = 1;
    scanner;
    fold;
    isAhead = false;
    constructor(text, lexicon, fold) {
        this.scanner = new Scanner(text, lexicon);
        this.fold = fold;
    }
    /** Where the next token stands. */
    get here() { return { line: this.line, column: this.column }; }
    get done() { return this.kind === "end"; }
    isAt(kind) { return this.kind === kind; }
    /** The token after the next. */
    get second() {
        if (!this.isAhead)
            this.scanner.next();
        this.isAhead = true;
        return this.folded();
    }
    /** Takes the first comment in the lines before the next token. */
    comment() { return this.scanner.commentBefore(this.line); }
    /** Goes on by one token. @throws {TextError} at a character without a meaning. */
    advance() {
        const { scanner } = this;
        if (!this.isAhead)
            scanner.next();
        this.isAhead = false;
        this.kind = scanner.kind;
        this.raw = scanner.raw;
        this.line = scanner.tokenLine;
        this.column = scanner.tokenColumn;
        this.next = this.folded();
    }
    folded() {
        const { kind, raw } = this.scanner;
        return kind === "word" ? this.fold(raw) : kind === "text" ? "" : raw;
    }
    /** The next token, which is left behind. */
    take() {
        const { next } = this;
        this.advance();
        return next;
    }
    accept(text) {
        if (this.next !== text || this.kind === "end" || this.kind === "text")
            return false;
        this.advance();
        return true;
    }
    expect(text) {
        if (!this.accept(text))
            throw this.unexpected(`"${text}"`);
    }
    /** A name, which is left behind. */
    name(expected) {
        if (this.kind !== "word")
            throw this.unexpected(expected);
        return this.take();
    }
    /** Leaves tokens behind until `isEnd` says so, faults among them too. */
    skip(isEnd) {
        this.scanner.recover();
        while (!this.done && !isEnd(this)) {
            try {
                this.advance();
            }
            catch (cause) {
                if (!(cause instanceof TextError))
                    throw cause;
            }
        }
    }
    unexpected(expected) {
        const { kind, raw } = this;
        const what = kind === "end" ? "The text ends" : kind === "line-end" ? "The line ends" : `"${raw}" stands`;
        return new TextError(this.here, expected, `${what} where ${expected} is expected.`);
    }
}
