import {
  branchOf, compose, degrees, explainReach, flangeOfTcp, flangePose, identity, inverse, palletPlaces, solveAll, type MoveStep, type Pose, type Program, type Robot, type Step, type Target,
} from "@twincell/core";
import { axisValues } from "./location.ts";
import { statusOf, turnOf } from "./status.ts";
import type { AxisConvention } from "../robots.ts";

/** What Status and Turn of a point are; undefined where they differ from one visit to the next. */
export interface Posture { readonly status: number | undefined; readonly turn: number | undefined }
/** By step id. */
export type PostureMap = ReadonlyMap<string, Posture>;
export type Postures =
  | { readonly kind: "postures"; readonly of: PostureMap }
  | { readonly kind: "cannot"; readonly step: string; readonly sentence: string; readonly hint: string };

const LIMIT_SLACK_RAD = 1e-9;
/** A pallet is looked at at every place up to this many. */
const MOST_PLACES = 400;

/** Where a program counts from: the world of the cell, seen from $WORLD of the controller. */
export class Place {
  readonly program: Program;
  readonly robot: Robot;
  readonly worldFromBase: Pose<"world", "base">;
  readonly rootFromWorld: Pose<"root", "world">;
  /** Where the place of a pallet is that is being visited. */
  readonly visited = new Map<string, Pose<"world", "frame">>();

  constructor(program: Program, robot: Robot, worldFromBase: Pose<"world", "base">) {
    this.program = program;
    this.robot = robot;
    this.worldFromBase = worldFromBase;
    this.rootFromWorld = inverse(compose(worldFromBase, robot.baseFromVendorWorld as Pose as Pose<"base", "root">));
  }

  tool(name: string): Pose<"flange", "tcp"> {
    const { tools } = this.program;
    return Object.hasOwn(tools, name) ? tools[name]! : identity();
  }

  worldFromFrame(name: string): Pose<"world", "frame"> {
    const { frames } = this.program;
    return this.visited.get(name) ?? (Object.hasOwn(frames, name) ? frames[name]! : identity());
  }

  /** Pose of the tool in the world. */
  worldFromTarget(target: Target, tool: string): Pose<"world", "tcp"> {
    if ("q" in target) return compose(compose(this.worldFromBase, flangePose(this.robot.arm, target.q)), this.tool(tool));
    return compose(this.worldFromFrame(target.frame), target.pose);
  }
}

/**
 * Status and Turn of every taught point, by step id: of the joint angles that were taught, or of those that reach the pose
 * with least travel from the point before, in the order of execution. Stops at the first point that cannot be reached or
 * lies outside the limits.
 */
export function posturesOf(place: Place, convention: AxisConvention): Postures {
  const walk = new Walk(place, convention);
  const flaw = walk.steps(place.program.steps);
  return flaw ?? { kind: "postures", of: walk.found };
}

type Flaw = Extract<Postures, { kind: "cannot" }>;

class Walk {
  readonly found = new Map<string, Posture>();
  private readonly place: Place;
  private readonly convention: AxisConvention;
  private near: ArrayLike<number>;

  constructor(place: Place, convention: AxisConvention) {
    this.place = place;
    this.convention = convention;
    this.near = place.robot.home_rad;
  }

  steps(steps: readonly Step[]): Flaw | undefined {
    for (const step of steps) {
      const flaw = this.step(step);
      if (flaw !== undefined) return flaw;
    }
    return undefined;
  }

  private step(step: Step): Flaw | undefined {
    const { routines, pallets } = this.place.program;
    switch (step.type) {
      case "move": return this.move(step);
      // The second round begins where the first one ends.
      case "repeat": return this.steps(step.steps) ?? (step.times === 1 ? undefined : this.steps(step.steps));
      case "if": return this.steps(step.then) ?? this.steps(step.else ?? []);
      case "call": return this.steps(Object.hasOwn(routines, step.routine) ? routines[step.routine]! : []);
      case "pallet": {
        const pallet = Object.hasOwn(pallets, step.pallet) ? pallets[step.pallet] : undefined;
        if (pallet === undefined) return undefined;
        for (const place of palletPlaces(pallet).slice(0, MOST_PLACES)) {
          this.place.visited.set(step.pallet, compose(this.place.worldFromFrame(pallet.frame), place) as Pose as Pose<"world", "frame">);
          const flaw = this.steps(step.steps);
          if (flaw !== undefined) return flaw;
        }
        this.place.visited.delete(step.pallet);
        return undefined;
      }
      default: return undefined;
    }
  }

  private move({ id, name, path, target }: MoveStep): Flaw | undefined {
    const { robot, worldFromBase } = this.place, called = `Step ${name ?? id}`, { joints } = robot.arm;
    if ("q" in target) {
      if (target.q.length !== joints.length) {
        return { kind: "cannot", step: id, sentence: `${called} holds ${target.q.length} joint angles; the ${robot.name} has ${joints.length} joints.`, hint: "Teach the step again on this robot." };
      }
    }
    if ("q" in target && path === "ptp") this.near = target.q;
    else {
      // Along a path the axes arrive in the turn that is nearest, whatever angles were taught.
      const baseFromFlange = "q" in target ? flangePose(robot.arm, target.q) : flangeOfTcp(worldFromBase, this.place.worldFromTarget(target, target.tool), this.place.tool(target.tool));
      const branch = "q" in target ? branchOf(robot, target.q) : target.branch;
      const reach = solveAll(robot, baseFromFlange, branch === undefined ? { near: this.near } : { near: this.near, branch });
      if (reach.kind !== "reached") {
        return { kind: "cannot", step: id, sentence: `${called} cannot be reached. ${explainReach(reach)}`, hint: "Check the program: it says what would bring the step into reach." };
      }
      this.near = reach.solutions[0]!.q_rad;
    }
    const { near } = this;
    const i = joints.findIndex(({ limits }, k) => !(near[k]! >= limits.lower_rad - LIMIT_SLACK_RAD && near[k]! <= limits.upper_rad + LIMIT_SLACK_RAD));
    if (i >= 0) {
      const { lower_rad, upper_rad } = joints[i]!.limits;
      return {
        kind: "cannot", step: id,
        sentence: `${called} turns axis ${i + 1} to ${degrees(near[i]!).toFixed(2)}°; it may turn from ${degrees(lower_rad).toFixed(1)}° to ${degrees(upper_rad).toFixed(1)}°.`,
        hint: "Move the point, or choose another branch for it.",
      };
    }
    this.note(id, branchOf(robot, near), turnOf(axisValues(near, this.convention)));
    return undefined;
  }

  private note(id: string, branch: ReturnType<typeof branchOf>, turn: number): void {
    const status = branch === undefined ? 0 : statusOf(branch), before = this.found.get(id);
    if (before === undefined) this.found.set(id, { status, turn });
    else if (before.turn !== turn || before.status !== status) this.found.set(id, { status: before.status === status ? status : undefined, turn: undefined });
  }
}
