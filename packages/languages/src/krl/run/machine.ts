import type { Executed, MoveStep, Search, Signals, Step, TextFault, TextPlace } from "@twincell/core";
import { TextError, missingProgram, WaitsOutside, textFault } from "../../parser/index.ts";
import type {
  Declaration,
  Expression,
  Instruction,
  Motion,
  Routine,
  Source,
  Statement,
  Trigger,
  Variable,
} from "../read/syntax.ts";
import { BAS, inlineSetting } from "./bas.ts";
import { axesOf, typed, within, type Frame } from "./frame.ts";
import { Lines } from "./signals.ts";
import type { Context, ControllerState } from "./state.ts";
import { spelling, type System } from "./system.ts";
import {
  bool,
  boolOf,
  evaluate,
  fromFrame,
  indexed,
  keyOf,
  numberOf,
  structureOf,
  whole,
  type Memory,
  type Structure,
  type Value,
} from "./values.ts";

/** Statements without a motion or a wait after which the program is taken to run on the spot for ever. */
const STATEMENTS_WITHOUT_MOTION = 100_000;
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
/** Where the robot is, was called or will be: where it is sent, since nothing overtakes a motion here. */
const PLACES = /^\$(?:POS|AXIS)_(?:ACT|FOR|BACK|RET|INT|ACT_MES)$/;

const hasAlternatives = (of: Expression): boolean =>
  of.kind === "binary" && (of.sign === "OR" || hasAlternatives(of.left) || hasAlternatives(of.right));

/** A line is looked at while what stands before it is not executed yet. Never leaves the machine. */
class ReadTooEarly extends Error {}

/**
 * Executes a KRL module statement by statement. Deterministic: the same text and the same signals give the same steps.
 */
export class Machine implements Memory {
  readonly lines: Lines;
  private readonly source: Source;
  private readonly state: ControllerState;
  private readonly globals = new Map<string, Value>();
  private readonly types = new Map<string, string>();
  private readonly stack: Frame[] = [];
  private readonly times = new Map<number, number>();
  private readonly interrupts = new Map<
    number,
    { readonly condition: Expression; readonly routine: string; on: boolean }
  >();
  private spline: { readonly settings: Motion["settings"]; any: boolean } | undefined;
  /** A motion of which it is not yet known whether the robot stops at its end, and what was executed since. */
  private pending:
    | {
        readonly line: number;
        readonly step: MoveStep;
        readonly passing: Partial<Pick<MoveStep, "blend_m" | "blend_ratio">>;
      }
    | undefined;
  private readonly since: Executed[] = [];
  private ready: Executed[] = [];
  private idle = 0;
  private stopped = false;
  /** What the next motion does at its start and at its end. */
  private triggers: Extract<Statement, { kind: "trigger" }>[] = [];
  /** Depth of the routine that a trigger calls; what it does leaves the motion alone. */
  private onPath: number | undefined;
  private defining = "";
  /** Cyclic flags: what each of them is at any time. */
  private readonly cyclic = new Map<string, Expression>();
  /** Why nobody knows where the robot is: a sentence. */
  private lost: string | undefined;
  /** Names that modules declare for themselves, with the modules; names that all know. */
  private readonly owners = new Map<string, string[]>();
  private readonly shared = new Set<string>();
  /** What a person should know of a run: by what it is about. */
  readonly notes = new Map<string, TextFault>();

  constructor(source: Source, state: ControllerState, signals: Signals | undefined, met: Context["signals"]) {
    this.source = source;
    this.state = state;
    this.lines = new Lines(source.signals, signals, met);
    for (const { name, data } of source.modules.values())
      for (const declared of data) {
        if (declared.isGlobal) this.shared.add(declared.name);
        else if (!(this.owners.get(declared.name) ?? []).includes(name))
          this.owners.set(declared.name, [...(this.owners.get(declared.name) ?? []), name]);
      }
  }

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

