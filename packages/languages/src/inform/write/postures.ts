import {
  branchOf, compose, degrees, explainReach, flangeOfTcp, flangePose, identity, inverse, palletPlaces, solveAll, type MoveStep, type Pose, type Program, type Robot, type Step, type Target,
} from "@twincell/core";

/** The joint angles in which a point is reached first, and the point on the way to it. */
export interface Posture { readonly q_rad: ArrayLike<number>; readonly via_rad: ArrayLike<number> | undefined }
/** By step id. */
export type PostureMap = ReadonlyMap<string, Posture>;
export interface Flaw { readonly kind: "cannot"; readonly step: string; readonly sentence: string; readonly hint: string }
export type Postures = { readonly kind: "postures"; readonly of: PostureMap } | Flaw;

const LIMIT_SLACK_RAD = 1e-9;
/** A pallet is looked at at every place up to this many. */
const MOST_PLACES = 400;

/** Where a program counts from: the world of the cell, seen from the robot coordinates of the controller. */
export class Place {
  readonly program: Program;
  readonly robot: Robot;
  readonly worldFromBase: Pose<"world", "base">;
  readonly vendorFromWorld: Pose<"vendor-world", "world">;
  /** Where the place of a pallet is that is being visited. */
  readonly visited = new Map<string, Pose<"world", "frame">>();

  constructor(program: Program, robot: Robot, worldFromBase: Pose<"world", "base">) {
    this.program = program;
    this.robot = robot;
    this.worldFromBase = worldFromBase;
    this.vendorFromWorld = inverse(compose(worldFromBase, robot.baseFromVendorWorld));
  }

  tool(name: string): Pose<"flange", "tcp"> {
    const { tools } = this.program;
    return Object.hasOwn(tools, name) ? tools[name]! : identity();
  }

  worldFromFrame(name: string): Pose<"world", "frame"> {
    const { frames } = this.program;
    return this.visited.get(name) ?? (Object.hasOwn(frames, name) ? frames[name]! : identity());
  }

  worldFromTarget(target: Target, tool: string): Pose<"world", "tcp"> {
    if ("q" in target) return compose(compose(this.worldFromBase, flangePose(this.robot.arm, target.q)), this.tool(tool));
    return compose(this.worldFromFrame(target.frame), target.pose);
  }
}

/**
 * The joint angles of every taught point, by step id: those that were taught, or the ones that reach the pose with least
 * travel from the point before, in the order of execution. Stops at the first point that cannot be reached or lies outside
 * the limits.
 *
 * @param inPulses  points on the way of arcs are written as joint angles too, so they must be reached.
 */
export function posturesOf(place: Place, inPulses: boolean): Postures {
  const walk = new Walk(place, inPulses);
  return walk.steps(place.program.steps) ?? { kind: "postures", of: walk.found };
}

class Walk {
  readonly found = new Map<string, Posture>();
  private readonly place: Place;
  private near: ArrayLike<number>;

  private readonly inPulses: boolean;

  constructor(place: Place, inPulses: boolean) {
    this.inPulses = inPulses;
    this.place = place;
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
      case "repeat": return this.steps(step.steps) ?? (step.times === 1 ? undefined : this.steps(step.steps));
      case "if": return this.steps(step.then) ?? this.steps(step.else ?? []);
      case "call": return this.steps(Object.hasOwn(routines, step.routine) ? routines[step.routine]! : []);
      case "pallet": {
        const pallet = Object.hasOwn(pallets, step.pallet) ? pallets[step.pallet] : undefined;
        if (pallet === undefined) return undefined;
        for (const each of palletPlaces(pallet).slice(0, MOST_PLACES)) {
          this.place.visited.set(step.pallet, compose(this.place.worldFromFrame(pallet.frame), each) as Pose as Pose<"world", "frame">);
          const flaw = this.steps(step.steps);
          if (flaw !== undefined) return flaw;
        }
        this.place.visited.delete(step.pallet);
        return undefined;
      }
      default: return undefined;
    }
  }

  private move(step: MoveStep): Flaw | undefined {
    const { robot } = this.place, from_rad = this.near, via = step.via === undefined || !this.inPulses ? undefined : this.reach(step, { ...step.via, tool: step.target.tool ?? "flange" }, from_rad);
    if (via !== undefined && "kind" in via) return via;
    const reached = this.reach(step, step.target, from_rad);
    if ("kind" in reached) return reached;
    const { joints } = robot.arm, i = joints.findIndex(({ limits }, k) => !(reached.q_rad[k]! >= limits.lower_rad - LIMIT_SLACK_RAD && reached.q_rad[k]! <= limits.upper_rad + LIMIT_SLACK_RAD));
    if (i >= 0) {
      const { lower_rad, upper_rad } = joints[i]!.limits;
      return {
        kind: "cannot", step: step.id,
        sentence: `Step ${step.name ?? step.id} turns axis ${"SLURBT"[i] ?? i + 1} to ${degrees(reached.q_rad[i]!).toFixed(2)}°; it may turn from ${degrees(lower_rad).toFixed(1)}° to ${degrees(upper_rad).toFixed(1)}°.`,
        hint: "Move the point, or choose another branch for it.",
      };
    }
    this.near = reached.q_rad;
    if (!this.found.has(step.id)) this.found.set(step.id, { q_rad: reached.q_rad, via_rad: via?.q_rad });
    return undefined;
  }

  private reach({ id, name, path }: MoveStep, target: Target, near: ArrayLike<number>): { readonly q_rad: ArrayLike<number> } | Flaw {
    const { robot, worldFromBase } = this.place, called = `Step ${name ?? id}`, count = robot.arm.joints.length;
    if ("q" in target && target.q.length !== count) {
      return { kind: "cannot", step: id, sentence: `${called} holds ${target.q.length} joint angles; the ${robot.name} has ${count} joints.`, hint: "Teach the step again on this robot." };
    }
    if ("q" in target && path === "ptp") return { q_rad: target.q };
    // Along a path the axes arrive in the turn that is nearest, whatever angles were taught.
    const baseFromFlange = "q" in target ? flangePose(robot.arm, target.q) : flangeOfTcp(worldFromBase, this.place.worldFromTarget(target, target.tool), this.place.tool(target.tool));
    const branch = "q" in target ? branchOf(robot, target.q) : target.branch, reach = solveAll(robot, baseFromFlange, branch === undefined ? { near } : { near, branch });
    if (reach.kind === "reached") return { q_rad: reach.solutions[0]!.q_rad };
    return { kind: "cannot", step: id, sentence: `${called} cannot be reached. ${explainReach(reach)}`, hint: "Check the program: it says what would bring the step into reach." };
  }
}
