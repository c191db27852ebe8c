import {
  SignalTable,
  speedCorner,
  type Executed,
  type MoveStep,
  type Pose,
  type Robot,
  type Signals,
  type Step,
  type TextPlace,
} from "@twincell/core";
import { NotGiven, TextError, missingProgram, type Notices, type ShownAxes } from "../../parser/index.ts";
import type { Expression, Instruction, Routine, Source, Statement } from "../read/syntax.ts";
import { ControllerState, type DeclaredContext } from "./state.ts";
import { fromTrans, times, type Transform } from "./transform.ts";
import { evaluate, keyOf, location, number, signalName, transform, type Precision, type Value } from "./values.ts";

/** Statements without a motion or a wait after which the program is taken to run on the spot for ever. */
const STATEMENTS_WITHOUT_MOTION = 100_000;
/** Calls inside calls. */
const CALL_DEPTH = 40;

/** One program that is being executed, with its place and its loops. */
interface Frame {
  readonly routine: Routine;
  at: number;
  readonly last: number[];
  readonly step: number[];
  readonly chosen: Value[];
  /** Variables of this program alone, and what variables of their names held outside. */
  readonly own: { readonly name: string; readonly held: ReadonlyMap<string, Value>; readonly keeps: boolean }[];
  /** Parameters, what was given for them, and the value they began with. */
  readonly given: {
    readonly parameter: string;
    readonly to: Expression | undefined;
    readonly before: Value | undefined;
  }[];
}

/** Executes a V+ text statement by statement. Deterministic: the same text gives the same steps. */
export class Machine {
  private readonly source: Source;
  private readonly state: ControllerState;
  private readonly continuousPath_m: (step: MoveStep) => number;
  /** A motion of which it is not yet known whether the robot stops at its end, and what was executed since. */
  private pending: { readonly line: number; readonly step: MoveStep } | undefined;
  private readonly since: Executed[] = [];
  private readonly times = new Map<number, number>();
  private idle = 0;
  private readonly notices: Notices | undefined;
  /** What variables of LOCAL held when their program was left. */
  private readonly keptValues = new Map<string, ReadonlyMap<string, Value>>();

  constructor(
    source: Source,
    robot: Robot,
    axes: ShownAxes,
    worldFromBase: Pose<"world", "base">,
    met: DeclaredContext,
    signals: Signals = new SignalTable(),
    notices?: Notices,
  ) {
    this.source = source;
    this.notices = notices;
    this.state = new ControllerState(robot, axes, worldFromBase, met, signals, notices);
    // A program that looks at a line waits for something outside: it does not run on the spot.
    this.state.onRead = () => {
      this.idle = 0;
    };
    this.continuousPath_m = step => speedCorner(robot, step);
  }

  /** @throws {TextError} where the text cannot be executed further. */
  *run(): Generator<Executed, void> {
    for (const statement of [...this.source.data, ...this.source.immediate]) {
      const called: Frame[] = [];
      yield* this.statement(statement, called);
      yield* this.execute(called);
    }
    const main = this.source.routines.values().next();
    if (main.done !== true) yield* this.execute([newFrame(main.value)]);
    yield* this.settle(0);
  }

  private *execute(stack: Frame[]): Generator<Executed, void> {
    let frame: Frame | undefined;
    while ((frame = stack.at(-1)) !== undefined) {
      const instruction = frame.routine.instructions[frame.at++];
      if (instruction === undefined) {
        this.leave(stack);
        continue;
      }
      if (instruction.kind === "statement") yield* this.lenient(instruction.statement, stack);
      else this.control(instruction, frame);
    }
  }

