import {
  radians,
  type CommandOutcome,
  type Interpreted,
  type MoveStep,
  type Robot,
  type Step,
  type AxisCounting,
  jointsOfAxes,
} from "@twincell/core";
import { TextRun } from "../../runner/index.ts";
import type { VirtualController } from "../../virtual/index.ts";
import { PROGRAM, TWC, JOINTS } from "../codec/monitor.ts";
import type { Machine } from "./machine.ts";

const MOST_TEXT = 4_000_000;
const MOST_NAMES = 2_000;
const MILLI = 1000;

/**
 * Variables of the monitor, files of the disk, programs in memory, and the one task that has the robot. A refusal is
 * what the monitor says.
 */
export class Programs {
  readonly reals = new Map<string, number>();
  /** Precision points [deg]. */
  readonly points = new Map<string, readonly number[]>();
  /** What other definitions were given, line by line: an interpreter hears them before the command. */
  readonly definitions: string[] = [];
  private readonly disk = new Map<string, string>();
  /** The text of the file that a program came in. */
  private readonly memory = new Map<string, string>();
  private readonly arm: VirtualController;
  private readonly machine: Machine;
  private readonly robot: Robot;
  private readonly joints: AxisCounting;
  private readonly interpret: (text: string) => Interpreted;
  private readonly say: (text: string) => void;
  private task: { readonly run: TextRun; readonly context: Parameters<VirtualController["run"]>[1] } | null = null;
  private life = 0;
  private held = 0;
  isRunning = false;

  constructor(
    arm: VirtualController,
    machine: Machine,
    robot: Robot,
    joints: AxisCounting,
    interpret: (text: string) => Interpreted,
    say: (text: string) => void,
  ) {
    this.arm = arm;
    this.machine = machine;
    this.robot = robot;
    this.joints = joints;
    this.interpret = interpret;
    this.say = say;
  }
  get line(): number {
    return this.task?.run.line ?? 0;
  }
  get names(): string[] {
    return [PROGRAM.toLowerCase(), ...this.memory.keys()];
  }

  /** Puts a file on the controller's disk. */
  write(name: string, text: string): string | null {
    this.held += text.length - (this.disk.get(name.toLowerCase())?.length ?? 0);
    if (this.held > MOST_TEXT) {
      this.held -= text.length;
      return "*Device full*";
    }
    this.disk.set(name.toLowerCase(), text);
    return null;
  }
  load(name: string): string | null {
    const key = name.toLowerCase();
    const text = this.disk.get(key) ?? this.disk.get(`${key}.v2`);
    if (text === undefined) return "*Nonexistent file*";
    for (const [, program] of text.matchAll(/^\s*\.PROGRAM\s+([A-Za-z][\w.]*)/gim))
      this.memory.set(program!.toLowerCase(), text);
    return null;
  }
  setReal(name: string, value: number): string | null {
    if (this.reals.size >= MOST_NAMES) return "*Not enough storage area*";
    this.reals.set(name.toUpperCase(), value);
    return this.define(`${name} = ${value}`);
  }
  setPoint(name: string, joints_deg: readonly number[]): string | null {
    if (joints_deg.length !== JOINTS) return "*Illegal value*";
    if (this.points.size >= MOST_NAMES) return "*Not enough storage area*";
    this.points.set(name.toUpperCase(), joints_deg);
    return this.define(`SET ${name} = #PPOINT(${joints_deg.join(",")})`);
  }
  /** One statement of each name counts: the last. */
  define(statement: string): string | null {
    const name = statement.split("=")[0]!.trim().toUpperCase();
    const before = this.definitions.findIndex(each => each.split("=")[0]!.trim().toUpperCase() === name);
    if (before >= 0) this.definitions.splice(before, 1);
    if (this.definitions.length >= MOST_NAMES) return "*Not enough storage area*";
    this.definitions.push(statement);
    return null;
  }

