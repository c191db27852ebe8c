import type { Executed, MoveStep, Pose, Signals, Step, TextPlace } from "@twincell/core";
import { TextError, WaitsOutside } from "../../parser/index.ts";
import type { Condition, Instruction, Job, Move, Position, Source, Statement } from "../read/syntax.ts";
import { poseOf } from "./arm.ts";
import { Memory, looksOutside } from "./memory.ts";
import type { Context, ControllerState } from "./state.ts";

/** Instructions without a motion or a wait after which the job is taken to run on the spot for ever. */
const INSTRUCTIONS_WITHOUT_MOTION = 100_000;
const CALL_DEPTH = 40;
/** Elements of a position: three in µm, three in 1/10000 of a degree. */
const ELEMENTS = 6;
const PER_MM = 1000;
const PER_DEG = 10_000;
const ORIGIN: TextPlace = { line: 1, column: 1 };

interface Frame {
  readonly job: Job;
  at: number;
  readonly last: number[];
  readonly step: number[];
}

/** An input is asked while what stands before it is not executed yet. Never leaves the machine. */
class ReadTooEarly extends Error {}

/**
 * Executes INFORM jobs instruction by instruction. Deterministic: the same text and the same signals give the same
 * steps.
 */
export class Machine {
  private readonly memory: Memory;
  private readonly source: Source;
  private readonly state: ControllerState;
  private readonly stack: Frame[] = [];
  private readonly times = new Map<number, number>();
  /** A motion of which it is not yet known whether the robot stops at its end, and what was executed since. */
  private pending: { readonly line: number; readonly step: MoveStep; readonly corner_m: number } | undefined;
  private readonly since: Executed[] = [];
  private ready: Executed[] = [];
  /** The point on the way of an arc that has begun; how many points of it were met. */
  private arc: {
    readonly points: number;
    readonly via: { readonly position: Position; readonly line: number } | undefined;
  } = { points: 0, via: undefined };
  private inCurve = false;
  /** Positions that were taken from the robot itself, by their variable. */
  private readonly taken = new Map<string, Pose<"base", "flange">>();
  private idle = 0;
  private stopped = false;

  constructor(source: Source, state: ControllerState, signals: Signals | undefined, met: Context["signals"]) {
    this.source = source;
    this.state = state;
    this.memory = new Memory(signals, met);
  }

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

  /** What was done before an input is asked is executed first: the instruction comes again when it has been. */
  private standStill(): void {
    this.settle(false);
    if (this.ready.length > 0) throw new ReadTooEarly();
  }

