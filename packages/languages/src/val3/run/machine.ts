import type { Executed, Step, TextPlace } from "@twincell/core";
import { TextError, missingProgram, rememberMap } from "../../parser/index.ts";
import {
  BlockMachine,
  changedNames,
  type Argument,
  type Block,
  type Do,
  type Expression,
  type Flow,
  type Routine,
  type WaitUntil,
} from "../../parser/structured/index.ts";
import { FAULT } from "../read/application.ts";
import { asNumber, kindOf, type Value } from "./values.ts";
import { Motions } from "./motions.ts";

/** Instructions that change nothing of where the robot goes. */
const SILENT = new Set([
  "autoconnectmove",
  "userpage",
  "cls",
  "enablepower",
  "gotoxy",
  "title",
  "restartmove",
  "put",
  "setmonitorspeed",
]);

const SAYS = new Set(["putln", "popupmsg", "logmsg"]);

const MOTIONS = new Set(["movej", "movel", "movec"]);

/** Instructions for files, lines of text, links, screens and other tasks: none of them moves the arm. */
const OUTSIDE = new Set([
  "diolink",
  "aiolink",
  "siolink",
  "sioset",
  "sioget",
  "sioctrl",
  "clearbuffer",
  "fileopen",
  "fileclose",
  "taskkill",
  "tasksuspend",
  "taskresume",
  "userpageset",
  "resetmotion",
  "resettask",
  "disablepower",
  "stopmove",
  "clear",
  "delete",
  "insert",
  "resize",
  "libload",
  "libsave",
  "setmutex",
  "sendmessage",
  "scoffset",
  "bidiolink",
]);

/** Executes VAL 3 statement by statement. */
export class Machine extends Motions {
  *main(): Generator<Executed, Flow> {
    const { main } = this.application;
    if (!this.startsAlone(main)) return "next";
    const flow = yield* this.call(main, [], main);
    // Programs that were to run beside this one and move the arm are carried out behind it.
    for (let task = this.tasks.shift(); task !== undefined; task = this.tasks.shift()) {
      if (flow === "halt" && task.routine === undefined) return flow;
      yield* this.call(task.routine!, task.args, task.at);
    }
    return flow;
  }

  /** Whether a program can be started by itself: one that wants arguments has nobody who gives them. */
  private startsAlone({ name, parameters, line, column }: Routine): boolean {
    if (parameters.length === 0) return true;
    this.remark(
      "arguments",
      { line, column },
      "the program that calls this one",
      `${this.spelt(name)} wants to be given ${parameters.map(each => each.name).join(", ")}: it is not run by itself. Open it with the program that calls it.`,
    );
    return false;
  }

  protected override handBack(routine: Routine, names: ReadonlyMap<string, Value>, args: readonly Argument[]): void {
    const free = args.filter(({ name }) => name === undefined);
    for (const [i, { name, isBack }] of routine.parameters.entries()) {
      const given = free[i]?.value;
      const value = names.get(name);
      if (isBack !== true || given === undefined || value === undefined) continue;
      if (given.kind !== "variable" && given.kind !== "index") continue;
      if (kindOf(value) !== "dio" && kindOf(value) !== "aio") this.store(given, value);
    }
  }

  /** The code of a program and of all that it calls. */
  private bodiesOf(routine: Routine): readonly Block[] {
    const all = [...this.application.routines.values()];
    const met = new Set([routine]);
    for (const each of met)
      for (const other of all)
        if (!met.has(other) && JSON.stringify(each.body).includes(`"${other.name}"`)) met.add(other);
    return [...met].map(({ body }) => body);
  }

  /** Whether a program, or one that it calls, has a motion. */
  private moves(routine: Routine, met = new Set<string>()): boolean {
    if (met.has(routine.name)) return false;
    met.add(routine.name);
    const look = (block: Block): boolean =>
      block.some(statement => {
        switch (statement.kind) {
          case "do": {
            if (MOTIONS.has(statement.name.toLowerCase())) return true;
            const called = this.routine(statement.name);
            return called !== undefined && this.moves(called, met);
          }
          case "if":
            return statement.branches.some(({ body }) => look(body)) || look(statement.otherwise ?? []);
          case "while":
          case "for":
            return look(statement.body);
          default:
            return false;
        }
      });
    return look(routine.body);
  }

  private createTask(statement: Do): undefined {
    const called = statement.args.at(-1)?.value;
    const routine = called?.kind === "call" ? this.routine(`call ${called.name}`) : undefined;
    if (called?.kind !== "call" || routine === undefined)
      throw new TextError(statement, "a program of the text", "The program of the task is not in the text.");
    if (!this.moves(routine)) {
      for (const name of changedNames(this.bodiesOf(routine))) this.foreign.add(name);
      this.remark(
        `task ${called.name}`,
        statement,
        "a program that moves the robot",
        `The task ${called.name} does not move the robot: it is kept and not executed. What it gives to data is not known.`,
      );
      return undefined;
    }
    this.remark(
      `task ${called.name}`,
      statement,
      "one program after the other",
      `The task ${called.name} runs beside this program on the controller: it is carried out behind it here.`,
    );
    this.tasks.push({ routine, args: called.args, at: statement });
    return undefined;
  }

  open(): Block {
    const names = new Map<string, Value>();
    const { main } = this.application;
    this.scopes.push({ routine: main.name, names });
    this.prepare(main, names);
    return main.body;
  }

