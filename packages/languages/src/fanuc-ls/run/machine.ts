import type { Condition, Executed, MoveStep, Pose, Robot, Signals, Step, Target, TextPlace } from "@twincell/core";
import { TextError, rememberMap, type DeclaredCell } from "../../parser/index.ts";
import {
  BlockMachine,
  type Argument,
  type Block,
  type Do,
  type Expression,
  type Flow,
  type Routine,
  type Statement,
  type WaitUntil,
} from "../../parser/structured/index.ts";
import type { Action, Motion, Point } from "../read/actions.ts";
import type { PositionRecord } from "../read/listing.ts";
import type { Source } from "../read/source.ts";
import { ControllerArm } from "./arm.ts";
import { Lines, isLineWord, kindOfLine } from "./lines.ts";
import { fromSix, inverted, moved, times, toPose, toSix, type Matrix } from "./matrix.ts";
import { speedOf } from "./pace.ts";
import { Setups } from "./setups.ts";
import { asNumber, binary, isSix, type Value } from "./values.ts";

const GRIPPER = "ro1";
/** $WAITTMOUT counts hundredths of a second; 30 s when nobody has set it. */
const TIMEOUT = 3000;

/** A position register that is the difference of two others: how far a place is from the first. */
interface Difference {
  readonly present: string;
  readonly first: string;
}

/** Executes TP statement by statement. */
export class Machine extends BlockMachine<Value> {
  readonly arm: ControllerArm;
  readonly declared: DeclaredCell;
  /** Registers that hold how far the place of a pallet is off, while the pallet is read as one. */
  readonly places = new Set<string>();
  private readonly source: Source;
  private readonly lines: Lines;
  private readonly setups: Setups;
  private readonly writesDown: boolean;
  private readonly differences = new Map<string, Difference>();
  private timeout = TIMEOUT;
  private skip: Expression | undefined;
  private offset: string | undefined;
  private toolOffset: string | undefined;
  /** Where the further axes stood at the last taught position. */
  private others: string | undefined;
  /** Arguments of the calls under way, the innermost last. */
  private readonly given: (readonly Value[])[] = [];
  private jump: number | undefined;

  /** Frames and tools that were used and are set up nowhere in the text. */
  get assumed(): ReadonlyMap<string, TextPlace> {
    return this.setups.assumed;
  }

  /**
   * @param writesDown  the program becomes steps to be kept: poses stay poses, whatever turn of an axis the text asks
   *   for.
   */
  constructor(
    source: Source,
    robot: Robot,
    worldFromBase: Pose<"world", "base">,
    declared: DeclaredCell,
    signals: Signals | undefined,
    writesDown: boolean,
  ) {
    super(source.routines);
    this.source = source;
    this.arm = new ControllerArm(robot, worldFromBase);
    this.declared = declared;
    this.lines = new Lines(declared.signals, signals, name => this.spelt(name));
    this.setups = new Setups(declared, this.arm);
    this.writesDown = writesDown;
  }

  *main(): Generator<Executed, Flow> {
    return yield* this.call(this.source.main, [], this.source.main);
  }

  /** The body of the first program, to be written down. */
  open(): Block {
    this.scopes.push({ routine: this.source.main.name, names: new Map() });
    return this.source.main.body;
  }

  spelt(name: string): string {
    const { labels, spelling } = this.source;
    return (
      labels.get(name) ??
      spelling.get(name) ??
      name.replace(/^([a-z]+)([0-9]+)$/, (_, word: string, number: string) => `${word.toUpperCase()}[${number}]`)
    );
  }

  // --- jumps ------------------------------------------------------------------------------------------------------

  override *block(block: Block): Generator<Executed, Flow> {
    for (let i = 0; i < block.length; i++) {
      const statement = block[i]!;
      const flow = yield* this.statement(statement);
      if (this.jump !== undefined) {
        const to = block.findIndex(each => this.isLabel(each, this.jump!));
        if (to < 0) return "break";
        this.jump = undefined;
        i = to;
        continue;
      }
      if (flow !== "next") return flow;
    }
    return "next";
  }

  private isLabel(statement: Statement, label: number): boolean {
    const action = this.source.actions.get(statement);
    return action?.kind === "label" && action.label === label;
  }

  // --- values -----------------------------------------------------------------------------------------------------

