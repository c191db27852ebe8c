import type { Executed, TextPlace } from "@twincell/core";
import { TextError, missingProgram } from "../../parser/index.ts";
import type { Expression, Instruction, Routine, Statement, Variable } from "../read/syntax.ts";
import { BAS } from "./bas.ts";
import { typed, type Frame } from "./frame.ts";
import { Lines } from "./signals.ts";
import { spelling } from "./system.ts";
import { bool, boolOf, evaluate, keyOf, numberOf, structureOf, whole, type Value } from "./values.ts";
import { Motions, hasAlternatives } from "./motions.ts";
import { ReadTooEarly } from "./memory.ts";

/** Calls inside calls. */
const CALL_DEPTH = 40;

/** Dealt with before, or of no consequence for where the robot goes. */
const QUIET_ROUTINES = new Set(["IR_STOPM", "MSGQUIT"]);

/** Routines of the controller's packages that move no arm: grippers, messages, the program number of a line. */
const OF_PACKAGES = new Set([
  "P00",
  "USERSPOT",
  "USER_GRP",
  "ERR_RAISE",
  "ERR_CLEAR",
  "H50",
  "H70",
  "GRP",
  "GRIPPER",
  "A10_INI",
  "A20_INI",
  "A50_INI",
  "USERLIB",
  "CLEAR_KRLMSG",
  "SET_KRLMSG",
  "MSGSTATE",
  "MSGINFO",
]);

/**
 * Executes a KRL module statement by statement. Deterministic: the same text and the same signals give the same steps.
 */
export class Machine extends Motions {
  /** @throws {TextError} where the text cannot be executed further. */
  *run(): Generator<Executed, void> {
    this.initialize();
    const { main } = this.source;
    if (main !== undefined) {
      this.enter(main, [], main.place);
      if (!this.startsAlone(main)) this.stack.length = 0;
      while (this.stack.length > 0 && !this.stopped) {
        const frame = this.stack.at(-1)!;
        const { at } = frame;
        const depth = this.stack.length;
        try {
          this.instruction(frame);
        } catch (cause) {
          if (!(cause instanceof ReadTooEarly)) throw cause;
          this.stack.length = depth;
          frame.at = at;
        }
        if (this.ready.length > 0) {
          const ready = this.ready;
          this.ready = [];
          yield* ready;
        }
      }
    }
    this.settle(false);
    yield* this.ready;
  }

  /**
   * Whether a routine can be started by itself: what it wants to be given must be given by hand, as an input of that
   * name.
   */
  private startsAlone({ name: called, parameters, declarations, place }: Routine): boolean {
    const { values } = this.stack.at(-1)!;
    const asked: string[] = [];
    for (const { name, out } of parameters) {
      const type = declarations.find(each => each.name === name)?.type ?? "";
      const given = this.lines.given(name);
      if (type === "BOOL" && typeof given === "boolean") values.set(name, bool(given));
      else if (typeof given === "number" && (type === "INT" || type === "REAL"))
        values.set(name, typed(whole(given), type));
      else if (!out) asked.push(name);
    }
    if (asked.length === 0) return true;
    this.remark(
      "arguments",
      place,
      "the program that calls this one",
      `${called} wants to be given ${asked.join(", ")}: it is not run by itself. Open it with the program that calls it, or give the values by hand.`,
    );
    return false;
  }

  private checkCall(routine: Routine, args: readonly (Expression | undefined)[], at: TextPlace): void {
    if (this.stack.length >= CALL_DEPTH)
      throw new TextError(
        at,
        `at most ${CALL_DEPTH} calls inside each other`,
        `Routine ${routine.name} is called more than ${CALL_DEPTH} deep.`,
      );
    if (args.length > routine.parameters.length)
      throw new TextError(
        at,
        `${routine.parameters.length} arguments`,
        `Routine ${routine.name} takes ${routine.parameters.length} arguments; ${args.length} are given.`,
      );
  }

