import { LineCursor } from "../../text/index.ts";
const RULES = {
    longest: 1024,
    called: "statement",
    tokens: [
        [null, / +/y],
        [null, /;.*/y],
        ["word", /[$#]?[A-Za-z][A-Za-z0-9_.]*/y],
        ["number", /(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[Ee][+-]?[0-9]+)?/y],
        ["text", /"[^"]*"/y],
        ["sign", /==|<>|<=|>=|\*\*|[-+*/=<>()[\],:]/y],
    ],
};
/** Walks over the tokens of one line. */
export class Cursor extends LineCursor {
    constructor(text, line) { super(text, line, RULES); }
}
