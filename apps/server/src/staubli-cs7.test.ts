/**
 * Stäubli CS7 on the system's own sockets: our driver, V+ as it is exported, and a client that nobody here wrote and
 * that moves a real RX90: the C++ class Rx90 of luismarzo/rx90. TWINCELL_RX90 names its folder in a checkout,
 * `rx90/Server_Client/No_modbus`.
 */
import {
  createCs7Adapter,
  createRealController,
  createVirtualCs7,
  openRobotConnection,
  staubli,
  staubliCs7,
  type VirtualCs7,
} from "@twincell/controllers";
import { emptyProgram, robotById, type Program } from "@twincell/core";
import { runnableFile, val3, vPlus } from "@twincell/languages";
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { setTimeout as pause } from "node:timers/promises";
import { afterEach, expect, test } from "vitest";
import { nodeScheduler } from "./clock.ts";
import { nodeNetwork } from "./sockets/node-network.ts";
import { RX90_MAIN, SERIAL_STREAM } from "./testing/serial-line.ts";

const robot = robotById("staubli_rx90l")!;
const network = nodeNetwork();
const scheduler = nodeScheduler;
const DEG = Math.PI / 180;
const ACCURACY_RAD = 0.001 * DEG;
const open: (() => void)[] = [];
afterEach(() => {
  for (const close of open.splice(0).reverse()) close();
});

async function virtualCs7(host: string, port?: number): Promise<VirtualCs7> {
  const started = await createVirtualCs7({
    robot,
    scheduler,
    network,
    host,
    ...(port === undefined ? {} : { port }),
    interpret: text => vPlus.interpret(text, robot),
  });
  if (started.kind === "taken") throw new Error(started.sentence);
  open.push(() => {
    started.virtual.close();
  });
  return started.virtual;
}
/** With a bent wrist, so that a pose names one posture. */
const shifted = (by_rad: number): number[] => [by_rad, by_rad - 1.2, by_rad + 2, 0, 0.8, 0];
const farthest = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(b, (q, i) => Math.abs(q - a[i]!)));
/** Types a line and waits for that text. */
async function typed(
  host: string,
  port: number,
  commands: readonly (readonly [line: string, until: RegExp])[],
): Promise<string> {
  const connected = await network.connect({ host, port });
  if (connected.kind === "refused") throw new Error(connected.sentence);
  let heard = "";
  let from = 0;
  connected.stream.onBytes(lent => {
    heard += String.fromCharCode(...lent);
  });
  for (const [line, until] of commands) {
    from = heard.length;
    connected.stream.send(Uint8Array.from(`${line}\r`, sign => sign.charCodeAt(0)));
    for (let i = 0; i < 400 && !until.test(heard.slice(from)); i++) await pause(50);
  }
  connected.stream.close();
  return heard;
}

test("T-22 T-23 CS7: the driver moves the virtual controller over the loopback", async () => {
  const cs7 = await virtualCs7("127.0.0.71");
  const real = createRealController({
    face: createCs7Adapter({ robot, scheduler, network, host: "127.0.0.71" }),
    scheduler,
  });
  open.push(() => {
    real.close();
  });
  expect(cs7.ports).toEqual({ line: 4001 });
  expect(await real.connect()).toEqual({ kind: "done" });
  expect(await real.moveJoints(shifted(0.2))).toEqual({ kind: "done" });
  for (const is of [real.jointAngles(), cs7.arm.jointAngles()])
    expect(farthest(is, shifted(0.2))).toBeLessThanOrEqual(ACCURACY_RAD);
  const moving = real.moveJoints(shifted(-0.9));
  await pause(200);
  real.stop();
  expect((await moving).kind).toBe("stopped");
});