  protected enter(routine: Routine, args: readonly (Expression | undefined)[], at: TextPlace): Frame {
    this.checkCall(routine, args, at);
    const caller = this.stack.at(-1);
    const values = new Map<string, Value>();
    const types = new Map<string, string>();
    const own = new Set([
      ...routine.parameters.map(({ name }) => name),
      ...routine.declarations.map(({ name }) => name),
    ]);
    const back: { from: string; to: Variable; frame: Frame | undefined }[] = [];
    const lines = new Map<string, string>();
    for (const [i, arg] of args.entries()) {
      const { name, out } = routine.parameters[i]!;
      if (arg === undefined) continue;
      if (arg.kind === "variable" && arg.parts.length === 1 && arg.parts[0]!.indices.length === 0) {
        const items = this.itemsOf(arg.parts[0]!.name);
        if (items.length > 0) {
          for (const [place, value] of items) values.set(name + place, value);
          if (out) back.push({ from: name, to: arg, frame: caller });
          continue;
        }
      }
      if (!out) {
        values.set(name, evaluate(arg, this));
        continue;
      }
      const key = arg.kind === "variable" && arg.parts.length === 1 ? this.meant(keyOf(arg, this)) : "";
      // A line that is handed over is that line itself, not what it is worth now.
      if (this.lines.line(key) !== undefined || this.lines.group(key) !== undefined) {
        lines.set(name, key);
        continue;
      }
      const value = arg.kind === "variable" ? this.read(keyOf(arg, this), arg) : evaluate(arg, this);
      if (value !== undefined)
        values.set(name, arg.kind === "variable" && arg.parts.length > 1 ? evaluate(arg, this) : value);
      if (arg.kind === "variable") back.push({ from: name, to: arg, frame: caller });
    }
    const frame: Frame = {
      routine,
      at: 0,
      last: [],
      step: [],
      chosen: [],
      own,
      values,
      types,
      back,
      lines,
      result: undefined,
    };
    this.stack.push(frame);
    for (const declaration of routine.declarations) this.define(declaration, values, types);
    return frame;
  }

  private leave(): void {
    const frame = this.stack.pop()!;
    for (const { from, to } of frame.back) {
      const value = frame.values.get(from);
      if (value !== undefined) this.assign(to, value, "");
      for (const [key, item] of frame.values)
        if (key.startsWith(`${from}[`)) this.store(to.parts[0]!.name + key.slice(from.length), item, to, "");
    }
  }

  protected instruction(frame: Frame): void {
    const instruction = frame.routine.instructions[frame.at++];
    if (instruction === undefined) this.leave();
    else if (instruction.kind === "statement") this.statement(instruction.statement, frame);
    else this.control(instruction, frame);
  }

  private control(instruction: Exclude<Instruction, { kind: "statement" }>, frame: Frame): void {
    switch (instruction.kind) {
      case "jump":
        this.spend(instruction.at);
        frame.at = instruction.to;
        return;
      case "unless":
        this.spend(instruction.condition);
        if (!boolOf(instruction.condition, this)) frame.at = instruction.to;
        return;
      case "for":
        this.assign(instruction.variable, whole(Math.round(numberOf(instruction.from, this))), "");
        frame.last[instruction.slot] = numberOf(instruction.last, this);
        frame.step[instruction.slot] = instruction.step === undefined ? 1 : numberOf(instruction.step, this);
        if (frame.step[instruction.slot] === 0)
          throw new TextError(instruction.step!, "a step other than 0", "The loop has the step 0.");
        return;
      case "for-check": {
        const value = numberOf(instruction.variable, this);
        const last = frame.last[instruction.slot]!;
        if (frame.step[instruction.slot]! > 0 ? value > last : value < last) frame.at = instruction.to;
        return;
      }
      case "for-next":
        this.spend(instruction.variable);
        this.assign(
          instruction.variable,
          whole(numberOf(instruction.variable, this) + frame.step[instruction.slot]!),
          "",
        );
        frame.at = instruction.to;
        return;
      case "switch":
        frame.chosen[instruction.slot] = evaluate(instruction.value, this);
        return;
      case "case-unless": {
        const chosen = frame.chosen[instruction.slot];
        const hit = instruction.values.some(each => {
          const value = evaluate(each, this);
          return value.kind !== "structure" && chosen?.kind === value.kind && chosen.value === value.value;
        });
        if (!hit) frame.at = instruction.to;
        return;
      }
    }
  }

