import type { Executed, MoveStep, Pose, Speed, Step, Target, TextPlace } from "@twincell/core";
import {
  NotGiven,
  TextError,
  missingProgram,
  nameIn,
  rememberMap,
  times,
  type Matrix,
  type Notices,
} from "../../parser/index.ts";
import { type Do, type Expression, type Flow, type WaitUntil } from "../../parser/structured/index.ts";
import { MOTIONS, SPEED_UNITS } from "../read/words.ts";
import { type Posture } from "./arm.ts";
import { NULL, shifted, toPose, trans } from "./frame.ts";
import { numbersOf } from "./functions.ts";
import { holds } from "./lines.ts";
import { asPlace, isUnknown, kindOf, type PlaceValue, type Value } from "./values.ts";
import { Evaluation, type Setting } from "./evaluation.ts";

const FIRST_PULSE_S = 0.2;

/** Executes AS statement by statement. */
export class Machine extends Evaluation {
  protected *waitUntil(statement: WaitUntil): Generator<Executed, void> {
    const when = this.condition(statement.when);
    if (this.notices !== undefined && when === undefined) return yield* this.waitAsText(statement, this.notices);
    if (when === undefined)
      throw new TextError(
        statement.when,
        "one line that is waited for",
        "Only a wait for one line can be carried out.",
      );
    if (this.outputs.has(when.signal) && !holds(when, { read: line => this.read(line) }))
      throw new TextError(
        statement.when,
        "a condition that comes true",
        "The program waits for an output that nothing here changes.",
      );
    yield this.done(statement, { id: this.stepId(statement), type: "wait-for", when });
  }

  placeIn(variable: string): { readonly frame: string; readonly pose: Pose<"frame", "place"> } | undefined {
    const value = this.variable(variable);
    return typeof value === "object" && value.kind === "place" ? this.poseOf<"place">(value) : undefined;
  }

  edge(): void {
    this.hasTool = false;
  }

  override remember(): () => void {
    const values = super.remember();
    const arm = this.arm.remember();
    const outputs = rememberMap(this.outputs);
    const { tool, hasTool, baseName, posture: configuration, via, passes } = this;
    const speed = { ...this.speed };
    const accuracy = { ...this.accuracy };
    const acceleration = { ...this.acceleration };
    return () => {
      values();
      arm();
      outputs();
      Object.assign(this, {
        tool,
        hasTool,
        baseName,
        posture: configuration,
        via,
        passes,
        speed: { ...speed },
        accuracy: { ...accuracy },
        acceleration: { ...acceleration },
      });
    };
  }

  /** A wait for what is no single line: over at once where it is so, and else told. */
  private *waitAsText(statement: WaitUntil, notices: Notices): Generator<Executed, void> {
    if (!this.isTrue(statement.when))
      notices.add(
        statement,
        "a condition of one line",
        `Line ${statement.line} waits for what nothing here makes true: the program goes on as if it were.`,
      );
    yield { line: statement.line };
  }

  /** What only the controller knows is left out and told; the arm is then somewhere. */
  private lenient(statement: Do, act: () => Step[]): Step[] {
    if (this.notices === undefined) return act();
    try {
      return act();
    } catch (cause) {
      if (!(cause instanceof NotGiven)) throw cause;
      const { message } = cause;
      if (MOTIONS.has(statement.name) || statement.name === "away") {
        this.notices.notGiven(statement, `${message}: the motion is not executed.`);
        this.arm.isLost = true;
        this.via = undefined;
      } else this.notices.notGiven(statement, `${message}: line ${statement.line} is not executed.`);
      return [];
    }
  }

  protected *instruction(statement: Do): Generator<Executed, Flow | undefined> {
    const steps = this.lenient(statement, () => this.steps(statement));
    for (const step of steps) yield this.done(statement, step);
    if (steps.length === 0) yield { line: statement.line };
    return undefined;
  }

