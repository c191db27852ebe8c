import type { TextPlace } from "@twincell/core";
import { TextError } from "../../text/index.ts";
import type { Cursor } from "./cursor.ts";
import { readExpression, readVariable } from "./expression.ts";
import { readStatement } from "./statement.ts";
import type { Declaration, Expression, Instruction, Parameter, Routine, Variable } from "./syntax.ts";

type Jumping = Extract<Instruction, { to: number }>;
/** A block that has been opened and not yet closed, with the jumps that must still learn where to go. */
type Open = { readonly at: TextPlace; readonly word: string; readonly start: number; readonly leaves: Jumping[] } & (
  | { readonly kind: "IF"; miss: Jumping | undefined }
  | { readonly kind: "LOOP" | "WHILE" | "REPEAT" }
  | { readonly kind: "FOR"; readonly variable: Variable; readonly slot: number }
  | { readonly kind: "SWITCH"; readonly slot: number; miss: Jumping | undefined; isLast: boolean }
);
const ENDS = { IF: "ENDIF", LOOP: "ENDLOOP", WHILE: "ENDWHILE", REPEAT: "UNTIL", FOR: "ENDFOR", SWITCH: "ENDSWITCH" } as const;

/** Turns the lines of one routine into instructions with jumps, so that GOTO and blocks are one thing. */
export class RoutineBuilder {
  readonly name: string;
  readonly isFunction: boolean;
  readonly declarations: Declaration[] = [];
  private readonly place: TextPlace;
  private readonly parameters: readonly Parameter[];
  private readonly code: Instruction[] = [];
  private readonly open: Open[] = [];
  private readonly labels = new Map<string, number>();
  private readonly gotos: { readonly jump: Jumping; readonly label: string; readonly at: TextPlace }[] = [];
  private slots = 0;

  constructor(name: string, place: TextPlace, isFunction: boolean, parameters: readonly Parameter[]) {
    this.name = name;
    this.place = place;
    this.isFunction = isFunction;
    this.parameters = parameters;
  }

  /** One line of the body. @throws {TextError} */
  line(cursor: Cursor): void {
    if (cursor.nextKind === "word" && cursor.second === ":") return this.label(cursor);
    const at = cursor.here;
    switch (cursor.second === "=" ? "" : cursor.next) {
      case "IF": return this.readIf(cursor, at);
      case "ELSE": return this.readElse(cursor);
      case "FOR": return this.readFor(cursor, at);
      case "LOOP": return this.begin(cursor, { kind: "LOOP", word: "LOOP", at, start: this.code.length, leaves: [] });
      case "REPEAT": return this.begin(cursor, { kind: "REPEAT", word: "REPEAT", at, start: this.code.length, leaves: [] });
      case "WHILE": return this.readWhile(cursor, at);
      case "SWITCH": return this.readSwitch(cursor, at);
      case "CASE": return this.readCase(cursor);
      case "DEFAULT": return this.readDefault(cursor);
      case "UNTIL": return this.readUntil(cursor);
      case "ENDIF": case "ENDLOOP": case "ENDWHILE": case "ENDFOR": case "ENDSWITCH": return this.readEnd(cursor);
      case "EXIT": return this.readExit(cursor, at);
      case "GOTO": {
        cursor.take();
        const to = cursor.here, label = cursor.name("a label");
        this.gotos.push({ jump: this.push({ kind: "jump", to: -1, at }), label, at: to });
        return cursor.expectEnd();
      }
      default: this.code.push({ kind: "statement", statement: readStatement(cursor) });
    }
  }

  /** @throws {TextError} for a block without its end, or a GOTO to a label that is not there. */
  finish(end: TextPlace): Routine {
    const block = this.open.at(-1);
    if (block !== undefined) throw new TextError(block.at, ENDS[block.kind], `The ${block.word} of line ${block.at.line} is not closed before line ${end.line}.`);
    for (const { jump, label, at } of this.gotos) {
      const to = this.labels.get(label);
      if (to === undefined) throw new TextError(at, "a label of this routine", `Label ${label} is not in routine ${this.name}.`);
      jump.to = to;
    }
    const { name, place, isFunction, parameters, declarations, slots } = this;
    return { name, place, isFunction, parameters, declarations, instructions: this.code, slots };
  }

  private begin(cursor: Cursor, block: Open): void {
    cursor.take();
    cursor.expectEnd();
    this.open.push(block);
  }