  /** EXECUTE: the monitor is free at once, what becomes of the program is told when it ends. */
  execute(name: string): string | null {
    const why = this.isRunning || this.arm.isMoving() ? "*Program task already active*" : this.machine.hindrance;
    if (why) return why;
    if (name.toUpperCase() === PROGRAM) return this.move();
    const file = this.memory.get(name.toLowerCase());
    if (file === undefined) return "*Undefined program or variable name*";
    const read = this.interpret(first(file, name));
    if (read.kind === "not-understood") {
      const [fault] = read.faults;
      return `*${fault?.sentence ?? "Program not executable"}* line ${fault?.line ?? 1}`;
    }
    this.task = { run: new TextRun(read.run(this.arm.signals)), context: read.context };
    return this.proceed();
  }
  /** PROCEED: from where it was stopped. */
  proceed(): string | null {
    const { task } = this;
    const why = !task
      ? "*No program to proceed*"
      : this.isRunning || this.arm.isMoving()
        ? "*Program task already active*"
        : this.machine.hindrance;
    if (why) return why;
    this.carryOut(task!.run.rest(), task!.context, () => {
      this.task = null;
    });
    return null;
  }
  /** TWC.MOVE, as docs/controllers/TWINCELL.v2 has it. */
  private move(): string | null {
    const at = (name: string): number => this.reals.get(name) ?? NaN;
    const point = this.points.get("#TWC");
    const isLine = at(TWC.line) !== 0;
    const speed = at(TWC.speed);
    const accel = at(TWC.accel);
    if (!point || !(speed > 0) || !(accel > 0)) return "*Undefined value*";
    const id = at(TWC.id);
    this.carryOut(
      [
        this.step(
          point,
          isLine,
          isLine ? { mps: speed / MILLI } : { ratio: Math.min(1, speed / 100) },
          Math.min(1, accel / 100),
        ),
      ],
      { tools: {}, frames: {} },
      () => {
        this.reals.set(TWC.done, id);
      },
    );
    return null;
  }
  step(point: readonly number[], isLine: boolean, speed: MoveStep["speed"], acceleration: number): MoveStep {
    const q = [...jointsOfAxes(this.joints, point, new Float64Array(JOINTS))].map((value, i) => {
      // A ten-thousandth of a degree beyond a limit is on it.
      const { lower_rad, upper_rad } = this.robot.arm.joints[i]!.limits;
      const slack = radians(1e-4);
      return value > upper_rad && value < upper_rad + slack
        ? upper_rad
        : value < lower_rad && value > lower_rad - slack
          ? lower_rad
          : value;
    });
    return {
      id: "move",
      type: "move",
      path: isLine ? "lin" : "ptp",
      target: { q },
      speed,
      acceleration: { ratio: acceleration },
      blend_m: 0,
    };
  }
  carryOut(
    steps: Iterable<Step>,
    context: Parameters<VirtualController["run"]>[1],
    done: () => void,
    told = true,
  ): void {
    const mine = ++this.life;
    this.isRunning = true;
    void this.arm.run(steps, context).then((outcome: CommandOutcome) => {
      if (mine !== this.life) return;
      this.isRunning = false;
      if (outcome.kind === "done") done();
      if (told)
        this.say(
          outcome.kind === "done"
            ? "Program completed"
            : `*${this.machine.hindrance?.replaceAll("*", "") ?? outcome.why.sentence}*`,
        );
    });
  }
  /** ABORT: the program ends, and with it its motion. */
  abort(): void {
    if (!this.isRunning) return;
    this.life++;
    this.isRunning = false;
    this.arm.stop();
    this.say("Program aborted");
  }
  cycle(step: string): void {
    this.task?.run.reached(step);
  }
  forget(): void {
    this.life++;
    this.isRunning = false;
    this.task = null;
  }
}

/** The file with that program in front: an interpreter executes the first one. */
function first(file: string, name: string): string {
  const block =
    new RegExp(`^[ \\t]*\\.PROGRAM\\s+${name.replaceAll(".", "\\.")}\\b[\\s\\S]*?^[ \\t]*\\.END[^\\n]*\\n?`, "im").exec(
      file,
    )?.[0] ?? "";
  return block + file.replace(block, "");
}
