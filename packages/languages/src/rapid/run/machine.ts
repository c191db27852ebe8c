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
import { TextError, nameIn, type DeclaredCell } from "../../parser/index.ts";
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
import type { DataDeclaration, Source } from "../read/grammar.ts";
import { ControllerArm } from "./arm.ts";
import { Arguments } from "./arguments.ts";
import type { Confdata } from "./configuration.ts";
import { inverted, times, toPose, type Frame } from "./frame.ts";
import { FUNCTIONS } from "./functions.ts";
import { GRIPPER, HALTS, REFUSED, SILENT } from "./instructions.ts";
import { KIND_OF_FUNCTION, KIND_OF_WAIT, Lines } from "./lines.ts";
import { jointsOf, loadOf, toolFrameOf, zoneOf } from "./records.ts";
import { predefined } from "./predefined.ts";
import { WORLD, WorkObjects, type WorkObject } from "./work-objects.ts";
import { asFrame, asNumber, asNumbers, asRecord, asTruth, binary, fromFrame, placeOf, type Value } from "./values.ts";

/** Records whose orientation a program may leave unset. */
const UNSET = new Set(["num", "dnum", "bool", "string", "byte", "clock", "intnum"]);
const MOST_ITEMS = 100_000;

interface Motion {
  readonly goal: Expression;
  readonly via?: Expression;
  readonly speed: Expression;
  readonly zone?: Expression;
  readonly tool: Expression;
}

/** Executes RAPID statement by statement. */
export class Machine extends BlockMachine<Value> {
  readonly arm: ControllerArm;
  readonly declared: DeclaredCell;
  private readonly source: Source;
  private readonly known: ReadonlyMap<string, Value>;
  private readonly objects: WorkObjects;
  private readonly lines: Lines;
  private acceleration = 1;
  private override = 1;
  private fastest_mmps = Infinity;
  private asksConfiguration = true;
  private tool: Frame;

  /** Work objects that are frames although they change: the places of a pallet that is being read. */
  get places(): Set<string> {
    return this.objects.places;
  }

  /** @param changing  data that get a value while the program runs. */
  constructor(
    source: Source,
    changing: ReadonlySet<string>,
    robot: Robot,
    worldFromBase: Pose<"world", "base">,
    declared: DeclaredCell,
    signals?: Signals,
  ) {
    super(source.routines);
    this.source = source;
    this.known = predefined(robot.maxTcpSpeed_mps);
    this.arm = new ControllerArm(robot, worldFromBase);
    this.declared = declared;
    this.lines = new Lines(
      declared.signals,
      signals,
      name => this.spelt(name),
      name => this.variable(name) === undefined,
    );
    this.objects = new WorkObjects(source, changing, declared, this.arm);
    this.tool = { mm: [0, 0, 0], wxyz: [1, 0, 0, 0] };
    for (const datum of source.data) this.make(datum, this.globals);
  }

  // --- data -------------------------------------------------------------------------------------------------------

  private make(datum: DataDeclaration, into: Map<string, Value>): void {
    const { name, type, value, sizes } = datum;
    if (value !== undefined) into.set(name, this.evaluate(value));
    else if (sizes.length > 0) into.set(name, this.empty(sizes, type));
    else if (UNSET.has(type)) into.set(name, unsetValue(type));
  }

  private empty(sizes: readonly Expression[], type: string): Value {
    const [size, ...rest] = sizes;
    const length = this.numberOf(size!);
    if (!Number.isInteger(length) || length < 1 || length > MOST_ITEMS)
      throw new TextError(size!, `a size from 1 to ${MOST_ITEMS}`, `An array of ${length} items cannot be made.`);
    return Array.from({ length }, (): Value => (rest.length > 0 ? this.empty(rest, type) : unsetValue(type)));
  }

  protected override prepare(routine: Routine, names: Map<string, Value>): void {
    for (const datum of this.source.local.get(routine.name) ?? []) this.make(datum, names);
  }

