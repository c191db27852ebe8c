import type { MoveStep, Robot, Step } from "@twincell/core";
import { slowed } from "../../guard/index.ts";
import { TextRun } from "../../runner/index.ts";
import type { VirtualController } from "../../virtual/index.ts";
import { MANUAL_MPS, type Machine } from "./machine.ts";

/** Points that wait in ros_server's buffer, and motions that wait in the arm's stack behind it. */
export const MAX_POINTS = 10;
export const MAX_MOTIONS = 10;

/**
 * What makes the arm move: points of ros_server, one from its buffer into the stack of motions in each cycle, and a VAL
 * 3 program started at the pendant. A motion that lost its power stays in the stack and is carried out when the power
 * is back.
 */
export class Stack {
  private readonly robot: Robot;
  private readonly arm: VirtualController;
  private readonly machine: Machine;
  private points: MoveStep[] = [];
  private motions: MoveStep[] = [];
  private text: {
    readonly run: TextRun;
    readonly context: Parameters<VirtualController["run"]>[1];
    readonly over: (sentence: string) => void;
  } | null = null;
  private busy = false;
  private life = 0;
  /** `movej` counts its motions; `progress` is the one that is carried out or the last that was. */
  moveId = -1;
  progress = -1;

  constructor(robot: Robot, arm: VirtualController, machine: Machine) {
    this.robot = robot;
    this.arm = arm;
    this.machine = machine;
  }

  get waiting(): number {
    return this.points.length + this.motions.length;
  }
  get runsText(): boolean {
    return this.text !== null;
  }
  /** Of the program of the pendant that is carried out; 0 without one. */
  get line(): number {
    return this.text?.run.line ?? 0;
  }

  /** False when the buffer is full or a program of the pendant has the arm. */
  push(q_rad: readonly number[], ratio: number): boolean {
    if (this.points.length >= MAX_POINTS || this.text) return false;
    this.points.push({ id: "point", type: "move", path: "ptp", target: { q: q_rad }, speed: { ratio }, blend_m: 0 });
    return true;
  }
  /** `resetMotion`: the robot brakes and everything that waited is forgotten. */
  reset(): void {
    this.life++;
    this.points = [];
    this.motions = [];
    this.moveId = this.progress = -1;
    this.endText("The program was stopped.");
    if (this.busy) this.arm.stop();
  }
  start(text: NonNullable<Stack["text"]>): void {
    this.reset();
    this.text = text;
  }
  private endText(sentence: string): void {
    const ended = this.text;
    this.text = null;
    ended?.over(sentence);
  }

  /** Once a cycle. @param step  what the arm carries out. */
  cycle(step: string): void {
    this.text?.run.reached(step);
    const point = this.motions.length < MAX_MOTIONS ? this.points.shift() : undefined;
    if (point) {
      this.motions.push(point);
      this.moveId++;
    }
    if (this.busy || !this.machine.moves) return;
    const { text } = this;
    const motion = this.motions[0];
    if (text)
      this.carryOut(this.paced(text.run.rest()), text.context, () => {
        this.endText("");
      });
    else if (motion) {
      this.progress = this.moveId - this.motions.length + 1;
      this.carryOut([this.inMode(motion)], { tools: {}, frames: {} }, () => {
        this.motions.shift();
      });
    }
  }
  private *paced(steps: Iterable<Step>): Generator<Step, void> {
    let from: ArrayLike<number> = this.arm.jointAngles();
    for (const step of steps) {
      if (step.type !== "move") {
        yield step;
        continue;
      }
      yield this.inMode(step, from);
      from = "q" in step.target ? step.target.q : this.arm.jointAngles();
    }
  }
  private inMode(step: MoveStep, from: ArrayLike<number> = this.arm.jointAngles()): MoveStep {
    return this.machine.mode === "manual" ? slowed(this.robot, step, from, MANUAL_MPS) : step;
  }
  private carryOut(steps: Iterable<Step>, context: Parameters<VirtualController["run"]>[1], done: () => void): void {
    const mine = this.life;
    this.busy = true;
    void this.arm.run(steps, context).then(outcome => {
      this.busy = false;
      if (mine !== this.life) return;
      if (outcome.kind === "done") done();
      // Without power the motion waits; whatever else stands in its way ends it.
      else if (this.machine.isPowered) {
        this.machine.error = outcome.why.sentence;
        this.reset();
      }
    });
  }
}
