import type { CommandOutcome } from "@twincell/core";
import type { ConnectionRequest, RequestOf } from "./ask.ts";
import { OLDEST_HOST, PROTOCOL, readConnectionEvent, write } from "./read.ts";
import type { Channel } from "./channel.ts";
import type { ConnectionEvent, EventOf } from "./tell.ts";

type Numbered = Extract<ConnectionRequest, { readonly id: number }>;
/** A request without its number. */
export type Request = Numbered extends infer One ? (One extends Numbered ? Omit<One, "id"> : never) : never;

export interface Client {
  /** Resolves with the host's answer; as refused when the connection ends before it. */
  ask(request: Request): Promise<CommandOutcome>;
  /** Told at once and never answered: anyone may stop. */
  stop(station?: string, emergency?: boolean): void;
  alive(station: string): void;
  /** Time there and back [s]. */
  ping(): Promise<number>;
  hear(text: string): void;
  /** The connection is gone. */
  gone(): void;
}

/** One end of a channel to a host: numbers requests, finds their answers, hands on everything else. */
export function createClient(
  channel: Channel,
  now_s: () => number,
  onTell: (message: Exclude<ConnectionEvent, EventOf<"answer" | "pong">>) => void,
): Client {
  const asked = new Map<number, (outcome: CommandOutcome) => void>();
  const pings = new Map<number, (seconds: number) => void>();
  let count = 0;
  let over = false;
  const lost: CommandOutcome = {
    kind: "refused",
    why: {
      code: "host.gone",
      sentence: "The connection to the host of the stations is gone.",
      hint: "Connect again; motion goes on only when you command it.",
    },
  };
  const send = (ask: ConnectionRequest): void => {
    if (!over) channel.send(write(ask));
  };
  const end = (): void => {
    over = true;
    for (const settle of asked.values()) settle(lost);
    asked.clear();
    for (const settle of pings.values()) settle(NaN);
    pings.clear();
  };
  return {
    ask(request) {
      if (over) return Promise.resolve(lost);
      const id = count++;
      return new Promise(resolve => {
        asked.set(id, resolve);
        send({ ...request, id } as Numbered);
      });
    },
    stop(station, emergency = false) {
      send({ type: "stop", emergency, ...(station === undefined ? {} : { station }) } satisfies RequestOf<"stop">);
    },
    alive(station) {
      send({ type: "alive", station });
    },
    ping() {
      if (over) return Promise.resolve(NaN);
      const sent_s = now_s();
      return new Promise(resolve => {
        pings.set(sent_s, resolve);
        send({ type: "ping", sent_s });
      });
    },
    hear(text) {
      if (over) return;
      const heard = readConnectionEvent(text);
      if (heard.kind === "fault") {
        onTell({ type: "fault", sentence: heard.sentence });
        end();
        channel.close();
        return;
      }
      const { message } = heard;
      if (message.type === "answer") {
        asked.get(message.id)?.(message.outcome);
        asked.delete(message.id);
        return;
      }
      if (message.type === "pong") {
        pings.get(message.sent_s)?.(now_s() - message.sent_s);
        pings.delete(message.sent_s);
        return;
      }
      if (message.type === "hello" && (message.protocol > PROTOCOL || message.protocol < OLDEST_HOST)) {
        onTell({
          type: "fault",
          sentence: `The host speaks version ${message.protocol} of the protocol, this studio version ${PROTOCOL}: use the same release of both.`,
        });
        end();
        channel.close();
        return;
      }
      onTell(message);
      if (message.type === "fault") end();
    },
    gone: end,
  };
}