  /** What is not executed: a place of the controller, a fault of a program that is called, values from outside. */
  private leftOut({ name, args, ...at }: Do): boolean {
    if (name === "received") {
      for (const { value } of args) if (value !== undefined) this.forget(value);
      return true;
    }
    const said = (i: number): string => String(args[i]?.value === undefined ? "" : this.evaluate(args[i].value));
    if (name === "away") throw new NotGiven(at, "a place", `${said(0)} is in none of the files`);
    if (name === "fault") throw new TextError(at, said(0), said(1));
    return false;
  }

  private steps(statement: Do): Step[] {
    const { name, args } = statement;
    if (this.leftOut(statement)) return [];
    if (MOTIONS.has(name)) {
      const step = this.motion(statement);
      return step === undefined ? [] : [step];
    }
    const value = (i: number): Value | undefined => {
      const { value: of, name: mark } = args[i] ?? {};
      return of === undefined || mark !== undefined ? undefined : this.evaluate(of);
    };
    const number = (i: number, what: string): number => {
      const found = value(i);
      if (found === undefined) throw new TextError(statement, what, `${name.toUpperCase()} is said without ${what}.`);
      return this.number(found, args[i]!);
    };
    const isAlways = args.some(({ name: mark }) => mark === "always");
    const set = <T>(setting: Setting<T>, to: T): void => {
      setting.once = isAlways ? undefined : to;
      if (isAlways) setting.always = to;
    };
    switch (name) {
      case "speed":
        if (this.notices !== undefined && isUnknown(value(0))) {
          this.notices.notGiven(statement, "The speed is in none of the files: it stays as it was.");
          return [];
        }
        set(
          this.speed,
          this.speedOf(number(0, "a speed"), args.find(({ name: mark }) => mark === "unit")?.value, statement),
        );
        return [];
      case "accuracy":
        set(this.accuracy, atLeast0(number(0, "a distance"), statement));
        return [];
      case "accel":
        set(this.acceleration, Math.min(1, atLeast0(number(0, "a percentage"), statement) / 100));
        return [];
      // The neutral program has one number for both: the one of ACCEL.
      case "decel":
        number(0, "a percentage");
        return [];
      case "break":
      case "mon_speed":
        return [];
      case "switch":
        if (value(0) === "cp") this.passes = number(1, "ON or OFF") !== 0;
        return [];
      case "tool":
        this.setTool(args[0]?.value, statement);
        return [];
      case "base":
        this.setBase(args[0]?.value, statement);
        return [];
      default:
        return this.posturesAndGrippers(statement);
    }
  }

  /** Postures, variables, waits and grippers. */
  private posturesAndGrippers(statement: Do): Step[] {
    const { name, args } = statement;
    const id = (): string => this.stepId(statement);
    const value = (i: number): Value | undefined => {
      const { value: of, name: mark } = args[i] ?? {};
      return of === undefined || mark !== undefined ? undefined : this.evaluate(of);
    };
    const number = (i: number, what: string): number => {
      const found = value(i);
      if (found === undefined) throw new TextError(statement, what, `${name.toUpperCase()} is said without ${what}.`);
      return this.number(found, args[i]!);
    };
    switch (name) {
      case "lefty":
      case "righty":
        this.posture = { ...this.posture, arm: name };
        return [];
      case "above":
      case "below":
        this.posture = { ...this.posture, elbow: name };
        return [];
      case "uwrist":
      case "dwrist":
        this.posture = { ...this.posture, wrist: name };
        return [];
      case "here":
      case "decompose":
        this.keep(statement);
        return [];
      case "twait":
      case "delay":
      case "stable":
        return [{ id: id(), type: "wait", s: atLeast0(number(0, "a time"), statement) }];
      case "openi":
      case "open":
        return [{ id: id(), type: "gripper", closed: false }];
      case "closei":
      case "close":
        return [{ id: id(), type: "gripper", closed: true }];
      default:
        return this.linesAndMessages(statement);
    }
  }

