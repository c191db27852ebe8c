import type {
  Condition,
  Executed,
  MoveStep,
  Pose,
  Robot,
  SignalLine,
  Signals,
  Speed,
  Step,
  Target,
  TextPlace,
} from "@twincell/core";
import { TextError, rememberMap, type DeclaredCell } from "../../parser/index.ts";
import {
  BlockMachine,
  type Argument,
  type Block,
  type Do,
  type Expression,
  type Flow,
  type Routine,
  type WaitUntil,
} from "../../parser/structured/index.ts";
import type { Application } from "../read/application.ts";
import { ControllerArm } from "./arm.ts";
import { NOTHING, fromSix, inverted, times, toPose, type Trsf } from "./trsf.ts";
import {
  asNumber,
  beginning,
  binary,
  finite,
  isList,
  kindOf,
  valuesOf,
  type Description,
  type Frame,
  type Kind,
  type Point,
  type Value,
} from "./values.ts";

/** Instructions that change nothing of where the robot goes. */
const SILENT = new Set([
  "autoconnectmove",
  "userpage",
  "cls",
  "enablepower",
  "gotoxy",
  "title",
  "restartmove",
  "put",
  "setmonitorspeed",
]);
const SAYS = new Set(["putln", "popupmsg", "logmsg"]);
const MATHS: Readonly<Record<string, (x: number, y: number) => number>> = {
  abs: Math.abs,
  sqrt: Math.sqrt,
  min: Math.min,
  max: Math.max,
  round: x => Math.round(x),
  rounddown: x => Math.floor(x),
  roundup: x => Math.ceil(x),
  sin: x => Math.sin((x * Math.PI) / 180),
  cos: x => Math.cos((x * Math.PI) / 180),
  tan: x => Math.tan((x * Math.PI) / 180),
};
/** A limit of the tool's speed that is none [mm/s]. */
const NO_LIMIT = 10_000;

/** Executes VAL 3 statement by statement. */
export class Machine extends BlockMachine<Value> {
  readonly arm: ControllerArm;
  readonly declared: DeclaredCell;
  /** Frames that are places of a pallet that is being read. */
  readonly places = new Set<string>();
  private readonly application: Application;
  private readonly changing: ReadonlySet<string>;
  private readonly signals: Signals | undefined;
  private readonly outputs = new Map<string, boolean | number>();
  /** Motions are on their way while the program goes on. */
  private moving = false;

  /** @param changing  names that are given a value while the program runs. */
  constructor(
    application: Application,
    changing: ReadonlySet<string>,
    robot: Robot,
    worldFromBase: Pose<"world", "base">,
    declared: DeclaredCell,
    signals?: Signals,
  ) {
    super(application.routines);
    this.application = application;
    this.changing = changing;
    this.arm = new ControllerArm(robot, worldFromBase);
    this.declared = declared;
    this.signals = signals;
    for (const datum of application.data)
      for (const [i, value] of valuesOf(datum).entries())
        this.globals.set(i === 0 ? datum.name : `${datum.name}[${i}]`, value);
  }

  protected override prepare(routine: Routine, names: Map<string, Value>): void {
    for (const [name, type] of this.application.locals.get(routine.name) ?? []) {
      const value = beginning(type);
      if (value !== undefined) names.set(name, value);
    }
  }

  *main(): Generator<Executed, Flow> {
    return yield* this.call(this.application.main, [], this.application.main);
  }

  open(): Block {
    const names = new Map<string, Value>();
    const { main } = this.application;
    this.scopes.push({ routine: main.name, names });
    this.prepare(main, names);
    return main.body;
  }

  spelt(name: string): string {
    return name.replace(/^call /, "");
  }

  // --- values -----------------------------------------------------------------------------------------------------

  private nameOf(expression: Expression): string | undefined {
    if (expression.kind === "variable") return expression.name;
    if (expression.kind !== "index" || expression.of.kind !== "variable" || expression.indices.length !== 1)
      return undefined;
    const i = this.numberOf(expression.indices[0]!);
    return i === 0 ? expression.of.name : `${expression.of.name}[${i}]`;
  }