  evaluate(expression: Expression): Value {
    switch (expression.kind) {
      case "number":
      case "truth":
        return expression.value;
      case "variable": {
        if (expression.name === "lpos")
          return [
            ...toSix(
              times(
                times(inverted(this.setups.now("uframe", expression).matrix), this.arm.flange),
                this.setups.now("utool", expression).matrix,
              ),
            ),
          ];
        return this.register(expression.name, expression);
      }
      case "index": {
        const { of, indices } = expression;
        const word = of.kind === "variable" ? of.name : "";
        const [first, second] = indices.map(index => this.numberOf(index));
        if (isLineWord(word)) return this.lines.read(this.lines.line(word, first!, expression));
        if (word === "ar") {
          const argument = this.given.at(-1)?.[first! - 1];
          if (argument === undefined)
            throw new TextError(
              expression,
              "an argument of the call",
              `The program is called without an argument ${first}.`,
            );
          return argument;
        }
        if (word !== "r" && word !== "pr")
          throw new TextError(expression, "R[n], PR[n] or a line", `${word.toUpperCase()}[] is not read here.`);
        const value = this.register(`${word}${first}`, expression);
        if (second === undefined) return value;
        const part = isSix(value) ? value[second - 1] : undefined;
        if (part === undefined)
          throw new TextError(expression, "PR[n,1] … PR[n,6]", `PR[${first}] has no element ${second}.`);
        return part;
      }
      case "unary":
        return expression.sign === "!" ? !this.isTrue(expression.of) : -this.numberOf(expression.of);
      case "binary":
        return binary(expression.sign, this.evaluate(expression.left), this.evaluate(expression.right), expression);
      default:
        throw new TextError(expression, "a value of TP", "This is no value of TP.");
    }
  }

  private register(name: string, at: TextPlace): Value {
    const value = this.holder(name).get(name);
    if (value === undefined)
      throw new TextError(at, "a register that has a value", `${this.spelt(name)} has no value here.`);
    return value;
  }

  /** Where a register is kept: those that loops count in belong to the call. */
  private holder(name: string): Map<string, Value> {
    return this.scopes.findLast(({ names }) => names.has(name))?.names ?? this.globals;
  }

  isTrue(expression: Expression): boolean {
    const when = this.condition(expression);
    if (when !== undefined) return this.lines.holds(when);
    const value = this.evaluate(expression);
    if (typeof value !== "boolean") throw new TextError(expression, "a condition", "A number is no condition.");
    return value;
  }
  numberOf(expression: Expression): number {
    return asNumber(this.evaluate(expression), expression);
  }
  fromNumber(value: number): Value {
    return value;
  }

  protected store(to: Expression, value: Value): void {
    if (to.kind === "variable") {
      if (to.name.startsWith("pr") !== isSix(value))
        throw new TextError(
          to,
          to.name.startsWith("pr") ? "a position" : "a number",
          `${this.spelt(to.name)} cannot hold this.`,
        );
      this.holder(to.name).set(to.name, value);
      return;
    }
    if (to.kind !== "index" || to.of.kind !== "variable")
      throw new TextError(to, "a register", "Only a register can be given a value.");
    const word = to.of.name;
    const [number, element] = to.indices.map(index => this.numberOf(index));
    const name = `${word}${number}`;
    this.differences.delete(name);
    if (element === undefined) {
      this.globals.set(name, value);
      return;
    }
    const before = this.globals.get(name) ?? [0, 0, 0, 0, 0, 0];
    if (!isSix(before) || !Number.isInteger(element) || element < 1 || element > 6)
      throw new TextError(to, "PR[n,1] … PR[n,6]", `PR[${number}] has no element ${element}.`);
    this.globals.set(name, before.with(element - 1, asNumber(value, to)));
  }

  /** The called program reads its arguments as AR[1], AR[2], … */
  override *call(routine: Routine, args: readonly Argument[], at: TextPlace): Generator<Executed, Flow> {
    this.given.push(args.map(({ value }) => (value === undefined ? 0 : this.evaluate(value))));
    try {
      return yield* super.call(routine, [], at);
    } finally {
      this.given.pop();
    }
  }

  override *statement(statement: Statement): Generator<Executed, Flow> {
    if (statement.kind === "assign" && statement.to.kind === "variable") {
      const { value, to } = statement;
      const [left, right] =
        value.kind === "binary" && value.sign === "-"
          ? [this.registerName(value.left), this.registerName(value.right)]
          : [];
      if (left !== undefined && right !== undefined) this.differences.set(to.name, { present: left, first: right });
      else this.differences.delete(to.name);
    }
    return yield* super.statement(statement);
  }

  /** PR[n] */
  private registerName(expression: Expression): string | undefined {
    return expression.kind === "index" &&
      expression.of.kind === "variable" &&
      expression.of.name === "pr" &&
      expression.indices.length === 1
      ? `pr${this.numberOf(expression.indices[0]!)}`
      : undefined;
  }