  *main(): Generator<Executed, Flow> {
    const main = this.entry();
    return main === undefined ? "next" : yield* this.call(main, [], main);
  }

  /** Arguments without those that hang on an optional parameter which the routine was not given. */
  private present(args: readonly Argument[]): readonly Argument[] {
    if (!args.some(({ ifPresent }) => ifPresent === true)) return args;
    const names = this.scopes.at(-1)?.names;
    return args.filter(
      ({ ifPresent, value }) => ifPresent !== true || (value?.kind === "variable" && names?.has(value.name) === true),
    );
  }

  /** Arguments by place fill the parameters that are not optional, in their order. */
  override *call(routine: Routine, args: readonly Argument[], at: TextPlace): Generator<Executed, Flow> {
    const required = routine.parameters.filter(({ optional }) => optional !== true);
    const given = this.present(args);
    const free = given.filter(({ name }) => name === undefined).length;
    if (free > required.length)
      throw new TextError(
        at,
        `${required.length} arguments`,
        `${this.spelt(routine.name)} takes ${required.length} arguments; ${free} are given.`,
      );
    let place = 0;
    return yield* super.call(
      routine,
      given.map(each => (each.name === undefined ? { ...each, name: required[place++]!.name } : each)),
      at,
    );
  }

  /** PROC main, or the only routine there is. */
  entry(): Routine | undefined {
    return (
      this.source.routines.get("main") ??
      (this.source.routines.size === 1 ? [...this.source.routines.values()][0] : undefined)
    );
  }

  /** The body of the entry with its data made, to be written down. */
  open(): Block {
    const main = this.entry();
    if (main === undefined) return [];
    const names = new Map<string, Value>();
    this.scopes.push({ routine: main.name, names });
    this.prepare(main, names);
    return main.body;
  }

  variable(name: string): Value | undefined {
    return this.scopes.at(-1)?.names.get(name) ?? this.globals.get(name) ?? this.known.get(name);
  }

  evaluate(expression: Expression): Value {
    switch (expression.kind) {
      case "number":
      case "truth":
      case "text":
        return expression.value;
      case "variable": {
        const value = this.variable(expression.name) ?? this.lines.level(expression.name);
        if (value === undefined)
          throw new TextError(
            expression,
            "a datum that has a value",
            `"${this.spelt(expression.name)}" has no value here.`,
          );
        return value;
      }
      case "list":
        return expression.items.map(item => this.evaluate(item));
      case "index":
        return expression.indices.reduce<Value>((value, index) => {
          const i = this.numberOf(index);
          const item = typeof value === "object" && Number.isInteger(i) ? value[i - 1] : undefined;
          if (item === undefined) throw new TextError(index, "an item of the array", `The array has no item ${i}.`);
          return item;
        }, this.evaluate(expression.of));
      case "component": {
        const record = this.evaluate(expression.of);
        const place = typeof record === "object" ? placeOf(record, expression.name) : undefined;
        const value = typeof record === "object" && place !== undefined ? record[place] : undefined;
        if (value === undefined)
          throw new TextError(
            expression,
            "a component of the record",
            `There is no component "${expression.name}" here.`,
          );
        return value;
      }
      case "unary":
        return expression.sign === "not" ? !this.isTrue(expression.of) : -this.numberOf(expression.of);
      case "binary":
        return binary(expression.sign, this.evaluate(expression.left), this.evaluate(expression.right), expression);
      case "call":
        return this.function(expression);
    }
  }

  isTrue(expression: Expression): boolean {
    const when = this.condition(expression);
    return when === undefined ? asTruth(this.evaluate(expression), expression) : this.lines.holds(when);
  }
  numberOf(expression: Expression): number {
    return asNumber(this.evaluate(expression), expression);
  }
  fromNumber(value: number): Value {
    return value;
  }

