import type { TextFault } from "@twincell/core";
import { TextError, LineReader } from "../../parser/index.ts";
import { RoutineBuilder } from "./blocks.ts";
import { Cursor } from "./cursor.ts";
import { readDeclarations, readHeader, readSignal } from "./declaration.ts";
import { readStatement } from "./statement.ts";
import type { Declaration, Module, Routine, SignalDeclaration, Source, Statement } from "./syntax.ts";

export type SourceAnswer =
  | { readonly kind: "source"; readonly source: Source }
  | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] };

const QUIET = /^\s*(?:;|$)/;
/** Stands at the head of every file that the controller keeps. */
const ATTRIBUTE = /^\s*&/;
/** What stands in it is known to every module. */
const SHARED_LIST = "$CONFIG";

/**
 * Reads modules: each a .src with or without its .dat, in one text, that of the main routine first. A module begins
 * where attribute lines (`&ACCESS`) do, or with a routine that has a data list of its name. Folds are comments. Goes on
 * after a fault, so that all of them are told at once.
 */
export function readSource(text: string): SourceAnswer {
  const lists = Array.from(text.matchAll(/^[ \t]*DEFDAT[ \t]+([\w$]+)/gim), match => match[1]!.toUpperCase());
  const reader = new SourceReader(new Set(lists));
  const wrong = reader.read(text);
  if (wrong !== undefined) return wrong;
  const { modules, signals, main } = reader;
  const shared = new Map<string, Routine>();
  for (const module of modules.values())
    for (const [i, routine] of [...module.routines.values()].entries())
      if ((i === 0 || module.shared.has(routine.name)) && !shared.has(routine.name)) shared.set(routine.name, routine);
  return { kind: "source", source: { modules, main, shared, signals } };
}

/** A module that is being read. */
interface OpenModule extends Module {
  readonly routines: Map<string, Routine>;
  readonly data: Declaration[];
  readonly elements: Extract<Statement, { kind: "assign" }>[];
  /** Routines that were called GLOBAL. */
  readonly shared: Set<string>;
}

const openModule = (name: string): OpenModule => ({
  name,
  routines: new Map(),
  data: [],
  elements: [],
  shared: new Set(),
});

class SourceReader extends LineReader {
  readonly modules = new Map<string, OpenModule>();
  readonly signals: SignalDeclaration[] = [];
  main: Routine | undefined;
  private readonly lists: ReadonlySet<string>;
  private current: OpenModule | undefined;
  private begins = true;
  private section: "outside" | "data" | "routine" = "outside";
  private builder: RoutineBuilder | undefined;
  private opened = 0;
  private word = "";

  /** @param lists  names of the data lists of the text. */
  constructor(lists: ReadonlySet<string>) {
    super();
    this.lists = lists;
  }

  /** An attribute line: a file begins. */
  private attribute(): void {
    if (this.section === "outside") this.begins = true;
  }

  private module(name: string): OpenModule {
    const known = this.modules.get(name);
    if (known !== undefined) return known;
    const made = openModule(name);
    this.modules.set(name, made);
    return made;
  }

  // What is wrong in another file than that of the program matters where it is reached.
  protected override fault(cause: TextError): void {
    if (this.isElsewhere && this.current !== undefined) this.builder?.fault(cause);
    else super.fault(cause);
  }

  protected line(text: string, line: number): void {
    if (QUIET.test(text)) return;
    if (ATTRIBUTE.test(text)) return this.attribute();
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
    return this.content(cursor);
  }

  /** A line of a data list or of a routine. */
  private content(cursor: Cursor): void {
    const declared = readDeclarations(cursor);
    if (declared !== undefined)
      (this.section === "data" ? this.current!.data : this.builder!.declarations).push(
        ...(this.section === "data" && this.current!.name === SHARED_LIST
          ? declared.map(each => ({ ...each, isGlobal: true }))
          : declared),
      );
    else if (this.section === "data") this.element(cursor);
    else this.builder!.line(cursor);
  }

  /** An element of an array in the data list. */
  private element(cursor: Cursor): void {
    if (cursor.second !== "[" && cursor.second !== "=" && cursor.second !== ".")
      throw cursor.unexpected("a declaration");
    const statement = readStatement(cursor);
    if (statement.kind === "assign") this.current!.elements.push(statement);
  }

  protected end(line: number): void {
    if (this.section === "outside") {
      if (this.modules.size === 0) throw new TextError({ line: 1, column: 1 }, "DEF", "The text has no routine.");
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
    const isShared = cursor.accept("GLOBAL");
    cursor.take();
    if (word === "DEFDAT") {
      this.section = "data";
      // Something to put lines into even when the name is at fault.
      this.current = openModule("");
      this.current = this.module(cursor.name("the name of the data list"));
      this.begins = true;
      cursor.accept("PUBLIC");
      return cursor.expectEnd();
    }
    this.section = "routine";
    // Something to put lines into even when the header is at fault.
    this.builder = new RoutineBuilder("", "", cursor.here, word === "DEFFCT", []);
    const { name, place, parameters } = readHeader(cursor, word === "DEFFCT");
    if (this.current === undefined || (this.begins && !this.current.routines.has(name)) || this.isOfAnother(name))
      this.current = this.module(name);
    this.begins = false;
    this.builder = new RoutineBuilder(name, this.current.name, place, word === "DEFFCT", parameters);
    if (isShared) this.current.shared.add(name);
    if (this.current.routines.has(name))
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
      const routine = this.isElsewhere ? builder.finishOrFault(place) : builder.finish(place);
      this.current?.routines.set(routine.name, routine);
      this.main ??= routine;
    }
    cursor.expectEnd();
  }

  private get isElsewhere(): boolean {
    return this.main !== undefined && this.current?.name !== this.main.module;
  }

  /** A routine with a data list of its name is the first of its module. */
  private isOfAnother(name: string): boolean {
    return this.lists.has(name) && this.current?.name !== name;
  }
}