  condition(expression: Expression): Condition | undefined {
    return this.lines.condition(expression, of => this.numberOf(of));
  }

  // --- instructions -----------------------------------------------------------------------------------------------

  /* v8 ignore next */
  protected *waitUntil(statement: WaitUntil): Generator<Executed, void> {
    throw new TextError(statement, "a statement of TP", "TP has no such wait.");
  }

  protected *instruction(statement: Do): Generator<Executed, Flow | undefined> {
    const action = this.source.actions.get(statement);
    if (action === undefined)
      throw new TextError(
        statement,
        "the listing of the program that is called",
        `The program ${statement.name.toUpperCase()} is not in the text.`,
      );
    if (action.kind === "jump") {
      this.jump = action.label;
      yield { line: statement.line };
      return "break";
    }
    const step = this.step(action, statement);
    yield step === undefined ? { line: statement.line } : this.done(statement, step);
    return undefined;
  }

  private step(action: Exclude<Action, { kind: "jump" }>, at: Do): Step | undefined {
    const id = (): string => this.stepId(at);
    switch (action.kind) {
      case "motion":
        return this.motion(action, at, id());
      case "set":
        return this.set(action, at, id);
      case "wait": {
        const s = this.numberOf(action.s);
        if (!(s >= 0)) throw new TextError(at, "a time of 0 s or more", `The time is ${s} s.`);
        return { id: id(), type: "wait", s };
      }
      case "wait-for":
        return this.waitFor(action, at, id());
      case "message":
        return { id: id(), type: "message", text: action.text.trim() };
      case "skip-condition":
        this.skip = action.when;
        return undefined;
      case "offset-condition":
        this.offset = `pr${this.numberOf(action.register)}`;
        return undefined;
      case "tool-offset-condition":
        this.toolOffset = `pr${this.numberOf(action.register)}`;
        return undefined;
      case "timeout":
        this.timeout = this.numberOf(action.value);
        return undefined;
      case "select": {
        const number = this.numberOf(action.number);
        this.setups.inUse[action.what] = number;
        return undefined;
      }
      case "define":
        this.define(action, at);
        return undefined;
      case "label":
      case "nothing":
        return undefined;
    }
  }

  private define({ what, number, value }: Extract<Action, { kind: "define" }>, at: TextPlace): void {
    const six = this.evaluate(value);
    const name = this.registerName(value);
    if (!isSix(six)) throw new TextError(at, "a position register", "A number is no frame.");
    const matrix = fromSix(six);
    const key = `${what}${this.numberOf(number)}`;
    const isNothing = six.every(each => each === 0);
    const wanted = what === "utool" && isNothing ? "flange" : name === undefined ? this.spelt(key) : this.spelt(name);
    this.setups.define(key, { matrix, name: wanted });
  }

  private set({ word, number, value, pulse }: Extract<Action, { kind: "set" }>, at: TextPlace, id: () => string): Step {
    const line = this.numberOf(number);
    const to = this.evaluate(value);
    if (kindOfLine(word).endsWith("in"))
      throw new TextError(at, "an output", `${word.toUpperCase()}[${line}] is an input.`);
    if (`${word}${line}` === GRIPPER && typeof to === "boolean" && pulse === undefined)
      return { id: id(), type: "gripper", closed: to };
    const signal = this.lines.line(word, line, at);
    if (isSix(to) || (typeof to === "boolean") !== kindOfLine(word).startsWith("digital"))
      throw new TextError(
        at,
        kindOfLine(word).startsWith("digital") ? "ON or OFF" : "a number",
        `${word.toUpperCase()}[${line}] takes no such value.`,
      );
    this.lines.write(signal, to);
    return { id: id(), type: "set", signal, to, ...(pulse === undefined ? {} : { pulse_s: this.numberOf(pulse) }) };
  }

  private waitFor({ when, label }: Extract<Action, { kind: "wait-for" }>, at: Do, id: string): Step {
    const condition = this.condition(when);
    if (condition === undefined) {
      if (!this.isTrue(when))
        throw new TextError(
          when,
          "a condition of one line",
          "The program waits for a condition that nothing here makes true.",
        );
      return { id, type: "wait", s: 0 };
    }
    if (label === undefined) return { id, type: "wait-for", when: condition };
    if (this.source.fates.get(at) !== "abort")
      throw new TextError(
        at,
        "a label before ABORT",
        "A wait that goes on elsewhere after its time is not executed here.",
      );
    return { id, type: "wait-for", when: condition, timeout_s: this.timeout / 100 };
  }

  // --- motions ----------------------------------------------------------------------------------------------------

