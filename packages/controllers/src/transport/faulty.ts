import { seededRandom, type Random, type Scheduler } from "@twincell/core";

/** What a controller and its line do wrong, by switch, on any network. All at rest by default. */
export interface LineFaults {
  /** Connections are closed as soon as they are open. */
  refusing: boolean;
  /** What comes is taken and nothing is answered; the connection stays: half open. */
  silent: boolean;
  /** What is sent comes so much later [s]. */
  delay_s: number;
  /** Part of what is sent of which one byte is changed, 0 … 1. */
  garbage: number;
  /** What is sent comes byte by byte. */
  split: boolean;
  /** The connection is cut after so many more things sent; Infinity never. */
  dropAfter: number;
  /** States stand still while the controller goes on answering. */
  frozen: boolean;
}
export const noLineFaults = (): LineFaults => ({
  refusing: false,
  silent: false,
  delay_s: 0,
  garbage: 0,
  split: false,
  dropAfter: Infinity,
  frozen: false,
});

export interface FaultyLine {
  send(bytes: Uint8Array, out: (bytes: Uint8Array) => void): void;
  readonly random: Random;
}

/** Sends bytes as the faults have it. `bytes` may be used again at once. */
export function faultyLine(faults: LineFaults, scheduler: Scheduler, seed: number): FaultyLine {
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
        if (!faults.split) {
          out(said);
          return;
        }
        for (let i = 0; i < said.length; i++) out(said.subarray(i, i + 1));
      };
      if (!(faults.delay_s > 0)) {
        say(now);
        return;
      }
      const kept = now.slice();
      const stop = scheduler.every(faults.delay_s, () => {
        stop();
        say(kept);
      });
    },
  };
}
