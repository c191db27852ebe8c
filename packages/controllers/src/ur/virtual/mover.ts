import type { JointSample, Program, Robot, Step } from "@twincell/core";
import type { VirtualController } from "../../virtual/index.ts";
import { Stream } from "./stream.ts";

/** A motion that was begun: over when the arm stands again, with a sentence when it did not come to its end. */
export interface Moving {
  over: boolean;
  sentence: string;
  begun: boolean;
}

/**
 * Everything that moves the arm: whole motions through the neutral virtual robot, and streams of targets. One at a
 * time.
 */
export class Mover {
  readonly stream: Stream;
  private readonly neutral: VirtualController;
  private readonly q: Float64Array;
  private readonly last: Float64Array;
  private readonly dt_s: number;
  private moving: Moving | null = null;
  private rate = 1;
  private held = false;
  /** Joint speeds over the last cycle [rad/s]. */
  readonly qd: Float64Array;

  constructor(neutral: VirtualController, robot: Robot, dt_s: number) {
    this.neutral = neutral;
    this.dt_s = dt_s;
    this.stream = new Stream(robot, dt_s);
    this.q = neutral.jointAngles();
    this.last = neutral.jointAngles();
    this.qd = new Float64Array(this.q.length);
  }

  /** Whether nothing is under way. */
  get isAtRest(): boolean {
    return this.moving === null && this.stream.isAtRest;
  }
  /** Whether a whole motion is under way. */
  get isTravelling(): boolean {
    return this.moving !== null;
  }
  get isMoving(): boolean {
    return this.qd.some(speed => Math.abs(speed) > 1e-9);
  }

  /** Begins steps from standstill. */
  run(steps: Iterable<Step>, context: Pick<Program, "tools" | "frames">): Moving {
    const mine: Moving = { over: false, sentence: "", begun: false };
    this.moving = mine;
    void this.neutral.run(steps, context).then(outcome => {
      this.end(mine, outcome.kind === "done" ? "" : outcome.why.sentence);
    });
    return mine;
  }
  private end(moving: Moving, sentence: string): void {
    if (moving.over) return;
    moving.over = true;
    moving.sentence = sentence;
    if (this.moving === moving) this.moving = null;
  }

  /** Everything comes to rest, as fast as the accelerations allow. */
  stop(deceleration = Infinity): void {
    this.stream.rest(deceleration);
    if (this.moving) this.neutral.stop();
  }

  /** Speed slider 0 … 1. */
  setRate(rate: number): void {
    this.rate = rate;
    this.neutral.setSpeed(100 * (this.held ? 0 : rate));
  }
  /** Holding stops along the path, which goes on from there; streams end. */
  hold(held: boolean): void {
    this.held = held;
    if (held) this.stream.rest(Infinity);
    this.setRate(this.rate);
  }

  /**
   * One cycle, after the neutral robot has made its own; the posture is lent.
   *
   * @param sample  of the neutral robot: that it executes no step any more is known here a cycle before its promise
   *   resolves.
   */
  cycle(sample: JointSample): Float64Array {
    this.neutral.jointAngles(this.q);
    if (this.moving && sample.step !== "") this.moving.begun = true;
    else if (this.moving?.begun) this.end(this.moving, sample.message);
    const next = this.moving === null ? this.stream.advance(this.q) : null;
    if (next && this.neutral.jumpTo(next).kind === "done") this.q.set(next);
    for (let i = 0; i < this.q.length; i++) {
      this.qd[i] = (this.q[i]! - this.last[i]!) / this.dt_s;
      this.last[i] = this.q[i]!;
    }
    return this.q;
  }
}
