import type { MoveStep, VendorSection } from "@twincell/core";
import {
  called,
  outsideLimits,
  reached,
  walkMoves,
  type Cannot,
  type WalkedPlace,
  shownAxes,
} from "../../emitter/index.ts";
import { rconfText } from "./location.ts";

/** The joint angles in which a point is reached first, and the point on the way to it. */
export interface Posture {
  readonly q_rad: ArrayLike<number>;
  readonly via_rad: ArrayLike<number> | undefined;
}
/** By step id. */
export type ConfigurationMap = ReadonlyMap<string, Posture>;
export type Configurations = { readonly kind: "postures"; readonly of: ConfigurationMap } | Cannot;

/**
 * The joint angles of every taught point, by step id: those that were taught, or the ones that reach the pose with
 * least travel from the point before, in the order of execution. Stops at the first point that cannot be reached or
 * lies outside the limits.
 *
 * @param inPulses  points on the way of arcs are written as joint angles too, so they must be reached.
 */
export function configurationsOf(place: WalkedPlace, convention: VendorSection, inPulses: boolean): Configurations {
  const found = new Map<string, Posture>();
  const typeOf = (q_rad: ArrayLike<number>): string => rconfText(place.robot, q_rad, shownAxes(convention, q_rad));
  const flaw = walkMoves(place, (step: MoveStep, near) => {
    const via =
      step.via === undefined || !inPulses
        ? undefined
        : reached(place, step, { ...step.via, tool: step.target.tool ?? "flange" }, near);
    if (via?.kind === "cannot") return via;
    const answer = reached(place, step, step.target, near);
    if (answer.kind === "cannot") return answer;
    const outside = outsideLimits(place.robot, step, answer.q_rad, axis => `axis ${"SLURBT"[axis] ?? axis + 1}`);
    if (outside !== undefined) return outside;
    const first = found.get(step.id)?.q_rad;
    if (first === undefined) found.set(step.id, { q_rad: answer.q_rad, via_rad: via?.q_rad });
    // The points of a pallet are shifted with the type that is written for its first place.
    else if (place.visited.size > 0 && typeOf(first) !== typeOf(answer.q_rad)) {
      return {
        kind: "cannot",
        step: step.id,
        sentence: `${called(step)} reaches a place of the pallet with another manipulator type (RCONF) than its first place; INFORM shifts a point and keeps its type.`,
        hint: "Turn the tool or move the pallet, so that one posture reaches all places, or teach the places one by one.",
      };
    }
    return answer;
  });
  return flaw ?? { kind: "postures", of: found };
}
