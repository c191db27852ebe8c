import type { TextPlace } from "@twincell/core";
import { JumpBuilder, TextError, type JumpRules, type SwitchWords } from "../../parser/index.ts";
import type { Cursor } from "./cursor.ts";
import { readExpression, readVariable } from "./expression.ts";
import { readStatement } from "./statement.ts";
import type { Declaration, Expression, Parameter, Routine, Statement, Variable } from "./syntax.ts";

const ENDS: Readonly<Record<string, string>> = {
  IF: "ENDIF",
  LOOP: "ENDLOOP",
  WHILE: "ENDWHILE",
  REPEAT: "UNTIL",
  FOR: "ENDFOR",
  SWITCH: "ENDSWITCH",
};
const RULES: JumpRules<Cursor, Expression, Variable, Statement> = {
  expression: readExpression,
  variable: readVariable,
  statement: readStatement,
  called: "routine",
  endOf: word => ENDS[word]!,
};
const SWITCH: SwitchWords = { opens: "SWITCH", ends: "ENDSWITCH", last: "DEFAULT" };

/** Turns the lines of one routine into instructions with jumps. */
export class RoutineBuilder extends JumpBuilder<Cursor, Expression, Variable, Statement> {
  readonly isFunction: boolean;
  readonly declarations: Declaration[] = [];
  private readonly place: TextPlace;
  private readonly parameters: readonly Parameter[];
  private readonly module: string;

  constructor(name: string, module: string, place: TextPlace, isFunction: boolean, parameters: readonly Parameter[]) {
    super(name, RULES);
    this.module = module;
    this.place = place;
    this.isFunction = isFunction;
    this.parameters = parameters;
  }

  line(cursor: Cursor): void {
    if (cursor.nextKind === "word" && cursor.second === ":") return this.readLabel(cursor);
    if (cursor.done) return;
    const at = cursor.here;
    switch (cursor.second === "=" ? "" : cursor.next) {
      case "IF":
        return this.readIf(cursor, at);
      case "ELSE":
        return this.readElse(cursor);
      case "FOR":
        return this.readFor(cursor, at);
      case "LOOP":
        return this.begin(cursor, "loop");
      case "REPEAT":
        return this.begin(cursor, "until");
      case "WHILE":
        return this.readWhile(cursor, at);
      case "SWITCH":
        return this.readSwitch(cursor, at);
      default:
        return this.branchOrEnd(cursor, at);
    }
  }

  /** What goes on with a block, ends or leaves it. */
  private branchOrEnd(cursor: Cursor, at: TextPlace): void {
    switch (cursor.second === "=" ? "" : cursor.next) {
      case "CASE":
        return this.readCase(cursor, SWITCH, false);
      case "DEFAULT":
        return this.readLastCase(cursor, SWITCH);
      case "UNTIL":
        return this.readUntil(cursor, "REPEAT");
      case "ENDIF":
      case "ENDLOOP":
      case "ENDWHILE":
      case "ENDFOR":
      case "ENDSWITCH":
        return this.readEnd(cursor);
      case "EXIT":
        return this.readExit(cursor, at);
      case "GOTO": {
        cursor.take();
        const to = cursor.here;
        const label = cursor.name("a label");
        this.goto(this.push({ kind: "jump", to: -1, at }), label, to);
        return cursor.expectEnd();
      }
      default:
        this.code.push({ kind: "statement", statement: readStatement(cursor) });
    }
  }

  /** @throws {TextError} for a block without its end, or a GOTO to a label that is not there. */
  finish(end: TextPlace): Routine {
    this.close(end);
    const { name, module, place, isFunction, parameters, declarations, slots } = this;
    return { name, module, place, isFunction, parameters, declarations, instructions: this.code, slots };
  }

  /** A line that is not understood, in a routine that perhaps nobody comes to. */
  fault({ line, column, expected, message }: TextError): void {
    this.code.push({ kind: "statement", statement: { kind: "fault", expected, sentence: message, line, column } });
  }

  /** Where a block is not closed the whole routine is at fault. */
  finishOrFault(end: TextPlace): Routine {
    try {
      return this.finish(end);
    } catch (cause) {
      if (!(cause instanceof TextError)) throw cause;
      this.code.splice(0);
      this.fault(cause);
      const { name, module, place, isFunction, parameters, declarations, slots } = this;
      return { name, module, place, isFunction, parameters, declarations, instructions: this.code, slots };
    }
  }

  private readLabel(cursor: Cursor): void {
    const at = cursor.here;
    const label = cursor.name();
    cursor.take();
    cursor.expectEnd();
    this.label(label, at);
  }

  private readIf(cursor: Cursor, at: TextPlace): void {
    cursor.take();
    const condition = readExpression(cursor);
    cursor.expect("THEN");
    cursor.expectEnd();
    this.openIf(condition, at);
  }
}
