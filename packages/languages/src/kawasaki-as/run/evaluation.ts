import type { Condition, Pose, Robot, Signals, Speed, Target, TextPlace } from "@twincell/core";
import { NotGiven, TextError, type DeclaredCell, type Notices, inverted } from "../../parser/index.ts";
import { BlockMachine, type Argument, type Expression, type Routine } from "../../parser/structured/index.ts";
import type { Source } from "../read/grammar.ts";
import { ControllerArm, type Posture } from "./arm.ts";
import { NULL } from "./frame.ts";
import { FUNCTIONS } from "./functions.ts";
import { holds, lineAt } from "./lines.ts";
import { asNumber, binary, isUnknown, truth, type Value } from "./values.ts";

/** A setting that holds until it is said anew, and one that holds for the next motion alone. */
export interface Setting<T> {
  always: T;
  once: T | undefined;
}

const JOINTS = 6;

/** How near a passed target is passed when nothing else was said [mm]. */
const FIRST_ACCURACY_MM = 1;

/** Where a text runs. */
export interface Stage {
  readonly source: Source;
  /** Variables that get their value once: a place in one of them is a frame of the program. */
  readonly constants: ReadonlySet<string>;
  readonly robot: Robot;
  readonly worldFromBase: Pose<"world", "base">;
  readonly declared: DeclaredCell;
  readonly signals?: Signals | undefined;
  /** Takes what only the controller knows; without, such a thing is refused. */
  readonly notices?: Notices | undefined;
}

/** What expressions of AS are worth, and lines that are read in them. */
export abstract class Evaluation extends BlockMachine<Value> {
  readonly declared: DeclaredCell;
  /** Variables whose place is a frame although it changes: the places of a pallet that is being read. */
  readonly places = new Set<string>();

  protected readonly arm: ControllerArm;
  private readonly constants: Set<string>;
  protected readonly notices: Notices | undefined;

  protected readonly outputs = new Map<string, boolean>();
  private readonly signals: Signals | undefined;

  protected tool = "flange";
  /** Whether the tool was said where the program is now; joint angles alone do not ask for one. */
  protected hasTool = false;

  /** The variable that BASE was given, where its value never changes. */
  protected baseName: string | undefined;
  protected speed: Setting<Speed> = { always: { ratio: 1 }, once: undefined };

  protected accuracy: Setting<number> = { always: FIRST_ACCURACY_MM, once: undefined };
  protected acceleration: Setting<number> = { always: 1, once: undefined };

  protected posture: Posture = {};
  protected via: Target | undefined;

  protected passes = true;

  constructor({ source, constants, robot, worldFromBase, declared, signals, notices }: Stage) {
    super(source.routines);
    this.arm = new ControllerArm(robot, worldFromBase);
    this.declared = declared;
    this.constants = new Set(constants);
    this.signals = signals;
    this.notices = notices;
  }

