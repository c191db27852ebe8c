import type { Executed, MoveStep, Search, Signals, Step, TextPlace } from "@twincell/core";
import { TextError, WaitsOutside } from "../../parser/index.ts";
import type {
  Declaration,
  Expression,
  Instruction,
  Motion,
  Routine,
  Source,
  Statement,
  Variable,
} from "../read/syntax.ts";
import { BAS, inlineSetting } from "./bas.ts";
import { axesOf, typed, within, type Frame } from "./frame.ts";
import { Lines } from "./signals.ts";
import type { Context, ControllerState } from "./state.ts";
import { spelling } from "./system.ts";
import { boolOf, evaluate, keyOf, numberOf, structureOf, whole, type Memory, type Value } from "./values.ts";

/** Statements without a motion or a wait after which the program is taken to run on the spot for ever. */
const STATEMENTS_WITHOUT_MOTION = 100_000;
/** Calls inside calls. */
const CALL_DEPTH = 40;
/** Dealt with before, or of no consequence for where the robot goes. */
const QUIET_ROUTINES = new Set(["IR_STOPM", "MSGQUIT"]);

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

  constructor(source: Source, state: ControllerState, signals: Signals | undefined, met: Context["signals"]) {
    this.source = source;
    this.state = state;
    this.lines = new Lines(source.signals, signals, met);
  }

  /** @throws {TextError} where the text cannot be executed further. */
  *run(): Generator<Executed, void> {
    for (const declaration of this.source.data) this.define(declaration, this.globals, this.types);
    for (const { to, value } of this.source.elements) this.assign(to, evaluate(value, this), "");
    const main = this.source.routines.values().next();
    if (main.done !== true) {
      this.enter(main.value, [], main.value.place);
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

  // Values ------------------------------------------------------------------------------------------------------------

  read(key: string, at: TextPlace): Value | undefined {
    const line = this.lines.line(key);
    if (line !== undefined) {
      // Looking at a line stops the advance run: the motion before it ends where it was taught.
      this.settle(false);
      // What was done before is executed first: the statement comes again when it has been.
      if (this.ready.length > 0) throw new ReadTooEarly();
      return this.lines.read(line);
    }
    if (key === "$AXIS_ACT") return axesOf(this.state.presentAxes_deg);
    const frame = this.stack.at(-1);
    const name = key.split("[", 1)[0]!;
    if (frame?.own.has(name) === true) return frame.values.get(key);
    return this.globals.get(key) ?? this.state.system.read(key, at);
  }

  call(name: string, args: readonly (Expression | undefined)[], at: TextPlace): Value {
    const routine = this.source.routines.get(name);
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

  private define(
    { name, type, index, value, ...at }: Declaration,
    values: Map<string, Value>,
    types: Map<string, string>,
  ): void {
    if (type !== "") types.set(name, type);
    if (value === undefined) return;
    const key = index.length === 0 ? name : `${name}[${index.map(each => numberOf(each, this)).join(",")}]`;
    if (key.startsWith("$")) this.state.system.write(key, evaluate(value, this), at, "");
    else values.set(key, typed(evaluate(value, this), types.get(name)));
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
          members.map(({ name }) => name),
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
    this.globals.set(key, typed(value, this.types.get(name)));
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
    for (const [i, arg] of args.entries()) {
      const { name, out } = routine.parameters[i]!;
      if (arg === undefined) continue;
      if (!out) {
        values.set(name, evaluate(arg, this));
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
    }
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
        const s = numberOf(statement.time, this);
        if (!(s >= 0)) throw new TextError(statement.time, "a time of 0 s or more", `The time is ${s} s.`);
        this.settle(false);
        return this.step(statement, { id: this.stepId(statement.line), type: "wait", s });
      }
      case "wait-for":
        return this.waitFor(statement);
      case "pulse": {
        const line = this.lines.line(keyOf(statement.output, this));
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
      case "brake":
      case "resume":
      case "nothing":
        break;
    }
    this.note(statement);
  }

  private assignment(statement: Extract<Statement, { kind: "assign" }>): void {
    const { to, value } = statement;
    const line = to.parts.length === 1 ? this.lines.line(keyOf(to, this)) : undefined;
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
    const when = this.lines.condition(
      condition,
      variable => keyOf(variable, this),
      each => numberOf(each, this),
    );
    this.step(statement, { id: this.stepId(statement.line), type: "wait-for", when });
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
    const target = structureOf(motion.target, this);
    this.settle(true);
    const until = this.search();
    const step = this.state.move(this.stepId(at.line), motion, target, via, at);
    this.pending = {
      line: at.line,
      step: until === undefined ? step : { ...step, until },
      passing: this.passing(motion, step),
    };
    if (this.spline !== undefined) this.spline.any = true;
    if (before !== undefined) {
      system.values.clear();
      for (const [key, value] of before.values) system.values.set(key, value);
      system.tool = before.tool;
      system.base = before.base;
    }
    this.idle = 0;
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
    for (const { on, condition, routine } of this.interrupts.values()) {
      if (!on) continue;
      const reaction = this.source.routines.get(routine)?.instructions ?? [];
      if (!reaction.some(each => each.kind === "statement" && each.statement.kind === "brake")) continue;
      const frame = this.stack.at(-1)!;
      const rest = frame.routine.instructions.slice(frame.at);
      const halts = rest.some(each => each.kind === "statement" && each.statement.kind === "halt");
      if (this.stack.length > 1) frame.at = frame.routine.instructions.length;
      return {
        when: this.lines.condition(
          condition,
          variable => keyOf(variable, this),
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
    const routine = this.source.routines.get(name);
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
    if (!QUIET_ROUTINES.has(name))
      throw new TextError(statement, "a routine of this text", `Routine ${name} is not in this text.`);
    this.note(statement);
  }

  // What comes out
  // ------------------------------------------------------------------------------------------------------

  /** Hands out the motion that was waiting for what comes after it. */
  private settle(goesOn: boolean): void {
    const { pending } = this;
    if (pending === undefined) return;
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
