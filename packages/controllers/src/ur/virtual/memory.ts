import { slotOf, SLOTS, type Field } from "../codec/rtde-fields.ts";

/** Every variable of the controller in one array, as RTDE names them, and when a client last wrote each input. */
export class Memory {
  readonly slots = new Float64Array(SLOTS);
  private readonly written_s = new Float64Array(SLOTS).fill(-Infinity);
  private readonly places = new Map<string, number>();

  slotOf(name: string): number {
    let slot = this.places.get(name);
    if (slot === undefined) {
      slot = slotOf(name);
      this.places.set(name, slot);
    }
    return slot;
  }
  get(name: string): number {
    return this.slots[this.slotOf(name)]!;
  }
  set(name: string, value: number): void {
    this.slots[this.slotOf(name)] = value;
  }
  setAll(name: string, values: ArrayLike<number>, count = 6): void {
    const slot = this.slotOf(name);
    for (let i = 0; i < count; i++) this.slots[slot + i] = values[i] ?? 0;
  }
  touch(fields: readonly Field[], now_s: number): void {
    for (const { slot } of fields) this.written_s[slot] = now_s;
  }
  /** When a client last wrote that input; −∞ when none did. */
  writtenAt_s(name: string): number {
    return this.written_s[this.slotOf(name)]!;
  }

  digital(side: "input" | "output", bit: number): boolean {
    return (this.get(`actual_digital_${side}_bits`) & (1 << bit)) !== 0;
  }
  setDigital(side: "input" | "output", bit: number, on: boolean): void {
    const name = `actual_digital_${side}_bits`;
    const bits = this.get(name);
    this.set(name, (on ? bits | (1 << bit) : bits & ~(1 << bit)) >>> 0);
  }
}