  protected statement(statement: Statement, frame: Frame): void {
    this.spend(statement);
    switch (statement.kind) {
      case "assign":
        return this.assignment(statement);
      case "motion":
        return this.motion(statement, statement);
      case "spline":
        this.spline = { settings: statement.settings, any: false };
        break;
      case "end-spline":
        this.endSpline(statement);
        break;
      case "wait": {
        if (this.onPath !== undefined) return this.passOver(statement);
        const s = numberOf(statement.time, this);
        if (!(s >= 0)) throw new TextError(statement.time, "a time of 0 s or more", `The time is ${s} s.`);
        this.settle(false);
        return this.step(statement, { id: this.stepId(statement.line), type: "wait", s });
      }
      case "wait-for":
        if (this.onPath !== undefined) return this.passOver(statement);
        return this.waitFor(statement);
      case "pulse": {
        const line = this.lines.line(this.meant(keyOf(statement.output, this)));
        const pulse_s = numberOf(statement.time, this);
        if (line?.wire !== "out")
          throw new TextError(statement.output, "$OUT[n] or its name", "PULSE takes an output.");
        if (!(pulse_s > 0)) throw new TextError(statement.time, "a time above 0 s", `The time is ${pulse_s} s.`);
        this.settle(false);
        const to = boolOf(statement.to, this);
        this.lines.write(line, !to);
        return this.step(statement, { id: this.stepId(statement.line), type: "set", signal: line.name, to, pulse_s });
      }
      case "call":
        return this.callRoutine(statement);
      default:
        return this.flow(statement, frame);
    }
    this.note(statement);
  }

  /** Interrupts, triggers and ends. */
  private flow(
    statement: Exclude<
      Statement,
      { kind: "assign" | "motion" | "spline" | "end-spline" | "wait" | "wait-for" | "pulse" | "call" }
    >,
    frame: Frame,
  ): void {
    switch (statement.kind) {
      case "interrupt":
        this.interrupts.set(numberOf(statement.number, this), {
          condition: statement.condition,
          routine: statement.routine,
          on: false,
        });
        break;
      case "interrupt-switch":
        this.switchInterrupt(statement);
        break;
      case "return":
        if (statement.value !== undefined) frame.result = evaluate(statement.value, this);
        this.leave();
        break;
      case "halt":
        this.settle(false);
        this.stopped = true;
        return this.step(statement, { id: this.stepId(statement.line), type: "stop" });
      case "fault":
        throw new TextError(statement, statement.expected, statement.sentence);
      case "trigger":
        this.triggers.push(statement);
        break;
      case "brake":
      case "resume":
      case "nothing":
        break;
    }
    this.note(statement);
  }

  /** A trigger waits while the robot goes on. */
  private passOver(statement: Statement): void {
    this.remark(
      `wait ${statement.line}`,
      statement,
      "a trigger that does not wait",
      "The wait belongs to a trigger, beside which the robot goes on: it is not carried out.",
    );
    this.note(statement);
  }

