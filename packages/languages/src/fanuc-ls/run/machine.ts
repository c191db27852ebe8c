import type { Condition, Executed, MoveStep, Pose, Robot, Signals, Step, Target, TextPlace } from "@twincell/core";
import { TextError, missingProgram, type DeclaredCell, type Notices } from "../../parser/index.ts";
import {
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
import { kindOfLine } from "./lines.ts";
import { fromSix, inverted, moved, times, toPose, type Matrix } from "./matrix.ts";
import { FASTEST, planned, speedOf } from "./pace.ts";
import { RegisterMachine } from "./registers.ts";
import { isJoints, isKnown, isSix, type Value } from "./values.ts";

const GRIPPER = "ro1";
/** $WAITTMOUT counts hundredths of a second; 30 s when nobody has set it. */
const TIMEOUT = 3000;

/** Executes TP statement by statement. */
export class Machine extends RegisterMachine {
  /** Registers that hold how far the place of a pallet is off, while the pallet is read as one. */
  readonly places = new Set<string>();
  private readonly writesDown: boolean;
  private timeout = TIMEOUT;
  private skip: Expression | undefined;
  private offset: string | undefined;
  private toolOffset: string | undefined;
  /** Where the further axes stood at the last taught position. */
  private others: string | undefined;
  private jump: number | undefined;
  private jumpFrom: TextPlace = { line: 1, column: 1 };

  /** Frames and tools that were used and are set up nowhere in the text. */
  get assumed(): ReadonlyMap<string, TextPlace> {
    return this.setups.assumed;
  }

  /**
   * @param notices     takes what only the controller knows, as registers that no file holds; without, such a thing is
   *   refused.
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
    notices?: Notices,
  ) {
    super(source, robot, worldFromBase, declared, signals, notices);
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

  /** The called program reads its arguments as AR[1], AR[2], … */
  override *call(routine: Routine, args: readonly Argument[], at: TextPlace): Generator<Executed, Flow> {
    this.given.push(args.map(({ value }) => (value === undefined ? 0 : this.evaluate(value))));
    try {
      const flow = yield* super.call(routine, [], at);
      if (this.jump !== undefined)
        throw new TextError(
          this.jumpFrom,
          `LBL[${this.jump}]`,
          `A jump goes to the label ${this.jump}, which is not reached from there.`,
        );
      return flow;
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

  // --- instructions -----------------------------------------------------------------------------------------------

  /* v8 ignore next */
  protected *waitUntil(statement: WaitUntil): Generator<Executed, void> {
    throw new TextError(statement, "a statement of TP", "TP has no such wait.");
  }

  protected *instruction(statement: Do): Generator<Executed, Flow | undefined> {
    const action = this.source.actions.get(statement);
    if (action === undefined) throw missingProgram(statement, statement.name.toUpperCase());
    if (action.kind === "jump" || action.kind === "jump-to") {
      this.jump = action.kind === "jump" ? action.label : this.numberOf(action.label);
      this.jumpFrom = statement;
      yield { line: statement.line };
      return "break";
    }
    if (action.kind === "pause" && this.notices === undefined) {
      yield this.done(statement, { id: this.stepId(statement), type: "stop" });
      return "halt";
    }
    if (action.kind === "motion" && this.notices !== undefined) return yield* this.lenient(action, statement);
    if (action.kind === "wait-for" && this.notices !== undefined) return yield* this.waits(action, statement);
    const step = this.step(action, statement);
    yield step === undefined ? { line: statement.line } : this.done(statement, step);
    return undefined;
  }

  /** A motion that goes on at a label, or that is left out and named because only the controller knows where to. */
  private *lenient(action: Motion, at: Do): Generator<Executed, Flow | undefined> {
    const missing = this.missing(action, at);
    if (missing !== undefined) {
      this.notices!.notGiven(at, `${missing}: the motion is not executed.`);
      this.arm.lose();
      yield { line: at.line };
      return undefined;
    }
    yield this.done(at, this.motion(action, at, this.stepId(at)));
    if (action.skip === undefined || !this.leads(action, at)) return undefined;
    const met = this.isTrue(this.skip!);
    if (met !== (action.jumpsWhenMet === true)) return undefined;
    this.jump = action.skip;
    this.jumpFrom = at;
    return "break";
  }

  /** Whether the program goes on at the label of a search in one of its two ends. */
  private leads({ jumpsWhenMet }: Motion, at: Do): boolean {
    const fate = this.source.fates.get(at);
    return this.skip !== undefined && fate !== "on" && (jumpsWhenMet === true || fate !== "abort");
  }

  /** What of a motion only the controller knows; undefined where all of it is known. */
  private missing(motion: Motion, at: Do): string | undefined {
    for (const point of motion.via === undefined ? [motion.goal] : [motion.via, motion.goal]) {
      const number = this.numberOf(point.number);
      const key = `${point.register}${number}`;
      const value = point.register === "pr" ? this.register(key, at) : this.taught(number, at);
      const six = isJoints(value) ? value.joints_deg : value;
      if (isSix(six) && !isKnown(six))
        return point.register === "p"
          ? `${key.toUpperCase().replace(/([A-Z]+)/, "$1[")}] was never taught`
          : `${this.called(key)} is in none of the files`;
    }
    for (const [offset, condition] of [
      [motion.offset, this.offset],
      [motion.toolOffset, this.toolOffset],
    ] as const) {
      if (offset === undefined) continue;
      const register = offset.register === undefined ? condition : `pr${this.numberOf(offset.register)}`;
      const six = register === undefined ? undefined : this.register(register, at);
      if (six === undefined) return "The offset is set in none of the files";
      if (isSix(six) && !isKnown(six)) return `The offset ${this.called(register!)} is in none of the files`;
    }
    if (this.arm.isLost && (motion.incremental === true || motion.path === "C"))
      return "Where the robot stands before it is not known";
    return undefined;
  }

  /** Waits for what the lines say; what is not one line, or goes on at a label, is said. */
  private *waits(action: Extract<Action, { kind: "wait-for" }>, at: Do): Generator<Executed, Flow | undefined> {
    const { when, label } = action;
    const id = this.stepId(at);
    if (label !== undefined && this.source.fates.get(at) !== "abort") {
      // The label is taken when the time is over: looked at in ten parts of it.
      for (let part = 0; part < 10 && !this.isTrue(when); part++)
        yield this.done(at, { id: `${id} ${part}`, type: "wait", s: this.timeout / 1000 });
      if (this.isTrue(when)) {
        yield this.done(at, { id, type: "wait", s: 0 });
        return undefined;
      }
      if (this.source.fates.get(at) === "on") return undefined;
      this.jump = label;
      this.jumpFrom = at;
      return "break";
    }
    if (this.condition(when) !== undefined) {
      yield this.done(at, this.waitFor(action, at, id));
      return undefined;
    }
    const lines = this.leaves(when);
    if (lines.length > 0 && !this.isTrue(when)) {
      if (this.isAlternative(when))
        this.notices!.add(
          at,
          "a condition of one line",
          `Line ${at.line} waits for one of several conditions: here it waits for the first of them.`,
        );
      for (const [i, line] of (this.isAlternative(when) ? lines.slice(0, 1) : lines).entries())
        yield this.done(at, { id: `${id} ${i}`, type: "wait-for", when: line });
      return undefined;
    }
    if (!this.isTrue(when))
      this.notices!.add(
        at,
        "a condition that the program or a line makes true",
        `Line ${at.line} waits for what nothing here makes true: the program goes on as if it were.`,
      );
    yield this.done(at, { id, type: "wait", s: 0 });
    return undefined;
  }

  /** The conditions of one line that are joined in a condition and do not hold now. */
  private leaves(of: Expression): readonly Condition[] {
    const own = this.condition(of);
    if (own !== undefined) return this.lines.holds(own) ? [] : [own];
    if (of.kind !== "binary" || (of.sign !== "and" && of.sign !== "or")) return [];
    return [...this.leaves(of.left), ...this.leaves(of.right)];
  }
  private isAlternative(of: Expression): boolean {
    return of.kind === "binary" && (of.sign === "or" || this.isAlternative(of.left) || this.isAlternative(of.right));
  }

  private step(action: Exclude<Action, { kind: "jump" | "jump-to" }>, at: Do): Step | undefined {
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
        const before = this.unknowns;
        const number = this.numberOf(action.number);
        // A number that only the controller knows: positions bring their own.
        this.setups.inUse[action.what] = this.unknowns === before ? number : undefined;
        return undefined;
      }
      case "define":
        this.define(action, at);
        return undefined;
      case "flag": {
        const to = this.evaluate(action.value);
        const number = this.numberOf(action.number);
        this.lines.write(this.lines.line(action.word, number, at), to === true || (typeof to === "number" && to !== 0));
        return undefined;
      }
      case "move-register": {
        const value = this.evaluate(action.value);
        if (typeof value !== "object") throw new TextError(at, "a position", "A number is no position.");
        this.moved.set(this.positionKey(this.numberOf(action.number)), value);
        return undefined;
      }
      case "pause":
        this.notices?.add(
          at,
          "a program that goes on by itself",
          `Line ${at.line} waits for a person to go on: the program goes on here.`,
        );
        return undefined;
      case "label":
      case "nothing":
        return undefined;
    }
  }

  private define({ what, number, value }: Extract<Action, { kind: "define" }>, at: TextPlace): void {
    const six = this.evaluate(value);
    const name = this.registerName(value);
    if (isSix(six) && !isKnown(six) && this.notices !== undefined) {
      this.notices.notGiven(
        at,
        `The position of ${what.toUpperCase()}[${this.numberOf(number)}] is in none of the files: it is taken to be no different from the ${what === "uframe" ? "world" : "flange"}.`,
      );
      return;
    }
    if (!isSix(six)) throw new TextError(at, "a position register", "A number is no frame.");
    const matrix = fromSix(six);
    const key = `${what}${this.numberOf(number)}`;
    const isNothing = six.every(each => each === 0);
    const wanted = what === "utool" && isNothing ? "flange" : name === undefined ? this.spelt(key) : this.spelt(name);
    this.setups.define(key, { matrix, name: wanted });
  }

  private set({ word, number, value, pulse }: Extract<Action, { kind: "set" }>, at: TextPlace, id: () => string): Step {
    const line = this.numberOf(number);
    const given = this.evaluate(value);
    // A group of lines takes the number that a decision is, a line what a number says.
    const digital = kindOfLine(word).startsWith("digital");
    const to =
      typeof given === "boolean" && !digital
        ? Number(given)
        : typeof given === "number" && digital
          ? given !== 0
          : given;
    if (kindOfLine(word).endsWith("in"))
      throw new TextError(at, "an output", `${word.toUpperCase()}[${line}] is an input.`);
    if (`${word}${line}` === GRIPPER && typeof to === "boolean" && pulse === undefined)
      return { id: id(), type: "gripper", closed: to };
    const signal = this.lines.line(word, line, at);
    if (typeof to === "object" || (typeof to === "boolean") !== kindOfLine(word).startsWith("digital"))
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
      return this.fromValue(this.register(`pr${n}`, at), `PR[${n}]`, at);
    }
    const moved = this.moved.get(this.positionKey(n));
    if (moved !== undefined) return this.fromValue(moved, `P[${n}]`, at);
    const record = this.listed(n, at);
    if (record.remote)
      throw new TextError(
        at,
        "a position of a tool that the robot carries",
        `P[${n}] was taught with a tool that stands in the cell (RX, RY, RZ), which is not executed here.`,
      );
    for (const [word, taught, used] of [
      ["UFRAME", record.uf, this.setups.inUse.uframe],
      ["UTOOL", record.ut, this.setups.inUse.utool],
    ] as const) {
      if (used !== undefined && taught !== undefined && used !== taught)
        throw new TextError(
          at,
          `a position of ${word} ${used}`,
          `P[${n}] was taught with ${word} ${taught}, and ${used} is in use.`,
        );
    }
    return record;
  }

  /** The value of a register as a position in the frame and the tool that are in use. */
  private fromValue(value: Value, name: string, at: TextPlace): PositionRecord {
    if (!isSix(value) && !isJoints(value)) throw new TextError(at, "a position", `${name} holds no position.`);
    return {
      uf: this.setups.inUse.uframe,
      ut: this.setups.inUse.utool,
      joints: isJoints(value),
      config: undefined,
      remote: false,
      values: isJoints(value) ? value.joints_deg : value,
      line: at.line,
      column: at.column,
      others: "",
    };
  }

  /** How fast a motion is; what only the controller knows of it is said. */
  private pace(motion: Motion, at: TextPlace): MoveStep["speed"] {
    const { speed, unit, path } = motion;
    if (unit === "max_speed") return path === "J" ? { ratio: 1 } : FASTEST;
    const before = this.unknowns;
    const value = speed === undefined ? 0 : this.numberOf(speed);
    const isGiven = speed !== undefined && (this.unknowns === before || value > 0);
    if (this.notices !== undefined && (!isGiven || (!(value > 0) && speed.kind !== "number"))) {
      const { said, assumed } = planned(unit, path);
      this.notices.notGiven(at, `The speed of line ${at.line} is in none of the files: it is planned at ${said}.`);
      return assumed;
    }
    if (speed === undefined)
      throw new TextError(at, "a speed", `${unit.toUpperCase()} is in none of the files: the speed is not known.`);
    return speedOf(value, { unit, path }, at);
  }

  private motion(motion: Motion, at: Do, id: string): MoveStep {
    const { path, goal, via, cnt, acceleration, offset } = motion;
    const shifted = this.shift(offset, at);
    const inTool = this.toolShift(motion.toolOffset, at);
    this.further(motion, at);
    const speed = this.pace(motion, at);
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
    const how = path === "J" ? "by-joints" : "by-path";
    const target =
      motion.incremental === true ? this.further_by(goal, how, at) : this.target(goal, shifted, inTool, how, at);
    return {
      ...common,
      path: path === "J" ? "ptp" : path === "L" ? "lin" : "circ",
      target,
      ...passing,
      ...this.search(motion, at),
    };
  }

  private search(motion: Motion, at: Do): Pick<MoveStep, "until"> {
    const { skip } = motion;
    if (skip === undefined) return {};
    const when = this.skip === undefined ? undefined : this.condition(this.skip);
    const fate = this.source.fates.get(at);
    if (when === undefined && this.notices !== undefined) {
      this.notices.add(
        at,
        "a condition of one line",
        `The search of line ${at.line} has no condition of one line: the motion goes to its end.`,
      );
      return {};
    }
    if (when === undefined)
      throw new TextError(at, "SKIP CONDITION of one line before it", "The search has no condition of one line.");
    if (this.notices !== undefined && this.leads(motion, at)) return { until: { when, missing: "continue" } };
    if (motion.jumpsWhenMet === true || fate === "elsewhere" || fate === undefined)
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

  /** INC: from where the robot stands, along the axes of the frame, or by joint angles. */
  private further_by(point: Point, how: "by-joints" | "by-path", at: TextPlace): Target {
    const record = this.record(point, at);
    const { values } = record;
    if (values === undefined)
      throw new TextError(at, "a position that was taught", "The position was never taught: it is ********.");
    const ut = this.setups.inUse.utool ?? record.ut ?? 0;
    const tool = this.setups.of("utool", ut, at);
    const name = this.setups.toolName(tool);
    if (record.joints)
      return { q: this.arm.atShown(this.arm.shown().map((angle, i) => angle + values[i]!)), tool: name };
    if (values.slice(3).some(angle => angle !== 0))
      throw new TextError(at, "a position that does not turn", "INC with a turn of the tool is not executed here.");
    const frame = this.setups.of("uframe", this.setups.inUse.uframe ?? record.uf ?? 0, at);
    const standing = times(times(inverted(frame.matrix), this.arm.flange), tool.matrix);
    const seen = moved(standing, [values[0]!, values[1]!, values[2]!]);
    const named = this.setups.frameName(frame);
    const reached = this.arm.atFlange(times(times(frame.matrix, seen), inverted(tool.matrix)), undefined);
    if (how === "by-joints" && reached.q !== undefined && !this.writesDown) return { q: reached.q, tool: name };
    return {
      pose: named === "world" ? this.arm.cell<"frame", "tcp">(times(frame.matrix, seen)) : toPose<"frame", "tcp">(seen),
      frame: named,
      tool: name,
      ...(reached.branch === undefined ? {} : { branch: reached.branch }),
    };
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
    const uf = this.setups.inUse.uframe ?? record.uf ?? 0;
    const ut = this.setups.inUse.utool ?? record.ut ?? 0;
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
    if (how === "by-joints" && !reached.fits && this.notices !== undefined)
      this.notices.add(
        at,
        "a configuration that reaches the position",
        `Line ${at.line}: this robot does not reach the position in its configuration; the nearest posture is taken.`,
      );
    else if (how === "by-joints" && !reached.fits)
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
    const registers = this.rememberRegisters();
    return () => {
      values();
      arm();
      registers();
      this.timeout = timeout;
      this.skip = skip;
      this.offset = offset;
      this.toolOffset = toolOffset;
      this.others = others;
      this.jump = jump;
    };
  }
}