  /** What only the controller knows is left out and told; the arm is then somewhere. */
  private *lenient(statement: Statement, stack: Frame[]): Generator<Executed, void> {
    const { notices, state } = this;
    if (statement.kind === "own" || statement.kind === "kept") {
      this.keptBack(statement, stack.at(-1));
      return yield* this.note({ line: statement.line });
    }
    try {
      yield* this.statement(statement, stack);
    } catch (cause) {
      if (!(cause instanceof NotGiven) || notices === undefined) throw cause;
      const { kind } = statement;
      const isMotion = kind === "move" || kind === "approach" || kind === "depart" || kind === "drive";
      if (isMotion) state.isLost = true;
      if (kind === "set" || kind === "here" || kind === "decompose") state.take(keyOf(statement.to, state));
      if (kind === "tool") state.setTool(fromTrans(0, 0, 0, 0, 0, 0), undefined);
      const instead =
        kind === "tool" ? "it is taken to be the flange." : `${isMotion ? "the motion" : "the line"} is not executed.`;
      notices.notGiven(statement, `${cause.message}: ${instead}`);
      yield* this.note({ line: statement.line });
    }
  }

  /** The end of a program: its own variables go, and its arguments come back to where they were given from. */
  private leave(stack: Frame[]): void {
    const frame = stack.pop();
    if (frame === undefined) return;
    const { state } = this;
    const back = frame.given.map(({ parameter }) => state.read(parameter));
    for (const { name, held, keeps } of frame.own.toReversed()) {
      const values = state.take(name);
      if (keeps) this.keptValues.set(`${frame.routine.name} ${name}`, values);
      for (const [key, value] of held) state.write(key, value);
    }
    for (const [i, { to, before }] of frame.given.entries()) {
      const value = back[i];
      if (to?.kind === "variable" && value !== undefined && value !== before) state.write(keyOf(to, state), value);
    }
  }

  private control(instruction: Exclude<Instruction, { kind: "statement" }>, frame: Frame): void {
    const { state } = this;
    switch (instruction.kind) {
      case "jump":
        this.spend(instruction.at);
        frame.at = instruction.to;
        return;
      case "unless":
        this.spend(instruction.condition);
        if (number(instruction.condition, state) === 0) frame.at = instruction.to;
        return;
      case "for":
        state.write(keyOf(instruction.variable, state), number(instruction.from, state));
        frame.last[instruction.slot] = number(instruction.last, state);
        frame.step[instruction.slot] = instruction.step === undefined ? 1 : number(instruction.step, state);
        if (frame.step[instruction.slot] === 0)
          throw new TextError(instruction.step!, "a step other than 0", "The loop has the step 0.");
        return;
      case "for-check": {
        const value = number(instruction.variable, state);
        const last = frame.last[instruction.slot]!;
        if (frame.step[instruction.slot]! > 0 ? value > last : value < last) frame.at = instruction.to;
        return;
      }
      case "for-next":
        this.spend(instruction.variable);
        state.write(
          keyOf(instruction.variable, state),
          Math.fround(number(instruction.variable, state) + frame.step[instruction.slot]!),
        );
        frame.at = instruction.to;
        return;
      case "switch":
        frame.chosen[instruction.slot] = evaluate(instruction.value, state);
        return;
      case "case-unless":
        if (!instruction.values.some(value => evaluate(value, state) === frame.chosen[instruction.slot]))
          frame.at = instruction.to;
        return;
    }
  }

  private *statement(statement: Statement, stack: Frame[]): Generator<Executed, void> {
    const { state } = this;
    this.spend(statement);
    switch (statement.kind) {
      case "assign": {
        const value = evaluate(statement.value, state);
        if (typeof value === "object")
          throw new TextError(statement.value, "a number or a string", "A location is given to a variable with SET.");
        if ((typeof value === "string") !== statement.to.name.startsWith("$"))
          throw new TextError(
            statement.value,
            "a value of the variable's sort",
            `"${statement.to.name}" takes ${statement.to.name.startsWith("$") ? "a string" : "a number"}.`,
          );
        state.write(keyOf(statement.to, state), value);
        break;
      }
      case "set": {
        const value = location(statement.value, state);
        if ((value.kind === "precision") !== statement.to.name.startsWith("#"))
          throw new TextError(
            statement.value,
            "a location of the variable's sort",
            `"${statement.to.name}" takes a ${statement.to.name.startsWith("#") ? "precision point" : "transformation"}.`,
          );
        state.write(keyOf(statement.to, state), value);
        break;
      }
      case "here":
        state.write(keyOf(statement.to, state), state.here(statement));
        break;
      case "decompose":
        for (const [i, component] of state.decomposed(location(statement.location, state)).entries()) {
          state.write(keyOf(statement.to, state, i), Math.fround(component));
        }
        break;
      case "tool": {
        yield* this.settle(0);
        const named = statement.location?.kind === "variable" ? statement.location.name : undefined;
        state.setTool(
          statement.location === undefined ? fromTrans(0, 0, 0, 0, 0, 0) : transform(statement.location, state),
          named,
        );
        break;
      }
      case "base": {
        yield* this.settle(0);
        const [x, y, z, turn] = [0, 1, 2, 3].map(i =>
          statement.values[i] === undefined ? 0 : number(statement.values[i], state),
        );
        state.setBase(x!, y!, z!, turn!);
        break;
      }
      default:
        return yield* this.setting(statement, stack);
    }
    yield* this.note({ line: statement.line });
  }

