import type { Condition, Executed, MoveStep, Pose, Robot, Signals, Step, Target, TextPlace } from "@twincell/core";
import { NotGiven, TextError } from "../faults.ts";
import type { Notices } from "../notices.ts";
import { rememberMap } from "../remember.ts";
import type { DeclaredCell } from "../declared-cell.ts";
import {
  BlockMachine,
  constantsOf,
  type Argument,
  type Block,
  type Do,
  type Expression,
  type Flow,
  type Routine,
  type Statement,
  type WaitUntil,
} from "../structured/index.ts";
import type { BasicSource } from "./reader.ts";
import { NOWHERE, asPose, on, type Rigid } from "./rigid.ts";
import { UprightArm, type Upright } from "./upright.ts";
import { arithmetic, isUnknown, numberIn, placeIn, sortOf, type PlaceValue, type Value } from "./values.ts";

/** Where a text runs. */
export interface RunContext {
  readonly source: BasicSource;
  readonly robot: Robot;
  readonly worldFromBase: Pose<"world", "base">;
  readonly declared: DeclaredCell;
  readonly signals?: Signals;
  /** Takes what only the controller knows; without, such a thing is refused. */
  readonly notices?: Notices;
}
type Binary = Extract<Expression, { kind: "binary" }>;
type Call = Extract<Expression, { kind: "call" }>;

/**
 * Executes a BASIC statement by statement. S holds what instructions have said: plain values, which are copied to be
 * remembered.
 */
export abstract class BasicMachine<S extends object> extends BlockMachine<Value> {
  readonly declared: DeclaredCell;
  /** Variables whose place is a frame although it changes: the places of a pallet that is being read. */
  readonly places = new Set<string>();
  protected readonly arm: UprightArm;
  protected state: S;
  /** Variables that never change: a place in one of them is a frame of the program. */
  protected readonly constants: Set<string>;
  /** Frames by their names, from the base. */
  protected readonly frames = new Map<string, Rigid>();
  private readonly outputs = new Map<string, boolean>();
  private readonly signals: Signals | undefined;
  private tool = "flange";
  /** Whether the tool was said where the program is now; joint angles alone do not ask for one. */
  private hasTool = false;

  protected readonly notices: Notices | undefined;

  constructor({ source, robot, worldFromBase, declared, signals, notices }: RunContext, upright: Upright, state: S) {
    super(source.routines);
    this.notices = notices;
    this.arm = new UprightArm(robot, upright, worldFromBase);
    this.constants = new Set(constantsOf(source.main, source.routines.values()));
    this.declared = declared;
    this.signals = signals;
    this.state = state;
  }

  // --- the language's own -----------------------------------------------------------------------------------------

  /** What TRUE is as a number. */
  protected abstract readonly truth: number;
  /** A word that the controller knows, or undefined. */
  protected abstract known(name: string): Value | undefined;
  protected abstract applied(call: Call): Value;
  /** The line that an expression reads, or undefined. */
  protected abstract lineIn(expression: Expression): string | undefined;
  /** Signs between places; undefined for numbers and texts. */
  protected joined(_sign: string, _left: Value, _right: Value, _of: Binary): Value | undefined {
    return undefined;
  }
  protected component(_of: Value, name: string, at: TextPlace): Value {
    throw new TextError(at, "a variable", `There is no component ${name}.`);
  }
  /** The steps that an instruction amounts to. */
  protected abstract steps(statement: Do): readonly Step[];

  // --- values -----------------------------------------------------------------------------------------------------

  protected variable(name: string): Value | undefined {
    return this.scopes.at(-1)?.names.get(name) ?? this.globals.get(name);
  }

  /** A variable as it is kept: `p[3]` for the third of a row of places. */
  protected keyOf(expression: Expression): string {
    if (expression.kind === "variable") return expression.name;
    const numbers = (of: readonly Expression[]): string => of.map(index => this.numberOf(index)).join(",");
    if (expression.kind === "index" && expression.of.kind === "variable")
      return `${expression.of.name}[${numbers(expression.indices)}]`;
    if (expression.kind === "call")
      return `${expression.name}[${numbers(expression.args.flatMap(({ value }) => (value === undefined ? [] : [value])))}]`;
    throw new TextError(expression, "a variable", "Only a variable can be given a value.");
  }

