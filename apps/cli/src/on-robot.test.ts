/**
 * A robot moved from the command line: at a server, and at its controller directly. Every command is a process of its
 * own.
 */
import { execFile, spawn, type ChildProcess } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import { emptyProgram, flangePose, robotById, type MoveStep, type Program } from "@twincell/core";
import { serve, type Served } from "@twincell/server";
import { afterAll, beforeAll, describe, expect, test } from "vitest";

const root = fileURLToPath(new URL("../../../", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "twincell-on-"));
const robot = robotById("ur10e")!;
const ends: (() => Promise<void> | void)[] = [];
afterAll(async () => {
  for (const end of ends.reverse()) await end();
  rmSync(folder, { recursive: true, force: true });
});

interface Ran {
  readonly code: number;
  readonly out: string;
  readonly err: string;
}
const started = (args: readonly string[]): { readonly child: ChildProcess; readonly ended: Promise<Ran> } => {
  let child!: ChildProcess;
  const ended = new Promise<Ran>(resolve => {
    child = execFile(process.execPath, ["apps/cli/src/main.ts", ...args], { cwd: root }, (_, out, err) => {
      resolve({ code: child.exitCode ?? -1, out, err });
    });
  });
  return { child, ended };
};
const twincell = (...args: string[]): Promise<Ran> => started(args).ended;
const outcomeOf = ({ out }: Ran): unknown => JSON.parse(out);
const DONE = { kind: "done" };

/** A virtual controller of that maker on this machine, as a process of its own. */
async function virtual(driver: string, host: string): Promise<void> {
  const child = spawn(process.execPath, ["apps/cli/src/main.ts", "virtual", driver, "--host", host, "--json"], {
    cwd: root,
    stdio: ["pipe", "pipe", "inherit"],
  });
  ends.push(
    () =>
      new Promise<void>(resolve => {
        child.once("exit", () => {
          resolve();
        });
        child.kill("SIGTERM");
      }),
  );
  const lines = createInterface({ input: child.stdout })[Symbol.asyncIterator]();
  expect(JSON.parse((await lines.next()).value as string)).toMatchObject({ brand: driver, host });
}
const step = (id: string, q: readonly number[], ratio = 0.5): MoveStep => ({
  id,
  type: "move",
  path: "ptp",
  target: { q: [...q] },
  speed: { ratio },
  blend_m: 0,
});
const turned = (by_rad: number): number[] => robot.home_rad.map((q, i) => (i === 0 ? q + by_rad : q));
function programFile(name: string, ...steps: MoveStep[]): string {
  const path = join(folder, `${name}.json`);
  writeFileSync(path, JSON.stringify({ ...emptyProgram(robot.id, name), steps } satisfies Program));
  return path;
}
/** Where the robot stands, as watch says. */
async function standsAt(at: readonly string[]): Promise<readonly number[]> {
  const { code, out } = await twincell("watch", ...at, "--samples", "1", "--only", "sample");
  expect(code).toBe(0);
  return (JSON.parse(out) as { q_rad: number[] }).q_rad;
}
const near = (a: readonly number[], b: readonly number[]): number =>
  Math.max(...a.map((value, i) => Math.abs(value - b[i]!)));