  /** How the motions that follow are carried out. */
  private *setting(
    statement: Exclude<Statement, { kind: "assign" | "set" | "here" | "decompose" | "tool" | "base" }>,
    stack: Frame[],
  ): Generator<Executed, void> {
    const { state } = this;
    switch (statement.kind) {
      case "config":
        state.configure(statement.word);
        break;
      case "speed":
        state.setSpeed(number(statement.value, state), statement.unit, statement.always, statement);
        break;
      case "duration":
        state.setDuration(number(statement.value, state), statement.always);
        break;
      case "path":
        state.continuous = statement.continuous;
        break;
      case "break":
        yield* this.settle(0);
        break;
      case "signal":
        return yield* this.set(statement);
      default:
        return yield* this.action(statement, stack);
    }
    yield* this.note({ line: statement.line });
  }

  /** What the robot does, and where the program goes on. */
  private *action(
    statement: Exclude<
      Statement,
      {
        kind:
          | "assign"
          | "set"
          | "here"
          | "decompose"
          | "tool"
          | "base"
          | "config"
          | "speed"
          | "duration"
          | "path"
          | "break"
          | "signal";
      }
    >,
    stack: Frame[],
  ): Generator<Executed, void> {
    const { state } = this;
    switch (statement.kind) {
      case "accel": {
        const percent = number(statement.percent, state);
        if (!(percent > 0))
          throw new TextError(statement.percent, "a percentage above 0", `The acceleration is ${percent} %.`);
        state.accelerate(percent);
        break;
      }
      case "type":
        yield* this.settle(state.continuous ? "continuous" : 0);
        return yield this.done(statement, { id: this.stepId(statement.line), type: "message", text: statement.text });
      case "wait":
        if (statement.condition !== undefined && isOneSignal(statement.condition))
          return yield* this.waitFor(statement, statement.condition.args[0]);
        if (statement.condition !== undefined) this.comesTrue(statement, statement.condition);
        break;
      case "delay":
        return yield* this.delay(statement, number(statement.time, state));
      case "gripper":
        return yield* this.gripper(statement);
      case "move":
      case "approach":
      case "depart":
      case "drive":
        return yield* this.motion(statement);
      case "call":
        this.call(statement, stack);
        break;
      case "return":
        this.leave(stack);
        break;
      case "stop":
        stack.length = 0;
        yield* this.settle(0);
        return yield this.done(statement, { id: this.stepId(statement.line), type: "stop" });
      case "nothing":
        break;
    }
    yield* this.note({ line: statement.line });
  }

  /** A wait for what is no single line: it must be so, or is told where a text is executed as it is. */
  private comesTrue(at: TextPlace, condition: Expression): void {
    if (number(condition, this.state) !== 0) return;
    if (this.notices === undefined)
      throw new TextError(
        condition,
        "a condition that comes true",
        "The program waits for a condition that nothing here makes true.",
      );
    this.notices.add(
      at,
      "a condition of one line",
      `Line ${at.line} waits for what nothing here makes true: the program goes on as if it were.`,
    );
  }

