import type { Branch } from "../kinematics/branch.ts";
import type { Pose } from "../spatial/pose.ts";

/** Where a move ends: joint angles, or the pose of a tool in a frame. */
export type Target =
  | { readonly q: readonly number[]; readonly tool?: string }
  | { readonly pose: Pose<"frame", "tcp">; readonly frame: string; readonly tool: string; readonly branch?: Branch };

/** ratio: of full joint speed, 0 … 1. mps: speed of the TCP. time_s: duration of the whole move. */
export type Speed = { readonly ratio: number } | { readonly mps: number } | { readonly time_s: number };

interface StepBase {
  readonly id: string;
  /** What a person calls it. */
  readonly name?: string;
  /** Steps of one traced edge share a group. */
  readonly group?: string;
}

export interface MoveStep extends StepBase {
  readonly type: "move";
  readonly path: "ptp" | "lin" | "circ" | "spline";
  readonly target: Target;
  /** The point a circ passes through. */
  readonly via?: Target;
  readonly speed: Speed;
  /** 0 stops at the target; more lets the path leave it by that much. */
  readonly blend_m: number;
}
export interface WaitStep extends StepBase { readonly type: "wait"; readonly s: number }
export interface GripperStep extends StepBase { readonly type: "gripper"; readonly closed: boolean }

/** Grows by new step types. */
export type Step = MoveStep | WaitStep | GripperStep;

/** How a group of steps came to be, so that it can be made again with other numbers. */
export interface Group { readonly name: string; readonly recipe?: Readonly<Record<string, unknown>> }

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
  readonly steps: readonly Step[];
}

/** What a program file says of itself. */
export const PROGRAM_FORMAT = "twincell.program";
export const PROGRAM_VERSION = 1;

/** An empty program for that robot. */
export const emptyProgram = (robot: string, name = "Program"): Program => ({
  format: PROGRAM_FORMAT, version: PROGRAM_VERSION, name, robot, tools: {}, frames: {}, groups: {}, steps: [],
});