  private holds(when: Condition, at: TextPlace): boolean {
    if (looksOutside(when)) this.standStill();
    return this.memory.holds(when, at);
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
        return done({ id: id(), type: "set", signal: memory.write(statement.number, statement.to), to: statement.to });
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
        return done({ id: id(), type: "wait-for", when: memory.awaited(statement.when, statement) });
      case "hand":
        return done({ id: id(), type: "gripper", closed: statement.to });
      case "message":
        return done({ id: id(), type: "message", text: statement.text });
      case "abort":
        if (statement.when !== undefined && !this.holds(statement.when, statement)) break;
        this.stopped = true;
        return done({ id: id(), type: "stop" });
      case "call":
        if (statement.when === undefined || this.holds(statement.when, statement)) this.call(statement.job, statement);
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
        this.taken.set(statement.position, this.state.here);
        break;
      case "clear":
        memory.clear(statement.from, statement.count);
        break;
      case "shift": {
        const [x, y, z, rx, ry, rz] = memory.position(statement.position);
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
    const a = this.memory.value({ kind: "variable", name: to });
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
    const values = this.memory.position(position);
    if (!get) {
      values[element - 1] = this.memory.value(operand);
      return;
    }
    if (operand.kind === "variable") this.memory.set(operand.name, values[element - 1]!, at);
  }

  private call(name: string, at: TextPlace): void {
    const job = this.source.jobs.get(name);
    if (job === undefined) throw new TextError(at, "a job of this text", `Job ${name} is not in this text.`);
    if (this.stack.length >= CALL_DEPTH)
      throw new TextError(
        at,
        `at most ${CALL_DEPTH} calls inside each other`,
        `Job ${name} is called more than ${CALL_DEPTH} deep.`,
      );
    this.stack.push(newFrame(job));
  }

  // Motion
  // --------------------------------------------------------------------------------------------------------------

  private move(move: Extract<Statement, { kind: "move" }>, frame: Frame): void {
    const taken = this.taken.get(move.position);
    if (taken !== undefined) return this.begin(move, taken);
    const position = this.positionOf(move, frame);
    if (move.motion !== "MOVC") this.endArc(move);
    if (move.motion !== "MOVS") this.inCurve = false;
    switch (move.motion) {
      case "MOVJ":
      case "MOVL":
        return this.go(move, position, undefined, frame);
      case "MOVS": {
        // A curve begins where it is: with the point before it once more, or with a straight way to its first point.
        const first = !this.inCurve;
        this.inCurve = true;
        if (!first) return this.go(move, position, undefined, frame);
        return this.state.isAt(position, move)
          ? this.note(move)
          : this.go({ ...move, motion: "MOVL" }, position, undefined, frame);
      }
      case "MOVC":
        return this.arcPoint(move, position, frame);
    }
  }

  /** An arc or a curve that begins where the robot was when it was asked. */
  private begin(move: Extract<Statement, { kind: "move" }>, taken: Pose<"base", "flange">): void {
    if ((move.motion !== "MOVC" && move.motion !== "MOVS") || !this.state.isAt(taken, move))
      throw new TextError(
        move,
        "a position of this job",
        "A motion back to a position that was taken from the robot is not understood here.",
      );
    this.endArc(move);
    this.inCurve = move.motion === "MOVS";
    if (move.motion === "MOVC") this.arc = { points: 1, via: undefined };
    this.note(move);
  }

  /** Three points are an arc: where it begins, one on the way, and its end. */
  private arcPoint(move: Extract<Statement, { kind: "move" }>, position: Position, frame: Frame): void {
    const { points, via } = this.arc;
    if (points === 0) {
      this.arc = { points: 1, via: undefined };
      return this.state.isAt(position, move)
        ? this.note(move)
        : this.go({ ...move, motion: "MOVL" }, position, undefined, frame);
    }
    if (via === undefined) {
      this.arc = { points: 2, via: { position, line: move.line } };
      return this.note(move);
    }
    this.arc = move.isLastOfArc ? { points: 0, via: undefined } : { points: 1, via: undefined };
    this.go(move, position, via.position, frame);
  }

  /** @throws {TextError} when an arc has a point on the way and no end. */
  private endArc(at: TextPlace): void {
    const { via } = this.arc;
    this.arc = { points: 0, via: undefined };
    if (via !== undefined)
      throw new TextError(
        { line: via.line, column: 1 },
        "a third MOVC behind it",
        `The arc with the point of line ${via.line} has no end before line ${at.line}.`,
      );
  }

  private go(move: Move & TextPlace, position: Position, via: Position | undefined, frame: Frame): void {
    this.settle(true);
    const corner_m = this.state.corner(move, move);
    const step = this.state.move(this.stepId(move.line), move, position, via, move);
    const until =
      move.until === undefined
        ? undefined
        : {
            when: this.memory.awaited(move.until, move),
            missing: this.aborts(move.until, frame) ? ("fault" as const) : ("continue" as const),
          };
    this.pending = { line: move.line, step: until === undefined ? step : { ...step, until }, corner_m };
    this.idle = 0;
  }

  /**
   * Whether the job ends when a search met nothing: ABORT behind it, on the opposite of its condition. Goes past it.
   */
  private aborts(until: Condition, frame: Frame): boolean {
    const next = frame.job.instructions[frame.at];
    if (next?.kind !== "statement" || next.statement.kind !== "abort" || next.statement.when === undefined)
      return false;
    const { left, right } = next.statement.when;
    if (
      left.kind !== "line" ||
      until.left.kind !== "line" ||
      left.wire !== until.left.wire ||
      left.number !== until.left.number ||
      right === until.right
    )
      return false;
    frame.at++;
    return true;
  }

  private positionOf({ position, ...at }: Move & TextPlace, { job }: Frame): Position {
    const own = job.positions.get(position);
    const isVariable = position.startsWith("P");
    const anywhere = own ?? (isVariable ? this.globalPosition(position) : undefined);
    if (anywhere === undefined)
      throw new TextError(at, "a position of this job", `Position ${position} is not in job ${job.name}.`);
    return anywhere;
  }

  private globalPosition(key: string): Position | undefined {
    for (const { positions } of this.source.jobs.values()) {
      const found = positions.get(key);
      if (found !== undefined) return found;
    }
    return undefined;
  }

  // What comes out
  // ------------------------------------------------------------------------------------------------------

  private settle(goesOn: boolean): void {
    const { pending } = this;
    if (pending === undefined) return;
    this.pending = undefined;
    this.ready.push(
      { line: pending.line, step: goesOn ? { ...pending.step, blend_m: pending.corner_m } : pending.step },
      ...this.since.splice(0),
    );
  }

  private note({ line }: TextPlace): void {
    if (this.pending === undefined) this.ready.push({ line });
    else this.since.push({ line });
  }

  private step({ line }: TextPlace, step: Step): void {
    this.idle = 0;
    this.ready.push({ line, step });
  }

  /** L12, and L12.2 when line 12 is executed again. */
  private stepId(line: number): string {
    const time = (this.times.get(line) ?? 0) + 1;
    this.times.set(line, time);
    return time === 1 ? `L${line}` : `L${line}.${time}`;
  }

  private spend(at: TextPlace): void {
    if (++this.idle <= INSTRUCTIONS_WITHOUT_MOTION) return;
    if (this.memory.asked) throw new WaitsOutside(at, "job");
    throw new TextError(
      at,
      "a motion, a wait or an end",
      `The job has executed ${INSTRUCTIONS_WITHOUT_MOTION} instructions without a motion: it runs on the spot for ever.`,
    );
  }
}

const newFrame = (job: Job): Frame => ({ job, at: 0, last: [], step: [] });