  private variable(name: string): Value | undefined {
    return this.scopes.at(-1)?.names.get(name) ?? this.globals.get(name);
  }

  evaluate(expression: Expression): Value {
    switch (expression.kind) {
      case "number":
      case "truth":
      case "text":
        return expression.value;
      case "variable":
      case "index": {
        const name = this.nameOf(expression);
        const value = name === undefined ? undefined : this.variable(name);
        if (name === "flange" && value === undefined) return { kind: "tool", trsf: NOTHING };
        if (name === "world" && value === undefined) return { kind: "frame", trsf: NOTHING, father: "" };
        if (name === undefined || value === undefined)
          throw new TextError(expression, "a datum that has a value", `"${name ?? "this"}" has no value here.`);
        return kindOf(value) === "dio" ? this.read(name, "digital-in") : value;
      }
      case "list":
        return expression.items.map(item => this.numberOf(item));
      case "unary":
        return expression.sign === "!" ? !this.isTrue(expression.of) : -this.numberOf(expression.of);
      case "binary":
        return binary(expression.sign, this.evaluate(expression.left), this.evaluate(expression.right), expression);
      case "call":
        return this.function(expression);
      case "component":
        throw new TextError(expression, "a whole datum", "Components of data are not read here.");
    }
  }

  private function({ name, args, line, column }: Extract<Expression, { kind: "call" }>): Value {
    const at = { line, column };
    const given = (i: number): Expression => this.given(args, i, name, at);
    switch (name) {
      case "placed":
        return { ...this.of("frame", given(0)), trsf: this.trsf(given(1)) };
      case "appro": {
        const point = this.of("point", given(0));
        return { ...point, trsf: times(point.trsf, this.trsf(given(1))) };
      }
      case "compose": {
        // Moved along the axes of the frame, wherever the point counts from.
        const point = this.of("point", given(0));
        const along = this.chain(this.of("frame", given(1)));
        const father = this.father(point.father, at);
        const moved = times(times(times(along, this.trsf(given(2))), inverted(along)), times(father, point.trsf));
        return { ...point, trsf: times(inverted(father), moved) };
      }
      case "aioGet": {
        const line = this.nameOf(given(0));
        if (line === undefined || kindOf(this.variable(line)) !== "aio")
          throw new TextError(at, "an analogue line", "aioGet reads an analogue line.");
        return this.read(line, "analogue-in");
      }
      case "dioGet":
        return this.evaluate(given(0));
      default: {
        const maths = Object.hasOwn(MATHS, name) ? MATHS[name] : undefined;
        if (maths === undefined)
          throw new TextError(at, "a function of VAL 3", `"${name}" is no function that is understood here.`);
        return finite(maths(this.numberOf(given(0)), args.length > 1 ? this.numberOf(given(1)) : 0), at);
      }
    }
  }

  private given(args: readonly Argument[], i: number, name: string, at: TextPlace): Expression {
    const found = args[i]?.value;
    if (found === undefined) throw new TextError(at, `argument ${i + 1}`, `${name} has only ${args.length} arguments.`);
    return found;
  }

  private of<K extends Kind>(kind: K, expression: Expression): Extract<Value, { readonly kind: K }> {
    const value = this.evaluate(expression);
    const isKind = (each: Value): each is Extract<Value, { readonly kind: K }> => kindOf(each) === kind;
    if (!isKind(value))
      throw new TextError(
        expression,
        `a ${kind}`,
        `Something else (${kindOf(value)}) stands where a ${kind} is expected.`,
      );
    return value;
  }

  private trsf(expression: Expression): Trsf {
    const value = this.evaluate(expression);
    if (!isList(value) || value.length !== 6)
      throw new TextError(expression, "{x,y,z,rx,ry,rz}", "This is no transformation.");
    return fromSix(value);
  }

