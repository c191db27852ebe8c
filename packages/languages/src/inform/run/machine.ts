import type { Executed, Step, TextPlace } from "@twincell/core";
import { TextError, missingProgram } from "../../parser/index.ts";
import type { Instruction, Job, Statement } from "../read/syntax.ts";
import { poseOf } from "./arm.ts";
import { type Frame, ReadTooEarly } from "./executed.ts";
import { Motions } from "./motions.ts";

const CALL_DEPTH = 40;

/** Elements of a position: three in µm, three in 1/10000 of a degree. */
const ELEMENTS = 6;

const PER_MM = 1000;

const PER_DEG = 10_000;

const ORIGIN: TextPlace = { line: 1, column: 1 };

/** What is no motion, waits for nothing and sets no line. */
type Handled = Exclude<
  Statement,
  { kind: "timer" | "dout" | "group" | "pulse" | "aout" | "din" | "wait" | "hand" | "message" | "abort" }
>;

/**
 * Executes INFORM jobs instruction by instruction. Deterministic: the same text and the same signals give the same
 * steps.
 */
export class Machine extends Motions {
  /** @throws {TextError} where the text cannot be executed further. */
  *run(): Generator<Executed, void> {
    const main = this.source.jobs.values().next();
    if (main.done !== true) {
      this.stack.push(newFrame(main.value));
      while (this.stack.length > 0 && !this.stopped) {
        const frame = this.stack.at(-1)!;
        const { at } = frame;
        try {
          this.instruction(frame);
        } catch (cause) {
          if (!(cause instanceof ReadTooEarly)) throw cause;
          frame.at = at;
        }
        if (this.ready.length > 0) {
          const ready = this.ready;
          this.ready = [];
          yield* ready;
        }
      }
    }
    this.endArc(ORIGIN);
    this.settle(false);
    yield* this.ready;
  }

  private instruction(frame: Frame): void {
    const instruction = frame.job.instructions[frame.at++];
    if (instruction === undefined) this.stack.pop();
    else if (instruction.kind === "statement") this.statement(instruction.statement, frame);
    else this.control(instruction, frame);
  }

  private control(instruction: Exclude<Instruction, { kind: "statement" }>, frame: Frame): void {
    const { memory } = this;
    switch (instruction.kind) {
      case "jump":
        this.spend(instruction.at);
        frame.at = instruction.to;
        return;
      case "jump-to": {
        this.spend(instruction.at);
        const label = `*${memory.value(instruction.number)}`;
        const to = instruction.labels.get(label);
        if (to === undefined)
          throw new TextError(instruction.at, "a label of this job", `Label ${label} is not in job ${frame.job.name}.`);
        frame.at = to;
        return;
      }
      case "unless":
        this.spend(instruction.at);
        if (!this.holds(instruction.when, instruction.at)) frame.at = instruction.to;
        return;
      case "for":
        memory.set(instruction.variable, memory.value(instruction.from), instruction.at);
        frame.last[instruction.slot] = memory.value(instruction.last);
        frame.step[instruction.slot] = memory.value(instruction.step);
        if (frame.step[instruction.slot] === 0)
          throw new TextError(instruction.at, "a step other than 0", "The loop has the step 0.");
        return;
      case "for-check": {
        const value = memory.value({ kind: "variable", name: instruction.variable });
        const last = frame.last[instruction.slot]!;
        if (frame.step[instruction.slot]! > 0 ? value > last : value < last) frame.at = instruction.to;
        return;
      }
      case "for-next":
        this.spend(instruction.at);
        memory.set(
          instruction.variable,
          memory.value({ kind: "variable", name: instruction.variable }) + frame.step[instruction.slot]!,
          instruction.at,
        );
        frame.at = instruction.to;
        return;
    }
  }

