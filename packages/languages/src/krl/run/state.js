import { branchOf, compose, flangePose, inverse } from "@twincell/core";
import { TextError } from "../../text/index.ts";
import { STATUS_SLACK, travel } from "./axes.ts";
import { componentsOf, frameOf, fromPose, inverted, times, toPose } from "./frames.ts";
import { System } from "./system.ts";
import { component, toFrame } from "./values.ts";
const AXIS_NAMES = ["A1", "A2", "A3", "A4", "A5", "A6"];
/** Where the arm is sent, and the steps this amounts to. */
export class ControllerState {
    system = new System();
    robot;
    axes;
    context;
    worldFromRoot;
    rootFromBase;
    /** Where the flange is sent, in the controller's $WORLD, and the axis values there. */
    flange;
    axes_deg;
    /** Names given last: most motions keep their tool and their base. */
    toolMet = { of: undefined, name: "" };
    baseMet = { of: undefined, name: "" };
    constructor(robot, axes, worldFromBase, context) {
        this.robot = robot;
        this.axes = axes;
        this.context = context;
        this.worldFromRoot = compose(worldFromBase, robot.baseFromVendorWorld);
        this.rootFromBase = inverse(robot.baseFromVendorWorld);
        this.axes_deg = axes.degrees(robot.home_rad);
        this.flange = this.flangeAt(this.axes_deg);
    }
    /** $POS_ACT: the tool in the base. */
    here() {
        const { tool, base } = this.system;
        return times(times(inverted(base.frame), this.flange), tool.frame);
    }
    get presentAxes_deg() { return this.axes_deg; }
    /** The neutral step of a motion; from now on the arm is at its end. */
    move(id, motion, target, via, at) {
        const isAxes = AXIS_NAMES.some(name => target.fields.has(name));
        if (isAxes && motion.motion !== "PTP")
            throw new TextError(at, "a position with X, Y, Z, A, B, C", `${motion.motion} does not take axis values.`);
        const passing = via === undefined ? undefined : this.viaPose(via, at);
        const path = motion.motion === "PTP" ? "ptp" : motion.motion === "LIN" ? "lin" : motion.motion === "CIRC" ? "circ" : "spline";
        const reached = isAxes ? this.toAxes(target, motion.relative) : this.toPosition(target, motion, at);
        const ratio = path === "ptp" ? this.system.accelerationRatio : this.system.pathAccelerationRatio;
        return {
            id, type: "move", path, target: reached, speed: this.speed(path), blend_m: 0,
            ...(passing === undefined ? {} : { via: passing }),
            ...(Math.abs(ratio - 1) < 1e-6 ? {} : { acceleration: { ratio: Math.min(1, ratio) } }),
        };
    }
    speed(path) {
        return path === "ptp" ? { ratio: this.system.velocityRatio } : { mps: this.system.pathSpeed_mps };
    }
    toAxes(target, relative) {
        this.axes_deg = AXIS_NAMES.slice(0, this.axes.count).map((name, i) => {
            const value = component(target, name);
            return relative ? this.axes_deg[i] + (value ?? 0) : value ?? this.axes_deg[i];
        });
        this.flange = this.flangeAt(this.axes_deg);
        return { q: this.axes.radians(this.axes_deg), tool: this.nameTool() };
    }
    toPosition(target, motion, at) {
        const { tool, base } = this.system;
        const baseFromTcp = motion.relative ? (motion.inTool ? this.shiftedInTool(target) : this.shifted(target)) : toFrame(target, this.here(), at);
        this.flange = times(times(base.frame, baseFromTcp), inverted(tool.frame));
        const status = component(target, "S"), turn = motion.motion === "PTP" ? component(target, "T") : undefined;
        const before = this.axes_deg, all = this.axes.reaching(compose(inverse(this.rootFromBase), toPose(this.flange)), before);
        const exact = status === undefined ? all : all.filter(axes => this.axes.hasStatus(axes, status));
        const candidates = exact.length > 0 || status === undefined ? exact : all.filter(axes => this.axes.hasStatus(axes, status, STATUS_SLACK.written));
        if (candidates.length === 0) {
            if (all.length > 0)
                throw new TextError(at, "a Status that the point can be reached with", `The point cannot be reached within the axis limits with Status ${status}.`);
            return this.poseTarget(baseFromTcp, undefined);
        }
        candidates.sort((a, b) => travel(a, before) - travel(b, before));
        const turned = turn === undefined ? candidates[0] : candidates.find(axes => this.axes.hasTurn(axes, turn));
        if (turned === undefined)
            throw new TextError(at, "a Turn that the point can be reached with", `The point cannot be reached within the axis limits with Turn ${turn}.`);
        this.axes_deg = turned;
        const q = this.axes.radians(turned);
        // The nearest turn is what a pose means; another one can only be said by the axes themselves.
        return turned === candidates[0] ? this.poseTarget(baseFromTcp, q) : { q, tool: this.nameTool() };
    }
    poseTarget(baseFromTcp, q) {
        const branch = q === undefined ? undefined : branchOf(this.robot, q);
        return { ...this.place(baseFromTcp), ...(branch === undefined ? {} : { branch }) };
    }
    viaPose(via, at) {
        if (AXIS_NAMES.some(name => via.fields.has(name)))
            throw new TextError(at, "a position with X, Y, Z, A, B, C", "CIRC does not take axis values.");
        return this.place(toFrame(via, this.here(), at));
    }
    place(baseFromTcp) {
        const { base } = this.system, frame = this.nameFrame(base), tool = this.nameTool();
        if (frame !== "world")
            return { pose: toPose(baseFromTcp), frame, tool };
        return { pose: compose(this.worldFromRoot, toPose(times(base.frame, baseFromTcp))), frame, tool };
    }
    /** LIN_REL and PTP_REL: what is given is added to the present position, in the base. */
    shifted(by) {
        const now = componentsOf(this.here());
        const [x, y, z, a, b, c] = ["X", "Y", "Z", "A", "B", "C"].map((name, i) => now[i] + (component(by, name) ?? 0));
        return frameOf(x, y, z, a, b, c);
    }
    /** `LIN_REL {Z -50} #TOOL`: what is given is a pose seen from the tool as it stands. */
    shiftedInTool(by) {
        const [x, y, z, a, b, c] = ["X", "Y", "Z", "A", "B", "C"].map(name => component(by, name) ?? 0);
        return times(this.here(), frameOf(x, y, z, a, b, c));
    }
    flangeAt(axes_deg) {
        return fromPose(compose(this.rootFromBase, flangePose(this.robot.arm, this.axes.radians(axes_deg))));
    }
    nameTool() {
        const { tool } = this.system;
        if (this.toolMet.of !== tool) {
            this.toolMet = { of: tool, name: isNull(tool.frame) ? "flange" : named(this.context.tools, toPose(tool.frame), plainName(tool, "TOOL"), "flange") };
        }
        return this.toolMet.name;
    }
    /** The base of the robot is no frame of a program: what is given in it is given in the world. */
    nameFrame(base) {
        if (this.baseMet.of !== base) {
            const isWorld = isNull(base.frame);
            this.baseMet = { of: base, name: isWorld ? "world" : named(this.context.frames, compose(this.worldFromRoot, toPose(base.frame)), plainName(base, "BASE"), "world") };
        }
        return this.baseMet.name;
    }
    /** What the flange carries, centre of mass in metres. */
    payload(load, at) {
        const cm = load.fields.get("CM"), j = load.fields.get("J"), mass_kg = component(load, "M");
        if (mass_kg === undefined || cm?.kind !== "structure")
            throw new TextError(at, "a load with M and CM", "$LOAD takes a mass and the place of its centre.");
        const { r, p_mm: [x, y, z] } = toFrame(cm, undefined, at);
        const center_m = [x / 1000, y / 1000, z / 1000];
        const main = j?.kind === "structure" ? [component(j, "X") ?? 0, component(j, "Y") ?? 0, component(j, "Z") ?? 0] : [0, 0, 0];
        if (main.every(value => value === 0))
            return { mass_kg, center_m };
        const of = (i, k) => [0, 1, 2].reduce((sum, n) => sum + r[3 * i + n] * main[n] * r[3 * k + n], 0);
        return { mass_kg, center_m, inertia_kgm2: [of(0, 0), of(1, 1), of(2, 2), of(0, 1), of(0, 2), of(1, 2)] };
    }
}
const isNull = ({ r, p_mm }) => p_mm.every(value => value === 0) && r[0] === 1 && r[4] === 1 && r[8] === 1;
/** TOOL_TORCH is the tool "torch"; TOOL_DATA_1 stays what it is. */
const plainName = ({ name }, word) => {
    const stem = name.startsWith(`${word}_`) && !name.startsWith(`${word}_DATA`) ? name.slice(word.length + 1) : name;
    return (stem === "" ? word : stem).toLowerCase();
};
/** What was met before keeps its name; two things never share one. */
function named(known, pose, wanted, never) {
    const text = JSON.stringify(pose), stem = wanted === never ? `${wanted}_1` : wanted;
    for (let i = 1;; i++) {
        const name = i === 1 ? stem : `${stem}_${i}`, there = Object.hasOwn(known, name) ? known[name] : undefined;
        if (there === undefined)
            known[name] = pose;
        if (there === undefined || JSON.stringify(there) === text)
            return name;
    }
}
