import { branchOf } from "@twincell/core";
import { outsideLimits, reached, walkMoves } from "../../writing/index.ts";
import { axisValues } from "./location.ts";
import { statusOf, turnOf } from "./status.ts";
/**
 * Status and Turn of every taught point, by step id: of the joint angles that were taught, or of those that reach the pose
 * with least travel from the point before, in the order of execution. Stops at the first point that cannot be reached or
 * lies outside the limits.
 */
export function posturesOf(place, convention) {
    const found = new Map(), { robot } = place;
    const flaw = walkMoves(place, (step, near) => {
        const { id, target } = step, answer = reached(place, step, target, near);
        if (answer.kind === "cannot")
            return answer;
        const { q_rad } = answer, outside = outsideLimits(place, step, q_rad, axis => `${axis + 1}`);
        if (outside !== undefined)
            return outside;
        const branch = branchOf(robot, q_rad), status = branch === undefined ? 0 : statusOf(branch), turn = turnOf(axisValues(q_rad, convention)), before = found.get(id);
        if (before === undefined)
            found.set(id, { status, turn });
        else if (before.turn !== turn || before.status !== status)
            found.set(id, { status: before.status === status ? status : undefined, turn: undefined });
        return answer;
    });
    return flaw ?? { kind: "postures", of: found };
}
