import type {
  Condition,
  Executed,
  MoveStep,
  Pose,
  Robot,
  Signals,
  Speed,
  Step,
  Target,
  TextPlace,
} from "@twincell/core";
import {
  TextError,
  missingProgram,
  nameIn,
  rememberMap,
  type DeclaredCell,
  inverted,
  times,
  type Matrix,
} from "../../parser/index.ts";
import { BlockMachine, type Do, type Expression, type Flow, type WaitUntil } from "../../parser/structured/index.ts";
import type { Source } from "../read/grammar.ts";
import { MOTIONS, SPEED_UNITS } from "../read/words.ts";
import { ControllerArm, type Posture } from "./arm.ts";
import { NULL, shifted, toPose, trans } from "./frame.ts";
import { FUNCTIONS, numbersOf } from "./functions.ts";
import { holds, lineAt } from "./lines.ts";
import { asNumber, asPlace, binary, kindOf, truth, type PlaceValue, type Value } from "./values.ts";

/** A setting that holds until it is said anew, and one that holds for the next motion alone. */
interface Setting<T> {
  always: T;
  once: T | undefined;
}
const JOINTS = 6;
/** How near a passed target is passed when nothing else was said [mm]. */
const FIRST_ACCURACY_MM = 1;
const FIRST_PULSE_S = 0.2;

/** Executes AS statement by statement. */
export class Machine extends BlockMachine<Value> {
  readonly declared: DeclaredCell;
  /** Variables whose place is a frame although it changes: the places of a pallet that is being read. */
  readonly places = new Set<string>();
  private readonly arm: ControllerArm;
  private readonly constants: ReadonlySet<string>;
  private readonly outputs = new Map<string, boolean>();
  private readonly signals: Signals | undefined;
  private tool = "flange";
  /** Whether the tool was said where the program is now; joint angles alone do not ask for one. */
  private hasTool = false;
  /** The variable that BASE was given, where its value never changes. */
  private baseName: string | undefined;
  private speed: Setting<Speed> = { always: { ratio: 1 }, once: undefined };
  private accuracy: Setting<number> = { always: FIRST_ACCURACY_MM, once: undefined };
  private acceleration: Setting<number> = { always: 1, once: undefined };
  private posture: Posture = {};
  private via: Target | undefined;
  private passes = true;

  /** @param constants  variables that get their value once: a place in one of them is a frame of the program. */
  constructor(
    source: Source,
    constants: ReadonlySet<string>,
    robot: Robot,
    worldFromBase: Pose<"world", "base">,
    declared: DeclaredCell,
    signals?: Signals,
  ) {
    super(source.routines);
    this.arm = new ControllerArm(robot, worldFromBase);
    this.declared = declared;
    this.constants = constants;
    this.signals = signals;
  }

  // --- values -----------------------------------------------------------------------------------------------------

  /** Names with a dot before them belong to one call, all others to the controller. */
  private variable(name: string): Value | undefined {
    return this.scopes.at(-1)?.names.get(name) ?? this.globals.get(name);
  }

  private keyOf(expression: Expression): string {
    if (expression.kind === "variable") return expression.name;
    if (expression.kind === "index" && expression.of.kind === "variable")
      return `${expression.of.name}[${expression.indices.map(index => this.numberOf(index)).join(",")}]`;
    throw new TextError(expression, "a variable", "Only a variable can be given a value.");
  }

  evaluate(expression: Expression): Value {
    switch (expression.kind) {
      case "number":
      case "text":
        return expression.value;
      case "truth":
        return truth(expression.value);
      case "variable":
      case "index":
        return this.held(expression);
      case "list":
        throw new TextError(expression, "#[jt1, …]", "A list of numbers stands where a value is expected.");
      case "component":
        throw new TextError(expression, "an index", "AS has no components of that name.");
      case "unary":
        return this.prefixed(expression);
      case "binary": {
        const { sign, left, right } = expression;
        const value = this.evaluate(left);
        if (sign === "and" && value === 0) return 0;
        const frame =
          left.kind === "variable" &&
          (this.places.has(left.name) || this.constants.has(left.name)) &&
          this.baseName === undefined
            ? left.name
            : undefined;
        return binary(sign, value, this.evaluate(right), frame, expression);
      }
      case "call":
        return this.function(expression);
    }
  }