describe("a controller without a server", () => {
  const at = ["--at", "127.0.0.61", "--driver", "ur", "--robot", "ur10e"];
  beforeAll(() => virtual("ur", "127.0.0.61"), 60_000);

  test("connect says what it hears and leaves; another model is refused with both names", async () => {
    const { code, out } = await twincell("connect", ...at);
    expect(code).toBe(0);
    expect(JSON.parse(out)).toMatchObject({
      driver: "ur",
      model: "ur10e",
      moving: false,
      q_rad: expect.any(Array) as unknown,
    });
    const other = await twincell("connect", "--at", "127.0.0.61", "--driver", "kuka", "--robot", "ur10e");
    expect([other.code, other.err]).toEqual([2, expect.stringContaining("KUKA") as string]);
    const nobody = await twincell("connect", "--at", "127.0.0.62", "--driver", "ur", "--robot", "ur10e");
    expect([nobody.code, nobody.err]).toEqual([2, expect.stringContaining("127.0.0.62") as string]);
  }, 120_000);

  test("T-06 T-07 T-08 move goes to joint angles, one joint, a pose; out of reach is said in numbers", async () => {
    expect(outcomeOf(await twincell("move", ...at, "--joints", turned(0.2).join(",")))).toEqual(DONE);
    expect(near(await standsAt(at), turned(0.2))).toBeLessThan(1e-3);
    expect(outcomeOf(await twincell("move", ...at, "--joint", "1=0.1"))).toEqual(DONE);
    expect((await standsAt(at))[0]).toBeCloseTo(0.1, 3);
    const { position, quaternion } = flangePose(robot.arm, [0.1, ...robot.home_rad.slice(1)]);
    const there = [position[0], position[1], position[2] - 0.05, ...quaternion];
    expect(outcomeOf(await twincell("move", ...at, "--pose", there.join(","), "--line"))).toEqual(DONE);
    const stood = flangePose(robot.arm, await standsAt(at)).position;
    expect(stood[2]).toBeCloseTo(position[2] - 0.05, 4);
    const far = await twincell("move", ...at, "--pose", "9,0,0,0,0,0,1");
    expect(far.code).toBe(1);
    expect(outcomeOf(far)).toMatchObject({
      kind: "refused",
      why: { code: expect.stringMatching(/^reach\./) as string },
    });
  }, 180_000);

  test("jog goes by steps: a joint, and the flange along an axis of the base", async () => {
    const from = await standsAt(at);
    expect(outcomeOf(await twincell("jog", ...at, "--joint", "2", "--by", "-0.02", "--steps", "3"))).toEqual(DONE);
    const after = await standsAt(at);
    expect(after[1]! - from[1]!).toBeCloseTo(-0.06, 3);
    expect(outcomeOf(await twincell("jog", ...at, "--axis", "z", "--by", "0.02"))).toEqual(DONE);
    const [before, then] = [flangePose(robot.arm, after), flangePose(robot.arm, await standsAt(at))];
    expect(then.position[2] - before.position[2]).toBeCloseTo(0.02, 4);
    expect(then.position[0] - before.position[0]).toBeCloseTo(0, 4);
  }, 120_000);

  test("stop from another process stops a move at the controller; the move says that it was stopped", async () => {
    const moving = twincell("move", ...at, "--joints", turned(1).join(","), "--ratio", "0.03");
    const watching = spawn(process.execPath, ["apps/cli/src/main.ts", "watch", ...at, "--only", "sample"], {
      cwd: root,
      stdio: ["ignore", "pipe", "inherit"],
    });
    for await (const line of createInterface({ input: watching.stdout }))
      if ((JSON.parse(line) as { moving: boolean }).moving) break;
    watching.kill("SIGTERM");
    const stopped = await twincell("stop", ...at);
    expect([stopped.code, outcomeOf(stopped)]).toMatchObject([0, { stands: true }]);
    const ended = await moving;
    expect([ended.code, outcomeOf(ended)]).toMatchObject([1, { kind: "stopped" }]);
    expect(Math.abs((await standsAt(at))[0]! - turned(1)[0]!)).toBeGreaterThan(0.1);
  }, 120_000);

  test("T-34 run --on --paced: 32.875 ± 1 ms on average from the end of a command to the next", async () => {
    const path = programFile("paced", ...[0.02, 0.04, 0.06, 0.08, 0.1].map((by, i) => step(`p${i}`, turned(by), 1)));
    const { code, err, out } = await twincell("run", path, "--on", "127.0.0.61", ...at.slice(2), "--paced");
    expect([code, JSON.parse(out)]).toEqual([0, DONE]);
    const [, count, mean] = /(\d+) commands, ([\d.]+) ms from the end/.exec(err) ?? [];
    expect(Number(count)).toBe(5);
    expect(Math.abs(Number(mean) - 32.875)).toBeLessThan(1);
    expect((await standsAt(at))[0]).toBeCloseTo(0.1 + robot.home_rad[0]!, 3);
    // A step that the connection cannot say, at the end: named before the first one is sent.
    const spline = programFile("spline", step("p0", turned(0.5), 1), { ...step("bend", turned(0.4)), path: "spline" });
    const refused = await twincell("run", spline, "--on", "127.0.0.61", ...at.slice(2), "--paced");
    expect([refused.code, JSON.parse(refused.out)]).toMatchObject([
      1,
      { kind: "refused", why: { sentence: expect.stringContaining("“bend” cannot be carried out") as string } },
    ]);
    expect((await standsAt(at))[0]).toBeCloseTo(0.1 + robot.home_rad[0]!, 3);
  }, 120_000);
});

