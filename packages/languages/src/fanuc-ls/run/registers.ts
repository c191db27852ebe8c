import type { Condition, Pose, Robot, Signals, TextPlace } from "@twincell/core";
import { TextError, rememberMap, type DeclaredCell, type Notices } from "../../parser/index.ts";
import { BlockMachine, type Expression } from "../../parser/structured/index.ts";
import type { PositionRecord } from "../read/listing.ts";
import type { Source } from "../read/source.ts";
import { FUNCTIONS } from "../read/statements.ts";
import { ControllerArm } from "./arm.ts";
import { applied } from "./functions.ts";
import { Lines, isLineWord } from "./lines.ts";
import { inverted, times, toSix } from "./matrix.ts";
import { Setups } from "./setups.ts";
import { UNKNOWN, asNumber, binary, isJoints, isSix, type Value } from "./values.ts";

/** A position register that is the difference of two others: how far a place is from the first. */
export interface Difference {
  readonly present: string;
  readonly first: string;
}

/** Registers, flags, lines and positions of a controller, and what expressions are worth with them. */
export abstract class RegisterMachine extends BlockMachine<Value> {
  readonly arm: ControllerArm;
  readonly declared: DeclaredCell;
  protected readonly source: Source;
  protected readonly lines: Lines;
  protected readonly setups: Setups;
  protected readonly notices: Notices | undefined;
  protected readonly differences = new Map<string, Difference>();
  /** Arguments of the calls under way, the innermost last. */
  protected readonly given: (readonly Value[])[] = [];
  /** How many values were asked for that only the controller knows. */
  protected unknowns = 0;
  /** Positions of a program that were given another value, by program and number. */
  protected readonly moved = new Map<string, Value>();

  /**
   * @param notices  takes what only the controller knows, as registers that no file holds; without, such a thing is
   *   refused.
   */
  constructor(
    source: Source,
    robot: Robot,
    worldFromBase: Pose<"world", "base">,
    declared: DeclaredCell,
    signals: Signals | undefined,
    notices: Notices | undefined,
  ) {
    super(source.routines);
    this.notices = notices;
    this.source = source;
    this.arm = new ControllerArm(robot, worldFromBase);
    this.declared = declared;
    this.lines = new Lines(declared.signals, signals, name => this.spelt(name));
    this.setups = new Setups(declared, this.arm, notices);
    for (const [number, value] of source.registers.numbers) this.globals.set(`r${number}`, value);
    for (const [number, { joints, values }] of source.registers.positions)
      this.globals.set(`pr${number}`, joints ? { joints_deg: values } : values);
  }

  spelt(name: string): string {
    const { labels, spelling } = this.source;
    return (
      labels.get(name) ??
      spelling.get(name) ??
      name.replace(/^([a-z]+)([0-9]+)$/, (_, word: string, number: string) => `${word.toUpperCase()}[${number}]`)
    );
  }

  /** A register by its number, with the name that a person gave it. */
  protected called(name: string): string {
    const plain = name.startsWith("$")
      ? name.toUpperCase()
      : name.replace(/^([a-z]+)([0-9]+)$/, (_, word: string, number: string) => `${word.toUpperCase()}[${number}]`);
    const label = this.source.labels.get(name);
    return label === undefined ? plain : `${plain} (${label})`;
  }

  evaluate(expression: Expression): Value {
    switch (expression.kind) {
      case "number":
      case "truth":
        return expression.value;
      case "variable":
        return this.namedValue(expression);
      case "index":
        return this.elementOf(expression);
      case "unary":
        return expression.sign === "!" ? !this.isTrue(expression.of) : -this.numberOf(expression.of);
      case "binary":
        return binary(expression.sign, this.evaluate(expression.left), this.evaluate(expression.right), expression);
      default:
        throw new TextError(expression, "a value of TP", "This is no value of TP.");
    }
  }

