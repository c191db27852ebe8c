import { asciiText } from "../../text/index.ts";
import { TooLong } from "../../writing/index.ts";
import { positionLines } from "./positions.ts";
/** Lines have four places for their number. */
const MOST_LINES = 9999;
const COMMENT_LENGTH = 16;
/** A comment that has to be cut says less than the name of the program. */
const shortOr = (comment) => comment.length <= COMMENT_LENGTH ? comment : "";
/** One program as the controller lists it: attributes, numbered lines, positions. */
export class Listing {
    name;
    comment;
    statements = [];
    positions = [];
    numbers = new Map();
    labels = 0;
    /** Labels behind the end at which the program is aborted. */
    abort;
    constructor(name, comment) {
        this.name = name;
        this.comment = shortOr(asciiText(comment).replace(/["']/g, ""));
    }
    add(text, step = "") { this.statements.push({ text, isMotion: false, step }); }
    motion(text, step) { this.statements.push({ text, isMotion: true, step }); }
    label() { return ++this.labels; }
    /** A label where the program ends with a fault. */
    abortLabel() { return this.abort ??= this.label(); }
    /** The number of a position; the same record is kept once for each step. */
    position(position) {
        const key = JSON.stringify(position), known = this.numbers.get(key);
        if (known !== undefined)
            return known;
        this.positions.push(position);
        this.numbers.set(key, this.positions.length);
        return this.positions.length;
    }
    file() {
        if (this.abort !== undefined)
            for (const line of ["END", `LBL[${this.abort}]`, "ABORT"])
                this.add(line);
        const { statements, name } = this, last = statements.at(-1), texts = [], lines = [];
        if (statements.length > MOST_LINES)
            throw new TooLong(last.step, `The program ${name} has ${statements.length} lines; a listing numbers ${MOST_LINES}.`, "Put parts of it into routines of their own.");
        const put = (text, step = "") => { texts.push(`${text}\r\n`); lines.push(step); };
        put(`/PROG  ${name}`);
        for (const line of [
            "/ATTR", "OWNER\t\t= MNEDITOR;", `COMMENT\t\t= "${this.comment}";`, "PROG_SIZE\t= 0;", "FILE_NAME\t= ;", "VERSION\t\t= 0;", `LINE_COUNT\t= ${statements.length};`, "MEMORY_SIZE\t= 0;", "PROTECT\t\t= READ_WRITE;",
            "TCD:  STACK_SIZE\t= 0,", "      TASK_PRIORITY\t= 50,", "      TIME_SLICE\t= 0,", "      BUSY_LAMP_OFF\t= 0,", "      ABORT_REQUEST\t= 0,", "      PAUSE_REQUEST\t= 0;",
            "DEFAULT_GROUP\t= 1,*,*,*,*;", "CONTROL_CODE\t= 00000000 00000000;", "/MN",
        ])
            put(line);
        for (const [i, { text, isMotion, step }] of statements.entries()) {
            const [first, ...more] = text.split("\n"), number = `${i + 1}`.padStart(4);
            put(`${number}:${isMotion ? "" : "  "}${first}${more.length > 0 ? "    " : isMotion ? "    ;" : " ;"}`, step);
            for (const line of more)
                put(`    :  ${line}    ;`, step);
        }
        put("/POS");
        for (const [i, position] of this.positions.entries())
            for (const line of positionLines(i + 1, position))
                put(line, position.step);
        put("/END");
        return { name: `${name}.LS`, text: texts.join(""), lines };
    }
}
