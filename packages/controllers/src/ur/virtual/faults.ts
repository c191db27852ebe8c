import { seededRandom } from "@twincell/core";
import type { ByteStream } from "../../transport/index.ts";

/** Faults by switch, of everything the controller says. All at rest by default; in force from the next byte on. */
export interface UrFaults {
  /** New connections are closed at once. */
  refusing: boolean;
  /** Connections are taken and nothing is ever said on them. */
  silent: boolean;
  /** The controller hangs: its clock, its motion and its answers stand still. */
  frozen: boolean;
  /** Everything is said this much later [s]. */
  delay_s: number;
  /** Part of the chunks one byte of which is changed, 0 … 1. */
  garbage: number;
  /** Part of the state packages that are never sent, 0 … 1. */
  loss: number;
  /** Everything is sent byte by byte. */
  split: boolean;
  /** Only protocol 1 is spoken. */
  oldProtocol: boolean;
  /** Inputs are said to be another client's. */
  inUse: boolean;
  /** After so many more state packages of a connection it breaks; 0 for never. */
  dropAfter: number;
}
export const noFaults = (): UrFaults => ({
  refusing: false,
  silent: false,
  frozen: false,
  delay_s: 0,
  garbage: 0,
  loss: 0,
  split: false,
  oldProtocol: false,
  inUse: false,
  dropAfter: 0,
});

/** More than this waiting for a client that does not read: states are left out [bytes]. */
export const MOST_WAITING = 1 << 16;
/** More than this, and the client is cut off: answers are not left out. */
const FAR_TOO_MUCH = 1 << 20;

interface Late {
  readonly due_s: number;
  readonly send: () => void;
}

/** What is between the controller and its connections: its faults, and the bound on what waits. */
export class Outbox {
  readonly faults: UrFaults;
  private readonly random = seededRandom(7);
  private late: Late[] = [];
  private readonly now_s: () => number;
  constructor(faults: UrFaults, now_s: () => number) {
    this.faults = faults;
    this.now_s = now_s;
  }

  /** @param isState  one of many: left out when the client does not read. */
  send(stream: ByteStream, bytes: Uint8Array, isState = false): void {
    const { faults } = this;
    if (faults.silent || faults.frozen) return;
    if (isState && (stream.waiting > MOST_WAITING || (faults.loss > 0 && this.random() < faults.loss))) return;
    if (stream.waiting > FAR_TOO_MUCH) {
      stream.close();
      return;
    }
    const isLate = faults.delay_s > 0 || this.late.length > 0;
    const copy = isLate || faults.garbage > 0 ? bytes.slice() : bytes;
    if (faults.garbage > 0 && this.random() < faults.garbage)
      copy[Math.floor(this.random() * copy.length)] = Math.floor(this.random() * 256);
    const send = (): void => {
      if (!faults.split) {
        stream.send(copy);
        return;
      }
      for (let i = 0; i < copy.length; i++) stream.send(copy.subarray(i, i + 1));
    };
    if (isLate) this.late.push({ due_s: this.now_s() + faults.delay_s, send });
    else send();
  }

  /** What is due goes out, in order. */
  cycle(): void {
    const now_s = this.now_s();
    while (this.late.length > 0 && this.late[0]!.due_s <= now_s + 1e-9) this.late.shift()!.send();
  }
  clear(): void {
    this.late = [];
  }
}
