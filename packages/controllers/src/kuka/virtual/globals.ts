import { krlBool, krlReal, krlStruct, readKrlValue, REAL_DIGITS, type KrlValue } from "../codec/values.ts";

export type GlobalType = "INT" | "REAL" | "BOOL" | "E6AXIS" | "E6POS";
interface Entry {
  readonly type: GlobalType;
  value: KrlValue;
  text: string;
}

/** The global variables of the programs on the controller, typed as they are declared. */
export class Globals {
  private readonly entries = new Map<string, Entry>();
  private readonly digits: number;
  constructor(declared: readonly (readonly [string, GlobalType, string])[], digits = REAL_DIGITS) {
    this.digits = digits;
    for (const [name, type, text] of declared) {
      this.entries.set(name, { type, value: { kind: "number", value: 0 }, text });
      if (!this.write(name, text)) throw new RangeError(`${name} cannot begin with ${text}.`);
    }
  }
  text(name: string): string | undefined {
    return this.entries.get(name)?.text;
  }
  number(name: string): number {
    const value = this.entries.get(name)?.value;
    return value?.kind === "number" ? value.value : NaN;
  }
  bool(name: string): boolean {
    const value = this.entries.get(name)?.value;
    return value?.kind === "bool" && value.value;
  }
  /**
   * False when there is no such variable or the value is not of its type. A part left out of a structure stays as it
   * is.
   */
  write(name: string, text: string): boolean {
    const entry = this.entries.get(name);
    const read = readKrlValue(text);
    if (!entry || read.kind !== "value") return false;
    const { value } = read;
    switch (entry.type) {
      case "INT":
        if (value.kind !== "number" || !Number.isInteger(value.value) || Math.abs(value.value) > 0x7fffffff)
          return false;
        entry.text = String(value.value);
        break;
      case "REAL":
        if (value.kind !== "number") return false;
        entry.text = krlReal(value.value, this.digits);
        break;
      case "BOOL":
        if (value.kind !== "bool") return false;
        entry.text = krlBool(value.value);
        break;
      default:
        return this.writeStruct(entry, value);
    }
    entry.value = value;
    return true;
  }
  set(name: string, value: number | boolean): void {
    this.write(name, typeof value === "number" ? String(value) : krlBool(value));
  }

  private writeStruct(entry: Entry, value: KrlValue): boolean {
    if (value.kind !== "struct" || (value.type !== "" && value.type !== entry.type)) return false;
    const parts = new Map<string, KrlValue>(entry.value.kind === "struct" ? entry.value.parts : []);
    for (const [name, part] of value.parts) {
      if (part.kind !== "number" || !PARTS[entry.type as keyof typeof PARTS].includes(name)) return false;
      parts.set(name, part);
    }
    entry.value = { kind: "struct", type: entry.type, parts };
    entry.text = krlStruct(
      entry.type,
      [...parts].map(([name, part]) => [name, part.kind === "number" ? part.value : 0] as const),
      this.digits,
      ["S", "T"],
    );
    return true;
  }
}
const OUTER = ["E1", "E2", "E3", "E4", "E5", "E6"];
const PARTS = {
  E6AXIS: ["A1", "A2", "A3", "A4", "A5", "A6", ...OUTER],
  E6POS: ["X", "Y", "Z", "A", "B", "C", "S", "T", ...OUTER],
} as const;

/** $TIMER[1 … 20]: count milliseconds while they are not stopped; their flag is up above 0. */
export class Timers {
  private readonly now_ms: () => number;
  private readonly base_ms = new Float64Array(TIMERS + 1);
  private readonly since_ms = new Float64Array(TIMERS + 1).fill(NaN);
  constructor(now_ms: () => number) {
    this.now_ms = now_ms;
  }
  has(n: number): boolean {
    return n >= 1 && n <= TIMERS;
  }
  read(n: number): number {
    return Number.isNaN(this.since_ms[n]!) ? this.base_ms[n]! : this.base_ms[n]! + this.now_ms() - this.since_ms[n]!;
  }
  write(n: number, ms: number): void {
    this.base_ms[n] = ms;
    if (!Number.isNaN(this.since_ms[n]!)) this.since_ms[n] = this.now_ms();
  }
  stopped(n: number): boolean {
    return Number.isNaN(this.since_ms[n]!);
  }
  stop(n: number, stop: boolean): void {
    this.base_ms[n] = this.read(n);
    this.since_ms[n] = stop ? NaN : this.now_ms();
  }
}
const TIMERS = 20;