  evaluate(expression: Expression): Value {
    switch (expression.kind) {
      case "number":
      case "text":
        return expression.value;
      case "truth":
        return expression.value ? this.truth : 0;
      case "variable":
        return this.namedValue(expression);
      case "index":
        return this.indexedValue(expression);
      case "list":
        throw new TextError(expression, "a value", "A list of numbers stands where a value is expected.");
      case "component":
        return this.component(this.evaluate(expression.of), expression.name, expression);
      case "unary": {
        const value = this.number(this.evaluate(expression.of), expression);
        return expression.sign === "not" ? (value === 0 ? this.truth : 0) : -value;
      }
      case "binary":
        return this.binaryValue(expression);
      case "call": {
        const routine = this.routine(expression.name);
        if (routine !== undefined) return this.answer(routine, expression.args, expression);
        return this.digital(expression) ?? this.applied(expression);
      }
    }
  }

  /** Two values that a sign joins; what decides alone is not asked further. */
  private binaryValue(expression: Extract<Expression, { kind: "binary" }>): Value {
    const { sign, left, right } = expression;
    const a = this.evaluate(left);
    if (sign === "and" && a === 0) return 0;
    const b = this.evaluate(right);
    if (isUnknown(a) || isUnknown(b)) return this.withUnknown(expression, a, b);
    return this.joined(sign, a, b, expression) ?? arithmetic(sign, a, b, is => (is ? this.truth : 0), expression);
  }

  /** An element of an array, or a line by its number. */
  private indexedValue(expression: Extract<Expression, { kind: "index" }>): Value {
    const key = this.keyOf(expression);
    const value = this.variable(key) ?? this.digital(expression);
    if (value === undefined && this.notices !== undefined) return { kind: "unknown", name: key };
    if (value === undefined)
      throw new TextError(expression, "a variable that has a value", `"${key}" has no value yet.`);
    return value;
  }

  /** What a name stands for. */
  private namedValue(expression: Extract<Expression, { kind: "variable" }>): Value {
    const value = this.variable(expression.name) ?? this.known(expression.name);
    if (value === undefined && this.notices !== undefined) return { kind: "unknown", name: expression.name };
    if (value === undefined)
      throw new TextError(expression, "a variable that has a value", `"${expression.name}" has no value yet.`);
    return value;
  }

  isTrue(expression: Expression): boolean {
    return this.numberOf(expression) !== 0;
  }
  numberOf(expression: Expression): number {
    return this.number(this.evaluate(expression), expression);
  }

  /** A number; one that only the controller knows is 0, which is said. */
  private number(value: Value, at: TextPlace): number {
    if (!isUnknown(value)) return numberIn(value, at);
    this.notices?.notGiven(at, `${value.name} is in none of the files: it is taken as 0.`);
    return 0;
  }

  /** A sign beside something that only the controller knows: with a number it is one, with a place a place. */
  private withUnknown(of: Binary, a: Value, b: Value): Value {
    const isNumbers =
      typeof a === "number" || typeof b === "number" || !["+", "-", "*", "/", "@", ":"].includes(of.sign);
    if (!isNumbers) return { kind: "unknown", name: isUnknown(a) ? a.name : isUnknown(b) ? b.name : "" };
    const left = typeof a === "string" ? a : this.number(a, of.left);
    const right = typeof b === "string" ? b : this.number(b, of.right);
    if (typeof left !== typeof right) return 0;
    return arithmetic(of.sign, left, right, is => (is ? this.truth : 0), of);
  }
  fromNumber(value: number): Value {
    return value;
  }
  /** The argument of that place, which must be there. */
  protected given({ name, args, line, column }: Do, i: number, what: string): Expression {
    const value = args[i]?.value;
    if (value === undefined) throw new TextError({ line, column }, what, `${name} is said without ${what}.`);
    return value;
  }

  /** The numbers of a list of arguments; those left out are 0. */
  protected numbers(args: readonly Argument[]): number[] {
    return args.map(({ value }) => (value === undefined ? 0 : this.numberOf(value)));
  }

