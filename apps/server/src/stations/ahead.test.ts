import { DRIVER_KINDS } from "@twincell/controllers";
import {
  emptyProgram,
  manualScheduler,
  pose,
  robotById,
  type CommandOutcome,
  type Pose,
  type Program,
} from "@twincell/core";
import { createClient, type Client, type Request, type ConnectionEvent, type EventOf } from "@twincell/protocol";
import { afterEach, describe, expect, test } from "vitest";
import { stationHost } from "./host.ts";

const ROBOTS: Readonly<Record<string, string>> = {
  ur: "ur10e",
  yaskawa: "yaskawa_gp8",
  kuka: "kuka_kr6r900sixx",
  fanuc: "fanuc_lrmate200id",
  abb: "abb_irb120",
};
const brands = DRIVER_KINDS.map(({ id }) => id).filter(id => id in ROBOTS);
const DEGREE_RAD = Math.PI / 180;
const hosts: { close(): void }[] = [];
afterEach(() => {
  for (const host of hosts.splice(0)) host.close();
});

const through = (robotId: string, configurations: readonly (readonly number[])[], ratio = 0.15): Program => ({
  ...emptyProgram(robotId, "Through"),
  steps: configurations.map((q, i) => ({
    id: `p${i}`,
    type: "move",
    path: "ptp",
    target: { q: [...q] },
    speed: { ratio },
    blend_m: 0,
  })),
});

async function bench(...of: readonly (readonly [brand: string, stand: Pose<"world", "base">])[]) {
  const scheduler = manualScheduler();
  const host = stationHost(scheduler, "test");
  const told: { readonly at_s: number; readonly message: ConnectionEvent }[] = [];
  const early: string[] = [];
  hosts.push(host);
  let hear = (text: string): void => {
    early.push(text);
  };
  const commander = host.join("you", {
    send: text => {
      hear(text);
    },
    close() {
      /* Ends with the test. */
    },
  });
  const client: Client = createClient(
    {
      send: text => {
        commander.hear(text);
      },
      close() {
        /* As above. */
      },
    },
    () => scheduler.now_s(),
    message => {
      told.push({ at_s: scheduler.now_s(), message });
    },
  );
  ({ hear } = client);
  for (const text of early) hear(text);
  const ids = of.map(([brand]) => brand);
  const pass = async (seconds: number): Promise<void> => {
    for (let t = 0; t < seconds; t += 0.02) {
      for (const id of ids) client.alive(id);
      await scheduler.elapse(0.02);
    }
  };
  async function answered(asking: Promise<CommandOutcome>, most_s = 60): Promise<CommandOutcome> {
    let outcome: CommandOutcome | undefined;
    void asking.then(value => {
      outcome = value;
    });
    for (let t = 0; t < most_s && !outcome; t += 0.02) await pass(0.02);
    if (!outcome) throw new Error(`No answer within ${most_s} s.`);
    return outcome;
  }
  const ask = (request: Request) => answered(client.ask(request));
  for (const [brand, stand] of of) {
    expect(await ask({ type: "open", station: brand, brand, robot: ROBOTS[brand]!, stand })).toEqual({ kind: "done" });
    await ask({ type: "take", station: brand });
    expect(await ask({ type: "connect", station: brand })).toEqual({ kind: "done" });
  }
  await pass(0.5);
  const heard = <Type extends ConnectionEvent["type"]>(type: Type) =>
    told.filter((each): each is { at_s: number; message: EventOf<Type> } => each.message.type === type);
  return { scheduler, client, ask, answered, pass, told, heard };
}

describe.each(brands)("T-63 ahead of a %s", brand => {
  test.each([
    ["at full override", 100],
    ["at half override", 50],
  ])(
    "the ghost is where the robot is seen that much later, %s",
    async (_, percent) => {
      const { ask, client, answered, heard } = await bench([brand, pose()]);
      const { home_rad } = robotById(ROBOTS[brand]!)!;
      const there = home_rad.map((q, k) => (k === 0 ? q + 0.8 : q));
      expect(await ask({ type: "look-ahead", station: brand, seconds: 1 })).toEqual({ kind: "done" });
      const slowed = await ask({ type: "speed", station: brand, percent });
      // A Yaskawa runs its jobs at full override alone, and says so.
      const asText = brand !== "yaskawa" || percent === 100;
      expect(slowed).toEqual({ kind: "done" });
      expect(
        await answered(
          client.ask({
            type: "run",
            station: brand,
            program: through(ROBOTS[brand]!, [there, home_rad, there]),
            asText,
          }),
        ),
      ).toEqual({ kind: "done" });
      const samples = heard("sample");
      const ghosts = heard("ahead").filter(({ message }) => message.ahead !== null && message.ahead.in_s > 0.99);
      expect(ghosts.length).toBeGreaterThan(20);
      // As near as controllers keep to a plan that is not theirs: most of the time it is there within 0.6 s of the time
      // said: a controller that takes one motion after the other rests between them.
      const far = ghosts
        .map(({ at_s, message: { ahead } }) =>
          Math.min(
            ...samples
              .filter(each => Math.abs(each.at_s - at_s - ahead!.in_s) < 0.6)
              .map(({ message }) => Math.max(...message.q_rad.map((q, i) => Math.abs(q - ahead!.q_rad[i]!)))),
          ),
        )
        .sort((x, y) => x - y);
      expect(far[Math.floor(0.9 * far.length)]!).toBeLessThan(3 * DEGREE_RAD);
      // It ends with the motion.
      expect(heard("ahead").at(-1)!.message.ahead).toBe(null);
    },
    60_000,
  );
});