  /** Variables of this program alone; what is kept and shown, of which what would come from outside has no value. */
  private keptBack(statement: Extract<Statement, { kind: "own" | "kept" }>, frame: Frame | undefined): void {
    if (statement.kind === "own") {
      for (const name of statement.names) {
        if (frame === undefined || frame.own.some(each => each.name === name)) continue;
        frame.own.push({ name, held: this.state.take(name), keeps: statement.keeps });
        for (const [key, value] of this.keptValues.get(`${frame.routine.name} ${name}`) ?? [])
          this.state.write(key, value);
      }
      return;
    }
    const sentence = `${statement.word} is kept and shown, and not executed.`;
    this.notices?.add(statement, "a statement that moves the robot", sentence);
    for (const variable of statement.forgets) this.state.take(keyOf(variable, this.state));
  }

  private *motion(
    statement: Extract<Statement, { kind: "move" | "approach" | "depart" | "drive" }>,
  ): Generator<Executed, void> {
    const { state } = this;
    yield* this.settle(state.continuous ? "continuous" : 0);
    if (statement.kind === "move" && statement.hand !== undefined) {
      // The hand moves while the arm does: before the motion is the nearest that a list of steps can say.
      yield this.done(statement, {
        id: this.stepId(statement.line),
        type: "gripper",
        closed: number(statement.hand, state) <= 0,
      });
    }
    if (statement.kind === "drive") state.setSpeed(number(statement.speed, state), "percent", false, statement.speed);
    const straight = statement.kind !== "drive" && statement.straight;
    const step = state.moveTo(this.stepId(statement.line), this.goal(statement), straight);
    this.pending = { line: statement.line, step };
    this.idle = 0;
  }

  private goal(
    statement: Extract<Statement, { kind: "move" | "approach" | "depart" | "drive" }>,
  ): Transform | Precision {
    const { state } = this;
    const back = (from: Transform, distance_mm: number): Transform =>
      times(from, fromTrans(0, 0, -distance_mm, 0, 0, 0));
    switch (statement.kind) {
      case "move":
        return location(statement.location, state);
      case "drive":
        return state.driven(number(statement.joint, state), number(statement.change, state), statement);
      case "depart":
        return back(state.here(statement), number(statement.distance, state));
      case "approach": {
        const target = location(statement.location, state);
        return back(target.kind === "precision" ? state.reached(target) : target, number(statement.distance, state));
      }
    }
  }

  private *delay(statement: Statement, s: number): Generator<Executed, void> {
    if (!(s >= 0)) throw new TextError(statement, "a time of 0 s or more", `The time is ${s} s.`);
    yield* this.settle(0);
    yield this.done(statement, { id: this.stepId(statement.line), type: "wait", s });
  }

  /** A program runs ahead of its motions: without BREAK a signal is set while the robot still moves. */
  private *set(statement: Extract<Statement, { kind: "signal" }>): Generator<Executed, void> {
    yield* this.settle(this.state.continuous ? "continuous" : 0);
    for (const expression of statement.signals) {
      const plain = expression.kind === "unary" && expression.sign === "-" ? expression.of : expression;
      if (plain.kind === "variable" && this.state.isMissing(keyOf(plain, this.state))) {
        const signal = this.state.namedOutput(plain.name);
        this.state.wrote(signal, plain === expression);
        const to = plain === expression;
        yield this.done(statement, { id: this.stepId(statement.line), type: "set", signal, to });
        continue;
      }
      const signed = Math.trunc(number(expression, this.state));
      if (signed === 0) throw new TextError(expression, "a signal from 1", "There is no signal 0.");
      const signal = this.state.line(Math.abs(signed), signalName(expression));
      const to = signed > 0;
      this.state.wrote(signal, to);
      yield this.done(statement, { id: this.stepId(statement.line), type: "set", signal, to });
    }
  }

