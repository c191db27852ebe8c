/** Programs that run cycle after cycle on virtual controllers of three makers, in virtual time. */
import { emptyProgram, manualScheduler, robotById, type CommandOutcome, type Program } from "@twincell/core";
import { createClient, type Client, type ConnectionEvent, type EventOf, type Request } from "@twincell/protocol";
import { afterEach, describe, expect, test } from "vitest";
import { stationHost } from "./host.ts";

const ROBOTS: Readonly<Record<string, string>> = { ur: "ur10e", yaskawa: "yaskawa_gp8", kuka: "kuka_kr6r900sixx" };
const DONE = { kind: "done" };
const TENTH_OF_MILLIDEGREE_RAD = (0.001 * Math.PI) / 180;
const hosts: { close(): void }[] = [];
afterEach(() => {
  for (const host of hosts.splice(0)) host.close();
});

async function bench(brand: string) {
  const scheduler = manualScheduler();
  const host = stationHost(scheduler, "test");
  hosts.push(host);
  const told: ConnectionEvent[] = [];
  const join = (who: string): Client => {
    const early: string[] = [];
    let client: Client | null = null;
    const place = host.join(who, {
      send(text) {
        if (client) client.hear(text);
        else early.push(text);
      },
      close: () => undefined,
    });
    client = createClient({ send: place.hear, close: () => undefined }, scheduler.now_s, message => {
      if (who === "you") told.push(message);
    });
    for (const text of early) client.hear(text);
    return client;
  };
  const you = join("you");
  const robot = robotById(ROBOTS[brand]!)!;
  /** Lets time pass, with signs of life from whoever commands, until that is so. */
  async function until(so: () => boolean, alive: Client = you): Promise<void> {
    for (let at_s = 0; !so(); at_s += 0.02) {
      if (at_s > 90) throw new Error("It never came about.");
      alive.alive("s");
      await scheduler.elapse(0.02);
    }
  }
  async function ask(request: Request, client = you): Promise<CommandOutcome> {
    let outcome: CommandOutcome | undefined;
    void client.ask(request).then(value => (outcome = value));
    await until(() => outcome !== undefined, client);
    return outcome!;
  }
  const begin = (request: Request): { outcome: CommandOutcome | undefined } => {
    const going: { outcome: CommandOutcome | undefined } = { outcome: undefined };
    void you.ask(request).then(value => (going.outcome = value));
    return going;
  };
  expect(await ask({ type: "open", station: "s", brand, robot: robot.id })).toEqual(DONE);
  expect(await ask({ type: "take", station: "s" })).toEqual(DONE);
  expect(await ask({ type: "connect", station: "s" })).toEqual(DONE);
  await until(() => told.some(({ type }) => type === "sample"));
  // Arms that are upright at home lean forward, clear of themselves.
  const at = (first: number, second = 0): number[] =>
    robot.home_rad.map((q, i) => (i === 0 ? q + first : i === 1 ? q + second : q));
  const program = (name: string, turns: readonly number[]): Program => ({
    ...emptyProgram(robot.id, name),
    steps: turns.map((turn, i) => ({
      id: `${name}${i}`,
      type: "move" as const,
      path: "ptp" as const,
      speed: { ratio: 0.4 },
      blend_m: 0,
      target: { q: at(turn) },
    })),
  });
  const samples = (): EventOf<"sample">[] => told.filter(message => message.type === "sample");
  const states = (): EventOf<"production">[] => told.filter(message => message.type === "production");
  const last = (): EventOf<"sample"> => told.findLast(message => message.type === "sample")!;
  const produce = (made: Program, more: Partial<Extract<Request, { type: "produce" }>> = {}): Request => ({
    type: "produce",
    station: "s",
    program: made,
    asText: false,
    cycles: 3,
    breakpoints: [],
    stepping: false,
    ...more,
  });
  const off_rad = (q_rad: readonly number[]): number =>
    Math.max(...q_rad.map((q, i) => Math.abs(q - last().q_rad[i]!)));
  return { scheduler, told, join, ask, begin, until, at, program, samples, states, last, produce, off_rad };
}