  protected store(to: Expression, value: Value): void {
    if (to.kind === "variable") {
      const scope = this.scopes.at(-1);
      const declares = (data: readonly DataDeclaration[] | undefined): boolean =>
        data?.some(({ name }) => name === to.name) === true;
      if (scope !== undefined && (scope.names.has(to.name) || declares(this.source.local.get(scope.routine))))
        scope.names.set(to.name, value);
      else if (this.globals.has(to.name) || declares(this.source.data)) this.globals.set(to.name, value);
      else throw new TextError(to, "a datum that is declared", `"${this.spelt(to.name)}" is not declared.`);
      return;
    }
    if (to.kind === "component") {
      const record = this.evaluate(to.of);
      const place = typeof record === "object" ? placeOf(record, to.name) : undefined;
      if (typeof record !== "object" || place === undefined || place >= record.length)
        throw new TextError(to, "a component of the record", `There is no component "${to.name}" here.`);
      return this.store(to.of, record.with(place, value));
    }
    if (to.kind === "index") {
      const [index, ...rest] = to.indices;
      const array = this.evaluate(to.of);
      const i = this.numberOf(index!);
      if (typeof array !== "object" || !Number.isInteger(i) || i < 1 || i > array.length)
        throw new TextError(index!, "an item of the array", `The array has no item ${i}.`);
      const inner: Expression = { kind: "index", of: to.of, indices: [index!], line: to.line, column: to.column };
      return rest.length > 0
        ? this.store({ kind: "index", of: inner, indices: rest, line: to.line, column: to.column }, value)
        : this.store(to.of, array.with(i - 1, value));
    }
    throw new TextError(to, "a datum", "Only a datum can be given a value.");
  }

  private function(expression: Extract<Expression, { kind: "call" }>): Value {
    const { name, args: given } = expression;
    const routine = this.routine(name);
    if (routine !== undefined) return this.answer(routine, given, expression);
    const args = new Arguments(name, given, expression, each => this.evaluate(each));
    switch (name) {
      case "crobt": {
        const base = times(this.arm.flange, this.tool);
        return [...asRecord(fromFrame(base), expression, 2, "a pose"), [...this.arm.configuration()], NO_AXES];
      }
      case "cjointt":
        return [this.jointsNow(expression), NO_AXES];
      case "cpos":
        return [...times(this.arm.flange, this.tool).mm];
      case "calcrobt":
        return [
          ...asRecord(
            fromFrame(
              times(
                this.arm.flangeAt(jointsOf(args.value(0, "a jointtarget"), expression)),
                toolFrameOf(args.value(1, "a tool"), expression),
              ),
            ),
            expression,
            2,
            "a pose",
          ),
          [0, 0, 0, 0],
          NO_AXES,
        ];
      case "testdi":
      case "dinput":
      case "doutput":
      case "ainput":
      case "aoutput": {
        const value = this.lines.read(this.lines.line(args.nameOf(0, "a line"), KIND_OF_FUNCTION[name]!));
        return name === "testdi" ? value === true : Number(value);
      }
      case "isfile":
      case "present": {
        const parameter = given[0]?.value;
        return parameter?.kind === "variable" && this.scopes.at(-1)?.names.has(parameter.name) === true;
      }
      default:
        break;
    }
    const known = Object.hasOwn(FUNCTIONS, name) ? FUNCTIONS[name] : undefined;
    if (known === undefined)
      throw new TextError(expression, "a function of RAPID", `"${name}" is no function that is understood here.`);
    const [count, run] = known;
    if (args.count !== count)
      throw new TextError(
        expression,
        `${count} argument${count === 1 ? "" : "s"}`,
        `${name} takes ${count} argument${count === 1 ? "" : "s"}; ${args.count} are given.`,
      );
    return run(args.values(), args.options(), expression);
  }

  private jointsNow(at: TextPlace): Value {
    const { joints_deg } = this.arm;
    if (joints_deg === undefined)
      throw new TextError(
        at,
        "a MoveAbsJ before it",
        "The joint angles are the controller's choice here, and are not known.",
      );
    return [...joints_deg];
  }

