/**
 * Stäubli CS8 and CS9 on the system's own sockets: our driver, VAL 3 as it is exported, and both ends of simple_message
 * as nobody here wrote them: the C++ library of ROS-Industrial. TWINCELL_SIMPLE_MESSAGE names its folder in a checkout:
 *   git clone industrial_core of ros-industrial at 0.7.3;  TWINCELL_SIMPLE_MESSAGE=industrial_core/simple_message
 */
import {
  createRealController,
  createStaubliAdapter,
  createVirtualStaubli,
  type VirtualStaubli,
} from "@twincell/controllers";
import { emptyProgram, robotById, type Program } from "@twincell/core";
import { runnableFile, val3 } from "@twincell/languages";
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { setTimeout as pause } from "node:timers/promises";
import { afterAll, afterEach, beforeAll, describe, expect, test } from "vitest";
import { nodeScheduler } from "./clock.ts";
import { nodeNetwork } from "./sockets/node-network.ts";
import { freePort } from "./testing/free-port.ts";
import { CLIENT, LOOPBACK, SERVER, SOURCES } from "./testing/simple-message.ts";

const robot = robotById("staubli_rx160")!;
const network = nodeNetwork();
const scheduler = nodeScheduler;
const ACCURACY_RAD = (0.001 * Math.PI) / 180;
/** Robot and driver share one processor here with whatever else it does. */
const PATIENT_S = 1;
const open: (() => void)[] = [];
afterEach(() => {
  for (const close of open.splice(0).reverse()) close();
});

async function virtualStaubli(
  host: string,
  ports: { motion?: number; feedback?: number } = { motion: 0, feedback: 0 },
): Promise<VirtualStaubli> {
  const started = await createVirtualStaubli({
    robot,
    scheduler,
    network,
    host,
    ports,
    interpret: text => val3.interpret(text, robot),
  });
  if (started.kind === "taken") throw new Error(started.sentence);
  open.push(() => {
    started.virtual.close();
  });
  return started.virtual;
}
function driver(host: string, ports: { motion: number; feedback: number }) {
  const real = createRealController({
    face: createStaubliAdapter({ robot, scheduler, network, host, ports, stale_s: PATIENT_S }),
    scheduler,
  });
  open.push(() => {
    real.close();
  });
  return real;
}
const shifted = (by_rad: number): number[] => [0, 0.3, 0.8, 0, 0.3, 0].map(q => q + by_rad);
const farthest = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(b, (q, i) => Math.abs(q - a[i]!)));

test("T-22 T-23 Stäubli: the driver moves the virtual controller over the loopback; the ports are those of the program", async () => {
  const staubli = await virtualStaubli("127.0.0.61", {});
  const real = driver("127.0.0.61", staubli.ports);
  expect(staubli.ports).toEqual({ motion: 11_000, feedback: 11_002 });
  expect(await real.connect()).toEqual({ kind: "done" });
  let samples = 0;
  real.onSample(() => {
    samples++;
  });
  const begun_s = scheduler.now_s();
  expect(await real.moveJoints(shifted(0.2))).toEqual({ kind: "done" });
  expect(samples / (scheduler.now_s() - begun_s)).toBeGreaterThan(20);
  for (const is of [real.jointAngles(), staubli.arm.jointAngles()])
    expect(farthest(is, shifted(0.2))).toBeLessThanOrEqual(ACCURACY_RAD);
  const moving = real.moveJoints(shifted(-0.5));
  await pause(200);
  real.stop();
  expect((await moving).kind).toBe("stopped");
});

test("N-62 Stäubli: an application of VAL 3 as it is exported is loaded and started at the pendant; a driver that watches follows", async () => {
  const staubli = await virtualStaubli("127.0.0.62");
  const real = driver("127.0.0.62", staubli.ports);
  expect(await real.connect()).toEqual({ kind: "done" });
  const program: Program = {
    ...emptyProgram(robot.id, "Two"),
    steps: [0.2, -0.1].map((by, i) => ({
      id: `p${i}`,
      type: "move",
      path: "ptp",
      target: { q: shifted(by) },
      speed: { ratio: 1 },
      blend_m: 0,
    })),
  };
  const emitted = val3.emit(program, robot);
  if (emitted.kind !== "emitted") throw new Error(emitted.sentence);
  expect(staubli.pendant.load(runnableFile(val3, emitted.files)!.text)).toBeNull();
  expect(await staubli.pendant.start()).toBe("");
  await pause(100);
  expect(farthest(staubli.arm.jointAngles(), shifted(-0.1))).toBeLessThanOrEqual(ACCURACY_RAD);
  expect(farthest(real.jointAngles(), shifted(-0.1))).toBeLessThanOrEqual(ACCURACY_RAD);
});

