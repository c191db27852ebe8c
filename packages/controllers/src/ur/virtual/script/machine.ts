import { ScriptError, type At, type ScriptFault } from "./fault.ts";
import { Arguments, PURE, type ScriptFunction } from "./functions.ts";
import type { Argument, Expression, Routine, Script, Statement } from "./tree.ts";
import { asNumber, asNumbers, asTruth, binary, itemOf, withItem, type Value } from "./values.ts";

/** So many statements of one thread take one cycle: a loop that only counts does not stop the clock. */
const STATEMENTS_PER_CYCLE = 4000;
const MOST_THREADS = 32;
const DEEPEST_CALLS = 64;

type Flow = { readonly kind: "break" | "continue" } | { readonly kind: "return"; readonly value: Value } | undefined;
type Scope = Map<string, Value>;
interface Thread {
  readonly id: number;
  readonly steps: Generator<void, void>;
  done: boolean;
  spent: number;
  depth: number;
}
class Halt extends Error {}

export type MachineState =
  | { readonly kind: "running" }
  | { readonly kind: "done" }
  | { readonly kind: "fault"; readonly fault: ScriptFault };

/**
 * Executes one script as its controller does: threads take turns, each runs until it waits for the next cycle. What a
 * program body names is seen by its routines and threads; what a routine names first is its own.
 */
export class Machine {
  readonly script: Script;
  private readonly functions: Readonly<Record<string, ScriptFunction>>;
  private readonly onKill: (thread: number) => void;
  private readonly globals: Scope = new Map();
  private readonly threads = new Map<number, Thread>();
  private next = 1;
  /** The thread that wants to be alone. */
  private alone = 0;
  private current = 0;
  private state: MachineState = { kind: "running" };
  /** The statement that the main thread is at. */
  line = 0;

  /** @param onKill  called when a thread ends by another's hand: what it moved is nobody's. */
  constructor(script: Script, functions: Readonly<Record<string, ScriptFunction>>, onKill: (thread: number) => void) {
    this.script = script;
    this.functions = functions;
    this.onKill = onKill;
    this.begin(this.main());
  }

  private *main(): Generator<void, void> {
    yield* this.block(this.script.body, this.globals);
  }

  private begin(steps: Generator<void, void>): number {
    const id = this.next++;
    this.threads.set(id, { id, steps, done: false, spent: 0, depth: 0 });
    return id;
  }

  /** One cycle of the controller: every thread goes on to where it waits. */
  cycle(): MachineState {
    if (this.state.kind !== "running") return this.state;
    try {
      // A thread that is begun in this cycle has its turn in it as well.
      for (const thread of this.threads.values()) {
        if (this.alone !== 0 && this.alone !== thread.id) continue;
        if (thread.done || !this.threads.has(thread.id)) continue;
        this.current = thread.id;
        thread.spent = 0;
        if (thread.steps.next().done === true) this.finish(thread);
      }
    } catch (reason) {
      if (reason instanceof Halt) this.state = { kind: "done" };
      else if (reason instanceof ScriptError) this.state = { kind: "fault", fault: reason.fault };
      else if (reason instanceof RangeError)
        this.state = {
          kind: "fault",
          fault: {
            line: this.line,
            column: 1,
            sentence: `The program asks for more than there is: ${reason.message}.`,
          },
        };
      else throw reason;
    }
    // The program ends with its body; threads that are left end with it.
    if (this.state.kind === "running" && !this.threads.has(1)) this.state = { kind: "done" };
    return this.state;
  }

  private finish(thread: Thread): void {
    thread.done = true;
    this.threads.delete(thread.id);
    if (this.alone === thread.id) this.alone = 0;
  }

  private kill(id: number): void {
    const thread = this.threads.get(id);
    if (!thread || id === this.current) return;
    this.finish(thread);
    this.onKill(id);
  }

  /** Null when the name is nobody's. */
  private named(name: string, scope: Scope): Value | undefined {
    return scope.get(name) ?? this.globals.get(name);
  }

  private *block(statements: readonly Statement[], scope: Scope): Generator<void, Flow> {
    for (const statement of statements) {
      const thread = this.threads.get(this.current);
      if (thread && ++thread.spent > STATEMENTS_PER_CYCLE) {
        thread.spent = 0;
        yield;
      }
      if (this.current === 1) this.line = statement.line;
      const flow = yield* this.statement(statement, scope);
      if (flow) return flow;
    }
    return undefined;
  }

  private *statement(statement: Statement, scope: Scope): Generator<void, Flow> {
    switch (statement.kind) {
      case "assign": {
        const value = yield* this.evaluate(statement.value, scope);
        const { name } = statement;
        const into =
          statement.scope === "global" || (statement.scope === "nearest" && !scope.has(name) && this.globals.has(name))
            ? this.globals
            : scope;
        if (statement.index === undefined) {
          into.set(name, value);
          return undefined;
        }
        const index = yield* this.evaluate(statement.index, scope);
        const old = this.named(name, scope);
        if (old === undefined) throw new ScriptError(statement, `"${name}" has no value yet.`);
        into.set(name, withItem(old, index, value, statement));
        return undefined;
      }
      case "do":
        yield* this.evaluate(statement.value, scope);
        return undefined;
      case "if":
        for (const arm of statement.arms)
          if (asTruth(yield* this.evaluate(arm.when, scope), arm.when)) return yield* this.block(arm.body, scope);
        return yield* this.block(statement.otherwise, scope);
      case "while":
        while (asTruth(yield* this.evaluate(statement.when, scope), statement.when)) {
          const flow = yield* this.block(statement.body, scope);
          const thread = this.threads.get(this.current);
          // An empty loop spends too.
          if (thread && ++thread.spent > STATEMENTS_PER_CYCLE) {
            thread.spent = 0;
            yield;
          }
          if (flow?.kind === "break") break;
          if (flow?.kind === "return") return flow;
        }
        return undefined;
      case "return":
        return {
          kind: "return",
          value: statement.value === undefined ? null : yield* this.evaluate(statement.value, scope),
        };
      case "kill":
        this.kill(asNumber(yield* this.evaluate(statement.thread, scope), statement));
        return undefined;
      case "join": {
        const id = asNumber(yield* this.evaluate(statement.thread, scope), statement);
        while (this.threads.has(id) && id !== this.current) yield;
        return undefined;
      }
      case "enter_critical":
        this.alone = this.current;
        return undefined;
      case "exit_critical":
        this.alone = 0;
        return undefined;
      case "halt":
        throw new Halt();
      case "pass":
        return undefined;
      default:
        return { kind: statement.kind };
    }
  }