  spelt(name: string): string {
    return this.source.spelling.get(name) ?? name;
  }

  condition(expression: Expression): Condition | undefined {
    return this.lines.condition(expression, of => this.evaluate(of));
  }

  // --- waits ------------------------------------------------------------------------------------------------------

  protected *waitUntil(statement: WaitUntil): Generator<Executed, void> {
    const when = this.condition(statement.when);
    if (when === undefined) {
      if (!asTruth(this.evaluate(statement.when), statement.when))
        throw new TextError(
          statement.when,
          "a condition that comes true",
          "The program waits for a condition that nothing here makes true.",
        );
      yield { line: statement.line };
      return;
    }
    yield this.waitFor(statement, when, statement.timeout === undefined ? undefined : this.numberOf(statement.timeout));
  }

  private waitFor(at: TextPlace, when: Condition, timeout_s: number | undefined): Executed {
    return this.done(at, {
      id: this.stepId(at),
      type: "wait-for",
      when,
      ...(timeout_s === undefined ? {} : { timeout_s }),
    });
  }

  // --- instructions -----------------------------------------------------------------------------------------------

  protected *instruction(statement: Do): Generator<Executed, Flow | undefined> {
    const { name } = statement;
    const args = new Arguments(this.spelt(name), this.present(statement.args), statement, each => this.evaluate(each));
    if (HALTS.has(name)) {
      yield this.done(statement, { id: this.stepId(statement), type: "stop" });
      return "halt";
    }
    const step = this.step(name, args, statement);
    yield step === undefined ? { line: statement.line } : this.done(statement, step);
    return undefined;
  }

  private step(name: string, args: Arguments, at: TextPlace): Step | undefined {
    const id = (): string => this.stepId(at);
    switch (name) {
      case "moveabsj":
      case "movej":
      case "movel":
      case "movec":
        return this.move(name, args, id());
      case "searchl":
      case "searchc":
        return this.search(name, args, id());
      case "waittime": {
        const s = args.number(0, "a time");
        if (!(s >= 0)) throw new TextError(at, "a time of 0 s or more", `The time is ${s} s.`);
        return { id: id(), type: "wait", s };
      }
      case "waitdi":
      case "waitdo":
      case "waitai":
      case "waitao":
      case "waituntil":
        return this.wait(name, args, at);
      case "set":
      case "reset":
        return this.write(args.nameOf(0, "a line"), name === "set", at);
      case "setdo":
        return this.write(args.nameOf(0, "a line"), args.number(1, "a value") !== 0, at);
      case "setao":
        return this.write(args.nameOf(0, "a line"), args.number(1, "a value"), at);
      case "pulsedo": {
        const pulse_s = args.option("plength") ?? 0.2;
        const signal = this.lines.line(args.nameOf(0, "a line"), "digital-out");
        return { id: id(), type: "set", signal, to: true, pulse_s };
      }
      case "gripload":
        return { id: this.stepId(at), type: "payload", ...loadOf(args.value(0, "a load"), this.tool, at) };
      case "tpwrite": {
        const text = args.value(0, "a text");
        if (typeof text !== "string") throw new TextError(at, "a text", "TPWrite writes a text.");
        const number = args.option("num");
        return { id: id(), type: "message", text: number === undefined ? text : `${text}${number}` };
      }
      case "accset":
        this.acceleration = Math.min(1, Math.max(0.2, args.number(0, "a percentage") / 100));
        return undefined;
      case "velset":
        this.override = Math.min(1, Math.max(0.01, args.number(0, "a percentage") / 100));
        this.fastest_mmps = args.number(1, "a speed");
        return undefined;
      case "confj":
        this.asksConfiguration = !args.has("off");
        return undefined;
      default:
        if (SILENT.has(name)) return undefined;
        throw new TextError(
          at,
          "an instruction of RAPID",
          REFUSED[name] ?? `"${this.spelt(name)}" is no instruction of RAPID that is understood here.`,
        );
    }
  }

