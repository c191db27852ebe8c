import { branchOf, flangePose, solveAll, travel } from "@twincell/core";
import { NOWHERE, asPose, back, ofPose, on } from "./rigid.ts";
const DEG = Math.PI / 180;
export const inRadians = (deg) => deg.map(angle => angle * DEG);
/** Where the arm is sent, and what the controller works out about it. Places count from the base of the robot. */
export class UprightArm {
    robot;
    tool = NOWHERE;
    worldFromBase;
    upright;
    /** The last joint angles that were known [rad]. */
    near;
    flange;
    constructor(robot, upright, worldFromBase) {
        this.robot = robot;
        this.upright = upright;
        this.worldFromBase = ofPose(worldFromBase);
        this.near = robot.home_rad;
        this.flange = ofPose(flangePose(robot.arm, robot.home_rad));
    }
    /** The tool, from the base. */
    here() { return on(this.flange, this.tool); }
    atAngles(deg) { return on(ofPose(flangePose(this.robot.arm, inRadians(deg))), this.tool); }
    inWorld(place) { return asPose(on(this.worldFromBase, place)); }
    goneToAngles(deg) {
        this.near = inRadians(deg);
        this.flange = ofPose(flangePose(this.robot.arm, this.near));
    }
    goneTo(place) { this.flange = on(place, back(this.tool)); }
    /** The posture at a place; what is left open is as near as possible to where the arm was. Undefined when there is none. */
    branchAt(place, posture) {
        const reach = solveAll(this.robot, asPose(on(place, back(this.tool))), { near: this.near });
        if (reach.kind !== "reached")
            return undefined;
        const found = reach.solutions.map(({ q_rad }) => [...q_rad]).filter(q => this.fits(q, posture)).sort((a, b) => travel(a, this.near) - travel(b, this.near))[0];
        if (found === undefined)
            return undefined;
        this.near = found;
        return branchOf(this.robot, found);
    }
    /**
     *   reach = ahead + upper · sin lean + fore · sin(lean + fold) + offset · cos(lean + fold)
     *   bend  = fold + atan2(offset, fore)
     */
    fits(q_rad, { front, up, bent, wrist }) {
        const { ahead_mm, upper_mm, fore_mm, offset_mm, lean, fold } = this.upright, deg = q_rad.map(angle => angle / DEG);
        const upperArm = lean(deg) * DEG, forearm = upperArm + fold(deg) * DEG;
        const isFront = ahead_mm + upper_mm * Math.sin(upperArm) + fore_mm * Math.sin(forearm) + offset_mm * Math.cos(forearm) >= 0;
        const isBent = Math.sin(fold(deg) * DEG + Math.atan2(offset_mm, fore_mm)) > 0;
        return (front === undefined || front === isFront) && (bent === undefined || bent === isBent) && (up === undefined || up === (isFront === isBent)) && (wrist === undefined || wrist === deg[4] > 0);
    }
    /** Remembers where the arm is; the answer brings it back. */
    remember() {
        const { tool, near, flange } = this;
        return () => { this.tool = tool; this.near = near; this.flange = flange; };
    }
}