  private *waitFor(statement: Statement, expression: Expression): Generator<Executed, void> {
    yield* this.settle(0);
    const plain = expression.kind === "unary" && expression.sign === "-" ? expression.of : expression;
    if (plain.kind === "variable" && this.state.isMissing(keyOf(plain, this.state))) {
      this.state.named(plain.name);
      const when = { signal: plain.name, is: plain === expression };
      return yield this.done(statement, { id: this.stepId(statement.line), type: "wait-for", when });
    }
    const signed = Math.trunc(number(expression, this.state));
    const signal = this.state.line(Math.abs(signed), signalName(expression));
    yield this.done(statement, { id: this.stepId(statement.line), type: "wait-for", when: { signal, is: signed > 0 } });
  }

  private *gripper(statement: Extract<Statement, { kind: "gripper" }>): Generator<Executed, void> {
    yield* this.settle(statement.immediate || !this.state.continuous ? 0 : "continuous");
    yield this.done(statement, { id: this.stepId(statement.line), type: "gripper", closed: statement.closed });
  }

  private call(statement: Extract<Statement, { kind: "call" }>, stack: Frame[]): void {
    const routine = this.source.routines.get(statement.program);
    if (routine === undefined) throw missingProgram(statement, statement.program);
    if (stack.length >= CALL_DEPTH)
      throw new TextError(
        statement,
        `at most ${CALL_DEPTH} calls inside each other`,
        `Program ${statement.program} is called more than ${CALL_DEPTH} deep.`,
      );
    if (statement.args.length > routine.parameters.length)
      throw new TextError(
        statement,
        `${routine.parameters.length} arguments`,
        `Program ${statement.program} takes ${routine.parameters.length} arguments; ${statement.args.length} are given.`,
      );
    const { state } = this;
    const values = statement.args.map(arg => this.argument(arg));
    const frame = newFrame(routine);
    // Parameters are the program's own; what it makes of them goes back into the variables that were given.
    for (const [i, name] of routine.parameters.entries()) {
      frame.own.push({ name, held: state.take(name), keeps: false });
      const value = values[i];
      if (value !== undefined) state.write(name, value);
      frame.given.push({ parameter: name, to: statement.args[i], before: value });
    }
    stack.push(frame);
  }

  /** What a program is called with; a variable without a value is given on without one. */
  private argument(arg: Expression): Value | undefined {
    if (arg.kind === "variable" && this.state.isMissing(keyOf(arg, this.state))) return undefined;
    return evaluate(arg, this.state);
  }

  /** Hands out the motion that was waiting for what comes after it. */
  private *settle(end: 0 | "continuous"): Generator<Executed, void> {
    const { pending } = this;
    if (pending === undefined) return;
    this.pending = undefined;
    const step = end === 0 ? pending.step : { ...pending.step, blend_m: this.continuousPath_m(pending.step) };
    yield { line: pending.line, step };
    yield* this.since.splice(0);
  }

  private *note(executed: Executed): Generator<Executed, void> {
    if (this.pending === undefined) yield executed;
    else this.since.push(executed);
  }

  private done(at: TextPlace, step: Step): Executed {
    this.idle = 0;
    return { line: at.line, step };
  }

  /** L12, and L12.2 when line 12 is executed again. */
  private stepId(line: number): string {
    const time = (this.times.get(line) ?? 0) + 1;
    this.times.set(line, time);
    return time === 1 ? `L${line}` : `L${line}.${time}`;
  }

  private spend(at: TextPlace): void {
    if (++this.idle > STATEMENTS_WITHOUT_MOTION) {
      throw new TextError(
        at,
        "a motion, a wait or an end",
        `The program has executed ${STATEMENTS_WITHOUT_MOTION} statements without a motion: it runs on the spot for ever.`,
      );
    }
  }
}

const isOneSignal = (
  condition: Expression,
): condition is Extract<Expression, { kind: "call" }> & { readonly args: readonly [Expression] } =>
  condition.kind === "call" &&
  condition.name === "SIG" &&
  condition.args.length === 1 &&
  condition.args[0] !== undefined;

const newFrame = (routine: Routine): Frame => ({
  routine,
  at: 0,
  last: [],
  step: [],
  chosen: [],
  own: [],
  given: [],
});