  private wait(name: string, args: Arguments, at: TextPlace): Step {
    const timeout = args.option("maxtime");
    const limit = timeout === undefined ? {} : { timeout_s: timeout };
    const when = name === "waituntil" ? this.condition(args.given(0, "a condition")) : this.waited(name, args);
    if (when !== undefined) return { id: this.stepId(at), type: "wait-for", when, ...limit };
    if (!this.isTrue(args.given(0, "a condition")))
      throw new TextError(
        at,
        "a condition that comes true",
        "The program waits for a condition that nothing here makes true.",
      );
    return { id: this.stepId(at), type: "wait", s: 0 };
  }

  private waited(name: string, args: Arguments): Condition {
    const kind = KIND_OF_WAIT[name]!;
    const signal = this.lines.line(args.nameOf(0, "a line"), kind);
    const value = args.number(1, "a value");
    if (kind.startsWith("digital")) return { signal, is: value !== 0 };
    if (args.has("gt")) return { signal, above: value };
    if (args.has("lt")) return { signal, below: value };
    throw new TextError(args.at, "\\GT or \\LT", "Only a wait for more or for less can be carried out.");
  }

  private write(name: string, to: boolean | number, at: TextPlace): Step {
    if (name === GRIPPER && typeof to === "boolean") return { id: this.stepId(at), type: "gripper", closed: to };
    const signal = this.lines.line(name, typeof to === "boolean" ? "digital-out" : "analogue-out");
    this.lines.write(signal, to);
    return { id: this.stepId(at), type: "set", signal, to };
  }

  // --- moves ------------------------------------------------------------------------------------------------------

  private move(name: "moveabsj" | "movej" | "movel" | "movec", args: Arguments, id: string): MoveStep {
    const shift = name === "movec" ? 1 : 0;
    const motion: Motion = {
      goal: args.given(shift, "a target"),
      speed: args.given(shift + 1, "a speed"),
      zone: args.given(shift + 2, "a zone"),
      tool: args.given(shift + 3, "a tool"),
      ...(shift === 0 ? {} : { via: args.given(0, "a point on the arc") }),
    };
    return this.motion(name, motion, args, id);
  }

  private search(name: "searchl" | "searchc", args: Arguments, id: string): MoveStep {
    const signal = this.lines.line(args.nameOf(0, "a line"), "digital-in");
    const shift = name === "searchc" ? 1 : 0;
    if (args.has("flanks"))
      throw new TextError(args.at, "\\PosFlank or \\NegFlank", "A search for either edge is not executed here.");
    const motion: Motion = {
      goal: args.given(2 + shift, "a target"),
      speed: args.given(3 + shift, "a speed"),
      tool: args.given(4 + shift, "a tool"),
      ...(shift === 0 ? {} : { via: args.given(2, "a point on the arc") }),
    };
    const routine = this.scopes.at(-1)?.routine ?? "";
    const is = !args.has("negflank") && !args.has("lowlevel");
    return {
      ...this.motion(name === "searchl" ? "movel" : "movec", motion, args, id),
      until: { when: { signal, is }, missing: this.source.forgiving.has(routine) ? "continue" : "fault" },
    };
  }

