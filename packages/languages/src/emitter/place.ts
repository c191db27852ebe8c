import {
  compose,
  degrees,
  distance,
  explainReach,
  flangeOfTcp,
  flangePose,
  identity,
  inverse,
  palletSlots,
  solveAll,
  type MoveStep,
  type Pose,
  type Program,
  type Robot,
  type Step,
  type Target,
} from "@twincell/core";
import { UnsupportedStep, called } from "./cannot.ts";

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
    const name = called(step);
    if ("q" in target) {
      if (target.q.length !== robot.arm.joints.length) {
        throw new UnsupportedStep(
          step.id,
          `${name} holds ${target.q.length} joint angles; the ${robot.name} has ${robot.arm.joints.length} joints.`,
          "Teach the step again on this robot.",
        );
      }
      this.insideLimits(step, target.q);
      return target.q;
    }
    const reach = solveAll(
      robot,
      flangeOfTcp(this.worldFromBase, compose(this.worldFromBase, this.tip(target)), this.tool(target.tool)),
      {
        ...(near === undefined ? {} : { near }),
        ...(target.branch === undefined ? {} : { branch: target.branch }),
      },
    );
    if (reach.kind === "no-solver") return undefined;
    if (reach.kind !== "reached")
      throw new UnsupportedStep(
        step.id,
        `${name} cannot be reached. ${explainReach(reach)}`,
        "Check the program: it says what would bring the step into reach.",
      );
    return [...reach.solutions[0]!.q_rad];
  }

  private insideLimits(step: Pick<Step, "id" | "name">, q: readonly number[]): void {
    for (const [
      i,
      {
        limits: { lower_rad, upper_rad },
      },
    ] of this.robot.arm.joints.entries()) {
      if (q[i]! >= lower_rad - LIMIT_SLACK_RAD && q[i]! <= upper_rad + LIMIT_SLACK_RAD) continue;
      throw new UnsupportedStep(
        step.id,
        `${called(step)} turns joint ${i + 1} to ${degrees(q[i]!).toFixed(2)}°; it may turn from ${degrees(lower_rad).toFixed(1)}° to ${degrees(upper_rad).toFixed(1)}°.`,
        "Move the point, or choose another branch for it.",
      );
    }
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
const LIMIT_SLACK_RAD = 1e-9;
