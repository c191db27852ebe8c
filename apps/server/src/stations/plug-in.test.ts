import { robotById, type CommandOutcome, type Scheduler } from "@twincell/core";
import {
  createClient,
  readConnectionRequest,
  readConnectionEvent,
  write,
  type Client,
  type Request,
  type ConnectionEvent,
  type EventOf,
} from "@twincell/protocol";
import { spawn, spawnSync, type ChildProcess } from "node:child_process";
import { readFileSync } from "node:fs";
import { createServer, type AddressInfo } from "node:net";
import { setTimeout as pause } from "node:timers/promises";
import { fileURLToPath } from "node:url";
import { afterEach, describe, expect, test } from "vitest";
import { stationHost } from "./host.ts";
import { lines } from "./lines.ts";

const robot = robotById("yaskawa_gp8")!;
const python = process.env["TWINCELL_PYTHON"] ?? "python3";
const noPython = spawnSync(python, ["-c", ""]).status !== 0;
if (noPython) console.warn("T-60 is not shown here: there is no python3.");
const script = fileURLToPath(new URL("testing/plug_in.py", import.meta.url));
const TARGET = [0.3, 0.1, -0.1, 0.2, -0.2, 0.1];

/**
 * Goes with the machine's clock, but a stall of this process, which is the test's and not the robot's, is not counted:
 * the guard would stop for it.
 */
function patientClock(): Scheduler & { close(): void } {
  const due = new Set<{ at_s: number; readonly period_s: number; readonly tick: () => void }>();
  let now_s = 0;
  let seen_ms = performance.now();
  const timer = setInterval(() => {
    const ms = performance.now();
    now_s += Math.min(0.01, (ms - seen_ms) / 1000);
    seen_ms = ms;
    for (const each of [...due])
      if (due.has(each) && each.at_s <= now_s) {
        each.at_s = now_s + each.period_s;
        each.tick();
      }
  }, 4);
  return {
    now_s: () => now_s,
    every(period_s, tick) {
      const each = { at_s: now_s + period_s, period_s, tick };
      due.add(each);
      return () => {
        due.delete(each);
      };
    },
    close() {
      clearInterval(timer);
    },
  };
}

const open: { close(): void }[] = [];
afterEach(() => {
  for (const each of open.splice(0).reverse()) each.close();
});

/** The plug-in on that port, or on a free one. */
async function plugIn(port = 0, name = robot.id, joints = 6): Promise<{ port: number; child: ChildProcess }> {
  const child = spawn(python, [script, String(port), name, String(joints)], { stdio: ["ignore", "pipe", "inherit"] });
  open.push({
    close() {
      child.kill("SIGKILL");
    },
  });
  const said = await new Promise<string>((resolve, reject) => {
    child.stdout.once("data", (bytes: Buffer) => {
      resolve(bytes.toString());
    });
    child.once("exit", reject);
  });
  return { port: Number(said), child };
}
function bench() {
  const clock = patientClock();
  const host = stationHost(clock, "test");
  const told: ConnectionEvent[] = [];
  const client: Client = createClient(
    {
      send: text => {
        commander.hear(text);
      },
      close() {
        /* Ends with the test. */
      },
    },
    () => clock.now_s(),
    message => {
      told.push(message);
    },
  );
  const early: string[] = [];
  let ready = false;
  const commander = host.join("you", {
    send: text => {
      if (ready) client.hear(text);
      else early.push(text);
    },
    close() {
      client.gone();
    },
  });
  ready = true;
  for (const text of early) client.hear(text);
  const stopBeat = clock.every(0.02, () => {
    client.alive("s");
  });
  open.push(clock, host, { close: stopBeat });
  const ask = (request: Request): Promise<CommandOutcome> => client.ask(request);
  const last = (): EventOf<"sample"> | undefined =>
    told.findLast((message): message is EventOf<"sample"> => message.type === "sample");
  const link = (): EventOf<"link"> | undefined =>
    told.findLast((message): message is EventOf<"link"> => message.type === "link");
  const until = async (so: () => boolean, what: string): Promise<void> => {
    for (const end_ms = performance.now() + 15_000; !so(); ) {
      if (performance.now() > end_ms) throw new Error(`${what}: ${link()?.state} ${link()?.sentence}`);
      await pause(10);
    }
  };
  const connect = async (port: number): Promise<CommandOutcome> => {
    expect(
      await ask({
        type: "open",
        station: "s",
        brand: "plug-in",
        robot: robot.id,
        address: { host: "127.0.0.1", ports: { "plug-in": port } },
      }),
    ).toEqual({ kind: "done" });
    expect(await ask({ type: "take", station: "s" })).toEqual({ kind: "done" });
    return ask({ type: "connect", station: "s" });
  };
  return { client, ask, told, last, link, until, connect };
}
/** A process that says these bytes to whoever connects, and nothing else. */
async function saying(bytes: string | Uint8Array): Promise<number> {
  const server = createServer(socket => {
    socket.on("error", () => {
      socket.destroy();
    });
    socket.write(bytes);
  });
  open.push(server);
  await new Promise<void>(resolve => {
    server.listen(0, "127.0.0.1", resolve);
  });
  return (server.address() as AddressInfo).port;
}
const farthest = (a: readonly number[], b: readonly number[]): number =>
  Math.max(...a.map((q, i) => Math.abs(q - b[i]!)));

