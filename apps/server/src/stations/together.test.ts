import { DRIVER_KINDS, START_WITHIN_S } from "@twincell/controllers";
import { emptyProgram, manualScheduler, pose, robotById, type CommandOutcome, type Program } from "@twincell/core";
import { createClient, type Request, type ConnectionEvent, type EventOf } from "@twincell/protocol";
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
const pairs = brands.flatMap((a, i) => brands.slice(i).map(b => [a, b] as const));
const hosts: { close(): void }[] = [];
afterEach(() => {
  for (const host of hosts.splice(0)) host.close();
});

/** To and fro with joint 1, as often as wanted. */
function program(robotId: string, times = 1, by_rad = 0.4): Program {
  const { home_rad } = robotById(robotId)!;
  const to = (id: string, by: number) =>
    ({
      id,
      type: "move",
      path: "ptp",
      target: { q: home_rad.map((q, k) => (k === 0 ? q + by : q)) },
      speed: { ratio: 0.3 },
      blend_m: 0,
    }) as const;
  return {
    ...emptyProgram(robotId, "To and fro"),
    steps: Array.from({ length: times }, (_, i) => [to(`a${i}`, by_rad), to(`b${i}`, 0)]).flat(),
  };
}

async function bench(of: readonly string[]) {
  const scheduler = manualScheduler();
  const host = stationHost(scheduler, "test");
  const told: ConnectionEvent[] = [];
  hosts.push(host);
  const join = (who: string) => {
    const early: string[] = [];
    let hear = (text: string): void => {
      early.push(text);
    };
    const commander = host.join(who, {
      send: text => {
        hear(text);
      },
      close() {
        /* Ends with the test. */
      },
    });
    const client = createClient(
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
        if (who === "you") told.push(message);
      },
    );
    ({ hear } = client);
    for (const text of early) hear(text);
    return client;
  };
  const you = join("you");
  const ids = of.map((brand, i) => `${brand} ${i}`);
  const pass = async (seconds: number): Promise<void> => {
    for (let t = 0; t < seconds; t += 0.02) {
      for (const id of ids) you.alive(id);
      await scheduler.elapse(0.02);
    }
  };
  async function answered(asking: Promise<CommandOutcome>, most_s = 30): Promise<CommandOutcome> {
    let outcome: CommandOutcome | undefined;
    void asking.then(value => {
      outcome = value;
    });
    for (let t = 0; t < most_s && !outcome; t += 0.02) await pass(0.02);
    if (!outcome) throw new Error(`No answer within ${most_s} s.`);
    return outcome;
  }
  const ask = (request: Request) => answered(you.ask(request));
  for (const [i, brand] of of.entries()) {
    const station = ids[i]!;
    // Far apart: they do not meet.
    expect(await ask({ type: "open", station, brand, robot: ROBOTS[brand]!, stand: pose([0, 5 * i, 0]) })).toEqual({
      kind: "done",
    });
    expect(await ask({ type: "take", station })).toEqual({ kind: "done" });
    expect(await ask({ type: "connect", station })).toEqual({ kind: "done" });
  }
  await pass(0.5);
  // Each stands where its program ends.
  for (const [i, brand] of of.entries())
    expect(await ask({ type: "move", station: ids[i]!, q_rad: [...robotById(ROBOTS[brand]!)!.home_rad] })).toEqual({
      kind: "done",
    });
  const members = (times = 1) =>
    of.map((brand, i) => ({ station: ids[i]!, program: program(ROBOTS[brand]!, times), asText: true }));
  const moved = () =>
    told.filter((message): message is EventOf<"sample"> => message.type === "sample" && message.moving).length;
  const last = (station: string) =>
    told.findLast((message): message is EventOf<"sample"> => message.type === "sample" && message.station === station)!;
  told.length = 0;
  return { scheduler, host, you, join, ask, answered, pass, ids, members, told, moved, last };
}

