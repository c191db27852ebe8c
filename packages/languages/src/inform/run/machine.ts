import type { Executed, MoveStep, Pose, Signals, Step, TextPlace } from "@twincell/core";
import { TextError, missingProgram, WaitsOutside, type Notices } from "../../parser/index.ts";
import type { Condition, Instruction, Job, Move, Operand, Position, Source, Statement } from "../read/syntax.ts";
import { positionKey } from "../read/statement.ts";
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
  /** Arguments of the call. */
  readonly args: readonly number[];
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
  private readonly notices: Notices | undefined;
  /** Where further axes were sent last. */
  private others: string | undefined;

  constructor(
    source: Source,
    state: ControllerState,
    signals: Signals | undefined,
    met: Context["signals"],
    notices?: Notices,
  ) {
    this.source = source;
    this.state = state;
    this.notices = notices;
    this.memory = new Memory(signals, met, name => this.globalPosition(name), notices);
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

  // Motion
  // --------------------------------------------------------------------------------------------------------------

  /** A motion with the speed that its variable says. */
  private withSpeed(move: Extract<Statement, { kind: "move" }>): Extract<Statement, { kind: "move" }> {
    const { speedIn } = move;
    if (speedIn === undefined) return move;
    const read = (of: Operand | undefined, per: number, planned: number, unit: string): number | undefined => {
      if (of === undefined) return undefined;
      const value = this.memory.value(of) / per;
      if (value > 0 || this.notices === undefined) return value;
      this.memory.notGiven(
        `The speed of line ${move.line} is in none of the files: it is planned at ${planned} ${unit}.`,
      );
      return planned;
    };
    return { ...move, v: read(speedIn.v, 10, 100, "mm/s") ?? move.v, vj: read(speedIn.vj, 100, 10, "%") ?? move.vj };
  }

  private move(given: Extract<Statement, { kind: "move" }>, frame: Frame): void {
    const move = this.withSpeed(given);
    const taken = this.taken.get(move.position);
    if (taken !== undefined && (this.notices === undefined || move.motion === "MOVC" || move.motion === "MOVS"))
      return this.begin(move, taken);
    const missing = this.missing(move, frame);
    if (missing !== undefined) {
      this.endArc(move);
      this.memory.notGiven(`${missing}: the motion is not executed.`);
      this.state.isLost = true;
      return this.note(move);
    }
    this.further(move, frame);
    const position = move.by === undefined ? this.positionOf(move, frame) : this.incremented(move, move.by, frame);
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

  /** What of a motion only the controller knows; undefined where all of it is known. */
  private missing(move: Move & TextPlace, frame: Frame): string | undefined {
    if (this.notices === undefined) return undefined;
    const { position } = move;
    if (position.startsWith("C")) {
      // A position that was never taught stays empty.
      if (!frame.job.positions.has(position)) return undefined;
    } else {
      const given = this.memory.given(position);
      const taught = frame.job.positions.get(position) ?? this.globalPosition(position);
      if (given === undefined && taught === undefined) return `${position} is in none of the files`;
      if (given?.values.some(Number.isNaN) === true) return `${position} is in none of the files`;
    }
    const startsHere = move.by !== undefined || move.motion === "MOVC" || move.motion === "MOVS";
    return this.state.isLost && startsHere ? "Where the robot stands before it is not known" : undefined;
  }

  /** Further axes are named and not moved; a motion that follows what they carry is refused when they go on. */
  private further(move: Move & TextPlace, { job }: Frame): void {
    const others = (move.others ?? [])
      .join(" ")
      .replace(/\b(?:BC|EC)[0-9]+/g, name => job.others.get(positionKey(name)) ?? name);
    if (others !== "")
      this.notices?.add(
        move,
        "the axes of one arm",
        `Further axes go with the motion of line ${move.line} and are not moved: ${move.others!.join(", ")}.`,
      );
    if (others !== "" && this.notices === undefined)
      throw new TextError(
        move,
        "positions of the robot alone",
        "Positions of a track or a station are not understood here.",
      );
    if (move.follows === true && this.others !== undefined && others !== this.others)
      throw new TextError(
        move,
        "a motion along a station that stands still",
        `With SMOV the robot follows the station, which goes from ${standing(this.others)} to ${standing(others)}: stations are not moved here.`,
      );
    this.others = others;
  }

  /** IMOV: from where the robot stands, along the axes of a frame or of the tool. */
  private incremented(move: Move & TextPlace, by: NonNullable<Move["by"]>, frame: Frame): Position {
    const amount = this.positionOf(move, frame);
    if (amount.type === "PULSE" || amount.type === "ANGLE")
      throw new TextError(move, "an amount in X, Y, Z", "IMOV by the axes is not executed here.");
    if (this.notices === undefined)
      throw new TextError(move, "a position", "IMOV moves by an amount: write the position.");
    const type = by.frame === "TOOL" ? "BASE" : by.frame;
    const from = this.state.standing(type, by.user, amount.tool, move);
    return this.state.movedBy(from, amount.values, by.frame === "TOOL", move);
  }

  private positionOf({ position, ...at }: Move & TextPlace, { job }: Frame): Position {
    const given = position.startsWith("C") ? undefined : this.memory.given(position);
    if (given !== undefined) return given;
    const own = job.positions.get(position);
    const isVariable = !position.startsWith("C");
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
    this.memory.at = at;
    if (++this.idle <= INSTRUCTIONS_WITHOUT_MOTION) return;
    if (this.memory.asked) throw new WaitsOutside(at, "job");
    throw new TextError(
      at,
      "a motion, a wait or an end",
      `The job has executed ${INSTRUCTIONS_WITHOUT_MOTION} instructions without a motion: it runs on the spot for ever.`,
    );
  }
}

const newFrame = (job: Job, args: readonly number[] = []): Frame => ({ job, at: 0, last: [], step: [], args });
/** Where a station stands, or that it is not said. */
const standing = (others: string): string => (others === "" ? "where it was" : others);
