import { JumpBuilder, TextError } from "../../text/index.ts";
import { readExpression, readVariable } from "./expression.ts";
import { readStatement } from "./statement.ts";
const RULES = { expression: readExpression, variable: readVariable, statement: readStatement, called: "program", endOf: word => word === "DO" ? "UNTIL" : "END" };
const CASE = { opens: "CASE", ends: "END", last: "ANY" };
/** Turns the lines of one program into instructions with jumps. */
export class RoutineBuilder extends JumpBuilder {
    place;
    parameters;
    constructor(name, place, parameters) {
        super(name, RULES);
        this.place = place;
        this.parameters = parameters;
    }
    line(cursor) {
        if (cursor.nextKind === "number")
            this.readLabel(cursor);
        if (cursor.done)
            return;
        const at = cursor.here;
        switch (cursor.second === "=" ? "" : cursor.next) {
            case "IF": return this.readIf(cursor, at);
            case "ELSE": return this.readElse(cursor);
            case "WHILE": return this.readWhile(cursor, at, "DO");
            case "DO": return this.readDo(cursor);
            case "UNTIL": return this.readUntil(cursor, "DO");
            case "FOR": return this.readFor(cursor, at);
            case "CASE": return this.readSwitch(cursor, at, "OF");
            case "VALUE": return this.readCase(cursor, CASE, true);
            case "ANY": return this.readLastCase(cursor, CASE);
            case "END": return this.readEnd(cursor);
            case "EXIT": return this.readExit(cursor, at);
            case "GOTO":
                cursor.take();
                this.readGoto(this.push({ kind: "jump", to: -1, at }), cursor);
                return cursor.expectEnd();
            default: this.code.push({ kind: "statement", statement: readStatement(cursor) });
        }
    }
    /** @throws {TextError} for a block without its end, or a GOTO to a label that is not there. */
    finish(end) {
        this.close(end);
        return { name: this.name, place: this.place, parameters: this.parameters, instructions: this.code, slots: this.slots };
    }
    readLabel(cursor) {
        const at = cursor.here, label = cursor.take();
        if (!/^[0-9]+$/.test(label) || Number(label) > 65535)
            throw new TextError(at, "a label from 0 to 65535", `${label} is no label.`);
        this.label(label, at);
    }
    readGoto(jump, cursor) {
        const at = cursor.here;
        if (cursor.nextKind !== "number")
            throw cursor.unexpected("a label");
        this.goto(jump, cursor.take(), at);
    }
    readIf(cursor, at) {
        cursor.take();
        const condition = readExpression(cursor);
        if (cursor.accept("GOTO")) {
            const over = this.push({ kind: "unless", condition, to: -1 });
            this.readGoto(this.push({ kind: "jump", to: -1, at }), cursor);
            over.to = this.code.length;
        }
        else {
            cursor.expect("THEN");
            this.openIf(condition, at);
        }
        cursor.expectEnd();
    }
    /** `DO` alone opens a block; `DO statement` is what a terminal would run at once, and does the same here. */
    readDo(cursor) {
        if (cursor.second === "")
            return this.begin(cursor, "until");
        cursor.take();
        this.code.push({ kind: "statement", statement: readStatement(cursor) });
    }
}
