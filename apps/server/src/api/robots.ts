import { randomBytes } from "node:crypto";
import type { CommandOutcome, Scheduler } from "@twincell/core";
import {
  refused,
  createClient,
  type Client,
  type Request,
  type RobotServer,
  type ServedConnection,
} from "@twincell/protocol";

export interface Lease {
  readonly token: string;
  readonly robot: string;
  readonly who: string;
  readonly expires_s: number;
}
interface Held extends Lease {
  readonly client: Client;
  readonly leave: () => void;
  until_s: number;
  /** Requests under way: the lease does not end before them. */
  busy: number;
}
/** What is known of one robot, as the texts that were last told of it. */
interface Heard {
  sample: string | null;
  link: string | null;
  guard: string | null;
  production: string | null;
  signals: unknown;
  samples: number;
}
const TOLD = /^\{"type":"(\w+)","(?:station|id)":("(?:[^"\\]|\\.)*")/;
/** How often leases say that they are alive, at most [s]: well within the 80 ms of the guard. */
const BEAT_S = 0.01;
const MOST_LEASES = 64;

export interface ApiRobots {
  find(id: string): ServedConnection | undefined;
  state(id: string): {
    readonly sample: unknown;
    readonly link: unknown;
    readonly guard: unknown;
    readonly production: unknown;
  };
  samples(id: string): number;
  /** As that person, without a lease. */
  ask(who: string, request: Request): Promise<CommandOutcome>;
  stop(who: string, robot: string | undefined, emergency: boolean): void;
  take(robot: string, who: string, expires_s: number): Promise<Lease | CommandOutcome>;
  give(token: string): Promise<CommandOutcome>;
  /** With a lease of that robot; `onGone` is told the function that stops it when whoever asked is gone. */
  command(token: string, robot: string, request: Request, onGone?: (stop: () => void) => void): Promise<CommandOutcome>;
  holds(token: string, robot: string): boolean;
  /**
   * Signs of life of those who have a lease by HTTP: their open connection is one, and without a motion none is needed.
   */
  beat(): void;
  close(): void;
}