  private held(expression: Extract<Expression, { kind: "variable" | "index" }>): Value {
    if (expression.kind === "variable") {
      switch (expression.name) {
        case "null":
          return { kind: "place", at: NULL };
        case "here":
          return { kind: "place", at: this.arm.here() };
        case "pi":
          return Math.PI;
        default:
          break;
      }
    }
    const key = this.keyOf(expression);
    const value = this.variable(key);
    if (value === undefined)
      throw new TextError(expression, "a variable that has a value", `"${key}" has no value yet.`);
    return value;
  }

  private prefixed({ sign, of, line, column }: Extract<Expression, { kind: "unary" }>): Value {
    const at = { line, column };
    if (sign === "#") {
      if (of.kind !== "list" || of.items.length > JOINTS)
        throw new TextError(at, `#[jt1, … jt${JOINTS}]`, `#[…] takes ${JOINTS} joint angles.`);
      return {
        kind: "joints",
        deg: Array.from({ length: JOINTS }, (_, i) => (of.items[i] === undefined ? 0 : this.numberOf(of.items[i]))),
      };
    }
    const value = this.evaluate(of);
    if (sign === "not") return truth(asNumber(value, at) === 0);
    return typeof value === "object" && value.kind === "place"
      ? { kind: "place", at: inverted(value.at) }
      : -asNumber(value, at);
  }

  isTrue(expression: Expression): boolean {
    return this.numberOf(expression) !== 0;
  }
  numberOf(expression: Expression): number {
    return asNumber(this.evaluate(expression), expression);
  }
  fromNumber(value: number): Value {
    return value;
  }

