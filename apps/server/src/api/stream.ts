import type { IncomingMessage } from "node:http";
import type { Scheduler } from "@twincell/core";
import { SOCKETS, type RobotServer } from "@twincell/protocol";
import type { Route } from "../sockets/doors.ts";

/** Samples that wait for a slow reader beyond this many bytes are left out; the next one tells more anyway. */
const MAX_WAITING = 1 << 20;
/** A reader so far behind is let go [bytes]. */
const MOST_WAITING = 32 << 20;
const MOST_READERS = 256;
const TOLD = /^\{"type":"(\w+)"(?:,"(?:station|id)":("(?:[^"\\]|\\.)*"))?/;
const ANSWERS: ReadonlySet<string> = new Set(["answer", "pong", "pendant"]);

/** Whoever is let in hears everything that is told of robots, and has nothing to say: no lease, no sign of life. */
export function streamRoute(host: Pick<RobotServer, "join">, scheduler: Scheduler): Route {
  let readers = 0;
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
      const together: string[] = [];
      const end =
        asked === null
          ? null
          : scheduler.every(1 / messages_per_s, () => {
              if (together.length > 0) socket.send(`[${together.splice(0).join(",")}]`);
            });
      const send = (text: string): void => {
        if (end) together.push(text);
        else socket.send(text);
      };
      const sample = (station: string, text: string): void => {
        const now_s = scheduler.now_s();
        const late = now_s - (sent_s.get(station) ?? -Infinity) >= period_s;
        const has = text.includes('"signals":{');
        if (!late || socket.bufferedAmount > MAX_WAITING) {
          // Lines are told when they change: what a left-out sample said of them goes with the next one.
          if (has) signals.set(station, (JSON.parse(text) as { readonly signals: unknown }).signals);
          return;
        }
        sent_s.set(station, now_s);
        const kept = signals.get(station);
        signals.delete(station);
        send(kept === undefined || has ? text : JSON.stringify({ ...(JSON.parse(text) as object), signals: kept }));
      };
      const reader = host.join(`reader ${readers}`, {
        send(text) {
          const told = TOLD.exec(text);
          const type = told?.[1] ?? "";
          if (ANSWERS.has(type)) return;
          const station = told?.[2] === undefined ? null : (JSON.parse(told[2]) as string);
          if (robot !== null && station !== null && station !== robot) return;
          if (type === "sample" && station !== null) sample(station, text);
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