describe.each(Object.keys(ROBOTS))("a production on a virtual controller of %s", brand => {
  test("T-53 a program that is changed while it runs takes over at the next cycle, within seconds and without a stop; one that is red is refused at once and the old one goes on", async () => {
    const { scheduler, ask, begin, until, at, program, samples, states, last, produce, off_rad } = await bench(brand);
    const going = begin(produce(program("old", [0.3, 0])));
    await until(() => last().step === "old0" && last().moving);
    const beyond = { ...program("red", [0.2]), steps: program("red", [99]).steps };
    expect(await ask({ type: "replace", station: "s", program: beyond, asText: false })).toMatchObject({
      kind: "refused",
      why: { code: expect.stringMatching(/./) as string },
    });
    const asked_s = scheduler.now_s();
    const before = samples().length;
    expect(await ask({ type: "replace", station: "s", program: program("new", [-0.4, 0.1]), asText: false })).toEqual(
      DONE,
    );
    const took_s = scheduler.now_s() - asked_s;
    expect(took_s).toBeLessThan(10);
    await until(() => going.outcome !== undefined);
    expect(going.outcome).toEqual(DONE);
    const seen = samples().slice(before);
    expect(seen.every(({ safety }) => safety === "normal")).toBe(true);
    // The cycle that ran is finished with the old steps, and nothing of it comes after the first new step.
    const order = seen.map(({ step }) => step).filter((step, i, all) => step !== "" && step !== all[i - 1]);
    expect(order).toEqual(["old0", "old1", "new0", "new1", "new0", "new1"]);
    expect(states().map(({ cycle, program: name }) => `${cycle} ${name}`)).toContain("2 new");
    // Between the last motion of the old one and the first of the new one it stands for less than half a second.
    const end = seen.findLastIndex(({ step, moving }) => step === "old1" && moving);
    const start = seen.findIndex(({ step, moving }) => step === "new0" && moving);
    expect(seen[start]!.time_s - seen[end]!.time_s).toBeLessThan(0.5);
    expect(off_rad(at(0.1))).toBeLessThan(TENTH_OF_MILLIDEGREE_RAD);
    expect(states().at(-1)).toMatchObject({ state: "ended", next: null });
  });

  test("X-56 an operator takes over in a run, moves by hand and hands back: the run goes on with the step it was in and ends where the program ends; nobody without the lease hands back, and a STOP ends it", async () => {
    const { ask, begin, until, at, program, states, last, produce, off_rad, join, told } = await bench(brand);
    const going = begin(produce(program("p", [0.5, -0.2, 0.2]), { cycles: 1 }));
    await until(() => last().step === "p1" && last().moving);
    const operator = join("operator");
    expect(await ask({ type: "intervene", station: "s" }, operator)).toEqual(DONE);
    await until(() => states().at(-1)?.state === "held" && !last().moving);
    expect(states().at(-1)).toMatchObject({ state: "held", step: "p1", cycle: 1 });
    expect(await ask({ type: "resume", station: "s", from: "step" }, operator)).toMatchObject({
      kind: "refused",
      why: { code: "guard.no-lease", sentence: expect.stringContaining("commanded by you") as string },
    });
    // The one who commanded gives the robot away; the run is kept, and belongs to whoever has the lease.
    expect(await ask({ type: "release", station: "s" })).toEqual(DONE);
    expect(await ask({ type: "take", station: "s" }, operator)).toEqual(DONE);
    expect(await ask({ type: "move", station: "s", q_rad: at(0.35, 0.1) }, operator)).toEqual(DONE);
    expect(off_rad(at(0.35, 0.1))).toBeLessThan(TENTH_OF_MILLIDEGREE_RAD);
    expect(going.outcome).toBeUndefined();
    const before = told.length;
    expect(await ask({ type: "resume", station: "s", from: "step" }, operator)).toEqual(DONE);
    await until(() => going.outcome !== undefined, operator);
    expect(going.outcome).toEqual(DONE);
    expect(off_rad(at(0.2))).toBeLessThan(TENTH_OF_MILLIDEGREE_RAD);
    const steps = told
      .slice(before)
      .flatMap(message => (message.type === "sample" && message.step ? [message.step] : []));
    expect(steps.filter((step, i) => step !== steps[i - 1])).toEqual(["p1", "p2"]);
    // Who did what is told to everybody, recorders among them.
    const acts = told.flatMap(message => (message.type === "act" ? [`${message.who}: ${message.action}`] : []));
    expect(acts).toContain("operator: holds the production to take over by hand");
    expect(acts).toContain("operator: hands back to the production");
  });

  test("X-56 a motion by hand is ended by holding once more: the robot stands, the place is kept and the run goes on from it", async () => {
    const { ask, begin, until, at, program, states, last, produce, off_rad } = await bench(brand);
    const going = begin(produce(program("p", [0.5, 0.2]), { cycles: 1 }));
    await until(() => last().moving);
    expect(await ask({ type: "intervene", station: "s" })).toEqual(DONE);
    await until(() => states().at(-1)?.state === "held" && !last().moving);
    const byHand = begin({ type: "move", station: "s", q_rad: at(-0.6) });
    await until(() => last().moving);
    expect(await ask({ type: "intervene", station: "s" })).toEqual(DONE);
    await until(() => byHand.outcome !== undefined && !last().moving);
    expect(byHand.outcome).toMatchObject({ kind: "stopped" });
    expect(off_rad(at(-0.6))).toBeGreaterThan(0.05);
    expect(states().at(-1)).toMatchObject({ state: "held", cycle: 1 });
    expect(await ask({ type: "resume", station: "s", from: "step" })).toEqual(DONE);
    await until(() => going.outcome !== undefined);
    expect(going.outcome).toEqual(DONE);
    expect(off_rad(at(0.2))).toBeLessThan(TENTH_OF_MILLIDEGREE_RAD);
  });

  test("a held production is over after a STOP: nothing resumes it", async () => {
    const { ask, begin, until, program, states, last, produce, join } = await bench(brand);
    const going = begin(produce(program("p", [0.5, 0]), { cycles: null }));
    await until(() => last().moving);
    expect(await ask({ type: "intervene", station: "s" })).toEqual(DONE);
    await until(() => states().at(-1)?.state === "held");
    join("somebody").stop("s");
    await until(() => going.outcome !== undefined);
    expect(going.outcome).toMatchObject({ kind: "stopped", why: { code: "production.stopped" } });
    expect(await ask({ type: "resume", station: "s", from: "step" })).toMatchObject({
      kind: "refused",
      why: { code: "production.none" },
    });
  });

  test("breakpoints hold it before a step, single steps do one each, and it goes on to its end", async () => {
    const { ask, begin, until, at, program, states, last, produce, off_rad } = await bench(brand);
    const going = begin(produce(program("p", [0.1, 0.2, 0.3, 0.4]), { cycles: 1, breakpoints: ["p1"] }));
    const held = (step: string): Promise<void> =>
      until(() => states().at(-1)?.state === "held" && states().at(-1)?.step === step && !last().moving);
    await held("p1");
    expect(off_rad(at(0.1))).toBeLessThan(TENTH_OF_MILLIDEGREE_RAD);
    expect(await ask({ type: "single-step", station: "s" })).toEqual(DONE);
    await held("p2");
    expect(off_rad(at(0.2))).toBeLessThan(TENTH_OF_MILLIDEGREE_RAD);
    expect(await ask({ type: "breakpoints", station: "s", steps: ["p3"] })).toEqual(DONE);
    expect(await ask({ type: "resume", station: "s", from: "step" })).toEqual(DONE);
    await held("p3");
    expect(await ask({ type: "resume", station: "s", from: "step" })).toEqual(DONE);
    await until(() => going.outcome !== undefined);
    expect(going.outcome).toEqual(DONE);
    expect(off_rad(at(0.4))).toBeLessThan(TENTH_OF_MILLIDEGREE_RAD);
  });
});

test("a production is not cut where its place is not known: in the middle of a loop, in text of the controller, where it computes; a cycle from its beginning is", async () => {
  const { ask, begin, until, program, states, last, produce } = await bench("ur");
  const [first, second] = program("p", [0.3, 0]).steps;
  const loop: Program = {
    ...program("loop", [0]),
    steps: [{ id: "loop", type: "repeat", times: 3, steps: [first!, second!] }],
  };
  const going = begin(produce(loop, { cycles: 1 }));
  await until(() => last().step === "p1" && last().moving);
  expect(await ask({ type: "intervene", station: "s" })).toEqual(DONE);
  await until(() => states().at(-1)?.state === "held");
  expect(await ask({ type: "resume", station: "s", from: "step" })).toMatchObject({
    kind: "refused",
    why: { code: "production.block" },
  });
  expect(await ask({ type: "resume", station: "s", from: "cycle" })).toEqual(DONE);
  await until(() => going.outcome !== undefined);
  expect(going.outcome).toEqual(DONE);
  expect(await ask(produce(program("p", [0.1]), { asText: true, breakpoints: ["p0"] }))).toMatchObject({
    kind: "refused",
    why: { code: "production.text" },
  });
});
