import type { Condition, Pose, Robot, Signals, Speed, Target } from "@twincell/core";
import { TextError, type DeclaredCell, inverted } from "../../parser/index.ts";
import { BlockMachine, type Expression } from "../../parser/structured/index.ts";
import type { Source } from "../read/grammar.ts";
import { ControllerArm, type Posture } from "./arm.ts";
import { NULL } from "./frame.ts";
import { FUNCTIONS } from "./functions.ts";
import { holds, lineAt } from "./lines.ts";
import { asNumber, binary, truth, type Value } from "./values.ts";

/** A setting that holds until it is said anew, and one that holds for the next motion alone. */
export interface Setting<T> {
  always: T;
  once: T | undefined;
}

const JOINTS = 6;

/** How near a passed target is passed when nothing else was said [mm]. */
const FIRST_ACCURACY_MM = 1;

/** What expressions of AS are worth, and lines that are read in them. */
export abstract class Evaluation extends BlockMachine<Value> {
  readonly declared: DeclaredCell;
  /** Variables whose place is a frame although it changes: the places of a pallet that is being read. */
  readonly places = new Set<string>();

  protected readonly arm: ControllerArm;
  private readonly constants: ReadonlySet<string>;

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

  /** A line that shall be on, or, with a minus before its number, off. */
  protected lineOf(expression: Expression): { readonly signal: string; readonly is: boolean } {
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

  protected read(line: string): boolean {
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
}
