import { TextError } from "../faults.ts";
import { plainText } from "../lines.ts";
/** A line longer than this is nobody's program; it also bounds how much a statement can hold. */
const LINE_LENGTH = 4096;
const NUMBER = /(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[Ee][+-]?[0-9]+)?/y;
const BLANK = 32, DOT = 46, LETTER = 1, DIGIT = 2, LINE_END = 3;
/** The sort of each ASCII character: a large text is looked at by numbers, not by patterns. */
const SORTS = Uint8Array.from({ length: 128 }, (_, code) => {
    const letter = String.fromCharCode(code);
    return /[A-Za-z_]/.test(letter) ? LETTER : /[0-9]/.test(letter) ? DIGIT : /[\r\n]/.test(letter) ? LINE_END : 0;
});
const isDigitCode = (code) => code < 128 && SORTS[code] === DIGIT;
const isWordCode = (code) => code < 128 && (SORTS[code] === LETTER || SORTS[code] === DIGIT);
/** The tokens of a text one after the other: `next` puts the token into these fields. Lines may end in CR LF, LF or CR. */
export class Scanner {
    kind = "line-end";
    raw = "";
    tokenLine = 1;
    tokenColumn = 1;
    text;
    lexicon;
    signs = new Map();
    at = 0;
    line = 1;
    lineStart = 0;
    depth = 0;
    /** Comments that have been passed and not yet been taken. */
    comments = [];
    constructor(text, lexicon) {
        this.text = plainText(text);
        this.lexicon = lexicon;
        for (const sign of lexicon.signs)
            this.signs.set(sign[0], [...(this.signs.get(sign[0]) ?? []), sign]);
    }
    /** Forgets open brackets, so that reading can go on behind a fault. */
    recover() { this.depth = 0; }
    /** Takes the first comment that stands before that line. */
    commentBefore(line) {
        const first = this.comments[0];
        return first !== undefined && first.line < line ? this.comments.shift() : undefined;
    }
    /** @throws {TextError} at a character that has no meaning in the language; the character is then behind. */
    next() {
        const { text, lexicon } = this, { length } = text;
        for (;;) {
            while (this.at < length && text.charCodeAt(this.at) === BLANK)
                this.at++;
            const from = this.at, column = from - this.lineStart + 1, { line } = this;
            this.tokenLine = line;
            this.tokenColumn = column;
            if (from >= length)
                return this.found("end", "");
            const code = text.charCodeAt(from), sort = code < 128 ? SORTS[code] : 0;
            if (column > LINE_LENGTH && sort !== LINE_END) {
                this.skipLine();
                throw new TextError({ line, column }, `a line of at most ${LINE_LENGTH} characters`, `Line ${line} has more than ${LINE_LENGTH} characters.`);
            }
            if (lexicon.word !== undefined && sort !== DIGIT && sort !== LINE_END) {
                lexicon.word.lastIndex = from;
                const word = lexicon.word.exec(text)?.[0];
                if (word !== undefined) {
                    this.at += word.length;
                    return this.found("word", word);
                }
            }
            if (sort === LETTER) {
                while (this.at < length && isWordCode(text.charCodeAt(this.at)))
                    this.at++;
                return this.found("word", text.slice(from, this.at));
            }
            if (sort === DIGIT || (code === DOT && isDigitCode(text.charCodeAt(from + 1)))) {
                NUMBER.lastIndex = from;
                const number = NUMBER.exec(text)[0];
                this.at += number.length;
                return this.found("number", number);
            }
            if (sort === LINE_END) {
                this.newLine(text[from]);
                if (lexicon.lineEnds && this.depth === 0)
                    return this.found("line-end", "");
                continue;
            }
            const letter = text[from];
            if (letter === lexicon.comment) {
                this.skipLine();
                this.comments.push({ text: text.slice(from + 1, this.at).trim(), line, column });
                continue;
            }
            if (lexicon.quotes.includes(letter))
                return this.found("text", this.quoted(letter, { line, column }));
            return this.sign(letter, line, column);
        }
    }
    found(kind, raw) {
        this.kind = kind;
        this.raw = raw;
    }
    sign(letter, line, column) {
        const { text } = this, choice = this.signs.get(letter);
        const sign = choice === undefined || choice.length === 1 && choice[0].length === 1 ? choice?.[0] : choice.find(each => text.startsWith(each, this.at));
        if (sign === undefined) {
            const whole = String.fromCodePoint(text.codePointAt(this.at));
            this.at += whole.length;
            throw new TextError({ line, column }, "a name, a number or a sign of the language", `The character "${whole}" has no meaning here.`);
        }
        this.at += sign.length;
        if (sign === "(" || sign === "[" || sign === "{")
            this.depth++;
        if ((sign === ")" || sign === "]" || sign === "}") && this.depth > 0)
            this.depth--;
        this.found("sign", sign);
    }
    newLine(letter) {
        this.at += letter === "\r" && this.text[this.at + 1] === "\n" ? 2 : 1;
        this.line++;
        this.lineStart = this.at;
    }
    skipLine() {
        while (this.at < this.text.length && this.text[this.at] !== "\n" && this.text[this.at] !== "\r")
            this.at++;
    }
    quoted(quote, place) {
        const { text } = this;
        let value = "", at = this.at + 1;
        for (;;) {
            const letter = text[at];
            if (letter === undefined || letter === "\n" || letter === "\r") {
                this.at = at;
                throw new TextError(place, `a ${quote} at the end of the text`, `The text that begins in column ${place.column} is not closed in its line.`);
            }
            if (letter === quote && !(this.lexicon.doubled && text[at + 1] === quote))
                break;
            if (letter === quote)
                at++;
            value += letter;
            at++;
        }
        this.at = at + 1;
        return value;
    }
}
