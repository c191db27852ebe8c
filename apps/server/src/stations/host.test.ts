import {
  checkProgram,
  emptyProgram,
  linkSolids,
  manualScheduler,
  ownRobotFile,
  parseRobot,
  pose,
  robotById,
  type CommandOutcome,
  type ManualScheduler,
  type MoveStep,
  type Pose,
  type Program,
} from "@twincell/core";
import { DRIVER_KINDS } from "@twincell/controllers";
import { createClient, write, type Client, type Request, type ConnectionEvent, type EventOf } from "@twincell/protocol";
import { cellGeometry, edgeTraceCell, emptyCell } from "@twincell/project";
import { afterEach, describe, expect, test } from "vitest";
import { stationHost } from "./host.ts";

const ROBOTS: Readonly<Record<string, string>> = { ur: "ur10e", yaskawa: "yaskawa_gp8", kuka: "kuka_kr6r900sixx" };
const brands = DRIVER_KINDS.filter(({ id }) => id in ROBOTS).map(({ id }) => id);
const to = (id: string, y: number): MoveStep => ({
  id,
  type: "move",
  path: "ptp",
  speed: { ratio: 0.3 },
  blend_m: 0,
  target: {
    pose: { position: [0.42, y, 0.4], quaternion: [0, 1, 0, 0] } as unknown as Pose<"frame", "tcp">,
    frame: "world",
    tool: "flange",
  },
});
const program = (robot: string): Program => ({
  ...emptyProgram(robot, "To and fro"),
  steps: [to("a", -0.1), to("b", 0.1), to("c", -0.1)],
});

const hosts: { close(): void }[] = [];
afterEach(() => {
  for (const host of hosts.splice(0)) host.close();
});

function bench() {
  const scheduler = manualScheduler();
  const host = stationHost(scheduler, "test");
  const told: ConnectionEvent[] = [];
  hosts.push(host);
  const join = (who: string): { client: Client; leave: () => void; hear: (text: string) => void } => {
    const lines: string[] = [];
    const client = createClient(
      {
        send: text => {
          commander.hear(text);
        },
        close() {
          /* Ends with the test. */
        },
      },
      () => scheduler.now_s(),
      message => {
        told.push(message);
      },
    );
    let client2: Client | null = client;
    const commander = host.join(who, {
      send: text => {
        if (client2) client2.hear(text);
        else lines.push(text);
      },
      close() {
        client2 = null;
        client.gone();
      },
    });
    return {
      client,
      leave: () => {
        client2 = null;
        commander.leave();
      },
      hear: commander.hear,
    };
  };
  const samples = (station: string): EventOf<"sample">[] =>
    told.filter((message): message is EventOf<"sample"> => message.type === "sample" && message.station === station);
  return { scheduler, host, told, join, samples };
}
/** Lets time pass, with signs of life from who commands, until the answer is there. */
async function answered(
  scheduler: ManualScheduler,
  client: Client,
  station: string,
  asking: Promise<CommandOutcome>,
  most_s = 60,
): Promise<CommandOutcome> {
  let outcome: CommandOutcome | undefined;
  void asking.then(value => {
    outcome = value;
  });
  for (let at_s = 0; at_s < most_s && !outcome; at_s += 0.02) {
    client.alive(station);
    await scheduler.elapse(0.02);
  }
  if (!outcome) throw new Error(`No answer within ${most_s} s.`);
  return outcome;
}
async function connected(brand: string) {
  const { scheduler, join, ...rest } = bench();
  const { client, ...ends } = join("you");
  const robot = ROBOTS[brand]!;
  const ask = (request: Request) => answered(scheduler, client, "s", client.ask(request));
  expect(await ask({ type: "open", station: "s", brand, robot })).toEqual({ kind: "done" });
  expect(await ask({ type: "take", station: "s" })).toEqual({ kind: "done" });
  expect(await ask({ type: "connect", station: "s" })).toEqual({ kind: "done" });
  for (let i = 0; i < 15; i++) {
    client.alive("s");
    await scheduler.elapse(0.02);
  }
  return { scheduler, client, ask, robot, join, ...ends, ...rest };
}

