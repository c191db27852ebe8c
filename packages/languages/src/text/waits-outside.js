import { Fault } from "@twincell/core";
/** A program that goes round without a motion until a line from outside changes: it shows only when it runs beside such lines. */
export class WaitsOutside extends Fault {
    code = "language.waits-outside";
    hint;
    constructor({ line, column }, called = "program") {
        super(`The ${called} turns in a circle until a line from outside changes.`);
        this.hint = `Line ${line}, column ${column}: set the line that it looks at.`;
    }
}