describe("T-60 a maker's own driver as a process of its own", () => {
  test.skipIf(noPython)(
    "moves, is stopped, is killed and comes back without motion; the guard is the common one",
    async () => {
      const { ask, client, last, link, until, connect } = bench();
      const first = await plugIn();
      expect(await connect(first.port)).toEqual({ kind: "done" });
      expect(await ask({ type: "move", station: "s", q_rad: TARGET })).toMatchObject({
        kind: "refused",
        why: { code: "guard.enabling-switch" },
      });
      expect(await ask({ type: "hold", station: "s", pressed: true })).toEqual({ kind: "done" });
      expect(await ask({ type: "move", station: "s", q_rad: TARGET })).toEqual({ kind: "done" });
      await until(() => farthest(last()?.q_rad ?? [9], TARGET) < 1e-9, "at the target");
      expect(await ask({ type: "move", station: "s", q_rad: [9, 0, 0, 0, 0, 0] })).toMatchObject({
        kind: "refused",
        why: { code: "limits.joint" },
      });

      const stopped = ask({ type: "move", station: "s", q_rad: TARGET.map(() => 1) });
      await until(() => last()!.moving && last()!.q_rad[0]! > 0.35, "on the way");
      client.stop("s");
      expect(await stopped).toMatchObject({ kind: "stopped" });
      await until(() => !last()!.moving, "at rest");
      expect(last()!.q_rad[0]).toBeLessThan(0.9);

      await ask({ type: "hold", station: "s", pressed: true });
      const cut = ask({ type: "move", station: "s", q_rad: TARGET.map(() => 1) });
      await until(() => last()!.moving, "on the way again");
      first.child.kill("SIGKILL");
      expect(await cut).toMatchObject({ kind: "stopped" });
      await until(() => link()?.state === "lost", "lost");
      await plugIn(first.port);
      await until(() => link()?.state === "open", "open again");
      await pause(500);
      // The new process stands at zero and stays there: nothing of before goes on.
      expect([link()?.state, last()!.moving, farthest(last()!.q_rad, [0, 0, 0, 0, 0, 0])]).toEqual(["open", false, 0]);
      expect(await ask({ type: "move", station: "s", q_rad: TARGET })).toMatchObject({
        kind: "refused",
        why: { code: "guard.link-unconfirmed" },
      });
      expect(await ask({ type: "confirm", station: "s" })).toEqual({ kind: "done" });
      await ask({ type: "hold", station: "s", pressed: true });
      expect(await ask({ type: "move", station: "s", q_rad: TARGET })).toEqual({ kind: "done" });
    },
    40_000,
  );

  test.skipIf(noPython)(
    "another robot or another number of joints is refused with both names, and not tried again",
    async () => {
      for (const [name, joints, sentence] of [
        ["ur10e", 6, "The plug-in drives “ur10e”; the station is of “yaskawa_gp8”."],
        [robot.id, 7, `The plug-in of “yaskawa_gp8” tells 7 joints; ${robot.name} has 6.`],
      ] as const) {
        const { ask, link, connect } = bench();
        const { port } = await plugIn(0, name, joints);
        expect(await connect(port)).toMatchObject({ kind: "refused", why: { code: "plug-in.other-robot", sentence } });
        await pause(400);
        expect(link()).toMatchObject({ state: "closed", sentence });
        expect((await ask({ type: "zero", station: "s" })).kind).toBe("refused");
      }
    },
    20_000,
  );

  test("what cannot be read ends the link with one sentence", async () => {
    for (const [bytes, sentence] of [
      ["HTTP/1.1 200 OK\r\n\r\n", /^A message is JSON; this one is not/],
      [Uint8Array.of(0xff, 0xfe, 0x0a), /^What came is no text in UTF-8/],
      ['{"type":"dance"}\n', /^A message could not be understood/],
      ['{"type":"hello","protocol":99,"version":"","brands":[],"stations":[]}\n', /version 99/],
      ['{"type":"fault","sentence":"Out of order."}\n', /^Out of order/],
    ] as const) {
      const { connect, link } = bench();
      const outcome = await connect(await saying(bytes));
      expect(outcome).toMatchObject({
        kind: "refused",
        why: { code: "plug-in.lost", sentence: expect.stringMatching(sentence) as string },
      });
      expect(link()?.state).toBe("lost");
    }
  });

  test("no address, no station; nobody there, a sentence", async () => {
    const { ask } = bench();
    expect(await ask({ type: "open", station: "s", brand: "plug-in", robot: robot.id })).toMatchObject({
      kind: "refused",
      why: { code: "station.no-address" },
    });
  });

  test("the session of docs/controllers/plug-in.md is of the schemas, line by line", () => {
    const text = readFileSync(new URL("../../../../docs/controllers/plug-in.md", import.meta.url), "utf8");
    const session = [...text.matchAll(/^([<>]) (\{.*\})$/gm)];
    expect(session.length).toBeGreaterThan(10);
    for (const [, way, line] of session) {
      const heard = way === ">" ? readConnectionRequest(line!) : readConnectionEvent(line!);
      expect(heard, line).toMatchObject({ kind: "read" });
      if (heard.kind === "read") expect(JSON.parse(write(heard.message))).toEqual(JSON.parse(line!));
    }
  });

  test("lines are found wherever chunks end; one that does not end is said once", () => {
    const bytes = new TextEncoder().encode('{"ä":1}\n\n{"b":2}\r\nrest');
    for (let at = 0; at <= bytes.length; at++) {
      const heard: string[] = [];
      const take = lines(
        line => {
          heard.push(line.trim());
        },
        sentence => {
          heard.push(sentence);
        },
      );
      take(bytes.slice(0, at));
      take(bytes.slice(at));
      expect(heard).toEqual(['{"ä":1}', '{"b":2}']);
    }
    const broken: string[] = [];
    const take = lines(
      () => {
        broken.push("a line");
      },
      sentence => {
        broken.push(sentence);
      },
    );
    for (let i = 0; i < 40; i++) take(new Uint8Array(1 << 16).fill(65));
    expect(broken).toEqual(["A line of more than 1048576 characters does not end."]);
  });
});
