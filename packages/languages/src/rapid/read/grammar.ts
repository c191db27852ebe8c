import type { TextFault } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Parameter, Routine } from "../../parser/structured/index.ts";
import { StatementReader, type DataDeclaration, type Component, ownName } from "./statements.ts";

/** What a text holds. Names are lower case; `spelling` has them as they were first written. */
export interface Source {
  readonly title: string;
  readonly data: readonly DataDeclaration[];
  readonly routines: ReadonlyMap<string, Routine>;
  /** Data of the routines, by routine. */
  readonly local: ReadonlyMap<string, readonly DataDeclaration[]>;
  /** Routines whose error handler goes on behind a search that found nothing. */
  readonly forgiving: ReadonlySet<string>;
  readonly spelling: ReadonlyMap<string, string>;
  /** Components of the records that the text declares: name and type of each, by the type. */
  readonly records: ReadonlyMap<string, readonly Component[]>;
  /** Names that a module keeps for itself, by the module; empty for a text of one module. */
  readonly own: ReadonlyMap<string, ReadonlySet<string>>;
  /** The module of a routine, by its name. */
  readonly moduleOf: ReadonlyMap<string, string>;
  /** Whether a routine jumps by GOTO. */
  readonly hasJumps: boolean;
}

export type SourceAnswer =
  | { readonly kind: "source"; readonly source: Source }
  | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] };

/** Reads RAPID modules. Goes on after a fault, so that all of them are told at once. */
export const readSource = (text: string): SourceAnswer => new Reader(text).source();

export class Reader extends StatementReader {
  source(): SourceAnswer {
    const { cursor } = this;
    this.guard(() => {
      cursor.advance();
    });
    while (!cursor.done && !this.hasEnough) {
      this.guard(() => {
        cursor.expect("module");
        this.modules++;
        this.module();
      });
    }
    if (this.modules === 0 && this.faults.length === 0)
      this.faults.push(new TextError(cursor.here, "MODULE", "The text holds no module.").fault);
    if (this.faults.length > 0) return { kind: "not-understood", faults: this.faults };
    const { data, routines, local, forgiving, spelling, records, moduleOf, hasJumps } = this;
    const own = this.modules > 1 ? this.own : new Map<string, ReadonlySet<string>>();
    const title =
      this.remarks
        .find(remark => remark.startsWith("*"))
        ?.slice(1)
        .trim() ?? this.title;
    return {
      kind: "source",
      source: { title, data, routines, local, forgiving, spelling, records, own, moduleOf, hasJumps },
    };
  }

  private module(): void {
    const { cursor } = this;
    // Generators name modules by numbers too, which the controller lets pass when it loads them.
    if (cursor.isAt("number")) cursor.advance();
    const { raw } = cursor;
    const { name: inside } = this.declared("the name of the module");
    this.inside = this.own.has(inside) ? `${inside}#${this.modules}` : inside;
    this.own.set(this.inside, new Set());
    if (this.title === "") this.title = raw;
    if (cursor.accept("(")) {
      while (!cursor.accept(")")) {
        if (cursor.done) throw cursor.unexpected('")"');
        cursor.advance();
      }
    }
    while (cursor.next !== "endmodule") {
      this.takeRemarks();
      if (cursor.done) throw cursor.unexpected("ENDMODULE");
      if (this.hasEnough) return;
      const before = cursor.here;
      this.guard(() => {
        this.member();
      });
      // What is left where a fault was is left behind.
      if (before.line === cursor.here.line && before.column === cursor.here.column && !cursor.done)
        this.guard(() => {
          cursor.advance();
        });
    }
    this.takeRemarks();
    cursor.expect("endmodule");
  }

  private member(): void {
    const { cursor } = this;
    let isOwn = false;
    while (cursor.next === "local" || cursor.next === "task") {
      isOwn ||= cursor.next === "local";
      cursor.advance();
    }
    switch (cursor.next) {
      case "const":
      case "pers":
      case "var":
        this.datum(this.data, isOwn);
        return;
      case "record":
        this.record();
        return;
      case "alias":
        cursor.skip(each => each.next === ";");
        cursor.accept(";");
        return;
      case "proc":
        this.routine("endproc", false, isOwn);
        return;
      case "func":
        this.routine("endfunc", true, isOwn);
        return;
      case "trap":
        this.routine("endtrap", false, isOwn);
        return;
      default:
        throw cursor.unexpected("a declaration, PROC or ENDMODULE");
    }
  }

  /** `RECORD part  num count; robtarget place; ENDRECORD` */
  private record(): void {
    const { cursor } = this;
    cursor.advance();
    const { name } = this.declared("the name of the record");
    const components: Component[] = [];
    while (!cursor.accept("endrecord")) {
      if (cursor.done) throw cursor.unexpected("ENDRECORD");
      if (cursor.accept(";")) continue;
      const type = cursor.name("the type of the component");
      components.push({ name: cursor.name("the name of the component"), type });
      cursor.expect(";");
    }
    this.records.set(name, components);
  }

  private routine(end: string, hasType: boolean, isOwn: boolean): void {
    const { cursor } = this;
    const opened = cursor.here;
    cursor.advance();
    if (hasType) cursor.name("the type of the function");
    const { name: spelt, at } = this.declared("the name of the routine");
    const isElsewhere = this.modules > 1;
    const isHidden = isElsewhere && (isOwn || this.routines.has(spelt));
    const name = isHidden ? ownName(spelt, this.inside) : spelt;
    if (isHidden) this.own.get(this.inside)!.add(spelt);
    const parameters: Parameter[] = [];
    if (cursor.accept("(")) this.parameters(parameters);
    if (this.routines.has(name))
      this.faults.push(new TextError(at, "a name used once", `The routine ${name} is declared twice.`).fault);
    const local: DataDeclaration[] = [];
    this.local.set(name, local);
    this.current = local;
    const body = this.body(opened, [end, "error", "undo", "backward"]);
    this.current = undefined;
    while (cursor.next !== end) this.handler(name, end);
    cursor.expect(end);
    this.routines.set(name, { name, parameters, body, ...at });
    this.moduleOf.set(name, this.inside);
  }

  private parameters(into: Parameter[]): void {
    const { cursor } = this;
    while (!cursor.accept(")")) {
      const optional = cursor.accept("\\");
      if (cursor.accept("switch")) {
        into.push({ name: this.declared("the name of the parameter").name, type: "switch", optional: true });
      } else {
        const isBack = cursor.next === "inout" || cursor.next === "var" || cursor.next === "pers";
        if (isBack) cursor.advance();
        const type = cursor.name("the type of the parameter");
        const { name } = this.declared("the name of the parameter");
        if (cursor.accept("{")) {
          while (cursor.accept("*") || cursor.accept(",")) {
            /* an array of any size */
          }
          cursor.expect("}");
        }
        into.push({ name, type, ...(optional ? { optional } : {}), ...(isBack ? { isBack } : {}) });
      }
      if (!cursor.accept(",") && !cursor.accept("|") && cursor.next !== ")" && cursor.next !== "\\")
        throw cursor.unexpected('"," or ")"');
    }
  }
}
