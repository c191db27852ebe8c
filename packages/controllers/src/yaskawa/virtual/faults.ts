import type { Scheduler } from "@twincell/core";
import { calm, type Address, type DatagramSocket, type NetworkConditions } from "../../transport/index.ts";

/**
 * What may go wrong with the server, by switch: the weather of what it sends and hears, and numbers that are not what
 * they should be.
 */
export interface Faults extends NetworkConditions {
  /** Of answers, whose request id is another one. */
  wrongId: number;
}
export const noFaults = (): Faults => ({ ...calm(), wrongId: 0 });

const TICK_S = 0.001;
const ID_AT = 11;

/** A socket with faults in front of it, on any network. `frozen` hears and says nothing; `refusing` says nothing. */
export function faultySocket(
  socket: DatagramSocket,
  faults: Faults,
  scheduler: Scheduler,
  random: () => number,
): DatagramSocket {
  let late: { readonly due_s: number; readonly bytes: Uint8Array; readonly to: Address }[] = [];
  const stop = scheduler.every(TICK_S, () => {
    if (late.length === 0) return;
    const due = late.filter(({ due_s }) => due_s <= scheduler.now_s()).sort((a, b) => a.due_s - b.due_s);
    late = late.filter(({ due_s }) => due_s > scheduler.now_s());
    for (const { bytes, to } of due) socket.send(bytes, to);
  });
  return {
    address: socket.address,
    send(bytes, to) {
      if (faults.frozen || faults.refusing || random() < faults.loss) return;
      for (let copies = random() < faults.duplicates ? 2 : 1; copies > 0; copies--) {
        const sent = bytes.slice();
        if (random() < faults.wrongId) sent[ID_AT] = (sent[ID_AT]! + 1 + Math.floor(random() * 255)) & 255;
        if (sent.length > 0 && random() < faults.garbage)
          sent[Math.floor(random() * sent.length)] = Math.floor(random() * 256);
        const wait_s = faults.delay_s + faults.jitter_s * random();
        if (wait_s > 0) late.push({ due_s: scheduler.now_s() + wait_s, bytes: sent, to });
        else socket.send(sent, to);
      }
    },
    onDatagram(listen) {
      socket.onDatagram((lent, from) => {
        if (!faults.frozen && random() >= faults.loss) listen(lent, from);
      });
    },
    close() {
      stop();
      late = [];
      socket.close();
    },
  };
}
