import type { Condition as Neutral, SignalLine, Signals, TextPlace } from "@twincell/core";
import { TextError, type Notices, compared } from "../../parser/index.ts";
import type { Condition, Operand, Position, Wire } from "../read/syntax.ts";

/** Least and greatest value of a variable, by its letter; R is a real. */
const RANGES: Readonly<Record<string, readonly [number, number]>> = {
  B: [0, 255],
  I: [-32768, 32767],
  D: [-2147483648, 2147483647],
};

const KINDS: Readonly<Record<Wire | "AO", SignalLine["kind"]>> = {
  IN: "digital-in",
  OT: "digital-out",
  RIN: "digital-in",
  SIN: "digital-in",
  SOUT: "digital-out",
  IG: "analogue-in",
  OG: "analogue-out",
  IGH: "analogue-in",
  OGH: "analogue-out",
  AI: "analogue-in",
  AO: "analogue-out",
};
/** Lines that the neutral program has numbers for; others go by their names. */
const NUMBERED = new Set<Wire | "AO">(["IN", "OT", "AI", "AO"]);
/** An element of a position that only the controller knows. */
const ELEMENTS = 6;

/** Lines in and out by number, with the names that the steps know them by. */
const lineName = (wire: Wire | "AO", number: number): string => `${wire.toLowerCase()}_${number}`;

/** Variables B, I, D, R and P, and the lines in and out. */
export class Memory {
  /** Whether something outside was asked for, which may change by itself. */
  asked = false;
  private readonly met: Record<string, SignalLine>;
  private readonly values = new Map<string, number>();
  private readonly positions = new Map<string, number[]>();
  /** How the elements of a position variable are to be taken: its type, tool and frame. */
  private readonly kinds = new Map<string, Position>();
  private readonly outputs = new Map<string, boolean | number>();
  private readonly outside: Signals | undefined;
  private readonly notices: Notices | undefined;
  private readonly taught: (name: string) => Position | undefined;
  /** The instruction that is executed. */
  at: TextPlace = { line: 1, column: 1 };

  /**
   * @param met      receives the lines that are used, by name.
   * @param taught   a position variable as the job's own data give it.
   * @param notices  takes what only the controller knows; without, such a position is refused.
   */
  constructor(
    outside: Signals | undefined,
    met: Record<string, SignalLine>,
    taught: (name: string) => Position | undefined = () => undefined,
    notices?: Notices,
  ) {
    this.outside = outside;
    this.met = met;
    this.taught = taught;
    this.notices = notices;
  }

  value(operand: Operand): number {
    if (operand.kind === "number") return operand.value;
    if (operand.kind === "line") return this.line(operand);
    if (operand.kind === "sum") return this.sum(operand);
    const name = this.resolved(operand.name);
    const value = this.values.get(name);
    if (value === undefined) this.notGiven(`${name} is in none of the files: it is taken as 0.`);
    return value ?? 0;
  }

  /** B[LB014]: the variable whose number another one says. */
  private resolved(name: string): string {
    const found = /^(L?[BIDR])\[(.+)\]$/.exec(name);
    if (found === null) return name;
    const number = /^[0-9]+$/.test(found[2]!) ? Number(found[2]) : this.value({ kind: "variable", name: found[2]! });
    return `${found[1]!}${String(Math.trunc(number)).padStart(3, "0")}`;
  }

  private sum({ sign, left, right }: Extract<Operand, { kind: "sum" }>): number {
    const a = this.value(left);
    const b = this.value(right);
    if (sign === "/" && b === 0) throw new TextError(this.at, "a divisor other than 0", "The divisor is 0.");
    return sign === "+" ? a + b : sign === "-" ? a - b : sign === "*" ? a * b : a / b;
  }

  notGiven(sentence: string): void {
    this.notices?.notGiven(this.at, sentence);
  }

  set(to: string, value: number, at: TextPlace): void {
    const name = this.resolved(to);
    const letter = name.replace(/^L/, "")[0]!;
    const range = RANGES[letter];
    if (!Number.isFinite(value)) throw new TextError(at, "a finite result", "The result is not a number.");
    const whole = range === undefined ? Math.fround(value) : Math.trunc(value);
    if (range !== undefined && (whole < range[0] || whole > range[1]))
      throw new TextError(at, `a number from ${range[0]} to ${range[1]}`, `${name} cannot hold ${whole}.`);
    this.values.set(name, whole);
  }

  /** Elements of a position variable: µm and 1/10000°, or pulses. NaN is what only the controller knows. */
  position(name: string): number[] {
    let values = this.positions.get(name);
    if (values === undefined) {
      const taught = this.taught(name);
      if (taught !== undefined) this.kinds.set(name, taught);
      values = taught === undefined ? this.nobodys() : elementsOf(taught);
      this.positions.set(name, values);
    }
    return values;
  }

