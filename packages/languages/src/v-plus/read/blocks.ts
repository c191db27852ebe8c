import type { TextPlace } from "@twincell/core";
import { JumpBuilder, TextError, type JumpRules, type SwitchWords } from "../../parser/index.ts";
import type { Cursor } from "./cursor.ts";
import { readExpression, readVariable } from "./expression.ts";
import { readStatement } from "./statement.ts";
import type { Expression, Routine, Statement, Variable } from "./syntax.ts";

const RULES: JumpRules<Cursor, Expression, Variable, Statement> = {
  expression: readExpression,
  variable: readVariable,
  statement: readStatement,
  called: "program",
  endOf: word => (word === "DO" ? "UNTIL" : "END"),
};
const CASE: SwitchWords = { opens: "CASE", ends: "END", last: "ANY" };

/** Turns the lines of one program into instructions with jumps. */
export class RoutineBuilder extends JumpBuilder<Cursor, Expression, Variable, Statement> {
  private readonly place: TextPlace;
  private readonly parameters: readonly string[];

  private readonly asText: boolean;

  constructor(name: string, place: TextPlace, parameters: readonly string[], asText: boolean) {
    super(name, { ...RULES, statement: cursor => readStatement(cursor, asText) });
    this.asText = asText;
    this.place = place;
    this.parameters = parameters;
  }

  line(cursor: Cursor): void {
    if (cursor.nextKind === "number") this.readLabel(cursor);
    if (cursor.done) return;
    const at = cursor.here;
    switch (cursor.second === "=" ? "" : cursor.next) {
      case "IF":
        return this.readIf(cursor, at);
      case "ELSE":
        return this.readElse(cursor);
      case "WHILE":
        return this.readWhile(cursor, at, "DO");
      case "DO":
        return this.readDo(cursor);
      case "UNTIL":
        return this.readUntil(cursor, "DO");
      case "FOR":
        return this.readFor(cursor, at);
      case "CASE":
        return this.readSwitch(cursor, at, "OF");
      case "VALUE":
        return this.readCase(cursor, CASE, true);
      case "ANY":
        return this.readLastCase(cursor, CASE);
      case "END":
        return this.readEnd(cursor);
      case "EXIT":
        return this.readExit(cursor, at);
      case "GOTO":
        cursor.take();
        this.readGoto(this.push({ kind: "jump", to: -1, at }), cursor);
        return cursor.expectEnd();
      default:
        this.code.push({ kind: "statement", statement: readStatement(cursor, this.asText) });
    }
  }

  /** @throws {TextError} for a block without its end, or a GOTO to a label that is not there. */
  finish(end: TextPlace): Routine {
    this.close(end);
    return {
      name: this.name,
      place: this.place,
      parameters: this.parameters,
      instructions: this.code,
      slots: this.slots,
    };
  }

  private readLabel(cursor: Cursor): void {
    const at = cursor.here;
    const label = cursor.take();
    if (!/^[0-9]+$/.test(label) || Number(label) > 65535)
      throw new TextError(at, "a label from 0 to 65535", `${label} is no label.`);
    this.label(label, at);
  }

  private readGoto(jump: { to: number }, cursor: Cursor): void {
    const at = cursor.here;
    if (cursor.nextKind !== "number") throw cursor.unexpected("a label");
    this.goto(jump, cursor.take(), at);
  }

  private readIf(cursor: Cursor, at: TextPlace): void {
    cursor.take();
    const condition = readExpression(cursor);
    if (cursor.accept("GOTO")) {
      const over = this.push({ kind: "unless", condition, to: -1 });
      this.readGoto(this.push({ kind: "jump", to: -1, at }), cursor);
      over.to = this.code.length;
    } else {
      cursor.expect("THEN");
      this.openIf(condition, at);
    }
    cursor.expectEnd();
  }

  /** `DO` alone opens a block; `DO statement` is what a terminal would run at once, and does the same here. */
  private readDo(cursor: Cursor): void {
    if (cursor.second === "") return this.begin(cursor, "until");
    cursor.take();
    this.code.push({ kind: "statement", statement: readStatement(cursor, this.asText) });
  }
}
