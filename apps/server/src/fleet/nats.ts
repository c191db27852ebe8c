import type { JetStreamClient, JetStreamManager } from "@nats-io/jetstream";
import type { KV } from "@nats-io/kv";
import type { NatsConnection } from "@nats-io/transport-node";
import { PlainFault } from "@twincell/core";

export interface NatsOptions {
  /** host:port of one or more servers of the cluster. */
  readonly servers: readonly string[];
  /** Name of this line or plant among the others. */
  readonly site: string;
  /** Copies of what is kept: 1, or 3 in a cluster of three. */
  readonly replicas: number;
  /** How long states are kept [h]. */
  readonly kept_h: number;
}
/** Names in the cluster: subjects, streams and buckets. */
export const STATES = "TWINCELL_STATES";
export const EVENTS = "TWINCELL_EVENTS";
const OWNERS = "twincell_owners";
const COMMANDS = "twincell_commands";
/** A server that is gone owns its robots for so long after it last said that it is there [s]. */
export const OWNED_S = 10;
const COMMANDS_KEPT_MS = 3_600_000;
const DUPLICATES_NS = 120e9;
/** An election takes up to 8 s: what fails is tried again for longer than that [ms]. */
const PATIENCE_MS = 60_000;
const PAUSE_MS = 150;

export const subjectOf = (kind: "state" | "event" | "command", site: string, robot?: string): string =>
  `twincell.${kind}.${site}${robot === undefined ? "" : `.${tokenOf(robot)}`}`;
/** A name as one token of a subject or a key. */
export const tokenOf = (name: string): string => Buffer.from(name, "utf8").toString("base64url");

export interface Cluster {
  readonly connection: NatsConnection;
  readonly streams: JetStreamClient;
  readonly manager: JetStreamManager;
  /** Which server has which robot. */
  readonly owners: KV;
  /** Commands by id with what became of them. */
  readonly commands: KV;
  close(): Promise<void>;
}

/** Tries again what fails while a leader is elected; gives up with the last problem. */
export async function again<T>(act: () => Promise<T>, patience_ms = PATIENCE_MS): Promise<T> {
  const until = performance.now() + patience_ms;
  for (;;)
    try {
      return await act();
    } catch (problem) {
      if (performance.now() > until) throw problem;
      await new Promise(resolve => setTimeout(resolve, PAUSE_MS));
    }
}

/** Joins a NATS cluster with JetStream and makes the streams and buckets that are not there. */
export async function joinCluster({ servers, site, replicas, kept_h }: NatsOptions): Promise<Cluster> {
  if (!/^[\w-]{1,60}$/.test(site))
    throw new PlainFault("nats.site", `“${site}” is no name of a site.`, "Use letters, digits, “_” and “-”.");
  const [{ connect }, { jetstream, jetstreamManager, RetentionPolicy, StorageType }, { Kvm }] = await Promise.all([
    import("@nats-io/transport-node"),
    import("@nats-io/jetstream"),
    import("@nats-io/kv"),
  ]);
  let connection: NatsConnection;
  try {
    connection = await connect({ servers: [...servers], maxReconnectAttempts: -1, reconnectTimeWait: 200, name: site });
  } catch (problem) {
    const why = problem instanceof Error ? problem.message : String(problem);
    throw new PlainFault(
      "nats.none",
      `No NATS server answers at ${servers.join(", ")}: ${why}.`,
      "docs/scale.md says how to start one.",
    );
  }
  try {
    const manager = await again(() => jetstreamManager(connection, { timeout: 5000 }));
    const add = (name: string, subjects: string[]) =>
      again(() =>
        manager.streams.add({
          name,
          subjects,
          num_replicas: replicas,
          storage: StorageType.File,
          retention: RetentionPolicy.Limits,
          max_age: kept_h * 3600e9,
          duplicate_window: DUPLICATES_NS,
        }),
      );
    await add(STATES, [subjectOf("state", "*")]);
    await add(EVENTS, [subjectOf("event", "*")]);
    const kvm = new Kvm(connection);
    const owners = await again(() => kvm.create(OWNERS, { replicas, history: 1, ttl: OWNED_S * 1000 }));
    const commands = await again(() => kvm.create(COMMANDS, { replicas, history: 1, ttl: COMMANDS_KEPT_MS }));
    return {
      connection,
      streams: jetstream(connection, { timeout: 5000 }),
      manager,
      owners,
      commands,
      close: () => connection.close(),
    };
  } catch (problem) {
    await connection.close();
    throw problem;
  }
}
