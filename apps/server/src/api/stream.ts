import type { IncomingMessage } from "node:http";
import type { Scheduler } from "@twincell/core";
import { SOCKETS, type RobotServer } from "@twincell/protocol";
import type { Route } from "../sockets/doors.ts";

/** Samples that wait for a slow reader beyond this many bytes are left out; the next one tells more anyway. */
const MAX_WAITING = 1 << 20;
/** The same of a reader who gets many samples a message, and wants every one: a page that stood still for a while. */
const MAX_TOGETHER = 8 << 20;
/** A reader so far behind is let go [bytes]. */
const MOST_WAITING = 32 << 20;
const MOST_READERS = 256;
const TOLD = /^\{"type":"(\w+)"(?:,"(?:station|id)":("(?:[^"\\]|\\.)*"))?/;
const ANSWERS: ReadonlySet<string> = new Set(["answer", "pong", "pendant"]);

interface Told {
  readonly type: string;
  readonly station: string | null;
  /** It says of a sample what changed in its signals. */
  readonly hasSignals: boolean;
}
/** What a text of the host is. The host says the same text to all readers one after the other: it is looked at once. */
function lookOnce(): (text: string) => Told {
  let last = "";
  let told: Told = { type: "", station: null, hasSignals: false };
  return text => {
    if (text === last) return told;
    const found = TOLD.exec(text);
    const type = found?.[1] ?? "";
    const station = found?.[2] === undefined ? null : (JSON.parse(found[2]) as string);
    last = text;
    return (told = { type, station, hasSignals: type === "sample" && text.includes('"signals":{') });
  };
}

/** Many texts as one message. Readers of the same get the same bytes: they are made once. */
function joinOnce(): (texts: readonly string[]) => Buffer {
  let last: readonly string[] = [];
  let bytes = Buffer.from("[]");
  return texts => {
    if (texts.length === last.length && texts.every((text, i) => text === last[i])) return bytes;
    last = texts;
    return (bytes = Buffer.from(`[${texts.join(",")}]`));
  };
}

/** One timer for all readers of the same pace, so that they are sent the same at the same time. */
function pacemaker(scheduler: Scheduler): (messages_per_s: number, flush: () => void) => () => void {
  const paces = new Map<number, { readonly flushes: Set<() => void>; readonly end: () => void }>();
  return (messages_per_s, flush) => {
    let pace = paces.get(messages_per_s);
    if (!pace) {
      const flushes = new Set<() => void>();
      const end = scheduler.every(1 / messages_per_s, () => {
        for (const each of flushes) each();
      });
      paces.set(messages_per_s, (pace = { flushes, end }));
    }
    const { flushes, end } = pace;
    flushes.add(flush);
    return () => {
      flushes.delete(flush);
      if (flushes.size > 0) return;
      end();
      paces.delete(messages_per_s);
    };
  };
}

/** Whoever is let in hears everything that is told of robots, and has nothing to say: no lease, no sign of life. */
export function streamRoute(host: Pick<RobotServer, "join">, scheduler: Scheduler): Route {
  let readers = 0;
  const look = lookOnce();
  const joined = joinOnce();
  const paced = pacemaker(scheduler);
  return {
    path: SOCKETS.stream,
    longest: 1 << 16,
    welcome(socket, request: IncomingMessage) {
      const { searchParams } = new URL(request.url ?? "/", "http://here");
      const robot = searchParams.get("robot");
      const rate_Hz = Number(searchParams.get("rate_Hz") ?? Infinity);
      const asked = searchParams.get("messages_per_s");
      const messages_per_s = Number(asked ?? 1);
      if (!(rate_Hz > 0) || !(messages_per_s > 0 && messages_per_s <= 1000) || readers >= MOST_READERS) {
        const why =
          rate_Hz > 0 ? "messages_per_s wants a number above 0, at most 1000" : "rate_Hz wants a number above 0";
        socket.close(1008, readers >= MOST_READERS ? "too many readers" : why);
        return;
      }
      readers++;
      // 1 ms of slack: a rate that is asked for as it comes is not halved by a tick that comes early.
      const period_s = 1 / rate_Hz - 0.001;
      const sent_s = new Map<string, number>();
      const signals = new Map<string, unknown>();
      // Together, many samples cost a page one message: it is drawn 60 times a second however many come.
      let together: string[] = [];
      const end =
        asked === null
          ? null
          : paced(messages_per_s, () => {
              if (together.length === 0) return;
              socket.send(joined(together), { binary: false });
              together = [];
            });
      const mostWaiting = end ? MAX_TOGETHER : MAX_WAITING;
      const send = (text: string): void => {
        if (end) together.push(text);
        else socket.send(text);
      };
      const sample = (station: string, text: string, has: boolean): void => {
        const isLimited = rate_Hz < Infinity;
        const now_s = isLimited ? scheduler.now_s() : 0;
        const late = !isLimited || now_s - (sent_s.get(station) ?? -Infinity) >= period_s;
        if (!late || socket.bufferedAmount > mostWaiting) {
          // Lines are told when they change: what a left-out sample said of them goes with the next one.
          if (has) signals.set(station, (JSON.parse(text) as { readonly signals: unknown }).signals);
          return;
        }
        if (isLimited) sent_s.set(station, now_s);
        const kept = signals.get(station);
        signals.delete(station);
        send(kept === undefined || has ? text : JSON.stringify({ ...(JSON.parse(text) as object), signals: kept }));
      };
      const reader = host.join(`reader ${readers}`, {
        send(text) {
          const { type, station, hasSignals } = look(text);
          if (ANSWERS.has(type)) return;
          if (robot !== null && station !== null && station !== robot) return;
          if (type === "sample" && station !== null) sample(station, text, hasSignals);
          else if (socket.bufferedAmount > MOST_WAITING) socket.terminate();
          else send(text);
        },
        close() {
          socket.close();
        },
      });
      // What a reader says is not looked at, so that later versions may say something.
      let gone = false;
      const leave = (): void => {
        if (gone) return;
        gone = true;
        readers--;
        end?.();
        reader.leave();
      };
      socket.on("close", leave);
      socket.on("error", leave);
    },
  };
}