  protected store(to: Expression, value: Value): void {
    const key = this.keyOf(to);
    const scope = this.scopes.at(-1)?.names;
    // Places belong to the controller, numbers to the routine that counts with them.
    (scope === undefined || this.globals.has(key) || typeof value === "object" ? this.globals : scope).set(key, value);
  }

  // --- lines ------------------------------------------------------------------------------------------------------

  /** The line of that number, under the name of the variable that holds the number, else DO3 and its like. */
  protected line(of: Expression, kind: "digital-in" | "digital-out"): string {
    const { signals } = this.declared;
    const address = this.numberOf(of);
    if (!Number.isInteger(address) || address < 0)
      throw new TextError(of, "the number of a line", `There is no line ${address}.`);
    const found = Object.entries(signals).find(([, line]) => line.address === address && line.kind === kind)?.[0];
    if (found !== undefined) return found;
    const wanted = of.kind === "variable" ? of.name : "";
    const name =
      wanted !== "" && !Object.hasOwn(signals, wanted) ? wanted : `${kind === "digital-in" ? "DI" : "DO"}${address}`;
    signals[name] = { kind, address };
    return name;
  }

  protected override changed(to: Expression): void {
    let of = to;
    while (of.kind === "index" || of.kind === "component") ({ of } = of);
    if (of.kind === "variable") this.constants.delete(of.name);
  }

  /** Where the arm is, for what counts from there. */
  protected hereFor(at: TextPlace): Rigid {
    if (this.arm.isLost) throw new NotGiven(at, "a place", "Where the robot then is is in none of the files");
    return this.arm.here();
  }

  protected set(signal: string, to: boolean, id: string, pulse_s?: number): Extract<Step, { type: "set" }> {
    this.outputs.set(signal, to);
    return { id, type: "set", signal, to, ...(pulse_s === undefined ? {} : { pulse_s }) };
  }

  private digital(expression: Expression): number | undefined {
    const signal = this.lineIn(expression);
    return signal === undefined ? undefined : this.read(signal) ? this.truth : 0;
  }

  private read(signal: string): boolean {
    return this.outputs.get(signal) ?? this.signals?.read(signal) === true;
  }
  private holds(when: Condition): boolean {
    return "is" in when && this.read(when.signal) === when.is;
  }

  /** The condition of one line that an expression is, if it is one. */
  condition(expression: Expression): Condition | undefined {
    if (expression.kind === "unary" && expression.sign === "not") {
      const inner = this.condition(expression.of);
      return inner !== undefined && "is" in inner ? { signal: inner.signal, is: !inner.is } : undefined;
    }
    if (expression.kind === "binary" && (expression.sign === "=" || expression.sign === "<>")) {
      const signal = this.lineIn(expression.left);
      const { right } = expression;
      if (signal === undefined || (right.kind !== "number" && right.kind !== "truth")) return undefined;
      return { signal, is: (right.value !== 0 && right.value !== false) === (expression.sign === "=") };
    }
    const signal = this.lineIn(expression);
    return signal === undefined ? undefined : { signal, is: true };
  }

  /** A label that a jump goes to, until it is met. */
  private pendingJump: { readonly label: string; readonly at: TextPlace } | undefined;

  /** Blocks inside blocks that are executed. */
  private depthOfBlocks = 0;

  override *block(block: Block): Generator<Executed, Flow> {
    this.depthOfBlocks++;
    try {
      for (let i = 0; i < block.length; i++) {
        const flow = yield* this.statement(block[i]!);
        if (this.pendingJump !== undefined) {
          const { label } = this.pendingJump;
          const to = block.findIndex(each => labelOf(each) === label);
          if (to < 0 && this.depthOfBlocks === 1) throw this.unreached();
          if (to < 0) return "break";
          this.pendingJump = undefined;
          i = to;
          continue;
        }
        if (flow !== "next") return flow;
      }
      return "next";
    } finally {
      this.depthOfBlocks--;
    }
  }

  private unreached(): TextError {
    const { label, at } = this.pendingJump!;
    return new TextError(at, "a label of this routine", `The label ${label} is not reached from there.`);
  }

  override *call(routine: Routine, args: readonly Argument[], at: TextPlace): Generator<Executed, Flow> {
    const flow = yield* super.call(routine, args, at);
    if (this.pendingJump !== undefined) throw this.unreached();
    return flow;
  }

