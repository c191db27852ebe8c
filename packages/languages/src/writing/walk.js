import { branchOf, compose, degrees, explainReach, flangeOfTcp, flangePose, identity, inverse, palletPlaces, solveAll, } from "@twincell/core";
import { called } from "./cannot.ts";
const LIMIT_SLACK_RAD = 1e-9;
/** A pallet is looked at at every place up to this many. */
const MOST_PLACES = 400;
/** Where a program counts from while it is walked through: the world of the cell, seen from the world of the controller. */
export class WalkedPlace {
    program;
    robot;
    worldFromBase;
    vendorFromWorld;
    /** Where the place of a pallet is that is being visited. */
    visited = new Map();
    constructor(program, robot, worldFromBase) {
        this.program = program;
        this.robot = robot;
        this.worldFromBase = worldFromBase;
        this.vendorFromWorld = inverse(compose(worldFromBase, robot.baseFromVendorWorld));
    }
    tool(name) {
        const { tools } = this.program;
        return Object.hasOwn(tools, name) ? tools[name] : identity();
    }
    worldFromFrame(name) {
        const { frames } = this.program;
        return this.visited.get(name) ?? (Object.hasOwn(frames, name) ? frames[name] : identity());
    }
    /** Pose of the tool in the world. */
    worldFromTarget(target, tool) {
        if ("q" in target)
            return compose(compose(this.worldFromBase, flangePose(this.robot.arm, target.q)), this.tool(tool));
        return compose(this.worldFromFrame(target.frame), target.pose);
    }
}
/** More starts than these are not told apart. */
const MOST_STARTS = 8;
/** Postures that are closer than this are one [rad]. */
const SAME_RAD = 1e-6;
/**
 * Shows every move of a program in the order of execution: loops twice, since the second round begins where the first one
 * ends, pallets place by place, what follows a decision from both its ends, and routines that nobody calls behind
 * everything else.
 *
 * @param visit  the posture that a move ends in when the arm starts from `near`, or what is wrong with it; the walk ends there.
 */
export function walkMoves(place, visit) {
    const { program, robot } = place, { routines, pallets } = program, walked = new Set();
    let starts = [robot.home_rad];
    const routine = (name) => {
        walked.add(name);
        return walk(Object.hasOwn(routines, name) ? routines[name] : []);
    };
    const walk = (steps) => {
        for (const step of steps) {
            const flaw = one(step);
            if (flaw !== undefined)
                return flaw;
        }
        return undefined;
    };
    const move = (step) => {
        const ends = [];
        for (const near of starts) {
            const answer = visit(step, near);
            if (answer.kind === "cannot")
                return answer;
            ends.push(answer.q_rad);
        }
        starts = distinct(ends);
        return undefined;
    };
    const one = (step) => {
        switch (step.type) {
            case "move": return move(step);
            case "repeat": return walk(step.steps) ?? (step.times === 1 ? undefined : walk(step.steps));
            case "if": {
                const before = starts, flaw = walk(step.then), then = starts;
                starts = before;
                const other = flaw ?? walk(step.else ?? []);
                starts = distinct([...then, ...starts]);
                return other;
            }
            case "call": return routine(step.routine);
            case "pallet": {
                const pallet = Object.hasOwn(pallets, step.pallet) ? pallets[step.pallet] : undefined;
                if (pallet === undefined)
                    return undefined;
                for (const each of palletPlaces(pallet).slice(0, MOST_PLACES)) {
                    place.visited.set(step.pallet, compose(place.worldFromFrame(pallet.frame), each));
                    const flaw = walk(step.steps);
                    if (flaw !== undefined)
                        return flaw;
                }
                place.visited.delete(step.pallet);
                return undefined;
            }
            default: return undefined;
        }
    };
    return walk(program.steps) ?? Object.keys(routines).reduce((flaw, name) => flaw ?? (walked.has(name) ? undefined : routine(name)), undefined);
}
function distinct(starts) {
    const found = [];
    for (const start of starts) {
        if (found.length < MOST_STARTS && !found.some(other => Array.from(other).every((angle, i) => Math.abs(angle - start[i]) < SAME_RAD)))
            found.push(start);
    }
    return found;
}
/** The joint angles in which a target of a step is reached from `near`: those that were taught on a joint move, otherwise those of least travel. */
export function reached(place, step, target, near) {
    const { robot, worldFromBase } = place, count = robot.arm.joints.length;
    if ("q" in target && target.q.length !== count) {
        return { kind: "cannot", step: step.id, sentence: `${called(step)} holds ${target.q.length} joint angles; the ${robot.name} has ${count} joints.`, hint: "Teach the step again on this robot." };
    }
    if ("q" in target && step.path === "ptp")
        return { kind: "reached", q_rad: target.q };
    // Along a path the axes arrive in the turn that is nearest, whatever angles were taught.
    const baseFromFlange = "q" in target ? flangePose(robot.arm, target.q) : flangeOfTcp(worldFromBase, place.worldFromTarget(target, target.tool), place.tool(target.tool));
    const branch = "q" in target ? branchOf(robot, target.q) : target.branch, reach = solveAll(robot, baseFromFlange, branch === undefined ? { near } : { near, branch });
    if (reach.kind === "reached")
        return { kind: "reached", q_rad: reach.solutions[0].q_rad };
    return { kind: "cannot", step: step.id, sentence: `${called(step)} cannot be reached. ${explainReach(reach)}`, hint: "Check the program: it says what would bring the step into reach." };
}
/** @param axisName  what the controller calls its axes, counted from 0. */
export function outsideLimits({ robot }, step, q_rad, axisName) {
    const { joints } = robot.arm, i = joints.findIndex(({ limits }, k) => !(q_rad[k] >= limits.lower_rad - LIMIT_SLACK_RAD && q_rad[k] <= limits.upper_rad + LIMIT_SLACK_RAD));
    if (i < 0)
        return undefined;
    const { lower_rad, upper_rad } = joints[i].limits;
    return {
        kind: "cannot", step: step.id,
        sentence: `${called(step)} turns axis ${axisName(i)} to ${degrees(q_rad[i]).toFixed(2)}°; it may turn from ${degrees(lower_rad).toFixed(1)}° to ${degrees(upper_rad).toFixed(1)}°.`,
        hint: "Move the point, or choose another branch for it.",
    };
}
