import type { Condition, Executed, Pose, Step, TextPlace } from "@twincell/core";
import { TextError, missingProgram } from "../../parser/index.ts";
import type {
  Argument,
  Block,
  Do,
  Expression,
  Flow,
  Routine,
  Statement,
  WaitUntil,
} from "../../parser/structured/index.ts";
import type { Action, Motion } from "../read/actions.ts";
import { kindOfLine } from "./lines.ts";
import { fromSix, times, toPose } from "./matrix.ts";
import { isJoints, isKnown, isSix } from "./values.ts";
import { Motions } from "./motions.ts";

const GRIPPER = "ro1";

/** Executes TP statement by statement. */
export class Machine extends Motions {
  /** Frames and tools that were used and are set up nowhere in the text. */
  get assumed(): ReadonlyMap<string, TextPlace> {
    return this.setups.assumed;
  }

  *main(): Generator<Executed, Flow> {
    return yield* this.call(this.source.main, [], this.source.main);
  }

  /** The body of the first program, to be written down. */
  open(): Block {
    this.scopes.push({ routine: this.source.main.name, names: new Map() });
    return this.source.main.body;
  }

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
      default:
        return this.setting(action, at);
    }
  }

  /** Frames, flags and registers. */
  private setting(
    action: Extract<Action, { kind: "select" | "define" | "flag" | "move-register" | "pause" | "label" | "nothing" }>,
    at: Do,
  ): Step | undefined {
    switch (action.kind) {
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
