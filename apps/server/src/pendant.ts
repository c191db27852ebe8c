import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import type { Scheduler } from "@twincell/core";
import { createPendantHost, type ServedVirtualPendant, type ConnectionInfo } from "@twincell/protocol";
import { isServed, LOOPBACK, studioListener } from "./pages.ts";
import { staticFiles } from "./static-files.ts";
import { openRoutes } from "./sockets/doors.ts";
import { connectionRoute } from "./stations/socket.ts";

export interface ServePendantOptions {
  /** Folder of the built studio, in which the page of the pendant is. */
  readonly studio: string;
  /** Address of this machine that the virtual controller stands at; the page is served nowhere else. */
  readonly host: string;
  /** 0 takes any free port. */
  readonly port: number;
  readonly version: string;
  readonly scheduler: Scheduler;
  readonly words: ConnectionInfo;
  readonly pendant: ServedVirtualPendant;
}
export type ServedPendant =
  | { readonly kind: "served"; readonly url: string; close(): void }
  | { readonly kind: "taken"; readonly sentence: string };

/** Serves the web pendant of one virtual controller. */
export async function servePendant({ studio, host, port, ...options }: ServePendantOptions): Promise<ServedPendant> {
  const hosts = new Set([...LOOPBACK, host]);
  const server = createServer(
    studioListener(staticFiles(studio), hosts, null, null, sentence => console.error(sentence)),
  );
  const problem = await new Promise<Error | null>(resolve => {
    server.once("error", resolve);
    server.listen(port, host, () => {
      resolve(null);
    });
  });
  if (problem)
    return { kind: "taken", sentence: `The pendant's page cannot be served at ${host}:${port}: ${problem.message}.` };
  const socket = openRoutes(server, [connectionRoute(createPendantHost(options))], {
    enters: request => isServed(hosts, request),
    stays: () => true,
    scheduler: options.scheduler,
  });
  return {
    kind: "served",
    url: `http://${host}:${(server.address() as AddressInfo).port}/pendant/`,
    close() {
      socket.close();
      server.closeAllConnections();
      server.close();
    },
  };
}
