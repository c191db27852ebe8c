import { createClient, type Client, type ConnectionEvent, type EventOf, type RobotServer } from "@twincell/protocol";
import { WebSocket } from "ws";
import { nodeScheduler } from "../clock.ts";
import { STATIONS_PATH } from "./socket.ts";

export type Told = Exclude<ConnectionEvent, EventOf<"answer" | "pong">>;
/** One who is in at a host of robots. */
export interface Joined {
  readonly client: Client;
  /** Resolves when the connection ends: with a sentence when nobody here ended it. */
  readonly ended: Promise<string | null>;
  close(): void;
}

/**
 * Goes into a server over the socket that studios use.
 *
 * @param token  of `twincell token add`, where the server asks for one.
 */
export function joinServer(url: URL, onTold: (message: Told) => void, token?: string): Joined {
  const address = new URL(STATIONS_PATH, url);
  address.protocol = url.protocol === "https:" ? "wss:" : "ws:";
  const socket = new WebSocket(address, {
    perMessageDeflate: false,
    ...(token === undefined ? {} : { headers: { authorization: `Bearer ${token}` } }),
  });
  let asked = false;
  let why = `The server at ${url.host} ended the connection.`;
  const early: string[] = [];
  const client = createClient(
    {
      send(text) {
        if (socket.readyState === WebSocket.OPEN) socket.send(text);
        else if (socket.readyState === WebSocket.CONNECTING) early.push(text);
      },
      close() {
        socket.close();
      },
    },
    nodeScheduler.now_s,
    onTold,
  );
  socket.on("open", () => {
    for (const text of early.splice(0)) socket.send(text);
  });
  socket.on("message", (data, binary) => {
    if (!binary) client.hear(String(data as Buffer));
  });
  socket.on("unexpected-response", (_, { statusCode }) => {
    why =
      statusCode === 401 || statusCode === 403
        ? `The server at ${url.host} does not let this in: it asks for a token.`
        : `What answers at ${url.host} is no Twincell server.`;
    socket.terminate();
  });
  socket.on("error", problem => {
    if (why.endsWith("ended the connection."))
      why = `There is no Twincell server at ${url.host}: ${problem.message || "nothing answers"}.`;
  });
  return {
    client,
    ended: new Promise(resolve => {
      socket.on("close", () => {
        client.gone();
        resolve(asked ? null : why);
      });
    }),
    close() {
      asked = true;
      socket.close();
    },
  };
}

/** The same at a host of this process. */
export function joinHost(host: RobotServer, who: string, onTold: (message: Told) => void): Joined {
  let client: Client | null = null;
  const early: string[] = [];
  let end: (why: string | null) => void = () => undefined;
  const ended = new Promise<string | null>(resolve => {
    end = resolve;
  });
  const place = host.join(who, {
    send(text) {
      if (client) client.hear(text);
      else early.push(text);
    },
    close() {
      end("The host ended the connection.");
    },
  });
  client = createClient({ send: place.hear, close: () => undefined }, nodeScheduler.now_s, onTold);
  for (const text of early) client.hear(text);
  return {
    client,
    ended,
    close() {
      place.leave();
      client.gone();
      end(null);
    },
  };
}
