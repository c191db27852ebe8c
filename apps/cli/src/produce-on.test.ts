/** Programs that run cycle after cycle, steered by lines of a console, on a virtual controller in virtual time. */
import { writeFileSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { PassThrough } from "node:stream";
import { setImmediate as turn } from "node:timers/promises";
import { emptyProgram, manualScheduler, robotById, type CommandOutcome, type Program } from "@twincell/core";
import type { ConnectionInfo, EventOf, Request } from "@twincell/protocol";
import { joinHost, stationHost, type Told } from "@twincell/server";
import { afterAll, expect, test } from "vitest";
import { cyclesOf, PRODUCTION_OPTIONS, produceOn, stateLine } from "./commands/produce-on.ts";
import { given } from "./io/arguments.ts";
import { readProgram } from "./io/program.ts";

const folder = mkdtempSync(join(tmpdir(), "twincell-produce-"));
afterAll(() => {
  rmSync(folder, { recursive: true, force: true });
});
const robot = robotById("ur10e")!;
const DONE = { kind: "done" };
const at = (turn_rad: number): number[] => robot.home_rad.map((q, i) => (i === 0 ? q + turn_rad : q));
const programOf = (name: string, ...turns: readonly number[]): Program => ({
  ...emptyProgram(robot.id, name),
  steps: turns.map((by_rad, i) => ({
    id: `${name}${i}`,
    type: "move",
    path: "ptp",
    target: { q: at(by_rad) },
    speed: { ratio: 0.5 },
    blend_m: 0,
  })),
});

async function bench() {
  const scheduler = manualScheduler();
  const host = stationHost(scheduler, "test");
  const listeners = new Set<(message: Told) => void>();
  let info: ConnectionInfo | undefined;
  let last: EventOf<"sample"> | undefined;
  const hear = (message: Told): void => {
    if (message.type === "opened") info = message;
    if (message.type === "sample") last = message;
    for (const listen of listeners) listen(message);
  };
  const { client } = joinHost(host, "command line", hear);
  const other = joinHost(host, "operator", () => undefined).client;
  /** Lets time pass, with signs of life from both, until that is so. */
  async function until(so: () => boolean, what: string): Promise<void> {
    for (let at_s = 0; !so(); at_s += 0.02) {
      if (at_s > 90) throw new Error(`It never came about: ${what}`);
      for (const each of [client, other]) each.alive("s");
      await scheduler.elapse(0.02);
      await turn();
    }
  }
  async function ask(request: Request, by = client): Promise<CommandOutcome> {
    let outcome: CommandOutcome | undefined;
    void by.ask(request).then(value => (outcome = value));
    await until(() => outcome !== undefined, request.type);
    return outcome!;
  }
  for (const request of [
    { type: "open", station: "s", brand: "ur", robot: robot.id },
    { type: "take", station: "s" },
    { type: "connect", station: "s" },
  ] as const)
    expect(await ask(request)).toEqual(DONE);
  await until(() => last !== undefined, "a sample");
  const said: string[] = [];
  const input = new PassThrough();
  return {
    ask,
    until,
    other,
    said,
    turned: () => last!.q_rad[0]! - robot.home_rad[0]!,
    says: (words: string) => until(() => said.some(line => line.includes(words)), words),
    type(line: string) {
      said.length = 0;
      input.write(`${line}\n`);
    },
    begin(program: Program, args: readonly string[], path = join(folder, "none.json")) {
      const going: { outcome: CommandOutcome | undefined } = { outcome: undefined };
      void produceOn(
        given([path, ...args], PRODUCTION_OPTIONS),
        {
          info: info!,
          onTold: listen => {
            listeners.add(listen);
            return () => listeners.delete(listen);
          },
        },
        request => client.ask(request),
        () => client.stop("s"),
        program,
        async file => (await readProgram(file, { robot, solids: () => [] })).program,
        { input, say: line => said.push(line) },
      ).then(outcome => (going.outcome = outcome));
      return going;
    },
    close() {
      host.close();
    },
  };
}

test("T-53 X-56 run --on --cycles 2: held before a breakpoint, one step, another program takes over at the next cycle; given away, moved by hand by somebody else, taken back, it ends where the new program ends", async () => {
  const { ask, until, other, said, says, type, turned, begin, close } = await bench();
  const going = begin(programOf("old", 0.1, 0.2, 0.1), ["--cycles", "2", "--breakpoint", "old1"]);
  await says("cycle 1 of 2, old: held before step old1");
  expect(turned()).toBeCloseTo(0.1, 4);
  type("step");
  await says("cycle 1 of 2, old: held before step old2");
  expect(turned()).toBeCloseTo(0.2, 4);
  type("twice");
  await says('There is no "twice" here');
  const bad = join(folder, "bad.json");
  writeFileSync(bad, '{"no":"program"}');
  type(`replace ${bad}`);
  await says("What runs goes on.");
  const good = join(folder, "new.json");
  writeFileSync(good, JSON.stringify(programOf("new", -0.15)));
  type(`replace ${good}`);
  await says("new takes over at the next cycle");
  type("breakpoints");
  type("hold");
  await says("The lease is given away");
  expect(await ask({ type: "take", station: "s" }, other)).toEqual(DONE);
  expect(await ask({ type: "move", station: "s", q_rad: at(0.3) }, other)).toEqual(DONE);
  type("resume");
  await says("is commanded by operator");
  expect(await ask({ type: "release", station: "s" }, other)).toEqual(DONE);
  type("resume");
  await says("cycle 2 of 2, new: running");
  await until(() => going.outcome !== undefined, "its end");
  expect([going.outcome, said.at(-1)]).toEqual([DONE, "production ended in cycle 2 of 2"]);
  expect(turned()).toBeCloseTo(-0.15, 4);
  close();
});

test("T-53 run --on --reload: a file that is saved while it runs takes over at the next cycle; stop ends it", async () => {
  const { until, says, type, turned, begin, close } = await bench();
  const path = join(folder, "saved.json");
  writeFileSync(path, JSON.stringify(programOf("first", 0.1, 0)));
  const going = begin(programOf("first", 0.1, 0), ["--cycles", "forever", "--step", "--reload"], path);
  await says("cycle 1, first: held before step first0");
  writeFileSync(path, JSON.stringify(programOf("second", -0.2, 0.25)));
  // The file is looked at on the machine's clock.
  await says("second takes over at the next cycle");
  type("resume");
  await says("cycle 2, second: running");
  await until(() => Math.abs(turned() - 0.25) < 1e-3, "the end of the second program");
  type("stop");
  await until(() => going.outcome !== undefined, "its end");
  expect(going.outcome).toMatchObject({ kind: "stopped" });
  close();
});

test("the number of cycles is a whole one or forever; how it stands is one line", () => {
  const asked = (...args: string[]) => cyclesOf(given(args, PRODUCTION_OPTIONS));
  expect([asked(), asked("--cycles", "5"), asked("--cycles", "forever")]).toEqual([1, 5, null]);
  for (const wrong of ["0", "1.5", "often"]) expect(() => asked("--cycles", wrong)).toThrow(/whole number/);
  const state = { type: "production", station: "s", program: "P", cycle: 2, of: 3, step: "a", next: null } as const;
  expect(stateLine({ ...state, state: "held" })).toBe("cycle 2 of 3, P: held before step a");
  expect(stateLine({ ...state, state: "running", of: null, next: "Q" })).toBe(
    "cycle 2, P: running, step a; Q takes over at the next cycle",
  );
});