describe.each(brands)("a station of %s", brand => {
  test("T-24 runs a program as text of its own language, on its plan all the way", async () => {
    const { ask, robot, samples, told } = await connected(brand);
    expect(await ask({ type: "run", station: "s", program: program(robot), asText: true })).toEqual({ kind: "done" });
    const seen = samples("s");
    const far = seen.map(({ plan_rad }) => plan_rad ?? 0);
    expect(seen.some(({ moving }) => moving)).toBe(true);
    expect(Math.max(...far)).toBeLessThan(Math.PI / 180);
    // Opened without a cell: that is said, and nothing else.
    expect(told.flatMap(message => (message.type === "notice" ? [message.why.code] : []))).toEqual(["station.no-cell"]);
  }, 60_000);

  test("X-41 the plug is pulled: stopped within 100 ms of silence, and no motion after it before a person says so", async () => {
    const { scheduler, client, ask, samples, told } = await connected(brand);
    const moving = client.ask({ type: "zero", station: "s" });
    for (let i = 0; i < 20; i++) {
      client.alive("s");
      await scheduler.elapse(0.02);
    }
    expect(samples("s").at(-1)?.moving).toBe(true);
    void client.ask({ type: "plug", station: "s", pulled: true });
    const outcome = await answered(scheduler, client, "s", moving, 1);
    expect(outcome.kind).toBe("stopped");
    expect(told.some(message => message.type === "link" && message.state === "lost")).toBe(true);
    await ask({ type: "plug", station: "s", pulled: false });
    for (let i = 0; i < 400; i++) {
      client.alive("s");
      await scheduler.elapse(0.02);
    }
    expect(told.findLast((message): message is EventOf<"link"> => message.type === "link")?.state).toBe("open");
    expect(samples("s").at(-1)?.moving).toBe(false);
    expect(await ask({ type: "zero", station: "s" })).toMatchObject({
      kind: "refused",
      why: { code: "guard.link-unconfirmed" },
    });
  }, 60_000);
});