  private statement(statement: Statement, frame: Frame): void {
    const { memory } = this;
    this.spend(statement);
    if (statement.kind === "move") return this.move(statement, frame);
    // Whatever the robot stands still for ends arcs and curves.
    const done = (step: Step): void => {
      this.endArc(statement);
      this.inCurve = false;
      this.settle(false);
      this.step(statement, step);
    };
    const id = (): string => this.stepId(statement.line);
    switch (statement.kind) {
      case "timer": {
        const s = memory.value(statement.s) / (statement.isHundredths ? 100 : 1);
        if (!(s >= 0)) throw new TextError(statement, "a time of 0 s or more", `The time is ${s} s.`);
        return done({ id: id(), type: "wait", s });
      }
      case "dout":
        return done({
          id: id(),
          type: "set",
          signal: memory.write(statement.number, statement.to, statement.wire ?? "OT"),
          to: statement.to,
        });
      case "group": {
        const to = memory.value(statement.to);
        return done({ id: id(), type: "set", signal: memory.write(statement.number, to, statement.wire), to });
      }
      case "pulse":
        if (!(statement.s > 0)) throw new TextError(statement, "a time above 0 s", `The time is ${statement.s} s.`);
        return done({
          id: id(),
          type: "set",
          signal: memory.write(statement.number, false),
          to: true,
          pulse_s: statement.s,
        });
      case "aout":
        return done({ id: id(), type: "set", signal: memory.note("AO", statement.number), to: statement.to });
      case "din":
        this.standStill();
        memory.set(statement.to, memory.value(statement.from), statement);
        break;
      case "wait":
        return this.wait(statement, done, id);
      case "hand":
        return done({ id: id(), type: "gripper", closed: statement.to });
      case "message":
        return done({ id: id(), type: "message", text: statement.text });
      case "abort":
        if (statement.when !== undefined && !this.holds(statement.when, statement)) break;
        this.stopped = true;
        return done({ id: id(), type: "stop" });
      default:
        return this.handled(statement, frame);
    }
    this.note(statement);
  }

  /** What calls, computes and sets. */
  private handled(statement: Handled, frame: Frame): void {
    const { memory } = this;
    switch (statement.kind) {
      case "call":
        if (statement.when === undefined || this.holds(statement.when, statement)) this.call(statement, statement);
        break;
      case "argument": {
        const given = frame.args[statement.number - 1];
        if (given === undefined)
          memory.notGiven(`The job is called without an argument ${statement.number}: it is taken as 0.`);
        memory.set(statement.to, given ?? 0, statement);
        break;
      }
      case "unknown":
        if (this.notices === undefined)
          throw new TextError(
            statement,
            "a value in the job",
            `${statement.to} takes ${statement.from}, which only the controller knows.`,
          );
        memory.notGiven(`${statement.to} takes ${statement.from}, which only the controller knows.`);
        memory.forget(statement.to);
        this.taken.delete(statement.to);
        break;
      case "positions":
        this.combine(statement);
        break;
      case "frame": {
        if (this.notices === undefined)
          throw new TextError(statement, "UFRAME.CND behind the job", "A user frame that a job works out is not kept.");
        if (statement.through.some(name => memory.position(name).some(Number.isNaN))) {
          memory.notGiven(
            `User frame ${statement.user} is worked out from positions that are in none of the files: it is taken as it was.`,
          );
          break;
        }
        const points = statement.through.map(name => {
          const [x, y, z] = memory.known(name);
          return [x! / PER_MM, y! / PER_MM, z! / PER_MM] as const;
        });
        this.state.makeFrame(statement.user, points, statement);
        break;
      }
      case "away":
        if (statement.when === undefined || this.holds(statement.when, statement)) this.away(statement.what, statement);
        break;
      default:
        return this.computedOrSet(statement);
    }
    this.note(statement);
  }

  /** What is shown, computed, kept or set for the motions that follow. */
  private computedOrSet(
    statement: Exclude<Handled, { kind: "call" | "argument" | "unknown" | "positions" | "frame" | "away" }>,
  ): void {
    const { memory } = this;
    switch (statement.kind) {
      case "shown":
        this.notices?.add(
          statement,
          "an instruction that is executed",
          `Line ${statement.line} is shown, not executed: ${statement.what}.`,
        );
        break;
      case "return":
        if (statement.when === undefined || this.holds(statement.when, statement)) this.stack.pop();
        break;
      case "arithmetic":
        this.arithmetic(statement);
        break;
      case "element":
        this.element(statement);
        break;
      case "here":
        this.takeHere(statement.position, statement);
        break;
      case "clear":
        memory.clear(statement.from, statement.count);
        this.taken.delete(statement.from);
        break;
      case "shift": {
        const [x, y, z, rx, ry, rz] = memory.known(statement.position);
        const { baseFromFrame } = this.state.frameOf(statement.frame, statement.user, statement);
        this.state.shift = {
          baseFromFrame,
          by: poseOf([x! / PER_MM, y! / PER_MM, z! / PER_MM, rx! / PER_DEG, ry! / PER_DEG, rz! / PER_DEG]),
        };
        break;
      }
      case "shift-off":
        this.state.shift = undefined;
        break;
      case "speed":
        if (statement.vj !== undefined) this.state.speed.vj = statement.vj;
        if (statement.v !== undefined) this.state.speed.v_mps = statement.v / 1000;
        break;
      case "nothing":
        break;
    }
    this.note(statement);
  }

