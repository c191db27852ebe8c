import type { Condition, SignalLine, Signals, TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Expression, SignalDeclaration, Variable } from "../read/syntax.ts";
import { bool, real, type Value } from "./values.ts";

type Wire = Exclude<SignalDeclaration["wire"], "variable">;
const WIRES: Readonly<Record<string, Wire>> = { $IN: "in", $OUT: "out", $ANIN: "analogue-in", $ANOUT: "analogue-out" };
const KEY = /^(\$(?:IN|OUT|ANIN|ANOUT))\[([0-9]+)\]$/;
/** The output that a gripper hangs on is called so; TRUE closes (row T-31). */
const GRIPPER = "GRIPPER";
const CALLED: Readonly<Record<Wire, string>> = { in: "in", out: "out", "analogue-in": "anin", "analogue-out": "anout" };

const KINDS: Readonly<Record<Wire, SignalLine["kind"]>> = {
  in: "digital-in",
  out: "digital-out",
  "analogue-in": "analogue-in",
  "analogue-out": "analogue-out",
};

interface Line {
  readonly name: string;
  readonly wire: Wire;
  readonly address: number;
}

/** The lines in and out: declared with a name (`SIGNAL PART $IN[3]`), or met by their number. */
export class Lines {
  private readonly met: Record<string, SignalLine>;
  /** Whether something outside was asked for, which may change by itself. */
  asked = false;
  private readonly outside: Signals | undefined;
  private readonly byName = new Map<string, Line>();
  private readonly written = new Map<string, boolean | number>();
  /** Rows of digital lines that one number stands for, the lowest bit first. */
  private readonly groups = new Map<string, readonly string[]>();
  private readonly aliases = new Map<string, string>();

  /** @param met  receives the lines that are used, by name. */
  constructor(declared: readonly SignalDeclaration[], outside: Signals | undefined, met: Record<string, SignalLine>) {
    this.outside = outside;
    this.met = met;
    for (const { name, wire, address, last, variable } of declared) {
      if (wire === "variable") {
        this.aliases.set(name, variable ?? "");
        continue;
      }
      if (last !== undefined) {
        const variables = wire === "in" ? "$IN" : "$OUT";
        this.groups.set(
          name,
          Array.from({ length: last - address + 1 }, (_, i) => `${variables}[${address + i}]`),
        );
        continue;
      }
      const line: Line = { name: name.toLowerCase(), wire, address };
      this.byName.set(name, line);
      this.byName.set(`${wire} ${address}`, line);
    }
  }

  /** The line of a name or of `$IN[3]`, or undefined when it is none. */
  line(key: string): Line | undefined {
    const named = this.byName.get(key);
    if (named !== undefined) return this.note(named);
    const match = KEY.exec(key);
    if (match === null) return undefined;
    const wire = WIRES[match[1]!]!;
    const address = Number(match[2]);
    return this.note(this.byName.get(`${wire} ${address}`) ?? { name: `${CALLED[wire]}_${address}`, wire, address });
  }

  /** The lines of a group, or undefined for what is none. */
  group(key: string): readonly Line[] | undefined {
    if (!this.hasNames) return undefined;
    return this.groups.get(key)?.map(each => this.line(each)!);
  }

  /** Whether there are groups, or other names of system variables. */
  get hasNames(): boolean {
    return this.groups.size > 0 || this.aliases.size > 0;
  }

  /** What a name is that is another one of a system variable. */
  alias(key: string): string {
    return this.aliases.get(key) ?? key;
  }

  isGripper({ name }: Line): boolean {
    return name.toUpperCase() === GRIPPER;
  }

  read(line: Line): Value {
    const known = this.written.get(line.name);
    if (known === undefined || line.wire === "in" || line.wire === "analogue-in") this.asked = true;
    const value =
      line.wire === "out" || line.wire === "analogue-out"
        ? (known ?? this.outside?.read(line.name))
        : this.outside?.read(line.name);
    return line.wire.startsWith("analogue") ? real(Number(value ?? 0)) : bool(value === true);
  }