  private assignment(statement: Extract<Statement, { kind: "assign" }>): void {
    const { to, value } = statement;
    const key = to.parts.length === 1 ? this.meant(keyOf(to, this)) : "";
    if (key.startsWith("$CYCFLAG[")) {
      this.cyclic.set(key, value);
      return this.note(statement);
    }
    const group = this.lines.group(key);
    if (group !== undefined) return this.setGroup(group, statement);
    const line = to.parts.length === 1 ? this.lines.line(key) : undefined;
    if (line === undefined) {
      if (keyOf(to, this) === "$LOAD") return this.payload(statement);
      this.assign(to, evaluate(value, this), value.kind === "variable" ? spelling(value) : "");
      return this.note(statement);
    }
    if (line.wire === "in" || line.wire === "analogue-in")
      throw new TextError(to, "an output", `${line.name} is an input.`);
    this.settle(false);
    const set = line.wire === "out" ? boolOf(value, this) : numberOf(value, this);
    this.lines.write(line, set);
    this.step(
      statement,
      typeof set === "boolean" && this.lines.isGripper(line)
        ? { id: this.stepId(statement.line), type: "gripper", closed: set }
        : { id: this.stepId(statement.line), type: "set", signal: line.name, to: set },
    );
  }

  /** A number given to a row of outputs: line by line, since nothing moves in between. */
  private setGroup(
    group: NonNullable<ReturnType<Lines["group"]>>,
    statement: Extract<Statement, { kind: "assign" }>,
  ): void {
    const value = numberOf(statement.value, this);
    if (!Number.isInteger(value) || value < 0 || value >= 2 ** group.length)
      throw new TextError(
        statement.value,
        `a whole number from 0 to ${2 ** group.length - 1}`,
        `${group.length} lines do not hold ${value}.`,
      );
    if (group.some(({ wire }) => wire === "in")) throw new TextError(statement.to, "outputs", "Inputs are not set.");
    this.settle(false);
    for (const [i, line] of group.entries()) {
      const to = Math.floor(value / 2 ** i) % 2 === 1;
      this.lines.write(line, to);
      this.step(statement, { id: this.stepId(statement.line), type: "set", signal: line.name, to });
    }
  }

  private payload(statement: Extract<Statement, { kind: "assign" }>): void {
    const load = structureOf(statement.value, this);
    this.settle(false);
    this.step(statement, {
      id: this.stepId(statement.line),
      type: "payload",
      ...this.state.payload(load, statement.value),
    });
  }

  private waitFor(statement: Extract<Statement, { kind: "wait-for" }>): void {
    this.settle(false);
    const { condition } = statement;
    if (condition.kind === "bool") {
      if (!condition.value)
        throw new TextError(condition, "a condition that comes true", "The program waits for ever.");
      return this.note(statement);
    }
    this.takeAllForInputs(condition);
    const unfolded = this.unfolded(condition);
    const all = this.lines.conditions(
      unfolded,
      variable => this.meant(keyOf(variable, this)),
      each => numberOf(each, this),
      each => boolOf(each, this),
    );
    if (all.length === 0) return this.note(statement);
    if (hasAlternatives(unfolded))
      this.remark(
        `alternatives ${statement.line}`,
        statement,
        "one thing to wait for",
        "The wait ends with the first of several inputs: only one of them is waited for here.",
      );
    for (const when of all) this.step(statement, { id: this.stepId(statement.line), type: "wait-for", when });
  }

  private callRoutine(statement: Extract<Statement, { kind: "call" }>): void {
    const { name, args } = statement;
    const routine = this.routine(name);
    if (routine !== undefined) {
      this.enter(routine, args, statement);
      return this.note(statement);
    }
    if (name === "BAS") {
      BAS(args, this.state.system, this, statement);
      return this.note(statement);
    }
    if (name === "MSGNOTIFY") {
      const text = args[0] === undefined ? undefined : evaluate(args[0], this);
      return this.step(statement, {
        id: this.stepId(statement.line),
        type: "message",
        text: text?.kind === "text" ? text.value : "",
      });
    }
    if (!QUIET_ROUTINES.has(name)) {
      if (!OF_PACKAGES.has(name)) throw missingProgram(statement, name);
      this.remark(
        `call ${name}`,
        statement,
        "a routine of this text",
        `${name} belongs to a package of the controller: it is not executed. It does not move the robot.`,
      );
      if (name === "P00") this.lines.asked = true;
    }
    this.note(statement);
  }
}
