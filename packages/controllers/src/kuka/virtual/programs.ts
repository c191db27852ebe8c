import type { CommandOutcome, Interpreted, Robot, Step } from "@twincell/core";
import type { VirtualController } from "../../virtual/index.ts";

import { LOOP_FILES } from "../codec/loop.ts";
import type { Builtin } from "./builtin.ts";
import { Job } from "./job.ts";
import { BY_MACHINE } from "./loop-run.ts";
import type { Machine } from "./machine.ts";

/** $PRO_STATE1 without its #P_. */
export type ProgramState = "FREE" | "RESET" | "ACTIVE" | "STOP" | "END";
/** Kept in all files together. */
const MOST_CHARACTERS = 16_000_000;

/** `KRC:\R1\PROGRAM\A.SRC`, `/R1/a` and `A` are the same module. */
export const moduleOf = (path: string): string =>
  (path.split(/[\\/]/).at(-1) ?? "")
    .replace(/\.(SRC|DAT|SUB)$/i, "")
    .replace(/\(.*$/, "")
    .trim()
    .toUpperCase();

/**
 * The programs on the controller and the one that is selected: selected, run to its path, executed, stopped, taken up
 * again. Why something cannot be is a sentence; null when it was done.
 */
export class Programs {
  private readonly arm: VirtualController;
  private readonly machine: Machine;
  private readonly builtins: ReadonlyMap<string, Builtin>;
  private builtin: Builtin | null = null;
  private readonly robot: Robot;
  private readonly interpret: (text: string) => Interpreted;
  private readonly files = new Map<string, string>();
  private job: Job | null = null;
  private isState: ProgramState = "FREE";
  private isName = "";
  private onPath = false;
  private begun = false;
  private run = 0;
  private step = "";

  constructor(
    arm: VirtualController,
    machine: Machine,
    builtins: ReadonlyMap<string, Builtin>,
    robot: Robot,
    interpret: (text: string) => Interpreted,
  ) {
    this.arm = arm;
    this.machine = machine;
    this.builtins = builtins;
    this.robot = robot;
    this.interpret = interpret;
    for (const { name, text } of LOOP_FILES) this.write(name, text);
  }

  get state(): ProgramState {
    return this.isState;
  }
  get name(): string {
    return this.isName;
  }

  write(path: string, text: string): string | null {
    const key = path.split(/[\\/]/).at(-1)!.toUpperCase();
    if (!/^[A-Z$_][A-Z0-9$_]{0,23}\.(SRC|DAT|SUB)$/.test(key)) return `${path} is no name of a module.`;
    let held = text.length;
    for (const [name, is] of this.files) if (name !== key) held += is.length;
    if (held > MOST_CHARACTERS) return "The memory of the controller is full.";
    this.files.set(key, text);
    return null;
  }
  read(path: string): string | undefined {
    return this.files.get(path.split(/[\\/]/).at(-1)!.toUpperCase());
  }
  delete(path: string): boolean {
    const module = moduleOf(path);
    if (module === this.isName) return false;
    return [this.files.delete(`${module}.SRC`), this.files.delete(`${module}.DAT`)].some(gone => gone);
  }

  select(path: string): string | null {
    const name = moduleOf(path);
    const src = this.files.get(`${name}.SRC`);
    const builtin = this.builtins.get(name) ?? null;
    if (this.isState === "ACTIVE") return "A program is running.";
    if (src === undefined && !builtin) return `There is no program ${name}.`;
    if (!builtin) {
      const read = this.interpret(src! + (this.files.get(`${name}.DAT`) ?? ""));
      if (read.kind === "not-understood") {
        const fault = read.faults[0];
        this.machine.say(`${name}, line ${fault?.line ?? 1}: ${fault?.sentence ?? "not understood"}`);
        return `${name} has an error in line ${fault?.line ?? 1}: ${fault?.sentence ?? "not understood"}`;
      }
      this.job = new Job(read, this.robot, this.arm.signals, () => this.arm.jointAngles());
    } else this.job = null;
    this.builtin?.abandon();
    this.builtin = builtin;
    this.isName = name;
    this.rewind();
    return null;
  }
  private rewind(): void {
    this.run++;
    this.builtin?.abandon();
    this.isState = "RESET";
    this.onPath = this.begun = false;
    this.machine.hold(false);
    this.machine.setShare(1);
  }
  reset(): string | null {
    if (this.isState === "ACTIVE") return "A program is running.";
    return this.isName === "" ? "No program is selected." : this.select(this.isName);
  }
  cancel(): string | null {
    if (this.isState === "FREE") return null;
    this.arm.stop();
    this.run++;
    this.builtin?.abandon();
    this.builtin = null;
    this.isState = "FREE";
    this.isName = "";
    this.job = null;
    this.machine.hold(false);
    return null;
  }

  /** The start key, or what stands for it in EXT. */
  start(): string | null {
    const why = this.machine.hindrance;
    if (why) return why;
    if (this.isState === "FREE" || this.isState === "END")
      return this.isName === "" ? "No program is selected." : "The program has ended; reset it first.";
    if (this.isState === "ACTIVE") return null;
    if (this.machine.isHeld) {
      this.machine.hold(false);
      this.isState = "ACTIVE";
      return null;
    }
    this.isState = "ACTIVE";
    if (this.builtin) {
      if (this.begun) this.builtin.goOn();
      else {
        this.begun = true;
        this.builtin.begin();
      }
      // Its first motion is none: it is on its path at once.
      if (!this.onPath) this.reachedPath();
      return null;
    }
    const job = this.job!;
    if (!this.onPath)
      this.carryOut(job.toThePath(true), () => {
        this.reachedPath();
      });
    else
      this.carryOut(job.rest(this.machine.mode === "T1"), () => {
        this.isState = "END";
      });
    return null;
  }
  /** The stop key: the robot stops on its path and goes on from there. */
  hold(): void {
    if (this.isState !== "ACTIVE") return;
    this.isState = "STOP";
    this.machine.hold(true);
  }

  /** The arm was stopped for a reason of its own. */
  interrupted(): void {
    if (this.isState !== "ACTIVE" && !this.machine.isHeld) return;
    this.isState = "STOP";
    this.builtin?.interrupted?.();
    this.machine.hold(false);
  }
  /** Once a cycle. @param step  what the arm carries out. */
  cycle(step: string): void {
    if (step !== "") this.step = step;
    if (this.isState === "ACTIVE") this.builtin?.cycle();
  }

  private carryOut(steps: Iterator<Step, void>, then: () => void): void {
    const mine = ++this.run;
    const { job } = this;
    this.step = "";
    void this.arm.run({ [Symbol.iterator]: () => steps }, job!.context).then((outcome: CommandOutcome) => {
      if (mine !== this.run) return;
      if (outcome.kind === "done") {
        then();
        return;
      }
      job!.takeUp(this.step);
      if (!BY_MACHINE.includes(outcome.why.code)) this.machine.stop(2, outcome.why.sentence);
      this.isState = "STOP";
    });
  }
  /** On the path: EXT goes on by itself, otherwise a person starts once more. */
  private reachedPath(): void {
    this.onPath = true;
    this.isState = "STOP";
    if (this.machine.mode === "EX") this.start();
    else this.machine.say("Programmed path reached (BCO)");
  }
}