  isTrue(expression: Expression): boolean {
    const when = this.condition(expression);
    if (when !== undefined) {
      this.settled(expression);
      return this.holds(when);
    }
    const value = this.evaluate(expression);
    if (typeof value !== "boolean") throw new TextError(expression, "a condition", "This is neither true nor false.");
    return value;
  }
  numberOf(expression: Expression): number {
    return asNumber(this.evaluate(expression), expression);
  }
  fromNumber(value: number): Value {
    return value;
  }

  protected store(to: Expression, value: Value): void {
    const name = this.nameOf(to);
    if (name === undefined) throw new TextError(to, "a datum", "Only a whole datum can be given a value here.");
    const names = this.scopes.at(-1)?.names;
    const holder = names?.has(name) === true ? names : this.globals;
    const before = holder.get(name);
    if (before !== undefined && kindOf(before) !== kindOf(value))
      throw new TextError(to, `a ${kindOf(before)}`, `"${name}" cannot hold this.`);
    holder.set(name, value);
  }

  // --- lines ------------------------------------------------------------------------------------------------------

  private read(name: string, kind: SignalLine["kind"]): boolean | number {
    this.declared.signals[name] ??= { kind };
    const value = this.outputs.get(name) ?? this.signals?.read(name);
    return kind.startsWith("digital")
      ? value === true || (typeof value === "number" && value !== 0)
      : Number(value ?? 0);
  }

  private holds(when: Condition): boolean {
    if ("is" in when) return (this.read(when.signal, "digital-in") === true) === when.is;
    const value = Number(this.read(when.signal, "analogue-in"));
    return "above" in when ? value > when.above : value < when.below;
  }

  condition(expression: Expression): Condition | undefined {
    switch (expression.kind) {
      case "variable":
      case "index": {
        const name = this.nameOf(expression);
        if (name === undefined || kindOf(this.variable(name)) !== "dio") return undefined;
        this.declared.signals[name] ??= { kind: "digital-in" };
        return { signal: name, is: true };
      }
      case "unary": {
        const inner = expression.sign === "!" ? this.condition(expression.of) : undefined;
        return inner !== undefined && "is" in inner ? { signal: inner.signal, is: !inner.is } : undefined;
      }
      case "binary": {
        const { sign, left, right } = expression;
        if (right.kind === "truth" && (sign === "==" || sign === "!=")) {
          const inner = this.condition(left);
          return inner !== undefined && "is" in inner
            ? { signal: inner.signal, is: inner.is === (right.value === (sign === "==")) }
            : undefined;
        }
        const line =
          left.kind === "call" && left.name === "aioGet" && left.args[0]?.value !== undefined
            ? this.nameOf(left.args[0].value)
            : undefined;
        if (
          line === undefined ||
          right.kind !== "number" ||
          kindOf(this.variable(line)) !== "aio" ||
          (sign !== "<" && sign !== ">")
        )
          return undefined;
        this.declared.signals[line] ??= { kind: "analogue-in" };
        return sign === ">" ? { signal: line, above: right.value } : { signal: line, below: right.value };
      }
      default:
        return undefined;
    }
  }

  /** Lines are read and written when the program comes to them, not when the robot does. */
  private settled(at: TextPlace): void {
    if (this.moving)
      throw new TextError(
        at,
        "waitEndMove()",
        "The robot may still be on its way here: what overtakes a motion is not executed.",
      );
  }

  protected *waitUntil(statement: WaitUntil): Generator<Executed, void> {
    this.settled(statement);
    const when = this.condition(statement.when);
    if (when === undefined) {
      if (!this.isTrue(statement.when))
        throw new TextError(
          statement.when,
          "a condition of one line",
          "The program waits for a condition that nothing here makes true.",
        );
      yield { line: statement.line };
      return;
    }
    yield this.done(statement, {
      id: this.stepId(statement),
      type: "wait-for",
      when,
      ...(statement.timeout === undefined ? {} : { timeout_s: this.numberOf(statement.timeout) }),
    });
  }

  // --- instructions -----------------------------------------------------------------------------------------------