  private record({ register, number }: Point, at: TextPlace): PositionRecord {
    const n = this.numberOf(number);
    if (register === "pr") {
      const values = this.register(`pr${n}`, at);
      if (!isSix(values)) throw new TextError(at, "a position", `PR[${n}] holds no position.`);
      return {
        uf: this.setups.inUse.uframe ?? 0,
        ut: this.setups.inUse.utool ?? 0,
        joints: false,
        config: undefined,
        values,
        line: at.line,
        column: at.column,
        others: "",
      };
    }
    const record = this.source.positions.get(this.scopes.at(-1)?.routine ?? "")?.get(n);
    if (record === undefined) throw new TextError(at, "a position in /POS", `P[${n}] is not in the list of positions.`);
    for (const [word, taught, used] of [
      ["UFRAME", record.uf, this.setups.inUse.uframe],
      ["UTOOL", record.ut, this.setups.inUse.utool],
    ] as const) {
      if (used !== undefined && used !== taught)
        throw new TextError(
          at,
          `a position of ${word} ${used}`,
          `P[${n}] was taught with ${word} ${taught}, and ${used} is in use.`,
        );
    }
    return record;
  }

  private motion(motion: Motion, at: Do, id: string): MoveStep {
    const { path, goal, via, cnt, acceleration, offset } = motion;
    const shifted = this.shift(offset, at);
    const inTool = this.toolShift(motion.toolOffset, at);
    this.further(motion, at);
    const speed = speedOf(this.numberOf(motion.speed), motion, at);
    const ratio = acceleration === undefined ? 1 : Math.min(1, this.numberOf(acceleration) / 100);
    const share = cnt === undefined ? 0 : this.numberOf(cnt) / 100;
    if (!(share >= 0 && share <= 1)) throw new TextError(at, "CNT0 … CNT100", `CNT${share * 100} is no share of 100.`);
    const passing = via === undefined ? {} : { via: this.target(via, shifted, inTool, "on-the-way", at) };
    const common = {
      id,
      type: "move",
      speed,
      ...(ratio < 1 ? { acceleration: { ratio } } : {}),
      blend_m: 0,
      ...(share > 0 ? { blend_ratio: share } : {}),
    } as const;
    const target = this.target(goal, shifted, inTool, path === "J" ? "by-joints" : "by-path", at);
    return {
      ...common,
      path: path === "J" ? "ptp" : path === "L" ? "lin" : "circ",
      target,
      ...passing,
      ...this.search(motion, at),
    };
  }

  private search({ skip }: Motion, at: Do): Pick<MoveStep, "until"> {
    if (skip === undefined) return {};
    const when = this.skip === undefined ? undefined : this.condition(this.skip);
    const fate = this.source.fates.get(at);
    if (when === undefined)
      throw new TextError(at, "SKIP CONDITION of one line before it", "The search has no condition of one line.");
    if (fate === "elsewhere" || fate === undefined)
      throw new TextError(
        at,
        "a label in the next line, or one before ABORT",
        "A search that goes on elsewhere is not executed here.",
      );
    return { until: { when, missing: fate === "abort" ? "fault" : "continue" } };
  }

  /** How far the positions of a motion are shifted along the axes of the frame in use, and by which register. */
  private shift(
    offset: Motion["offset"],
    at: TextPlace,
  ): { readonly mm: readonly [number, number, number]; readonly register: string } | undefined {
    if (offset === undefined) return undefined;
    const register = offset.register === undefined ? this.offset : `pr${this.numberOf(offset.register)}`;
    const six = register === undefined ? undefined : this.register(register, at);
    if (register === undefined || six === undefined || !isSix(six))
      throw new TextError(at, "Offset,PR[n]", "The offset is in no register.");
    if (six.slice(3).some(angle_deg => Math.abs(angle_deg - 360 * Math.round(angle_deg / 360)) > 1e-6))
      throw new TextError(at, "an offset that does not turn", "Offsets that turn are not executed here.");
    return { mm: [six[0]!, six[1]!, six[2]!], register };
  }

  /** Tool_Offset,PR[n]: the point is shifted and turned as it is seen from itself. */
  private toolShift(offset: Motion["toolOffset"], at: TextPlace): Matrix | undefined {
    if (offset === undefined) return undefined;
    const register = offset.register === undefined ? this.toolOffset : `pr${this.numberOf(offset.register)}`;
    const six = register === undefined ? undefined : this.register(register, at);
    if (six === undefined || !isSix(six))
      throw new TextError(at, "Tool_Offset,PR[n]", "The offset of the tool is in no register.");
    return fromSix(six);
  }