  protected *waitUntil(statement: WaitUntil): Generator<Executed, void> {
    this.settled(statement);
    const { when: all } = statement;
    if (all.kind === "binary" && all.sign === "and") {
      yield* this.waitUntil({ ...statement, when: all.left });
      yield* this.waitUntil({ ...statement, when: all.right });
      return;
    }
    const when = this.condition(all);
    if (when === undefined) {
      if (!this.isTrue(all)) {
        const one =
          all.kind === "binary" && all.sign === "or"
            ? (this.condition(all.left) ?? this.condition(all.right))
            : undefined;
        if (one === undefined)
          throw new TextError(
            all,
            "a condition of one line",
            "The program waits for a condition that nothing here makes true.",
          );
        this.remark(
          `alternatives ${statement.line}`,
          statement,
          "one thing to wait for",
          "The wait ends with the first of several lines: only one of them is waited for here.",
        );
        yield this.done(statement, { id: this.stepId(statement), type: "wait-for", when: one });
        return;
      }
      yield { line: statement.line };
      return;
    }
    yield this.done(statement, {
      id: this.stepId(statement),
      type: "wait-for",
      when,
      ...(statement.timeout === undefined ? {} : { timeout_s: this.numberOf(statement.timeout) }),
    });
  }

  override *statement(statement: Parameters<BlockMachine<Value>["statement"]>[0]): Generator<Executed, Flow> {
    // A line is a variable: giving it a value writes it.
    const name = statement.kind === "assign" ? this.nameOf(statement.to) : undefined;
    if (statement.kind === "assign" && name !== undefined && kindOf(this.variable(name)) === "dio") {
      const value = this.evaluate(statement.value);
      if (typeof value !== "boolean") throw new TextError(statement, "true or false", `"${name}" is a digital line.`);
      yield this.done(statement, this.set(name, value, statement));
      return "next";
    }
    return yield* super.statement(statement);
  }

  private set(signal: string, to: boolean | number, at: TextPlace): Step {
    this.settled(at);
    this.declared.signals[signal] ??= { kind: typeof to === "boolean" ? "digital-out" : "analogue-out" };
    this.outputs.set(signal, to);
    return { id: this.stepId(at), type: "set", signal, to };
  }

  protected *instruction(statement: Do): Generator<Executed, Flow | undefined> {
    const step = this.step(statement);
    yield step === undefined ? { line: statement.line } : this.done(statement, step);
    return undefined;
  }

  private step(statement: Do): Step | undefined {
    const { name, args } = statement;
    if (name === FAULT) {
      const text = (argument: Argument | undefined): string =>
        argument?.value?.kind === "text" ? argument.value.value : "";
      throw new TextError(statement, text(args[0]), text(args[1]));
    }
    if (name === "taskCreate" || name === "taskCreateSync") return this.createTask(statement);
    const given = (i: number): Expression => this.given(args, i, name, statement);
    const id = (): string => this.stepId(statement);
    const word = name.toLowerCase();
    switch (word) {
      case "movej":
      case "movel":
      case "movec":
        if (this.leaveOut(this.given(args, word === "movec" ? 1 : 0, word, statement))) return undefined;
        return this.motion(word, statement, id());
      case "dioset": {
        const line = this.nameOf(given(0));
        if (line === undefined || !this.isLine(line, "dio"))
          throw new TextError(statement, "a digital line", "dioSet writes a digital line.");
        return this.set(line, this.numberOf(given(1)) !== 0, statement);
      }
      case "waitendmove":
        this.moving = false;
        return undefined;
      case "open":
      case "close":
        this.of("tool", given(0));
        this.moving = false;
        return { id: id(), type: "gripper", closed: word === "close" };
      case "delay": {
        this.settled(statement);
        const s = this.numberOf(given(0));
        if (!(s >= 0)) throw new TextError(statement, "a time of 0 s or more", `The time is ${s} s.`);
        return { id: id(), type: "wait", s };
      }
      default:
        return this.linesAndMessages(statement, word);
    }
  }

  /** Analogue lines, what is said, and what does not move the robot. */
  private linesAndMessages(statement: Do, word: string): Step | undefined {
    const { name, args } = statement;
    const given = (i: number): Expression => this.given(args, i, name, statement);
    const id = (): string => this.stepId(statement);
    switch (word) {
      case "aioset": {
        const line = this.nameOf(given(0));
        if (line === undefined || !this.isLine(line, "aio"))
          throw new TextError(statement, "an analogue line", "aioSet writes an analogue line.");
        return this.set(line, this.numberOf(given(1)), statement);
      }
      default:
        if (SAYS.has(word)) {
          const said = given(0);
          if (said.kind === "variable" && this.foreign.has(said.name))
            return { id: id(), type: "message", text: `<${said.name}>` };
          const text = this.evaluate(given(0));
          return {
            id: id(),
            type: "message",
            text: typeof text === "string" ? text : String(asNumber(text, statement)),
          };
        }
        if (SILENT.has(word)) return undefined;
        if (OUTSIDE.has(word)) {
          if (word === "sioget")
            for (const { value } of args.slice(1)) if (value?.kind === "variable") this.foreign.add(value.name);
          this.remark(
            `${word} ${statement.line}`,
            statement,
            "a statement about the robot",
            `${name} is kept and not executed: it does not move the robot.`,
          );
          return undefined;
        }
        if (name.startsWith("call ")) throw missingProgram(statement, name.slice(5));
        throw new TextError(
          statement,
          "an instruction of VAL 3",
          `"${name}" is no instruction that is understood here.`,
        );
    }
  }

  edge(): void {
    /* every motion says everything */
  }

  override remember(): () => void {
    const values = super.remember();
    const arm = this.arm.remember();
    const { moving } = this;
    const outputs = rememberMap(this.outputs);
    return () => {
      values();
      arm();
      this.moving = moving;
      outputs();
    };
  }
}