const LIBRARY_AT = process.env["TWINCELL_SIMPLE_MESSAGE"] ?? "";
const has = existsSync(join(LIBRARY_AT, "src", "simple_message.cpp"));
const SKIPPED = has
  ? ""
  : " (no checkout of industrial_core: name its folder simple_message by TWINCELL_SIMPLE_MESSAGE)";

describe.skipIf(!has)(`simple_message of ROS-Industrial, which nobody here wrote${SKIPPED}`, () => {
  let folder = "";
  const run = (
    program: string,
    args: readonly string[],
    started?: (stop: () => void) => void,
  ): Promise<{ code: number; out: string }> =>
    new Promise(resolve => {
      const child = spawn(program, args, { stdio: ["ignore", "pipe", "pipe"] });
      let out = "";
      for (const stream of [child.stdout, child.stderr])
        stream.on("data", (chunk: Buffer) => {
          out += chunk.toString();
        });
      child.once("error", problem => {
        resolve({ code: -1, out: problem.message });
      });
      child.once("close", code => {
        resolve({ code: code ?? -1, out });
      });
      started?.(() => {
        child.kill("SIGKILL");
      });
    });
  const compiled = async (name: string, source: string): Promise<string> => {
    const main = join(folder, `${name}.cpp`);
    const program = join(folder, name);
    writeFileSync(main, source);
    const sources = SOURCES.map(file => join(LIBRARY_AT, "src", file));
    const { code, out } = await run("g++", [
      "-std=c++11",
      "-O1",
      "-w",
      "-DSIMPLE_MESSAGE_LINUX",
      `-include${join(folder, "loopback.h")}`,
      `-I${join(LIBRARY_AT, "include")}`,
      main,
      ...sources,
      "-o",
      program,
      "-lpthread",
    ]);
    expect(code, out).toBe(0);
    return program;
  };
  beforeAll(() => {
    folder = mkdtempSync(join(tmpdir(), "simple-message-"));
    writeFileSync(join(folder, "loopback.h"), LOOPBACK);
  });
  afterAll(() => {
    rmSync(folder, { recursive: true, force: true });
  });

  test("T-22 its client moves the virtual controller, reads its joints and its status, is refused beyond a limit, and stops it", async () => {
    const program = await compiled("client", CLIENT);
    const staubli = await virtualStaubli("127.0.0.63");
    const { code, out } = await run(program, [
      "127.0.0.63",
      String(staubli.ports.motion),
      String(staubli.ports.feedback),
      ...shifted(0.3).map(String),
    ]);
    expect(code, out).toBe(0);
    expect(out).toContain("point 7: reply 1");
    expect(out).toContain("beyond: reply 2");
    expect(out).toContain("status: powered 1 emergency 0 error 0 mode 2 possible 1");
    const joints = /joints: (.*)/.exec(out)![1]!.split(" ").map(Number);
    expect(farthest(joints, shifted(0.3))).toBeLessThanOrEqual(ACCURACY_RAD);
    expect(out).toContain("stop: reply 1");
    expect(staubli.waiting).toBe(0);
  }, 120_000);

  test("T-22 T-23 our driver connects to its server, moves it and reads it", async () => {
    const program = await compiled("server", SERVER);
    const motion = await freePort("127.0.0.1");
    const feedback = await freePort("127.0.0.1");
    let stop = (): void => {
      /* Not started yet. */
    };
    const over = run(program, [String(motion), String(feedback)], kill => {
      stop = kill;
    });
    open.push(() => {
      stop();
    });
    await pause(500);
    const real = driver("127.0.0.1", { motion, feedback });
    expect(await real.connect()).toEqual({ kind: "done" });
    expect(await real.moveJoints(shifted(0.3))).toEqual({ kind: "done" });
    expect(farthest(real.jointAngles(), shifted(0.3))).toBeLessThanOrEqual(ACCURACY_RAD);
    real.close();
    stop();
    await over;
  }, 120_000);
});
