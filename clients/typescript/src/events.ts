import type { StreamEvent } from "./api.ts";
import { Refused, type Connection } from "./http.ts";

export interface StreamOptions {
  readonly robot?: string | undefined;
  /** At most so many samples a second of each robot; every one when left out. */
  readonly rate_Hz?: number | undefined;
  readonly signal?: AbortSignal | undefined;
}
/** Events that wait for a loop that is busy; beyond it the stream ends with a sentence: nothing is lost unseen. */
const MOST_WAITING = 100_000;

/** Everything that is told of robots, until the loop is left, the signal aborts or the server goes. */
export async function* streamEvents(
  connection: Connection,
  { robot, rate_Hz, signal }: StreamOptions = {},
): AsyncGenerator<StreamEvent, void, undefined> {
  const url = new URL("/api/v1/stream", connection.url);
  url.protocol = connection.url.protocol === "https:" ? "wss:" : "ws:";
  if (robot !== undefined) url.searchParams.set("robot", robot);
  if (rate_Hz !== undefined) url.searchParams.set("rate_Hz", String(rate_Hz));
  // Browsers send their cookie; Node takes headers as a second argument, which the types of browsers do not know.
  const Socket = WebSocket as unknown as new (url: URL, options?: object) => WebSocket;
  const socket = connection.token === undefined ? new Socket(url) : new Socket(url, { headers: connection.headers() });
  const waiting: StreamEvent[] = [];
  let wake: () => void = () => undefined;
  let ended = false;
  let opened = false;
  let trouble: Refused | null = null;
  const end = (): void => {
    ended = true;
    wake();
  };
  const abort = (): void => {
    socket.close();
    end();
  };
  socket.addEventListener("open", () => {
    opened = true;
  });
  socket.addEventListener("message", ({ data }) => {
    if (ended) return;
    if (waiting.length >= MOST_WAITING) {
      trouble = new Refused(
        "client.slow",
        `${MOST_WAITING} events wait: this program is too slow for them.`,
        "Ask for a lower rate_Hz.",
        0,
      );
      abort();
      return;
    }
    waiting.push(JSON.parse(String(data)) as StreamEvent);
    wake();
  });
  socket.addEventListener("close", ({ code, reason }) => {
    if (!opened)
      trouble ??= new Refused("client.stream", `${url.host} does not let this in.`, "Check address and token.", 0);
    else if (reason !== "" && code !== 1000)
      trouble ??= new Refused("client.stream", `The server ended the stream: ${reason}.`, "", 0);
    end();
  });
  socket.addEventListener("error", end);
  signal?.addEventListener("abort", abort, { once: true });
  if (signal?.aborted) abort();
  try {
    for (;;) {
      const next = waiting.shift();
      if (next) yield next;
      else if (ended) break;
      else
        await new Promise<void>(resolve => {
          wake = resolve;
        });
    }
    if (trouble !== null) throw trouble as Refused;
  } finally {
    signal?.removeEventListener("abort", abort);
    socket.close();
  }
}
