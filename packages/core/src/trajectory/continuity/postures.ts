import { branchOf, type Branch } from "../../kinematics/branch.ts";
import { allBranches, solveAll, solverScratch } from "../../kinematics/inverse.ts";
import { isSingularConfiguration } from "../../kinematics/singularity.ts";
import { revolutionsInside } from "../../kinematics/turns.ts";
import { isInsideWorkspace } from "../../kinematics/workspace.ts";
import type { Robot } from "../../model/robot.ts";
import type { Pose } from "../../spatial/pose.ts";
import { NO_CODE } from "./pool.ts";

/** All postures of a pose inside the limits, one after another. */
export interface Configurations {
  readonly q: Float64Array;
  /** The same for postures that differ by whole turns. */
  readonly groups: readonly number[];
  readonly codes: readonly number[];
}

/** The branch as a small number, so that two can be compared at a glance. */
export const codeOf = (branch: Branch | undefined): number =>
  branch === undefined
    ? NO_CODE
    : (branch.shoulder === "back" ? 1 : 0) +
      (branch.elbow === "down" ? 2 : 0) +
      (branch.wrist === "negative" ? 4 : 0) +
      (branch.determinant === "negative" ? 8 : 0);

/**
 * Every posture of a pose: all branches, and of each all copies by whole turns of the joints that turn, inside limits
 * and workspace. An arm of seven joints keeps the elbow angle of `near`, or takes the nearest its limits allow.
 */
export class ConfigurationFinder {
  private readonly robot: Robot;
  private readonly scratch = solverScratch();
  /** What a program comes to again, in loops. Only where `near` has no say. */
  private readonly known = new Map<object, Configurations>();

  constructor(robot: Robot) {
    this.robot = robot;
  }

  /** @param key  the same for the same pose. */
  at(baseFromFlange: Pose<"base", "flange">, near: Float64Array, key?: object): Configurations {
    const seen = key === undefined ? undefined : this.known.get(key);
    if (seen !== undefined) return seen;
    const { robot } = this;
    const bases = this.bases(baseFromFlange, near);
    const n = robot.arm.joints.length;
    const groups: number[] = [];
    const codes: number[] = [];
    const found: Float64Array[] = [];
    for (let group = 0; group < bases.length; group++) {
      let code: number | undefined;
      for (const copy of revolutionsInside(robot, bases[group]!)) {
        if (!isInsideWorkspace(robot, copy)) break;
        code ??= codeOf(branchOf(robot, copy));
        found.push(copy);
        groups.push(group);
        codes.push(code);
      }
    }
    const q = new Float64Array(found.length * n);
    for (let k = 0; k < found.length; k++) q.set(found[k]!, k * n);
    const configurations = { q, groups, codes };
    if (
      key !== undefined &&
      robot.family.kind !== "spherical-seven" &&
      !bases.some(base => isSingularConfiguration(robot, base))
    )
      this.known.set(key, configurations);
    return configurations;
  }

  private bases(baseFromFlange: Pose<"base", "flange">, near: Float64Array): readonly Float64Array[] {
    const { robot, scratch } = this;
    const bases = allBranches(robot, baseFromFlange, near, scratch);
    if (robot.family.kind !== "spherical-seven" || bases.some(base => revolutionsInside(robot, base).length > 0))
      return bases;
    const reach = solveAll(robot, baseFromFlange, { near }, scratch);
    return reach.kind === "reached" ? reach.solutions.map(({ q_rad }) => q_rad) : [];
  }
}
