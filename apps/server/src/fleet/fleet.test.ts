/** Servers in a cluster of real nats-servers: `npm run clients` builds nats-server. */
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { robotById } from "@twincell/core";
import { afterEach, expect, test, vi } from "vitest";
import { addToken, auditFile, readAudit, serve, type Served } from "../index.ts";
import { programOf } from "../standards/testing/broker.ts";
import { natsCluster, type NatsCluster } from "../standards/testing/nats-cluster.ts";
import { fleetBatch } from "./fleet-state.ts";
import { again, joinCluster, STATES, subjectOf } from "./nats.ts";
import { createOutbox } from "./outbox.ts";

const missing = process.env["CI"] === undefined && programOf("nats-server") === undefined;
const studio = mkdtempSync(join(tmpdir(), "twincell-studio-"));
writeFileSync(join(studio, "index.html"), "<title>studio</title>");
const open: { close(): unknown }[] = [];
afterEach(async () => {
  for (const each of open.splice(0).reverse()) await each.close();
});
const folder = (): string => mkdtempSync(join(tmpdir(), "twincell-data-"));
async function cluster(nodes: number): Promise<NatsCluster> {
  const made = await natsCluster(nodes);
  open.push(made);
  return made;
}
const optionsOf = ({ servers }: NatsCluster, site: string) => ({
  servers,
  site,
  replicas: servers.length,
  kept_h: 1,
});
async function server(nats: NatsCluster, site: string, data?: string): Promise<Served> {
  const served = await serve({
    studio,
    port: 0,
    version: "test",
    nats: optionsOf(nats, site),
    ...(data === undefined ? {} : { data }),
  });
  open.push(served);
  return served;
}
const ask = async (served: Served, method: string, path: string, body?: unknown, lease?: string) => {
  const response = await fetch(new URL(`/api/v1${path}`, served.url), {
    method,
    headers: {
      ...(body === undefined ? {} : { "content-type": "application/json" }),
      ...(lease === undefined ? {} : { "twincell-lease": lease }),
    },
    ...(body === undefined ? {} : { body: JSON.stringify(body) }),
  });
  return (await response.json()) as Record<string, unknown>;
};
const arm = { id: "arm", driver: "yaskawa", model: "yaskawa_gp8" };
async function connected(served: Served): Promise<void> {
  expect(await ask(served, "POST", "/robots", arm)).toEqual({ kind: "done" });
  const { lease } = await ask(served, "POST", "/robots/arm/lease", {});
  await ask(served, "POST", "/robots/arm/connect", undefined, String(lease));
  await ask(served, "POST", "/robots/arm/confirm", undefined, String(lease));
  await ask(served, "DELETE", "/robots/arm/lease", undefined, String(lease));
}
interface Entry {
  readonly site: string;
  readonly id: string;
  readonly state: string;
}
/** The fleet of a server as soon as it fits. */
async function fleetOf(served: Served, fits: (robots: readonly Entry[]) => boolean): Promise<readonly Entry[]> {
  for (;;) {
    const { robots } = (await ask(served, "GET", "/fleet")) as { readonly robots: readonly Entry[] };
    if (fits(robots)) return robots;
    await new Promise(resolve => setTimeout(resolve, 50));
  }
}

test("a server by itself tells of its own robots as its fleet", async () => {
  const served = await serve({ studio, port: 0, version: "test" });
  open.push(served);
  await connected(served);
  const robots = await fleetOf(served, ([robot]) => robot !== undefined && robot.state !== "no-link");
  expect(robots).toMatchObject([{ site: "here", id: "arm", model: "yaskawa_gp8", vendor: "Yaskawa", virtual: true }]);
});