  /** Where the robot is, or a register. */
  private namedValue(expression: Extract<Expression, { kind: "variable" }>): Value {
    if (expression.name === "jpos") return { joints_deg: this.arm.isLost ? UNKNOWN : this.arm.shown() };
    if (expression.name === "lpos" && this.arm.isLost) return UNKNOWN;
    if (expression.name === "lpos")
      return [
        ...toSix(
          times(
            times(inverted(this.setups.now("uframe", expression).matrix), this.arm.flange),
            this.setups.now("utool", expression).matrix,
          ),
        ),
      ];
    return this.register(expression.name, expression);
  }

  /** A register, a line or a function with its number. */
  private elementOf(expression: Extract<Expression, { kind: "index" }>): Value {
    const { of, indices } = expression;
    const word = of.kind === "variable" ? of.name : "";
    const [first, second] = indices.map(index => this.numberOf(index));
    if (isLineWord(word)) return this.lines.read(this.lines.line(word, first!, expression));
    if (word === "ar") {
      const argument = this.given.at(-1)?.[first! - 1];
      if (argument === undefined && this.notices !== undefined)
        return this.unknown(expression, `The program is called without an argument ${first}: it is taken as 0.`);
      if (argument === undefined)
        throw new TextError(
          expression,
          "an argument of the call",
          `The program is called without an argument ${first}.`,
        );
      return argument;
    }
    if (FUNCTIONS.has(word)) return applied(word, first!, expression);
    if (word === "p") return this.taught(first!, expression);
    if (word === "uframe" || word === "utool")
      return toSix(this.setups.of(word, this.indexOf(first!, word), expression).matrix);
    if (word === "timer" && this.notices !== undefined)
      return this.unknown(expression, `TIMER[${first}] is the controller's: it is taken as 0.`);
    if (word !== "r" && word !== "pr")
      throw new TextError(expression, "R[n], PR[n] or a line", `${word.toUpperCase()}[] is not read here.`);
    return this.registerValue(expression, word, second, first);
  }

  /** A register, or an element of it. */
  private registerValue(
    expression: Extract<Expression, { kind: "index" }>,
    word: string,
    second: number | undefined,
    first: number | undefined,
  ): Value {
    const value = this.register(`${word}${first}`, expression);
    if (second === undefined) return value;
    const part = (isSix(value) ? value : isJoints(value) ? value.joints_deg : [])[second - 1];
    if (part === undefined)
      throw new TextError(expression, "PR[n,1] … PR[n,6]", `PR[${first}] has no element ${second}.`);
    if (Number.isNaN(part))
      return this.unknown(
        expression,
        `${this.spelt(`pr${first}`)},${second} is in none of the files: it is taken as 0.`,
      );
    return part;
  }

  /** A value that only the controller knows: 0, which is said. */
  protected unknown(at: TextPlace, sentence: string): number {
    this.unknowns++;
    this.notices?.notGiven(at, sentence);
    return 0;
  }

  protected indexOf(number: number, what: "uframe" | "utool"): number {
    return Number.isInteger(number) ? number : (this.setups.inUse[what] ?? 0);
  }

  /** P[n] of the program that runs, as a value. */
  protected taught(number: number, at: TextPlace): Value {
    const moved = this.moved.get(this.positionKey(number));
    if (moved !== undefined) return moved;
    const record = this.listed(number, at);
    if (record.values === undefined) return UNKNOWN;
    return record.joints ? { joints_deg: record.values } : record.values;
  }
  protected positionKey(number: number): string {
    return `${this.scopes.at(-1)?.routine ?? ""} ${number}`;
  }
  protected listed(number: number, at: TextPlace): PositionRecord {
    const record = this.source.positions.get(this.scopes.at(-1)?.routine ?? "")?.get(number);
    if (record === undefined)
      throw new TextError(at, "a position in /POS", `P[${number}] is not in the list of positions.`);
    return record;
  }

