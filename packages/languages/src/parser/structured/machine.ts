import type { Executed, Step, TextFault, TextPlace } from "@twincell/core";
import { TextError, textFault } from "../faults.ts";
import { rememberMap } from "../remember.ts";
import type { Argument, Block, Expression, Routine, Statement } from "./tree.ts";

export type Flow = "next" | "break" | "continue" | "return" | "halt" | "goto";
export type Do = Extract<Statement, { kind: "do" }>;
export type WaitUntil = Extract<Statement, { kind: "wait-until" }>;

/** Statements without a motion or a wait after which a program is taken to run on the spot for ever. */
const STATEMENTS_WITHOUT_MOTION = 100_000;
/** Calls inside calls. */
const CALL_DEPTH = 40;

/** A program that executes statement after statement without a motion. */
export class RunsOnTheSpot extends TextError {}

/** The variables of one call. */
export interface Scope<V> {
  readonly routine: string;
  readonly names: Map<string, V>;
}

/**
 * Executes blocks, loops and calls of a language whose values are V. What an expression is worth and what an
 * instruction does is the language's own affair. Deterministic: the same text gives the same steps.
 */
export abstract class BlockMachine<V> {
  protected readonly scopes: Scope<V>[] = [];
  protected readonly globals = new Map<string, V>();
  private readonly routines: ReadonlyMap<string, Routine>;
  private readonly met = new Map<number, number>();
  private idle = 0;
  private depth = 0;
  private returned: V | undefined;
  /** The label that a GOTO looks for. */
  private sought = "";
  private soughtAt: TextPlace = { line: 1, column: 1 };
  /** What is not carried out as it stands, by what it is about. */
  notes: Map<string, TextFault> = new Map();

  constructor(routines: ReadonlyMap<string, Routine>) {
    this.routines = routines;
  }

  abstract evaluate(expression: Expression): V;
  abstract isTrue(expression: Expression): boolean;
  abstract numberOf(expression: Expression): number;
  abstract fromNumber(value: number): V;
  protected abstract store(to: Expression, value: V, global: boolean): void;
  /** What an instruction of the controller does. */
  protected abstract instruction(statement: Do): Generator<Executed, Flow | undefined>;
  protected abstract waitUntil(statement: WaitUntil): Generator<Executed, void>;

  routine(name: string): Routine | undefined {
    return this.routines.get(name);
  }

  *block(block: Block): Generator<Executed, Flow> {
    for (let i = 0; i < block.length; i++) {
      const flow = yield* this.statement(block[i]!);
      if (flow === "next") continue;
      if (flow !== "goto") return flow;
      // The label stands here or in a block around this one.
      const at = block.findIndex(each => each.kind === "label" && each.name === this.sought);
      if (at < 0) return flow;
      this.spend(block[at]!);
      i = at;
    }
    return "next";
  }

  /** A whole program: what it jumps to stands in it. */
  *program(block: Block): Generator<Executed, Flow> {
    const flow = yield* this.block(block);
    if (flow === "goto") throw this.unfound("the program");
    return flow;
  }

  private unfound(where: string): TextError {
    return new TextError(
      this.soughtAt,
      "a label of the routine",
      `Label ${this.sought} is not in ${where}, or inside a block.`,
    );
  }

  /** Says something once. */
  protected remark(about: string, at: TextPlace, expected: string, sentence: string): void {
    if (!this.notes.has(about)) this.notes.set(about, textFault(at, expected, sentence));
  }

  *statement(statement: Statement): Generator<Executed, Flow> {
    if (statement.kind === "comment" || statement.kind === "label") return "next";
    this.spend(statement);
    switch (statement.kind) {
      case "assign":
        return yield* this.assignment(statement);
      case "do": {
        const called = this.routine(statement.name);
        if (called !== undefined) return yield* this.call(called, statement.args, statement);
        return (yield* this.instruction(statement)) ?? "next";
      }
      case "if": {
        yield { line: statement.line };
        for (const { when, body } of statement.branches) if (this.isTrue(when)) return yield* this.block(body);
        return statement.otherwise === undefined ? "next" : yield* this.block(statement.otherwise);
      }
      case "while":
        return yield* this.whileLoop(statement);
      case "for":
        return yield* this.loop(statement);
      case "wait-until":
        yield* this.waitUntil(statement);
        return "next";
      default:
        return yield* this.leaving(statement);
    }
  }

