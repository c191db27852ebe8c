import type { TextPlace } from "@twincell/core";
import { TextError } from "../../text/index.ts";
import type { Cursor } from "./cursor.ts";
import { readExpression, readVariable } from "./expression.ts";
import { readStatement } from "./statement.ts";
import type { Expression, Instruction, Routine, Variable } from "./syntax.ts";

type Jumping = Extract<Instruction, { to: number }>;
/** A block that has been opened and not yet closed, with the jumps that must still learn where to go. */
type Open = { readonly at: TextPlace; readonly word: string; readonly start: number; readonly leaves: Jumping[] } & (
  | { readonly kind: "if"; miss: Jumping | undefined }
  | { readonly kind: "while" | "do" }
  | { readonly kind: "for"; readonly variable: Variable; readonly slot: number }
  | { readonly kind: "case"; readonly slot: number; miss: Jumping | undefined; any: boolean }
);

/** Turns the lines of one program into instructions with jumps, so that GOTO and blocks are one thing. */
export class RoutineBuilder {
  private readonly name: string;
  private readonly place: TextPlace;
  private readonly parameters: readonly string[];
  private readonly code: Instruction[] = [];
  private readonly open: Open[] = [];
  private readonly labels = new Map<string, number>();
  private readonly gotos: { readonly jump: Jumping; readonly label: string; readonly at: TextPlace }[] = [];
  private slots = 0;

  constructor(name: string, place: TextPlace, parameters: readonly string[]) {
    this.name = name;
    this.place = place;
    this.parameters = parameters;
  }

  /** One line of the body. @throws {TextError} */
  line(cursor: Cursor): void {
    if (cursor.nextKind === "number") this.label(cursor);
    if (cursor.done) return;
    const at = cursor.here;
    switch (cursor.second === "=" ? "" : cursor.next) {
      case "IF": return this.readIf(cursor, at);
      case "ELSE": return this.readElse(cursor);
      case "WHILE": return this.readWhile(cursor, at);
      case "DO": return this.readDo(cursor, at);
      case "UNTIL": return this.readUntil(cursor);
      case "FOR": return this.readFor(cursor, at);
      case "CASE": return this.readCase(cursor, at);
      case "VALUE": return this.readValue(cursor);
      case "ANY": return this.readAny(cursor);
      case "END": return this.readEnd(cursor);
      case "EXIT": return this.readExit(cursor, at);
      case "GOTO": cursor.take(); this.goto(this.push({ kind: "jump", to: -1, at }), cursor); return cursor.expectEnd();
      default: this.code.push({ kind: "statement", statement: readStatement(cursor) });
    }
  }

  /** @throws {TextError} for a block without its end, or a GOTO to a label that is not there. */
  finish(end: TextPlace): Routine {
    const block = this.open.at(-1);
    if (block !== undefined) throw new TextError(block.at, block.kind === "do" ? "UNTIL" : "END", `The ${block.word} of line ${block.at.line} is not closed before line ${end.line}.`);
    for (const { jump, label, at } of this.gotos) {
      const to = this.labels.get(label);
      if (to === undefined) throw new TextError(at, "a label of this program", `Label ${label} is not in program ${this.name}.`);
      jump.to = to;
    }
    return { name: this.name, place: this.place, parameters: this.parameters, instructions: this.code, slots: this.slots };
  }

  private label(cursor: Cursor): void {
    const at = cursor.here, label = cursor.take();
    if (!/^[0-9]+$/.test(label) || Number(label) > 65535) throw new TextError(at, "a label from 0 to 65535", `${label} is no label.`);
    if (this.labels.has(label)) throw new TextError(at, "a label used once", `Label ${label} is in program ${this.name} twice.`);
    this.labels.set(label, this.code.length);
  }

  private push<I extends Instruction>(instruction: I): I {
    this.code.push(instruction);
    return instruction;
  }

  private goto(jump: Jumping, cursor: Cursor): void {
    const at = cursor.here;
    if (cursor.nextKind !== "number") throw cursor.unexpected("a label");
    this.gotos.push({ jump, label: cursor.take(), at });
  }

  private readIf(cursor: Cursor, at: TextPlace): void {
    cursor.take();
    const condition = readExpression(cursor);
    if (cursor.accept("GOTO")) {
      const over = this.push({ kind: "unless", condition, to: -1 });
      this.goto(this.push({ kind: "jump", to: -1, at }), cursor);
      over.to = this.code.length;
    } else {
      cursor.expect("THEN");
      this.open.push({ kind: "if", word: "IF", at, start: this.code.length, leaves: [], miss: this.push({ kind: "unless", condition, to: -1 }) });
    }
    cursor.expectEnd();
  }