describe.each(pairs)("started together: %s and %s", (a, b) => {
  test("T-24 both are ready before either moves, begin within the stated time on one clock, and end", async () => {
    const { ask, members, told, ids } = await bench([a, b]);
    expect(await ask({ type: "together", members: members() })).toEqual({ kind: "done" });
    const began = told.filter((message): message is EventOf<"began"> => message.type === "began");
    expect(began.map(({ stations }) => stations)).toEqual([ids]);
    expect(began[0]!.spread_s).toBeLessThanOrEqual(START_WITHIN_S);
    expect(
      told
        .findLast((message): message is EventOf<"ended"> => message.type === "ended")!
        .stations.map(({ outcome }) => outcome.kind),
    ).toEqual(["done", "done"]);
  }, 60_000);
});

describe("a group", () => {
  test("if one refuses nobody starts, and the refusal is told first", async () => {
    const { ask, members, moved, ids } = await bench(["ur", "kuka", "yaskawa"]);
    await ask({ type: "release", station: ids[1]! });
    expect(await ask({ type: "together", members: members() })).toMatchObject({
      kind: "refused",
      why: { code: "guard.no-lease" },
    });
    expect(moved()).toBe(0);
    await ask({ type: "take", station: ids[1]! });
    // What one cannot reach is refused before anything is handed over.
    const [first, ...others] = members();
    const far = {
      ...first!,
      program: {
        ...program(ROBOTS["ur"]!),
        steps: program(ROBOTS["ur"]!).steps.map(step => ({ ...step, target: { q: [99, 0, 0, 0, 0, 0] } })),
      },
    };
    expect((await ask({ type: "together", members: [far, ...others] })).kind).toBe("refused");
    expect(moved()).toBe(0);
    // And nothing is left behind: they start when all may.
    expect(await ask({ type: "together", members: members() })).toEqual({ kind: "done" });
  }, 60_000);

  test.each(["ur", "kuka", "yaskawa"])(
    "T-63 whoever stops one stops all: %s by somebody else",
    async stopped => {
      const { you, join, members, pass, answered, last, ids, told } = await bench(["ur", "kuka", "yaskawa"]);
      const running = you.ask({ type: "together", members: members(20) });
      await pass(1.5);
      expect(ids.map(id => last(id).moving)).toEqual([true, true, true]);
      join("somebody").stop(ids.find(id => id.startsWith(stopped))!);
      expect((await answered(running, 3)).kind).toBe("stopped");
      await pass(0.3);
      expect(ids.map(id => last(id).moving)).toEqual([false, false, false]);
      const ended = told.findLast((message): message is EventOf<"ended"> => message.type === "ended")!;
      expect(ended.stations.map(({ outcome }) => outcome.kind)).toEqual(["stopped", "stopped", "stopped"]);
      expect(
        ended.stations.filter(({ outcome }) => outcome.kind === "stopped" && outcome.why.code === "group.stopped")
          .length,
      ).toBe(2);
    },
    60_000,
  );

  test("one that fails in the start window stops the others: its plug is pulled just after the start", async () => {
    const { you, members, pass, answered, last, ids } = await bench(["ur", "kuka"]);
    const running = you.ask({ type: "together", members: members(20) });
    await pass(0.6);
    void you.ask({ type: "plug", station: ids[0]!, pulled: true });
    expect((await answered(running, 3)).kind).toBe("stopped");
    await pass(0.3);
    expect(last(ids[1]!).moving).toBe(false);
  }, 60_000);

  test("the same station twice, one that is not there, and one that is only watched are refused", async () => {
    const { ask, members, ids, moved } = await bench(["ur", "kuka"]);
    const [one, two] = members();
    expect(await ask({ type: "together", members: [one!, one!] })).toMatchObject({
      kind: "refused",
      why: { code: "group.twice" },
    });
    expect(await ask({ type: "together", members: [one!, { ...two!, station: "nowhere" }] })).toMatchObject({
      kind: "refused",
      why: { code: "station.none" },
    });
    await ask({ type: "watch", station: ids[1]!, on: true });
    expect(await ask({ type: "together", members: members() })).toMatchObject({
      kind: "refused",
      why: { code: "guard.watching" },
    });
    expect(moved()).toBe(0);
  }, 60_000);
});