  /** The data lists: that of the controller first, since the others count on it. */
  private initialize(): void {
    const modules = [...this.source.modules.values()];
    const own = this.source.main?.module ?? modules[0]?.name;
    for (const module of [
      ...modules.filter(each => each.name.startsWith("$")),
      ...modules.filter(each => !each.name.startsWith("$")),
    ]) {
      this.defining = module.name;
      for (const declaration of module.data)
        this.attempt(module.name === own, () => {
          this.define(declaration, this.globals, this.types, this.homeOf(declaration.name));
        });
      for (const { to, value } of module.elements)
        this.attempt(module.name === own, () => {
          this.assign(to, evaluate(value, this), "");
        });
    }
    this.defining = "";
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

  /** What is wrong in the data of another file shows when it is asked for. */
  private attempt(isOwn: boolean, act: () => void): void {
    try {
      act();
    } catch (cause) {
      if (isOwn || !(cause instanceof TextError)) throw cause;
    }
  }

  /** The module whose data list a name belongs to, or nothing for what every module knows. */
  private homeOf(name: string): string {
    const owners = this.owners.get(name);
    if (owners === undefined || this.source.modules.size < 2) return "";
    const module = this.stack.at(-1)?.routine.module ?? this.defining;
    if (owners.includes(module)) return `${module} `;
    return this.shared.has(name) || owners.length > 1 ? "" : `${owners[0]!} `;
  }

  /** A routine as the one that is being executed calls it: of its own module first. */
  private routine(name: string): Routine | undefined {
    const module = this.source.modules.get(this.stack.at(-1)?.routine.module ?? this.source.main?.module ?? "");
    const near = module?.routines.get(name) ?? this.source.shared.get(name);
    if (near !== undefined) return near;
    const others = [...this.source.modules.values()].flatMap(each => each.routines.get(name) ?? []);
    return others.length === 1 ? others[0] : undefined;
  }

  /** Says something once. */
  private remark(about: string, at: TextPlace, expected: string, sentence: string): void {
    if (!this.notes.has(about)) this.notes.set(about, textFault(at, expected, sentence));
  }

  // Values ------------------------------------------------------------------------------------------------------------

  read(key: string, at: TextPlace): Value | undefined {
    const named = this.meant(key);
    if (named !== key) return this.read(named, at);
    if (this.cyclic.size > 0) {
      const cyclic = this.cyclic.get(key);
      if (cyclic !== undefined) return evaluate(cyclic, this);
    }
    const group = this.lines.group(key);
    if (group !== undefined) {
      const bits = group.map(({ wire, address }) => this.read(`$${wire.toUpperCase()}[${address}]`, at));
      return whole(bits.reduce((sum, bit, i) => sum + (bit?.kind === "bool" && bit.value ? 2 ** i : 0), 0));
    }
    const line = this.lines.line(key);
    if (line !== undefined) {
      // Looking at a line stops the advance run: the motion before it ends where it was taught.
      this.settle(false);
      // What was done before is executed first: the statement comes again when it has been.
      if (this.ready.length > 0 && this.onPath === undefined) throw new ReadTooEarly();
      return this.lines.read(line);
    }
    if (key.startsWith("$") && PLACES.test(key)) return this.whereNow(key, at);
    if (key === "PGNO") return this.lines.outsideNumber("PGNO");
    const frame = this.stack.at(-1);
    const name = key.split("[", 1)[0]!;
    if (frame?.own.has(name) === true) return frame.values.get(key);
    return this.globals.get(this.homeOf(name) + key) ?? this.state.system.read(key, at);
  }

  /** The key of what a name stands for: a line that was handed over, or another name of a system variable. */
  private meant(key: string): string {
    const given = this.stack.at(-1)?.lines;
    const own = given === undefined || given.size === 0 ? key : (given.get(key) ?? key);
    return this.lines.hasNames ? this.lines.alias(own) : own;
  }

  /** A condition with cyclic flags replaced by what they always are. */
  private unfolded(of: Expression): Expression {
    if (of.kind === "variable") return this.cyclic.get(keyOf(of, this)) ?? of;
    if (of.kind === "unary") return { ...of, of: this.unfolded(of.of) };
    return of.kind === "binary" ? { ...of, left: this.unfolded(of.left), right: this.unfolded(of.right) } : of;
  }

  /** Where the robot is; asking for it stops the advance run. */
  private whereNow(key: string, at: TextPlace): Value {
    this.settle(false);
    if (this.lost !== undefined)
      throw new TextError(at, "a position that is known", `${this.lost} ${key} is not known here.`);
    return key.startsWith("$AXIS")
      ? axesOf(this.state.presentAxes_deg)
      : fromFrame(this.state.here(), { kind: "structure", type: "E6POS", fields: new Map() });
  }

  call(name: string, args: readonly (Expression | undefined)[], at: TextPlace): Value {
    if (name === "VARSTATE") return this.stateOf(args[0], at);
    const routine = this.routine(name);
    if (routine?.isFunction !== true)
      throw new TextError(at, "a function of KRL or of this text", `"${name}" is no function that is understood here.`);
    const depth = this.stack.length;
    const frame = this.enter(routine, args, at);
    const steps = (): number => this.times.size;
    const before = steps();
    while (this.stack.length > depth) this.instruction(this.stack.at(-1)!);
    if (steps() !== before) throw new TextError(at, "a function that computes", `Function ${name} moves the robot.`);
    if (frame.result === undefined)
      throw new TextError(at, "a function with RETURN", `Function ${name} ends without a result.`);
    return frame.result;
  }

  /** VARSTATE("NAME") */
  private stateOf(of: Expression | undefined, at: TextPlace): Value {
    const name = of === undefined ? undefined : evaluate(of, this);
    if (name?.kind !== "text") throw new TextError(at, "a name as a text", "VARSTATE takes the name of a variable.");
    const key = name.value.trim().toUpperCase();
    const isThere = this.read(key, at) !== undefined || this.itemsOf(key).length > 0;
    return { kind: "enum", value: isThere ? "#INITIALIZED" : this.isDeclared(key) ? "#DECLARED" : "#UNDEFINED" };
  }

  private define(
    { name, type, index, value, ...at }: Declaration,
    values: Map<string, Value>,
    types: Map<string, string>,
    home = "",
  ): void {
    if (type !== "") types.set(home + name, type);
    if (value === undefined) return;
    const key = index.length === 0 ? name : `${name}[${index.map(each => numberOf(each, this)).join(",")}]`;
    if (key.startsWith("$")) this.state.system.write(key, evaluate(value, this), at, "");
    else values.set(home + key, typed(evaluate(value, this), types.get(home + name)));
  }

  private assign(to: Variable, value: Value, source: string): void {
    const key = keyOf(to, this);
    const [, ...members] = to.parts;
    if (members.length > 0) {
      const before = this.read(key, to);
      return this.store(
        key,
        within(
          before?.kind === "structure" ? before : { kind: "structure", type: undefined, fields: new Map() },
          members.map(({ name, indices }) => indexed(name, indices, this, to)),
          value,
        ),
        to,
        "",
      );
    }
    this.store(key, value, to, source);
  }

  private store(key: string, value: Value, at: TextPlace, source: string): void {
    if (key.startsWith("$")) return this.state.system.write(key, value, at, source);
    const frame = this.stack.at(-1);
    const name = key.split("[", 1)[0]!;
    if (frame?.own.has(name) === true) {
      frame.values.set(key, typed(value, frame.types.get(name)));
      return;
    }
    const home = this.homeOf(name);
    this.globals.set(home + key, typed(value, this.types.get(home + name)));
    // The system looks these up itself.
    if (/^(?:DEF_|TOOL_DATA|BASE_DATA)/.test(key)) this.state.system.write(key, value, at, source);
  }

  // Order of execution ------------------------------------------------------------------------------------------------

  private enter(routine: Routine, args: readonly (Expression | undefined)[], at: TextPlace): Frame {
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

  /** The items of an array, each with its place: `[1,2]`. */
  private itemsOf(name: string): [place: string, value: Value][] {
    const frame = this.stack.at(-1);
    const home = this.homeOf(name) + name;
    const [values, prefix] = frame?.own.has(name) === true ? [frame.values, `${name}[`] : [this.globals, `${home}[`];
    const items: [string, Value][] = [];
    for (const [key, value] of values) if (key.startsWith(prefix)) items.push([key.slice(prefix.length - 1), value]);
    return items;
  }

  private instruction(frame: Frame): void {
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

  private statement(statement: Statement, frame: Frame): void {
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

  takeForInput(variable: Variable): boolean {
    const name = variable.parts[0]!.name;
    const isOne = variable.parts.length === 1 && variable.parts[0]!.indices.length === 0;
    if (!isOne || name.startsWith("$") || this.isDeclared(name) || this.meant(name) !== name) return false;
    if (this.lines.line(name) !== undefined || this.lines.group(name) !== undefined) return true;
    if (this.globals.has(name) || this.state.system.read(name, variable) !== undefined) return false;
    this.lines.takeForInput(name);
    this.remark(
      `input ${name}`,
      variable,
      "the data list that declares it",
      `${name} is declared in no file that is open: it counts as an input, off until it is given by hand.`,
    );
    return true;
  }

  /** Every name of a condition that nothing declares. */
  private takeAllForInputs(of: Expression): void {
    if (of.kind === "variable") this.takeForInput(of);
    else if (of.kind === "unary" && of.sign === "NOT") this.takeAllForInputs(of.of);
    else if (of.kind === "binary" && (of.right.kind === "bool" || ["AND", "OR", "EXOR"].includes(of.sign))) {
      this.takeAllForInputs(of.left);
      this.takeAllForInputs(of.right);
    }
  }

  // Motion ------------------------------------------------------------------------------------------------------------

  private motion(motion: Motion, at: TextPlace): void {
    const { system } = this.state;
    const settings = [...(this.spline?.settings ?? []), ...motion.settings];
    if (motion.motion === "SPL" && this.spline === undefined)
      throw new TextError(at, "SPLINE before it", "SPL stands outside a SPLINE block.");
    const before =
      settings.length === 0 ? undefined : { values: new Map(system.values), tool: system.tool, base: system.base };
    for (const [to, value] of settings) this.setting(to, value);
    const via = motion.via === undefined ? undefined : structureOf(motion.via, this);
    const target = this.pointOf(motion, at);
    if (target === undefined) return this.leftOut(before);
    if (this.onPath !== undefined)
      throw new TextError(at, "a routine that does not move", "What a trigger does must not move the robot here.");
    this.knowsWhere(motion, target, at);
    this.fire("start");
    this.settle(true);
    const until = this.search();
    this.lost = until === undefined ? undefined : "The robot may stop anywhere on the way of the search before this.";
    const step = this.state.move(this.stepId(at.line), motion, target, via, at);
    this.pending = {
      line: at.line,
      step: until === undefined ? step : { ...step, until },
      passing: this.passing(motion, step),
    };
    if (this.spline !== undefined) this.spline.any = true;
    if (before !== undefined) this.takeBack(before);
    this.idle = 0;
    this.fire("end");
  }

  /** What WITH set holds for one motion only. */
  private takeBack({
    values,
    tool,
    base,
  }: Pick<System, "tool" | "base"> & { readonly values: Map<string, Value> }): void {
    const { system } = this.state;
    system.values.clear();
    for (const [key, value] of values) system.values.set(key, value);
    system.tool = tool;
    system.base = base;
  }

  /** The target of a motion, or undefined for a point that only the controller has. */
  private pointOf({ target, relative }: Motion, at: TextPlace): Structure | undefined {
    const name = target.kind === "variable" && target.parts.length === 1 ? keyOf(target, this) : undefined;
    if (
      relative ||
      name === undefined ||
      name.startsWith("$") ||
      this.isDeclared(name) ||
      this.read(name, at) !== undefined
    )
      return structureOf(target, this);
    this.remark(
      `point ${name}`,
      at,
      "the data list that holds the point",
      `The motion to ${name} is left out: the point is kept on the controller. Put its data list beside the program. The robot goes on to the next point from where it is.`,
    );
    return undefined;
  }

  private isDeclared(key: string): boolean {
    const name = key.split("[", 1)[0]!;
    return this.stack.at(-1)?.own.has(name) === true || this.owners.has(name) || this.shared.has(name);
  }

  private leftOut(before: Parameters<Machine["takeBack"]>[0] | undefined): void {
    if (before !== undefined) this.takeBack(before);
    this.settle(false);
    this.triggers = [];
    this.lost = "The robot was to be at a point that is kept on the controller.";
  }

  /** After a motion whose end is not known nothing counts from where the robot is. */
  private knowsWhere({ relative }: Motion, target: Structure, at: TextPlace): void {
    if (this.lost === undefined) return;
    const isWhole = (["X", "Y", "Z", "A", "B", "C"] as const).every(name => target.fields.has(name));
    const isAxes = (["A1", "A2", "A3", "A4", "A5", "A6"] as const).every(name => target.fields.has(name));
    if (relative || (!isWhole && !isAxes))
      throw new TextError(at, "a whole position", `${this.lost} What counts from there is not carried out.`);
  }

  // Triggers ----------------------------------------------------------------------------------------------------------

  /** Does what was asked for at the start or at the end of a motion, while the robot goes on. */
  private fire(which: "start" | "end"): void {
    if (this.triggers.length === 0) return;
    const isAtStart = ({ distance, onStart }: Trigger): boolean =>
      distance === undefined ? onStart : numberOf(distance, this) === 0;
    const due = this.triggers.filter(each => which === "end" || isAtStart(each));
    this.triggers = this.triggers.filter(each => !due.includes(each));
    for (const each of due) this.trigger(each);
  }

  private trigger({ path, delay, action, ...at }: Extract<Statement, { kind: "trigger" }>): void {
    const way_mm = path === undefined ? 0 : numberOf(path, this);
    const later_ms = delay === undefined ? 0 : numberOf(delay, this);
    if (way_mm !== 0 || later_ms !== 0)
      this.remark(
        `trigger ${at.line}`,
        at,
        "a trigger at the point itself",
        `The trigger acts at the point itself: ${way_mm} mm along the path and ${later_ms} ms from there are not carried out.`,
      );
    const depth = this.stack.length;
    const { onPath } = this;
    this.onPath = depth;
    this.statement(action, this.stack.at(-1)!);
    while (this.stack.length > depth && !this.stopped) this.instruction(this.stack.at(-1)!);
    this.onPath = onPath;
  }

  /** How the robot would pass the point if a motion follows. */
  private passing({ approximation }: Motion, { path }: MoveStep): Partial<Pick<MoveStep, "blend_m" | "blend_ratio">> {
    const { system } = this.state;
    if (this.spline !== undefined) return path === "spline" ? {} : { blend_m: system.approximation_m };
    if (approximation.length === 0) return {};
    // C_PTP counts in percent of the way, everything else by the distance.
    return path === "ptp" && approximation[0] === "C_PTP" && !approximation.includes("C_DIS")
      ? { blend_ratio: Math.min(1, system.approximationRatio) }
      : { blend_m: system.approximation_m };
  }

  private endSpline({ approximation }: Extract<Statement, { kind: "end-spline" }>): void {
    const { spline, pending } = this;
    this.spline = undefined;
    if (spline?.any !== true || pending === undefined) return;
    this.pending = {
      ...pending,
      passing: approximation.length === 0 ? {} : { blend_m: this.state.system.approximation_m },
    };
    // What follows a block that ends with a stop does not belong to its curve.
    if (approximation.length === 0) this.settle(false);
  }

  /** One setting of a WITH: a variable, or what a function of the controller makes of it. */
  private setting(to: Variable, value: Expression): void {
    const { system } = this.state;
    const first = value.kind === "call" ? value.args[0] : undefined;
    if (value.kind === "call" && first !== undefined) {
      if (value.name === "STOOL2" || value.name === "SBASE")
        return this.chooseFrame(value.name === "STOOL2" ? "TOOL" : "BASE", first);
      if (inlineSetting(value.name, first, system, this) === "done") return;
    }
    this.assign(to, evaluate(value, this), value.kind === "variable" ? spelling(value) : "");
  }

  private chooseFrame(which: "TOOL" | "BASE", of: Expression): void {
    const value = evaluate(of, this);
    const index = value.kind === "structure" ? value.fields.get(`${which}_NO`) : value;
    if (index?.kind === "number") this.state.system.choose(which, index.value, of);
  }

  /**
   * The search that a motion is while an interrupt is on whose routine brakes. RESUME leaves the routine of the motion,
   * so what follows in it is only done when nothing was met: a HALT there is what "not found" leads to.
   */
  private search(): Search | undefined {
    for (const [number, { on, condition, routine }] of this.interrupts) {
      if (!on) continue;
      const reaction = this.routine(routine)?.instructions ?? [];
      if (!reaction.some(each => each.kind === "statement" && each.statement.kind === "brake")) continue;
      const watched = this.unfolded(condition);
      if (hasAlternatives(watched)) {
        this.remark(
          `interrupt ${number}`,
          condition,
          "one line to watch",
          `Interrupt ${number} stops the robot at one of several inputs: it is not watched.`,
        );
        continue;
      }
      const frame = this.stack.at(-1)!;
      const rest = frame.routine.instructions.slice(frame.at);
      const halts = rest.some(each => each.kind === "statement" && each.statement.kind === "halt");
      if (this.stack.length > 1) frame.at = frame.routine.instructions.length;
      return {
        when: this.lines.condition(
          watched,
          variable => this.meant(keyOf(variable, this)),
          each => numberOf(each, this),
        ),
        missing: halts && this.stack.length > 1 ? "fault" : "continue",
      };
    }
    return undefined;
  }

  private switchInterrupt({ on, number }: Extract<Statement, { kind: "interrupt-switch" }>): void {
    const which = number === undefined ? undefined : numberOf(number, this);
    for (const [key, interrupt] of this.interrupts) if (which === undefined || key === which) interrupt.on = on;
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

  // What comes out
  // ------------------------------------------------------------------------------------------------------

  /** Hands out the motion that was waiting for what comes after it. */
  private settle(goesOn: boolean): void {
    const { pending } = this;
    if (pending === undefined || (this.onPath !== undefined && !goesOn)) return;
    this.pending = undefined;
    this.ready.push(
      { line: pending.line, step: goesOn ? { ...pending.step, ...pending.passing } : pending.step },
      ...this.since.splice(0),
    );
  }

  private note({ line }: TextPlace): void {
    if (this.pending === undefined) this.ready.push({ line });
    else this.since.push({ line });
  }

  private step({ line }: TextPlace, step: Step): void {
    this.idle = 0;
    if (this.pending === undefined) this.ready.push({ line, step });
    else this.since.push({ line, step });
  }

  /** L12, and L12.2 when line 12 is executed again. */
  private stepId(line: number): string {
    const time = (this.times.get(line) ?? 0) + 1;
    this.times.set(line, time);
    return time === 1 ? `L${line}` : `L${line}.${time}`;
  }

  private spend(at: TextPlace): void {
    if (++this.idle <= STATEMENTS_WITHOUT_MOTION) return;
    if (this.lines.asked) throw new WaitsOutside(at);
    throw new TextError(
      at,
      "a motion, a wait or an end",
      `The program has executed ${STATEMENTS_WITHOUT_MOTION} statements without a motion: it runs on the spot for ever.`,
    );
  }
}