  private nobodys(): number[] {
    return Array<number>(ELEMENTS).fill(this.notices === undefined ? 0 : NaN);
  }

  /** As `position`; elements that only the controller knows are 0, which is said. */
  known(name: string): number[] {
    const values = this.position(name);
    if (values.some(Number.isNaN))
      this.notGiven(`${name} is in none of the files: what is not known of it is taken as 0.`);
    return values.map(value => (Number.isNaN(value) ? 0 : value));
  }

  /** A position variable that the program has given a value, as a position; undefined where it still is as taught. */
  given(name: string): Position | undefined {
    const values = this.positions.get(name);
    if (values === undefined) return undefined;
    const kind = this.kinds.get(name);
    if (kind === undefined) return { ...this.at, type: "BASE", user: 0, tool: 0, rconf: [], values: inUnits(values) };
    return { ...kind, values: kind.type === "PULSE" ? values : inUnits(values, kind.type) };
  }

  setPosition(name: string, values: readonly number[], kind: Position | undefined): void {
    this.positions.set(name, [...values]);
    if (kind === undefined) this.kinds.delete(name);
    else this.kinds.set(name, kind);
  }
  kindOf(name: string): Position | undefined {
    this.position(name);
    return this.kinds.get(name);
  }
  /** From now on only the controller knows what it is. */
  forget(name: string): void {
    if (/^L?P/.test(name)) this.setPosition(name, this.nobodys(), undefined);
    else this.values.set(this.resolved(name), 0);
  }

  clear(name: string, count: number): void {
    const stem = name.slice(0, -3);
    const first = Number(name.slice(-3));
    if (/^L?P/.test(name)) {
      this.setPosition(name, Array<number>(ELEMENTS).fill(0), undefined);
      return;
    }
    for (const key of [...this.values.keys()])
      if (key.slice(0, -3) === stem && Number(key.slice(-3)) >= first && Number(key.slice(-3)) < first + count)
        this.values.delete(key);
  }

  write(number: number, to: boolean | number, wire: Wire = "OT"): string {
    const name = this.note(wire, number);
    this.outputs.set(name, to);
    return name;
  }

  note(wire: Wire | "AO", number: number): string {
    const name = lineName(wire, number);
    this.met[name] ??= NUMBERED.has(wire) ? { kind: KINDS[wire], address: number } : { kind: KINDS[wire] };
    return name;
  }

  private line({ wire, number }: Extract<Operand, { kind: "line" }>): number {
    const name = this.note(wire, number);
    const known = this.outputs.get(name);
    if (known === undefined) this.asked = true;
    return Number(known ?? this.outside?.read(name) ?? 0);
  }

  holds({ more, ...first }: Condition, at: TextPlace): boolean {
    let result = this.compares(first, at);
    for (const { join, condition } of more ?? [])
      result = join === "and" ? this.compares(condition, at) && result : this.compares(condition, at) || result;
    return result;
  }

  private compares({ left, sign, right }: Condition, at: TextPlace): boolean {
    const a = this.value(left);
    const b = right === "ON" ? 1 : right === "OFF" ? 0 : this.value(right);
    const answer = compared(sign, a, b);
    if (answer === undefined) throw new TextError(at, "a comparison", "The condition compares nothing.");
    return answer;
  }

  /** What is waited for, when it is one line that is on or off. */
  awaited({ left, sign, right, more }: Condition, at: TextPlace): Neutral {
    if (
      more !== undefined ||
      left.kind !== "line" ||
      (right !== "ON" && right !== "OFF") ||
      (sign !== "=" && sign !== "<>")
    )
      throw new TextError(
        at,
        "IN#(n)=ON or =OFF",
        "The job waits for something that is not one line of the controller.",
      );
    return { signal: this.note(left.wire, left.number), is: (right === "ON") === (sign === "=") };
  }
}

/** Whether looking at a condition is looking at the outside, which stops the robot at its point. */
export const looksOutside = ({ left, right, more }: Condition): boolean =>
  left.kind === "line" ||
  (typeof right === "object" && right.kind === "line") ||
  (more ?? []).some(({ condition }) => looksOutside(condition));

/** Elements of a position as instructions count them. */
function elementsOf({ type, values }: Position): number[] {
  if (type === "PULSE") return [...values];
  return values.map((value, i) => Math.round(value * (type === "ANGLE" || i >= 3 ? 10_000 : 1000)));
}
/** The other way: mm and degrees. */
const inUnits = (values: readonly number[], type: Position["type"] = "BASE"): readonly number[] =>
  values.map((value, i) => value / (type === "ANGLE" || i >= 3 ? 10_000 : 1000));