  /** Lines, loads and messages. */
  private linesAndMessages(statement: Do): Step[] {
    const { name, args } = statement;
    const id = (): string => this.stepId(statement);
    const value = (i: number): Value | undefined => {
      const { value: of, name: mark } = args[i] ?? {};
      return of === undefined || mark !== undefined ? undefined : this.evaluate(of);
    };
    const number = (i: number, what: string): number => {
      const found = value(i);
      if (found === undefined) throw new TextError(statement, what, `${name.toUpperCase()} is said without ${what}.`);
      return this.number(found, args[i]!);
    };
    switch (name) {
      case "signal":
        return args.flatMap(({ value: of }) => (of === undefined ? [] : [this.write(of, id())]));
      case "pulse": {
        const line = args[0]?.value;
        if (line === undefined) throw new TextError(statement, "an output", "PULSE is said without an output.");
        return [
          {
            ...this.write(line, id()),
            pulse_s: args.length > 1 ? atLeast0(number(1, "a time"), statement) : FIRST_PULSE_S,
          },
        ];
      }
      case "weight": {
        const [mass = 0, x = 0, y = 0, z = 0, ...inertia] = args.map((_, i) => number(i, "a number"));
        const [ixx = 0, iyy = 0, izz = 0] = inertia;
        return [
          {
            id: id(),
            type: "payload",
            mass_kg: mass,
            center_m: [x / 1000, y / 1000, z / 1000],
            ...(inertia.length === 0 ? {} : { inertia_kgm2: [ixx, iyy, izz, 0, 0, 0] }),
          },
        ];
      }
      case "print":
      case "type":
        return [
          {
            id: id(),
            type: "message",
            text: args
              .map((_, i) => {
                const said = value(i);
                return typeof said === "object" ? "" : String(said ?? "");
              })
              .join(""),
          },
        ];
      default: {
        const called = name.startsWith("call ") ? name.slice(5) : undefined;
        if (called !== undefined) throw missingProgram(statement, called);
        throw new TextError(statement, "a statement of AS", `${name.toUpperCase()} is not understood here.`);
      }
    }
  }

  private speedOf(value: number, unit: Expression | undefined, at: TextPlace): Speed {
    if (!(value > 0)) throw new TextError(at, "a speed above 0", `The speed is ${value}.`);
    if (unit === undefined) return { ratio: Math.min(1, value / 100) };
    const factor = unit.kind === "text" ? (SPEED_UNITS[unit.value] ?? 0) : 0;
    return factor > 0 ? { mps: (value * factor) / 1000 } : { time_s: value };
  }

  /** What comes from outside has no value that is known. */
  private forget(to: Expression): void {
    if (to.kind !== "variable") return;
    const value: Value = { kind: "unknown", name: to.name };
    this.store(to, value);
    this.store({ ...to, name: `${to.name}[]` }, value);
  }

  private write(line: Expression, id: string): Extract<Step, { type: "set" }> {
    const { signal, is } = this.lineOf(line, "digital-out");
    if (this.declared.signals[signal]!.kind !== "digital-out")
      throw new TextError(line, "an output", `${signal} is an input, which no program sets.`);
    this.outputs.set(signal, is);
    return { id, type: "set", signal, to: is };
  }

  /** `HERE a`, and `DECOMPOSE x[1] = a`, which puts the numbers of a place one after the other. */
  private keep({ name, args, line, column }: Do): void {
    const to = args[0]?.value;
    const of = args[1]?.value;
    if (to === undefined || (name === "decompose" && of === undefined))
      throw new TextError({ line, column }, "a variable", `${name.toUpperCase()} is said without a variable.`);
    if (name === "here" || of === undefined) return this.store(to, this.placeHere());
    if (to.kind !== "index" || to.indices.length !== 1)
      throw new TextError(to, "the first of several variables, as x[0]", "DECOMPOSE fills variables that are counted.");
    const first = this.numberOf(to.indices[0]!);
    for (const [i, value] of numbersOf(this.evaluate(of), of).entries())
      this.store({ ...to, indices: [{ kind: "number", value: first + i, line, column }] }, value);
  }