  private label(cursor: Cursor): void {
    const at = cursor.here, label = cursor.name();
    cursor.take();
    cursor.expectEnd();
    if (this.labels.has(label)) throw new TextError(at, "a label used once", `Label ${label} is in routine ${this.name} twice.`);
    this.labels.set(label, this.code.length);
  }

  private push<I extends Instruction>(instruction: I): I {
    this.code.push(instruction);
    return instruction;
  }

  private readIf(cursor: Cursor, at: TextPlace): void {
    cursor.take();
    const condition = readExpression(cursor);
    cursor.expect("THEN");
    cursor.expectEnd();
    this.open.push({ kind: "IF", word: "IF", at, start: this.code.length, leaves: [], miss: this.push({ kind: "unless", condition, to: -1 }) });
  }

  private readElse(cursor: Cursor): void {
    const block = this.open.at(-1);
    if (block?.kind !== "IF" || block.miss === undefined) throw cursor.unexpected("a statement, since no IF is open");
    block.leaves.push(this.push({ kind: "jump", to: -1, at: cursor.here }));
    block.miss.to = this.code.length;
    block.miss = undefined;
    cursor.take();
    cursor.expectEnd();
  }

  private readWhile(cursor: Cursor, at: TextPlace): void {
    cursor.take();
    const condition = readExpression(cursor), start = this.code.length;
    cursor.expectEnd();
    this.open.push({ kind: "WHILE", word: "WHILE", at, start, leaves: [this.push({ kind: "unless", condition, to: -1 })] });
  }

  private readUntil(cursor: Cursor): void {
    const block = this.open.at(-1);
    if (block?.kind !== "REPEAT") throw cursor.unexpected("a statement, since no REPEAT is open");
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
    this.open.push({ kind: "FOR", word: "FOR", at, start, slot, variable, leaves: [this.push({ kind: "for-check", variable, slot, to: -1 })] });
  }

  private readSwitch(cursor: Cursor, at: TextPlace): void {
    cursor.take();
    const value = readExpression(cursor);
    cursor.expectEnd();
    const slot = this.slots++;
    this.push({ kind: "switch", value, slot });
    this.open.push({ kind: "SWITCH", word: "SWITCH", at, slot, start: this.code.length, leaves: [], miss: undefined, isLast: false });
  }

  private openSwitch(cursor: Cursor): Extract<Open, { kind: "SWITCH" }> {
    const block = this.open.at(-1);
    if (block?.kind !== "SWITCH") throw cursor.unexpected("a statement, since no SWITCH is open");
    if (block.isLast) throw cursor.unexpected("ENDSWITCH, since DEFAULT is the last branch");
    if (this.code.length > block.start) block.leaves.push(this.push({ kind: "jump", to: -1, at: cursor.here }));
    if (block.miss !== undefined) block.miss.to = this.code.length;
    block.miss = undefined;
    cursor.take();
    return block;
  }

  private readCase(cursor: Cursor): void {
    const block = this.openSwitch(cursor);
    const values: Expression[] = [readExpression(cursor)];
    while (cursor.accept(",")) values.push(readExpression(cursor));
    cursor.expectEnd();
    block.miss = this.push({ kind: "case-unless", values, slot: block.slot, to: -1 });
  }

  private readDefault(cursor: Cursor): void {
    this.openSwitch(cursor).isLast = true;
    cursor.expectEnd();
  }

  private readEnd(cursor: Cursor): void {
    const block = this.open.at(-1);
    if (block === undefined || cursor.next !== ENDS[block.kind]) throw cursor.unexpected(block === undefined ? "a statement, since no block is open" : ENDS[block.kind]);
    const at = cursor.here;
    cursor.take();
    cursor.expectEnd();
    if (block.kind === "WHILE" || block.kind === "LOOP") this.push({ kind: "jump", to: block.start, at });
    if (block.kind === "FOR") this.push({ kind: "for-next", variable: block.variable, slot: block.slot, to: block.start });
    if ((block.kind === "IF" || block.kind === "SWITCH") && block.miss !== undefined) block.miss.to = this.code.length;
    this.close(block);
  }

  /** Leaves the innermost loop. */
  private readExit(cursor: Cursor, at: TextPlace): void {
    const loop = this.open.findLast(({ kind }) => kind !== "IF" && kind !== "SWITCH");
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