describe("A the guard of a connected robot knows the objects of its cell", () => {
  const robot = robotById("staubli_rx90l")!;
  const cell = edgeTraceCell();
  const { worldFromBase } = cell.robot;
  /** Down through the table, as a program of joint targets. */
  const down: Program = {
    ...emptyProgram(robot.id, "Down"),
    steps: [
      {
        id: "a",
        type: "move",
        path: "ptp",
        speed: { ratio: 0.3 },
        blend_m: 0,
        target: { q: [0, 0.5, 2.1, 0, 0.2, 0] },
      },
    ],
  };
  async function opened(given: unknown) {
    const { scheduler, join, samples, told } = bench();
    const { client } = join("you");
    const other = join("another").client;
    const ask = (request: Request, from = client) => answered(scheduler, client, "s", from.ask(request));
    const outcome = await ask({
      type: "open",
      station: "s",
      brand: "staubli-cs7",
      robot: robot.id,
      worldFromBase,
      ...(given === undefined ? {} : { cell: given }),
    });
    return { ask, samples, told, outcome, other };
  }
  async function ready(given: unknown) {
    const { ask, outcome, ...rest } = await opened(given);
    expect(outcome).toEqual({ kind: "done" });
    expect(await ask({ type: "take", station: "s" })).toEqual({ kind: "done" });
    expect(await ask({ type: "connect", station: "s" })).toEqual({ kind: "done" });
    return { ask, ...rest };
  }

  test("T-45 T-68 the table that the check speaks of keeps the program from the robot, the cell given when it is opened or later", async () => {
    const { verdict } = checkProgram(down, robot, { cell: cellGeometry(cell, linkSolids(robot)) });
    expect(verdict.steps.flatMap(({ findings }) => findings).map(({ code }) => code)).toContain("collision.contact");
    const { ask, samples, other } = await ready(cell);
    const run: Request = { type: "run", station: "s", program: down, asText: false };
    expect(await ask(run)).toMatchObject({ kind: "refused", why: { code: "collision.contact" } });
    const table = cell.objects;
    // Who has not the lease takes nothing out of the cell.
    expect(await ask({ type: "cell", station: "s", cell: { ...cell, objects: [] } }, other)).toMatchObject({
      kind: "refused",
      why: { code: "guard.lease-taken" },
    });
    expect(await ask({ type: "cell", station: "s", cell: { ...cell, objects: [], frames: [] } })).toEqual({
      kind: "done",
    });
    expect(await ask({ type: "cell", station: "s", cell: { ...cell, objects: table } })).toEqual({ kind: "done" });
    expect(await ask(run)).toMatchObject({ kind: "refused", why: { code: "collision.contact" } });
    for (const { q_rad } of samples("s")) expect(q_rad[1]).toBeCloseTo(robot.home_rad[1]!, 3);
  }, 60_000);

  test("T-64 what is told of a guard says whether a cell is known to it and what is kept, from the opening on and when the cell changes", async () => {
    const { ask, told } = await ready(undefined);
    const guard = () => told.findLast((message): message is EventOf<"guard"> => message.type === "guard")!;
    expect(guard()).toMatchObject({ cell: false });
    expect(told.find(({ type }) => type === "notice")).toMatchObject({ why: { code: "station.no-cell" } });
    const measured = { ...cell, errors: { registration_m: 0.003, twin_m: 0.002 } };
    expect(await ask({ type: "cell", station: "s", cell: measured })).toEqual({ kind: "done" });
    expect(guard().cell).toBe(true);
    expect(guard().kept_m).toBeCloseTo(robot.shapeError_m + 0.005, 12);
  }, 60_000);

  test("a cell that cannot be read is refused with the place, and the one before counts on", async () => {
    expect((await opened({ ...cell, version: 99 })).outcome).toMatchObject({
      kind: "refused",
      why: { code: "station.cell", sentence: expect.stringContaining("99") as string },
    });
    const { ask } = await ready(cell);
    expect(await ask({ type: "cell", station: "s", cell: { ...cell, objects: 5 } })).toMatchObject({
      kind: "refused",
      why: { code: "station.cell", sentence: expect.stringContaining("objects") as string },
    });
    expect(await ask({ type: "run", station: "s", program: down, asText: false })).toMatchObject({
      kind: "refused",
      why: { code: "collision.contact" },
    });
  }, 60_000);
});

describe.each([
  ["kuka-rsi", "kuka_kr6r900sixx"],
  ["abb-egm", "abb_irb120"],
])("the other way %s to a controller", (brand, robotId) => {
  test("T-20 T-23 is offered by the host, connects, moves to joint angles, runs steps, and stops", async () => {
    const { scheduler, join, told, samples } = bench();
    const { client } = join("you");
    const robot = robotById(robotId)!;
    const ask = (request: Request) => answered(scheduler, client, "s", client.ask(request));
    const hello = told.find((message): message is EventOf<"hello"> => message.type === "hello")!;
    expect(hello.brands.map(({ id }) => id)).toContain(brand);
    expect(await ask({ type: "open", station: "s", brand, robot: robotId })).toEqual({ kind: "done" });
    expect(await ask({ type: "take", station: "s" })).toEqual({ kind: "done" });
    expect(await ask({ type: "connect", station: "s" })).toEqual({ kind: "done" });
    for (let i = 0; i < 15; i++) {
      client.alive("s");
      await scheduler.elapse(0.02);
    }
    const there = robot.home_rad.map((q, i) => (i === 0 ? q + 0.2 : q));
    expect(await ask({ type: "move", station: "s", q_rad: there })).toEqual({ kind: "done" });
    expect(samples("s").at(-1)!.q_rad[0]).toBeCloseTo(there[0]!, 3);
    expect(await ask({ type: "run", station: "s", program: program(robotId), asText: brand === "kuka-rsi" })).toEqual({
      kind: "done",
    });
    const moving = client.ask({ type: "zero", station: "s" });
    for (let i = 0; i < 10; i++) {
      client.alive("s");
      await scheduler.elapse(0.02);
    }
    client.stop("s");
    expect(await answered(scheduler, client, "s", moving)).toMatchObject({ kind: "stopped" });
  }, 60_000);
});