  /** A group of lines, by its name: a number that comes from outside. */
  protected group(name: string): number {
    this.declared.signals[name] ??= { kind: "analogue-in" };
    return Number(this.signals?.read(name) ?? 0);
  }

  protected *waitUntil(statement: WaitUntil): Generator<Executed, void> {
    const when = this.condition(statement.when);
    if (this.notices !== undefined && (when === undefined || statement.timeout !== undefined))
      return yield* this.waitAsText(statement, this.notices);
    if (when === undefined)
      throw new TextError(
        statement.when,
        "one line that is waited for",
        "Only a wait for one line can be carried out.",
      );
    if (this.outputs.has(when.signal) && !this.holds(when))
      throw new TextError(
        statement.when,
        "a condition that comes true",
        "The program waits for an output that nothing here changes.",
      );
    const timeout_s = statement.timeout === undefined ? undefined : this.numberOf(statement.timeout);
    yield this.done(statement, {
      id: this.stepId(statement),
      type: "wait-for",
      when,
      ...(timeout_s === undefined ? {} : { timeout_s }),
    });
  }

  // --- how an outline reads it ------------------------------------------------------------------------------------

  placeIn(variable: string): { readonly frame: string; readonly pose: Pose<"frame", "place"> } | undefined {
    const value = this.variable(variable);
    return typeof value === "object" && value.kind === "place" ? this.poseOf<"place">(value) : undefined;
  }

  edge(): void {
    this.hasTool = false;
  }

  override remember(): () => void {
    const values = super.remember();
    const arm = this.arm.remember();
    const outputs = rememberMap(this.outputs);
    const state = { ...this.state };
    const frames = rememberMap(this.frames);
    const { tool, hasTool } = this;
    return () => {
      values();
      arm();
      outputs();
      frames();
      this.state = { ...state };
      this.tool = tool;
      this.hasTool = hasTool;
    };
  }

  // --- moves ------------------------------------------------------------------------------------------------------

  /** A wait that is over when its time is, or for what nothing here makes true. */
  private *waitAsText({ when, timeout, ...at }: WaitUntil, notices: Notices): Generator<Executed, void> {
    const isMet = this.isTrue(when);
    if (!isMet && timeout === undefined)
      notices.add(
        at,
        "a condition of one line",
        `Line ${at.line} waits for what nothing here makes true: the program goes on as if it were.`,
      );
    const s = isMet || timeout === undefined ? 0 : Math.max(0, this.numberOf(timeout));
    yield this.done(at, { id: this.stepId(at), type: "wait", s });
  }

  /** What a statement does that is in none of the files: it may move the robot. */
  protected away(at: TextPlace, what: string): void {
    this.notices?.notGiven(at, `What ${what} does, motions too, is not executed.`);
    this.arm.isLost = true;
  }

  protected *instruction(statement: Do): Generator<Executed, Flow | undefined> {
    const [to] = statement.args;
    if (statement.name === "goto" && to?.value?.kind === "text") {
      this.pendingJump = { label: to.value.value, at: { line: statement.line, column: statement.column } };
      yield { line: statement.line };
      return "break";
    }
    if (statement.name === "label") return undefined;
    let steps: readonly Step[];
    try {
      steps = this.steps(statement);
    } catch (cause) {
      if (!(cause instanceof NotGiven) || this.notices === undefined) throw cause;
      this.notices.notGiven(statement, `${cause.fault.sentence}: the motion is not executed.`);
      this.arm.isLost = true;
      yield { line: statement.line };
      return undefined;
    }
    for (const step of steps) yield this.done(statement, step);
    if (steps.length === 0) yield { line: statement.line };
    return undefined;
  }

  /** @param name  what the program calls the tool; undefined for the bare flange. */
  protected useTool(of: Rigid, name: string | undefined): void {
    this.arm.tool = of;
    this.hasTool = true;
    this.tool = name === undefined ? "flange" : kept(this.declared.tools, asPose(of), name);
  }

