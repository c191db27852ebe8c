import { randomBytes } from "node:crypto";
import type { CommandOutcome } from "@twincell/core";
import { causeOf, type StandardContext } from "../standards/standard.ts";
import type { RobotState } from "../standards/robot-states.ts";
import { answerCommands, type FleetCommand } from "./commands.ts";
import { fleetBatch, fleetRobotOf, Use, type FleetBatch, type FleetRobot } from "./fleet-state.ts";
import { joinCluster, OWNED_S, STATES, subjectOf, tokenOf, type Cluster, type NatsOptions } from "./nats.ts";
import { createOutbox } from "./outbox.ts";

/** So often what was heard is told [s]. */
const TICK_S = 0.1;
const OWNERS_S = OWNED_S / 4;
/** A robot that nobody tells of any more has no link after this time [ms], and is forgotten after that one. */
const SILENT_MS = 5_000;
const FORGOTTEN_MS = 7 * 86_400_000;
const MOST_ROBOTS = 20_000;
/** Samples of a robot that wait until it is known whose it is: a minute at 500 Hz. */
const MOST_SAMPLES = 30_000;

export interface SeenRobot extends FleetRobot {
  readonly site: string;
}
export interface Fleet {
  /** All robots, this server's own among them. */
  robots(): readonly SeenRobot[];
  /** Asks the server that has a robot to do something, once. */
  command(site: string, command: FleetCommand, within_ms: number): Promise<CommandOutcome>;
  close(): Promise<void>;
}
type Sample = FleetBatch["robots"][number]["samples"][number];

/** A server by itself: its own robots are its fleet. */
export function ownFleet(
  { states, scheduler, now_ms }: Pick<StandardContext, "states" | "scheduler" | "now_ms">,
  url: string,
  site = "here",
): Fleet {
  const use = new Use();
  const stop = scheduler.every(TICK_S, () => {
    for (const robot of states.all.values()) use.look(robot, now_ms());
  });
  return {
    robots: () => [...states.all.values()].map(robot => ({ site, ...fleetRobotOf(robot, use, url) })),
    command: () =>
      Promise.resolve({
        kind: "refused",
        why: { code: "fleet.none", sentence: "This server is by itself.", hint: "Start it with --nats." },
      }),
    close() {
      stop();
      return Promise.resolve();
    },
  };
}

/** A server among others: tells the cluster of its robots, hears of theirs, and carries out what it is asked to. */
export async function joinFleet(context: StandardContext, options: NatsOptions, url: string): Promise<Fleet> {
  const cluster = await joinCluster(options);
  const { site } = options;
  const server = `${site}-${randomBytes(6).toString("hex")}`;
  const outbox = createOutbox(cluster, context.say);
  const own = createOwn(context, cluster, { site, server, url }, outbox.put);
  const seen = await hearOthers(context, cluster);
  const endCommands = answerCommands(context, cluster, site);
  return {
    robots: () => seen.robots(),
    async command(where, command, within_ms) {
      try {
        const message = await cluster.connection.request(subjectOf("command", where), JSON.stringify(command), {
          timeout: within_ms,
        });
        return message.json();
      } catch (problem) {
        const sentence = `The server of ${where} does not answer: ${causeOf(problem)}.`;
        return { kind: "refused", why: { code: "fleet.silent", sentence, hint: "Send it again with the same id." } };
      }
    },
    async close() {
      endCommands();
      await own.close();
      await outbox.drained(5000);
      outbox.close();
      await seen.close();
      await cluster.close();
    },
  };
}