describe("a robot of a server", () => {
  let served: Served;
  let at: string[];
  const config = join(folder, "connections.json");
  const studio = join(folder, "studio");
  const open = async (): Promise<void> => {
    served = await serve({ studio, port: 0, connections: config });
    at = ["--at", new URL(served.url).host];
  };
  beforeAll(async () => {
    mkdirSync(studio, { recursive: true });
    writeFileSync(join(studio, "index.html"), "");
    await virtual("kuka-rsi", "127.0.0.63");
    served = await serve({ studio, port: 0 });
    at = ["--at", new URL(served.url).host];
    ends.push(() => served.close());
  }, 60_000);

  test("connect opens a robot at a server and keeps it in a file; another way to a controller among them", async () => {
    const none = await twincell("watch", ...at, "--samples", "1");
    expect([none.code, none.err]).toEqual([2, expect.stringContaining("No robot is open") as string]);
    expect(
      outcomeOf(await twincell("connect", "arm", ...at, "--driver", "ur", "--robot", "ur10e", "--save", config)),
    ).toEqual(DONE);
    const kuka = ["--driver", "kuka-rsi", "--robot", "kuka_kr6r900sixx", "--address", "127.0.0.63"];
    expect(outcomeOf(await twincell("connect", "kuka", ...at, ...kuka, "--save", config))).toEqual(DONE);
    expect(JSON.parse(readFileSync(config, "utf8"))).toEqual({
      format: "twincell.connections",
      version: 1,
      robots: [
        { id: "arm", driver: "ur", model: "ur10e" },
        { id: "kuka", driver: "kuka-rsi", model: "kuka_kr6r900sixx", address: { host: "127.0.0.63", ports: {} } },
      ],
    });
    const which = await twincell("watch", ...at, "--samples", "1");
    expect([which.code, which.err]).toEqual([2, expect.stringMatching(/2 robots are open.*arm .*kuka /s) as string]);
  }, 120_000);

  test("stop from another process stops a move, which says so; a second move is refused the lease", async () => {
    const arm = [...at, "--station", "arm"];
    expect(outcomeOf(await twincell("move", ...arm, "--joints", turned(-1).join(","), "--ratio", "1"))).toEqual(DONE);
    const watching = spawn(process.execPath, ["apps/cli/src/main.ts", "watch", ...arm, "--only", "sample"], {
      cwd: root,
      stdio: ["ignore", "pipe", "inherit"],
    });
    const samples = createInterface({ input: watching.stdout })[Symbol.asyncIterator]();
    await samples.next();
    const moving = twincell("move", ...arm, "--joints", turned(1).join(","), "--ratio", "0.05");
    const next = async (): Promise<{ moving: boolean }> =>
      JSON.parse((await samples.next()).value as string) as { moving: boolean };
    while (!(await next()).moving);
    const second = await twincell("move", ...arm, "--home");
    const stopped = await twincell("stop", ...arm);
    expect([second.code, outcomeOf(second)]).toMatchObject([1, { why: { code: "guard.lease-taken" } }]);
    expect([stopped.code, outcomeOf(stopped)]).toMatchObject([0, { stopped: "arm", stands: true }]);
    const ended = await moving;
    expect([ended.code, outcomeOf(ended)]).toMatchObject([1, { kind: "stopped" }]);
    watching.kill("SIGTERM");
    const stood = await standsAt(arm);
    expect(Math.abs(stood[0]! - turned(1)[0]!)).toBeGreaterThan(0.1);
  }, 180_000);

  test("T-10 after an emergency stop no move is taken until a reset; after its answer one is", async () => {
    const arm = [...at, "--station", "arm"];
    const move = (by_rad: number): Promise<Ran> =>
      twincell("move", ...arm, "--joints", turned(by_rad).join(","), "--ratio", "1");
    expect(outcomeOf(await move(0.3))).toEqual(DONE);
    expect(outcomeOf(await twincell("stop", ...arm, "--emergency"))).toMatchObject({ stopped: "arm", stands: true });
    expect(outcomeOf(await move(0.2))).toMatchObject({ kind: "refused", why: { code: "safety.emergency-stop" } });
    const post = async (path: string, headers: Record<string, string>, body?: unknown): Promise<unknown> => {
      const response = await fetch(new URL(`/api/v1/robots/arm/${path}`, served.url), {
        method: "POST",
        headers: { "content-type": "application/json", ...headers },
        body: JSON.stringify(body ?? {}),
      });
      return response.json();
    };
    const { lease } = (await post("lease", {}, { who: "test", expires_s: 30 })) as { lease: string };
    const holder = { "twincell-lease": lease };
    expect(await post("reset", holder)).toEqual(DONE);
    expect(await post("move", holder, { q_rad: turned(0.2) })).toEqual(DONE);
    expect(near(await standsAt(arm), turned(0.2))).toBeLessThan(1e-3);
    await fetch(new URL("/api/v1/robots/arm/lease", served.url), { method: "DELETE", headers: holder });
  }, 120_000);

  test("Ctrl-C in a move stops the robot before the process ends", async () => {
    const arm = [...at, "--station", "arm"];
    const { child, ended } = started(["move", ...arm, "--joints", turned(1).join(","), "--ratio", "0.05"]);
    const watching = spawn(process.execPath, ["apps/cli/src/main.ts", "watch", ...arm, "--only", "sample"], {
      cwd: root,
      stdio: ["ignore", "pipe", "inherit"],
    });
    for await (const line of createInterface({ input: watching.stdout }))
      if ((JSON.parse(line) as { moving: boolean }).moving) break;
    watching.kill("SIGTERM");
    child.kill("SIGINT");
    const { code, out } = await ended;
    expect([code, JSON.parse(out)]).toMatchObject([1, { kind: "stopped" }]);
    const [a, b] = [await standsAt(arm), await standsAt(arm)];
    expect(near(a, b)).toBeLessThan(1e-4);
  }, 120_000);

  test("run --on sends a checked program, refuses a red one with the finding and a breakpoint in a text, runs a vendor's text", async () => {
    const arm = ["--on", at[1]!, "--station", "arm"];
    const good = programFile("good", step("a", turned(0.1)), step("b", turned(0)));
    expect(outcomeOf(await twincell("run", good, ...arm, "--as-text"))).toEqual(DONE);
    const held = await twincell("run", good, ...arm, "--as-text", "--breakpoint", "b");
    expect([held.code, outcomeOf(held)]).toMatchObject([1, { kind: "refused", why: { code: "production.text" } }]);
    const red = programFile("red", step("a", [...turned(0).slice(0, 5), 99]));
    const refused = await twincell("run", red, ...arm);
    expect([refused.code, outcomeOf(refused)]).toMatchObject([1, { kind: "refused", why: { code: "limits.joint" } }]);
    const text = join(folder, "there.script");
    writeFileSync(text, `def there():\n  movej([${turned(0.15).join(", ")}], a=1.4, v=1.05)\nend\n`);
    expect(outcomeOf(await twincell("run", text, "--dialect", "urscript", ...arm))).toEqual(DONE);
    expect((await standsAt([...at, "--station", "arm"]))[0]).toBeCloseTo(turned(0.15)[0]!, 3);
  }, 180_000);

  test("connections of the file are open after a start; a controller that is gone keeps no other away", async () => {
    await served.close();
    writeFileSync(
      config,
      JSON.stringify({
        ...(JSON.parse(readFileSync(config, "utf8")) as object),
        robots: [
          { id: "gone", driver: "ur", model: "ur10e", address: { host: "127.0.0.64" } },
          ...(JSON.parse(readFileSync(config, "utf8")) as { robots: unknown[] }).robots,
        ],
      }),
    );
    await open();
    for (const id of ["arm", "kuka"]) expect((await standsAt([...at, "--station", id])).length).toBe(6);
    const silent = await twincell("move", ...at, "--station", "gone", "--home");
    expect([silent.code, outcomeOf(silent)]).toMatchObject([1, { kind: "refused" }]);
    writeFileSync(config, '{"format":"twincell.connections","version":1,"robots":[{"id":"a","driver":"ur"}]}');
    await expect(serve({ studio, port: 0, connections: config })).rejects.toThrow(/robots\[0\] has no model/);
  }, 180_000);
});

test("wrong use is named", async () => {
  for (const [args, sentence] of [
    [["move"], "move wants one target"],
    [["move", "--home"], "--at is missing"],
    [["move", "--home", "--zero", "--at", "h"], "move wants one target"],
    [["jog", "--joint", "1", "--at", "h"], "--by is missing"],
    [["jog", "--axis", "q", "--by", "1", "--at", "h"], 'no axis "q"'],
    [["stop", "--at", "127.0.0.1:1"], "There is no Twincell server at 127.0.0.1:1"],
    [["watch", "--at", "127.0.0.1", "--driver", "acme"], 'There is no driver "acme"'],
    [["connect", "arm", "--at", "127.0.0.1:1"], "--driver is missing"],
    [["connect", "--at", "127.0.0.1"], "--driver is missing"],
    [["run", "a.json", "--on", "h", "--cycles", "0"], "--cycles wants a whole number of 1 or more"],
    [["run", "a.json", "--on", "h", "--paced", "--step"], "--paced sends one program step by step"],
  ] as const) {
    const { code, err } = await twincell(...args);
    expect([args.join(" "), code, err]).toEqual([args.join(" "), 2, expect.stringContaining(sentence) as string]);
  }
}, 120_000);