  override *statement(statement: Parameters<BlockMachine<Value>["statement"]>[0]): Generator<Executed, Flow> {
    // A line is a variable: giving it a value writes it.
    const name = statement.kind === "assign" ? this.nameOf(statement.to) : undefined;
    if (statement.kind === "assign" && name !== undefined && kindOf(this.variable(name)) === "dio") {
      const value = this.evaluate(statement.value);
      if (typeof value !== "boolean") throw new TextError(statement, "true or false", `"${name}" is a digital line.`);
      yield this.done(statement, this.set(name, value, statement));
      return "next";
    }
    return yield* super.statement(statement);
  }

  private set(signal: string, to: boolean | number, at: TextPlace): Step {
    this.settled(at);
    this.declared.signals[signal] ??= { kind: typeof to === "boolean" ? "digital-out" : "analogue-out" };
    this.outputs.set(signal, to);
    return { id: this.stepId(at), type: "set", signal, to };
  }

  protected *instruction(statement: Do): Generator<Executed, Flow | undefined> {
    const step = this.step(statement);
    yield step === undefined ? { line: statement.line } : this.done(statement, step);
    return undefined;
  }

  private step(statement: Do): Step | undefined {
    const { name, args } = statement;
    const given = (i: number): Expression => this.given(args, i, name, statement);
    const id = (): string => this.stepId(statement);
    const word = name.toLowerCase();
    switch (word) {
      case "movej":
      case "movel":
      case "movec":
        return this.motion(word, statement, id());
      case "waitendmove":
        this.moving = false;
        return undefined;
      case "open":
      case "close":
        this.of("tool", given(0));
        this.moving = false;
        return { id: id(), type: "gripper", closed: word === "close" };
      case "delay": {
        this.settled(statement);
        const s = this.numberOf(given(0));
        if (!(s >= 0)) throw new TextError(statement, "a time of 0 s or more", `The time is ${s} s.`);
        return { id: id(), type: "wait", s };
      }
      case "aioset": {
        const line = this.nameOf(given(0));
        if (line === undefined || kindOf(this.variable(line)) !== "aio")
          throw new TextError(statement, "an analogue line", "aioSet writes an analogue line.");
        return this.set(line, this.numberOf(given(1)), statement);
      }
      default:
        if (SAYS.has(word)) {
          const text = this.evaluate(given(0));
          return {
            id: id(),
            type: "message",
            text: typeof text === "string" ? text : String(asNumber(text, statement)),
          };
        }
        if (SILENT.has(word)) return undefined;
        throw new TextError(
          statement,
          "an instruction of VAL 3",
          name.startsWith("call ")
            ? `The program ${name.slice(5)} is not in the text.`
            : `"${name}" is no instruction that is understood here.`,
        );
    }
  }

  // --- motions ----------------------------------------------------------------------------------------------------

  private motion(word: "movej" | "movel" | "movec", { args, line, column }: Do, id: string): MoveStep {
    const at = { line, column };
    const shift = word === "movec" ? 1 : 0;
    const goal = this.given(args, shift, word, at);
    const toolAt = this.given(args, shift + 1, word, at);
    const tool = this.of("tool", toolAt);
    const how = this.of("mdesc", this.given(args, shift + 2, word, at));
    const name = this.toolName(tool.trsf, this.nameOf(toolAt) ?? "tool");
    const value = this.evaluate(goal);
    const ratio = Math.min(1, how.accel / 100);
    const blend_m = how.blend === "off" ? 0 : Math.min(how.leave, how.reach) / 1000;
    if (!(ratio > 0)) throw new TextError(goal, "an acceleration above 0", `The acceleration is ${how.accel} %.`);
    const common = {
      id,
      type: "move",
      speed: this.speed(how, word === "movej", goal),
      ...(ratio < 1 ? { acceleration: { ratio } } : {}),
      blend_m,
    } as const;
    this.moving = true;
    const via =
      word === "movec"
        ? { via: this.target(this.of("point", this.given(args, 0, word, at)), name, tool.trsf, "on-the-way", at) }
        : {};
    if (typeof value === "object" && !isList(value) && value.kind === "joint") {
      if (word !== "movej") throw new TextError(goal, "a point", `${word} goes to a point.`);
      const q = this.arm.axes.radians(value.deg);
      this.arm.joints_rad = q;
      return { ...common, path: "ptp", target: { q, tool: name } };
    }
    return {
      ...common,
      path: word === "movej" ? "ptp" : word === "movel" ? "lin" : "circ",
      target: this.target(this.of("point", goal), name, tool.trsf, word === "movej" ? "by-joints" : "by-path", at),
      ...via,
    };
  }

