import type { Condition, SignalLine, Signals, TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Expression, SignalDeclaration, Variable } from "../read/syntax.ts";
import { bool, real, type Value } from "./values.ts";

type Wire = SignalDeclaration["wire"];
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

  /** @param met  receives the lines that are used, by name. */
  constructor(declared: readonly SignalDeclaration[], outside: Signals | undefined, met: Record<string, SignalLine>) {
    this.outside = outside;
    this.met = met;
    for (const { name, wire, address } of declared) {
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

  write(line: Line, value: boolean | number): void {
    this.written.set(line.name, value);
  }

  private note(line: Line): Line {
    if (!this.isGripper(line)) this.met[line.name] ??= { kind: KINDS[line.wire], address: line.address };
    return line;
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
      const line = variable.kind === "variable" ? this.line(keyOf(variable)) : undefined;
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