  private arithmetic({ word, to, by, ...at }: Extract<Statement, { kind: "arithmetic" }>): void {
    const a = word === "SET" ? 0 : this.memory.value({ kind: "variable", name: to });
    const b = this.memory.value(by);
    if (word === "DIV" && b === 0) throw new TextError(at, "a divisor other than 0", "The divisor is 0.");
    this.memory.set(
      to,
      word === "SET" ? b : word === "ADD" ? a + b : word === "SUB" ? a - b : word === "MUL" ? a * b : a / b,
      at,
    );
  }

  private element({ get, position, element, with: operand, ...at }: Extract<Statement, { kind: "element" }>): void {
    if (element > ELEMENTS)
      throw new TextError(at, `an element from 1 to ${ELEMENTS}`, `A position has no element ${element}.`);
    if (!get) {
      this.memory.position(position)[element - 1] = this.memory.value(operand);
      this.taken.delete(position);
      return;
    }
    if (operand.kind === "variable") this.memory.set(operand.name, this.memory.known(position)[element - 1]!, at);
  }

  /** SET, ADD and SUB of a position variable by another, element by element. */
  private combine({ word, to, by }: Extract<Statement, { kind: "positions" }>): void {
    const { memory } = this;
    const given = memory.position(by);
    this.taken.delete(to);
    if (word === "SET") {
      const taken = this.taken.get(by);
      if (taken !== undefined) this.taken.set(to, taken);
      return memory.setPosition(to, given, memory.kindOf(by));
    }
    const kind = memory.kindOf(to) ?? memory.kindOf(by);
    const values = memory.position(to).map((value, i) => (word === "ADD" ? value + given[i]! : value - given[i]!));
    memory.setPosition(to, values, kind);
  }

  /** GETS PX: the variable holds where the robot is. */
  private takeHere(name: string, at: TextPlace): void {
    if (this.notices !== undefined && this.state.isLost) {
      this.memory.forget(name);
      this.taken.delete(name);
      return;
    }
    this.taken.set(name, this.state.here);
    if (this.notices === undefined) return;
    const { values, ...kind } = this.state.standing("BASE", 0, 0, at);
    this.memory.setPosition(
      name,
      values.map((value, i) => Math.round(value * (i < 3 ? PER_MM : PER_DEG))),
      { ...kind, values },
    );
  }

  /** What is done in the controller may move the robot: where it stands afterwards is not known. */
  private away(what: string, at: TextPlace): void {
    if (this.notices === undefined)
      throw new TextError(at, "an instruction of this job", `What ${what} does is not known here.`);
    this.memory.notGiven(`What ${what} does, motions too, is not executed.`);
    this.state.isLost = true;
  }

  /** A wait for one line, or until its time is over, after which the job goes on all the same. */
  private wait(statement: Extract<Statement, { kind: "wait" }>, done: (step: Step) => void, id: () => string): void {
    const { memory } = this;
    const { when, s, ...at } = statement;
    if (s === undefined && (when.more === undefined || this.notices === undefined)) {
      if (this.notices === undefined || when.left.kind === "line")
        return done({ id: id(), type: "wait-for", when: memory.awaited(when, at) });
    }
    if (this.notices === undefined)
      throw new TextError(
        at,
        "a wait without an end",
        "After the time of T= the job goes on as if nothing were missing: that is not understood here.",
      );
    if (this.holds(when, at)) return done({ id: id(), type: "wait", s: 0 });
    if (s !== undefined) return done({ id: id(), type: "wait", s: Math.max(0, memory.value(s)) });
    this.notices.add(
      at,
      "IN#(n)=ON or =OFF",
      `Line ${at.line} waits for what nothing here makes true: the job goes on as if it were.`,
    );
    done({ id: id(), type: "wait", s: 0 });
  }

  private call({ job: name, args = [] }: Extract<Statement, { kind: "call" }>, at: TextPlace): void {
    const job = this.source.jobs.get(name);
    if (job === undefined) throw missingProgram(at, name);
    if (this.stack.length >= CALL_DEPTH)
      throw new TextError(
        at,
        `at most ${CALL_DEPTH} calls inside each other`,
        `Job ${name} is called more than ${CALL_DEPTH} deep.`,
      );
    this.stack.push(
      newFrame(
        job,
        args.map(value => this.memory.value(value)),
      ),
    );
  }
}

const newFrame = (job: Job, args: readonly number[] = []): Frame => ({ job, at: 0, last: [], step: [], args });