test.skipIf(missing)(
  "a studio server sees robots of an edge server, has one of them moved exactly once by three commands of one id, and is refused without a token of the edge; the stop goes through",
  async () => {
    const nats = await cluster(1);
    const data = folder();
    const edge = await server(nats, "line1", data);
    const studioServer = await server(nats, "office");
    await connected(edge);
    await fleetOf(studioServer, robots => robots.some(({ site, state }) => site === "line1" && state !== "no-link"));
    const token = addToken(data, "Office", "operator", null)!;
    const q_rad = robotById(arm.model)!.home_rad.map((q, i) => (i === 0 ? q + 0.2 : q));
    const command = { id: "move-0000-1", token, robot: "arm", act: { type: "move", q_rad } };
    const send = (body: object) => ask(studioServer, "POST", "/fleet/line1/command", body);
    const outcomes = await Promise.all([send(command), send(command), send(command)]);
    const { lines } = readAudit(readFileSync(auditFile(data), "utf8"));
    expect(lines.filter(({ action, outcome }) => action === "moves the joints" && outcome === "asked")).toHaveLength(1);
    // Whoever was not first is told that it was begun, or what became of it.
    const last = await send(command);
    for (const outcome of outcomes)
      if ((outcome["why"] as { readonly code?: string } | undefined)?.code !== "fleet.begun")
        expect(outcome).toEqual(last);
    expect(await send({ ...command, id: "forged-0001", token: "twincell_forged" })).toMatchObject({
      why: { code: "fleet.token" },
    });
    expect(await send({ ...command, id: "nobody-0001", robot: "other" })).toMatchObject({
      why: { code: "robot.none" },
    });
    expect(await send({ ...command, id: "stop-00001", act: { type: "stop", emergency: true } })).toEqual({
      kind: "done",
    });
    expect(await ask(studioServer, "POST", "/fleet/nowhere/command", command)).toMatchObject({
      why: { code: "fleet.silent" },
    });
  },
  120_000,
);

test.skipIf(missing)(
  "of two servers that claim one robot the second says so and does not tell of it; it does when the first has gone",
  async () => {
    const nats = await cluster(1);
    const said = vi.spyOn(console, "error").mockImplementation(() => undefined);
    const first = await server(nats, "line1");
    await connected(first);
    await fleetOf(first, robots => robots.length === 1);
    const second = await server(nats, "line1");
    await connected(second);
    await vi.waitFor(
      () => {
        expect(said.mock.calls.flat().join()).toContain("is told of by another server");
      },
      { timeout: 20_000 },
    );
    const other = await joinCluster(optionsOf(nats, "reader"));
    open.push(other);
    const tellers = new Set<string>();
    const reading = other.connection.subscribe(subjectOf("state", "line1"), {
      callback(_problem, message) {
        tellers.add(fleetBatch.parse(message.json()).server);
      },
    });
    await vi.waitFor(() => {
      expect(tellers.size).toBe(1);
    });
    await first.close();
    await vi.waitFor(
      () => {
        expect(tellers.size).toBe(2);
      },
      { timeout: 20_000 },
    );
    reading.unsubscribe();
    said.mockRestore();
  },
  120_000,
);

test.skipIf(missing)(
  "with three nats-servers of which the one that leads the stream is killed, no sample of 200 made-up robots at 10 Hz and of a virtual one is lost or kept twice",
  async () => {
    const nats = await cluster(3);
    const edge = await server(nats, "line1");
    await connected(edge);
    const made = await joinCluster(optionsOf(nats, "hall"));
    open.push(made);
    const outbox = createOutbox(made, sentence => {
      throw new Error(sentence);
    });
    const text = new TextEncoder();
    const TICKS = 60;
    const ROBOTS = 200;
    for (let tick = 0; tick < TICKS; tick++) {
      const robots = Array.from({ length: ROBOTS }, (_, i) => [`r${i}`, tick, [0.1 * tick, 0, 0, 0, 0, 0]]);
      outbox.put(subjectOf("state", "hall"), `hall.${tick}`, text.encode(JSON.stringify({ tick, robots })));
      if (tick === TICKS / 2) nats.kill(await nats.leader(STATES));
      await new Promise(resolve => setTimeout(resolve, 100));
    }
    await outbox.drained(60_000);
    expect(outbox.waiting).toBe(0);
    await edge.close();
    const kept = await again(() => made.manager.streams.info(STATES));
    const consumer = await again(() => made.streams.consumers.get(STATES));
    const ticks: number[] = [];
    const numbers: number[] = [];
    const sequences: number[] = [];
    let left = kept.state.messages;
    for await (const message of await consumer.consume()) {
      if (message.subject === subjectOf("state", "hall")) {
        const { tick, robots } = message.json<{ readonly tick: number; readonly robots: readonly unknown[] }>();
        expect(robots).toHaveLength(ROBOTS);
        ticks.push(tick);
      } else {
        const batch = fleetBatch.parse(message.json());
        numbers.push(batch.number);
        for (const { samples } of batch.robots) sequences.push(...samples.map(([sequence]) => sequence));
      }
      if (--left === 0) break;
    }
    const whole = (count: number): number[] => Array.from({ length: count }, (_, i) => i);
    expect(ticks.toSorted((a, b) => a - b)).toEqual(whole(TICKS));
    expect(numbers.toSorted((a, b) => a - b)).toEqual(whole(numbers.length));
    expect(new Set(sequences).size).toBe(sequences.length);
    expect(sequences.length).toBeGreaterThan(100);
  },
  180_000,
);