  private placeHere(): Value {
    return this.arm.isLost ? { kind: "unknown", name: "Where the robot is" } : { kind: "place", at: this.arm.here() };
  }

  private setTool(of: Expression | undefined, at: TextPlace): void {
    if (of === undefined) throw new TextError(at, "a transformation", "TOOL is said without a transformation.");
    const given = this.evaluate(of);
    if (this.notices !== undefined && (isUnknown(given) || typeof given === "number")) {
      const name = isUnknown(given) ? given.name : `TOOL ${given}`;
      this.notices.notGiven(at, `${name} is in none of the files: it is taken to be the flange.`);
      this.arm.tool = NULL;
      this.tool = "flange";
      this.hasTool = true;
      return;
    }
    this.arm.tool = asPlace(given, of).at;
    this.hasTool = true;
    const isNull = (of.kind === "variable" && of.name === "null") || this.arm.tool === NULL;
    this.tool = isNull
      ? "flange"
      : nameIn(this.declared.tools, toPose(this.arm.tool), of.kind === "variable" ? of.name : "tool", "_");
  }

  private setBase(of: Expression | undefined, at: TextPlace): void {
    if (of === undefined) throw new TextError(at, "a transformation", "BASE is said without a transformation.");
    const given = this.evaluate(of);
    if (this.notices !== undefined && isUnknown(given))
      this.notices.notGiven(at, `${given.name} is in none of the files: it is taken to be the base of the robot.`);
    const base = this.notices !== undefined && isUnknown(given) ? NULL : asPlace(given, of).at;
    const name = of.kind === "variable" ? of.name : "base";
    this.arm.base = NULL;
    this.baseName = base === NULL ? undefined : nameIn(this.declared.frames, this.arm.inWorld(base), name, "_");
    this.arm.base = base;
  }

  private motion(statement: Do): MoveStep | undefined {
    const { name, args } = statement;
    const path = name.startsWith("c")
      ? "circ"
      : name.startsWith("j") || name === "drive" || name === "taught"
        ? "ptp"
        : "lin";
    const { at: goal, place } = this.goal(statement);
    const { posture: configuration } = this;
    this.posture = {};
    const target = this.target(goal, path === "ptp" ? configuration : undefined, place);
    if (typeof goal !== "object" || goal.kind !== "joints") this.arm.atPlace(asPlace(goal, statement).at);
    else if (path === "ptp") this.arm.atJoints(goal.deg);
    else this.arm.atPlace(this.arm.placeOf(goal.deg));
    if (name === "c1move") {
      this.via = target;
      return undefined;
    }
    const { via } = this;
    const passes = this.passes && !args.some(({ name: mark }) => mark === "break");
    this.via = undefined;
    if (name === "c2move" && via === undefined)
      throw new TextError(statement, "C1MOVE before it", "C2MOVE ends an arc of which no C1MOVE said the middle.");
    const take = <T>(setting: Setting<T>): T => {
      const { once, always } = setting;
      setting.once = undefined;
      return once ?? always;
    };
    const speed = take(this.speed);
    const accuracy = take(this.accuracy);
    const acceleration = take(this.acceleration);
    return {
      id: this.stepId(statement),
      type: "move",
      path,
      target,
      ...(via === undefined || path !== "circ" ? {} : { via }),
      speed,
      ...(acceleration < 1 ? { acceleration: { ratio: acceleration } } : {}),
      blend_m: passes && name !== "xmove" ? accuracy / 1000 : 0,
      ...(name === "xmove" ? { until: this.till(statement) } : {}),
    };
  }

