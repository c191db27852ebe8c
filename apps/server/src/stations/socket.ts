import type { IncomingMessage, Server } from "node:http";
import type { Duplex } from "node:stream";
import { LONGEST_MESSAGE, type Host } from "@twincell/messages";
import { WebSocketServer, type WebSocket } from "ws";

/** States that wait for a slow page beyond this many bytes are left out; the next one tells more anyway. */
const MOST_WAITING = 1 << 20;
const STATES = ['{"type":"sample"', '{"type":"pendant"'];
export const STATIONS_PATH = "/stations";

/**
 * Lets pages of this server into the host of the stations. A page of another origin could ride on a cookie, so it is
 * turned away: a browser says honestly where a page came from.
 *
 * @param allowed  whether that request may come in at all: the access code of the local network.
 */
export function stationSocket(server: Server, host: Pick<Host, "join">, allowed: (request: IncomingMessage) => boolean): { close(): void } {
  const sockets = new WebSocketServer({ noServer: true, maxPayload: LONGEST_MESSAGE, perMessageDeflate: false });
  let count = 0;
  const turnAway = (socket: Duplex, status: string): void => { socket.end(`HTTP/1.1 ${status}\r\nConnection: close\r\n\r\n`); };

  server.on("upgrade", (request: IncomingMessage, socket: Duplex, head: Buffer) => {
    socket.on("error", () => { socket.destroy(); });
    if ((request.url ?? "").split("?")[0] !== STATIONS_PATH) { turnAway(socket, "404 Not Found"); return; }
    if (!sameOrigin(request) || !allowed(request)) { turnAway(socket, "403 Forbidden"); return; }
    sockets.handleUpgrade(request, socket, head, welcome);
  });

  function welcome(socket: WebSocket): void {
    const seat = host.join(`studio ${++count}`, {
      send(text) { if (socket.bufferedAmount < MOST_WAITING || !STATES.some(state => text.startsWith(state))) socket.send(text); },
      close() { socket.close(); },
    });
    socket.on("message", (data, binary) => { if (binary) socket.close(1003); else seat.hear(String(data as Buffer)); });
    socket.on("close", seat.leave);
    socket.on("error", seat.leave);
  }
  return { close() { for (const socket of sockets.clients) socket.terminate(); sockets.close(); } };
}

function sameOrigin({ headers: { origin, host } }: IncomingMessage): boolean {
  if (origin === undefined) return true; // No browser: a program of this machine or one that knows the code.
  try { return new URL(origin).host === host; } catch { return false; }
}