  /** Further axes are not moved: a motion that keeps its place on what they carry is refused when they do. */
  private further({ goal, coordinated }: Motion, at: TextPlace): void {
    if (goal.register !== "p") return;
    const { others } = this.record(goal, at);
    if (coordinated && this.others !== undefined && this.others !== others)
      throw new TextError(
        at,
        "a coordinated motion whose other group stands still",
        `With COORD the robot follows the other group, which goes from ${this.others || "nowhere"} to ${others || "nowhere"}: other groups are not moved here.`,
      );
    this.others = others;
  }

  private target(
    point: Point,
    shifted: ReturnType<Machine["shift"]>,
    inTool: Matrix | undefined,
    how: "by-joints" | "by-path" | "on-the-way",
    at: TextPlace,
  ): Target {
    const record = this.record(point, at);
    const { values, config } = record;
    const uf = this.setups.inUse.uframe ?? record.uf;
    const ut = this.setups.inUse.utool ?? record.ut;
    if (values === undefined)
      throw new TextError(at, "a position that was taught", "The position was never taught: it is ********.");
    const frame = this.setups.of("uframe", uf, at);
    const tool = this.setups.of("utool", ut, at);
    const name = this.setups.toolName(tool);
    if (record.joints) {
      if (shifted !== undefined || inTool !== undefined)
        throw new TextError(at, "a position of X, Y, Z", "A position of joint angles is not shifted here.");
      const before = this.arm.remember();
      const q = this.arm.atShown(values);
      if (how === "on-the-way") before();
      return { q, tool: name };
    }
    const written = inTool === undefined ? fromSix(values) : times(fromSix(values), inTool);
    const seen = shifted === undefined ? written : moved(written, shifted.mm);
    const named = this.setups.frameName(frame);
    const inPlace = shifted === undefined ? undefined : this.atPlace(shifted.register, written);
    const plain = {
      pose: named === "world" ? this.arm.cell<"frame", "tcp">(times(frame.matrix, seen)) : toPose<"frame", "tcp">(seen),
      frame: named,
      tool: name,
    };
    const target = inPlace === undefined ? plain : { ...plain, ...inPlace };
    if (how === "on-the-way") return target;
    const reached = this.arm.atFlange(times(times(frame.matrix, seen), inverted(tool.matrix)), config);
    if (how === "by-joints" && !reached.fits)
      throw new TextError(
        at,
        "a configuration that reaches the position",
        "The position is not reached in its configuration.",
      );
    if (how === "by-joints" && reached.turned && !this.writesDown) return { q: reached.q!, tool: name };
    return { ...target, ...(reached.branch === undefined ? {} : { branch: reached.branch }) };
  }

  /** A taught point as it is seen from the place of a pallet that is being read as one. */
  private atPlace(
    register: string,
    written: Matrix,
  ): { readonly pose: Pose<"frame", "tcp">; readonly frame: string } | undefined {
    const difference = this.differences.get(register);
    const first = difference === undefined ? undefined : this.globals.get(difference.first);
    if (!this.places.has(this.spelt(register)) || first === undefined || !isSix(first)) return undefined;
    return { pose: toPose(times(inverted(fromSix(first)), written)), frame: this.spelt(register) };
  }

  // --- writing a program down -------------------------------------------------------------------------------------

  /** The place that an offset belongs to: the position that it is the distance of from the first. */
  placeIn(variable: string): { readonly frame: string; readonly pose: Pose<"frame", "place"> } | undefined {
    const difference = this.differences.get(variable);
    const present = difference === undefined ? undefined : this.globals.get(difference.present);
    const offset = this.globals.get(variable);
    if (
      present === undefined ||
      offset === undefined ||
      !isSix(present) ||
      !isSix(offset) ||
      offset.slice(3).some(each => each !== 0)
    )
      return undefined;
    const frame = this.setups.now("uframe", { line: 1, column: 1 });
    const name = this.setups.frameName(frame);
    const matrix = fromSix(present);
    return { frame: name, pose: name === "world" ? this.arm.cell(times(frame.matrix, matrix)) : toPose(matrix) };
  }

  edge(): void {
    /* every position says its frame and its tool */
  }

  override remember(): () => void {
    const values = super.remember();
    const arm = this.arm.remember();
    const { timeout, skip, offset, toolOffset, others, jump } = this;
    const kept = [this.lines.remember(), this.setups.remember(), rememberMap(this.differences)];
    return () => {
      values();
      arm();
      for (const back of kept) back();
      this.timeout = timeout;
      this.skip = skip;
      this.offset = offset;
      this.toolOffset = toolOffset;
      this.others = others;
      this.jump = jump;
    };
  }
}