  /** The line at which XMOVE ends before its place. */
  private till({ args, ...at }: Do): NonNullable<MoveStep["until"]> {
    const line = args.filter(({ name }) => name === undefined)[1]?.value;
    if (line === undefined) throw new TextError(at, "TILL and a line", "XMOVE is said without the line that ends it.");
    return { when: this.lineOf(line), missing: "continue" };
  }

  /** Where a motion goes. */
  private goal(statement: Do): { readonly at: Value; readonly place: TextPlace } {
    const { name } = statement;
    const args = statement.args.filter(({ name: mark }) => mark === undefined);
    const first = args[0];
    if (first?.value === undefined)
      throw new TextError(statement, "a location", `${name.toUpperCase()} is said without a location.`);
    const number = (i: number): number => {
      const of = args[i]?.value;
      return of === undefined ? 0 : this.numberOf(of);
    };
    const at = (place: Matrix): { readonly at: Value; readonly place: TextPlace } => ({
      at: { kind: "place", at: place },
      place: first,
    });
    switch (name) {
      case "jappro":
      case "lappro":
        return at(times(this.placeOf(first.value), trans([0, 0, -number(1), 0, 0, 0])));
      case "jdepart":
      case "ldepart":
        return at(times(this.hereFor(statement), trans([0, 0, -number(0), 0, 0, 0])));
      case "draw": {
        if (args.length > 3) throw new TextError(first, "three lengths", "DRAW with angles is not executed here.");
        return at(shifted(this.hereFor(statement), number(0), number(1), number(2)));
      }
      case "tdraw":
        return at(times(this.hereFor(statement), trans([number(0), number(1), number(2), 0, 0, 0])));
      case "drive":
        throw new TextError(
          statement,
          "a motion to a location",
          "DRIVE turns a joint on from where it is, which is not executed here.",
        );
      default:
        return { at: this.evaluate(first.value), place: first };
    }
  }

  private placeOf(of: Expression): Matrix {
    const value = this.evaluate(of);
    return typeof value === "object" && value.kind === "joints" ? this.arm.placeOf(value.deg) : asPlace(value, of).at;
  }

  private target(goal: Value, configuration: Posture | undefined, at: TextPlace): Target {
    const { tool } = this;
    if (isUnknown(goal)) throw new NotGiven(at, "a location", `${goal.name} is in none of the files`);
    if (typeof goal !== "object" || goal.kind === "row")
      throw new TextError(
        at,
        "a location",
        `${kindOf(goal).replace(/^./, letter => letter.toUpperCase())} is no place to move to.`,
      );
    if (goal.kind === "joints")
      return { q: this.arm.axes.radians(goal.deg), ...(configuration !== undefined && !this.hasTool ? {} : { tool }) };
    if (configuration === undefined || Object.keys(configuration).length === 0) return { ...this.poseOf(goal), tool };
    const branch = this.arm.branchAt(goal.at, configuration);
    if (branch === undefined)
      throw new TextError(
        at,
        "a place that is reached so",
        `The place cannot be reached ${Object.values(configuration).join(", ").toUpperCase()}.`,
      );
    return { ...this.poseOf(goal), tool, branch };
  }

  private poseOf<From extends string = "tcp">({
    at,
    inFrame,
  }: PlaceValue): { readonly pose: Pose<"frame", From>; readonly frame: string } {
    if (inFrame !== undefined) {
      const { frame } = inFrame;
      const { frames } = this.declared;
      if (!this.places.has(frame)) frames[frame] ??= this.arm.inWorld(inFrame.of);
      return { pose: toPose(inFrame.at), frame };
    }
    return this.baseName === undefined
      ? { pose: this.arm.inWorld(at), frame: "world" }
      : { pose: toPose(at), frame: this.baseName };
  }
}

function atLeast0(value: number, at: TextPlace): number {
  if (value >= 0) return value;
  throw new TextError(at, "a value of 0 or more", `The value is ${value}.`);
}
