import { TextError } from "../../text/index.ts";
/** Longer than any statement. */
const LINE_LENGTH = 4096;
/** Larger than any length, angle or time that means something. */
const MOST = 1e9;
const BLANK = 32, COMMA = 44, SEMICOLON = 59;
const WORD = /[A-Za-z_][A-Za-z0-9_]*/y, NUMBER = /[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[Ee][-+]?[0-9]+)?/y;
const TEXT = /"((?:[^"]|"")*)"/y, COMMENT = /\{([^}]*)\}/y;
/** Walks over one line. Blanks, commas and semicolons only part what stands beside them; words compare without regard to case. */
export class Cursor {
    text;
    line;
    at = 0;
    /** The word that was looked at last, in upper case, and where: a line asks for many words before the one it has. */
    seenAt = -1;
    seen = "";
    /** @throws {TextError} when the line is too long for anybody. */
    constructor(text, line) {
        if (text.length > LINE_LENGTH)
            throw new TextError({ line, column: LINE_LENGTH + 1 }, `a line of at most ${LINE_LENGTH} characters`, `Line ${line} has ${text.length} characters.`);
        this.text = text;
        this.line = line;
        this.skipBlanks();
    }
    get here() { return { line: this.line, column: this.at + 1 }; }
    get done() { return this.at >= this.text.length; }
    /** Whether a number stands here. */
    get atNumber() { return this.peek(NUMBER) !== undefined; }
    get atComment() { return this.text[this.at] === "{"; }
    /** The word that stands here in upper case, or "". */
    get word() {
        if (this.seenAt !== this.at) {
            this.seenAt = this.at;
            this.seen = this.done ? "" : this.peek(WORD)?.toUpperCase() ?? "";
        }
        return this.seen;
    }
    /** Goes past the word when it is that one. */
    accept(word) {
        if (this.word !== word)
            return false;
        this.pass(word.length);
        return true;
    }
    expect(word) {
        if (!this.accept(word))
            throw this.unexpected(word);
    }
    /** The one of these words that stands here. */
    oneOf(words) {
        const { word } = this, found = words.find(each => each === word);
        if (found === undefined)
            throw this.unexpected(words.join(" or "));
        this.pass(found.length);
        return found;
    }
    number(what, nth = 1, count = 1) {
        const { at } = this, text = this.match(NUMBER);
        if (text === undefined)
            throw this.unexpected(count === 1 ? what : `${what} ${nth} of ${count}`);
        const value = Number(text);
        if (!(Math.abs(value) <= MOST))
            throw new TextError({ line: this.line, column: at + 1 }, `${what} of at most ${MOST}`, `The number ${text} is larger than anything a robot reaches.`);
        return value;
    }
    numbers(count, what) {
        const values = [];
        for (let i = 1; i <= count; i++)
            values.push(this.number(what, i, count));
        return values;
    }
    /** A bare word, or a text in quotes in which a doubled quote stands for one. */
    name(what) {
        const name = this.match(WORD) ?? this.quoted();
        if (name === undefined)
            throw this.unexpected(what);
        return name;
    }
    /** What stands between braces. */
    comment() {
        const text = this.peek(COMMENT);
        if (text === undefined)
            throw new TextError(this.here, "a } at the end of the comment", "The comment is not closed in its line.");
        this.match(COMMENT);
        return text.slice(1, -1).trim();
    }
    percent() {
        if (this.text[this.at] !== "%")
            return false;
        this.pass(1);
        return true;
    }
    expectEnd() {
        if (!this.done)
            throw this.unexpected("the end of the line");
    }
    unexpected(expected) {
        const rest = this.text.slice(this.at), next = /^(?:[A-Za-z0-9_.+-]+|"[^"]*"?|[^])/u.exec(rest)?.[0];
        return new TextError(this.here, expected, next === undefined ? `The line ends where ${expected} is expected.` : `${next.startsWith("\"") ? next : `"${next}"`} stands where ${expected} is expected.`);
    }
    quoted() {
        return this.match(TEXT)?.slice(1, -1).replaceAll("\"\"", "\"");
    }
    peek(pattern) {
        pattern.lastIndex = this.at;
        return pattern.exec(this.text)?.[0];
    }
    match(pattern) {
        const found = this.peek(pattern);
        if (found === undefined)
            return undefined;
        this.pass(found.length);
        return found;
    }
    pass(length) {
        this.at += length;
        this.skipBlanks();
    }
    skipBlanks() {
        for (let code = this.text.charCodeAt(this.at); code === BLANK || code === COMMA || code === SEMICOLON; code = this.text.charCodeAt(this.at))
            this.at++;
    }
}
