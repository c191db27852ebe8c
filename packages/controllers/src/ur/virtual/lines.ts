import type { Signals, TextContext } from "@twincell/core";
import type { Memory } from "./memory.ts";

/** Lines by their name in a program text, joined with the lines of the control box. */
const ANALOGUE_IN = ["standard_analog_input0", "standard_analog_input1", "tool_analog_input0", "tool_analog_input1"];
const ANALOGUE_OUT = ["standard_analog_output0", "standard_analog_output1"];
export const GRIPPER_BIT = 16;

/** What a program wrote goes to the control box, and what the box reads goes to the program. */
export class NamedLines {
  private readonly memory: Memory;
  readonly signals: Signals;
  private context: TextContext["signals"] = undefined;
  private readonly seen = new Map<string, boolean | number>();
  constructor(memory: Memory, signals: Signals) {
    this.memory = memory;
    this.signals = signals;
  }

  begin(context: TextContext["signals"]): void {
    this.context = context;
    this.seen.clear();
    for (const [name, { kind, address }] of Object.entries(context ?? {})) {
      if (kind === "digital-out" && address !== undefined) {
        const is = this.memory.digital("output", address);
        this.signals.write(name, is);
        this.seen.set(name, is);
      }
    }
  }

  cycle(): void {
    const { memory, signals, context } = this;
    if (!context) return;
    for (const name in context) {
      const { kind, address } = context[name]!;
      if (address === undefined) continue;
      if (kind === "digital-in") {
        signals.write(name, memory.digital("input", address));
        continue;
      }
      if (kind === "analogue-in") {
        const slot = ANALOGUE_IN[address];
        if (slot) signals.write(name, memory.get(slot));
        continue;
      }
      const value = signals.read(name);
      if (this.seen.get(name) === value) continue;
      this.seen.set(name, value);
      if (kind === "digital-out")
        memory.setDigital("output", address, value === true || (typeof value === "number" && value !== 0));
      else {
        const slot = ANALOGUE_OUT[address];
        if (slot) memory.set(slot, Number(value));
      }
    }
  }
}
