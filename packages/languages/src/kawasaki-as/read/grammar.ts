import type { TextFault, TextPlace } from "@twincell/core";
import { TextError, textFault } from "../../parser/index.ts";
import {
  readExpression,
  type Argument,
  type Block,
  type Expression,
  type Parameter,
  type Routine,
  type Statement,
} from "../../parser/structured/index.ts";
import { programsOf } from "./sections.ts";
import { StatementReader, RESERVED, RULES } from "./statements.ts";

/**
 * A text that was read: what a person called it, the program that is started, and those that it calls, under the name
 * `call x`. The lists of locations come first in it.
 */
export interface Source {
  readonly title: string;
  readonly routines: ReadonlyMap<string, Routine>;
  readonly main: Block;
  /** Statements that are kept and not executed. */
  readonly kept: readonly TextFault[];
}

export type SourceAnswer =
  | { readonly kind: "source"; readonly source: Source }
  | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] };

/** Reads AS. Names are lower case. Goes on after a fault, so that all of them are told at once. */
export const readSource = (text: string, asText = false): SourceAnswer => new Reader(programsOf(text), asText).source();

export class Reader extends StatementReader {
  private readonly deferred = new Map<string, readonly TextFault[]>();

  source(): SourceAnswer {
    const { cursor, routines } = this;
    this.guard(() => {
      cursor.advance();
    });
    while (!cursor.done && !this.hasEnough) {
      if (cursor.isAt("line-end")) {
        this.guard(() => {
          cursor.advance();
        });
        continue;
      }
      this.guard(() => {
        this.part();
      });
    }
    const first = [...routines.values()].find(({ name }) => !this.called.has(name)) ?? [...routines.values()][0];
    if (first === undefined && this.faults.length === 0)
      this.faults.push(new TextError(cursor.here, ".PROGRAM", "The text holds no program.").fault);
    this.faults.push(...(this.deferred.get(first?.name ?? "") ?? []));
    if (this.faults.length > 0 || first === undefined) return { kind: "not-understood", faults: this.faults };
    for (const [name, faults] of this.deferred) this.defer(name, faults[0]!);
    routines.delete(`call ${first.name}`);
    return {
      kind: "source",
      source: {
        title: titleOf(first.body) ?? first.name,
        routines,
        main: [...this.lists, ...first.body],
        kept: this.kept,
      },
    };
  }

  /** What is not understood in a program that is not started matters where it is called. */
  private defer(name: string, { line, column, expected, sentence }: TextFault): void {
    const at = { line, column };
    const routine = this.routines.get(`call ${name}`);
    if (routine === undefined) return;
    const text = (value: string): Argument => ({ value: { kind: "text", value, ...at }, ...at });
    const fault: Statement = { kind: "do", name: "fault", args: [text(expected), text(sentence)], ...at };
    this.routines.set(`call ${name}`, { ...routine, body: [fault] });
    this.kept.push(textFault(at, expected, `${sentence} The program ${name} is refused where it is called.`));
  }

  protected override closes(word: string): boolean {
    return word === ".end";
  }

  /** `.PROGRAM … .END`, `.TRANS … .END` and their like. */
  private part(): void {
    const { cursor } = this;
    const at = cursor.here;
    const word = cursor.next;
    if (cursor.kind !== "word" || !word.startsWith(".")) throw cursor.unexpected(".PROGRAM");
    cursor.advance();
    switch (word) {
      case ".program":
        this.program(at);
        return;
      case ".trans":
      case ".joints":
        this.list(word, at);
        return;
      case ".reals":
      case ".strings":
      case ".integer":
        this.reals(at);
        return;
      case ".end":
        throw new TextError(at, ".PROGRAM", '".END" stands where nothing is open.');
      default:
        throw new TextError(at, ".PROGRAM", `"${word.toUpperCase()}" stands where a program is expected.`);
    }
  }

  private program(at: TextPlace): void {
    const { cursor } = this;
    const place = cursor.here;
    const name = cursor.name("the name of the program");
    const parameters: Parameter[] = [];
    if (RESERVED.has(name))
      throw new TextError(place, "a name that is no word of the language", `"${name}" is a word of AS.`);
    if (cursor.accept("(")) {
      while (!cursor.accept(")")) {
        parameters.push({ name: cursor.name("the name of a parameter"), type: "", optional: true, isBack: true });
        if (!cursor.accept(",") && cursor.next !== ")") throw cursor.unexpected('"," or ")"');
      }
    }
    // Behind the name the controller keeps the date of the last change.
    if (cursor.next === "@" || cursor.next === "#") this.restOfLine();
    if (!cursor.isAt("line-end")) throw cursor.unexpected("the end of the line");
    if (this.routines.has(`call ${name}`))
      this.faults.push(new TextError(place, "a name used once", `The program ${name} is there twice.`).fault);
    const before = this.faults.length;
    const body = this.body("program", at, [".end"]);
    cursor.expect(".end");
    this.endOfProgram();
    if (this.asText && this.faults.length > before) this.deferred.set(name, this.faults.splice(before));
    this.routines.set(`call ${name}`, { name, parameters, body, ...place });
  }

  /** `name x y z o a t` or `#name jt1 … jt6`, one a line. */
  private list(kind: ".trans" | ".joints", at: TextPlace): void {
    this.entries(kind, at, (to, place, numbers) => {
      const call: Expression = {
        kind: "call",
        name: kind === ".trans" ? "trans" : "#ppoint",
        args: numbers.map(value => ({ value, line: value.line, column: value.column })),
        ...place,
      };
      this.lists.push({ kind: "assign", to, value: call, global: true, ...place });
    });
  }

  private reals(at: TextPlace): void {
    this.entries(".reals", at, (to, place, numbers) => {
      if (numbers.length !== 1)
        throw new TextError(place, "one number", `${numbers.length} numbers stand where one is expected.`);
      this.lists.push({ kind: "assign", to, value: numbers[0]!, global: true, ...place });
    });
  }

  private entries(
    kind: string,
    at: TextPlace,
    add: (to: Expression, place: TextPlace, numbers: Expression[]) => void,
  ): void {
    const { cursor } = this;
    for (;;) {
      while (cursor.isAt("line-end")) cursor.advance();
      if (cursor.done)
        throw new TextError(cursor.here, ".END", `The ${kind.toUpperCase()} of line ${at.line} is not closed.`);
      if (cursor.accept(".end")) return;
      this.guard(() => {
        const place = cursor.here;
        const to = readExpression(cursor, RULES, 0, 100);
        const numbers: Expression[] = [];
        cursor.accept("=");
        while (!cursor.isAt("line-end") && !cursor.done) {
          numbers.push(readExpression(cursor, RULES, 0, 6));
          cursor.accept(",");
        }
        add(to, place, numbers);
      });
      if (this.hasEnough) return;
    }
  }
}

/** `;* Title` at the top. */
function titleOf(block: Block): string | undefined {
  const first = block[0];
  return first?.kind === "comment" && first.text.startsWith("*") ? first.text.slice(1).trim() : undefined;
}
