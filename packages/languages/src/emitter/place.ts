import {
  branchOf,
  compose,
  distance,
  flangeOfTcp,
  flangePose,
  identity,
  inverse,
  palletSlots,
  type MoveStep,
  type Pose,
  type Program,
  type Robot,
  type Step,
  type Target,
} from "@twincell/core";
import { UnsupportedStep, type Cannot } from "./cannot.ts";
import { flangeReached, numberedJoint, otherArm, outsideLimits } from "./posture.ts";

export type PoseTarget = Extract<Target, { readonly pose: unknown }>;

/** A program in its cell: where its targets are, and which postures reach them. */
export class Place {
  readonly program: Program;
  readonly robot: Robot;
  readonly worldFromBase: Pose<"world", "base">;
  readonly baseFromWorld: Pose<"base", "world">;

  constructor(program: Program, robot: Robot, worldFromBase: Pose<"world", "base">) {
    this.program = program;
    this.robot = robot;
    this.worldFromBase = worldFromBase;
    this.baseFromWorld = inverse(worldFromBase);
  }

  tool(name: string | undefined): Pose<"flange", "tcp"> {
    const { tools } = this.program;
    return name !== undefined && Object.hasOwn(tools, name) ? tools[name]! : identity();
  }

  frame(name: string): Pose<"world", "frame"> {
    const { frames, pallets } = this.program;
    if (Object.hasOwn(pallets, name)) {
      const { frame, origin } = pallets[name]!;
      const first: Pose<"frame", "place"> = palletSlots(pallets[name]!)[0] ?? origin;
      return compose(compose(this.frame(frame), first), identity<"place", "frame">());
    }
    return Object.hasOwn(frames, name) ? frames[name]! : identity();
  }

  /** The tool tip in the base that a target asks for; at a pallet that of its first place. */
  tip(target: Target): Pose<"base", "tcp"> {
    if ("q" in target) return compose(flangePose(this.robot.arm, target.q), this.tool(target.tool));
    return compose(this.baseFromWorld, compose(this.frame(target.frame), target.pose));
  }

  /** The world of the controller as it sees a frame of the program: the world itself, or the frame. */
  vendorFromFrame(name: string): Pose<"frame", "frame"> {
    if (name !== "world") return identity();
    const vendorFromBase = inverse(this.robot.baseFromVendorWorld as Pose as Pose<"base", "base">);
    return compose(
      compose(identity<"frame", "base">(), compose(vendorFromBase, this.baseFromWorld)),
      identity<"world", "frame">(),
    );
  }

  /** Off a joint move only the tool's pose is written: of taught angles the posture is kept. */
  asPose(target: Target): Target {
    const branch = "q" in target ? branchOf(this.robot, target.q) : undefined;
    if (!("q" in target) || branch === undefined) return target;
    return {
      pose: compose(compose(identity<"frame", "world">(), this.worldFromBase), this.tip(target)),
      frame: "world",
      tool: target.tool ?? "flange",
      branch,
    };
  }

  /** The pose of a target in a frame that is not its own. */
  seenIn(frame: string, { pose, frame: own }: PoseTarget): Pose<"frame", "tcp"> {
    return compose(inverse(this.frame(frame)), compose(this.frame(own), pose)) as Pose as Pose<"frame", "tcp">;
  }

  /**
   * The joint angles of a target: those that were taught, or the ones that reach the pose with least travel from
   * `near`. Undefined for an arm without a solver.
   *
   * @throws {UnsupportedStep} when the target is out of reach, or outside the limits of a joint.
   */
  posture(
    step: Pick<Step, "id" | "name">,
    target: Target,
    near: readonly number[] | undefined,
  ): readonly number[] | undefined {
    const { robot } = this;
    if ("q" in target) {
      refuse(otherArm(robot, step, target.q) ?? outsideLimits(robot, step, target.q, numberedJoint));
      return target.q;
    }
    const baseFromFlange = flangeOfTcp(
      this.worldFromBase,
      compose(this.worldFromBase, this.tip(target)),
      this.tool(target.tool),
    );
    const reach = flangeReached(robot, step, baseFromFlange, near, target.branch);
    if (reach.kind === "no-solver") return undefined;
    if (reach.kind === "cannot") return refuse(reach);
    return Array.from(reach.q_rad);
  }

  /**
   * The radius at which a step is passed: given in metres, or as a share of the shorter half of both neighbouring
   * paths.
   */
  blend_m(step: MoveStep, before: MoveStep | undefined, next: Step | undefined): number {
    const { blend_ratio: ratio = 0 } = step;
    if (next?.type !== "move") return 0;
    if (!(ratio > 0)) return step.blend_m;
    const here = this.tip(step.target).position;
    const from = before === undefined ? undefined : this.tip(before.target).position;
    const ways = [
      distance(here, this.tip(next.target).position),
      ...(from === undefined ? [] : [distance(here, from)]),
    ];
    return (ratio * Math.min(...ways)) / 2;
  }
}

function refuse(answer: Cannot): never;
function refuse(answer: Cannot | undefined): undefined;
function refuse(answer: Cannot | undefined): undefined {
  if (answer !== undefined) throw new UnsupportedStep(answer.step, answer.sentence, answer.hint);
}
