import { branchOf, compose, everyStep, inverse, pose, rotate, } from "@twincell/core";
import { asciiText } from "../../text/index.ts";
import { CannotSay, Names, StepWriter, called, fixed, patternOf, pitchTerm } from "../../writing/index.ts";
import { GRIPPER_OUTPUT } from "../robots.ts";
import { Listing } from "./listing.ts";
import { configOf, pendantJoints, xyzwpr } from "./positions.ts";
import { Registers } from "./registers.ts";
import { RESERVED, labelled } from "./words.ts";
const NAME_LENGTH = 36, REMARK_LENGTH = 32, MESSAGE_LENGTH = 23, LONGEST_WAIT_S = 327.67;
/** A pitch is added many times over: it is written to ten nanometres. */
const fine = (length_m) => fixed(length_m * 1000, 5);
const SHORT = { "digital-in": "DI", "digital-out": "DO", "analogue-in": "AI", "analogue-out": "AO" };
/** Writes the programs; each says what changes from one step to the next, and everything anew where it may be entered another way. */
export class ProgramWriter extends StepWriter {
    warnings = new Set();
    convention;
    fastest_mmps;
    names = new Names({ most: NAME_LENGTH, reserved: RESERVED, first: "P_", foldsCase: true });
    registers;
    visits = new Map();
    out = new Listing("", "");
    tool;
    frame;
    constructor(place, convention, fastest_mmps) {
        super(place);
        this.convention = convention;
        this.fastest_mmps = fastest_mmps;
        this.registers = new Registers(place);
    }
    write() {
        const { program } = this.place, name = this.names.of("program", program.name).toUpperCase(), main = new Listing(name, program.name), files = [];
        for (const routine of Object.keys(program.routines))
            this.names.of("routine", routine);
        for (const step of everyStep(program))
            if (step.type === "move")
                this.registers.note(step);
        for (const [routine, steps] of Object.entries(program.routines))
            files.push(this.program(new Listing(this.routineName(routine), routine), steps));
        main.add(`!* ${asciiText(program.name)}`.slice(0, REMARK_LENGTH + 1).trimEnd());
        this.registers.declare(main);
        this.program(main, program.steps);
        return [main, ...files].map(listing => listing.file());
    }
    routineName(routine) { return this.names.of("routine", routine).toUpperCase(); }
    program(listing, steps) {
        this.out = listing;
        this.begin();
        this.steps(steps);
        return listing;
    }
    begin() {
        super.begin();
        this.tool = undefined;
        this.frame = undefined;
    }
    remark(text, step) { this.out.add(`!${text.trimStart()}`.slice(0, REMARK_LENGTH + 1).trimEnd(), step); }
    step(step, next) {
        const add = (line) => { this.out.add(line, step.id); };
        switch (step.type) {
            case "move": return this.move(step, next);
            case "wait": return add(`WAIT ${this.seconds(step, step.s)}(sec)`);
            case "gripper": return add(`${GRIPPER_OUTPUT}=${step.closed ? "ON" : "OFF"}`);
            case "set": return this.set(step, add);
            case "wait-for": return this.waitFor(step, add);
            case "message": {
                const text = asciiText(step.text).replace(/[[\]]/g, "'");
                if (text.length > MESSAGE_LENGTH)
                    throw new CannotSay(step.id, `${called(step)} says ${text.length} characters; MESSAGE shows ${MESSAGE_LENGTH}.`, "Say it in fewer words.");
                return add(`MESSAGE[${text}]`);
            }
            case "stop": return add("ABORT");
            case "comment":
                for (const line of inLines(asciiText(step.text), REMARK_LENGTH - 2))
                    add(`!- ${line}`.trimEnd());
                return;
            case "call":
                add(`CALL ${this.routineName(step.routine)}`);
                return this.begin();
            case "repeat": return this.repeat(step, add);
            case "if": return this.decision(step, add);
            case "pallet": return this.pallet(step, add);
            // Declared under `cannot`.
            case "payload": throw new CannotSay(step.id, `${called(step)} says a load.`, "Choose a payload schedule at the controller.");
        }
    }
    // --- blocks -----------------------------------------------------------------------------------------------------
    block(steps) { this.begin(); this.steps(steps); }
    repeat(step, add) {
        const label = step.times === "forever" ? this.out.label() : 0;
        add(step.times === "forever" ? `LBL[${label}]` : `FOR ${this.registers.number("count")}=1 TO ${step.times}`);
        this.block(step.steps);
        add(step.times === "forever" ? `JMP LBL[${label}]` : "ENDFOR");
        this.begin();
    }
    decision(step, add) {
        add(`IF (${this.condition(step.when, step)}) THEN`);
        this.block(step.then);
        if (step.else !== undefined) {
            add("ELSE");
            this.block(step.else);
        }
        add("ENDIF");
        this.begin();
    }
    /** Loops over layers, lines and places: the present place is worked out, and its distance from the first shifts the taught points. */
    pallet(step, add) {
        const { program, baseFromWorld, robot } = this.place, { registers } = this, { pallet, lines, inLine, isShifted, isZigzag, ...pitch } = patternOf(step, program);
        const vendorFromFrame = pallet.frame === "world" ? compose(compose(pose(), compose(inverse(robot.baseFromVendorWorld), baseFromWorld)), pose()) : pose();
        const first = compose(vendorFromFrame, pallet.origin), [along_m, away_m, up_m] = [pitch.along_m, pitch.away_m, pitch.up_m].map(v => rotate(vendorFromFrame.quaternion, v));
        const origin = registers.position(`${step.pallet} 1`), present = registers.position(`${step.pallet} now`), offset = registers.position(step.pallet);
        const [layer, line, along, at, last] = ["layer", "line", "along", "at", "last"].map(word => registers.number(word));
        this.useFrame(registers.frameNumber(pallet.frame, step), step.id);
        for (const own of [origin, present])
            for (const each of registers.values(own, xyzwpr(first)))
                add(each);
        add(`FOR ${layer}=0 TO ${pallet.layers - 1}`);
        add(`FOR ${line}=0 TO ${lines - 1}`);
        add(isShifted ? `${last}=(${inLine - 1}-${line} MOD 2)` : `${last}=${inLine - 1}`);
        add(`FOR ${along}=0 TO ${last}`);
        add(`${at}=${along}`);
        if (isZigzag)
            for (const each of [`IF (${line} MOD 2=1) THEN`, `${at}=(${last}-${along})`, "ENDIF"])
                add(each);
        for (const [i, text] of xyzwpr(first).slice(0, 3).entries()) {
            // Packed rows count in half pitches, so that both are the same number.
            const inLine = isShifted ? pitchTerm(along_m[i] / 2, `(2*${at}+${line} MOD 2)`, fine) : pitchTerm(along_m[i], at, fine);
            add(`${element(present, i + 1)}=(${text}${inLine}${pitchTerm(away_m[i], line, fine)}${pitchTerm(up_m[i], layer, fine)})`);
        }
        add(`${offset}=${present}-${origin}`);
        this.visits.set(step.pallet, { first, frame: pallet.frame, offset });
        this.block(step.steps);
        this.visits.delete(step.pallet);
        for (let i = 0; i < 3; i++)
            add("ENDFOR");
        this.begin();
    }
    // --- lines ------------------------------------------------------------------------------------------------------
    lineOf(signal, step) {
        const { signals } = this.place.program;
        if (!Object.hasOwn(signals, signal))
            throw new CannotSay(step.id, `${called(step)} uses the line ${signal}, which is not in the list of signals.`, "Add it to the list.");
        const { kind, address } = signals[signal];
        if (address === undefined && /^(RI|RO|UI|UO|SI|SO)\[[0-9]+\]$/.test(signal))
            return { text: signal, kind };
        if (address === undefined || address < 1)
            throw new CannotSay(step.id, `${called(step)} uses the line ${signal}, whose number on the controller is not given.`, "Give it its number: lines of FANUC count from 1.");
        return { text: labelled(SHORT[kind], address, signal), kind };
    }
    set(step, add) {
        const { text, kind } = this.lineOf(step.signal, step), { to } = step;
        if (kind.endsWith("in"))
            throw new CannotSay(step.id, `${called(step)} writes the line ${step.signal}, which is an input.`, "Choose an output.");
        if (kind.startsWith("digital") !== (typeof to === "boolean"))
            throw new CannotSay(step.id, `${called(step)} writes ${String(to)} to the line ${step.signal}, which is ${kind}.`, "Choose a value of that line.");
        if (typeof to === "number")
            return add(`${text}=${fixed(to, 6)}`);
        if (step.pulse_s === undefined)
            return add(`${text}=${to ? "ON" : "OFF"}`);
        if (!to)
            throw new CannotSay(step.id, `${called(step)} is a pulse that goes off; PULSE goes on.`, "Turn the sense of the line in the controller.");
        add(`${text}=PULSE,${fixed(step.pulse_s, 2)}sec`);
    }
    waitFor(step, add) {
        const when = this.condition(step.when, step);
        if (step.timeout_s === undefined)
            return add(`WAIT ${when}`);
        // Hundredths of a second.
        add(`$WAITTMOUT=${Math.round(step.timeout_s * 100)}`);
        add(`WAIT ${when} TIMEOUT,LBL[${this.out.abortLabel()}]`);
    }
    condition(when, step) {
        const { text, kind } = this.lineOf(when.signal, step);
        if ("is" in when !== kind.startsWith("digital"))
            throw new CannotSay(step.id, `${called(step)} asks the line ${when.signal} for what it cannot answer.`, "Ask a digital line whether it is on, an analogue one for a limit.");
        if ("is" in when)
            return `${text}=${when.is ? "ON" : "OFF"}`;
        return "above" in when ? `${text}>${fixed(when.above, 6)}` : `${text}<${fixed(when.below, 6)}`;
    }
    seconds(step, s) {
        if (s > LONGEST_WAIT_S)
            throw new CannotSay(step.id, `${called(step)} waits ${s} s; WAIT goes up to ${LONGEST_WAIT_S} s.`, "Wait twice, or for a signal.");
        return s.toFixed(2).padStart(6);
    }
    // --- moves ------------------------------------------------------------------------------------------------------
    useFrame(number, step) {
        if (number !== this.frame)
            this.out.add(`UFRAME_NUM=${number}`, step);
        this.frame = number;
    }
    useTool(number, step) {
        if (number !== this.tool)
            this.out.add(`UTOOL_NUM=${number}`, step);
        this.tool = number;
    }
    move(step, next) {
        const { target, path, id } = step, isAngles = path === "ptp" && "q" in target, { registers } = this;
        const posture = this.place.posture(step, isAngles ? target : this.reached(target), this.near);
        this.near = posture ?? this.near;
        const frame = "q" in target ? "world" : target.frame, visit = this.visits.get(frame);
        this.useFrame(registers.frameNumber(visit?.frame ?? frame, step), id);
        this.useTool(isAngles && target.tool === undefined && this.tool !== undefined ? this.tool : registers.toolNumber(target.tool ?? "flange", step), id);
        const record = (values, config) => `P[${this.out.position({ uf: this.frame, ut: this.tool, step: id, values, ...(config === undefined ? {} : { config }) })}]`;
        const options = `${this.term(step, next)}${this.acceleration(step)}${visit === undefined ? "" : ` Offset,${visit.offset}`}`;
        if (isAngles)
            return this.out.motion(`J ${record(pendantJoints(target.q, this.convention))} ${this.percent(step)} ${options}`, id);
        const config = configOf(this.place.robot, posture ?? this.place.robot.home_rad), goal = record(xyzwpr(this.inFrame(target, frame)), config);
        const search = this.search(step);
        if (path === "ptp")
            this.out.motion(`J ${goal} ${this.percent(step)} ${options}${search}`, id);
        else if (path === "lin")
            this.out.motion(`L ${goal} ${this.path(step)} ${options}${search}`, id);
        else {
            if (step.via === undefined)
                throw new CannotSay(id, `${called(step)} has no point to pass through.`, "Teach the point on the arc.");
            const via = record(xyzwpr(this.inFrame(step.via, frame)), config);
            this.out.motion(`C ${via}${visit === undefined ? "" : ` Offset,${visit.offset}`}\n${goal} ${this.path(step)} ${options}${search}`, id);
        }
        if (search !== "" && step.until.missing === "continue")
            this.out.add(`LBL[${/LBL\[(\d+)/.exec(search)[1]}]`, id);
    }
    /** Off a joint move only the tool's pose is written: of taught angles the posture is kept. */
    reached(target) {
        const branch = "q" in target ? branchOf(this.place.robot, target.q) : undefined;
        if (!("q" in target) || branch === undefined)
            return target;
        return { pose: compose(compose(pose(), this.place.worldFromBase), this.place.tip(target)), frame: "world", tool: target.tool ?? "flange", branch };
    }
    /** A target as it is seen from the frame whose digits are written. */
    inFrame(target, frame) {
        const visit = this.visits.get(frame), { registers, place } = this;
        if (visit !== undefined && "pose" in target && target.frame === frame)
            return compose(visit.first, compose(pose(), target.pose));
        return compose(inverse(registers.baseFromFrame(visit?.frame ?? frame)), place.tip(target));
    }
    percent({ speed }) {
        const ratio = "ratio" in speed ? speed.ratio : "mps" in speed ? speed.mps / this.place.robot.maxTcpSpeed_mps : 1;
        return `${Math.min(100, Math.max(1, Math.round(100 * ratio)))}%`;
    }
    path({ speed }) {
        const v_mmps = 1000 * ("mps" in speed ? speed.mps : "ratio" in speed ? speed.ratio * this.place.robot.maxTcpSpeed_mps : 0);
        if (v_mmps > this.fastest_mmps)
            this.warnings.add(`Speeds of paths end at ${this.fastest_mmps} mm/s.`);
        return `${Math.min(this.fastest_mmps, Math.max(1, Math.round(v_mmps)))}mm/sec`;
    }
    acceleration(step) {
        const ratio = step.acceleration?.ratio ?? 1;
        return ratio === 1 ? "" : ` ACC${Math.max(1, Math.round(100 * ratio))}`;
    }
    /** CNT as a share of the shorter neighbouring half path. Before anything that is not a motion the robot stands. */
    term(step, next) {
        const { blend_m, blend_ratio = 0 } = step;
        if (step.until !== undefined || next?.type !== "move" || !(blend_m > 0 || blend_ratio > 0))
            return "FINE";
        const whole_m = this.place.blend_m({ ...step, blend_m: 0, blend_ratio: 1 }, this.before, next), share = blend_ratio > 0 ? blend_ratio : whole_m > 0 ? blend_m / whole_m : 1;
        return `CNT${Math.min(100, Math.max(1, Math.round(100 * share)))}`;
    }
    search(step) {
        if (step.until === undefined)
            return "";
        this.out.add(`SKIP CONDITION ${this.condition(step.until.when, step)}`, step.id);
        return ` Skip,LBL[${step.until.missing === "fault" ? this.out.abortLabel() : this.out.label()}]`;
    }
}
const element = (register, i) => register.replace(/(?=[:\]])/, `,${i}`).replace(/:[^\]]*/, "");
/** A text in lines of at most so many characters, broken between words where that goes. */
function inLines(text, most) {
    const lines = [];
    for (let rest = text; rest !== "" || lines.length === 0;) {
        const cut = rest.length <= most ? rest.length : rest.lastIndexOf(" ", most) > 0 ? rest.lastIndexOf(" ", most) : most;
        lines.push(rest.slice(0, cut).trim());
        rest = rest.slice(cut).trim();
    }
    return lines;
}
