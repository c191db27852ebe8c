import { branchOf, compose, inverse, solveAll } from "@twincell/core";
import { axisValues, pulseText, rconfText, rectanPose, rectanText } from "./location.ts";
import { TextWriter } from "./text-writer.ts";
/** The positions of a job. Settings are written where they change. */
export class Points {
    out = new TextWriter();
    count = 0;
    place;
    controller;
    convention;
    pulses;
    robot;
    user = "";
    tool = "";
    type = "";
    rconf = "";
    constructor(place, controller, convention, pulses) {
        this.place = place;
        this.robot = place.robot;
        this.controller = controller;
        this.convention = convention;
        this.pulses = pulses;
    }
    /** Adds a point and returns its name and where the robot is then. */
    add({ id }, target, frame, tool, q_rad) {
        if (this.pulses !== undefined)
            return { name: this.pulsePoint(id, tool, q_rad), arrival: { q_rad, written: undefined } };
        const text = rectanText(this.inFrame(target, frame, tool));
        return { name: this.rectanPoint(id, frame, tool, text, q_rad), arrival: { q_rad, written: { frame, tool, text } } };
    }
    /** The place where the robot is, once more, as a point of an arc or a curve. */
    repeat({ id }, arrival, frame, tool) {
        const { q_rad, written } = arrival;
        if (this.pulses !== undefined)
            return this.pulsePoint(id, tool, q_rad);
        if (written?.frame === frame && written.tool === tool)
            return this.rectanPoint(id, frame, tool, written.text, q_rad);
        const { frame: before, tool: by, text } = written, worldFromFlange = this.worldFromFlange(before, by, text);
        const tip = compose(inverse(this.worldFrom(frame)), compose(worldFromFlange, rectanPose(rectanText(this.place.tool(tool)))));
        return this.rectanPoint(id, frame, tool, rectanText(tip), q_rad);
    }
    /** A variable for shifts, at 0. */
    variable(name) {
        this.settings("world", "flange", "BASE");
        this.out.add(`P${name.slice(1).padStart(4, "0")}=0.000,0.000,0.000,0.0000,0.0000,0.0000`);
    }
    inFrame(target, frame, tool) {
        if ("pose" in target && target.frame === frame && frame !== "world")
            return target.pose;
        const worldFromTcp = this.place.worldFromTarget(target, tool);
        return frame === "world" ? compose(this.place.vendorFromWorld, worldFromTcp) : compose(inverse(this.place.worldFromFrame(frame)), worldFromTcp);
    }
    /** A frame as the text has it. */
    worldFrom(frame) {
        const worldFromVendor = inverse(this.place.vendorFromWorld);
        return frame === "world" ? worldFromVendor : compose(worldFromVendor, rectanPose(rectanText(this.controller.vendorFromFrame(frame))));
    }
    /** Where the flange is when the text is taken at its word: frames, tools and points are rounded each for itself. */
    worldFromFlange(frame, tool, text) {
        return compose(compose(this.worldFrom(frame), rectanPose(text)), inverse(rectanPose(rectanText(this.place.tool(tool)))));
    }
    /**
     * The joint angles in which the rounded text is reached in the posture of `q_rad`. With the wrist centre close to axis S the
     * last digit turns S and R by whole degrees: flags of the angles that were meant could name another posture.
     */
    reachedByText(frame, tool, text, q_rad) {
        const branch = branchOf(this.robot, q_rad), baseFromFlange = compose(inverse(this.place.worldFromBase), this.worldFromFlange(frame, tool, text));
        const reach = solveAll(this.robot, baseFromFlange, branch === undefined ? { near: q_rad } : { near: q_rad, branch });
        // At the very end of the reach the last digit can lie outside: then the angles that were meant are the best there is.
        return reach.kind === "reached" ? reach.solutions[0].q_rad : q_rad;
    }
    pulsePoint(id, tool, q_rad) {
        this.settings("", tool, "PULSE");
        return this.point(id, pulseText(axisValues(q_rad, this.convention), this.pulses.pulsesPerDegree));
    }
    rectanPoint(id, frame, tool, text, q_rad) {
        this.settings(frame === "world" ? "" : frame, tool, frame === "world" ? "BASE" : "USER");
        const rounded_rad = this.reachedByText(frame, tool, text, q_rad), rconf = rconfText(this.robot, rounded_rad, axisValues(rounded_rad, this.convention));
        if (rconf !== this.rconf)
            this.out.add(`///RCONF ${rconf}`);
        this.rconf = rconf;
        return this.point(id, text);
    }
    settings(frame, tool, type) {
        const user = frame === "" || frame === "world" ? this.user : `///USER ${this.controller.user(frame)}`, toolLine = `///TOOL ${this.controller.tool(tool)}`;
        if (user !== this.user)
            this.out.add(user);
        if (toolLine !== this.tool)
            this.out.add(toolLine);
        if (type !== this.type) {
            this.out.add(`///POSTYPE ${type}`);
            this.out.add(type === "PULSE" ? "///PULSE" : "///RECTAN");
        }
        this.user = user;
        this.tool = toolLine;
        this.type = type;
    }
    point(id, text) {
        const name = `C${String(this.count++).padStart(5, "0")}`;
        this.out.add(`${name}=${text}`, id);
        return name;
    }
}
