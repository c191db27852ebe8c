import type { CommandOutcome, Refusal, TextFault } from "./outcomes.ts";
import type { Signals } from "./signals.ts";
import type { Robot } from "./model/robot.ts";
import type { GraspSignal } from "./physical/grasp.ts";
import type { PhysicalScene } from "./physical/scene.ts";
import type { Pose } from "./spatial/pose.ts";
import type { Capability } from "./program/capabilities.ts";
import type { Program, Step } from "./program/program.ts";

/** Time given from outside: a real clock in the apps, a virtual one in tests. */
export interface Scheduler {
  /** Seconds since an arbitrary start; never runs backwards. */
  now_s(): number;
  /** Calls `tick` every `period_s` until the returned function is called. */
  every(period_s: number, tick: () => void): () => void;
}

export type OperatingMode = "manual" | "automatic" | "remote";
export type SafetyState = "normal" | "guard-stop" | "protective-stop" | "emergency-stop";

/** What a robot says of itself at one instant. */
export interface JointSample {
  readonly sequence: number;
  /** The controller's own time [s]. */
  readonly time_s: number;
  readonly q_rad: Float64Array;
  /** What the controller commands at that time, where it says so. Lent like the rest. */
  readonly target_rad?: Float64Array;
  readonly moving: boolean;
  readonly mode: OperatingMode;
  readonly safety: SafetyState;
  /** 0 … 1. */
  readonly override: number;
  readonly gripperClosed: boolean;
  /** Id of the step being executed, or "". */
  readonly step: string;
  /** Last fault, or what the program last said, in words; or "". */
  readonly message: string;
  /** What the lines are that were ever written, by name. Lent like the rest; left out by sources that do not know. */
  readonly signals?: ReadonlyMap<string, boolean | number>;
}

/** Live, virtual and recorded state come through one door; what a source cannot do it does not have. */
export interface StateSource {
  readonly name: string;
  readonly robot: Robot;
  /** `lent` is only valid during the call: copy what you keep. Returns the unsubscriber. */
  onSample(listen: (lent: JointSample) => void): () => void;
  readonly timeline?: Timeline;
  close(): void;
}

export interface Timeline {
  readonly start_s: number;
  readonly end_s: number;
  /** Emits the sample in force at that time. */
  seek(to_s: number): void;
  setSpeed(factor: number): void;
  play(): void;
  pause(): void;
}

/** One interface for virtual, real and twin robots (rows T-01 … T-18). Joints count from 1. */
export interface RobotController extends StateSource {
  readonly kind: "virtual" | "real" | "twin";
  isMoving(): boolean;
  /** Override 0 … 100 %. 0 holds the robot where it is. */
  setSpeed(percent: number): CommandOutcome;
  jointAngle(joint: number): number;
  jointAngles(out?: Float64Array): Float64Array;
  moveJoint(joint: number, angle_rad: number): Promise<CommandOutcome>;
  moveJoints(q_rad: ArrayLike<number>): Promise<CommandOutcome>;
  moveToPose(baseFromFlange: Pose<"base", "flange">): Promise<CommandOutcome>;
  moveToZero(): Promise<CommandOutcome>;
  /**
   * Executes primitive steps (`unrolled` makes them of a program) one after the other; the iterator is asked for the
   * next when it is needed (T-53).
   */
  run(steps: Iterable<Step>, context: Pick<Program, "tools" | "frames">): Promise<CommandOutcome>;
  /**
   * Why this controller cannot be told that step, wherever the robot stands; null when it can. It follows from what the
   * connection can say at all, so that a whole program is asked for before its first motion. Steps that hold others are
   * asked by what they hold.
   */
  cannotCarryOut(step: Step): Refusal | null;
  /** Stops along the path. `emergency` also takes the drives off: moves are refused until `reset`. */
  stop(emergency?: boolean): void;
  /**
   * Clears a stop: alarms, drives, brakes. Resolves when the robot says that it would take a command again, or why not;
   * a stop in the meantime wins and refuses it.
   */
  reset(): Promise<CommandOutcome>;
  /** The lines in and out, by name. A controller without them does not have it. */
  readonly signals?: Signals;
  /** Virtual robots only (row T-18). */
  readonly jumpTo?: (q_rad: ArrayLike<number>) => CommandOutcome;
}

/**
 * How the connection to a real robot is: connecting tries again by itself, with growing pauses; only a person closes
 * it.
 */
