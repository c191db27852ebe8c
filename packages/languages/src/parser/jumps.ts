import type { TextPlace } from "@twincell/core";
import { TextError } from "./faults.ts";
import type { LineCursor } from "./line-cursor.ts";

/**
 * A program as a list of statements and jumps; `to` is an index into the list, -1 only while the list is being made.
 */
export type JumpInstruction<Expression, Variable extends Expression, Statement> =
  | { readonly kind: "statement"; readonly statement: Statement }
  | { readonly kind: "jump"; to: number; readonly at: TextPlace }
  | { readonly kind: "unless"; readonly condition: Expression; to: number }
  | {
      readonly kind: "for";
      readonly variable: Variable;
      readonly from: Expression;
      readonly last: Expression;
      readonly step: Expression | undefined;
      readonly slot: number;
    }
  /** Jumps out when the variable of loop `slot` has passed its last value. */
  | { readonly kind: "for-check"; readonly variable: Variable; readonly slot: number; to: number }
  | { readonly kind: "for-next"; readonly variable: Variable; readonly slot: number; to: number }
  | { readonly kind: "switch"; readonly value: Expression; readonly slot: number }
  /** Jumps when the value of that switch is none of these. */
  | { readonly kind: "case-unless"; readonly values: readonly Expression[]; readonly slot: number; to: number };

/** How a language reads what stands inside its blocks, and what it calls a list of lines. */
export interface JumpRules<Cursor, Expression, Variable extends Expression, Statement> {
  readonly expression: (cursor: Cursor) => Expression;
  readonly variable: (cursor: Cursor) => Variable;
  readonly statement: (cursor: Cursor) => Statement;
  /** "routine", "program". */
  readonly called: string;
  /** The word that closes a block which that word opened. */
  readonly endOf: (word: string) => string;
}

type Jumping<I> = Extract<I, { to: number }>;
/** A block that has been opened and not yet closed, with the jumps that must still learn where to go. */
type Open<I, Variable> = {
  readonly at: TextPlace;
  readonly word: string;
  readonly start: number;
  readonly leaves: Jumping<I>[];
} & (
  | { readonly kind: "if"; miss: Jumping<I> | undefined }
  | { readonly kind: "loop" | "while" | "until" }
  | { readonly kind: "for"; readonly variable: Variable; readonly slot: number }
  | { readonly kind: "switch"; readonly slot: number; miss: Jumping<I> | undefined; isLast: boolean }
);

/** Turns the lines of one list into instructions with jumps, so that GOTO and blocks are one thing. */
export abstract class JumpBuilder<
  Cursor extends LineCursor<string>,
  Expression,
  Variable extends Expression,
  Statement,
