import { flangePose } from "../kinematics/forward.ts";
import type { Branch } from "../kinematics/branch.ts";
import type { MoveStep, Program, Target } from "../program/program.ts";
import type { Robot } from "../model/robot.ts";
import { compose, identity, inverse, type Pose } from "../spatial/pose.ts";

/** What targets of steps refer to. */
export interface PlanContext extends Pick<Program, "tools" | "frames"> {
  /** Where the robot stands in the cell; default: in its origin. */
  readonly worldFromBase?: Pose<"world", "base"> | undefined;
}

/** A move step with its frames and tool resolved to the robot's base. */
export interface Move {
  readonly step: MoveStep;
  readonly flangeFromTcp: Pose<"flange", "tcp">;
  readonly tcpFromFlange: Pose<"tcp", "flange">;
  readonly baseFromTcp: Pose<"base", "tcp">;
  readonly baseFromFlange: Pose<"base", "flange">;
  /** The posture itself, when the target was taught as joint angles. */
  readonly q_rad?: Float64Array;
  readonly branch?: Branch;
  /** The posture that was chosen for a pose because the nearest one does not lead on. */
  readonly chosen_rad?: Float64Array;
  readonly via?: Pose<"base", "tcp">;
}

/** A tool of that name; "flange" and names that do not exist are the flange itself. */
export const toolOf = (context: Pick<Program, "tools">, name: string | undefined): Pose<"flange", "tcp"> =>
  (name !== undefined && Object.hasOwn(context.tools, name) ? context.tools[name] : undefined) ?? identity();

const frameOf = (context: Pick<Program, "frames">, name: string): Pose<"world", "frame"> =>
  (Object.hasOwn(context.frames, name) ? context.frames[name] : undefined) ?? identity();

/** Pose of the TCP in the base that a target asks for. */
export function targetInBase(target: Target, robot: Robot, context: PlanContext): Pose<"base", "tcp"> {
  if ("q" in target) return compose(flangePose(robot.arm, target.q), toolOf(context, target.tool));
  const worldFromTcp = compose(frameOf(context, target.frame), target.pose);
  return context.worldFromBase === undefined
    ? (worldFromTcp as Pose as Pose<"base", "tcp">)
    : compose(inverse(context.worldFromBase), worldFromTcp);
}

/** Writes a TCP pose of the base back as a target of the same frame and tool. */
export function poseTarget(
  baseFromTcp: Pose<"base", "tcp">,
  like: Extract<Target, { pose: unknown }>,
  context: PlanContext,
): Extract<Target, { pose: unknown }> {
  const worldFromTcp = compose(context.worldFromBase ?? identity<"world", "base">(), baseFromTcp);
  return { ...like, pose: compose(inverse(frameOf(context, like.frame)), worldFromTcp) };
}

export function resolveMove(step: MoveStep, robot: Robot, context: PlanContext): Move {
  const flangeFromTcp = toolOf(context, step.target.tool);
  const tcpFromFlange = inverse(flangeFromTcp);
  const baseFromTcp = targetInBase(step.target, robot, context);
  return {
    step,
    flangeFromTcp,
    tcpFromFlange,
    baseFromTcp,
    baseFromFlange: compose(baseFromTcp, tcpFromFlange),
    ...("q" in step.target ? { q_rad: Float64Array.from(step.target.q) } : {}),
    ...("q" in step.target || step.target.branch === undefined ? {} : { branch: step.target.branch }),
    ...(step.via === undefined ? {} : { via: targetInBase(step.via, robot, context) }),
  };
}

/** Whether the path may leave the target of a move. */
export const blends = (step: MoveStep): boolean => step.blend_m > 0 || (step.blend_ratio ?? 0) > 0;

/** Whether the robot goes from one move into the next without stopping. A search ends where it stops. */
export const passes = (step: MoveStep, next: MoveStep): boolean =>
  step.until === undefined && (blends(step) || (step.path === "spline" && next.path === "spline"));
