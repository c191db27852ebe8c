import { branchOf, compose, flangePose, nearestSolution, solverScratch } from "@twincell/core";
import { BASE_FROM_CONTROLLER, fromPose, inverted, matrixOf, sixOf, times, toPose } from "./frame.ts";
/** Where the arm is sent, and what the controller works out about it. Poses count in the controller's base. */
export class ControllerArm {
    robot;
    worldFromController;
    baseFromController = toPose(BASE_FROM_CONTROLLER);
    scratch = solverScratch();
    tcp = matrixOf([0, 0, 0, 0, 0, 0]);
    /** The last joint angles that are known, undefined where they cannot be worked out, and the poses of the flange since then. */
    settled;
    since = [];
    constructor(robot, worldFromBase) {
        this.robot = robot;
        this.worldFromController = times(fromPose(worldFromBase), BASE_FROM_CONTROLLER);
        this.settled = robot.home_rad;
    }
    flangeAt(joints) { return times(inverted(BASE_FROM_CONTROLLER), fromPose(flangePose(this.robot.arm, joints))); }
    /** The tool tip where the arm is sent. */
    tip() { return times(this.since.at(-1) ?? this.flangeAt(this.settled), this.tcp); }
    tipAt(joints) { return times(this.flangeAt(joints), this.tcp); }
    world(pose) { return toPose(times(this.worldFromController, pose)); }
    /** The posture that each pose was reached in, one after the other, is worked out when somebody asks. Undefined where it cannot be. */
    get joints() {
        for (const flange of this.since)
            this.settled = this.settled === undefined ? undefined : this.solvedFor(flange, this.settled);
        if (this.settled !== undefined)
            this.since = [];
        return this.settled;
    }
    atJoints(joints) {
        this.settled = joints;
        this.since = [];
    }
    /** The tip is at that pose; the posture is the one nearest to where the arm was, or to `near`. */
    atPose(pose, near) {
        const flange = times(matrixOf(pose.six), inverted(this.tcp));
        if (near !== undefined) {
            this.settled = near;
            this.since = [flange];
            return;
        }
        this.since.push(flange);
    }
    /** Joint angles for a pose of the tip, nearest to a posture. Undefined where they cannot be worked out. */
    solve(pose, near) {
        return this.solvedFor(times(matrixOf(pose.six), inverted(this.tcp)), near);
    }
    /** Remembers where the arm is; the answer brings it back. */
    remember() {
        const { tcp, settled } = this, since = [...this.since];
        return () => { this.tcp = tcp; this.settled = settled; this.since = [...since]; };
    }
    branch(joints) { return branchOf(this.robot, joints); }
    solvedFor(flange, near) {
        const q = new Float64Array(near.length), baseFromFlange = compose(this.baseFromController, toPose(flange));
        return nearestSolution(this.robot, baseFromFlange, near, q, this.scratch) ? [...q] : undefined;
    }
    /** Six numbers of a matrix. */
    six(matrix) { return { kind: "pose", six: sixOf(matrix) }; }
}