  /** What leaves a loop, a routine or the program. */
  private *leaving(
    statement: Extract<Statement, { kind: "return" | "break" | "continue" | "goto" | "halt" }>,
  ): Generator<Executed, Flow> {
    switch (statement.kind) {
      case "return":
        this.returned = statement.value === undefined ? undefined : this.evaluate(statement.value);
        return "return";
      case "break":
        return "break";
      case "continue":
        return "continue";
      case "goto":
        this.sought = statement.label;
        this.soughtAt = statement;
        return "goto";
      case "halt":
        yield this.done(statement, { id: this.stepId(statement), type: "stop" });
        return "halt";
    }
  }

  /** A value, or what a routine answers. */
  private *assignment(statement: Extract<Statement, { kind: "assign" }>): Generator<Executed, Flow> {
    const { value } = statement;
    const called = value.kind === "call" ? this.routine(value.name) : undefined;
    if (called !== undefined && value.kind === "call") {
      const flow = yield* this.call(called, value.args, value);
      if (flow === "halt") return flow;
      this.store(statement.to, this.result(value), statement.global);
    } else this.store(statement.to, this.evaluate(value), statement.global);
    yield { line: statement.line };
    return "next";
  }

  private *whileLoop(statement: Extract<Statement, { kind: "while" }>): Generator<Executed, Flow> {
    while (this.isTrue(statement.when)) {
      this.spend(statement);
      yield { line: statement.line };
      const flow = yield* this.block(statement.body);
      if (flow === "break") break;
      if (flow === "return" || flow === "halt" || flow === "goto") return flow;
    }
    return "next";
  }

  /** From, last and step of a counting loop. */
  counting({
    from,
    to,
    step,
  }: Extract<Statement, { kind: "for" }>): readonly [from: number, last: number, step: number] {
    const first = this.numberOf(from);
    const last = this.numberOf(to);
    return [first, last, step === undefined ? (last < first ? -1 : 1) : this.numberOf(step)];
  }

  /** Gives the variable of a counting loop its value. */
  setCount(name: string, value: number): void {
    const holder =
      this.scopes.findLast(({ names }) => names.has(name))?.names ??
      (this.globals.has(name) ? this.globals : undefined);
    if (holder !== undefined) holder.set(name, this.fromNumber(value));
    else this.count(name, value);
  }

  private count(name: string, value: number): void {
    (this.scopes.at(-1)?.names ?? this.globals).set(name, this.fromNumber(value));
  }

  private *loop(statement: Extract<Statement, { kind: "for" }>): Generator<Executed, Flow> {
    const [from, last, step] = this.counting(statement);
    if (step === 0) throw new TextError(statement.step ?? statement, "a step other than 0", "The loop has the step 0.");
    for (let i = from; step > 0 ? i <= last : i >= last; i += step) {
      this.spend(statement);
      this.count(statement.variable, i);
      yield { line: statement.line };
      const flow = yield* this.block(statement.body);
      if (flow === "break") break;
      if (flow === "return" || flow === "halt" || flow === "goto") return flow;
    }
    return "next";
  }

  /** Makes the variables that a routine has from its beginning. */
  protected prepare(_routine: Routine, _names: Map<string, V>): void {
    /* most languages have none */
  }

  *call(routine: Routine, args: readonly Argument[], at: TextPlace): Generator<Executed, Flow> {
    this.enter(routine, args, at);
    const { names } = this.scopes.at(-1)!;
    const before = new Map(names);
    let flow: Flow;
    try {
      flow = yield* this.block(routine.body);
    } finally {
      this.leave();
    }
    if (flow === "goto") throw this.unfound(routine.name);
    this.handBack(routine, names, args, before);
    return flow === "halt" ? "halt" : "next";
  }

