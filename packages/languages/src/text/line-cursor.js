import { TextError } from "./faults.ts";
import { plainText } from "./lines.ts";
import { lineTokens } from "./tokens.ts";
const TYPOGRAPHIC = /[^ -~]/;
/** Walks over the tokens of one line. Words compare without regard to case. */
export class LineCursor {
    tokens;
    upper;
    end;
    called;
    at = 0;
    /** @throws {TextError} at a character that has no meaning in the language, or when the line is too long for anybody. */
    constructor(text, line, { tokens, longest, called }) {
        if (text.length > longest)
            throw new TextError({ line, column: longest + 1 }, `a line of at most ${longest} characters`, `Line ${line} has ${text.length} characters.`);
        this.tokens = lineTokens(TYPOGRAPHIC.test(text) ? plainText(text) : text, line, tokens);
        this.upper = this.tokens.map(token => token.text.toUpperCase());
        this.end = { line, column: text.length + 1 };
        this.called = called;
    }
    get here() { return this.tokens[this.at] ?? this.end; }
    get done() { return this.at >= this.tokens.length; }
    /** The next token in upper case, or "" at the end. */
    get next() { return this.upper[this.at] ?? ""; }
    get nextKind() { return this.tokens[this.at]?.kind ?? "end"; }
    /** The token after the next, in upper case. */
    get second() { return this.upper[this.at + 1] ?? ""; }
    get secondKind() { return this.tokens[this.at + 1]?.kind ?? "end"; }
    /** The next token as it stands. */
    take() {
        const token = this.tokens[this.at];
        if (token === undefined)
            throw this.unexpected(`more of the ${this.called}`);
        this.at++;
        return token.text;
    }
    /** Goes past the token when it is that one. */
    accept(text) {
        if (this.next !== text)
            return false;
        this.at++;
        return true;
    }
    expect(text) {
        if (!this.accept(text))
            throw this.unexpected(`"${text}"`);
    }
    expectEnd() {
        if (!this.done)
            throw this.unexpected(`the end of the ${this.called}`);
    }
    skip() { this.at = this.tokens.length; }
    unexpected(expected) {
        const token = this.tokens[this.at];
        return new TextError(this.here, expected, token === undefined
            ? `The line ends where ${expected} is expected.`
            : `"${token.text}" stands where ${expected} is expected.`);
    }
}
