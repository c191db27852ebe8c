import { branchOf, type MoveStep, type VendorSection, wristAboveZero } from "@twincell/core";
import { outsideLimits, reached, walkMoves, type Cannot, type WalkedPlace, shownAxes } from "../../emitter/index.ts";
import { statusOf, turnOf } from "./status.ts";

/** What Status and Turn of a point are; undefined where they differ from one visit to the next. */
export interface Posture {
  readonly status: number | undefined;
  readonly turn: number | undefined;
}
/** By step id. */
export type ConfigurationMap = ReadonlyMap<string, Posture>;
export type Configurations = { readonly kind: "postures"; readonly of: ConfigurationMap } | Cannot;

/**
 * Status and Turn of every taught point, by step id: of the joint angles that were taught, or of those that reach the
 * pose with least travel from the point before, in the order of execution. Stops at the first point that cannot be
 * reached or lies outside the limits.
 */
export function configurationsOf(place: WalkedPlace, convention: VendorSection): Configurations {
  const found = new Map<string, Posture>();
  const { robot } = place;
  const flaw = walkMoves(place, (step: MoveStep, near) => {
    const { id, target } = step;
    const answer = reached(place, step, target, near);
    if (answer.kind === "cannot") return answer;
    const { q_rad } = answer;
    const outside = outsideLimits(place.robot, step, q_rad, axis => `axis ${axis + 1}`);
    if (outside !== undefined) return outside;
    const branch = branchOf(robot, q_rad);
    const status = branch === undefined ? 0 : statusOf(branch, wristAboveZero(robot));
    const turn = turnOf(shownAxes(convention, q_rad));
    const before = found.get(id);
    if (before === undefined) found.set(id, { status, turn });
    else if (before.turn !== turn || before.status !== status)
      found.set(id, { status: before.status === status ? status : undefined, turn: undefined });
    return answer;
  });
  return flaw ?? { kind: "postures", of: found };
}