  /** Gives the variables of the caller what a routine made of its parameters. */
  protected handBack(
    { parameters }: Routine,
    names: ReadonlyMap<string, V>,
    args: readonly Argument[],
    before: ReadonlyMap<string, V>,
  ): void {
    const free = args.filter(({ name }) => name === undefined);
    for (const [i, { name, isBack }] of parameters.entries()) {
      const value = names.get(name);
      if (isBack !== true || value === undefined || value === before.get(name)) continue;
      const to = (args.find(each => each.name === name) ?? free[i])?.value;
      if (to?.kind !== "variable" && to?.kind !== "index" && to?.kind !== "component") continue;
      this.changed(to);
      this.store(to, value, false);
    }
  }

  /** A routine has given a variable another value: it is none that keeps its first one. */
  protected changed(_to: Expression): void {
    /* most machines know no such variables */
  }

  /** Does something in the variables of a routine that takes no arguments. */
  inside<T>(routine: Routine, act: () => T): T {
    this.enter(routine, [], routine);
    try {
      return act();
    } finally {
      this.leave();
    }
  }

  /** What a routine answers inside an expression; it must not move. */
  protected answer(routine: Routine, args: readonly Argument[], at: Expression): V {
    for (const { step } of this.call(routine, args, at)) {
      if (step !== undefined)
        throw new TextError(
          at,
          "a call as a statement of its own",
          `${routine.name} moves or waits: call it as a statement, not inside an expression.`,
        );
    }
    return this.result(at);
  }

  private result(at: TextPlace): V {
    const { returned } = this;
    if (returned === undefined)
      throw new TextError(at, "a routine that returns a value", "The routine ends without a value.");
    return returned;
  }

  /** Remembers variables and counts; the answer brings them back. */
  remember(): () => void {
    const globals = rememberMap(this.globals);
    const scopes = this.scopes.map(({ routine, names }) => ({ routine, names: new Map(names) }));
    const { idle } = this;
    return () => {
      globals();
      this.scopes.splice(
        0,
        this.scopes.length,
        ...scopes.map(({ routine, names }) => ({ routine, names: new Map(names) })),
      );
      this.idle = idle;
    };
  }

  private enter(routine: Routine, args: readonly Argument[], at: TextPlace): void {
    if (++this.depth > CALL_DEPTH)
      throw new TextError(
        at,
        `at most ${CALL_DEPTH} calls inside each other`,
        `${routine.name} is called more than ${CALL_DEPTH} deep.`,
      );
    const names = new Map<string, V>();
    const free = args.filter(({ name }) => name === undefined);
    if (free.length > routine.parameters.length)
      throw new TextError(
        at,
        `${routine.parameters.length} arguments`,
        `${routine.name} takes ${routine.parameters.length} arguments; ${free.length} are given.`,
      );
    for (const [i, { name, value, optional }] of routine.parameters.entries()) {
      const given = args.find(argument => argument.name === name)?.value ?? free[i]?.value ?? value;
      if (given !== undefined) names.set(name, this.evaluate(given));
      else if (optional !== true)
        throw new TextError(at, `a value for ${name}`, `${routine.name} is called without its argument ${name}.`);
    }
    this.scopes.push({ routine: routine.name, names });
    this.prepare(routine, names);
    this.returned = undefined;
  }

  private leave(): void {
    this.scopes.pop();
    this.depth--;
  }

  protected done(at: TextPlace, step: Step): Executed {
    this.idle = 0;
    return { line: at.line, step };
  }

  /** L12, and L12.2 when line 12 is executed again. */
  protected stepId({ line }: TextPlace): string {
    const time = (this.met.get(line) ?? 0) + 1;
    this.met.set(line, time);
    return time === 1 ? `L${line}` : `L${line}.${time}`;
  }

  protected spend(at: TextPlace): void {
    if (++this.idle > STATEMENTS_WITHOUT_MOTION) {
      throw new RunsOnTheSpot(
        at,
        "a motion, a wait or an end",
        `The program has executed ${STATEMENTS_WITHOUT_MOTION} statements without a motion: it runs on the spot for ever.`,
      );
    }
  }
}
