import { mkdirSync, mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { setTimeout as pause } from "node:timers/promises";
import { driverKindById, memoryNetwork, openVirtualPendant } from "@twincell/controllers";
import { manualScheduler, robotById, seededRandom } from "@twincell/core";
import {
  createClient,
  readConnectionEvent,
  write,
  type ConnectionRequest,
  type ConnectionEvent,
} from "@twincell/protocol";
import { afterEach, beforeEach, expect, test } from "vitest";
import { WebSocket } from "ws";
import { servePendant, type ServedPendant } from "./index.ts";

const studio = mkdtempSync(join(tmpdir(), "twincell-pendant-"));
mkdirSync(join(studio, "pendant"));
writeFileSync(join(studio, "pendant", "index.html"), "<title>pendant</title>");

/** A virtual UR on a clock of the test's own, its pendant on a real socket. */
async function bench() {
  const scheduler = manualScheduler();
  const robot = robotById("ur10e")!;
  const brand = driverKindById("ur")!;
  const opened = await openVirtualPendant({
    brand,
    robot,
    scheduler,
    network: memoryNetwork(scheduler),
    host: "127.0.0.1",
    interpret: () => ({ kind: "not-understood", faults: [] }),
  });
  if (opened.kind === "taken") throw new Error(opened.sentence);
  const served = await servePendant({
    studio,
    host: "127.0.0.1",
    port: 0,
    version: "test",
    scheduler,
    pendant: opened.cabinet,
    words: { id: "pendant", name: "Virtual UR10e", brand: "ur", robot: "ur10e", virtual: true, watchdog: "" },
  });
  if (served.kind === "taken") throw new Error(served.sentence);
  return {
    scheduler,
    served,
    opened,
    url: new URL(served.url),
    close() {
      served.close();
      opened.close();
    },
  };
}
let here: Awaited<ReturnType<typeof bench>>;
beforeEach(async () => {
  here = await bench();
});
afterEach(() => {
  here.close();
});

const dial = (origin?: string): WebSocket =>
  new WebSocket(`ws://${here.url.host}/stations`, origin === undefined ? {} : { origin });
const opening = (socket: WebSocket): Promise<"open" | "refused"> =>
  new Promise(resolve => {
    socket.once("open", () => {
      resolve("open");
    });
    socket.once("error", () => {
      resolve("refused");
    });
  });
/** A page at the pendant. */
async function visit() {
  const socket = dial();
  const told: ConnectionEvent[] = [];
  const client = createClient(
    {
      send: text => {
        socket.send(text);
      },
      close: () => {
        socket.close();
      },
    },
    () => here.scheduler.now_s(),
    message => {
      told.push(message);
    },
  );
  socket.on("message", data => {
    client.hear(String(data as Buffer));
  });
  expect(await opening(socket)).toBe("open");
  const ask = (act: Extract<ConnectionRequest, { type: "pendant" }>["act"]) =>
    client.ask({ type: "pendant", station: "pendant", act });
  return { socket, client, told, ask };
}
const until = async (so: () => boolean, what: string): Promise<void> => {
  for (const end_ms = performance.now() + 10_000; !so(); ) {
    if (performance.now() > end_ms) throw new Error(`Never ${what}.`);
    await pause(2);
  }
};

test("the page is served at /pendant/; pages of another origin and of another name are not let in", async () => {
  expect(await fetch(here.served.url).then(answer => answer.text())).toContain("pendant");
  expect(await opening(dial(`http://${here.url.host}`))).toBe("open");
  for (const origin of ["http://evil.example", "null", `https://${here.url.host}.evil.example`])
    expect(await opening(dial(origin)), origin).toBe("refused");
  const again: ServedPendant = await servePendant({
    studio,
    host: "127.0.0.1",
    port: Number(here.url.port),
    version: "",
    scheduler: here.scheduler,
    pendant: here.opened.cabinet,
    words: { id: "p", name: "p", brand: "ur", robot: "ur10e", virtual: true, watchdog: "" },
  });
  expect(again).toMatchObject({ kind: "taken", sentence: expect.stringContaining(here.url.port) as string });
});

test("X-41 T-26 whoever's connection ends while a jog key is held has let it go: the arm stands within 100 ms of the controller's time", async () => {
  const { socket, ask, client, told } = await visit();
  const { virtual, cabinet: virtualPendant } = here.opened;
  const { scheduler } = here;
  expect(await client.ask({ type: "visit", station: "pendant", on: true })).toEqual({ kind: "done" });
  expect(told.find(message => message.type === "pendant")).toMatchObject({
    words: { brandName: "Universal Robots", keys: [{ id: "manual" }, { id: "automatic" }, { id: "remote" }] },
  });
  await ask({ do: "key", position: "manual" });
  await ask({ do: "enable", pressed: true });
  const jog = ask({ do: "jog", joint: 1, direction: 1 });
  await until(() => virtualPendant.shown.jog !== null, "jogging");
  for (let i = 0; i < 60; i++) {
    virtualPendant.alive("studio 1");
    await scheduler.elapse(0.01);
  }
  expect(virtualPendant.shown.moving).toBe(true);
  socket.terminate();
  await until(() => !virtualPendant.shown.enabled, "let go");
  await scheduler.elapse(0.1);
  const rest = virtual.jointAngles().slice();
  await scheduler.elapse(1);
  expect([...virtual.jointAngles()]).toEqual([...rest]);
  client.gone();
  expect(await jog).toMatchObject({ kind: "refused", why: { code: "host.gone" } });
});

test("any bytes on the socket: a sentence and the end of that connection, never a crash, nothing moves (400 sockets)", async () => {
  const random = seededRandom(60);
  const whole: ConnectionRequest[] = [
    { type: "visit", id: 0, station: "pendant", on: true },
    { type: "pendant", id: 1, station: "pendant", act: { do: "key", position: "manual" } },
    { type: "alive", station: "pendant" },
    { type: "pendant", id: 2, station: "pendant", act: { do: "trouble", delay_s: 0.1 } },
    { type: "stop", emergency: false },
  ];
  const before = here.opened.virtual.jointAngles().slice();
  const said: string[] = [];
  for (let round = 0; round < 400; round++) {
    const socket = dial();
    const ended = new Promise<void>(resolve => {
      socket.once("close", () => {
        resolve();
      });
    });
    socket.on("error", () => {
      socket.terminate();
    });
    socket.on("message", data => {
      const heard = readConnectionEvent(String(data as Buffer));
      if (heard.kind === "fault") said.push(heard.sentence);
    });
    expect(await opening(socket)).toBe("open");
    const text = write(whole[Math.floor(random() * whole.length)]!);
    const bytes = new TextEncoder().encode(text);
    if (random() < 0.3)
      socket.send(Buffer.from(Array.from({ length: 1 + Math.floor(random() * 64) }, () => Math.floor(random() * 256))));
    else {
      for (let k = 0; k < 3; k++) bytes[Math.floor(random() * bytes.length)] = 32 + Math.floor(random() * 95);
      socket.send(new TextDecoder().decode(bytes));
    }
    if (random() < 0.5) socket.terminate();
    else socket.close();
    await ended;
  }
  const last = dial();
  const sentences: string[] = [];
  const over = new Promise<void>(resolve => {
    last.once("close", () => {
      resolve();
    });
  });
  last.on("message", data => {
    const heard = readConnectionEvent(String(data as Buffer));
    if (heard.kind === "read" && heard.message.type === "fault") sentences.push(heard.message.sentence);
  });
  expect(await opening(last)).toBe("open");
  last.send('{"type":"dance"}');
  await over;
  expect(sentences).toEqual([expect.stringContaining("could not be understood") as string]);
  // Whatever the pendant said was a message of the protocol, and it still answers; a damaged text may have been a whole
  // act.
  expect(said).toEqual([]);
  await here.scheduler.elapse(1);
  expect([...here.opened.virtual.jointAngles()]).toEqual([...before]);
  const { ask, client } = await visit();
  expect(await ask({ do: "reset" })).toHaveProperty("kind");
  expect(await client.ask({ type: "zero", station: "pendant" })).toMatchObject({
    kind: "refused",
    why: { code: "pendant.only" },
  });
}, 60_000);
