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
import { TextError, missingProgram, rememberMap, type DeclaredCell } from "../../parser/index.ts";
import {
  BlockMachine,
  changedNames,
  type Argument,
  type Block,
  type Do,
  type Expression,
  type Flow,
  type Routine,
  type WaitUntil,
} from "../../parser/structured/index.ts";
import { FAULT, type Application } from "../read/application.ts";
import { ControllerArm } from "./arm.ts";
import { NOTHING, fromSix, inverted, times, toPose, toSix, type Trsf } from "./trsf.ts";
import {
  asNumber,
  beginning,
  componentOf,
  withComponent,
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
const MOTIONS = new Set(["movej", "movel", "movec"]);
/** Instructions for files, lines of text, links, screens and other tasks: none of them moves the arm. */
const OUTSIDE = new Set([
  "diolink",
  "aiolink",
  "siolink",
  "sioset",
  "sioget",
  "sioctrl",
  "clearbuffer",
  "fileopen",
  "fileclose",
  "taskkill",
  "tasksuspend",
  "taskresume",
  "userpageset",
  "resetmotion",
  "resettask",
  "disablepower",
  "stopmove",
  "clear",
  "delete",
  "insert",
  "resize",
  "libload",
  "libsave",
  "setmutex",
  "sendmessage",
  "scoffset",
  "bidiolink",
]);
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
  /** Programs that are to run beside the one that is carried out. */
  private readonly tasks: { readonly routine: Routine; readonly args: readonly Argument[]; readonly at: TextPlace }[] =
    [];
  /** Why nobody knows where the robot is: a sentence. */
  private lost: string | undefined;
  /** Data that something outside the program gave a value. */
  private readonly foreign = new Set<string>();
  /** What kind of datum is asked for. */
  private wanted: Kind | undefined;

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
      for (const [place, value] of valuesOf(datum))
        this.globals.set(/^0(?:,0)*$/.test(place) ? datum.name : `${datum.name}[${place}]`, value);
  }

  protected override prepare(routine: Routine, names: Map<string, Value>): void {
    for (const [name, type] of this.application.locals.get(routine.name) ?? []) {
      const value = beginning(type);
      if (value !== undefined) names.set(name, value);
    }
  }

  *main(): Generator<Executed, Flow> {
    const { main } = this.application;
    if (!this.startsAlone(main)) return "next";
    const flow = yield* this.call(main, [], main);
    // Programs that were to run beside this one and move the arm are carried out behind it.
    for (let task = this.tasks.shift(); task !== undefined; task = this.tasks.shift()) {
      if (flow === "halt" && task.routine === undefined) return flow;
      yield* this.call(task.routine!, task.args, task.at);
    }
    return flow;
  }

  /** Whether a program can be started by itself: one that wants arguments has nobody who gives them. */
  private startsAlone({ name, parameters, line, column }: Routine): boolean {
    if (parameters.length === 0) return true;
    this.remark(
      "arguments",
      { line, column },
      "the program that calls this one",
      `${this.spelt(name)} wants to be given ${parameters.map(each => each.name).join(", ")}: it is not run by itself. Open it with the program that calls it.`,
    );
    return false;
  }

  /** Programs stand in the text under their own names, those of a library too. */
  override routine(name: string): Routine | undefined {
    const found = super.routine(name);
    if (found !== undefined || !name.includes(":")) return found;
    return super.routine(`call ${name.slice(name.indexOf(":") + 1)}`);
  }

  protected override handBack(routine: Routine, names: ReadonlyMap<string, Value>, args: readonly Argument[]): void {
    const free = args.filter(({ name }) => name === undefined);
    for (const [i, { name, isBack }] of routine.parameters.entries()) {
      const given = free[i]?.value;
      const value = names.get(name);
      if (isBack !== true || given === undefined || value === undefined) continue;
      if (given.kind !== "variable" && given.kind !== "index") continue;
      if (kindOf(value) !== "dio" && kindOf(value) !== "aio") this.store(given, value);
    }
  }

  /** The code of a program and of all that it calls. */
  private bodiesOf(routine: Routine): readonly Block[] {
    const all = [...this.application.routines.values()];
    const met = new Set([routine]);
    for (const each of met)
      for (const other of all)
        if (!met.has(other) && JSON.stringify(each.body).includes(`"${other.name}"`)) met.add(other);
    return [...met].map(({ body }) => body);
  }

  /** Whether a program, or one that it calls, has a motion. */
  private moves(routine: Routine, met = new Set<string>()): boolean {
    if (met.has(routine.name)) return false;
    met.add(routine.name);
    const look = (block: Block): boolean =>
      block.some(statement => {
        switch (statement.kind) {
          case "do": {
            if (MOTIONS.has(statement.name.toLowerCase())) return true;
            const called = this.routine(statement.name);
            return called !== undefined && this.moves(called, met);
          }
          case "if":
            return statement.branches.some(({ body }) => look(body)) || look(statement.otherwise ?? []);
          case "while":
          case "for":
            return look(statement.body);
          default:
            return false;
        }
      });
    return look(routine.body);
  }

  private createTask(statement: Do): undefined {
    const called = statement.args.at(-1)?.value;
    const routine = called?.kind === "call" ? this.routine(`call ${called.name}`) : undefined;
    if (called?.kind !== "call" || routine === undefined)
      throw new TextError(statement, "a program of the text", "The program of the task is not in the text.");
    if (!this.moves(routine)) {
      for (const name of changedNames(this.bodiesOf(routine))) this.foreign.add(name);
      this.remark(
        `task ${called.name}`,
        statement,
        "a program that moves the robot",
        `The task ${called.name} does not move the robot: it is kept and not executed. What it gives to data is not known.`,
      );
      return undefined;
    }
    this.remark(
      `task ${called.name}`,
      statement,
      "one program after the other",
      `The task ${called.name} runs beside this program on the controller: it is carried out behind it here.`,
    );
    this.tasks.push({ routine, args: called.args, at: statement });
    return undefined;
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
    if (expression.kind !== "index" || expression.of.kind !== "variable") return undefined;
    const places = expression.indices.map(index => this.numberOf(index));
    return places.every(i => i === 0) ? expression.of.name : `${expression.of.name}[${places.join(",")}]`;
  }

  private variable(name: string): Value | undefined {
    if (this.foreign.size > 0 && this.foreign.has(name)) return undefined;
    const value = this.scopes.at(-1)?.names.get(name) ?? this.globals.get(name);
    if (value !== undefined || !name.includes(":")) return value;
    return this.globals.get(name.slice(name.indexOf(":") + 1));
  }

  /** A component of a datum: `pPick.trsf.x`, `mFast.vel`, `jHome.j1`. */
  private component(of: Expression, name: string, at: TextPlace): Value {
    const value = this.evaluate(of);
    const found = componentOf(value, name);
    if (found === undefined)
      throw new TextError(at, "a component of the datum", `There is no component "${name}" here.`);
    return found;
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
        if (name === undefined || value === undefined) return this.missing(name, expression);
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
        return this.component(expression.of, expression.name, expression);
    }
  }

  /** A datum that no open file has: a speed and a tool have something to take for them, everything else has not. */
  private missing(name: string | undefined, at: TextPlace): Value {
    const say = (what: string, taken: string): void => {
      this.remark(
        `datum ${name}`,
        at,
        "the data of the application",
        `The ${what} ${name} is in no file that is open: ${taken}.`,
      );
    };
    if (this.wanted === "mdesc") {
      say("motion descriptor", "full speed without blending is taken for it");
      return { kind: "mdesc", accel: 100, vel: 100, tmax: NO_LIMIT, blend: "off", leave: 0, reach: 0 };
    }
    if (this.wanted === "tool") {
      say("tool", "the flange is taken for it");
      return { kind: "tool", trsf: NOTHING };
    }
    throw new TextError(
      at,
      "a datum that has a value",
      this.foreign.has(name ?? "")
        ? `"${name}" is what another machine or a task answers: it is not known here.`
        : `"${name ?? "this"}" has no value here.`,
    );
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
        if (line === undefined || !this.isLine(line, "aio"))
          throw new TextError(at, "an analogue line", "aioGet reads an analogue line.");
        return this.read(line, "analogue-in");
      }
      case "dioGet":
        return this.evaluate(given(0));
      case "here": {
        const tool = this.of("tool", given(0));
        const frame = this.chain(this.of("frame", given(1)));
        const father = this.nameOf(given(1)) ?? "world";
        const flange = this.arm.flange();
        if (this.lost !== undefined || flange === undefined)
          throw new TextError(at, "a position that is known", this.lost ?? "Where the robot is is not known here.");
        const config = { shoulder: "ssame", elbow: "esame", wrist: "wsame" };
        return { kind: "point", trsf: times(inverted(frame), times(flange, tool.trsf)), father, config };
      }
      case "herej": {
        const { joints_rad } = this.arm;
        if (this.lost !== undefined || joints_rad === undefined)
          throw new TextError(at, "a position that is known", this.lost ?? "Where the robot is is not known here.");
        return { kind: "joint", deg: this.arm.axes.degrees(joints_rad) };
      }
      case "distance": {
        const [p, q] = [this.placeOf(given(0), at), this.placeOf(given(1), at)];
        return Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      }
      case "position": {
        const point = this.of("point", given(0));
        const frame = this.chain(this.of("frame", given(1)));
        return toSix(times(inverted(frame), times(this.father(point.father, at), point.trsf)));
      }
      case "toString": {
        const value = this.numberOf(given(args.length > 1 ? 1 : 0));
        return String(value);
      }
      case "size":
        return this.sizeOf(given(0));
      case "isEmpty":
      case "isSettled":
      case "isPowered":
      case "isCalibrated":
      case "workingMode":
      case "esStatus":
      case "clock":
      case "getMonitorSpeed":
      case "getKey":
      case "taskStatus":
      case "setMonitorSpeed":
        return this.ofController(name, at);
      default: {
        const maths = Object.hasOwn(MATHS, name) ? MATHS[name] : undefined;
        if (maths === undefined)
          throw new TextError(at, "a function of VAL 3", `"${name}" is no function that is understood here.`);
        return finite(maths(this.numberOf(given(0)), args.length > 1 ? this.numberOf(given(1)) : 0), at);
      }
    }
  }

  /** Where a point is in the world, or a transformation from where it counts. */
  private placeOf(expression: Expression, at: TextPlace): Trsf["mm"] {
    const value = this.evaluate(expression);
    if (isList(value)) return this.trsf(expression).mm;
    const point = this.of("point", expression);
    return times(this.father(point.father, at), point.trsf).mm;
  }

  private sizeOf(of: Expression): number {
    const name = of.kind === "variable" ? of.name : "";
    let size = this.variable(name) === undefined ? 0 : 1;
    while (this.variable(`${name}[${size}]`) !== undefined) size++;
    return size;
  }

  /** What only a controller knows: one that runs by itself, stands still and is asked by nobody. */
  private ofController(name: string, at: TextPlace): Value {
    this.remark(
      name,
      at,
      "a value in the text",
      `${name} is asked of the controller: it runs by itself here, and no time passes.`,
    );
    if (name.startsWith("is")) return true;
    return name === "workingMode"
      ? 4
      : name === "taskStatus"
        ? 1
        : name === "getKey"
          ? -1
          : name === "clock" || name === "esStatus"
            ? 0
            : 100;
  }

  private given(args: readonly Argument[], i: number, name: string, at: TextPlace): Expression {
    const found = args[i]?.value;
    if (found === undefined) throw new TextError(at, `argument ${i + 1}`, `${name} has only ${args.length} arguments.`);
    return found;
  }

  private of<K extends Kind>(kind: K, expression: Expression): Extract<Value, { readonly kind: K }> {
    const { wanted } = this;
    this.wanted = kind;
    const value = this.evaluate(expression);
    this.wanted = wanted;
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
    if (to.kind === "component") {
      const changed = withComponent(this.evaluate(to.of), to.name, value);
      if (changed === undefined)
        throw new TextError(to, "a component of the datum", `"${to.name}" is no component that is given a value here.`);
      this.store(to.of, changed);
      return;
    }
    const name = this.nameOf(to);
    if (name === undefined) throw new TextError(to, "a datum", "Only a whole datum can be given a value here.");
    const names = this.scopes.at(-1)?.names;
    const holder = names?.has(name) === true ? names : this.globals;
    const before = holder.get(name);
    if (before === undefined && typeof value !== "object")
      this.remark(
        `datum ${name}`,
        to,
        "the data of the application",
        `${name} is in no file that is open: whether it is a line is not known, and no line is set.`,
      );
    if (before !== undefined && kindOf(before) !== kindOf(value))
      throw new TextError(to, `a ${kindOf(before)}`, `"${name}" cannot hold this.`);
    holder.set(name, value);
  }

  // --- lines ------------------------------------------------------------------------------------------------------

  /** Whether a name is that of a line: one of the data, or one that none of the open files has. */
  private isLine(name: string, kind: "dio" | "aio"): boolean {
    const value = this.variable(name);
    if (value !== undefined) return kindOf(value) === kind;
    this.remark(
      `datum ${name}`,
      { line: 1, column: 1 },
      "the data of the application",
      `The line ${name} is in no file that is open: it counts as a ${kind === "dio" ? "digital" : "analogue"} line of that name.`,
    );
    this.globals.set(name, { kind });
    return true;
  }

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
      this.remark(
        `overtakes ${at.line}`,
        at,
        "waitEndMove()",
        "This overtakes the motion before it on the controller: it is carried out when the robot is there here.",
      );
  }

  protected *waitUntil(statement: WaitUntil): Generator<Executed, void> {
    this.settled(statement);
    const { when: all } = statement;
    if (all.kind === "binary" && all.sign === "and") {
      yield* this.waitUntil({ ...statement, when: all.left });
      yield* this.waitUntil({ ...statement, when: all.right });
      return;
    }
    const when = this.condition(all);
    if (when === undefined) {
      if (!this.isTrue(all)) {
        const one =
          all.kind === "binary" && all.sign === "or"
            ? (this.condition(all.left) ?? this.condition(all.right))
            : undefined;
        if (one === undefined)
          throw new TextError(
            all,
            "a condition of one line",
            "The program waits for a condition that nothing here makes true.",
          );
        this.remark(
          `alternatives ${statement.line}`,
          statement,
          "one thing to wait for",
          "The wait ends with the first of several lines: only one of them is waited for here.",
        );
        yield this.done(statement, { id: this.stepId(statement), type: "wait-for", when: one });
        return;
      }
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
    if (name === FAULT) {
      const text = (argument: Argument | undefined): string =>
        argument?.value?.kind === "text" ? argument.value.value : "";
      throw new TextError(statement, text(args[0]), text(args[1]));
    }
    if (name === "taskCreate" || name === "taskCreateSync") return this.createTask(statement);
    const given = (i: number): Expression => this.given(args, i, name, statement);
    const id = (): string => this.stepId(statement);
    const word = name.toLowerCase();
    switch (word) {
      case "movej":
      case "movel":
      case "movec":
        if (this.leaveOut(this.given(args, word === "movec" ? 1 : 0, word, statement))) return undefined;
        return this.motion(word, statement, id());
      case "dioset": {
        const line = this.nameOf(given(0));
        if (line === undefined || !this.isLine(line, "dio"))
          throw new TextError(statement, "a digital line", "dioSet writes a digital line.");
        return this.set(line, this.numberOf(given(1)) !== 0, statement);
      }
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
        if (line === undefined || !this.isLine(line, "aio"))
          throw new TextError(statement, "an analogue line", "aioSet writes an analogue line.");
        return this.set(line, this.numberOf(given(1)), statement);
      }
      default:
        if (SAYS.has(word)) {
          const said = given(0);
          if (said.kind === "variable" && this.foreign.has(said.name))
            return { id: id(), type: "message", text: `<${said.name}>` };
          const text = this.evaluate(given(0));
          return {
            id: id(),
            type: "message",
            text: typeof text === "string" ? text : String(asNumber(text, statement)),
          };
        }
        if (SILENT.has(word)) return undefined;
        if (OUTSIDE.has(word)) {
          if (word === "sioget")
            for (const { value } of args.slice(1)) if (value?.kind === "variable") this.foreign.add(value.name);
          this.remark(
            `${word} ${statement.line}`,
            statement,
            "a statement about the robot",
            `${name} is kept and not executed: it does not move the robot.`,
          );
          return undefined;
        }
        if (name.startsWith("call ")) throw missingProgram(statement, name.slice(5));
        throw new TextError(
          statement,
          "an instruction of VAL 3",
          `"${name}" is no instruction that is understood here.`,
        );
    }
  }

  // --- motions ----------------------------------------------------------------------------------------------------

  /** A point that no open file has: nobody can go there. */
  private leaveOut(goal: Expression): boolean {
    let of = goal;
    while (of.kind === "call" && (of.name === "appro" || of.name === "compose") && of.args[0]?.value !== undefined)
      of = of.args[0].value;
    const name = of.kind === "variable" || of.kind === "index" ? this.nameOf(of) : undefined;
    if (name === undefined || this.variable(name) !== undefined) return false;
    this.remark(
      `point ${name}`,
      goal,
      "the data of the application",
      `The motion to ${name} is left out: no file that is open has the point. The robot goes on to the next point from where it is.`,
    );
    this.lost = "The robot was to be at a point that no open file has.";
    return true;
  }

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
    this.lost = undefined;
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
