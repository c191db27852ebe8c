import type { Branch } from "../kinematics/branch.ts";
import type { Expression, ValueType, Variable } from "./expression/expression.ts";
import type { Pallet } from "./pallet.ts";
import type { Pose } from "../spatial/pose.ts";
import type { Vector3 } from "../spatial/vector.ts";

/**
 * Where a move ends: joint angles, or the pose of a tool in a frame. Inside a pallet step, a frame with the name of its
 * pallet is the place being visited.
 */
export type Target =
  | { readonly q: readonly number[]; readonly tool?: string }
  | { readonly pose: Pose<"frame", "tcp">; readonly frame: string; readonly tool: string; readonly branch?: Branch };

/** ratio: of full joint speed, 0 … 1. mps: speed of the TCP. time_s: duration of the whole move. */
export type Speed = { readonly ratio: number } | { readonly mps: number } | { readonly time_s: number };

/** One line and what it is compared with: every controller can say this. */
export type Condition =
  | { readonly signal: string; readonly is: boolean }
  | { readonly signal: string; readonly above: number }
  | { readonly signal: string; readonly below: number };

/** What a step can wait for or decide by: one line, or an expression that is yes or no. */
export type Predicate = Condition | { readonly expression: Expression };

interface StepBase {
  readonly id: string;
  /** What a person calls it. */
  readonly name?: string;
  /** Steps of one traced edge share a group. */
  readonly group?: string;
}

/** A search or touch move: it ends where it is when the condition comes true. */
export interface Search {
  readonly when: Condition;
  /** What happens at the target when the condition never came true. */
  readonly missing: "continue" | "fault";
}

export interface MoveStep extends StepBase {
  readonly type: "move";
  readonly path: "ptp" | "lin" | "circ" | "spline";
  readonly target: Target;
  /** The point a circ passes through. */
  readonly via?: Target;
  readonly speed: Speed;
  /** Of the joint accelerations of the robot, more than 0 and up to 1; 1 when left out. */
  readonly acceleration?: { readonly ratio: number };
  /** 0 stops at the target; more lets the path leave it by that much. */
  readonly blend_m: number;
  /** The same as a share of the shorter half of both neighbouring paths, 0 … 1. At most one of the two is not 0. */
  readonly blend_ratio?: number;
  readonly until?: Search;
}
export interface WaitStep extends StepBase {
  readonly type: "wait";
  readonly s: number;
}
/** true closes (T-31). */
export interface GripperStep extends StepBase {
  readonly type: "gripper";
  readonly closed: boolean;
}
/**
 * Writes an output. With `pulse_s` a digital output goes back to the opposite after that time, while the program goes
 * on.
 */
export interface SetStep extends StepBase {
  readonly type: "set";
  readonly signal: string;
  readonly to: boolean | number;
  readonly pulse_s?: number;
}
/**
 * Rests until the condition is true. Longer than `timeout_s` stops the program with a message; with `late` those steps
 * are done instead, and the program goes on.
 */
