import type { MoveStep } from "@twincell/core";
import { outsideLimits, reached, walkMoves, type Cannot, type WalkedPlace } from "../../writing/index.ts";

/** The joint angles in which a point is reached first, and the point on the way to it. */
export interface Posture { readonly q_rad: ArrayLike<number>; readonly via_rad: ArrayLike<number> | undefined }
/** By step id. */
export type PostureMap = ReadonlyMap<string, Posture>;
export type Postures = { readonly kind: "postures"; readonly of: PostureMap } | Cannot;

/**
 * The joint angles of every taught point, by step id: those that were taught, or the ones that reach the pose with least
 * travel from the point before, in the order of execution. Stops at the first point that cannot be reached or lies outside
 * the limits.
 *
 * @param inPulses  points on the way of arcs are written as joint angles too, so they must be reached.
 */
export function posturesOf(place: WalkedPlace, inPulses: boolean): Postures {
  const found = new Map<string, Posture>();
  let near: ArrayLike<number> = place.robot.home_rad;
  const flaw = walkMoves(place, (step: MoveStep) => {
    const via = step.via === undefined || !inPulses ? undefined : reached(place, step, { ...step.via, tool: step.target.tool ?? "flange" }, near);
    if (via?.kind === "cannot") return via;
    const answer = reached(place, step, step.target, near);
    if (answer.kind === "cannot") return answer;
    const outside = outsideLimits(place, step, answer.q_rad, axis => "SLURBT"[axis] ?? `${axis + 1}`);
    if (outside !== undefined) return outside;
    near = answer.q_rad;
    if (!found.has(step.id)) found.set(step.id, { q_rad: near, via_rad: via?.q_rad });
    return undefined;
  });
  return flaw ?? { kind: "postures", of: found };
}
