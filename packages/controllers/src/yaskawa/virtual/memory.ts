import type { Signals } from "@twincell/core";
import { EXAMPLE_OUTPUTS, EXAMPLE_OUTPUT_GROUPS, KINDS, ioGroupOf, type ValueKind } from "../codec/index.ts";

/** Variables and registers of a controller, each as its bytes; kept over a restart. */
export class Variables {
  private readonly values = new Map<string, Uint8Array>();

  kind(command: number): ValueKind | undefined {
    return KINDS.find(kind => kind.command === command);
  }

  /** Undefined for a position that was never written; everything else begins as zeros. */
  read({ command, bytes, whole }: ValueKind, number: number): Uint8Array | undefined {
    return this.values.get(`${command} ${number}`) ?? (whole ? undefined : new Uint8Array(bytes));
  }
  write({ command, bytes }: ValueKind, number: number, value: Uint8Array): void {
    const kept = new Uint8Array(bytes);
    kept.set(value.subarray(0, bytes));
    this.values.set(`${command} ${number}`, kept);
  }
}

/** Of each kind of group, the first: general lines carry the numbers of IN#() and OT#(). */
const GENERAL_IN = 1;
const GENERAL_OUT = 1001;
const NETWORK_IN = 2701;
const NETWORK_OUT = 3701;
const NETWORK_LAST = 256;

/**
 * Lines in and out in groups of eight. The ladder of this virtual controller is an example: network inputs are joined
 * to the general inputs of the same place, those from 27170 on switch general outputs when they change, and general
 * outputs are repeated as network outputs.
 */
export class Lines {
  private readonly signals: Signals;
  private readonly network = new Map<number, number>();
  private readonly pressed = new Map<number, boolean>();
  private readonly other = new Map<number, number>();

  /** @param signals  of the job being executed, by the names that INFORM's interpreter gives: in_1, ot_1, … */
  constructor(signals: Signals) {
    this.signals = signals;
  }

  /** Undefined for a group there is not. */
  read(group: number): number | undefined {
    switch (ioGroupOf(group)?.name) {
      case undefined:
        return undefined;
      case "network input":
        return this.network.get(group) ?? 0;
      case "general input":
        return this.bits(number => this.input(number), group - GENERAL_IN);
      case "general output":
        return this.bits(number => this.signals.read(`ot_${number}`) === true, group - GENERAL_OUT);
      case "network output":
        return this.bits(number => this.signals.read(`ot_${number}`) === true, group - NETWORK_OUT);
      default:
        return this.other.get(group) ?? 0;
    }
  }

  /** Only network inputs are written from outside; false for any other group. */
  write(group: number, value: number): boolean {
    if (ioGroupOf(group)?.name !== "network input") return false;
    const changed = value ^ (this.network.get(group) ?? 0);
    const place = group - EXAMPLE_OUTPUTS / 10;
    this.network.set(group, value);
    if (place >= 0 && place < EXAMPLE_OUTPUT_GROUPS)
      for (let bit = 0; bit < 8; bit++)
        if (changed & (1 << bit)) this.signals.write(`ot_${8 * place + bit + 1}`, (value & (1 << bit)) !== 0);
    for (let bit = 0; bit < 8; bit++) this.tell(8 * (group - NETWORK_IN) + bit + 1);
    return true;
  }

  /** What is wired to general input IN#(number). */
  setInput(number: number, on: boolean): void {
    this.pressed.set(number, on);
    this.tell(number);
  }
  /** Groups that the controller itself fills. */
  set(group: number, value: number): void {
    this.other.set(group, value);
  }

  /** Whether IN#(number) is on, wired or written over the network. */
  isIn(number: number): boolean {
    return this.input(number);
  }
  /** Whether OT#(number) is on. */
  isOut(number: number): boolean {
    return this.signals.read(`ot_${number}`) === true;
  }
  private input(number: number): boolean {
    const group = Math.floor((number - 1) / 8);
    const bit = (number - 1) % 8;
    return (
      this.pressed.get(number) === true ||
      (group < NETWORK_LAST && ((this.network.get(NETWORK_IN + group) ?? 0) & (1 << bit)) !== 0)
    );
  }
  private tell(number: number): void {
    this.signals.write(`in_${number}`, this.input(number));
  }
  private bits(is: (number: number) => boolean, place: number): number {
    let value = 0;
    for (let bit = 0; bit < 8; bit++) if (is(8 * place + bit + 1)) value |= 1 << bit;
    return value;
  }
}