const EVERY_ROBOT: Readonly<Record<string, string>> = {
  ...ROBOTS,
  fanuc: "fanuc_lrmate200id",
  abb: "abb_irb120",
  staubli: "staubli_rx160",
};
const watchable = DRIVER_KINDS.filter(
  ({ id, cannot }) => id in EVERY_ROBOT && !cannot.some(({ row }) => row === "watch"),
).map(({ id }) => id);

describe.each(watchable)("a station of %s that was opened to watch", brand => {
  test("T-24 T-26 follows the pendant, refuses every command with one sentence, stops all the same, and stays so when the link comes back", async () => {
    const { scheduler, join, samples, told } = bench();
    const { client } = join("you");
    const robot = EVERY_ROBOT[brand]!;
    const ask = (request: Request) => answered(scheduler, client, "s", client.ask(request));
    const pass = (seconds: number) =>
      answered(
        scheduler,
        client,
        "s",
        scheduler.elapse(seconds).then(() => ({ kind: "done" as const })),
      );
    const guard = () => told.findLast((message): message is EventOf<"guard"> => message.type === "guard")!;
    const refuses = async () => {
      const asked: Request[] = [
        { type: "take", station: "s" },
        { type: "release", station: "s" },
        { type: "confirm", station: "s" },
        { type: "reset", station: "s" },
        { type: "hold", station: "s", pressed: true },
        { type: "speed", station: "s", percent: 50 },
        { type: "move", station: "s", q_rad: [0, 0, 0, 0, 0, 0] },
        { type: "zero", station: "s" },
        { type: "run", station: "s", program: program(robot), asText: true },
        { type: "run", station: "s", program: program(robot), asText: false },
      ];
      for (const request of asked)
        expect(await ask(request), request.type).toMatchObject({
          kind: "refused",
          why: { code: "guard.watching", hint: expect.stringContaining("Take control") as string },
        });
    };
    expect(await ask({ type: "open", station: "s", brand, robot, watch: true })).toEqual({ kind: "done" });
    expect(await ask({ type: "connect", station: "s" })).toEqual({ kind: "done" });
    await pass(0.4);
    await refuses();
    expect(samples("s").some(({ moving }) => moving)).toBe(false);

    // Somebody at the robot jogs it, and it is followed.
    await ask({ type: "pendant", station: "s", act: { do: "mode", mode: "manual" } });
    await pass(1);
    await ask({ type: "pendant", station: "s", act: { do: "enable", pressed: true } });
    await pass(1);
    const from = samples("s").at(-1)!.q_rad;
    const jogged = client.ask({ type: "pendant", station: "s", act: { do: "jog", joint: 1, direction: 1 } });
    await pass(1);
    await ask({ type: "pendant", station: "s", act: { do: "jog", joint: 1, direction: 0 } });
    expect(await jogged).toEqual({ kind: "done" });
    await ask({ type: "pendant", station: "s", act: { do: "enable", pressed: false } });
    await pass(0.3);
    expect(samples("s").at(-1)!.q_rad[0]! - from[0]!).toBeGreaterThan(0.05);
    await refuses();

    // The line breaks and is mended: it is watched as before, and nobody says that it was stopped.
    await ask({ type: "plug", station: "s", pulled: true });
    await pass(1);
    expect(guard()).toMatchObject({ link: "lost", watching: true });
    expect(
      told
        .filter(message => message.type === "notice")
        .map(({ why }) => why.sentence)
        .join(),
    ).toMatch(/^Nothing was heard of .* only watched and was not stopped/);
    await ask({ type: "plug", station: "s", pulled: false });
    await pass(12);
    expect(guard()).toMatchObject({ link: "up", watching: true });
    await refuses();

    // Taken to command it moves, after the pendant has given it back.
    await ask({ type: "pendant", station: "s", act: { do: "mode", mode: brand === "fanuc" ? "automatic" : "remote" } });
    await pass(1);
    expect(await ask({ type: "watch", station: "s", on: false })).toEqual({ kind: "done" });
    expect(await ask({ type: "take", station: "s" })).toEqual({ kind: "done" });
    expect(guard()).toMatchObject({ watching: false, holder: "you", link: "up" });
    await ask({ type: "reset", station: "s" });
    await pass(4);
    const moving = client.ask({ type: "move", station: "s", q_rad: from });
    expect(await answered(scheduler, client, "s", moving)).toEqual({ kind: "done" });
  }, 120_000);
});

