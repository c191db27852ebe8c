import { createServer as createHttp, type IncomingMessage } from "node:http";
import { createServer as createHttps } from "node:https";
import type { AddressInfo } from "node:net";
import { WebSocketServer, type WebSocket } from "ws";
import { isServed } from "../pages.ts";
import { sameOrigin } from "../sockets/doors.ts";
import type { StandardContext } from "./standard.ts";

export interface SocketPort {
  readonly port: number;
  readonly address: string;
  close(): void;
}
/** So many are in at once. */
const MOST_CLIENTS = 64;

/**
 * A port of its own for a protocol by WebSocket, with the rules of the API: pages of other servers and foreign host
 * names are turned away, a token is asked for where the API asks for one. A client that cannot send headers gives it as
 * `?token=`.
 */
export async function openSocketPort(
  { host, hosts, certificate, enter }: StandardContext,
  port: number,
  longest: number,
  protocols: readonly string[],
  welcome: (socket: WebSocket, request: IncomingMessage) => void,
): Promise<SocketPort> {
  const server = certificate === null ? createHttp() : createHttps(certificate);
  const sockets = new WebSocketServer({
    noServer: true,
    maxPayload: longest,
    perMessageDeflate: false,
    ...(protocols.length === 0
      ? {}
      : { handleProtocols: offered => protocols.find(each => offered.has(each)) ?? false }),
  });
  server.on("request", (_request, response) => {
    response.writeHead(426, { "content-type": "text/plain; charset=utf-8", upgrade: "websocket" });
    response.end("This port speaks by WebSocket.\n");
  });
  server.on("upgrade", (request, socket, head) => {
    socket.on("error", () => {
      socket.destroy();
    });
    const given = new URL(request.url ?? "/", "http://here").searchParams.get("token");
    if (given !== null) request.headers.authorization ??= `Bearer ${given}`;
    const isIn =
      isServed(hosts, request) &&
      sameOrigin(request) &&
      sockets.clients.size < MOST_CLIENTS &&
      enter(request, "look").kind === "in";
    if (!isIn) {
      socket.end("HTTP/1.1 403 Forbidden\r\nConnection: close\r\n\r\n");
      return;
    }
    sockets.handleUpgrade(request, socket, head, opened => {
      opened.on("error", () => {
        opened.terminate();
      });
      welcome(opened, request);
    });
  });
  await new Promise<void>((resolve, reject) => {
    server.once("error", reject);
    server.listen(port, host, resolve);
  });
  const taken = (server.address() as AddressInfo).port;
  return {
    port: taken,
    address: `${certificate === null ? "ws" : "wss"}://${host === "0.0.0.0" ? "127.0.0.1" : host}:${taken}`,
    close() {
      for (const socket of sockets.clients) socket.terminate();
      sockets.close();
      server.closeAllConnections();
      server.close();
    },
  };
}
