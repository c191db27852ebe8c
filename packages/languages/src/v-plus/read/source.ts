import type { TextFault } from "@twincell/core";
import { TextError, LineReader } from "../../parser/index.ts";
import { RoutineBuilder } from "./blocks.ts";
import { Cursor } from "./cursor.ts";
import { checkName, readExpression, readVariable } from "./expression.ts";
import { readStatement } from "./statement.ts";
import type { Expression, Routine, Source, Statement } from "./syntax.ts";

export type SourceAnswer =
  | { readonly kind: "source"; readonly source: Source }
  | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] };

/** Reads a V+ disk file or a list of terminal commands. Goes on after a fault, so that all of them are told at once. */
/** @param asText  the text is only executed: statements that do not move the arm may be left out and told. */
export function readSource(text: string, asText = false): SourceAnswer {
  const reader = new SourceReader(asText);
  const wrong = reader.read(text);
  if (wrong !== undefined) return wrong;
  return { kind: "source", source: { routines: reader.routines, immediate: reader.immediate, data: reader.data } };
}

type Section = "terminal" | "program" | ".LOCATIONS" | ".REALS" | ".STRINGS";

class SourceReader extends LineReader {
  readonly routines = new Map<string, Routine>();
  readonly immediate: Statement[] = [];
  readonly data: Statement[] = [];
  private section: Section = "terminal";
  private builder: RoutineBuilder | undefined;
  private opened = 0;
  private readonly asText: boolean;

  constructor(asText: boolean) {
    super();
    this.asText = asText;
  }

  protected line(text: string, line: number): void {
    const dot = /^\s*(\.[A-Za-z]+)/.exec(text);
    if (dot !== null) return this.dotLine(dot[1]!.toUpperCase(), text, line, dot[0].length);
    const cursor = new Cursor(text, line);
    if (cursor.done) return;
    if (this.section === "program") this.builder?.line(cursor);
    else if (this.section === "terminal") this.terminalLine(cursor);
    else this.data.push(dataLine(cursor, this.section));
  }

  protected end(line: number): void {
    if (this.section === "terminal") return;
    throw new TextError(
      { line, column: 1 },
      ".END",
      `The ${this.section === "program" ? ".PROGRAM" : this.section} of line ${this.opened} has no .END.`,
    );
  }

  private terminalLine(cursor: Cursor): void {
    cursor.accept("DO");
    this.immediate.push(readStatement(cursor, this.asText));
  }

  private dotLine(word: string, text: string, line: number, at: number): void {
    const place = { line, column: at - word.length + 1 };
    if (word === ".END") {
      if (this.section === "terminal") throw new TextError(place, ".PROGRAM", ".END closes nothing here.");
      const builder = this.builder;
      this.section = "terminal";
      this.builder = undefined;
      if (builder !== undefined) {
        const routine = builder.finish(place);
        this.routines.set(routine.name, routine);
      }
      return;
    }
    if (this.section !== "terminal")
      throw new TextError(
        place,
        ".END",
        `${word} stands inside the ${this.section === "program" ? ".PROGRAM" : this.section} of line ${this.opened}.`,
      );
    this.opened = line;
    if (word === ".LOCATIONS" || word === ".REALS" || word === ".STRINGS") {
      this.section = word;
      return;
    }
    if (word !== ".PROGRAM")
      throw new TextError(
        place,
        ".PROGRAM, .LOCATIONS, .REALS or .STRINGS",
        `"${word}" opens no section of a V+ file.`,
      );
    this.section = "program";
    this.header(new Cursor(" ".repeat(at) + text.slice(at), line));
  }

  private header(cursor: Cursor): void {
    const place = cursor.here;
    if (cursor.nextKind !== "word") throw cursor.unexpected("the name of the program");
    const name = cursor.take().toLowerCase();
    const parameters: string[] = [];
    this.builder = new RoutineBuilder(name, place, parameters, this.asText);
    checkName(name, place);
    if (cursor.accept("(")) {
      if (cursor.next !== ")")
        do parameters.push(readVariable(cursor).name);
        while (cursor.accept(","));
      cursor.expect(")");
    }
    cursor.expectEnd();
    if (this.routines.has(name))
      throw new TextError(place, "a program name used once", `Program ${name} is in the file twice.`);
  }
}

/** `name x y z y p r`, `#name j1 … jn`, `name value`, `$name "text"`. */
function dataLine(cursor: Cursor, section: Section): Statement {
  const { line, column } = cursor.here;
  const to = readVariable(cursor);
  if (section === ".STRINGS") return { kind: "assign", to, value: readExpression(cursor), line, column };
  const values: Expression[] = [];
  while (!cursor.done) {
    const at = cursor.here;
    const minus = cursor.accept("-");
    if (cursor.nextKind !== "number") throw cursor.unexpected("a number");
    values.push({ kind: "number", value: Number(cursor.take()) * (minus ? -1 : 1), line: at.line, column: at.column });
    cursor.accept(",");
  }
  if (section === ".REALS") {
    if (values.length !== 1)
      throw new TextError({ line, column }, "one number", `A real has one value; "${to.name}" has ${values.length}.`);
    return { kind: "assign", to, value: values[0]!, line, column };
  }
  const name = to.name.startsWith("#") ? "#PPOINT" : "TRANS";
  return { kind: "set", to, value: { kind: "call", name, args: values, line, column }, line, column };
}
