import { JumpBuilder } from "../../text/index.ts";
import { readExpression, readVariable } from "./expression.ts";
import { readStatement } from "./statement.ts";
const ENDS = { IF: "ENDIF", LOOP: "ENDLOOP", WHILE: "ENDWHILE", REPEAT: "UNTIL", FOR: "ENDFOR", SWITCH: "ENDSWITCH" };
const RULES = { expression: readExpression, variable: readVariable, statement: readStatement, called: "routine", endOf: word => ENDS[word] };
const SWITCH = { opens: "SWITCH", ends: "ENDSWITCH", last: "DEFAULT" };
/** Turns the lines of one routine into instructions with jumps. */
export class RoutineBuilder extends JumpBuilder {
    isFunction;
    declarations = [];
    place;
    parameters;
    constructor(name, place, isFunction, parameters) {
        super(name, RULES);
        this.place = place;
        this.isFunction = isFunction;
        this.parameters = parameters;
    }
    line(cursor) {
        if (cursor.nextKind === "word" && cursor.second === ":")
            return this.readLabel(cursor);
        if (cursor.done)
            return;
        const at = cursor.here;
        switch (cursor.second === "=" ? "" : cursor.next) {
            case "IF": return this.readIf(cursor, at);
            case "ELSE": return this.readElse(cursor);
            case "FOR": return this.readFor(cursor, at);
            case "LOOP": return this.begin(cursor, "loop");
            case "REPEAT": return this.begin(cursor, "until");
            case "WHILE": return this.readWhile(cursor, at);
            case "SWITCH": return this.readSwitch(cursor, at);
            case "CASE": return this.readCase(cursor, SWITCH, false);
            case "DEFAULT": return this.readLastCase(cursor, SWITCH);
            case "UNTIL": return this.readUntil(cursor, "REPEAT");
            case "ENDIF":
            case "ENDLOOP":
            case "ENDWHILE":
            case "ENDFOR":
            case "ENDSWITCH": return this.readEnd(cursor);
            case "EXIT": return this.readExit(cursor, at);
            case "GOTO": {
                cursor.take();
                const to = cursor.here, label = cursor.name("a label");
                this.goto(this.push({ kind: "jump", to: -1, at }), label, to);
                return cursor.expectEnd();
            }
            default: this.code.push({ kind: "statement", statement: readStatement(cursor) });
        }
    }
    /** @throws {TextError} for a block without its end, or a GOTO to a label that is not there. */
    finish(end) {
        this.close(end);
        const { name, place, isFunction, parameters, declarations, slots } = this;
        return { name, place, isFunction, parameters, declarations, instructions: this.code, slots };
    }
    readLabel(cursor) {
        const at = cursor.here, label = cursor.name();
        cursor.take();
        cursor.expectEnd();
        this.label(label, at);
    }
    readIf(cursor, at) {
        cursor.take();
        const condition = readExpression(cursor);
        cursor.expect("THEN");
        cursor.expectEnd();
        this.openIf(condition, at);
    }
}