  private speed({ vel, tmax }: Description, isJoint: boolean, at: TextPlace): Speed {
    if (!(vel > 0) || !(tmax > 0))
      throw new TextError(at, "speeds above 0", `The speeds are ${vel} % and ${tmax} mm/s.`);
    return isJoint || tmax >= NO_LIMIT ? { ratio: Math.min(1, vel / 100) } : { mps: tmax / 1000 };
  }

  private target(
    point: Point,
    tool: string,
    toolTrsf: Trsf,
    how: "by-joints" | "by-path" | "on-the-way",
    at: TextPlace,
  ): Target {
    const father = this.father(point.father, at);
    const tip = times(father, point.trsf);
    const frame = this.frameName(point.father, at);
    const pose: Pose<"frame", "tcp"> = frame === "world" ? this.arm.cell(tip) : toPose(point.trsf);
    if (how === "on-the-way") return { pose, frame, tool };
    const { branch, fits } = this.arm.atFlange(times(tip, inverted(toolTrsf)), point.config);
    if (how === "by-joints" && !fits)
      throw new TextError(
        at,
        "a configuration that reaches the point",
        `The point is not reached ${Object.values(point.config).join(", ")}.`,
      );
    return { pose, frame, tool, ...(branch === undefined ? {} : { branch }) };
  }

  /** Where a frame is in the world of the controller. */
  private father(name: string, at: TextPlace, depth = 0): Trsf {
    if (name === "world") return NOTHING;
    const frame = this.globals.get(name);
    if (depth > 20 || kindOf(frame) !== "frame")
      throw new TextError(
        at,
        "a frame among the data",
        `The frame ${name} that a point counts from is not among the data.`,
      );
    const { trsf, father } = this.of("frame", { kind: "variable", name, ...at });
    return times(this.father(father, at, depth + 1), trsf);
  }
  private chain({ trsf, father }: Frame): Trsf {
    return father === "" ? NOTHING : times(this.father(father, { line: 1, column: 1 }), trsf);
  }

  /** A frame that the program changes is none to count from, except the place of a pallet. */
  private frameName(name: string, at: TextPlace): string {
    if (name === "world" || this.places.has(name)) return name;
    if (this.changing.has(name)) return "world";
    this.declared.frames[name] ??= this.arm.cell(this.father(name, at));
    return name;
  }

  private toolName(trsf: Trsf, name: string): string {
    if (name === "flange") return name;
    const tool = toPose<"flange", "tcp">(trsf);
    const known = this.declared.tools[name];
    if (known === undefined || JSON.stringify(known) === JSON.stringify(tool)) {
      this.declared.tools[name] = tool;
      return name;
    }
    return this.toolName(trsf, `${name}_2`);
  }

  // --- writing a program down -------------------------------------------------------------------------------------

  placeIn(variable: string): { readonly frame: string; readonly pose: Pose<"frame", "place"> } | undefined {
    if (kindOf(this.globals.get(variable)) !== "frame" || !this.changing.has(variable)) return undefined;
    const at = { line: 1, column: 1 };
    const { trsf, father } = this.of("frame", { kind: "variable", name: variable, ...at });
    if (father === "world" || this.changing.has(father))
      return { frame: "world", pose: this.arm.cell(times(this.father(father, at), trsf)) };
    return { frame: this.frameName(father, at), pose: toPose(trsf) };
  }

  edge(): void {
    /* every motion says everything */
  }

  override remember(): () => void {
    const values = super.remember();
    const arm = this.arm.remember();
    const { moving } = this;
    const outputs = rememberMap(this.outputs);
    return () => {
      values();
      arm();
      this.moving = moving;
      outputs();
    };
  }
}