  private motion(
    name: "moveabsj" | "movej" | "movel" | "movec",
    motion: Motion,
    args: Arguments,
    id: string,
  ): MoveStep {
    const { goal, via } = motion;
    const tool = this.useTool(motion.tool);
    const object = args.optionGiven("wobj");
    const speed = this.speed(motion.speed, args);
    const blend_m = motion.zone === undefined ? 0 : zoneOf(this.evaluate(motion.zone), args.option("z"), motion.zone);
    const acceleration = this.acceleration < 1 ? { acceleration: { ratio: this.acceleration } } : {};
    const common = { id, type: "move", speed, ...acceleration, blend_m } as const;
    if (name === "moveabsj") {
      const joints = jointsOf(this.evaluate(goal), goal);
      this.arm.atJoints(joints);
      return { ...common, path: "ptp", target: { q: this.arm.axes.radians(joints), tool } };
    }
    const frame = object === undefined ? WORLD : this.objects.of(object, of => this.evaluate(of));
    const target = this.target(goal, frame, tool, name === "movej", true);
    const passing = via === undefined ? {} : { via: this.target(via, frame, tool, false, false) };
    return { ...common, path: name === "movej" ? "ptp" : name === "movel" ? "lin" : "circ", target, ...passing };
  }

  private useTool(tool: Expression): string {
    this.tool = toolFrameOf(this.evaluate(tool), tool);
    this.arm.tool = this.tool;
    if (tool.kind === "variable" && tool.name === "tool0") return "flange";
    return nameIn(
      this.declared.tools,
      toPose<"flange", "tcp">(this.tool),
      tool.kind === "variable" ? this.spelt(tool.name) : "tool",
      "_",
    );
  }

  private target(
    expression: Expression,
    frame: WorkObject,
    tool: string,
    choosesPosture: boolean,
    isEnd: boolean,
  ): Target {
    const [trans, rot, conf] = asRecord(this.evaluate(expression), expression, 4, "a robtarget [[…],[…],[…],[…]]");
    const inFrame = asFrame([trans!, rot!], expression);
    const tip = times(frame.base, inFrame);
    const [cf1, cf4, cf6, cfx] = asNumbers(conf, expression, 4, "a configuration [cf1,cf4,cf6,cfx]");
    const isNamed = frame.name !== "world";
    const pose = isNamed ? toPose<"frame", "tcp">(inFrame) : this.arm.world<"frame", "tcp">(tip);
    if (!isEnd) return { pose, frame: frame.name, tool };
    const asked: Confdata | undefined = this.asksConfiguration ? [cf1!, cf4!, cf6!, cfx!] : undefined;
    const branch = this.arm.atFlange(
      times(tip, inverted(this.tool)),
      choosesPosture || this.asksConfiguration ? asked : undefined,
    );
    return { pose, frame: frame.name, tool, ...(branch === undefined || !this.asksConfiguration ? {} : { branch }) };
  }

  private speed(expression: Expression, args: Arguments): Speed {
    const time = args.option("t");
    if (time !== undefined && time > 0) return { time_s: time };
    const [tcp] = asNumbers(this.evaluate(expression), expression, 4, "a speed [v_tcp,v_ori,v_leax,v_reax]");
    const v_mmps = Math.min((args.option("v") ?? tcp!) * this.override, this.fastest_mmps);
    if (!(v_mmps > 0)) throw new TextError(expression, "a speed above 0", `The speed is ${v_mmps} mm/s.`);
    return { mps: v_mmps / 1000 };
  }

  // --- writing a program down -------------------------------------------------------------------------------------

  placeIn(variable: string): { readonly frame: string; readonly pose: Pose<"frame", "place"> } | undefined {
    return this.objects.placeIn(variable, this.variable(variable), this.globals);
  }

  edge(): void {
    /* every move says everything */
  }

  override remember(): () => void {
    const values = super.remember();
    const arm = this.arm.remember();
    const { acceleration, override, fastest_mmps, asksConfiguration, tool } = this;
    const lines = this.lines.remember();
    return () => {
      values();
      arm();
      this.acceleration = acceleration;
      this.override = override;
      this.fastest_mmps = fastest_mmps;
      this.asksConfiguration = asksConfiguration;
      this.tool = tool;
      lines();
    };
  }
}

const unsetValue = (type: string): Value => (type === "bool" ? false : type === "string" ? "" : 0);
const NO_AXES: Value = [9e9, 9e9, 9e9, 9e9, 9e9, 9e9];