  /** A name that stands for an input from now on: nobody says which line it is. */
  takeForInput(name: string): void {
    const line: Line = { name: name.toLowerCase(), wire: "in", address: 0 };
    this.byName.set(name, line);
    this.met[line.name] ??= { kind: "digital-in" };
  }

  /** What is said of a name from outside, if anything. */
  given(name: string): boolean | number | undefined {
    return this.outside?.read(name);
  }

  /** A number that something outside the program decides, 0 until somebody says what it is. */
  outsideNumber(name: string): Value {
    this.asked = true;
    const value = Number(this.outside?.read(name) ?? 0);
    return { kind: "number", value, whole: true };
  }

  write(line: Line, value: boolean | number): void {
    this.written.set(line.name, value);
  }

  private note(line: Line): Line {
    if (!this.isGripper(line)) this.met[line.name] ??= { kind: KINDS[line.wire], address: line.address };
    return line;
  }

  /**
   * What the program waits for: `X`, `NOT X`, `X == TRUE`, `X > 0.5`, and several of them joined by AND. Each part is
   * waited for after the other.
   *
   * @param isTrue  what a part is worth that asks no line.
   */
  conditions(
    of: Expression,
    keyOf: (variable: Variable) => string,
    numberOf: (of: Expression) => number,
    isTrue: (of: Expression) => boolean,
  ): readonly Condition[] {
    if (of.kind === "binary" && of.sign === "AND")
      return [
        ...this.conditions(of.left, keyOf, numberOf, isTrue),
        ...this.conditions(of.right, keyOf, numberOf, isTrue),
      ];
    if (of.kind === "binary" && of.sign === "OR" && this.asksLine(of, keyOf))
      return isTrue(of)
        ? []
        : this.conditions(this.asksLine(of.left, keyOf) ? of.left : of.right, keyOf, numberOf, isTrue);
    if (this.asksLine(of, keyOf)) return [this.condition(of, keyOf, numberOf)];
    if (isTrue(of)) return [];
    throw new TextError(of, "a condition that comes true", "The program waits for what nothing here makes true.");
  }

  private asksLine(of: Expression, keyOf: (variable: Variable) => string): boolean {
    switch (of.kind) {
      case "variable":
        return this.line(this.alias(keyOf(of))) !== undefined || this.groups.has(keyOf(of));
      case "unary":
        return this.asksLine(of.of, keyOf);
      case "binary":
        return this.asksLine(of.left, keyOf) || this.asksLine(of.right, keyOf);
      case "call":
        return of.args.some(each => each !== undefined && this.asksLine(each, keyOf));
      default:
        return false;
    }
  }

  /** What the program waits for, when it is one line: `X`, `NOT X`, `X == TRUE`, `X > 0.5`. */
  condition(of: Expression, keyOf: (variable: Variable) => string, numberOf: (of: Expression) => number): Condition {
    const refuse = (at: TextPlace): never => {
      throw new TextError(
        at,
        "one line in or out, or its opposite",
        "The program waits for something that is not one line of the controller.",
      );
    };
    const named = (variable: Expression): Line => {
      const line = variable.kind === "variable" ? this.line(this.alias(keyOf(variable))) : undefined;
      return line ?? refuse(variable);
    };
    if (of.kind === "variable") return { signal: named(of).name, is: true };
    if (of.kind === "unary" && of.sign === "NOT") {
      const inner = this.condition(of.of, keyOf, numberOf);
      return "is" in inner ? { ...inner, is: !inner.is } : refuse(of);
    }
    if (of.kind !== "binary") return refuse(of);
    const { sign, left, right } = of;
    if ((sign === "==" || sign === "<>") && right.kind === "bool")
      return { signal: named(left).name, is: right.value === (sign === "==") };
    if (sign === ">" || sign === ">=") return { signal: named(left).name, above: numberOf(right) };
    if (sign === "<" || sign === "<=") return { signal: named(left).name, below: numberOf(right) };
    return refuse(of);
  }
}
