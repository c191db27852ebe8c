import { called, outsideLimits, reached, walkMoves } from "../../writing/index.ts";
import { axisValues, rconfText } from "./location.ts";
/**
 * The joint angles of every taught point, by step id: those that were taught, or the ones that reach the pose with least
 * travel from the point before, in the order of execution. Stops at the first point that cannot be reached or lies outside
 * the limits.
 *
 * @param inPulses  points on the way of arcs are written as joint angles too, so they must be reached.
 */
export function posturesOf(place, convention, inPulses) {
    const found = new Map(), typeOf = (q_rad) => rconfText(place.robot, q_rad, axisValues(q_rad, convention));
    const flaw = walkMoves(place, (step, near) => {
        const via = step.via === undefined || !inPulses ? undefined : reached(place, step, { ...step.via, tool: step.target.tool ?? "flange" }, near);
        if (via?.kind === "cannot")
            return via;
        const answer = reached(place, step, step.target, near);
        if (answer.kind === "cannot")
            return answer;
        const outside = outsideLimits(place, step, answer.q_rad, axis => "SLURBT"[axis] ?? `${axis + 1}`);
        if (outside !== undefined)
            return outside;
        const first = found.get(step.id)?.q_rad;
        if (first === undefined)
            found.set(step.id, { q_rad: answer.q_rad, via_rad: via?.q_rad });
        // The points of a pallet are shifted with the type that is written for its first place.
        else if (place.visited.size > 0 && typeOf(first) !== typeOf(answer.q_rad)) {
            return {
                kind: "cannot", step: step.id, sentence: `${called(step)} reaches a place of the pallet with another manipulator type (RCONF) than its first place; INFORM shifts a point and keeps its type.`,
                hint: "Turn the tool or move the pallet, so that one posture reaches all places, or teach the places one by one.",
            };
        }
        return answer;
    });
    return flaw ?? { kind: "postures", of: found };
}