export type LinkState = "closed" | "connecting" | "open" | "lost";
export interface LinkReport {
  readonly state: LinkState;
  /** Why it is as it is, in words; "" while it is open. */
  readonly sentence: string;
  /** Tries since it was last open. */
  readonly attempts: number;
  /** Samples that came per second, over the last second. */
  readonly rate_Hz: number;
  /** How much later than the fastest one the last sample came [s]; with `roundTrip_s` the age of what is shown. */
  readonly late_s: number;
  /** From a question to its answer [s]; NaN where the protocol asks nothing. */
  readonly roundTrip_s: number;
  /** Samples that the controller's own count or clock says are missing, since it was last opened. */
  readonly missing: number;
}
/** What stops the robot when nobody commands it any more: its own controller, or nothing on its side. */
export type Watchdog =
  | { readonly kind: "robot"; readonly within_s: number }
  | { readonly kind: "none"; readonly because: string };

/**
 * A robot on a wire (rows T-19 … T-22). Its commands are refused while the link is not open; nothing here waits for the
 * wire.
 */
export interface RealController extends RobotController {
  readonly kind: "real";
  readonly isConnected: boolean;
  readonly link: LinkReport;
  readonly watchdog: Watchdog;
  /**
   * Resolves with the first answer: open, or why not. A lost link is opened again without being asked; motion is not.
   */
  connect(): Promise<CommandOutcome>;
  disconnect(): void;
  onLink(listen: (report: LinkReport) => void): () => void;
  /** Hands the controller a program in its own language and runs it there to its end. */
  readonly runText?: (files: readonly EmittedFile[]) => Promise<CommandOutcome>;
  /** The same in two: handed over first, where nothing moves yet, and started when it is wanted. */
  readonly handText?: (files: readonly EmittedFile[]) => Promise<UploadedProgram>;
}
/** A program text that a controller has taken and not yet begun. */
export type UploadedProgram =
  | { readonly kind: "handed"; start(): Promise<CommandOutcome> /** It is not started after all. */; drop(): void }
  | { readonly kind: "refused"; readonly why: Refusal };

export interface EmittedFile {
  readonly name: string;
  readonly text: string;
  /** lines[i] is the step id that line i + 1 came from, or "". */
  readonly lines: readonly string[];
}
export type Emitted =
  | { readonly kind: "emitted"; readonly files: readonly EmittedFile[]; readonly warnings: readonly string[] }
  | { readonly kind: "cannot"; readonly step: string; readonly sentence: string; readonly hint: string };
/** What a reader left out because it did not understand it: the fault there, and how much is missing. */
export interface Skipped extends TextFault {
  /** A motion that is not carried out, a block whose condition nobody asks, or anything else. */
  readonly what: "motion" | "branch" | "statement";
  /** The first line as it stands, and the last line that is left out with it. */
  readonly text: string;
  readonly lastLine: number;
}
/** How a text is read. */
export interface ReadOptions {
  /** Leaves out the statements that are not understood instead of refusing the text, and tells each of them. */
  readonly skipUnknown?: boolean;
  /**
   * A call of a program that is in none of the files does nothing and is told in `notExecuted`. Without it the text is
   * refused, every such call with its line.
   */
  readonly missingPrograms?: "leave-out";
}
export type Parsed =
  | {
      readonly kind: "parsed";
      readonly program: Program;
      readonly warnings: readonly TextFault[];
      readonly skipped?: readonly Skipped[];
    }
  | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] };
/**
 * Statement by statement: the line being executed and the neutral step it amounts to, if any. Steps are primitive:
 * loops, calls and decisions have been carried out. A decision reads `signals` when it is reached.
 */
export interface Executed {
  readonly line: number;
  readonly step?: Step;
}
/**
 * What the steps of a text refer to. Signals are named as the text names them, with the controller's numbers as
 * addresses.
 */
export type TextContext = Pick<Program, "tools" | "frames"> & Partial<Pick<Program, "signals">>;
export type Interpreted =
  | {
      readonly kind: "ready";
      readonly run: (signals?: Signals) => Iterator<Executed, void>;
      readonly context: TextContext;
      readonly skipped?: readonly Skipped[];
      /**
       * Statements that are kept and shown but not executed, none of which moves the robot: each with what it would do.
       */
      readonly notExecuted?: readonly TextFault[];
    }
  | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] };

/** Half a step of what a language can say of a number, and the most it can say. */
export interface Resolution {
  /** Of a share of the joint speed. */
  readonly ratio?: number;
  /** Smaller shares become this. */
  readonly leastRatio?: number;
  readonly mps?: number;
  /** Speeds of a path above this are cut. */
  readonly mostMps?: number;
  /** Softer accelerations become this share. */
  readonly leastAcceleration?: number;
  /** Of a waiting time [s]. */
  readonly wait_s?: number;
  /** What rounding of joint values can do to where the tool is. */
  readonly position_m?: number;
  readonly angle_rad?: number;
  /** Joint angles are written as the pose they reach, with the posture. */
  readonly anglesAsPoses?: boolean;
  /** The robot stands before the language takes another tool: points between two tools are not passed. */
  readonly stopsAtNewTool?: boolean;
  /** Poses are written as joint angles that reach them. */
  readonly posesAsAngles?: boolean;
}