/** A KUKA that reaches between them, or holds aside. */
const REACHES = [0, -0.6, 1.2, 0, 0.6, 0];
const ASIDE = [2.6, -0.6, 1.2, 0, 0.6, 0];
const facing: Pose<"world", "base"> = { ...pose([1.3, 0, 0]), quaternion: [0, 0, 1, 0] };
const farther: Pose<"world", "base"> = { ...facing, position: [1.5, 0, 0] };
const U_ASIDE = [1.57, -0.6, 0.9, -0.3, 1.57, 0];
const U_BEYOND = [-1.57, -0.6, 0.9, -0.3, 1.57, 0];

describe("a way that is not free", () => {
  test("T-63 a program through a robot that stands there is not sent, with names, distance and time; previewed it says the same, and nothing moves", async () => {
    const { ask, heard, pass } = await bench(["ur", pose()], ["kuka", facing]);
    expect(await ask({ type: "move", station: "ur", q_rad: U_ASIDE })).toEqual({ kind: "done" });
    expect(await ask({ type: "move", station: "kuka", q_rad: REACHES })).toEqual({ kind: "done" });
    await pass(0.3);
    const before = heard("sample")
      .filter(({ message }) => message.station === "ur")
      .at(-1)!.message.q_rad;
    const program = through("ur10e", [U_BEYOND]);
    const why = {
      code: "ahead.robot",
      sentence: expect.stringMatching(
        /^After \d+\.\d s: .*UR10e comes within \d+ mm of .*KR 6.*; 50 mm are kept\.$/,
      ) as string,
    };
    expect(await ask({ type: "preview", station: "ur", program })).toMatchObject({ kind: "refused", why });
    for (const asText of [true, false])
      expect(await ask({ type: "run", station: "ur", program, asText })).toMatchObject({ kind: "refused", why });
    await pass(1);
    expect(
      heard("sample")
        .filter(({ message }) => message.station === "ur")
        .at(-1)!.message.q_rad,
    ).toEqual(before);
    // The ghost of the preview went where the robot did not.
    expect(
      Math.max(...heard("ahead").map(({ message }) => Math.abs((message.ahead?.q_rad[0] ?? before[0]!) - before[0]!))),
    ).toBeGreaterThan(0.3);
  }, 60_000);

  test("T-63 one that comes into the way is told ahead of time, with the time to come falling, and the robot is stopped before it is there", async () => {
    const { ask, client, answered, heard, pass } = await bench(["ur", pose()], ["kuka", farther]);
    await ask({ type: "look-ahead", station: "ur", seconds: 10 });
    expect(await ask({ type: "move", station: "ur", q_rad: U_ASIDE })).toEqual({ kind: "done" });
    expect(await ask({ type: "move", station: "kuka", q_rad: ASIDE })).toEqual({ kind: "done" });
    const running = client.ask({
      type: "run",
      station: "ur",
      program: through("ur10e", [U_BEYOND], 0.08),
      asText: true,
    });
    await pass(1);
    expect(heard("ahead").at(-1)!.message.ahead!.problem).toBe(null);
    expect(await ask({ type: "move", station: "kuka", q_rad: REACHES })).toEqual({ kind: "done" });
    expect(await answered(running)).toMatchObject({ kind: "stopped", why: { code: "cell.near" } });
    const times = heard("ahead").flatMap(({ message }) =>
      message.ahead?.problem?.code === "ahead.robot" ? [message.ahead.problem.in_s] : [],
    );
    expect(times[0]!).toBeGreaterThan(1);
    expect(times.at(-1)!).toBeLessThan(0.6);
  }, 60_000);

  test("T-15 T-63 a limit on the way is told before anything is sent", async () => {
    const { ask, heard } = await bench(["ur", pose()]);
    const far = robotById("ur10e")!.home_rad.map((q, k) => (k === 2 ? 3.5 : q));
    const outcome = await ask({ type: "run", station: "ur", program: through("ur10e", [far]), asText: true });
    expect(outcome).toMatchObject({ kind: "refused" });
    expect(heard("sample").some(({ message }) => message.moving)).toBe(false);
  }, 60_000);
});

test("T-63 two that start together and would meet: the later one yields, and both are stopped with their names before they touch", async () => {
  const { client, answered, heard } = await bench(
    ["ur", pose([0, 1.6, 0])],
    ["kuka", { ...pose([1.4, 1.6, 0]), quaternion: [0, 0, 1, 0] }],
  );
  const to = (id: string, y: number) =>
    ({
      id,
      type: "move",
      path: "ptp",
      speed: { ratio: 0.3 },
      blend_m: 0,
      target: {
        pose: { position: [0.65, y, 0.4], quaternion: [0, 1, 0, 0] } as unknown as Pose<"frame", "tcp">,
        frame: "world",
        tool: "flange",
      },
    }) as const;
  const program = (brand: string): Program => ({
    ...emptyProgram(ROBOTS[brand]!, "To and fro"),
    steps: Array.from({ length: 16 }, (_, i) => to(`p${i}`, i % 2 ? 0.12 : -0.12)),
  });
  const outcome = await answered(
    client.ask({
      type: "together",
      members: ["ur", "kuka"].map(station => ({ station, program: program(station), asText: true })),
    }),
  );
  expect(outcome).toMatchObject({
    kind: "stopped",
    why: { sentence: expect.stringMatching(/would have come within \d+ mm of .* (50|100) mm are kept/) as string },
  });
  expect(
    heard("ended")
      .at(-1)!
      .message.stations.map(each => each.outcome.kind),
  ).toEqual(["stopped", "stopped"]);
}, 60_000);
