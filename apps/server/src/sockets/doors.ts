import type { IncomingMessage, Server } from "node:http";
import type { Duplex } from "node:stream";
import type { Scheduler } from "@twincell/core";
import { WebSocketServer, type WebSocket } from "ws";

/** So often it is asked whether those who are in may stay [s]. */
const ASKED_EACH_S = 1;
/** Codes from 4000 on are the application's own; this one says what 401 says. */
const TAKEN_BACK = 4401;

/** Who may come in, and whether they may stay: what let them in may be taken back while they are there. */
export interface Admission {
  /** The access code of the local network, a token, or neither on loopback. */
  readonly enters: (request: IncomingMessage) => boolean;
  readonly stays: (request: IncomingMessage) => boolean;
  readonly scheduler: Scheduler;
}

/** One kind of conversation by WebSocket, at a path of its own. */
export interface Route {
  readonly path: string;
  /** A longer message ends the connection before it is kept [bytes]. */
  readonly longest: number;
  welcome(socket: WebSocket, request: IncomingMessage): void;
}

/**
 * Lets pages of this server in by several doors. A page of another origin could ride on a cookie, so it is turned away:
 * a browser says honestly where a page came from.
 *
 * Whoever may not stay any more is sent away within a second, which ends their lease as any closed connection does.
 */
export function openRoutes(
  server: Server,
  routes: readonly Route[],
  { enters, stays, scheduler }: Admission,
): { close(): void } {
  const rooms = new Map(
    routes.map(route => [
      route.path,
      {
        door: route,
        sockets: new WebSocketServer({ noServer: true, maxPayload: route.longest, perMessageDeflate: false }),
      },
    ]),
  );
  const inside = new Map<WebSocket, IncomingMessage>();
  const turnAway = (socket: Duplex, status: string): void => {
    socket.end(`HTTP/1.1 ${status}\r\nConnection: close\r\n\r\n`);
  };
  server.on("upgrade", (request: IncomingMessage, socket: Duplex, head: Buffer) => {
    socket.on("error", () => {
      socket.destroy();
    });
    const room = rooms.get((request.url ?? "").split("?")[0]!);
    if (!room) {
      turnAway(socket, "404 Not Found");
      return;
    }
    if (!sameOrigin(request) || !enters(request)) {
      turnAway(socket, "403 Forbidden");
      return;
    }
    room.sockets.handleUpgrade(request, socket, head, (opened, asked) => {
      inside.set(opened, asked);
      opened.once("close", () => inside.delete(opened));
      room.door.welcome(opened, asked);
    });
  });
  const end = scheduler.every(ASKED_EACH_S, () => {
    for (const [socket, request] of inside)
      if (!stays(request)) socket.close(TAKEN_BACK, "The token was taken back or has ended.");
  });
  return {
    close() {
      end();
      for (const { sockets } of rooms.values()) {
        for (const socket of sockets.clients) socket.terminate();
        sockets.close();
      }
    },
  };
}

/** Whether a request comes from a page of this server, or from no page at all. */
export function sameOrigin({ headers: { origin, host } }: IncomingMessage): boolean {
  if (origin === undefined) return true; // No browser: a program of this machine or one that knows the code.
  try {
    return new URL(origin).host === host;
  } catch {
    return false;
  }
}