/** Tells of the robots of this server that no other server has. */
function createOwn(
  { states, scheduler, say, now_ms }: StandardContext,
  { owners }: Cluster,
  { site, server, url }: { readonly site: string; readonly server: string; readonly url: string },
  put: (subject: string, id: string, body: Uint8Array) => void,
) {
  const use = new Use();
  const samples = new Map<RobotState, Sample[]>();
  const owned = new Map<string, number>();
  const refusedOnce = new Set<string>();
  const text = new TextEncoder();
  let count = 0;
  let events = 0;
  const keyOf = (robot: RobotState): string => `${site}.${tokenOf(robot.id)}`;
  async function claim(robot: RobotState): Promise<void> {
    const key = keyOf(robot);
    const revision = owned.get(key);
    try {
      const now =
        revision === undefined ? await owners.create(key, server) : await owners.update(key, server, revision);
      if (states.all.has(robot.id)) owned.set(key, now);
      refusedOnce.delete(key);
    } catch (problem) {
      const holder = await owners.get(key).catch(() => undefined);
      // Without an answer nothing is known: what was ours stays so until somebody else is heard of.
      if (holder === undefined) return;
      if (holder?.operation === "PUT" && holder.string() === server) {
        owned.set(key, holder.revision);
        return;
      }
      owned.delete(key);
      if (holder?.operation !== "PUT" || refusedOnce.has(key)) return;
      refusedOnce.add(key);
      say(`${robot.name} of ${site} is told of by another server (${holder.string()}): ${causeOf(problem)}.`);
    }
  }
  const forget = states.listen({
    opened(robot) {
      samples.set(robot, []);
      void claim(robot);
    },
    closed(robot) {
      samples.delete(robot);
      const key = keyOf(robot);
      if (owned.delete(key)) void owners.delete(key).catch(() => undefined);
    },
    sample(robot) {
      const { sequence, time_s } = robot.sample!;
      const waiting = samples.get(robot);
      if (!waiting) return;
      if (waiting.length >= MOST_SAMPLES) waiting.shift();
      waiting.push([sequence, time_s, robot.heard_ms, Array.from(robot.q_rad)]);
    },
    event(event) {
      if (event.type !== "act" && event.type !== "notice") return;
      put(subjectOf("event", site), `${server}.e${events++}`, text.encode(JSON.stringify({ server, ...event })));
    },
  });
  const tick = (): void => {
    const robots = [...states.all.values()].filter(robot => owned.has(keyOf(robot)));
    for (const robot of states.all.values()) use.look(robot, now_ms());
    const told = robots.map(robot => ({
      state: fleetRobotOf(robot, use, url),
      samples: samples.get(robot)!.splice(0),
    }));
    if (told.length === 0) return;
    const batch: FleetBatch = { server, number: count++, robots: told };
    put(subjectOf("state", site), `${server}.${batch.number}`, text.encode(JSON.stringify(batch)));
  };
  const stops = [
    scheduler.every(TICK_S, tick),
    scheduler.every(OWNERS_S, () => {
      for (const robot of states.all.values()) void claim(robot);
    }),
  ];
  return {
    async close() {
      for (const stop of stops) stop();
      tick();
      forget();
      await Promise.all([...owned.keys()].map(key => owners.delete(key).catch(() => undefined)));
    },
  };
}

/** What all servers tell, the last of each robot. */
async function hearOthers({ now_ms, say }: StandardContext, { streams }: Cluster) {
  const { DeliverPolicy } = await import("@nats-io/jetstream");
  const robots = new Map<string, SeenRobot>();
  let closed = false;
  let end: (() => Promise<unknown>) | undefined;
  const hear = (site: string, text: string): void => {
    let value: unknown;
    try {
      value = JSON.parse(text);
    } catch {
      return;
    }
    const parsed = fleetBatch.safeParse(value);
    if (!parsed.success) return;
    for (const { state } of parsed.data.robots) {
      const key = `${site} ${state.id}`;
      if (!robots.has(key) && robots.size >= MOST_ROBOTS) continue;
      robots.set(key, { site, ...state });
    }
  };
  async function follow(): Promise<void> {
    while (!closed)
      try {
        const consumer = await streams.consumers.get(STATES, { deliver_policy: DeliverPolicy.LastPerSubject });
        const messages = await consumer.consume();
        end = () => messages.close();
        for await (const message of messages) hear(message.subject.split(".")[2] ?? "", message.string());
      } catch (problem) {
        if (closed) return;
        say(`The fleet is not heard: ${causeOf(problem)}. It is asked again.`);
        await new Promise(resolve => setTimeout(resolve, 500));
      }
  }
  const following = follow();
  return {
    robots(): readonly SeenRobot[] {
      const now = now_ms();
      for (const [key, { heard_ms }] of robots) if (now - heard_ms > FORGOTTEN_MS) robots.delete(key);
      return [...robots.values()].map(robot =>
        now - robot.heard_ms > SILENT_MS && robot.state !== "no-link" ? { ...robot, state: "no-link" } : robot,
      );
    },
    async close() {
      closed = true;
      await end?.();
      await following;
    },
  };
}