  private readElse(cursor: Cursor): void {
    const block = this.open.at(-1);
    if (block?.kind !== "if" || block.miss === undefined) throw cursor.unexpected("a statement, since no IF is open");
    block.leaves.push(this.push({ kind: "jump", to: -1, at: cursor.here }));
    block.miss.to = this.code.length;
    block.miss = undefined;
    cursor.take();
    cursor.expectEnd();
  }

  private readWhile(cursor: Cursor, at: TextPlace): void {
    cursor.take();
    const condition = readExpression(cursor), start = this.code.length;
    this.open.push({ kind: "while", word: "WHILE", at, start, leaves: [this.push({ kind: "unless", condition, to: -1 })] });
    cursor.expect("DO");
    cursor.expectEnd();
  }

  /** `DO` alone opens a block; `DO statement` is what a terminal would run at once, and does the same here. */
  private readDo(cursor: Cursor, at: TextPlace): void {
    cursor.take();
    if (cursor.done) this.open.push({ kind: "do", word: "DO", at, start: this.code.length, leaves: [] });
    else this.code.push({ kind: "statement", statement: readStatement(cursor) });
  }

  private readUntil(cursor: Cursor): void {
    const block = this.open.at(-1);
    if (block?.kind !== "do") throw cursor.unexpected("a statement, since no DO is open");
    cursor.take();
    this.push({ kind: "unless", condition: readExpression(cursor), to: block.start });
    cursor.expectEnd();
    this.close(block);
  }

  private readFor(cursor: Cursor, at: TextPlace): void {
    cursor.take();
    const variable = readVariable(cursor);
    cursor.expect("=");
    const from = readExpression(cursor);
    cursor.expect("TO");
    const last = readExpression(cursor);
    const step = cursor.accept("STEP") ? readExpression(cursor) : undefined;
    cursor.expectEnd();
    const slot = this.slots++;
    this.push({ kind: "for", variable, from, last, step, slot });
    const start = this.code.length;
    this.open.push({ kind: "for", word: "FOR", at, start, slot, variable, leaves: [this.push({ kind: "for-check", variable, slot, to: -1 })] });
  }

  private readCase(cursor: Cursor, at: TextPlace): void {
    cursor.take();
    const value = readExpression(cursor);
    cursor.expect("OF");
    cursor.expectEnd();
    const slot = this.slots++;
    this.push({ kind: "case", value, slot });
    this.open.push({ kind: "case", word: "CASE", at, slot, start: this.code.length, leaves: [], miss: undefined, any: false });
  }

  private openCase(cursor: Cursor): Extract<Open, { kind: "case" }> {
    const block = this.open.at(-1);
    if (block?.kind !== "case") throw cursor.unexpected("a statement, since no CASE is open");
    if (block.any) throw cursor.unexpected("END, since ANY is the last branch");
    if (this.code.length > block.start) block.leaves.push(this.push({ kind: "jump", to: -1, at: cursor.here }));
    if (block.miss !== undefined) block.miss.to = this.code.length;
    block.miss = undefined;
    cursor.take();
    return block;
  }

  private readValue(cursor: Cursor): void {
    const block = this.openCase(cursor);
    const values: Expression[] = [readExpression(cursor)];
    while (cursor.accept(",")) values.push(readExpression(cursor));
    cursor.expect(":");
    cursor.expectEnd();
    block.miss = this.push({ kind: "case-unless", values, slot: block.slot, to: -1 });
  }

  private readAny(cursor: Cursor): void {
    this.openCase(cursor).any = true;
    cursor.accept(":");
    cursor.expectEnd();
  }

  private readEnd(cursor: Cursor): void {
    const block = this.open.at(-1);
    if (block === undefined || block.kind === "do") throw cursor.unexpected(block === undefined ? "a statement, since no block is open" : "UNTIL");
    const at = cursor.here;
    cursor.take();
    cursor.expectEnd();
    if (block.kind === "while") this.push({ kind: "jump", to: block.start, at });
    if (block.kind === "for") this.push({ kind: "for-next", variable: block.variable, slot: block.slot, to: block.start });
    if ((block.kind === "if" || block.kind === "case") && block.miss !== undefined) block.miss.to = this.code.length;
    this.close(block);
  }

  /** Leaves the innermost loop. */
  private readExit(cursor: Cursor, at: TextPlace): void {
    const loop = this.open.findLast(block => block.kind === "for" || block.kind === "while" || block.kind === "do");
    if (loop === undefined) throw cursor.unexpected("a statement, since no loop is open");
    cursor.take();
    cursor.expectEnd();
    loop.leaves.push(this.push({ kind: "jump", to: -1, at }));
  }

  private close(block: Open): void {
    for (const jump of block.leaves) jump.to = this.code.length;
    this.open.pop();
  }
}
