import { seededRandom, type Random, type Scheduler } from "@twincell/core";

/** What the controller and its line do wrong, by switch, on any network. All at rest by default. */
export interface KukaFaults {
  /** Connections are closed as soon as they are open. */
  refusing: boolean;
  /** Questions are taken and not answered; the connection stays: half open. */
  silent: boolean;
  /** Every answer comes so much later [s]. */
  delay_s: number;
  /** Part of the answers of which one byte is changed, 0 … 1. */
  garbage: number;
  /** Answers come byte by byte. */
  split: boolean;
  /** The connection is cut after so many more answers; Infinity never. */
  dropAfter: number;
  /** Variables stand still while the controller goes on answering. */
  frozen: boolean;
  /** Of RSI telegrams to the sensor, lost and sent twice. */
  loss: number;
  duplicates: number;
}
export const noFaults = (): KukaFaults => ({ refusing: false, silent: false, delay_s: 0, garbage: 0, split: false, dropAfter: Infinity, frozen: false, loss: 0, duplicates: 0 });

/** Sends bytes as the faults have it. `bytes` may be used again at once. */
export function faultyLine(faults: KukaFaults, scheduler: Scheduler, seed: number): { send(bytes: Uint8Array, out: (bytes: Uint8Array) => void): void; readonly random: Random } {
  const random = seededRandom(seed);
  return {
    random,
    send(bytes, out) {
      if (faults.silent) return;
      let now = bytes;
      if (faults.garbage > 0 && random() < faults.garbage) {
        now = bytes.slice();
        now[Math.floor(random() * now.length)] = Math.floor(random() * 256);
      }
      const say = (said: Uint8Array): void => {
        if (!faults.split) { out(said); return; }
        for (let i = 0; i < said.length; i++) out(said.subarray(i, i + 1));
      };
      if (!(faults.delay_s > 0)) { say(now); return; }
      const kept = now.slice(), stop = scheduler.every(faults.delay_s, () => { stop(); say(kept); });
    },
  };
}
