import type { Executed, MoveStep, Pose, Signals, Step, TextPlace } from "@twincell/core";
import { TextError, WaitsOutside, type Notices, type DeclaredCell } from "../../parser/index.ts";
import type { Condition, Job, Move, Position, Source } from "../read/syntax.ts";
import { Memory, looksOutside } from "./memory.ts";
import type { ControllerState } from "./state.ts";

/** Instructions without a motion or a wait after which the job is taken to run on the spot for ever. */
const INSTRUCTIONS_WITHOUT_MOTION = 100_000;

export interface Frame {
  readonly job: Job;
  at: number;
  readonly last: number[];
  readonly step: number[];
  /** Arguments of the call. */
  readonly args: readonly number[];
}

/** An input is asked while what stands before it is not executed yet. Never leaves the machine. */
export class ReadTooEarly extends Error {}

/** What comes out of jobs: steps in the order in which the robot carries them out, arcs as one. */
export abstract class ExecutedSteps {
  protected readonly memory: Memory;
  protected readonly source: Source;
  protected readonly state: ControllerState;
  protected readonly stack: Frame[] = [];
  private readonly times = new Map<number, number>();
  /** A motion of which it is not yet known whether the robot stops at its end, and what was executed since. */
  private pending: { readonly line: number; readonly step: MoveStep; readonly corner_m: number } | undefined;
  private readonly since: Executed[] = [];
  protected ready: Executed[] = [];
  /** The point on the way of an arc that has begun; how many points of it were met. */
  protected arc: {
    readonly points: number;
    readonly via: { readonly position: Position; readonly line: number } | undefined;
  } = { points: 0, via: undefined };
  protected inCurve = false;
  /** Positions that were taken from the robot itself, by their variable. */
  protected readonly taken = new Map<string, Pose<"base", "flange">>();
  private idle = 0;
  protected stopped = false;
  protected readonly notices: Notices | undefined;
  /** Where further axes were sent last. */
  protected others: string | undefined;

  constructor(
    source: Source,
    state: ControllerState,
    signals: Signals | undefined,
    met: DeclaredCell["signals"],
    notices?: Notices,
  ) {
    this.source = source;
    this.state = state;
    this.notices = notices;
    this.memory = new Memory(signals, met, name => this.globalPosition(name), notices);
  }

  protected abstract globalPosition(key: string): Position | undefined;

  /** What was done before an input is asked is executed first: the instruction comes again when it has been. */
  protected standStill(): void {
    this.settle(false);
    if (this.ready.length > 0) throw new ReadTooEarly();
  }

  protected holds(when: Condition, at: TextPlace): boolean {
    if (looksOutside(when)) this.standStill();
    return this.memory.holds(when, at);
  }

  /** @throws {TextError} when an arc has a point on the way and no end. */
  protected endArc(at: TextPlace): void {
    const { via } = this.arc;
    this.arc = { points: 0, via: undefined };
    if (via !== undefined)
      throw new TextError(
        { line: via.line, column: 1 },
        "a third MOVC behind it",
        `The arc with the point of line ${via.line} has no end before line ${at.line}.`,
      );
  }

  protected go(move: Move & TextPlace, position: Position, via: Position | undefined, frame: Frame): void {
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

  protected settle(goesOn: boolean): void {
    const { pending } = this;
    if (pending === undefined) return;
    this.pending = undefined;
    this.ready.push(
      { line: pending.line, step: goesOn ? { ...pending.step, blend_m: pending.corner_m } : pending.step },
      ...this.since.splice(0),
    );
  }

  protected note({ line }: TextPlace): void {
    if (this.pending === undefined) this.ready.push({ line });
    else this.since.push({ line });
  }

  protected step({ line }: TextPlace, step: Step): void {
    this.idle = 0;
    this.ready.push({ line, step });
  }

  /** L12, and L12.2 when line 12 is executed again. */
  protected stepId(line: number): string {
    const time = (this.times.get(line) ?? 0) + 1;
    this.times.set(line, time);
    return time === 1 ? `L${line}` : `L${line}.${time}`;
  }

  protected spend(at: TextPlace): void {
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
