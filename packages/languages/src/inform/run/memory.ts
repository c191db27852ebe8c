import type { Condition as Neutral, SignalLine, Signals, TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Condition, Operand } from "../read/syntax.ts";

/** Least and greatest value of a variable, by its letter; R is a real. */
const RANGES: Readonly<Record<string, readonly [number, number]>> = {
  B: [0, 255],
  I: [-32768, 32767],
  D: [-2147483648, 2147483647],
};

const KINDS: Readonly<Record<"IN" | "OT" | "AO", SignalLine["kind"]>> = {
  IN: "digital-in",
  OT: "digital-out",
  AO: "analogue-out",
};

/** Lines in and out by number, with the names that the steps know them by. */
const lineName = (wire: "IN" | "OT" | "AO", number: number): string => `${wire.toLowerCase()}_${number}`;

/** Variables B, I, D, R and P, and the lines in and out. */
export class Memory {
  /** Whether something outside was asked for, which may change by itself. */
  asked = false;
  private readonly met: Record<string, SignalLine>;
  private readonly values = new Map<string, number>();
  private readonly positions = new Map<string, number[]>();
  private readonly outputs = new Map<number, boolean>();
  private readonly outside: Signals | undefined;

  /** @param met  receives the lines that are used, by name. */
  constructor(outside: Signals | undefined, met: Record<string, SignalLine>) {
    this.outside = outside;
    this.met = met;
  }

  value(operand: Operand): number {
    if (operand.kind === "number") return operand.value;
    if (operand.kind === "line") return this.line(operand) ? 1 : 0;
    return this.values.get(operand.name) ?? 0;
  }

  set(name: string, value: number, at: TextPlace): void {
    const letter = name.replace(/^L/, "")[0]!;
    const range = RANGES[letter];
    if (!Number.isFinite(value)) throw new TextError(at, "a finite result", "The result is not a number.");
    const whole = range === undefined ? Math.fround(value) : Math.trunc(value);
    if (range !== undefined && (whole < range[0] || whole > range[1]))
      throw new TextError(at, `a number from ${range[0]} to ${range[1]}`, `${name} cannot hold ${whole}.`);
    this.values.set(name, whole);
  }

  /** Elements of a position variable: µm and 1/10000°. */
  position(name: string): number[] {
    let values = this.positions.get(name);
    if (values === undefined) this.positions.set(name, (values = [0, 0, 0, 0, 0, 0]));
    return values;
  }

  clear(name: string, count: number): void {
    const stem = name.slice(0, -3);
    const first = Number(name.slice(-3));
    if (name.startsWith("P")) {
      this.positions.delete(name);
      return;
    }
    for (const key of [...this.values.keys()])
      if (key.slice(0, -3) === stem && Number(key.slice(-3)) >= first && Number(key.slice(-3)) < first + count)
        this.values.delete(key);
  }

  write(number: number, to: boolean): string {
    this.outputs.set(number, to);
    return this.note("OT", number);
  }

  note(wire: "IN" | "OT" | "AO", number: number): string {
    const name = lineName(wire, number);
    this.met[name] ??= { kind: KINDS[wire], address: number };
    return name;
  }

  private line({ wire, number }: Extract<Operand, { kind: "line" }>): boolean {
    const name = this.note(wire, number);
    const known = wire === "OT" ? this.outputs.get(number) : undefined;
    if (known === undefined) this.asked = true;
    return known ?? this.outside?.read(name) === true;
  }

  holds({ left, sign, right }: Condition, at: TextPlace): boolean {
    const a = this.value(left);
    const b = right === "ON" ? 1 : right === "OFF" ? 0 : this.value(right);
    switch (sign) {
      case "=":
        return a === b;
      case "<>":
        return a !== b;
      case "<":
        return a < b;
      case ">":
        return a > b;
      case "<=":
        return a <= b;
      case ">=":
        return a >= b;
      default:
        throw new TextError(at, "a comparison", "The condition compares nothing.");
    }
  }

  /** What is waited for, when it is one line that is on or off. */
  awaited({ left, sign, right }: Condition, at: TextPlace): Neutral {
    if (left.kind !== "line" || (right !== "ON" && right !== "OFF") || (sign !== "=" && sign !== "<>"))
      throw new TextError(
        at,
        "IN#(n)=ON or =OFF",
        "The job waits for something that is not one line of the controller.",
      );
    return { signal: this.note(left.wire, left.number), is: (right === "ON") === (sign === "=") };
  }
}

/** Whether looking at a condition is looking at the outside, which stops the robot at its point. */
export const looksOutside = ({ left, right }: Condition): boolean =>
  left.kind === "line" || (typeof right === "object" && right.kind === "line");
