import { jointsOfAxes, type MoveStep, type Pose, type AxisCounting } from "@twincell/core";
import type { VirtualController } from "../../virtual/index.ts";
import { AXES, AXIS_NAMES, poseIn } from "../codec/axes.ts";
import { partsIn } from "../codec/values.ts";
import { TWC, TWC_KIND, TWC_RESULT, WATCH_TIMER } from "../codec/loop.ts";
import type { Builtin } from "./builtin.ts";
import type { Globals, Timers } from "./globals.ts";
import type { Machine } from "./machine.ts";

/** Why the arm was stopped when the machine in front of it did it. */
export const BY_MACHINE: readonly string[] = ["controller.stopped", "safety.emergency-stop", "controller.closed"];
/** $VEL.CP below this is none [m/s]. */
const LEAST_MPS = 1e-6;

/**
 * What the program TWINCELL does, statement for statement, as a controller executes it: it waits for commands in its
 * globals, moves, and brakes by interrupt. A motion that something else stopped goes on when the program is started
 * again, unless TWC_STOP has been set by then.
 */
export class LoopRun implements Builtin {
  private readonly globals: Globals;
  private readonly timers: Timers;
  private readonly arm: VirtualController;
  private readonly machine: Machine;
  private readonly axes: AxisCounting;
  private readonly slow: (step: MoveStep) => MoveStep;
  private motion: MoveStep | null = null;
  private now = 0;
  private running = 0;
  private braking = 0;

  constructor(
    globals: Globals,
    timers: Timers,
    arm: VirtualController,
    machine: Machine,
    axes: AxisCounting,
    slow: (step: MoveStep) => MoveStep,
  ) {
    this.globals = globals;
    this.timers = timers;
    this.arm = arm;
    this.machine = machine;
    this.axes = axes;
    this.slow = slow;
  }

  /** Deselected: what was under way is forgotten. */
  abandon(): void {
    this.running++;
    this.motion = null;
    this.braking = 0;
  }
  /** From the first line. */
  begin(): void {
    const { globals, timers } = this;
    this.abandon();
    timers.stop(WATCH_TIMER, true);
    timers.write(WATCH_TIMER, -1000);
    globals.set(TWC.done, globals.number(TWC.command));
    globals.set(TWC.stop, false);
  }
  /** The start key after a stop. */
  goOn(): void {
    if (!this.motion) return;
    if (this.globals.bool(TWC.stop)) this.end(TWC_RESULT.stopped);
    else this.move();
  }

  /** Once a cycle while the program is active. */
  cycle(): void {
    const { globals, timers } = this;
    if (this.motion) {
      if (this.braking !== 0) return;
      if (globals.bool(TWC.stop)) this.brake(TWC_RESULT.stopped);
      else if (!timers.stopped(WATCH_TIMER) && timers.read(WATCH_TIMER) > 0) this.brake(TWC_RESULT.silent);
      return;
    }
    const command = globals.number(TWC.command);
    if (globals.bool(TWC.stop)) {
      this.now = command;
      this.end(TWC_RESULT.stopped);
    } else if (command !== globals.number(TWC.done)) this.take(command);
  }

  private take(command: number): void {
    const { globals, timers } = this;
    this.now = command;
    globals.set(TWC.result, TWC_RESULT.running);
    const step = globals.bool(TWC.lock) ? null : this.step();
    if (!step) {
      this.end(TWC_RESULT.refused);
      return;
    }
    timers.write(WATCH_TIMER, -globals.number(TWC.watch));
    timers.stop(WATCH_TIMER, false);
    this.motion = this.slow(step);
    this.move();
  }

  private step(): MoveStep | null {
    const { globals } = this;
    const base = { id: `${TWC.command} ${this.now}`, type: "move", blend_m: 0 } as const;
    const percent = (name: string): number => Math.min(100, Math.max(1, globals.number(name))) / 100;
    const acceleration = { ratio: percent(TWC.acceleration) };
    if (globals.number(TWC.kind) === TWC_KIND.joints) {
      const a_deg = new Float64Array(AXES);
      if (!partsIn(globals.text(TWC.axis)!, AXIS_NAMES, a_deg)) return null;
      return {
        ...base,
        path: "ptp",
        acceleration,
        target: { q: [...jointsOfAxes(this.axes, a_deg, new Float64Array(AXES))] },
        speed: { ratio: percent(TWC.ratio) },
      };
    }
    const mps = globals.number(TWC.speed);
    const to = poseIn(globals.text(TWC.position)!);
    const via = poseIn(globals.text(TWC.via)!);
    if (!to || !(mps > LEAST_MPS)) return null;
    // The base is the world here, and the flange its tool.
    const place = (at: Pose) => ({ pose: at as Pose<"frame", "tcp">, frame: "world", tool: "flange" });
    const path = { ...base, acceleration, target: place(to), speed: { mps } };
    if (globals.number(TWC.kind) === TWC_KIND.line) return { ...path, path: "lin" };
    return globals.number(TWC.kind) === TWC_KIND.arc && via ? { ...path, path: "circ", via: place(via) } : null;
  }

  private move(): void {
    const mine = ++this.running;
    void this.arm.run([this.motion!], { tools: {}, frames: {} }).then(outcome => {
      if (mine !== this.running || !this.motion) return;
      if (this.braking !== 0) this.end(this.braking);
      else if (outcome.kind === "done") this.end(TWC_RESULT.done);
      // A target that cannot be reached stops the program with a message, as the controller does; what the machine
      // stopped waits.
      else if (outcome.kind === "refused" || !BY_MACHINE.includes(outcome.why.code))
        this.machine.stop(2, outcome.why.sentence);
    });
  }
  private brake(result: number): void {
    this.braking = result;
    this.arm.stop();
  }
  private end(result: number): void {
    const { globals, timers } = this;
    this.motion = null;
    this.braking = 0;
    timers.stop(WATCH_TIMER, true);
    globals.set(TWC.result, result);
    globals.set(TWC.done, this.now);
    if (result === TWC_RESULT.stopped || result === TWC_RESULT.silent) globals.set(TWC.stop, false);
  }
}
