import { branchOf, compose } from "@twincell/core";
import { BasicModules, CannotSay, called, degText, fixed, mmText, turnTexts } from "../../writing/index.ts";
import { GRIPPER, LINES } from "../robots.ts";
import { RESERVED } from "./reserved.ts";
const LONGEST_NAME = 32;
/** Tools and locals that the controller keeps. */
const MOST = 15;
/** The largest speed of a path [mm/s], and what SpeedS and Speed say at least. */
const FASTEST_MMPS = 2000, SLOWEST_MMPS = 0.1, LEAST_PERCENT = 1;
/** A pose in a pattern that is turned more than this is turned. */
const STRAIGHT = 1e-9;
/** The file: `main` and the functions that it calls. */
export class SpelProgram extends BasicModules {
    sharesNumbers = false;
    spoken;
    constructor(place, spoken) {
        super(place, { most: LONGEST_NAME, reserved: RESERVED, first: "n_", foldsCase: true }, {
            language: "SPEL+", file: "main.prg", define: "#define", main: "main", open: name => `Function ${name}`, close: "Fend", endIf: "EndIf", forever: ["Do", "Loop"], mm: mmText,
            most: { tools: MOST, frames: MOST, called: "locals" }, lines: LINES, gripper: GRIPPER,
        });
        this.spoken = spoken;
    }
    head() { return []; }
    ending() { return []; }
    declaration(names) { return [`Real ${names.join(", ")}`]; }
    patterns() { return [...this.used.pallets].map((name, i) => `#define ${this.named("pallet", name)} P${i + 1}`); }
    beginning() {
        const { place, used: { tools, frames } } = this;
        return [
            "Motor On", "Power High", "Accel 100, 100", ...[...tools].map(tool => `TLSet ${this.named("tool", tool)}, ${xyText(place.tool(tool))}`),
            ...[...frames].map(frame => `Local ${this.named("frame", frame)}, ${xyText(compose(place.baseFromWorld, place.frame(frame)))}`),
        ];
    }
    wait(s, add) { add(`Wait ${fixed(s, 6)}`); }
    grip(closed, add) { add(`${closed ? "On" : "Off"} ${GRIPPER.name}`); }
    set({ to, pulse_s }, line, add) { add(`${to === true ? "On" : "Off"} ${line}${pulse_s === undefined ? "" : `, ${fixed(pulse_s, 6)}`}`); }
    asked({ signal, is }, line) {
        return `${this.place.program.signals[signal]?.kind === "digital-out" ? "Oport" : "Sw"}(${line}) = ${is ? "On" : "Off"}`;
    }
    waitFor(condition, _step, add) { add(`Wait ${condition}`); }
    payload() { }
    message(text, add) { add(`Print "${text}"`); }
    stop(add) { add("Quit All"); }
    palletPlace({ pallet: name }, pallet, coordinates, turn, add) {
        add(`${this.named("pallet", name)} = XY(${coordinates.join(", ")}, ${[...turnTexts(turn)].reverse().join(", ")})${this.local(pallet.frame)}`);
    }
    move(step, next, add) {
        const { target, speed, path } = step, isJoint = path === "ptp", tool = target.tool ?? (isJoint && "q" in target ? undefined : "flange"), most_mps = this.place.robot.maxTcpSpeed_mps;
        if (tool !== undefined)
            this.say("tool", tool === "flange" ? "Tool 0" : `Tool ${this.named("tool", tool)}`, add);
        if ("time_s" in speed)
            return;
        const ratio = "mps" in speed ? speed.mps / most_mps : speed.ratio, mmps = ("mps" in speed ? speed.mps : speed.ratio * most_mps) * 1000;
        if (isJoint)
            this.say("speed", `Speed ${Math.min(100, Math.max(LEAST_PERCENT, Math.round(ratio * 100)))}`, add);
        else
            this.say("path speed", `SpeedS ${fixed(Math.min(FASTEST_MMPS, Math.max(SLOWEST_MMPS, mmps)), 4)}`, add);
        const posture = this.place.posture(step, target, this.near), passes = this.place.blend_m(step, this.before, next) > 0 ? " CP" : "";
        const words = isJoint && !("q" in target) ? this.postureWords(target.branch, posture) : "";
        if (path === "circ") {
            if (step.via === undefined)
                throw new CannotSay(step.id, `${called(step)} has no point to pass through.`, "Teach the point on the arc.");
            add(`Arc3 ${this.goal(step, step.via)}, ${this.goal(step, target)}${passes}`);
        }
        else
            add(`${isJoint ? "Go" : "Move"} ${this.goal(step, target)}${words}${passes}`);
        this.near = posture ?? this.near;
    }
    goal(step, target) {
        if ("q" in target)
            return `JA(${target.q.map(degText).join(", ")})`;
        return Object.hasOwn(this.place.program.pallets, target.frame) ? this.inPattern(step, target.frame, target.pose) : `${xyText(this.inBase(target))}${this.local(target.frame)}`;
    }
    /** A step from the place of a pattern along its own axes. */
    inPattern(step, pallet, { position, quaternion }) {
        if (Math.hypot(quaternion[0], quaternion[1], quaternion[2]) > STRAIGHT)
            throw new CannotSay(step.id, `${called(step)} turns the hand at the places of ${pallet}, which SPEL+ cannot count from a place.`, "Turn the places of the pallet instead.");
        const steps = position.flatMap((by, i) => mmText(by) === "0" ? [] : [` +TL${"XYZ"[i]}(${mmText(by)})`]);
        return `${this.named("pallet", pallet)}${steps.length === 0 ? " +TLZ(0)" : steps.join("")}`;
    }
    local(frame) { return frame === "world" ? "" : ` /${this.numberOf(frame)}`; }
    /** A place alone is reached in the posture that the arm is in; one that was taught is asked for. */
    postureWords(branch, posture) {
        const named = branch === undefined || posture === undefined ? undefined : branchOf(this.place.robot, posture);
        if (named === undefined)
            return "";
        return ` /${named.shoulder === "front" ? "R" : "L"} /${named.elbow === "up" ? "A" : "B"} /${named.wrist === this.spoken.noFlip ? "NF" : "F"}`;
    }
}
/** XY(x, y, z, u, v, w): mm and degrees, turns about z, y, x. */
const xyText = ({ position, quaternion }) => `XY(${[...position.map(mmText), ...[...turnTexts(quaternion)].reverse()].join(", ")})`;
