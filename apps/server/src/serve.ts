import { createServer as createHttp } from "node:http";
import { createServer as createHttps } from "node:https";
import type { AddressInfo } from "node:net";
import { join } from "node:path";
import { createVideoRelay } from "@twincell/protocol";
import { accessCode } from "./access.ts";
import { certificate, lanAddresses } from "./lan.ts";
import { nodeScheduler } from "./clock.ts";
import { isServed, LOOPBACK, studioListener } from "./pages.ts";
import { stationHost } from "./stations/host.ts";
import { prepareJobInWorker } from "./stations/lay-out.ts";
import { recordServer } from "./stations/record-host.ts";
import { openRoutes } from "./sockets/doors.ts";
import { connectionRoute } from "./stations/socket.ts";
import { videoRoute } from "./video/door.ts";
import { staticFiles } from "./static-files.ts";

export interface ServeOptions {
  /** Folder of the built studio. */
  readonly studio: string;
  /** 0 takes any free port. */
  readonly port: number;
  /** Where the server keeps what must survive it. */
  readonly data?: string;
  /** Also serve other machines: HTTPS, an access code. */
  readonly lan?: boolean;
  /** Address to listen on; by default loopback, or every address with `lan`. */
  readonly host?: string;
  /** For training: virtual controllers only. */
  readonly training?: boolean;
  /** The only addresses of controllers; left out: every address, or with `lan` this machine alone. */
  readonly robots?: readonly string[];
  /** What the studio is told it speaks with. */
  readonly version?: string;
}
export interface Served {
  readonly url: string;
  /** Addresses for other machines, access code included. */
  readonly lanUrls: readonly string[];
  readonly code: string | null;
  close(): Promise<void>;
}

/** Serves the built studio on loopback, or on the local network when asked. Rejects when the port is taken. */
export async function serve(options: ServeOptions): Promise<Served> {
  const addresses = options.lan ? lanAddresses() : [];
  const access = options.lan ? accessCode(() => nodeScheduler.now_s()) : null;
  const hosts = new Set([...LOOPBACK, ...addresses]);
  const listener = studioListener(staticFiles(options.studio), hosts, access);
  const server = options.lan
    ? createHttps({ ...(await certificate(options.data, addresses)) }, listener)
    : createHttp(listener);
  await new Promise<void>((resolve, reject) => {
    server.once("error", reject);
    server.listen(options.port, options.host ?? (options.lan ? "0.0.0.0" : "127.0.0.1"), resolve);
  });
  const programs = prepareJobInWorker();
  // Whoever has the code may open controllers: on a network only those that whoever started the server named.
  const robots = options.robots ?? (options.lan ? ["127.0.0.1", "localhost"] : undefined);
  const stations = stationHost(nodeScheduler, options.version ?? "", programs.layOut, {
    training: options.training,
    robots,
  });
  const recorder =
    options.data === undefined
      ? null
      : await recordServer(stations, join(options.data, "recordings"), nodeScheduler, sentence => {
          console.error(sentence);
        });
  const port = (server.address() as AddressInfo).port;
  const scheme = options.lan ? "https" : "http";
  const query = access ? `?code=${access.code}` : "";
  const relay = createVideoRelay(
    nodeScheduler.now_s,
    addresses.map(address => `${scheme}://${address}:${port}/camera/${query}`),
  );
  const socket = openRoutes(
    server,
    [connectionRoute(stations), videoRoute(relay)],
    request =>
      isServed(hosts, request) && (access === null || access.enter(request.headers.cookie, null).kind === "welcome"),
  );
  return {
    url: `${scheme}://127.0.0.1:${port}/${query}`,
    lanUrls: addresses.map(address => `${scheme}://${address}:${port}/${query}`),
    code: access?.code ?? null,
    close: () =>
      new Promise(resolve => {
        recorder?.close();
        stations.close();
        programs.close();
        socket.close();
        server.closeAllConnections();
        server.close(() => {
          resolve();
        });
      }),
  };
}