  protected register(name: string, at: TextPlace): Value {
    const value = this.holder(name).get(name);
    if (value === undefined && this.notices !== undefined) {
      if (name.startsWith("$") || /^r[0-9]+$/.test(name))
        return this.unknown(at, `${this.called(name)} is in none of the files: it is taken as 0.`);
      if (/^pr[0-9]+$/.test(name)) {
        this.unknowns++;
        return UNKNOWN;
      }
    }
    if (value === undefined)
      throw new TextError(at, "a register that has a value", `${this.spelt(name)} has no value here.`);
    return value;
  }

  /** Where a register is kept: those that loops count in belong to the call. */
  protected holder(name: string): Map<string, Value> {
    return this.scopes.findLast(({ names }) => names.has(name))?.names ?? this.globals;
  }

  isTrue(expression: Expression): boolean {
    const when = this.condition(expression);
    if (when !== undefined) return this.lines.holds(when);
    const value = this.evaluate(expression);
    if (typeof value !== "boolean") throw new TextError(expression, "a condition", "A number is no condition.");
    return value;
  }
  numberOf(expression: Expression): number {
    return asNumber(this.evaluate(expression), expression);
  }
  fromNumber(value: number): Value {
    return value;
  }

  protected store(to: Expression, value: Value): void {
    if (to.kind === "variable") {
      const taken = to.name.startsWith("r") && typeof value === "boolean" ? Number(value) : value;
      if (to.name.startsWith("pr") !== (typeof taken === "object"))
        throw new TextError(
          to,
          to.name.startsWith("pr") ? "a position" : "a number",
          `${this.spelt(to.name)} cannot hold this.`,
        );
      this.holder(to.name).set(to.name, taken);
      return;
    }
    if (to.kind !== "index" || to.of.kind !== "variable")
      throw new TextError(to, "a register", "Only a register can be given a value.");
    const word = to.of.name;
    const [number, element] = to.indices.map(index => this.numberOf(index));
    const name = `${word}${number}`;
    this.differences.delete(name);
    if (element === undefined) {
      this.globals.set(name, word === "r" && typeof value === "boolean" ? Number(value) : value);
      return;
    }
    return this.storeElement(to, value, element, number, name);
  }

  /** An element of a position register. */
  private storeElement(to: Expression, value: Value, element: number, number: number | undefined, name: string): void {
    const before = this.globals.get(name) ?? (this.notices === undefined ? [0, 0, 0, 0, 0, 0] : UNKNOWN);
    if (isJoints(before) && Number.isInteger(element) && element >= 1 && element <= 6) {
      this.globals.set(name, { joints_deg: before.joints_deg.with(element - 1, asNumber(value, to)) });
      return;
    }
    // Elements beyond the sixth belong to further axes.
    if (this.notices !== undefined && isSix(before) && Number.isInteger(element) && element > 6 && element <= 9) {
      this.notices.add(
        to,
        "the axes of one arm",
        `PR[${number},${element}] belongs to a further axis: it is not moved.`,
      );
      return;
    }
    if (!isSix(before) || !Number.isInteger(element) || element < 1 || element > 6)
      throw new TextError(to, "PR[n,1] … PR[n,6]", `PR[${number}] has no element ${element}.`);
    this.globals.set(name, before.with(element - 1, asNumber(value, to)));
  }

  /** PR[n] */
  protected registerName(expression: Expression): string | undefined {
    return expression.kind === "index" &&
      expression.of.kind === "variable" &&
      expression.of.name === "pr" &&
      expression.indices.length === 1
      ? `pr${this.numberOf(expression.indices[0]!)}`
      : undefined;
  }

  condition(expression: Expression): Condition | undefined {
    return this.lines.condition(expression, of => this.numberOf(of));
  }

  protected rememberRegisters(): () => void {
    const kept = [
      this.lines.remember(),
      this.setups.remember(),
      rememberMap(this.differences),
      rememberMap(this.moved),
    ];
    return () => {
      for (const back of kept) back();
    };
  }
}
