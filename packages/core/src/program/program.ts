import type { Branch } from "../kinematics/branch.ts";
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

/** What a step can wait for or decide by. There is no expression language on purpose: every controller can say this. */
export type Condition =
  | { readonly signal: string; readonly is: boolean }
  | { readonly signal: string; readonly above: number }
  | { readonly signal: string; readonly below: number };

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
/** Rests until the condition is true; longer than `timeout_s` stops the program with a message. */
export interface WaitForStep extends StepBase {
  readonly type: "wait-for";
  readonly when: Condition;
  readonly timeout_s?: number;
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
export interface CallStep extends StepBase {
  readonly type: "call";
  readonly routine: string;
}
export interface RepeatStep extends StepBase {
  readonly type: "repeat";
  readonly times: number | "forever";
  readonly steps: readonly Step[];
}
export interface IfStep extends StepBase {
  readonly type: "if";
  readonly when: Condition;
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
export type BlockStep = RepeatStep | IfStep | PalletStep;
/** Grows by new step types. */
export type Step = PrimitiveStep | CommentStep | CallStep | BlockStep;

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
  "call",
  "repeat",
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
  readonly version: 1;
  readonly name: string;
  /** Id of the robot it was taught on. */
  readonly robot: string;
  readonly tools: Readonly<Record<string, Pose<"flange", "tcp">>>;
  readonly frames: Readonly<Record<string, Pose<"world", "frame">>>;
  readonly groups: Readonly<Record<string, Group>>;
  readonly signals: Readonly<Record<string, SignalLine>>;
  /** No name is also that of a frame. */
  readonly pallets: Readonly<Record<string, Pallet>>;
  /** Steps that `call` does; none calls itself, not even through others. */
  readonly routines: Readonly<Record<string, readonly Step[]>>;
  readonly steps: readonly Step[];
}

/** What a program file says of itself. */
export const PROGRAM_FORMAT = "twincell.program";
export const PROGRAM_VERSION = 1;

/** An empty program for that robot. */
export const emptyProgram = (robot: string, name = "Program"): Program => ({
  format: PROGRAM_FORMAT,
  version: PROGRAM_VERSION,
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
