import type { TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Cursor } from "./cursor.ts";
import { condition, operand, readStatement, variable } from "./statement.ts";
import type { Instruction, Job, Operand, Position } from "./syntax.ts";

type Jumping = Extract<Instruction, { to: number }>;
type Open = { readonly at: TextPlace; readonly leaves: Jumping[] } & (
  | { readonly kind: "IFTHENEXP"; miss: Jumping | undefined }
  | { readonly kind: "WHILEEXP"; readonly start: number }
  | { readonly kind: "FOR"; readonly variable: string; readonly slot: number; readonly start: number }
);
const ONE: Operand = { kind: "number", value: 1 };

/** Turns the instructions of one job into a list with jumps, so that JUMP and blocks are one thing. */
export class JobBuilder {
  readonly name: string;
  readonly positions = new Map<string, Position>();
  readonly others = new Map<string, string>();
  private readonly place: TextPlace;
  private readonly code: Instruction[] = [];
  private readonly open: Open[] = [];
  private readonly labels = new Map<string, number>();
  private readonly jumps: { readonly jump: Jumping; readonly label: string; readonly at: TextPlace }[] = [];
  private slots = 0;

  constructor(name: string, place: TextPlace) {
    this.name = name;
    this.place = place;
  }

  /** One instruction. @throws {TextError} */
  line(cursor: Cursor): void {
    const at = cursor.here;
    if (cursor.nextKind === "label") {
      const label = cursor.take().toUpperCase();
      cursor.expectEnd();
      if (this.labels.has(label))
        throw new TextError(at, "a label used once", `Label ${label} is in job ${this.name} twice.`);
      this.labels.set(label, this.code.length);
      return;
    }
    switch (cursor.next) {
      case "JUMP":
        return this.readJump(cursor, at);
      case "IFTHEN":
      case "IFTHENEXP": {
        cursor.take();
        const when = condition(cursor);
        cursor.expectEnd();
        this.open.push({ kind: "IFTHENEXP", at, leaves: [], miss: this.push({ kind: "unless", when, to: -1, at }) });
        return;
      }
      case "ELSEIF":
      case "ELSEIFEXP": {
        const block = this.branch(cursor, at);
        const when = condition(cursor);
        cursor.expectEnd();
        block.miss = this.push({ kind: "unless", when, to: -1, at });
        return;
      }
      case "ELSE":
        this.branch(cursor, at);
        return cursor.expectEnd();
      case "ENDIF": {
        const block = this.open.at(-1);
        if (block?.kind !== "IFTHENEXP") throw cursor.unexpected("an instruction, since no IFTHENEXP is open");
        cursor.take();
        cursor.expectEnd();
        if (block.miss !== undefined) block.miss.to = this.code.length;
        return this.close(block);
      }
      case "WHILEEXP": {
        cursor.take();
        const start = this.code.length;
        const when = condition(cursor);
        cursor.expectEnd();
        this.open.push({ kind: "WHILEEXP", at, start, leaves: [this.push({ kind: "unless", when, to: -1, at })] });
        return;
      }
      case "ENDWHILE": {
        const block = this.open.at(-1);
        if (block?.kind !== "WHILEEXP") throw cursor.unexpected("an instruction, since no WHILEEXP is open");
        cursor.take();
        cursor.expectEnd();
        this.push({ kind: "jump", to: block.start, at });
        return this.close(block);
      }
      case "FOR":
        return this.readFor(cursor, at);
      case "NEXT":
        return this.readNext(cursor, at);
      default:
        this.code.push({ kind: "statement", statement: readStatement(cursor) });
    }
  }

  /** @throws {TextError} for a block without its end, or a JUMP to a label that is not there. */
  finish(end: TextPlace): Job {
    const block = this.open.at(-1);
    if (block !== undefined)
      throw new TextError(
        block.at,
        block.kind === "FOR" ? "NEXT" : block.kind === "WHILEEXP" ? "ENDWHILE" : "ENDIF",
        `The ${block.kind} of line ${block.at.line} is not closed before line ${end.line}.`,
      );
    for (const { jump, label, at } of this.jumps) {
      const to = this.labels.get(label);
      if (to === undefined)
        throw new TextError(at, "a label of this job", `Label ${label} is not in job ${this.name}.`);
      jump.to = to;
    }
    return {
      name: this.name,
      place: this.place,
      positions: this.positions,
      others: this.others,
      instructions: this.code,
      slots: this.slots,
    };
  }

  private push<I extends Instruction>(instruction: I): I {
    this.code.push(instruction);
    return instruction;
  }

  private readJump(cursor: Cursor, at: TextPlace): void {
    cursor.take();
    const to = cursor.here;
    if (cursor.next === "LABEL" && cursor.second === ":") {
      cursor.take();
      cursor.take();
      const number = operand(cursor);
      const unless = cursor.accept("IF")
        ? this.push({ kind: "unless", when: condition(cursor), to: -1, at })
        : undefined;
      cursor.expectEnd();
      this.push({ kind: "jump-to", number, labels: this.labels, at });
      if (unless !== undefined) unless.to = this.code.length;
      return;
    }
    if (cursor.nextKind !== "label") throw cursor.unexpected("a label such as *AGAIN");
    const label = cursor.take().toUpperCase();
    const over =
      cursor.accept("IF") || cursor.accept("IFEXPRESS")
        ? this.push({ kind: "unless", when: condition(cursor), to: -1, at })
        : undefined;
    cursor.expectEnd();
    this.jumps.push({ jump: this.push({ kind: "jump", to: -1, at }), label, at: to });
    if (over !== undefined) over.to = this.code.length;
  }

  private branch(cursor: Cursor, at: TextPlace): Extract<Open, { kind: "IFTHENEXP" }> {
    const block = this.open.at(-1);
    if (block?.kind !== "IFTHENEXP" || block.miss === undefined)
      throw cursor.unexpected("an instruction, since no IFTHENEXP is open");
    cursor.take();
    block.leaves.push(this.push({ kind: "jump", to: -1, at }));
    block.miss.to = this.code.length;
    block.miss = undefined;
    return block;
  }

  private readFor(cursor: Cursor, at: TextPlace): void {
    cursor.take();
    const name = variable(cursor);
    cursor.expect("START");
    cursor.expect("=");
    const from = operand(cursor);
    cursor.expect("TO");
    const last = operand(cursor);
    let step = ONE;
    if (cursor.accept("STEP")) {
      cursor.expect("=");
      step = operand(cursor);
    }
    cursor.expectEnd();
    const slot = this.slots++;
    this.push({ kind: "for", variable: name, from, last, step, slot, at });
    const start = this.code.length;
    this.open.push({
      kind: "FOR",
      at,
      variable: name,
      slot,
      start,
      leaves: [this.push({ kind: "for-check", variable: name, slot, to: -1 })],
    });
  }

  private readNext(cursor: Cursor, at: TextPlace): void {
    const block = this.open.at(-1);
    if (block?.kind !== "FOR") throw cursor.unexpected("an instruction, since no FOR is open");
    cursor.take();
    const place = cursor.here;
    const name = variable(cursor);
    if (name !== block.variable)
      throw new TextError(place, block.variable, `NEXT ${name} closes the FOR of ${block.variable}.`);
    cursor.expectEnd();
    this.push({ kind: "for-next", variable: name, slot: block.slot, to: block.start, at });
    this.close(block);
  }

  private close(block: Open): void {
    for (const jump of block.leaves) jump.to = this.code.length;
    this.open.pop();
  }
}