test("T-26 who gives a robot up to be watched in the middle of a motion stops it first", async () => {
  const { scheduler, join, samples } = bench();
  const { client } = join("you");
  const ask = (request: Request) => answered(scheduler, client, "s", client.ask(request));
  await ask({ type: "open", station: "s", brand: "ur", robot: "ur10e" });
  await ask({ type: "take", station: "s" });
  await ask({ type: "connect", station: "s" });
  await answered(
    scheduler,
    client,
    "s",
    scheduler.elapse(0.3).then(() => ({ kind: "done" as const })),
  );
  const moving = client.ask({ type: "zero", station: "s" });
  for (let i = 0; i < 20; i++) {
    client.alive("s");
    await scheduler.elapse(0.02);
  }
  expect(samples("s").at(-1)!.moving).toBe(true);
  expect(await ask({ type: "watch", station: "s", on: true })).toEqual({ kind: "done" });
  expect(await answered(scheduler, client, "s", moving)).toMatchObject({ kind: "stopped" });
}, 60_000);

test.each(DRIVER_KINDS.filter(({ cannot }) => cannot.some(({ row }) => row === "watch")))(
  "$name cannot only be watched, and says why",
  async ({ id }) => {
    const { scheduler, join } = bench();
    const { client } = join("you");
    expect(
      await answered(
        scheduler,
        client,
        "s",
        client.ask({ type: "open", station: "s", brand: id, robot: EVERY_ROBOT[id]!, watch: true }),
      ),
    ).toMatchObject({ kind: "refused", why: { code: "station.no-watching" } });
  },
);