/** The robots of a host as HTTP sees them: what was last told of each, and leases that requests name. */
export function createApiRobots(host: RobotServer, scheduler: Scheduler): ApiRobots {
  const heard = new Map<string, Heard>();
  const leases = new Map<string, Held>();
  const callers = new Map<string, { readonly client: Client; readonly leave: () => void }>();
  let beat_s = -Infinity;
  let taken = 0;

  function join(who: string): { readonly client: Client; readonly leave: () => void } {
    const commander = host.join(who, {
      send(text) {
        // Only answers: what else is told is kept once, for all.
        if (text.startsWith('{"type":"answer"')) client.hear(text);
      },
      close() {
        client.gone();
      },
    });
    const client = createClient(
      {
        send: text => {
          commander.hear(text);
        },
        close: () => undefined,
      },
      () => scheduler.now_s(),
      () => undefined,
    );
    return {
      client,
      leave() {
        client.gone();
        commander.leave();
      },
    };
  }
  /** Everybody without a lease who has the same name is one to the host. */
  function caller(who: string): Client {
    let found = callers.get(who);
    if (!found) {
      if (callers.size >= MOST_LEASES) {
        const [oldest] = callers;
        callers.delete(oldest![0]);
        oldest![1].leave();
      }
      callers.set(who, (found = join(who)));
    }
    return found.client;
  }
  const watcher = host.join("api", {
    send(text) {
      const told = TOLD.exec(text);
      if (!told) return;
      const id = JSON.parse(told[2]!) as string;
      const type = told[1]!;
      if (type === "closed") {
        heard.delete(id);
        for (const lease of leases.values()) if (lease.robot === id) drop(lease);
        return;
      }
      if (type !== "sample" && type !== "link" && type !== "guard" && type !== "production") return;
      let one = heard.get(id);
      if (!one)
        heard.set(
          id,
          (one = { sample: null, link: null, guard: null, production: null, signals: undefined, samples: 0 }),
        );
      one[type] = text;
      if (type !== "sample") return;
      one.samples++;
      // Lines are told when they change.
      if (text.includes('"signals":{')) one.signals = (JSON.parse(text) as { readonly signals?: unknown }).signals;
    },
    close: () => undefined,
  });
  function drop(lease: Held): void {
    leases.delete(lease.token);
    lease.leave();
  }
  const expire = scheduler.every(0.25, () => {
    const now_s = scheduler.now_s();
    for (const lease of leases.values()) if (lease.busy === 0 && now_s > lease.until_s) drop(lease);
  });
  const unknownLease = refused(
    "lease.unknown",
    "This request names no lease of that robot, or one that has ended.",
    "Take it with POST /api/v1/robots/{id}/lease and name it in the header Twincell-Lease.",
  );
  const parsed = (text: string | null): unknown => (text === null ? null : JSON.parse(text));

  return {
    find: id => host.stations.find(({ words }) => words.id === id),
    state(id) {
      const one = heard.get(id);
      const sample = parsed(one?.sample ?? null) as object | null;
      return {
        sample: sample && one?.signals !== undefined ? { ...sample, signals: one.signals } : sample,
        link: parsed(one?.link ?? null),
        guard: parsed(one?.guard ?? null),
        production: parsed(one?.production ?? null),
      };
    },
    samples: id => heard.get(id)?.samples ?? 0,
    ask: (who, request) => caller(who).ask(request),
    stop(who, robot, emergency) {
      caller(who).stop(robot, emergency);
    },
    async take(robot, name, expires_s) {
      if (leases.size >= MOST_LEASES)
        return refused("lease.too-many", `${MOST_LEASES} leases are held, which is the most.`, "Give one back first.");
      // A guard knows commanders by name: two of the same name must not share a lease.
      const who = `${name} (lease ${++taken})`;
      const { client, leave } = join(who);
      const outcome = await client.ask({ type: "take", station: robot });
      if (outcome.kind !== "done") {
        leave();
        return outcome;
      }
      const token = randomBytes(24).toString("base64url");
      leases.set(token, {
        token,
        robot,
        who,
        expires_s,
        client,
        leave,
        until_s: scheduler.now_s() + expires_s,
        busy: 0,
      });
      return { token, robot, who, expires_s };
    },
    async give(token) {
      const lease = leases.get(token);
      if (!lease) return unknownLease;
      const outcome = await lease.client.ask({ type: "release", station: lease.robot });
      if (leases.get(token) === lease) drop(lease);
      return outcome;
    },
    holds: (token, robot) => leases.get(token)?.robot === robot,
    async command(token, robot, request, onGone) {
      const lease = leases.get(token);
      if (lease?.robot !== robot) return unknownLease;
      lease.busy++;
      onGone?.(() => {
        lease.client.stop(robot);
      });
      try {
        return await lease.client.ask(request);
      } finally {
        lease.busy--;
        lease.until_s = scheduler.now_s() + lease.expires_s;
      }
    },
    beat() {
      const now_s = scheduler.now_s();
      if (leases.size === 0 || now_s - beat_s < BEAT_S) return;
      beat_s = now_s;
      for (const lease of leases.values()) lease.client.alive(lease.robot);
    },
    close() {
      expire();
      watcher.leave();
      for (const lease of [...leases.values()]) drop(lease);
      for (const { leave } of callers.values()) leave();
      callers.clear();
    },
  };
}

/**
 * That scheduler, with `before` called before each tick: leases by HTTP are alive whenever a guard looks, however late
 * a tick comes.
 */
export function schedulerWith(scheduler: Scheduler, before: () => void): Scheduler {
  return {
    now_s: () => scheduler.now_s(),
    every: (period_s, tick) =>
      scheduler.every(period_s, () => {
        before();
        tick();
      }),
  };
}
