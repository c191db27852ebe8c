import type { Scheduler } from "@twincell/core";
import type { ByteStream } from "../../transport/index.ts";
import { lineBytes, lineReader } from "../codec/lines.ts";

/** A question that is not answered for this long ends the connection [s]. */
const PATIENCE_S = 2;
const MOST_PENDING = 64;

export interface DashboardClient {
  /** Sends at once; resolves with the answer, or null when the connection ends first. */
  ask(command: string): Promise<string | null>;
  close(): void;
}

/** Questions and answers in order. The first line is the banner; it answers nothing. */
export function dashboardClient(
  stream: ByteStream,
  scheduler: Scheduler,
  onRoundTrip: (seconds: number) => void,
  onLost: (sentence: string) => void,
): DashboardClient {
  const lines = lineReader();
  const pending: { readonly asked_s: number; readonly answer: (text: string | null) => void }[] = [];
  let greeted = false;
  let over = false;
  const end = (sentence: string | null): void => {
    if (over) return;
    over = true;
    stopLooking();
    stream.close();
    for (const { answer } of pending.splice(0)) answer(null);
    if (sentence !== null) onLost(sentence);
  };
  const stopLooking = scheduler.every(PATIENCE_S / 4, () => {
    const first = pending[0];
    if (first && scheduler.now_s() - first.asked_s > PATIENCE_S)
      end(`The dashboard did not answer for ${PATIENCE_S} s.`);
  });
  stream.onEnd(ending => {
    end(ending.sentence);
  });
  stream.onBytes(lent => {
    const why = lines.push(lent, line => {
      if (!greeted) {
        greeted = true;
        return;
      }
      const first = pending.shift();
      if (!first) return;
      onRoundTrip(scheduler.now_s() - first.asked_s);
      first.answer(line);
    });
    if (why !== null) end(`Dashboard: ${why}`);
  });
  return {
    ask: command =>
      over || pending.length >= MOST_PENDING
        ? Promise.resolve(null)
        : new Promise(resolve => {
            pending.push({ asked_s: scheduler.now_s(), answer: resolve });
            stream.send(lineBytes(command));
          }),
    close() {
      end(null);
    },
  };
}
