import type { Argument, Block, Expression, Routine, Statement } from "./tree.ts";

/**
 * Whether the rounds of a loop cannot tell one from the other by a variable: its body never reads the counter, nor any
 * variable that it changes before it has given it a value in the same round.
 */
export function isSteady(body: Block, counter: string, routineOf: (name: string) => Routine | undefined): boolean {
  const walk = new Walk(counter, routineOf);
  walk.block(body, new Set());
  return !walk.readsCounter && ![...walk.changed].some(name => walk.readFirst.has(name));
}

class Walk {
  readsCounter = false;
  readonly changed = new Set<string>();
  /** Read at a place that can be reached before the variable got its value in this round. */
  readonly readFirst = new Set<string>();
  private readonly counter: string;
  private readonly routineOf: (name: string) => Routine | undefined;
  private readonly open = new Set<string>();

  constructor(counter: string, routineOf: (name: string) => Routine | undefined) {
    this.counter = counter;
    this.routineOf = routineOf;
  }

  /** @param given  variables that surely have their value of this round; grows. */
  block(block: Block, given: Set<string>): void {
    for (const statement of block) this.statement(statement, given);
  }

  private statement(statement: Statement, given: Set<string>): void {
    switch (statement.kind) {
      case "assign": {
        this.read(statement.value, given);
        let { to } = statement;
        while (to.kind === "component" || to.kind === "index") {
          if (to.kind === "index") for (const index of to.indices) this.read(index, given);
          to = to.of;
        }
        if (to.kind !== "variable") return;
        if (to.name === this.counter) this.readsCounter = true;
        this.changed.add(to.name);
        given.add(to.name);
        return;
      }
      case "do":
        this.args(statement.args, given);
        this.call(statement.name, given);
        return;
      case "if":
        for (const { when, body } of statement.branches) {
          this.read(when, given);
          this.block(body, new Set(given));
        }
        if (statement.otherwise !== undefined) this.block(statement.otherwise, new Set(given));
        return;
      case "while":
        this.read(statement.when, given);
        this.block(statement.body, new Set(given));
        return;
      case "for":
        for (const each of [statement.from, statement.to, statement.step])
          if (each !== undefined) this.read(each, given);
        this.block(statement.body, new Set(given).add(statement.variable));
        return;
      case "wait-until":
        this.read(statement.when, given);
        return;
      case "return":
        if (statement.value !== undefined) this.read(statement.value, given);
        return;
      default:
        return;
    }
  }

  private call(name: string, given: ReadonlySet<string>): void {
    const routine = this.routineOf(name);
    if (routine === undefined || this.open.has(name)) return;
    this.open.add(name);
    this.block(routine.body, new Set([...given, ...routine.parameters.map(parameter => parameter.name)]));
    this.open.delete(name);
  }

  private args(args: readonly Argument[], given: ReadonlySet<string>): void {
    for (const { value } of args) if (value !== undefined) this.read(value, given);
  }

  private read(expression: Expression, given: ReadonlySet<string>): void {
    switch (expression.kind) {
      case "variable":
        if (expression.name === this.counter) this.readsCounter = true;
        if (!given.has(expression.name)) this.readFirst.add(expression.name);
        return;
      case "list":
        for (const item of expression.items) this.read(item, given);
        return;
      case "index":
        this.read(expression.of, given);
        for (const index of expression.indices) this.read(index, given);
        return;
      case "component":
      case "unary":
        this.read(expression.of, given);
        return;
      case "call":
        this.args(expression.args, given);
        this.call(expression.name, given);
        return;
      case "binary":
        this.read(expression.left, given);
        this.read(expression.right, given);
        return;
      default:
        return;
    }
  }
}
