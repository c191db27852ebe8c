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
import { TextError, missingProgram, WaitsOutside, nameIn, type DeclaredCell } from "../../parser/index.ts";
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
import { FAULT, LATE_CALL, ownName, type DataDeclaration, type Source } from "../read/grammar.ts";
import { ControllerArm } from "./arm.ts";
import { Arguments } from "./arguments.ts";
import type { Confdata } from "./configuration.ts";
import { inverted, times, toPose, type Frame } from "./frame.ts";
import { FUNCTIONS } from "./functions.ts";
import { ANSWERS, GRIPPER, HALTS, OUTSIDE, QUESTIONS, REFUSED, SILENT } from "./instructions.ts";
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
  private readonly types = new Map<string, string>();
  private making: string | undefined;
  /** Why nobody knows where the robot is: a sentence. */
  private lost: string | undefined;
  private readonly triggers = new Map<
    string,
    { readonly signal: string; readonly to: boolean | number; readonly distance_mm: number }
  >();
  /** Data that something outside gave a value. */
  private readonly foreign = new Set<string>();

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
      name => this.handedLine(name) ?? this.spelt(name),
      name => this.isHeldElsewhere(name) || this.handedLine(name) !== undefined,
    );
    this.objects = new WorkObjects(source, changing, declared, this.arm);
    this.tool = { mm: [0, 0, 0], wxyz: [1, 0, 0, 0] };
    for (const { name, module, type } of source.data)
      this.types.set(module !== undefined && source.own.size > 0 ? ownName(name, module) : name, type);
    this.makeAll(source.data);
  }

  // --- data -------------------------------------------------------------------------------------------------------

  /** Data may count on others that stand further down, or in a module behind: these are made first. */
  private makeAll(data: readonly DataDeclaration[]): void {
    let waiting = data;
    let fault: TextError | undefined;
    do {
      const before = waiting.length;
      fault = undefined;
      const again: DataDeclaration[] = [];
      for (const datum of waiting) {
        const { name, module } = datum;
        const key = module !== undefined && this.source.own.size > 0 ? ownName(name, module) : name;
        this.making = module;
        try {
          this.make(datum, this.globals, key);
        } catch (cause) {
          if (!(cause instanceof TextError)) throw cause;
          fault ??= cause;
          again.push(datum);
        }
      }
      waiting = again;
      if (again.length === before) break;
    } while (waiting.length > 0);
    this.making = undefined;
    // In another file it matters where the datum is asked for.
    if (fault !== undefined && this.source.own.size === 0) throw fault;
  }

  private make(datum: DataDeclaration, into: Map<string, Value>, key = datum.name): void {
    const { type, value, sizes } = datum;
    if (value !== undefined) into.set(key, this.evaluate(value));
    else if (sizes.length > 0) into.set(key, this.empty(sizes, type));
    else {
      const unset = this.unset(type);
      if (unset !== undefined) into.set(key, unset);
    }
  }

  /** What a datum that is given no value begins with; undefined where that is nothing that could be used. */
  private unset(type: string, depth = 0): Value | undefined {
    if (UNSET.has(type)) return unsetValue(type);
    if (Object.hasOwn(EMPTY, type)) return EMPTY[type];
    const components = this.source.records.get(type);
    if (components === undefined || depth > RECORD_DEPTH) return undefined;
    return components.map(each => this.unset(each.type, depth + 1) ?? 0);
  }

  /** The declared type of what an expression stands for, where it is a record of the text. */
  private typeOf(expression: Expression): string | undefined {
    switch (expression.kind) {
      case "variable": {
        const routine = this.scopes.at(-1)?.routine ?? "";
        const local = this.source.local.get(routine)?.find(({ name }) => name === expression.name);
        const parameter = this.source.routines.get(routine)?.parameters.find(({ name }) => name === expression.name);
        return local?.type ?? parameter?.type ?? this.types.get(this.globalKey(expression.name));
      }
      case "index":
        return this.typeOf(expression.of);
      case "component": {
        const components = this.source.records.get(this.typeOf(expression.of) ?? "");
        return components?.find(({ name }) => name === expression.name)?.type;
      }
      default:
        return undefined;
    }
  }

  /** Where a component stands in its record: one that the text declares, or one of the controller. */
  private componentOf(of: Expression, record: readonly Value[], name: string): number | undefined {
    const components = this.source.records.size > 0 ? this.source.records.get(this.typeOf(of) ?? "") : undefined;
    const at = components?.findIndex(each => each.name === name) ?? -1;
    return at >= 0 ? at : placeOf(record, name);
  }

  /** The module of the routine that is carried out. */
  private get module(): string | undefined {
    const routine = this.scopes.at(-1)?.routine;
    return routine === undefined ? this.making : this.source.moduleOf.get(routine);
  }

  /** The name under which a datum of all or of the module is kept. */
  private globalKey(name: string): string {
    if (this.source.own.size === 0) return name;
    const { module } = this;
    return module !== undefined && this.source.own.get(module)?.has(name) === true ? ownName(name, module) : name;
  }

  override routine(name: string): Routine | undefined {
    return super.routine(this.globalKey(name)) ?? super.routine(name);
  }

  private empty(sizes: readonly Expression[], type: string): Value {
    const [size, ...rest] = sizes;
    const length = this.numberOf(size!);
    if (!Number.isInteger(length) || length < 1 || length > MOST_ITEMS)
      throw new TextError(size!, `a size from 1 to ${MOST_ITEMS}`, `An array of ${length} items cannot be made.`);
    return Array.from({ length }, (): Value => (rest.length > 0 ? this.empty(rest, type) : (this.unset(type) ?? 0)));
  }

  protected override prepare(routine: Routine, names: Map<string, Value>): void {
    for (const datum of this.source.local.get(routine.name) ?? []) this.make(datum, names);
  }

  *main(): Generator<Executed, Flow> {
    const main = this.entry();
    return main === undefined || !this.startsAlone(main) ? "next" : yield* this.call(main, [], main);
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
      this.linesByName(
        routine,
        given.map(each => (each.name === undefined ? { ...each, name: required[place++]!.name } : each)),
      ),
      at,
    );
  }

  protected override handBack(routine: Routine, names: ReadonlyMap<string, Value>, args: readonly Argument[]): void {
    for (const { name, isBack } of routine.parameters) {
      if (isBack !== true) continue;
      const given = args.find(argument => argument.name === name)?.value;
      const value = names.get(name);
      if (given === undefined || value === undefined || !isPlace(given)) continue;
      if (this.isConstantParameter(given)) continue;
      this.store(given, value);
    }
  }

  /** Data of the controller are only read. */
  private isConstantParameter(given: Expression): boolean {
    let of = given;
    while (of.kind === "index" || of.kind === "component") ({ of } = of);
    return of.kind !== "variable" || (!this.isDatum(of.name) && this.scopes.at(-1)?.names.has(of.name) !== true);
  }

  /** PROC main, or the only routine there is. */
  entry(): Routine | undefined {
    const main = this.source.routines.get("main");
    if (main !== undefined || this.source.routines.size === 0) return main;
    const all = [...this.source.routines.values()];
    const alone = all.length === 1 ? all[0]! : undefined;
    if (alone === undefined)
      this.remark(
        "main",
        all[0]!,
        "PROC main",
        "No module that is open has PROC main: no routine is run. Put the module that calls them beside it.",
      );
    return alone;
  }

  /** Whether a routine can be started by itself: one that wants arguments has nobody who gives them. */
  private startsAlone({ name, parameters, ...at }: Routine): boolean {
    const asked = parameters.filter(({ optional }) => optional !== true).map(each => this.spelt(each.name));
    if (asked.length === 0) return true;
    this.remark(
      "arguments",
      placeOnly(at),
      "the routine that calls this one",
      `${this.spelt(name)} wants to be given ${asked.join(", ")}: it is not run by itself. Open it with the module that calls it.`,
    );
    return false;
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
    return this.scopes.at(-1)?.names.get(name) ?? this.globals.get(this.globalKey(name)) ?? this.known.get(name);
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
            this.foreign.has(expression.name)
              ? `"${this.spelt(expression.name)}" is what another machine answers: it is not known here.`
              : `"${this.spelt(expression.name)}" has no value here.`,
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
        const place = typeof record === "object" ? this.componentOf(expression.of, record, expression.name) : undefined;
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
        if (COMPARES.has(expression.sign)) this.takeForLine(expression.left);
        return binary(expression.sign, this.evaluate(expression.left), this.evaluate(expression.right), expression);
      case "call":
        return this.function(expression);
    }
  }

  /** The line that a parameter of a routine stands for. */
  private handedLine(name: string): string | undefined {
    const scope = this.scopes.at(-1);
    const value = scope?.names.get(name);
    if (scope === undefined || typeof value !== "string") return undefined;
    const parameter = this.source.routines.get(scope.routine)?.parameters.find(each => each.name === name);
    return parameter !== undefined && SIGNAL_TYPE.test(parameter.type) ? value : undefined;
  }

  /** Lines are handed to a routine by their names. */
  private linesByName(routine: Routine, args: readonly Argument[]): readonly Argument[] {
    if (!routine.parameters.some(({ type }) => SIGNAL_TYPE.test(type))) return args;
    return args.map(argument => {
      const { name, value } = argument;
      const type = routine.parameters.find(each => each.name === name)?.type ?? "";
      if (value?.kind !== "variable" || !SIGNAL_TYPE.test(type)) return argument;
      const { line, column } = value;
      const spelt = this.handedLine(value.name) ?? this.spelt(value.name);
      return { ...argument, value: { kind: "text", value: spelt, line, column } };
    });
  }

  /** A name that is no datum, compared with a value, is that of a line. */
  private takeForLine(expression: Expression): void {
    if (
      expression.kind === "variable" &&
      this.variable(expression.name) === undefined &&
      !this.isDatum(expression.name)
    )
      if (this.lines.level(expression.name) === undefined) this.lines.line(expression.name, "digital-in");
  }

  private isDatum(name: string): boolean {
    return (
      this.types.has(this.globalKey(name)) ||
      this.source.local.get(this.scopes.at(-1)?.routine ?? "")?.some(each => each.name === name) === true
    );
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
      else if (this.types.has(this.globalKey(to.name))) this.globals.set(this.globalKey(to.name), value);
      else throw new TextError(to, "a datum that is declared", `"${this.spelt(to.name)}" is not declared.`);
      return;
    }
    if (to.kind === "component") {
      const record = this.evaluate(to.of);
      const place = typeof record === "object" ? this.componentOf(to.of, record, to.name) : undefined;
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
      case "crobt":
      case "cjointt":
      case "cpos":
        if (this.lost !== undefined)
          throw new TextError(expression, "a position that is known", `${this.lost} Where it is now is not known.`);
        break;
      default:
        break;
    }
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
      case "strtoval": {
        const to = given[1]?.value;
        const text = args.value(0, "a text");
        const value = typeof text === "string" ? readValue(text) : undefined;
        if (to === undefined || value === undefined) return false;
        this.store(to, value);
        return true;
      }
      case "dim": {
        const array = args.value(0, "an array");
        const depth = args.number(1, "the dimension");
        let part: Value | undefined = array;
        for (let i = 1; i < depth; i++) part = typeof part === "object" ? part[0] : undefined;
        if (typeof part !== "object") throw new TextError(expression, "an array", "Dim asks for the size of an array.");
        return part.length;
      }
      case "gettaskname":
        return "T_ROB1";
      case "opmode":
      case "clkread":
      case "runmode":
      case "robos":
        return this.ofController(name, expression);
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

  /** What only a controller knows: taken as for one that runs in automatic, and no time passes. */
  private ofController(name: string, at: TextPlace): Value {
    this.remark(
      name,
      at,
      "a value in the text",
      name === "clkread"
        ? "ClkRead measures time, which does not pass here: it reads 0."
        : `${this.spelt(name)} is asked of the controller: it runs in automatic here.`,
    );
    return name === "robos" ? false : name === "clkread" ? 0 : 1;
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
    if (name === FAULT || name === LATE_CALL) return yield* this.unread(statement);
    if (Object.hasOwn(WITH_EVENT, name)) return yield* this.withEvent(statement, WITH_EVENT[name]!);
    const args = new Arguments(this.spelt(name), this.present(statement.args), statement, each => this.evaluate(each));
    if (HALTS.has(name)) {
      yield this.done(statement, { id: this.stepId(statement), type: "stop" });
      return "halt";
    }
    const step = this.step(name, args, statement);
    yield step === undefined ? { line: statement.line } : this.done(statement, step);
    return undefined;
  }

  /** A statement that was not understood, or a call whose routine is named by a text. */
  private *unread(statement: Do): Generator<Executed, Flow> {
    const [first, second, ...others] = statement.args;
    if (statement.name === FAULT) {
      const text = (argument: Argument | undefined): string =>
        argument?.value?.kind === "text" ? argument.value.value : "";
      throw new TextError(statement, text(first), text(second));
    }
    const called = first?.value === undefined ? "" : this.evaluate(first.value);
    const routine = typeof called === "string" ? this.routine(called.toLowerCase()) : undefined;
    if (routine === undefined) throw missingProgram(statement, String(called));
    return yield* this.call(routine, second === undefined ? others : [second, ...others], statement);
  }

  /** A motion with something that happens on its way: at its end here, which is said where it is not that. */
  private *withEvent(statement: Do, { motion, event }: WithEvent): Generator<Executed, Flow> {
    const isArc = motion === "movec";
    const free = statement.args.filter(each => each.name === undefined);
    const at = event === "trigg" ? (isArc ? 3 : 2) : -1;
    const last = isArc ? 5 : 4;
    const events = event === "trigg" ? free.slice(at, at + 1) : free.slice(last);
    const rest = statement.args.filter(each => !events.includes(each) && !/^t[2-8]$/.test(each.name ?? ""));
    const triggers = event === "trigg" ? statement.args.filter(each => /^t[2-8]$/.test(each.name ?? "")) : [];
    const move = new Arguments(this.spelt(motion), this.present(rest), statement, each => this.evaluate(each));
    yield this.done(statement, this.move(motion, move, this.stepId(statement)));
    switch (event) {
      case "do":
      case "ao": {
        const [signal, value] = events.map(each => each.value!);
        if (signal?.kind !== "variable" || value === undefined)
          throw new TextError(statement, "a line and its value", `${this.spelt(statement.name)} sets a line.`);
        const number = this.numberOf(value);
        yield this.done(statement, this.write(signal.name, event === "do" ? number !== 0 : number, statement));
        return "next";
      }
      case "sync": {
        const called = events[0]?.value === undefined ? "" : this.evaluate(events[0].value);
        const routine = typeof called === "string" ? this.routine(called.toLowerCase()) : undefined;
        if (routine === undefined) throw missingProgram(statement, String(called));
        return yield* this.call(routine, [], statement);
      }
      case "trigg":
        for (const { value } of [...events, ...triggers]) yield* this.trigger(value, statement);
        return "next";
    }
  }

  /** What TriggIO or TriggEquip said is done on the way. */
  private *trigger(of: Expression | undefined, at: TextPlace): Generator<Executed, void> {
    const known = of?.kind === "variable" ? this.triggers.get(of.name) : undefined;
    if (of?.kind !== "variable" || known === undefined)
      throw new TextError(at, "TriggIO or TriggEquip before it", "What happens on the way is not said before.");
    if (known.distance_mm !== 0)
      this.remark(
        `trigger ${of.name}`,
        at,
        "an event at the end of the motion",
        `${this.spelt(of.name)} acts at the end of the motion here, and not ${known.distance_mm} mm from it.`,
      );
    yield this.done(at, this.write(known.signal, known.to, at));
  }

  private step(name: string, args: Arguments, at: TextPlace): Step | undefined {
    const id = (): string => this.stepId(at);
    switch (name) {
      case "moveabsj":
      case "movej":
      case "movel":
      case "movec": {
        const goal = args.given(name === "movec" ? 1 : 0, "a target");
        if (this.leaveOut(goal)) return undefined;
        const step = this.move(name, args, id());
        this.lost = undefined;
        return step;
      }
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
      case "incr":
      case "decr":
      case "add":
      case "clear":
        return this.counted(name, args);
      case "invertdo": {
        const line = args.nameOf(0, "a line");
        const level = this.lines.read(this.lines.line(line, "digital-out"));
        return this.write(line, level !== true, at);
      }
      case "setgo":
        return this.write(args.nameOf(0, "a line"), args.number(1, "a value"), at);
      case "triggio":
      case "triggequip":
        return this.defineTrigger(args);
      default:
        if (SILENT.has(name)) return undefined;
        if (QUESTIONS.has(name)) return this.asked(args, at);
        if (ANSWERS.has(name)) return this.answered(name, args, at);
        if (OUTSIDE.has(name)) {
          this.remark(
            `${name} ${at.line}`,
            at,
            "a statement about the robot",
            `${this.spelt(name)} is kept and not executed: it does not move the robot.`,
          );
          return undefined;
        }
        // What is no instruction is the name of a procedure.
        if (REFUSED[name] === undefined) throw missingProgram(at, this.spelt(name));
        throw new TextError(at, "an instruction of RAPID", REFUSED[name]);
    }
  }

  private counted(name: string, args: Arguments): undefined {
    const to = args.given(0, "a datum");
    const now = name === "clear" ? 0 : this.numberOf(to);
    this.store(
      to,
      name === "incr" ? now + 1 : name === "decr" ? now - 1 : name === "add" ? now + args.number(1, "a number") : 0,
    );
    return undefined;
  }

  private defineTrigger(args: Arguments): undefined {
    const name = args.nameOf(0, "the name of the event");
    const line = args.optionGiven("dop") ?? args.optionGiven("gop") ?? args.optionGiven("aop");
    if (line?.kind !== "variable") throw new TextError(args.at, "\\DOp:=line", "The event sets no line.");
    const shift = args.count - 2;
    const value = args.number(shift + 1, "a value");
    this.triggers.set(name, {
      signal: line.name,
      to: args.has("dop") ? value !== 0 : value,
      distance_mm: args.has("start") ? Number.NaN : args.number(1, "a distance"),
    });
    return undefined;
  }

  /** The operator is asked: the program goes on with an answer that is given by hand, as an input of that name. */
  private asked(args: Arguments, at: TextPlace): undefined {
    const to = args.given(0, "a datum");
    const name = to.kind === "variable" ? this.spelt(to.name) : "answer";
    const answer = this.lines.given(name);
    if (typeof answer !== "number") throw new WaitsOutside(at, "program", name);
    this.store(to, answer);
    return undefined;
  }

  /** Something outside answers into data: what these are worth is not known, and asking for them is refused. */
  private answered(name: string, args: Arguments, at: TextPlace): undefined {
    for (const expression of args.places()) {
      if (expression.kind !== "variable") continue;
      this.scopes.at(-1)?.names.delete(expression.name);
      this.globals.delete(this.globalKey(expression.name));
      this.foreign.add(expression.name);
    }
    this.remark(
      `${name} ${at.line}`,
      at,
      "a statement about the robot",
      `${this.spelt(name)} is kept and not executed: what another machine answers is not known.`,
    );
    return undefined;
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
    const frame = object === undefined ? WORLD : this.workObject(object);
    const target = this.target(goal, frame, tool, name === "movej", true);
    const passing = via === undefined ? {} : { via: this.target(via, frame, tool, false, false) };
    return { ...common, path: name === "movej" ? "ptp" : name === "movel" ? "lin" : "circ", target, ...passing };
  }

  private useTool(tool: Expression): string {
    if (tool.kind === "variable" && this.isHeldElsewhere(tool.name)) {
      this.remark(
        `tool ${tool.name}`,
        tool,
        "the module that declares the tool",
        `The tool ${this.spelt(tool.name)} is declared in no file that is open: the flange is taken for it.`,
      );
      this.tool = { mm: [0, 0, 0], wxyz: [1, 0, 0, 0] };
      this.arm.tool = this.tool;
      return nameIn(this.declared.tools, toPose<"flange", "tcp">(this.tool), this.spelt(tool.name), "_");
    }
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

  private isHeldElsewhere(name: string): boolean {
    return this.variable(name) === undefined && !this.isDatum(name) && !this.foreign.has(name);
  }

  private workObject(object: Expression): WorkObject {
    if (object.kind !== "variable" || !this.isHeldElsewhere(object.name))
      return this.objects.of(object, of => this.evaluate(of));
    this.remark(
      `object ${object.name}`,
      object,
      "the module that declares the work object",
      `The work object ${this.spelt(object.name)} is declared in no file that is open: the base of the robot is taken for it.`,
    );
    return WORLD;
  }

  /** A point that no file declares: nobody can go there. */
  private leaveOut(goal: Expression): boolean {
    let of = goal;
    while (of.kind === "call" && of.args[0]?.value !== undefined && SHIFTS.has(of.name)) of = of.args[0].value;
    if (of.kind !== "variable" || !this.isHeldElsewhere(of.name)) return false;
    this.remark(
      `point ${of.name}`,
      goal,
      "the module that declares the point",
      `The motion to ${this.spelt(of.name)} is left out: no file that is open declares the point. The robot goes on to the next point from where it is.`,
    );
    this.lost = "The robot was to be at a point that no open file declares.";
    return true;
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

const SIGNAL_TYPE = /^signal[dag][io]$/;
const COMPARES = new Set(["=", "<>", "<", ">", "<=", ">="]);
/** Functions that shift a point. */
const SHIFTS = new Set(["offs", "reltool"]);
const RECORD_DEPTH = 10;
interface WithEvent {
  readonly motion: "movej" | "movel" | "movec";
  readonly event: "do" | "ao" | "sync" | "trigg";
}
/** Motions with something that happens on their way. */
const WITH_EVENT: Readonly<Record<string, WithEvent>> = {
  movejdo: { motion: "movej", event: "do" },
  moveldo: { motion: "movel", event: "do" },
  movecdo: { motion: "movec", event: "do" },
  movejao: { motion: "movej", event: "ao" },
  movelao: { motion: "movel", event: "ao" },
  movecao: { motion: "movec", event: "ao" },
  movejsync: { motion: "movej", event: "sync" },
  movelsync: { motion: "movel", event: "sync" },
  movecsync: { motion: "movec", event: "sync" },
  triggj: { motion: "movej", event: "trigg" },
  triggl: { motion: "movel", event: "trigg" },
  triggc: { motion: "movec", event: "trigg" },
};
/** The value that a text spells: a number, TRUE or FALSE, or a record of them. */
function readValue(text: string): Value | undefined {
  const plain = text
    .trim()
    .replace(/\bTRUE\b/gi, "true")
    .replace(/\bFALSE\b/gi, "false");
  try {
    const value: unknown = JSON.parse(plain.replace(/(^|[[,\s-])\.(\d)/g, "$10.$2").replace(/(\d)\.(?!\d)/g, "$1"));
    return isValue(value) ? value : undefined;
  } catch (cause) {
    if (cause instanceof SyntaxError) return undefined;
    throw cause;
  }
}
const isValue = (value: unknown): value is Value =>
  typeof value === "number" ||
  typeof value === "boolean" ||
  typeof value === "string" ||
  (Array.isArray(value) && value.every(isValue));

const placeOnly = ({ line, column }: TextPlace): TextPlace => ({ line, column });
const isPlace = (expression: Expression): boolean =>
  expression.kind === "variable" || expression.kind === "component" || expression.kind === "index";

const unsetValue = (type: string): Value => (type === "bool" ? false : type === "string" ? "" : 0);
const POSE_0: Value = [
  [0, 0, 0],
  [0, 0, 0, 0],
];
const NO_EXTERNAL: Value = [0, 0, 0, 0, 0, 0];
/** Records of the controller that are given no value: all nought. */
const EMPTY: Readonly<Record<string, Value>> = {
  pos: [0, 0, 0],
  orient: [0, 0, 0, 0],
  pose: POSE_0,
  confdata: [0, 0, 0, 0],
  robjoint: [0, 0, 0, 0, 0, 0],
  extjoint: NO_EXTERNAL,
  robtarget: [[0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], NO_EXTERNAL],
  jointtarget: [[0, 0, 0, 0, 0, 0], NO_EXTERNAL],
  speeddata: [0, 0, 0, 0],
  wobjdata: [false, true, "", POSE_0, POSE_0],
};
const NO_AXES: Value = [9e9, 9e9, 9e9, 9e9, 9e9, 9e9];
