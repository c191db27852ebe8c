import { X509Certificate } from "node:crypto";
import { createServer as createHttp } from "node:http";
import { createServer as createHttps } from "node:https";
import type { AddressInfo } from "node:net";
import { hostname } from "node:os";
import { join } from "node:path";
import { PlainFault } from "@twincell/core";
import { createVideoRelay } from "@twincell/protocol";
import { accessCode } from "./access.ts";
import { documentFolder } from "./api/documents.ts";
import { apiHandlers } from "./api/handlers.ts";
import { createJudge } from "./api/judge.ts";
import { apiListener } from "./api/listener.ts";
import { createApiRobots, schedulerWith, type ApiRobots } from "./api/robots.ts";
import { streamRoute } from "./api/stream.ts";
import { certificate } from "./authority.ts";
import { lanAddresses } from "./lan.ts";
import { nodeScheduler } from "./clock.ts";
import { HEADERS, isServed, LOOPBACK, studioListener } from "./pages.ts";
import { editingRoute } from "./editing/route.ts";
import { createSharedCells } from "./editing/shared-cells.ts";
import { stationHost } from "./stations/host.ts";
import { prepareJobInWorker } from "./stations/lay-out.ts";
import { readConnections, restoreConnections } from "./stations/connections.ts";
import { recordServer } from "./stations/record-host.ts";
import { openRoutes } from "./sockets/doors.ts";
import { connectionRoute } from "./stations/socket.ts";
import { videoRoute } from "./video/door.ts";
import { hasAccounts, openAccounts, type Account, type Accounts } from "./people/accounts.ts";
import { auditHost } from "./people/audit-host.ts";
import { openAuditLog } from "./people/audit-log.ts";
import { createGate } from "./people/gate.ts";
import { cellLinks } from "./people/links.ts";
import { createSessions } from "./people/sessions.ts";
import { tokenReader } from "./people/tokens.ts";
import { siteFiles } from "./site-files.ts";
import { startStandards, type StandardsOptions, type StartedStandards } from "./standards/index.ts";
import type { StandardContext } from "./standards/standard.ts";
import { joinFleet, ownFleet, type Fleet } from "./fleet/fleet.ts";
import type { NatsOptions } from "./fleet/nats.ts";
import { robotStates } from "./standards/robot-states.ts";
import { openDataFolder } from "./operations/data-folder.ts";
import { textLog, type Log } from "./operations/log.ts";
import { logRobots } from "./operations/log-robots.ts";
import { standstill } from "./operations/standstill.ts";

export interface ServeOptions {
  /** Folder of the built studio. */
  readonly studio: string;
  /** Folder of the built documentation, which is shown at /docs/. */
  readonly docs?: string;
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
  /** A file of connections, whose robots are opened and connected when the server starts. */
  readonly connections?: string;
  /** What the studio is told it speaks with. */
  readonly version?: string;
  /** People sign in by name; always so where the data folder has accounts. */
  readonly accounts?: boolean;
  /** A cluster of NATS servers that this server and others tell of their robots. */
  readonly nats?: NatsOptions;
  /** Standards of plants that are spoken besides the API. */
  readonly standards?: StandardsOptions;
  /** Where it says what happens; left out: warnings go to stderr as sentences. */
  readonly log?: Log;
}
export interface Served {
  readonly url: string;
  /** Addresses for other machines, access code included. */
  readonly lanUrls: readonly string[];
  readonly code: string | null;
  /** SHA-256 of the authority that a device may trust (see /trust/); null without `lan`. */
  readonly fingerprint: string | null;
  /** Where the first admin chooses a name and a password; null when there is one, or nobody signs in by name. */
  readonly setUp: string | null;
  /** Where each standard that was asked for is spoken. */
  readonly standards: readonly string[];
  close(): Promise<void>;
}

