import { again, type Cluster } from "./nats.ts";

/** So many messages wait for their acknowledgement at once: without a bound an election ends in a storm of retries. */
const IN_FLIGHT = 16;
/** What waits for a cluster that is gone; of more the oldest is given up [bytes]. */
const MOST_BYTES = 256 << 20;
/** A cluster that is gone is tried for as long as it takes. */
const FOREVER_MS = Infinity;

export interface Outbox {
  /** @param id  the cluster keeps one message of it, however often it is sent. */
  put(subject: string, id: string, body: Uint8Array): void;
  readonly waiting: number;
  /** Resolves when everything was acknowledged, or after that time. */
  drained(within_ms: number): Promise<void>;
  close(): void;
}

/** Messages on their way to a stream: each is sent until it is acknowledged by a majority, and kept once. */
export function createOutbox({ streams }: Pick<Cluster, "streams">, say: (sentence: string) => void): Outbox {
  const waiting: { readonly subject: string; readonly id: string; readonly body: Uint8Array }[] = [];
  const idle: (() => void)[] = [];
  let bytes = 0;
  let flying = 0;
  let lost = 0;
  let closed = false;
  const pump = (): void => {
    while (flying < IN_FLIGHT && waiting.length > 0 && !closed) {
      const next = waiting.shift()!;
      bytes -= next.body.length;
      flying++;
      void send(next);
    }
    if (flying === 0 && waiting.length === 0) for (const settle of idle.splice(0)) settle();
  };
  async function send({ subject, id, body }: (typeof waiting)[number]): Promise<void> {
    await again(async () => {
      if (!closed) await streams.publish(subject, body, { msgID: id, timeout: 5000 });
    }, FOREVER_MS);
    flying--;
    pump();
  }
  return {
    put(subject, id, body) {
      waiting.push({ subject, id, body });
      bytes += body.length;
      while (bytes > MOST_BYTES) {
        bytes -= waiting.shift()!.body.length;
        if (lost++ === 0) say("NATS was away for too long: the oldest states that waited for it are given up.");
      }
      pump();
    },
    get waiting() {
      return waiting.length + flying;
    },
    async drained(within_ms) {
      if (flying === 0 && waiting.length === 0) return;
      let timer: ReturnType<typeof setTimeout> | undefined;
      await Promise.race([
        new Promise<void>(resolve => idle.push(resolve)),
        new Promise<void>(resolve => {
          timer = setTimeout(resolve, within_ms);
        }),
      ]);
      clearTimeout(timer);
    },
    close() {
      closed = true;
    },
  };
}