  protected placed(at: Rigid, frame = ""): PlaceValue {
    return { kind: "place", at, frame };
  }
  /** The place alone, wherever it was made of. */
  protected unbound({ at, frame, posture: configuration }: PlaceValue): PlaceValue {
    return { kind: "place", at, frame, ...(configuration === undefined ? {} : { posture: configuration }) };
  }
  /** From the base, whatever frame its numbers count in. */
  protected inBase({ at, frame }: PlaceValue): Rigid {
    return frame === "" ? at : on(this.frames.get(frame) ?? NOWHERE, at);
  }

  /** Where a motion goes: remembered as where the arm then is. `asks` for the posture that the place names. */
  protected go(goal: Value, isJoint: boolean, asks: boolean, at: TextPlace): Target {
    const { arm, tool } = this;
    if (typeof goal === "object" && goal.kind === "joints") {
      if (isJoint) arm.goneToAngles(goal.deg);
      else arm.goneTo(arm.atAngles(goal.deg));
      return { q: arm.inRadians(goal.deg), ...(isJoint && !this.hasTool ? {} : { tool }) };
    }
    if (typeof goal === "object" && goal.kind === "unknown") placeIn(goal, at);
    if (typeof goal !== "object" || goal.kind === "shift" || goal.kind === "unknown")
      throw new TextError(
        at,
        "a place",
        `${sortOf(goal).replace(/^./, letter => letter.toUpperCase())} is no place to move to.`,
      );
    const place = this.inBase(goal);
    const configuration =
      asks && goal.posture !== undefined && Object.keys(goal.posture).length > 0 ? goal.posture : undefined;
    const branch = configuration === undefined ? undefined : arm.branchAt(place, configuration);
    if (configuration !== undefined && branch === undefined) this.notInPosture(at);
    arm.goneTo(place);
    return { ...this.poseOf(goal), tool, ...(branch === undefined ? {} : { branch }) };
  }

  private notInPosture(at: TextPlace): void {
    const expected = "a place that is reached so";
    if (this.notices === undefined)
      throw new TextError(at, expected, "The place cannot be reached in the posture that is asked for.");
    this.notices.add(
      at,
      expected,
      `Line ${at.line}: this robot does not reach the place in the posture that is asked for; the nearest is taken.`,
    );
  }

  /** The middle of an arc is passed, not reached. */
  protected passing(goal: Value, at: TextPlace): Target {
    if (typeof goal === "object" && goal.kind === "joints") return { q: this.arm.inRadians(goal.deg), tool: this.tool };
    return { ...this.poseOf(placeIn(goal, at)), tool: this.tool };
  }

  protected move(
    statement: Do,
    path: MoveStep["path"],
    target: Target,
    more: Omit<MoveStep, "id" | "type" | "path" | "target">,
  ): MoveStep {
    return { id: this.stepId(statement), type: "move", path, target, ...more };
  }

  private poseOf<From extends string = "tcp">({
    at,
    frame,
    within,
  }: PlaceValue): { readonly pose: Pose<"frame", From>; readonly frame: string } {
    if (within !== undefined) {
      const { variable, of } = within;
      const { frames } = this.declared;
      if (!this.places.has(variable)) frames[variable] ??= this.arm.inWorld(of);
      return { pose: asPose(within.at), frame: variable };
    }
    if (frame === "") return { pose: this.arm.inWorld(at), frame: "world" };
    return { pose: asPose(at), frame };
  }

  /** A frame that numbers count in from now on, under the name of the variable that holds its number. */
  protected frameAt(name: string, of: Rigid): void {
    this.frames.set(name, of);
    this.declared.frames[name] ??= this.arm.inWorld(of);
  }
}

const labelOf = (statement: Statement): string | undefined =>
  statement.kind === "do" && statement.name === "label" && statement.args[0]?.value?.kind === "text"
    ? statement.args[0].value.value
    : undefined;

/** A place met before keeps its name; two never share one. */
function kept<T>(table: Record<string, T>, value: T, wanted: string): string {
  const text = JSON.stringify(value);
  for (let i = 1; ; i++) {
    const name = i === 1 ? wanted : `${wanted}_${i}`;
    const known = Object.hasOwn(table, name) ? table[name] : undefined;
    if (known === undefined) table[name] = value;
    if (known === undefined || JSON.stringify(known) === text) return name;
  }
}
