import type { CommandOutcome, Scheduler } from "@twincell/core";
import type { ConnectionRequest, RequestOf, PendantAct } from "./ask.ts";
import type { Channel } from "./channel.ts";
import { requestOrEnd, PROTOCOL, write } from "./read.ts";
import type { PendantShown, PendantWords, ConnectionInfo, ConnectionEvent } from "./tell.ts";

/** What a host needs of the pendant and the cabinet of a virtual controller. */
export interface ServedVirtualPendant {
  readonly words: PendantWords;
  readonly shown: PendantShown;
  /** @param who  one at one channel: what they hold is let go when they leave. */
  act(who: string, act: PendantAct): Promise<CommandOutcome>;
  alive(who: string): void;
  leave(who: string): void;
}
/** How often those who watch are told [s]. */
const SHOWN_S = 0.04;
const DONE: CommandOutcome = { kind: "done" };

/** One who stands before a pendant, from `visit` or their first act until they leave. */
export interface PendantSubscription {
  act(act: PendantAct): Promise<CommandOutcome>;
  watch(on: boolean): CommandOutcome;
  alive(): void;
  leave(): void;
}
export function subscribeToPendant(
  who: string,
  station: string,
  pendant: ServedVirtualPendant,
  scheduler: Scheduler,
  tell: (message: ConnectionEvent) => void,
): PendantSubscription {
  let stop: (() => void) | null = null;
  const show = (words?: PendantWords): void => {
    tell({ type: "pendant", station, ...(words ? { words } : {}), shown: pendant.shown } as ConnectionEvent);
  };
  const end = (): void => {
    stop?.();
    stop = null;
  };
  return {
    act: what => pendant.act(who, what),
    watch(on) {
      end();
      if (on) {
        show(pendant.words);
        stop = scheduler.every(SHOWN_S, () => {
          show();
        });
      }
      return DONE;
    },
    alive() {
      pendant.alive(who);
    },
    leave() {
      end();
      pendant.leave(who);
    },
  };
}

export interface PendantHostOptions {
  readonly scheduler: Scheduler;
  readonly version: string;
  readonly words: ConnectionInfo;
  readonly pendant: ServedVirtualPendant;
}
type Asked = Exclude<ConnectionRequest, RequestOf<"stop" | "alive" | "ping">>;

/** The host of one pendant and nothing else: for a virtual controller that is commanded at its own ports. */
export function createPendantHost({ scheduler, version, words, pendant }: PendantHostOptions): {
  join(who: string, channel: Channel): { hear(text: string): void; leave(): void };
} {
  return {
    join(who, channel) {
      let gone = false;
      const tell = (message: ConnectionEvent): void => {
        if (!gone) channel.send(write(message));
      };
      const visit = subscribeToPendant(who, words.id, pendant, scheduler, tell);
      const leave = (): void => {
        if (gone) return;
        gone = true;
        visit.leave();
      };
      const carryOut = async (ask: Asked): Promise<CommandOutcome> => {
        if (ask.type === "pendant" && ask.station === words.id) return visit.act(ask.act);
        if (ask.type === "visit" && ask.station === words.id) return visit.watch(ask.on);
        return {
          kind: "refused",
          why: {
            code: "pendant.only",
            sentence: `This is the pendant of ${words.name} and nothing else.`,
            hint: "Command the controller at its own ports, from a station.",
          },
        };
      };
      tell({ type: "hello", protocol: PROTOCOL, version, brands: [], stations: [words] });
      return {
        leave,
        hear(text) {
          if (gone) return;
          const ask = requestOrEnd(text, tell, () => {
            leave();
            channel.close();
          });
          if (!ask) return;
          if (ask.type === "ping") tell({ type: "pong", sent_s: ask.sent_s, host_s: scheduler.now_s() });
          else if (ask.type === "alive") visit.alive();
          // Anyone may stop: at a pendant that is its red button.
          else if (ask.type === "stop") void visit.act({ do: "emergency-stop", pressed: true });
          else {
            const { id } = ask;
            void carryOut(ask).then(outcome => {
              tell({ type: "answer", id, outcome });
            });
          }
        },
      };
    },
  };
}
