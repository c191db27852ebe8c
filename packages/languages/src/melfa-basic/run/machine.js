import { TextError } from "../../text/index.ts";
import { BasicMachine, NOWHERE, back, between, moved, numberIn, on, placeIn, rigid, sixNumbers } from "../../text/basic/index.ts";
/** All joints 0 stands straight up; joint 2 leans forwards, joint 3 folds forwards. */
const ARMS = {
    mitsubishi_rv7fl: { ahead_mm: 0, upper_mm: 435, fore_mm: 470, offset_mm: -50, lean: ([, j2]) => j2, fold: ([, , j3]) => j3 },
};
export const hasMelfa = (id) => Object.hasOwn(ARMS, id);
const FIRST = { speed: { ratio: 1 }, pathSpeed: { ratio: 1 }, acceleration: 1, passes_mm: undefined, base: NOWHERE };
const JOINTS = 6;
/** How near a point is passed when Cnt says no distance [mm]. */
const UNSAID_MM = 10;
/** Places that are closer are one [mm]. */
const SAME_MM = 0.01;
const RIGHT = 4, ABOVE = 2, NONFLIP = 1;
/** Executes MELFA-BASIC statement by statement. */
export class MelfaMachine extends BasicMachine {
    truth = 1;
    constructor(stage) { super(stage, ARMS[stage.robot.id], FIRST); }
    known(name) {
        switch (name) {
            case "p_curr": return this.placed(this.arm.here());
            case "p_zero":
            case "p_nbase":
            case "p_ntool": return this.placed(NOWHERE);
            case "m_pi": return Math.PI;
            case "m_nspd":
            case "m_novrd":
            case "m_njovrd": return 100;
            default: return undefined;
        }
    }
    lineIn(expression) {
        if (expression.kind !== "call" || expression.args[0]?.value === undefined)
            return undefined;
        return expression.name === "m_in" ? this.line(expression.args[0].value, "digital-in") : expression.name === "m_out" ? this.line(expression.args[0].value, "digital-out") : undefined;
    }
    applied(call) {
        const { name, args } = call, numbers = name === "inv" || name === "jtop" ? [] : this.numbers(args.filter(({ name: mark }) => mark === undefined)), [x = 0, y = 0, z = 0, a = 0, b = 0, c = 0] = numbers;
        switch (name) {
            case "position": {
                const flag = args.find(({ name: mark }) => mark === "flag")?.value, turned = { kind: "place", at: rigid([x, y, z, a, b, c]), frame: "" };
                return flag === undefined ? turned : { ...turned, posture: postureOf(this.numberOf(flag)) };
            }
            case "joints": return { kind: "joints", deg: Array.from({ length: JOINTS }, (_, i) => numbers[i] ?? 0) };
            // Angles that are computed are in radians.
            case "setpos": return this.placed(rigid([x, y, z, a / DEG, b / DEG, c / DEG]));
            case "setjnt": return { kind: "joints", deg: Array.from({ length: JOINTS }, (_, i) => (numbers[i] ?? 0) / DEG) };
            case "jtop": {
                const of = args[0]?.value, joints = of === undefined ? undefined : this.evaluate(of);
                if (typeof joints !== "object" || joints.kind !== "joints")
                    throw new TextError(call, "joint angles", "JtoP takes joint angles.");
                return this.placed(this.arm.atAngles(joints.deg));
            }
            case "inv": {
                const of = placeIn(args[0]?.value === undefined ? 0 : this.evaluate(args[0].value), call);
                return { ...of, at: back(of.at) };
            }
            default: break;
        }
        const kept = this.variable(this.keyOf(call)), run = FUNCTIONS[name];
        if (kept !== undefined)
            return kept;
        if (run === undefined)
            throw new TextError(call, "a function of MELFA-BASIC", `"${name}" is no function that is understood here.`);
        return run(x, y);
    }
    /** `*` goes on from the left position, `/` goes back by the right one, `+` and `-` add the numbers. The posture is the left one's. */
    joined(sign, left, right, of) {
        if (typeof left !== "object" || left.kind !== "place")
            return undefined;
        const other = placeIn(right, of.right);
        if (sign === "+" || sign === "-") {
            const factor = sign === "+" ? 1 : -1, a = sixNumbers(left.at), b = sixNumbers(other.at), isTurned = b.slice(3).some(angle => Math.abs(angle) > 1e-9);
            return { ...this.unbound(left), at: isTurned ? rigid(a.map((value, i) => value + factor * b[i])) : moved(left.at, factor * b[0], factor * b[1], factor * b[2]) };
        }
        if (sign !== "*" && sign !== "/")
            return undefined;
        const step = sign === "*" ? other.at : back(other.at), variable = of.left.kind === "variable" && (this.places.has(of.left.name) || this.constants.has(of.left.name)) ? of.left.name : undefined;
        const within = variable !== undefined ? { variable, of: left.at, at: step } : left.within === undefined ? undefined : { ...left.within, at: on(left.within.at, step) };
        return { ...left, at: on(left.at, step), ...(within === undefined ? {} : { within }) };
    }
    component(of, name, at) {
        if (typeof of === "object" && of.kind === "joints" && /^j[1-6]$/.test(name))
            return of.deg[Number(name[1]) - 1] * DEG;
        const i = AXES.indexOf(name);
        if (i < 0)
            throw new TextError(at, AXES.join(", ").toUpperCase(), `A position has no component ${name}.`);
        const value = sixNumbers(placeIn(of, at).at)[i];
        return i < 3 ? value : value * DEG;
    }
    /** `P1.X = 5` changes one number of a position. */
    store(to, value) {
        if (to.kind !== "component")
            return super.store(to, value);
        const i = AXES.indexOf(to.name), of = this.unbound(placeIn(this.evaluate(to.of), to)), number = numberIn(value, to);
        if (i < 0)
            throw new TextError(to, AXES.join(", ").toUpperCase(), `The component ${to.name} of a position is not changed here.`);
        super.store(to.of, { ...of, at: i < 3 ? of.at.with(4 * i + 3, number) : rigid(sixNumbers(of.at).with(i, number / DEG)) });
    }
    steps(statement) {
        const { name, args } = statement, id = () => this.stepId(statement), [first = 0, second] = name === "tool" || name === "base" || name === "m_out" || name.startsWith("mv") || name === "mov" ? [] : this.numbers(args);
        switch (name) {
            // All motions are slowed by it, which a step says of itself.
            case "ovrd":
                between(first, 0.01, 100, "a percentage", statement);
                return [];
            case "jovrd":
                this.state = { ...this.state, speed: { ratio: between(first, 0.01, 100, "a percentage", statement) / 100 } };
                return [];
            case "spd":
                this.state = { ...this.state, pathSpeed: { mps: between(first, 0.01, 100_000, "a speed", statement) / 1000 } };
                return [];
            case "accel":
                this.state = { ...this.state, acceleration: Math.min(1, between(first, 0, 1000, "a percentage", statement) / 100) };
                return [];
            case "cnt":
                this.state = { ...this.state, passes_mm: first === 0 ? undefined : second ?? UNSAID_MM };
                return [];
            case "dly": return [{ id: id(), type: "wait", s: between(first, 0, Number.MAX_VALUE, "a time", statement) }];
            case "hopen":
            case "hclose": return [{ id: id(), type: "gripper", closed: name === "hclose" }];
            case "m_out": return [this.output(statement, id())];
            case "tool": {
                const of = args[0].value, place = placeIn(this.evaluate(of), of), isNone = of.kind === "variable" && (of.name === "p_ntool" || of.name === "p_zero");
                this.useTool(place.at, isNone ? undefined : of.kind === "variable" ? of.name : "tool");
                return [];
            }
            // Where the robot stands in the world that positions count in.
            case "base":
                this.state = { ...this.state, base: placeIn(this.evaluate(args[0].value), statement).at };
                return [];
            case "mov": return [this.moveTo(statement, "ptp")];
            case "mvs": return [this.moveTo(statement, "lin")];
            case "mvr": return this.arc(statement);
            default: throw new TextError(statement, "a statement of MELFA-BASIC", `"${name}" is not understood here.`);
        }
    }
    output({ args, line, column }, id) {
        const [of, to, time] = args.map(({ value }) => value), number = of?.kind === "call" ? of.args[0]?.value : undefined;
        if (number === undefined || to === undefined)
            throw new TextError({ line, column }, "M_Out(n)", "The number of the output is missing.");
        return this.set(this.line(number, "digital-out"), this.numberOf(to) !== 0, id, time === undefined ? undefined : this.numberOf(time));
    }
    where(of, at) {
        const value = of === undefined ? this.placed(this.arm.here()) : this.evaluate(of);
        if (typeof value === "object" && value.kind === "place" && this.state.base !== NOWHERE && value.within === undefined)
            return { ...value, at: on(back(this.state.base), value.at) };
        if (typeof value !== "object")
            throw new TextError(at, "a position", "A number is no position to move to.");
        return value;
    }
    moveTo(statement, path) {
        const [first, away] = statement.args, goal = this.where(first?.value, statement), isJoint = path === "ptp";
        const place = away?.value === undefined ? goal : this.beside(placeIn(goal, statement), this.numberOf(away.value));
        return this.move(statement, path, this.go(place, isJoint, true, statement), this.manner(isJoint));
    }
    /** Along the z of the hand from a position. */
    beside(of, away_mm) {
        const step = rigid([0, 0, away_mm, 0, 0, 0]);
        return { ...of, at: on(of.at, step), ...(of.within === undefined ? {} : { within: { ...of.within, at: on(of.within.at, step) } }) };
    }
    /** From the first of three positions, to which the hand goes straight if it is not there, through the second to the third. */
    arc(statement) {
        const [from, via, to] = statement.args.map(({ value }) => value);
        if (from === undefined || via === undefined || to === undefined)
            throw new TextError(statement, "three positions", "Mvr takes three positions.");
        const start = placeIn(this.where(from, statement), statement), here = this.arm.here(), away = this.inBase(start), steps = [];
        if (Math.hypot(away[3] - here[3], away[7] - here[7], away[11] - here[11]) > SAME_MM)
            steps.push(this.move(statement, "lin", this.go(start, false, true, statement), { ...this.manner(false), blend_m: 0 }));
        const middle = this.passing(this.where(via, statement), statement);
        steps.push(this.move(statement, "circ", this.go(this.where(to, statement), false, true, statement), { via: middle, ...this.manner(false) }));
        return steps;
    }
    manner(isJoint) {
        const { speed, pathSpeed, acceleration, passes_mm } = this.state;
        return { speed: isJoint ? speed : pathSpeed, ...(acceleration < 1 ? { acceleration: { ratio: acceleration } } : {}), blend_m: (passes_mm ?? 0) / 1000 };
    }
}
const AXES = ["x", "y", "z", "a", "b", "c"];
const DEG = Math.PI / 180;
/** 7 is right, above, not flipped. */
const postureOf = (flag) => ({ front: (flag & RIGHT) !== 0, bent: (flag & ABOVE) !== 0, wrist: (flag & NONFLIP) !== 0 });
/** Angles in radians. */
const FUNCTIONS = {
    sin: Math.sin, cos: Math.cos, tan: Math.tan, atn: Math.atan, atn2: Math.atan2, sqr: Math.sqrt, abs: Math.abs, int: Math.floor, fix: Math.trunc, sgn: Math.sign, rad: x => x * DEG, deg: x => x / DEG, min: Math.min, max: Math.max,
};