  /** Names with a dot before them belong to one call, all others to the controller. */
  protected variable(name: string): Value | undefined {
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
        const other = this.evaluate(right);
        if (isUnknown(value) || isUnknown(other)) return this.withUnknown(expression, value, other);
        const frame =
          left.kind === "variable" &&
          (this.places.has(left.name) || this.constants.has(left.name)) &&
          this.baseName === undefined
            ? left.name
            : undefined;
        return binary(sign, value, other, frame, expression);
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
          if (this.arm.isLost) return { kind: "unknown", name: "Where the robot is" };
          return { kind: "place", at: this.arm.here() };
        case "pi":
          return Math.PI;
        default:
          break;
      }
    }
    const key = this.keyOf(expression);
    const value = key.endsWith("[]") ? this.row(key) : (this.variable(key) ?? this.ofRow(expression, key));
    if (value === undefined && this.notices !== undefined) return { kind: "unknown", name: key };
    if (value === undefined)
      throw new TextError(expression, "a variable that has a value", `"${key}" has no value yet.`);
    return value;
  }

  /** All values of `p[]`, which stands for the whole of a row. */
  private row(name: string): Value {
    const known = this.variable(name);
    if (known !== undefined) return known;
    const values = new Map<string, Value>();
    const start = name.slice(0, -1);
    for (const names of [this.globals, this.scopes.at(-1)?.names ?? []])
      for (const [key, value] of names) if (key.startsWith(start)) values.set(key.slice(start.length, -1), value);
    return { kind: "row", values };
  }

  /** An element of a row that was handed over. */
  private ofRow(expression: Expression, key: string): Value | undefined {
    if (expression.kind !== "index") return undefined;
    const start = key.indexOf("[");
    const row = this.variable(`${key.slice(0, start)}[]`);
    if (typeof row !== "object" || row.kind === "unknown") return row;
    return row.kind === "row" ? row.values.get(key.slice(start + 1, -1)) : undefined;
  }

  /**
   * A sign beside something that only the controller knows: beside a number it is one, beside a text a text, beside a
   * place it stays unknown.
   */
  private withUnknown(of: Extract<Expression, { kind: "binary" }>, a: Value, b: Value): Value {
    const known = isUnknown(a) ? b : a;
    const name = isUnknown(a) ? a.name : isUnknown(b) ? b.name : "";
    if (typeof known === "string") {
      if (of.sign === "+") return { kind: "unknown", name };
      this.notices?.notGiven(of, `${name} is in none of the files: it is taken as an empty text.`);
      return binary(of.sign, isUnknown(a) ? "" : a, isUnknown(b) ? "" : b, undefined, of);
    }
    if (typeof known === "object" && (known.kind !== "unknown" || of.sign === "+" || of.sign === "-"))
      return { kind: "unknown", name };
    return binary(of.sign, this.number(a, of.left), this.number(b, of.right), undefined, of);
  }

  /** A number; one that only the controller knows is 0, which is said. */
  protected number(value: Value, at: TextPlace): number {
    if (!isUnknown(value)) return asNumber(value, at);
    this.notices?.notGiven(at, `${value.name} is in none of the files: it is taken as 0.`);
    return 0;
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
    if (sign === "not") return truth(this.number(value, at) === 0);
    if (isUnknown(value)) return value;
    return typeof value === "object" && value.kind === "place"
      ? { kind: "place", at: inverted(value.at) }
      : -asNumber(value, at);
  }

  isTrue(expression: Expression): boolean {
    return this.numberOf(expression) !== 0;
  }

  numberOf(expression: Expression): number {
    return this.number(this.evaluate(expression), expression);
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

  /** A program gives the variables that it was called with what it made of its parameters. */
  protected override handBack(
    routine: Routine,
    names: ReadonlyMap<string, Value>,
    args: readonly Argument[],
    before: ReadonlyMap<string, Value>,
  ): void {
    super.handBack(routine, names, args, before);
    for (const [i, { name }] of routine.parameters.entries()) {
      const to = args[i]?.value;
      if (to !== undefined && name.endsWith("[]")) this.rowBack(to, name, names);
    }
  }

  protected override changed(to: Expression): void {
    if (to.kind === "variable") this.constants.delete(to.name);
  }

  private rowBack(to: Expression, name: string, names: ReadonlyMap<string, Value>): void {
    if (to.kind !== "variable" || !to.name.endsWith("[]")) return;
    const start = name.slice(0, -1);
    const own = to.name.startsWith(".") || /^[#$]\./.test(to.name);
    for (const [key, value] of names)
      if (key.startsWith(start) && key !== name)
        (own ? (this.scopes.at(-1)?.names ?? this.globals) : this.globals).set(
          `${to.name.slice(0, -1)}${key.slice(start.length)}`,
          value,
        );
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
    if (known === undefined && this.notices !== undefined) return { kind: "unknown", name: `${name.toUpperCase()}()` };
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
    const values = args.flatMap(({ value }) => (value === undefined ? [] : [this.evaluate(value)]));
    return values.find(isUnknown) ?? run(values, expression);
  }

  /** A line that shall be on, or, with a minus before its number, off. */
  protected lineOf(
    expression: Expression,
    kind: "digital-in" | "digital-out" = "digital-in",
  ): { readonly signal: string; readonly is: boolean } {
    const bare = expression.kind === "unary" && expression.sign === "-" ? expression.of : expression;
    const held = this.evaluate(bare);
    // A line whose number only the controller knows goes by its name.
    if (isUnknown(held)) {
      const { signals } = this.declared;
      if (signals[held.name] === undefined || kind === "digital-out") signals[held.name] = { kind };
      return { signal: held.name, is: bare === expression };
    }
    const number = this.numberOf(expression);
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

  protected read(line: string): boolean {
    return this.outputs.get(line) ?? this.signals?.read(line) === true;
  }

  /** Where the arm is, for what counts from there. */
  protected hereFor(at: TextPlace): ReturnType<ControllerArm["here"]> {
    if (this.arm.isLost) throw new NotGiven(at, "a place", "Where the robot then is is in none of the files");
    return this.arm.here();
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
}