describe("a host of stations", () => {
  test("one commands, anyone stops, and who leaves gives the robot back", async () => {
    const { scheduler, client, join, leave, ask } = await connected(brands[0]!);
    const other = join("somebody");
    expect(await answered(scheduler, client, "s", other.client.ask({ type: "take", station: "s" }))).toMatchObject({
      kind: "refused",
      why: { code: "guard.lease-taken" },
    });
    const moving = client.ask({ type: "zero", station: "s" });
    for (let i = 0; i < 10; i++) {
      client.alive("s");
      await scheduler.elapse(0.02);
    }
    other.client.stop();
    expect(await answered(scheduler, client, "s", moving)).toMatchObject({ kind: "stopped" });
    expect(await ask({ type: "close", station: "nowhere" })).toMatchObject({
      kind: "refused",
      why: { code: "station.none" },
    });
    leave();
    expect(await answered(scheduler, other.client, "s", other.client.ask({ type: "take", station: "s" }))).toEqual({
      kind: "done",
    });
  }, 60_000);

  test("X-41 who commands falls silent, a tab that sleeps for instance: the robot is stopped within 100 ms", async () => {
    const { scheduler, client, told } = await connected(brands[0]!);
    void client.ask({ type: "zero", station: "s" });
    for (let i = 0; i < 10; i++) {
      client.alive("s");
      await scheduler.elapse(0.02);
    }
    const from_s = scheduler.now_s();
    told.length = 0;
    while (
      !told.some(message => message.type === "guard" && message.motion === "stopping") &&
      scheduler.now_s() - from_s < 1
    )
      await scheduler.elapse(0.005);
    expect(scheduler.now_s() - from_s).toBeLessThanOrEqual(0.105);
    expect(told.some(message => message.type === "notice")).toBe(true);
  }, 60_000);

  test("what cannot be read ends the connection with one sentence, and nothing else", () => {
    const { told, join, host } = bench();
    for (const text of [
      "",
      "{",
      "[]",
      '{"type":"open"}',
      '{"type":"run","id":1,"station":"s","program":{},"asText":1}',
      "\u0000".repeat(100),
      JSON.stringify({ type: "move", id: 1, station: "s", q_rad: [null] }),
    ]) {
      const { hear } = join("stranger");
      told.length = 0;
      hear(text);
      expect(told.map(({ type }) => type)).toEqual(["fault"]);
      hear(write({ type: "ping", sent_s: 1 }));
      expect(told.length).toBe(1);
    }
    expect(host.stations).toEqual([]);
  });

  test("T-16 a robot that is in no library comes with its cell: it is driven on a running server, and others are told its file", async () => {
    const { scheduler, told, join } = bench();
    const ur = robotById("ur10e")!;
    const file = ownRobotFile({ ...ur, id: "our_arm", name: "Our arm" });
    const cell = { ...emptyCell(file.id), robot: { id: file.id, worldFromBase: pose(), file } };
    const { client } = join("you");
    const asked = (request: Request) => answered(scheduler, client, "own", client.ask(request));
    const open: Request = { type: "open", station: "own", brand: "ur", robot: file.id };
    const unknown = await asked(open);
    expect(unknown.kind === "refused" && unknown.why.sentence).toContain(file.id);
    expect(await asked({ ...open, cell })).toEqual({ kind: "done" });
    expect(await asked({ type: "take", station: "own" })).toEqual({ kind: "done" });
    expect(await asked({ type: "connect", station: "own" })).toEqual({ kind: "done" });
    expect(await asked({ type: "run", station: "own", program: program(file.id), asText: true })).toEqual({
      kind: "done",
    });
    const opened = told.find(message => message.type === "opened");
    expect(parseRobot(opened?.robotFile)).toMatchObject({ kind: "robot", robot: { id: file.id, name: "Our arm" } });
  });

  test("a message over no line comes back in no time", async () => {
    const { join } = bench();
    const { client } = join("you");
    expect(await client.ping()).toBe(0);
  });

  test("T-61 a message over a line of 30 ms there and 20 ms back took 50 ms, whatever is sent in between", async () => {
    const scheduler = manualScheduler();
    const host = stationHost(scheduler, "test");
    hosts.push(host);
    const late = (after_s: number, deliver: (text: string) => void) => (text: string) => {
      const cancel = scheduler.every(after_s, () => {
        cancel();
        deliver(text);
      });
    };
    const client: Client = createClient(
      {
        send: late(0.03, text => {
          commander.hear(text);
        }),
        close: () => undefined,
      },
      () => scheduler.now_s(),
      () => undefined,
    );
    const commander = host.join("you", { send: late(0.02, client.hear), close: () => undefined });
    const first = client.ping();
    await scheduler.elapse(0.01);
    const second = client.ping();
    await scheduler.elapse(0.1);
    expect(await first).toBeCloseTo(0.05, 12);
    expect(await second).toBeCloseTo(0.05, 12);
  });
});
