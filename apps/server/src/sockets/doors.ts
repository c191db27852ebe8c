import type { IncomingMessage, Server } from "node:http";
import type { Duplex } from "node:stream";
import { WebSocketServer, type WebSocket } from "ws";

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
 * @param allowed  whether that request may come in at all: the access code of the local network.
 */
export function openRoutes(
  server: Server,
  routes: readonly Route[],
  allowed: (request: IncomingMessage) => boolean,
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
    if (!sameOrigin(request) || !allowed(request)) {
      turnAway(socket, "403 Forbidden");
      return;
    }
    room.sockets.handleUpgrade(request, socket, head, room.door.welcome);
  });
  return {
    close() {
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