test("N-62 CS7: a V+ program as it is exported is loaded from the disk and replayed; so is a list of terminal commands", async () => {
  const cs7 = await virtualCs7("127.0.0.72", 0);
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
  const emitted = vPlus.emit(program, robot);
  if (emitted.kind !== "emitted") throw new Error(emitted.sentence);
  const { text } = runnableFile(vPlus, emitted.files)!;
  const name = /\.PROGRAM\s+([\w.]+)/i.exec(text)![1]!;
  expect(cs7.pendant.write("TWO.V2", text)).toBeNull();
  const heard = await typed("127.0.0.72", cs7.ports.line, [
    ["LOAD two", /\.$/],
    [`EXECUTE 1 ${name}`, /Program completed/],
  ]);
  expect(heard).not.toMatch(/\*/);
  expect(farthest(cs7.arm.jointAngles(), shifted(-0.1))).toBeLessThanOrEqual(ACCURACY_RAD);
  // As V+'s own instructions, through its interpreter: a location from the present one, and back up.
  const said = await typed("127.0.0.72", cs7.ports.line, [
    ["DO SET start=HERE", /\n\.$/],
    ["do set jog0 = SHIFT(HERE BY 0,0,-50)", /\n\.$/],
    ["do moves jog0", /\n\.$/],
    ["DO CLOSEI", /\n\.$/],
  ]);
  expect(said).not.toMatch(/\*/);
  const moved = cs7.arm.jointAngles();
  expect(farthest(moved, shifted(-0.1))).toBeGreaterThan(0.01);
  await typed("127.0.0.72", cs7.ports.line, [["do moves start", /\n\.$/]]);
  expect(farthest(cs7.arm.jointAngles(), shifted(-0.1))).toBeLessThan(1e-3);
}, 60_000);

test("a robot that stands on another controller of the vendor's is refused with both names", async () => {
  const rx160 = robotById("staubli_rx160")!;
  expect(
    await openRobotConnection({ id: "a", brand: staubliCs7, robot: rx160, scheduler, dialect: vPlus }),
  ).toMatchObject({
    kind: "refused",
    why: { sentence: "Stäubli RX160 does not stand on a controller of Stäubli CS7 (V+); its drivers are staubli." },
  });
  expect(await openRobotConnection({ id: "b", brand: staubli, robot, scheduler, dialect: val3 })).toMatchObject({
    kind: "refused",
    why: { sentence: "Stäubli RX90L does not stand on a controller of Stäubli (VAL 3); its drivers are staubli-cs7." },
  });
});

test("the program of the handbook is what the virtual controller has built in: it is V+, and its motions are the same", () => {
  const text = readFileSync(new URL("../../../docs/controllers/TWINCELL.v2", import.meta.url), "utf8");
  const asked = [
    "SET #TWC = #PPOINT(10,-80,80,0,0,0)",
    "TWC.LINE = 0",
    "TWC.SPEED = 50",
    "TWC.ACCEL = 100",
    "TWC.ID = 3",
  ];
  const read = vPlus.interpret(text.replace(/(\.PROGRAM[^\n]*\n)/i, `$1${asked.join("\n")}\n`), robot);
  if (read.kind !== "ready") throw new Error(JSON.stringify(read.faults));
  const steps = [];
  const run = read.run();
  for (let next = run.next(); !next.done; next = run.next()) if (next.value.step) steps.push(next.value.step);
  expect(steps).toMatchObject([{ type: "move", path: "ptp", speed: { ratio: 0.5 }, blend_m: 0 }]);
});

const RX90_AT = process.env["TWINCELL_RX90"] ?? "";
const has = existsSync(join(RX90_AT, "Rx90.cpp"));
const SKIPPED = has ? "" : " (no checkout of luismarzo/rx90: name its folder Server_Client/No_modbus by TWINCELL_RX90)";

test.skipIf(!has)(
  `T-22 the Rx90 class of luismarzo/rx90, which nobody here wrote, moves the virtual CS7${SKIPPED}`,
  async () => {
    const folder = mkdtempSync(join(tmpdir(), "rx90-"));
    open.push(() => {
      rmSync(folder, { recursive: true, force: true });
    });
    writeFileSync(join(folder, "SerialStream.h"), SERIAL_STREAM);
    writeFileSync(join(folder, "main.cpp"), RX90_MAIN);
    const run = (program: string, args: readonly string[]): Promise<{ code: number; out: string }> =>
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
      });
    const built = await run("g++", [
      "-O1",
      "-w",
      `-I${folder}`,
      `-I${RX90_AT}`,
      join(folder, "main.cpp"),
      join(RX90_AT, "Rx90.cpp"),
      "-o",
      join(folder, "main"),
    ]);
    expect(built.code, built.out).toBe(0);
    const cs7 = await virtualCs7("127.0.0.73", 0);
    const { code, out } = await run(join(folder, "main"), [`127.0.0.73:${cs7.ports.line}`, "30,-77,19,55,45,-43"]);
    expect(code, out).toBe(0);
    // It shifts a location POSE that it never set, and moves to what comes of it: that is its own, and said to it.
    expect(out.match(/\*[^*]*\*/g)).toEqual(["*Undefined value*", "*Undefined value*"]);
    expect(
      farthest(
        cs7.arm.jointAngles(),
        [30, -77, 19, 55, 45, -43].map(value => value * DEG),
      ),
    ).toBeLessThan(1e-9);
  },
  120_000,
);
