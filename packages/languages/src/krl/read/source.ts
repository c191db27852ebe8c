import type { TextFault } from "@twincell/core";
import { TextError, textLines } from "../../parser/index.ts";
import { RoutineBuilder } from "./blocks.ts";
import { Cursor } from "./cursor.ts";
import { readDeclarations, readHeader, readSignal } from "./declaration.ts";
import { readStatement } from "./statement.ts";
import type { Declaration, Routine, SignalDeclaration, Source, Statement } from "./syntax.ts";

export type SourceAnswer =
  | { readonly kind: "source"; readonly source: Source }
  | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] };

/** More faults than this help nobody. */
const MOST_FAULTS = 50;
const QUIET = /^\s*(?:;|&|$)/;

/**
 * Reads a module: a .src with or without its .dat behind it, in one text. Attribute lines (`&ACCESS`) and folds are
 * comments. Goes on after a fault, so that all of them are told at once.
 */
export function readSource(text: string): SourceAnswer {
  const reader = new SourceReader();
  const lines = textLines(text);
  for (const [i, line] of lines.entries()) {
    if (QUIET.test(line)) continue;
    reader.guard(() => {
      reader.line(line, i + 1);
    });
    if (reader.faults.length >= MOST_FAULTS) break;
  }
  reader.guard(() => {
    reader.end(lines.length + 1);
  });
  if (reader.faults.length > 0) return { kind: "not-understood", faults: reader.faults };
  const { routines, data, elements, signals, dataLine } = reader;
  return { kind: "source", source: { routines, data, elements, signals, dataLine } };
}

class SourceReader {
  readonly faults: TextFault[] = [];
  readonly routines = new Map<string, Routine>();
  readonly data: Declaration[] = [];
  readonly elements: Extract<Statement, { kind: "assign" }>[] = [];
  readonly signals: SignalDeclaration[] = [];
  dataLine: number | undefined;
  private section: "outside" | "data" | "routine" = "outside";
  private builder: RoutineBuilder | undefined;
  private opened = 0;
  private word = "";

  guard(read: () => void): void {
    try {
      read();
    } catch (cause) {
      if (!(cause instanceof TextError)) throw cause;
      this.faults.push(cause.fault);
    }
  }

  line(text: string, line: number): void {
    const cursor = new Cursor(text, line);
    if (cursor.done) return;
    const first = cursor.next === "GLOBAL" ? cursor.second : cursor.next;
    if (cursor.second !== "=" && (first === "DEF" || first === "DEFFCT" || first === "DEFDAT"))
      return this.begin(cursor, first, line);
    if (this.section === "outside") throw cursor.unexpected("DEF, DEFFCT or DEFDAT");
    const end = this.section === "data" ? "ENDDAT" : this.word === "DEFFCT" ? "ENDFCT" : "END";
    if (first === end || first === "END" || first === "ENDFCT" || first === "ENDDAT") return this.close(cursor, end);
    if (first === "SIGNAL") {
      this.signals.push(readSignal(cursor));
      return;
    }
    const declared = readDeclarations(cursor);
    if (declared !== undefined) (this.section === "data" ? this.data : this.builder!.declarations).push(...declared);
    else if (this.section === "data") this.element(cursor);
    else this.builder!.line(cursor);
  }

  /** An element of an array in the data list. */
  private element(cursor: Cursor): void {
    if (cursor.second !== "[" && cursor.second !== "=" && cursor.second !== ".")
      throw cursor.unexpected("a declaration");
    const statement = readStatement(cursor);
    if (statement.kind === "assign") this.elements.push(statement);
  }

  end(line: number): void {
    if (this.section === "outside") {
      if (this.routines.size === 0 && this.dataLine === undefined)
        throw new TextError({ line: 1, column: 1 }, "DEF", "The text has no routine.");
      return;
    }
    throw new TextError(
      { line, column: 1 },
      this.section === "data" ? "ENDDAT" : "END",
      `The ${this.word} of line ${this.opened} is not closed.`,
    );
  }

  private begin(cursor: Cursor, word: string, line: number): void {
    if (this.section !== "outside") throw cursor.unexpected(`the end of the ${this.word} of line ${this.opened}`);
    this.word = word;
    this.opened = line;
    if (cursor.accept("GLOBAL")) {
      /* Every routine of this text can be called here. */
    }
    cursor.take();
    if (word === "DEFDAT") {
      this.section = "data";
      this.dataLine ??= line;
      cursor.name("the name of the data list");
      cursor.accept("PUBLIC");
      return cursor.expectEnd();
    }
    this.section = "routine";
    // Something to put lines into even when the header is at fault.
    this.builder = new RoutineBuilder("", cursor.here, word === "DEFFCT", []);
    const { name, place, parameters } = readHeader(cursor, word === "DEFFCT");
    this.builder = new RoutineBuilder(name, place, word === "DEFFCT", parameters);
    if (this.routines.has(name))
      throw new TextError(place, "a routine name used once", `Routine ${name} is in the text twice.`);
  }

  private close(cursor: Cursor, wanted: string): void {
    if (cursor.next !== wanted) throw cursor.unexpected(wanted);
    const place = cursor.here;
    const builder = this.builder;
    cursor.take();
    this.section = "outside";
    this.builder = undefined;
    if (builder !== undefined) {
      const routine = builder.finish(place);
      this.routines.set(routine.name, routine);
    }
    cursor.expectEnd();
  }
}