/**
 * What lines of a language look like to whoever leaves out those that are not understood. Each pattern is tried on one
 * line.
 */
export interface LineShapes {
  /** Moves the robot. */
  readonly motion: RegExp;
  /** Opens a block, goes on to another part of it, closes it. */
  readonly opens: RegExp;
  readonly parts: RegExp;
  readonly closes: RegExp;
  /** Without these the text is no program: they are never left out. */
  readonly keeps: RegExp;
  /** What stands in the place of a line that is left out; nothing when it is not given. */
  readonly blank?: (line: string) => string;
  /**
   * How a call of a program is written inside a line that holds more than it, as behind THEN, and what does nothing in
   * its place.
   */
  readonly callInLine?: { readonly call: (name: string) => RegExp; readonly instead: string };
}

/**
 * Another text that the same controller takes, which holds less than its programs do: a list of positions, for
 * instance.
 */
export interface TextForm {
  readonly id: string;
  readonly name: string;
  readonly emit: (program: Program, robot: Robot) => Emitted;
  /** The program as this text says it: what is left out of it is as the controller takes it then. */
  readonly said: (program: Program) => Program;
  readonly resolution: Resolution;
}

/**
 * A robot language. One folder each; `cannot` is shown to the user as it stands.
 *
 * Programs count in the world of the cell, controllers from the robot: `worldFromBase` says where the robot stands.
 * Left out, it stands in the origin of the world.
 */
export interface Dialect {
  readonly id: string;
  readonly brand: string;
  readonly name: string;
  readonly extensions: readonly string[];
  readonly maturity: "proven" | "experimental";
  readonly cannot: readonly { readonly what: Capability; readonly because: string }[];
  /** What the language has no statement for and is written with those it has, as its programmers do. */
  readonly idioms?: readonly Capability[];
  /** Where the language itself is coarser than the proof of its text is strict. */
  readonly resolution?: Resolution;
  /**
   * What a controller executes, as one text, where that is more than the first of the files: a program and its data
   * list.
   */
  runnable?(files: readonly EmittedFile[]): EmittedFile;
  emit(program: Program, robot: Robot, worldFromBase?: Pose<"world", "base">): Emitted;
  readonly forms?: readonly TextForm[];
  /** Dialects with `lines` leave out what they do not understand when they are asked to. */
  readonly lines?: LineShapes;
  parse(text: string, robot: Robot, worldFromBase?: Pose<"world", "base">, options?: ReadOptions): Parsed;
  /** Executes the text with the vendor's own conventions. Written independently of `emit`. */
  interpret(text: string, robot: Robot, worldFromBase?: Pose<"world", "base">, options?: ReadOptions): Interpreted;
}

/** What the arm and its gripper are told for the next step of a physical cell. */
export interface DynamicsCommand {
  /** Where the joints are to be at its end, how fast and with which acceleration [rad, rad/s, rad/s²]. */
  readonly q_rad: ArrayLike<number>;
  readonly qd_rad_s: ArrayLike<number>;
  readonly qdd_rad_s2: ArrayLike<number>;
  readonly gripperClosed: boolean;
}

/** A physical cell at one instant. Lent: overwritten by the next step. */
export interface DynamicsState {
  readonly time_s: number;
  readonly q_rad: Float64Array;
  readonly qd_rad_s: Float64Array;
  /** What the drives give [N m]. */
  readonly torque_Nm: Float64Array;
  /** Between the fingers [m]; 0 without a gripper. */
  readonly opening_m: number;
  /** Seven numbers of each part: x y z [m], quaternion x y z w. */
  readonly parts: Float64Array;
  readonly grasp: readonly GraspSignal[];
}

/** Why a physical cell does not go on: the state before it is kept, and no number of it is ever NaN. */
export type DynamicsOutcome = { readonly kind: "running" } | { readonly kind: "paused"; readonly why: Refusal };

/**
 * Bodies with mass that touch: an arm, its gripper, parts, belts, sensors. One step after the other, without a clock;
 * the same scene, commands and engine give the same states to the last bit.
 */
export interface Dynamics {
  readonly scene: PhysicalScene;
  readonly step_s: number;
  /** Ids of the parts, in the order of `DynamicsState.parts`. */
  readonly parts: readonly string[];
  readonly masses_kg: readonly number[];
  readonly state: DynamicsState;
  /** The lines of belts are read from here and those of sensors written to it. */
  readonly signals: Signals;
  step(command: DynamicsCommand): DynamicsOutcome;
  /** Puts a part somewhere, at rest: a feeder, a shuffled start. */
  place(part: string, worldFromPart: Pose<"world", "object">): void;
  /** Everything as it was at the start. */
  reset(): void;
  close(): void;
}