/** Serves the built studio on loopback, or on the local network when asked. Rejects when the port is taken. */
export async function serve(options: ServeOptions): Promise<Served> {
  // A file that cannot be read is said before anything listens.
  if (options.connections !== undefined) readConnections(options.connections);
  const version = options.version ?? "";
  const log = options.log ?? textLog(line => console.error(line.trimEnd()));
  const say = (sentence: string): void => {
    log.say("warning", "server", sentence);
  };
  const clock_ms = (): number => Date.now();
  const { data } = options;
  const folder = data === undefined ? null : openDataFolder(data, version, clock_ms, nodeScheduler, say);
  const dated_ms = folder?.now_ms ?? clock_ms;
  const addresses = options.lan ? lanAddresses() : [];
  const accounts = peopleOf(options, dated_ms);
  const access = options.lan && !accounts ? accessCode(() => nodeScheduler.now_s()) : null;
  const hosts = new Set([...LOOPBACK, ...addresses]);
  const programs = prepareJobInWorker();
  // Whoever has the code may open controllers: on a network only those that whoever started the server named.
  const allowed = options.robots ?? (options.lan ? ["127.0.0.1", "localhost"] : undefined);
  const parts: { robots?: ApiRobots; standards?: StartedStandards; fleet?: Fleet; reached?: string } = {};
  const stations = stationHost(
    schedulerWith(nodeScheduler, () => parts.robots?.beat()),
    version,
    programs.layOut,
    { training: options.training, robots: allowed },
  );
  const robots = (parts.robots = createApiRobots(stations, nodeScheduler));
  const audit = data === undefined ? null : openAuditLog(data, clock_ms, say);
  const auditing = audit && auditHost(stations, audit, say);
  const tokens = tokenReader(data, dated_ms, say);
  const sessions = createSessions(() => nodeScheduler.now_s());
  const signedIn = (cookies: string | undefined): Account | null => {
    const name = sessions.nameOf(cookies);
    return (name === null ? undefined : accounts?.find(name)) ?? null;
  };
  const gate = createGate({
    access,
    tokens,
    people: accounts && signedIn,
    audit,
    scheduler: nodeScheduler,
    onTrouble: say,
  });
  const written = (who: string, action: string, detail: string, done: boolean): void => {
    audit?.write({ who, action, robot: "", detail, outcome: done ? "done" : "refused" });
  };
  const judge = createJudge();
  const links = cellLinks(tokens);
  const linkOf = (cookies: string | undefined): string | null => links.of(cookies)?.cell ?? null;
  const cells = documentFolder(data, "cells");
  const shared = createSharedCells({ folder: data, cells, scheduler: nodeScheduler, say });
  const counts = new Map<number, number>();
  let ready = true;
  const api = apiListener({
    handlers: apiHandlers({
      version,
      host: stations,
      robots,
      judge,
      scheduler: nodeScheduler,
      data: options.data,
      programs: documentFolder(data, "programs"),
      cells,
      shared,
      now_ms: dated_ms,
      reached: () => parts.reached ?? "",
      linkOf,
      requests: { byClass: counts },
      ready: () => ready,
      fleet: () => parts.fleet!,
      training: options.training === true,
      people: accounts && {
        training: options.training === true,
        linkOf,
        accounts,
        sessions,
        now_s: () => nodeScheduler.now_s(),
        audit: written,
      },
    }),
    headers: HEADERS,
    counts,
    enter: (request, route, subject) => gate.enter(request, route.access, subject),
    audit,
    closing: () => !ready,
    observe: (route, method, status, began_ms) => parts.standards?.request({ route, method, status, began_ms }),
  });
  const own = options.lan ? await certificate(options.data, addresses, hostname()) : null;
  const listener = studioListener(
    siteFiles(options.studio, options.docs),
    hosts,
    access,
    api,
    say,
    links,
    own?.authority,
  );
  const server = own ? createHttps({ key: own.key, cert: own.cert }, listener) : createHttp(listener);
  const states = robotStates(stations, clock_ms, say);
  const logging = logRobots(states, log);
  const end = (): void => {
    ready = false;
    logging();
    states.close();
    robots.close();
    stations.close();
    programs.close();
    judge.close();
    auditing?.();
    audit?.close();
    folder?.close();
  };
  const host = options.host ?? (options.lan ? "0.0.0.0" : "127.0.0.1");
  let standards: StartedStandards;
  try {
    await new Promise<void>((resolve, reject) => {
      server.once("error", reject);
      server.listen(options.port, host, resolve);
    });
    const context: StandardContext = {
      states,
      robots,
      scheduler: nodeScheduler,
      now_ms: clock_ms,
      version,
      host,
      hosts,
      certificate: own,
      enter: gate.enter,
      tokens,
      data: options.data,
      say,
    };
    // As other machines reach it; a server for this machine alone is reached by none.
    const reached =
      addresses[0] === undefined ? "" : `https://${addresses[0]}:${(server.address() as AddressInfo).port}/`;
    parts.reached = reached;
    parts.fleet = options.nats ? await joinFleet(context, options.nats, reached) : ownFleet(context, reached);
    standards = parts.standards = await startStandards(context, options.standards ?? {});
  } catch (problem) {
    await parts.fleet?.close();
    server.close();
    end();
    throw problem;
  }
  const recorder =
    options.data === undefined
      ? null
      : await recordServer(stations, join(options.data, "recordings"), nodeScheduler, say);
  const restoring =
    options.connections === undefined ? null : restoreConnections(stations, options.connections, nodeScheduler, say);
  const port = (server.address() as AddressInfo).port;
  const scheme = options.lan ? "https" : "http";
  const query = access ? `?code=${access.code}` : "";
  const relay = createVideoRelay(
    nodeScheduler.now_s,
    addresses.map(address => `${scheme}://${address}:${port}/camera/${query}`),
  );
  const socket = openRoutes(
    server,
    [
      connectionRoute(stations, gate.nameOf, gate.roleOf),
      streamRoute(stations, nodeScheduler),
      videoRoute(relay),
      editingRoute(shared, gate, nodeScheduler, (who, action, detail, done) => {
        try {
          written(who, action, detail, done);
        } catch (problem) {
          say(`The audit log cannot be written: ${problem instanceof Error ? problem.message : String(problem)}.`);
        }
      }),
    ],
    {
      enters: request => isServed(hosts, request) && gate.socket(request),
      stays: gate.stays,
      scheduler: nodeScheduler,
    },
  );
  const close = async (): Promise<void> => {
    // Robots first: nobody commands any more, what still moves is stopped and waited for until it stands.
    ready = false;
    log.say("info", "closing", "The server closes: every robot is stopped.");
    robots.stop("server", undefined, false);
    restoring?.close();
    socket.close();
    await shared.close();
    robots.close();
    await standards.close();
    const moving = (id: string): boolean => states.all.get(id)?.sample?.moving === true;
    for (const id of await standstill(stations, moving, nodeScheduler))
      log.say("error", "closing", `${id} was told to stop and still says that it moves: look at it.`);
    recorder?.close();
    await parts.fleet?.close();
    await new Promise<void>(resolve => {
      end();
      server.closeAllConnections();
      server.close(() => {
        resolve();
      });
    });
  };
  let closing: Promise<void> | null = null;
  const first = accounts?.all.length === 0 ? accounts.invite(null, "admin") : null;
  return {
    setUp:
      first === null
        ? null
        : `${scheme}://${options.lan ? (addresses[0] ?? "localhost") : "localhost"}:${port}/?invitation=${first}`,
    url: `${scheme}://127.0.0.1:${port}/${query}`,
    lanUrls: addresses.map(address => `${scheme}://${address}:${port}/${query}`),
    code: access?.code ?? null,
    fingerprint: own ? new X509Certificate(own.authority).fingerprint256 : null,
    standards: standards.addresses,
    close: () => (closing ??= close()),
  };
}

/** The accounts of the data folder where people sign in by name, or null. */
function peopleOf({ accounts, data }: ServeOptions, now_ms: () => number): Accounts | null {
  if (accounts === true && data === undefined)
    throw new PlainFault(
      "people.no-folder",
      "Accounts are kept in a data folder.",
      "Start the server with --data DIR.",
    );
  return data !== undefined && (accounts === true || hasAccounts(data)) ? openAccounts(data, now_ms) : null;
}