> {
  readonly name: string;
  protected readonly code: JumpInstruction<Expression, Variable, Statement>[] = [];
  protected slots = 0;
  private readonly rules: JumpRules<Cursor, Expression, Variable, Statement>;
  private readonly open: Open<JumpInstruction<Expression, Variable, Statement>, Variable>[] = [];
  private readonly labels = new Map<string, number>();
  private readonly gotos: { readonly jump: { to: number }; readonly label: string; readonly at: TextPlace }[] = [];

  constructor(name: string, rules: JumpRules<Cursor, Expression, Variable, Statement>) {
    this.name = name;
    this.rules = rules;
  }

  /** One line of the body. @throws {TextError} */
  abstract line(cursor: Cursor): void;

  /**
   * Gives every jump its place. @throws {TextError} for a block without its end, or a GOTO to a label that is not
   * there.
   */
  protected close(end: TextPlace): void {
    const block = this.open.at(-1);
    if (block !== undefined)
      throw new TextError(
        block.at,
        this.rules.endOf(block.word),
        `The ${block.word} of line ${block.at.line} is not closed before line ${end.line}.`,
      );
    for (const { jump, label, at } of this.gotos) {
      const to = this.labels.get(label);
      if (to === undefined)
        throw new TextError(
          at,
          `a label of this ${this.rules.called}`,
          `Label ${label} is not in ${this.rules.called} ${this.name}.`,
        );
      jump.to = to;
    }
  }

  protected push<I extends JumpInstruction<Expression, Variable, Statement>>(instruction: I): I {
    this.code.push(instruction);
    return instruction;
  }

  protected label(label: string, at: TextPlace): void {
    if (this.labels.has(label))
      throw new TextError(at, "a label used once", `Label ${label} is in ${this.rules.called} ${this.name} twice.`);
    this.labels.set(label, this.code.length);
  }

  protected goto(jump: { to: number }, label: string, at: TextPlace): void {
    this.gotos.push({ jump, label, at });
  }

  /** A block that is opened by its word alone. */
  protected begin(cursor: Cursor, kind: "loop" | "until"): void {
    const at = cursor.here;
    const word = cursor.take().toUpperCase();
    cursor.expectEnd();
    this.open.push({ kind, word, at, start: this.code.length, leaves: [] });
  }

  protected openIf(condition: Expression, at: TextPlace): void {
    this.open.push({
      kind: "if",
      word: "IF",
      at,
      start: this.code.length,
      leaves: [],
      miss: this.push({ kind: "unless", condition, to: -1 }),
    });
  }

  protected readElse(cursor: Cursor): void {
    const block = this.open.at(-1);
    if (block?.kind !== "if" || block.miss === undefined) throw cursor.unexpected("a statement, since no IF is open");
    block.leaves.push(this.push({ kind: "jump", to: -1, at: cursor.here }));
    block.miss.to = this.code.length;
    block.miss = undefined;
    cursor.take();
    cursor.expectEnd();
  }

  /** @param then  a word behind the condition. */
  protected readWhile(cursor: Cursor, at: TextPlace, then?: string): void {
    cursor.take();
    const condition = this.rules.expression(cursor);
    const start = this.code.length;
    this.open.push({
      kind: "while",
      word: "WHILE",
      at,
      start,
      leaves: [this.push({ kind: "unless", condition, to: -1 })],
    });
    if (then !== undefined) cursor.expect(then);
    cursor.expectEnd();
  }

  /** @param word  what opens the block that UNTIL closes. */
  protected readUntil(cursor: Cursor, word: string): void {
    const block = this.open.at(-1);
    if (block?.kind !== "until") throw cursor.unexpected(`a statement, since no ${word} is open`);
    cursor.take();
    this.push({ kind: "unless", condition: this.rules.expression(cursor), to: block.start });
    cursor.expectEnd();
    this.leave(block);
  }

  protected readFor(cursor: Cursor, at: TextPlace): void {
    const { expression } = this.rules;
    cursor.take();
    const variable = this.rules.variable(cursor);
    cursor.expect("=");
    const from = expression(cursor);
    cursor.expect("TO");
    const last = expression(cursor);
    const step = cursor.accept("STEP") ? expression(cursor) : undefined;
    cursor.expectEnd();
    const slot = this.slots++;
    this.push({ kind: "for", variable, from, last, step, slot });
    const start = this.code.length;
    this.open.push({
      kind: "for",
      word: "FOR",
      at,
      start,
      slot,
      variable,
      leaves: [this.push({ kind: "for-check", variable, slot, to: -1 })],
    });
  }

  /** @param then  a word behind the value. */
  protected readSwitch(cursor: Cursor, at: TextPlace, then?: string): void {
    const word = cursor.take().toUpperCase();
    const value = this.rules.expression(cursor);
    if (then !== undefined) cursor.expect(then);
    cursor.expectEnd();
    const slot = this.slots++;
    this.push({ kind: "switch", value, slot });
    this.open.push({
      kind: "switch",
      word,
      at,
      slot,
      start: this.code.length,
      leaves: [],
      miss: undefined,
      isLast: false,
    });
  }

  /** @param colon  whether one stands behind the values. */
  protected readCase(cursor: Cursor, words: SwitchWords, colon: boolean): void {
    const block = this.branch(cursor, words);
    const values: Expression[] = [this.rules.expression(cursor)];
    while (cursor.accept(",")) values.push(this.rules.expression(cursor));
    if (colon) cursor.expect(":");
    cursor.expectEnd();
    block.miss = this.push({ kind: "case-unless", values, slot: block.slot, to: -1 });
  }

  protected readLastCase(cursor: Cursor, words: SwitchWords): void {
    this.branch(cursor, words).isLast = true;
    cursor.accept(":");
    cursor.expectEnd();
  }

  private branch(
    cursor: Cursor,
    { opens, ends, last }: SwitchWords,
  ): Extract<Open<JumpInstruction<Expression, Variable, Statement>, Variable>, { kind: "switch" }> {
    const block = this.open.at(-1);
    if (block?.kind !== "switch") throw cursor.unexpected(`a statement, since no ${opens} is open`);
    if (block.isLast) throw cursor.unexpected(`${ends}, since ${last} is the last branch`);
    if (this.code.length > block.start) block.leaves.push(this.push({ kind: "jump", to: -1, at: cursor.here }));
    if (block.miss !== undefined) block.miss.to = this.code.length;
    block.miss = undefined;
    cursor.take();
    return block;
  }

  protected readEnd(cursor: Cursor): void {
    const block = this.open.at(-1);
    const ends = block === undefined ? undefined : this.rules.endOf(block.word);
    if (block === undefined || block.kind === "until" || cursor.next !== ends)
      throw cursor.unexpected(ends ?? "a statement, since no block is open");
    const at = cursor.here;
    cursor.take();
    cursor.expectEnd();
    if (block.kind === "while" || block.kind === "loop") this.push({ kind: "jump", to: block.start, at });
    if (block.kind === "for")
      this.push({ kind: "for-next", variable: block.variable, slot: block.slot, to: block.start });
    if ((block.kind === "if" || block.kind === "switch") && block.miss !== undefined) block.miss.to = this.code.length;
    this.leave(block);
  }

  /** Leaves the innermost loop. */
  protected readExit(cursor: Cursor, at: TextPlace): void {
    const loop = this.open.findLast(({ kind }) => kind !== "if" && kind !== "switch");
    if (loop === undefined) throw cursor.unexpected("a statement, since no loop is open");
    cursor.take();
    cursor.expectEnd();
    loop.leaves.push(this.push({ kind: "jump", to: -1, at }));
  }

  private leave(block: Open<JumpInstruction<Expression, Variable, Statement>, Variable>): void {
    for (const jump of block.leaves) jump.to = this.code.length;
    this.open.pop();
  }
}

/** What opens the branches of a value, what ends them, and what begins the one for all other values. */
export interface SwitchWords {
  readonly opens: string;
  readonly ends: string;
  readonly last: string;
}