  protected store(to: Expression, value: Value): void {
    const key = this.keyOf(to);
    const isJoints = typeof value === "object" && value.kind === "joints";
    // A name without # holds a transformation, whichever of the two it is given.
    const kept: Value = isJoints && !key.includes("#") ? { kind: "place", at: this.arm.placeOf(value.deg) } : value;
    (/^[#$]?\./.test(key) ? (this.scopes.at(-1)?.names ?? this.globals) : this.globals).set(key, kept);
  }

  private function(expression: Extract<Expression, { kind: "call" }>): Value {
    const { name, args } = expression;
    if (name === "sig") {
      // Every line must be as it is asked for.
      return truth(
        args.every(({ value }) => {
          const when = value === undefined ? undefined : this.lineOf(value);
          return when !== undefined && holds(when, { read: line => this.read(line) });
        }),
      );
    }
    const known = Object.hasOwn(FUNCTIONS, name) ? FUNCTIONS[name] : undefined;
    if (known === undefined)
      throw new TextError(
        expression,
        "a function of AS",
        `"${name.toUpperCase()}" is no function that is understood here.`,
      );
    const [least, most, run] = known;
    if (args.length < least || args.length > most)
      throw new TextError(
        expression,
        `${least} to ${most} arguments`,
        `${name.toUpperCase()} takes ${least === most ? "" : `${least} to `}${most} arguments; ${args.length} are given.`,
      );
    return run(
      args.flatMap(({ value }) => (value === undefined ? [] : [this.evaluate(value)])),
      expression,
    );
  }

  // --- lines ------------------------------------------------------------------------------------------------------

  /** A line that shall be on, or, with a minus before its number, off. */
  private lineOf(expression: Expression): { readonly signal: string; readonly is: boolean } {
    const number = this.numberOf(expression);
    const bare = expression.kind === "unary" && expression.sign === "-" ? expression.of : expression;
    return {
      signal: lineAt(
        Math.abs(number),
        bare.kind === "variable" ? bare.name : undefined,
        this.declared.signals,
        expression,
      ),
      is: number > 0,
    };
  }

  private read(line: string): boolean {
    return this.outputs.get(line) ?? this.signals?.read(line) === true;
  }

  condition(expression: Expression): Condition | undefined {
    if (expression.kind === "unary" && expression.sign === "not") {
      const inner = this.condition(expression.of);
      return inner !== undefined && "is" in inner ? { signal: inner.signal, is: !inner.is } : undefined;
    }
    const only =
      expression.kind === "call" && expression.name === "sig" && expression.args.length === 1
        ? expression.args[0]!.value
        : undefined;
    return only === undefined ? undefined : this.lineOf(only);
  }

  protected *waitUntil(statement: WaitUntil): Generator<Executed, void> {
    const when = this.condition(statement.when);
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

  // --- instructions -----------------------------------------------------------------------------------------------

  protected *instruction(statement: Do): Generator<Executed, Flow | undefined> {
    const steps = this.steps(statement);
    for (const step of steps) yield this.done(statement, step);
    if (steps.length === 0) yield { line: statement.line };
    return undefined;
  }

  private steps(statement: Do): Step[] {
    const { name, args } = statement;
    const id = (): string => this.stepId(statement);
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
      return asNumber(found, args[i]!);
    };
    const isAlways = args.some(({ name: mark }) => mark === "always");
    const set = <T>(setting: Setting<T>, to: T): void => {
      setting.once = isAlways ? undefined : to;
      if (isAlways) setting.always = to;
    };
    switch (name) {
      case "speed":
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
        return [{ id: id(), type: "wait", s: atLeast0(number(0, "a time"), statement) }];
      case "openi":
      case "open":
        return [{ id: id(), type: "gripper", closed: false }];
      case "closei":
      case "close":
        return [{ id: id(), type: "gripper", closed: true }];
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

  private write(line: Expression, id: string): Extract<Step, { type: "set" }> {
    const { signal, is } = this.lineOf(line);
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
    if (name === "here" || of === undefined) return this.store(to, { kind: "place", at: this.arm.here() });
    if (to.kind !== "index" || to.indices.length !== 1)
      throw new TextError(to, "the first of several variables, as x[0]", "DECOMPOSE fills variables that are counted.");
    const first = this.numberOf(to.indices[0]!);
    for (const [i, value] of numbersOf(this.evaluate(of), of).entries())
      this.store({ ...to, indices: [{ kind: "number", value: first + i, line, column }] }, value);
  }

  private setTool(of: Expression | undefined, at: TextPlace): void {
    if (of === undefined) throw new TextError(at, "a transformation", "TOOL is said without a transformation.");
    this.arm.tool = asPlace(this.evaluate(of), of).at;
    this.hasTool = true;
    const isNull = (of.kind === "variable" && of.name === "null") || this.arm.tool === NULL;
    this.tool = isNull
      ? "flange"
      : nameIn(this.declared.tools, toPose(this.arm.tool), of.kind === "variable" ? of.name : "tool", "_");
  }

  private setBase(of: Expression | undefined, at: TextPlace): void {
    if (of === undefined) throw new TextError(at, "a transformation", "BASE is said without a transformation.");
    const base = asPlace(this.evaluate(of), of).at;
    const name = of.kind === "variable" ? of.name : "base";
    this.arm.base = NULL;
    this.baseName = base === NULL ? undefined : nameIn(this.declared.frames, this.arm.inWorld(base), name, "_");
    this.arm.base = base;
  }

  // --- moves ------------------------------------------------------------------------------------------------------

  private motion(statement: Do): MoveStep | undefined {
    const { name, args } = statement;
    const path = name.startsWith("c") ? "circ" : name.startsWith("j") || name === "drive" ? "ptp" : "lin";
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
      blend_m: passes ? accuracy / 1000 : 0,
    };
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
        return at(times(this.arm.here(), trans([0, 0, -number(0), 0, 0, 0])));
      case "draw": {
        if (args.length > 3) throw new TextError(first, "three lengths", "DRAW with angles is not executed here.");
        return at(shifted(this.arm.here(), number(0), number(1), number(2)));
      }
      case "tdraw":
        return at(times(this.arm.here(), trans([number(0), number(1), number(2), 0, 0, 0])));
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
    if (typeof goal !== "object")
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
