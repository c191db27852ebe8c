import {
  branchOf,
  compose,
  distance,
  flangeOfTcp,
  flangePose,
  identity,
  inverse,
  isPassedOver,
  palletSlots,
  type MoveStep,
  type Pose,
  type Program,
  type Robot,
  type Step,
  type Target,
} from "@twincell/core";
import type { Cannot } from "./cannot.ts";
import { flangeReached, otherArm, type Reached } from "./posture.ts";

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
  visit: (step: MoveStep, near: ArrayLike<number>) => Reached | Cannot,
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
export function reached(place: WalkedPlace, step: MoveStep, target: Target, near: ArrayLike<number>): Reached | Cannot {
  const { robot, worldFromBase } = place;
  const other = "q" in target ? otherArm(robot, step, target.q) : undefined;
  if (other !== undefined) return other;
  if ("q" in target && step.path === "ptp") return { kind: "reached", q_rad: target.q };
  // Along a path the axes arrive in the turn that is nearest, whatever angles were taught.
  const baseFromFlange =
    "q" in target
      ? flangePose(robot.arm, target.q)
      : flangeOfTcp(worldFromBase, place.worldFromTarget(target, target.tool), place.tool(target.tool));
  const branch = "q" in target ? branchOf(robot, target.q) : target.branch;
  const reach = flangeReached(robot, step, baseFromFlange, near, branch);
  return reach.kind === "no-solver" ? reach.answer : reach;
}

/**
 * Whether the robot goes from a motion into what follows without a stop.
 *
 * @param isMain  whether nothing follows the end of the list.
 */
export function goesOn(place: WalkedPlace, next: Step | undefined, isMain: boolean): boolean {
  const into = (steps: readonly Step[] | undefined): boolean =>
    goesOn(
      place,
      steps?.find(each => !isPassedOver(each)),
      isMain,
    );
  switch (next?.type) {
    case undefined:
      return !isMain;
    case "move":
      return true;
    case "repeat":
    case "pallet":
      return into(next.steps);
    case "call":
      return into(place.program.routines[next.routine]);
    default:
      return false;
  }
}

/**
 * Where the corner of a path begins [m]. A share is turned into a distance by the chords to the points before and
 * behind.
 */
export function corner_m(place: WalkedPlace, step: MoveStep, before: Step | undefined, next: Step | undefined): number {
  const { blend_m, blend_ratio = 0 } = step;
  if (!(blend_ratio > 0)) return blend_m;
  const at = (each: MoveStep) => place.worldFromTarget(each.target, each.target.tool ?? "flange").position;
  const chords: number[] = [];
  if (before?.type === "move") chords.push(distance(at(before), at(step)));
  if (next?.type === "move") chords.push(distance(at(step), at(next)));
  return chords.length === 0 ? 0 : (blend_ratio * Math.min(...chords)) / 2;
}