  /** Where nothing is called nothing takes time: the shorter way. */
  private *evaluate(expression: Expression, scope: Scope): Generator<void, Value> {
    if (!expression.calls) return this.value(expression, scope);
    switch (expression.kind) {
      case "call":
        return yield* this.call(expression.name, expression.args, scope, expression);
      case "run": {
        const routine = this.script.routines.get(expression.name);
        if (!routine?.isThread) throw new ScriptError(expression, `There is no thread "${expression.name}".`);
        if (this.threads.size >= MOST_THREADS)
          throw new ScriptError(expression, `More than ${MOST_THREADS} threads are running.`);
        const inner = this.bind(routine, yield* this.given(expression.args, scope, expression), expression);
        return this.begin(this.body(routine, inner));
      }
      case "item":
        return itemOf(
          yield* this.evaluate(expression.of, scope),
          yield* this.evaluate(expression.index, scope),
          expression,
        );
      case "unary":
        return signed(expression.sign, yield* this.evaluate(expression.of, scope), expression);
      case "binary": {
        const left = yield* this.evaluate(expression.left, scope);
        if (decided(expression.sign, left)) return left;
        return binary(expression.sign, left, yield* this.evaluate(expression.right, scope), expression);
      }
      case "list": {
        const items: Value[] = [];
        for (const item of expression.items) items.push(yield* this.evaluate(item, scope));
        return made(items, expression.isPose, expression);
      }
      default:
        return this.value(expression, scope);
    }
  }

  private value(expression: Expression, scope: Scope): Value {
    switch (expression.kind) {
      case "constant":
        return expression.value;
      case "variable": {
        const value = this.named(expression.name, scope);
        if (value === undefined) throw new ScriptError(expression, `"${expression.name}" has no value yet.`);
        return value;
      }
      case "item":
        return itemOf(this.value(expression.of, scope), this.value(expression.index, scope), expression);
      case "unary":
        return signed(expression.sign, this.value(expression.of, scope), expression);
      case "binary": {
        const left = this.value(expression.left, scope);
        return decided(expression.sign, left)
          ? left
          : binary(expression.sign, left, this.value(expression.right, scope), expression);
      }
      case "list":
        return made(
          expression.items.map(item => this.value(item, scope)),
          expression.isPose,
          expression,
        );
      default:
        throw new ScriptError(expression, "A value is expected here.");
    }
  }

  private *given(args: readonly Argument[], scope: Scope, at: At): Generator<void, Arguments> {
    const placed: Value[] = [];
    const named = new Map<string, Value>();
    for (const { name, value } of args) {
      const is = yield* this.evaluate(value, scope);
      if (name === undefined) placed.push(is);
      else named.set(name, is);
    }
    return new Arguments(at, placed, named);
  }

  private *call(name: string, args: readonly Argument[], scope: Scope, at: At): Generator<void, Value> {
    const given = yield* this.given(args, scope, at);
    const routine = this.script.routines.get(name);
    if (routine) {
      const thread = this.threads.get(this.current);
      if (thread && ++thread.depth > DEEPEST_CALLS)
        throw new ScriptError(at, `More than ${DEEPEST_CALLS} calls stand inside each other.`);
      const flow = yield* this.block(routine.body, this.bind(routine, given, at));
      if (thread) thread.depth--;
      return flow?.kind === "return" ? flow.value : null;
    }
    const known = Object.hasOwn(this.functions, name)
      ? this.functions[name]
      : Object.hasOwn(PURE, name)
        ? PURE[name]
        : undefined;
    if (!known) throw new ScriptError(at, `"${name}" is no function of this controller.`);
    const answer = known(given, this.current);
    return isRunning(answer) ? yield* answer : answer;
  }

  private *body(routine: Routine, scope: Scope): Generator<void, void> {
    yield* this.block(routine.body, scope);
  }

  private bind(routine: Routine, args: Arguments, at: At): Scope {
    return new Map(
      routine.parameters.map((name, i) => {
        const value = args.maybe(i, name);
        if (value === undefined) throw new ScriptError(at, `"${routine.name}" wants "${name}".`);
        return [name, value];
      }),
    );
  }
}

const isRunning = (answer: Value | Generator<void, Value>): answer is Generator<void, Value> =>
  typeof answer === "object" && answer !== null && "next" in answer;
const decided = (sign: string, left: Value): boolean =>
  (sign === "and" && left === false) || (sign === "or" && left === true);
function signed(sign: "-" | "+" | "not", value: Value, at: At): Value {
  if (sign === "not") return !asTruth(value, at);
  return sign === "-" ? -asNumber(value, at) : asNumber(value, at);
}
function made(items: readonly Value[], isPose: boolean, at: At): Value {
  return isPose ? { pose: asNumbers(items, 6, at) } : items;
}