export interface WaitForStep extends StepBase {
  readonly type: "wait-for";
  readonly when: Predicate;
  readonly timeout_s?: number;
  readonly late?: readonly Step[];
}
/** What the flange carries from here on, tool included. */
export interface PayloadStep extends StepBase {
  readonly type: "payload";
  readonly mass_kg: number;
  /** Centre of mass in the flange frame. */
  readonly center_m: Vector3;
  /** About the centre of mass, axes of the flange: Ixx, Iyy, Izz, Ixy, Ixz, Iyz [kg·m²]. */
  readonly inertia_kgm2?: readonly [number, number, number, number, number, number];
}
/** Says something to whoever stands at the robot; the program goes on. */
export interface MessageStep extends StepBase {
  readonly type: "message";
  readonly text: string;
}
/** Ends the program, from wherever it is. */
export interface StopStep extends StepBase {
  readonly type: "stop";
}
/** Says something to whoever reads the program. */
export interface CommentStep extends StepBase {
  readonly type: "comment";
  readonly text: string;
}
/** Gives a variable its value. Parameters of a routine keep theirs. */
export interface AssignStep extends StepBase {
  readonly type: "assign";
  readonly variable: string;
  readonly to: Expression;
}
export interface CallStep extends StepBase {
  readonly type: "call";
  readonly routine: string;
  /** A value for every parameter of the routine. */
  readonly arguments?: Readonly<Record<string, Expression>>;
}
export interface RepeatStep extends StepBase {
  readonly type: "repeat";
  readonly times: number | "forever";
  readonly steps: readonly Step[];
}
/** Goes round as long as the condition is true when it is looked at, before every round. */
export interface WhileStep extends StepBase {
  readonly type: "while";
  readonly when: Predicate;
  readonly steps: readonly Step[];
}
export interface IfStep extends StepBase {
  readonly type: "if";
  readonly when: Predicate;
  readonly then: readonly Step[];
  readonly else?: readonly Step[];
}
/** Does its steps once at every place of a pallet. */
export interface PalletStep extends StepBase {
  readonly type: "pallet";
  readonly pallet: string;
  readonly steps: readonly Step[];
}

/** What a robot executes: `unrolled` makes any program a sequence of these. */
export type PrimitiveStep =
  | MoveStep
  | WaitStep
  | GripperStep
  | SetStep
  | WaitForStep
  | PayloadStep
  | MessageStep
  | StopStep;
/** Steps that hold other steps. */
export type BlockStep = RepeatStep | WhileStep | IfStep | PalletStep;
/** Grows by new step types. */
export type Step = PrimitiveStep | AssignStep | CommentStep | CallStep | BlockStep;

export const STEP_TYPES = [
  "move",
  "wait",
  "gripper",
  "set",
  "wait-for",
  "payload",
  "message",
  "stop",
  "comment",
  "assign",
  "call",
  "repeat",
  "while",
  "if",
  "pallet",
] as const satisfies readonly Step["type"][];

/** How a group of steps came to be, so that it can be made again with other numbers. */
export interface Group {
  readonly name: string;
  readonly recipe?: Readonly<Record<string, unknown>>;
}

/** A line in or out of the controller. `address` is the controller's own number for it. */
export interface SignalLine {
  readonly kind: "digital-in" | "digital-out" | "analogue-in" | "analogue-out";
  readonly address?: number;
}

/** The vendor-neutral program. Frame "world" and tool "flange" always exist and need no entry. */
export interface Program {
  readonly format: "twincell.program";
  /** 2 where variables or expressions are used; what uses none is written as version 1, as it always was. */
  readonly version: 1 | 2;
  readonly name: string;
  /** Id of the robot it was taught on. */
  readonly robot: string;
  readonly tools: Readonly<Record<string, Pose<"flange", "tcp">>>;
  readonly frames: Readonly<Record<string, Pose<"world", "frame">>>;
  readonly groups: Readonly<Record<string, Group>>;
  readonly signals: Readonly<Record<string, SignalLine>>;
  /** What the program remembers; no name is that of a signal. */
  readonly variables?: Readonly<Record<string, Variable>>;
  /** Values that routines are given when they are called, by the routine's name. */
  readonly parameters?: Readonly<Record<string, Readonly<Record<string, ValueType>>>>;
  /** No name is also that of a frame. */
  readonly pallets: Readonly<Record<string, Pallet>>;
  /** Steps that `call` does; none calls itself, not even through others. */
  readonly routines: Readonly<Record<string, readonly Step[]>>;
  readonly steps: readonly Step[];
}

/** What a program file says of itself. */
export const PROGRAM_FORMAT = "twincell.program";
export const PROGRAM_VERSION = 2;

/** An empty program for that robot. */
export const emptyProgram = (robot: string, name = "Program"): Program => ({
  format: PROGRAM_FORMAT,
  version: 1,
  name,
  robot,
  tools: {},
  frames: {},
  groups: {},
  signals: {},
  pallets: {},
  routines: {},
  steps: [],
});
