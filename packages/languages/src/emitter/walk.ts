import {
  branchOf,
  compose,
  degrees,
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
import { called, type Cannot } from "./cannot.ts";

const LIMIT_SLACK_RAD = 1e-9;
/** A pallet is looked at at every place up to this many. */
const MOST_PLACES = 400;

/**
 * Where a program counts from while it is walked through: the world of the cell, seen from the world of the controller.
 */
export class WalkedPlace {
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

  /** Pose of the tool in the world. */
  worldFromTarget(target: Target, tool: string): Pose<"world", "tcp"> {
    if ("q" in target)
      return compose(compose(this.worldFromBase, flangePose(this.robot.arm, target.q)), this.tool(tool));
    return compose(this.worldFromFrame(target.frame), target.pose);
  }
}

/** Where the arm may be before a step: behind a decision that is more than one posture. */
type Starts = readonly ArrayLike<number>[];
/** More starts than these are not told apart. */
const MOST_STARTS = 8;
/** Postures that are closer than this are one [rad]. */
const SAME_RAD = 1e-6;

/**
 * Shows every move of a program in the order of execution: loops twice, since the second round begins where the first
 * one ends, pallets place by place, what follows a decision from both its ends, and routines that nobody calls behind
 * everything else.
 *
 * @param visit  the posture that a move ends in when the arm starts from `near`, or what is wrong with it; the walk
 *   ends there.
 */
export function walkMoves(
  place: WalkedPlace,
  visit: (
    step: MoveStep,
    near: ArrayLike<number>,
  ) => { readonly kind: "reached"; readonly q_rad: ArrayLike<number> } | Cannot,
): Cannot | undefined {
  const { program, robot } = place;
  const { routines, pallets } = program;
  const walked = new Set<string>();
  let starts: Starts = [robot.home_rad];
  const routine = (name: string): Cannot | undefined => {
    walked.add(name);
    return walk(Object.hasOwn(routines, name) ? routines[name]! : []);
  };
  const walk = (steps: readonly Step[]): Cannot | undefined => {
    for (const step of steps) {
      const flaw = one(step);
      if (flaw !== undefined) return flaw;
    }
    return undefined;
  };
  const move = (step: MoveStep): Cannot | undefined => {
    const ends: ArrayLike<number>[] = [];
    for (const near of starts) {
      const answer = visit(step, near);
      if (answer.kind === "cannot") return answer;
      ends.push(answer.q_rad);
    }
    starts = distinct(ends);
    return undefined;
  };
  const one = (step: Step): Cannot | undefined => {
    switch (step.type) {
      case "move":
        return move(step);
      case "repeat":
        return walk(step.steps) ?? (step.times === 1 ? undefined : walk(step.steps));
      case "while": {
        // None, one or more rounds.
        const before = starts;
        const flaw = walk(step.steps) ?? walk(step.steps);
        starts = distinct([...before, ...starts]);
        return flaw;
      }
      case "if": {
        const before = starts;
        const flaw = walk(step.then);
        const then = starts;
        starts = before;
        const other = flaw ?? walk(step.else ?? []);
        starts = distinct([...then, ...starts]);
        return other;
      }
      case "call":
        return routine(step.routine);
      case "pallet": {
        const pallet = Object.hasOwn(pallets, step.pallet) ? pallets[step.pallet] : undefined;
        if (pallet === undefined) return undefined;
        for (const each of palletSlots(pallet).slice(0, MOST_PLACES)) {
          place.visited.set(
            step.pallet,
            compose(place.worldFromFrame(pallet.frame), each) as Pose as Pose<"world", "frame">,
          );
          const flaw = walk(step.steps);
          if (flaw !== undefined) return flaw;
        }
        place.visited.delete(step.pallet);
        return undefined;
      }
      default:
        return undefined;
    }
  };
  return (
    walk(program.steps) ??
    Object.keys(routines).reduce<Cannot | undefined>(
      (flaw, name) => flaw ?? (walked.has(name) ? undefined : routine(name)),
      undefined,
    )
  );
}

function distinct(starts: Starts): Starts {
  const found: ArrayLike<number>[] = [];
  for (const start of starts) {
    if (
      found.length < MOST_STARTS &&
      !found.some(other => Array.from(other).every((angle, i) => Math.abs(angle - start[i]!) < SAME_RAD))
    )
      found.push(start);
  }
  return found;
}

/**
 * The joint angles in which a target of a step is reached from `near`: those that were taught on a joint move,
 * otherwise those of least travel.
 */
export function reached(
  place: WalkedPlace,
  step: MoveStep,
  target: Target,
  near: ArrayLike<number>,
): { readonly kind: "reached"; readonly q_rad: ArrayLike<number> } | Cannot {
  const { robot, worldFromBase } = place;
  const count = robot.arm.joints.length;
  if ("q" in target && target.q.length !== count) {
    return {
      kind: "cannot",
      step: step.id,
      sentence: `${called(step)} holds ${target.q.length} joint angles; the ${robot.name} has ${count} joints.`,
      hint: "Teach the step again on this robot.",
    };
  }
  if ("q" in target && step.path === "ptp") return { kind: "reached", q_rad: target.q };
  // Along a path the axes arrive in the turn that is nearest, whatever angles were taught.
  const baseFromFlange =
    "q" in target
      ? flangePose(robot.arm, target.q)
      : flangeOfTcp(worldFromBase, place.worldFromTarget(target, target.tool), place.tool(target.tool));
  const branch = "q" in target ? branchOf(robot, target.q) : target.branch;
  const reach = solveAll(robot, baseFromFlange, branch === undefined ? { near } : { near, branch });
  if (reach.kind === "reached") return { kind: "reached", q_rad: reach.solutions[0]!.q_rad };
  return {
    kind: "cannot",
    step: step.id,
    sentence: `${called(step)} cannot be reached. ${explainReach(reach)}`,
    hint: "Check the program: it says what would bring the step into reach.",
  };
}

/** @param axisName  what the controller calls its axes, counted from 0. */
export function outsideLimits(
  { robot }: WalkedPlace,
  step: MoveStep,
  q_rad: ArrayLike<number>,
  axisName: (axis: number) => string,
): Cannot | undefined {
  const { joints } = robot.arm;
  const i = joints.findIndex(
    ({ limits }, k) =>
      !(q_rad[k]! >= limits.lower_rad - LIMIT_SLACK_RAD && q_rad[k]! <= limits.upper_rad + LIMIT_SLACK_RAD),
  );
  if (i < 0) return undefined;
  const { lower_rad, upper_rad } = joints[i]!.limits;
  return {
    kind: "cannot",
    step: step.id,
    sentence: `${called(step)} turns axis ${axisName(i)} to ${degrees(q_rad[i]!).toFixed(2)}°; it may turn from ${degrees(lower_rad).toFixed(1)}° to ${degrees(upper_rad).toFixed(1)}°.`,
    hint: "Move the point, or choose another branch for it.",
  };
}
