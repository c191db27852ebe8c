/**
 * KUKA on the system's own sockets: our driver, and clients that nobody here wrote. The Python that has them is named
 * by
 * TWINCELL_PYTHON, or is the python3 of the path:  pip install py-openshowvar==1.1.7
 */
import {
  createKukaAdapter,
  createRealController,
  createVirtualKuka,
  startLoop,
  type VirtualKuka,
} from "@twincell/controllers";
import { robotById, type CommandOutcome } from "@twincell/core";
import { krl } from "@twincell/languages";
import { spawn } from "node:child_process";
import { connect } from "node:net";
import { setTimeout as pause } from "node:timers/promises";
import { afterEach, describe, expect, test } from "vitest";
import { nodeScheduler } from "./clock.ts";
import { nodeNetwork } from "./sockets/node-network.ts";

const robot = robotById("kuka_kr6r900sixx")!;
const network = nodeNetwork();
const scheduler = nodeScheduler;
const ACCURACY_RAD = (0.001 * Math.PI) / 180;
/** Robot and driver share one processor here with whatever else it does. */
const PATIENT_S = 1;
const open: { close(): void }[] = [];
afterEach(() => {
  for (const each of open.splice(0).reverse()) each.close();
});

async function virtualKuka(host: string, port = 0): Promise<{ kuka: VirtualKuka; port: number; log: string[] }> {
  const log: string[] = [];
  const kuka = await createVirtualKuka({
    robot,
    scheduler,
    network,
    host,
    port,
    interpret: text => krl.interpret(text, robot),
    log: sentence => {
      log.push(sentence);
    },
  });
  open.push(kuka);
  if (kuka.listening.kind === "taken") throw new Error(kuka.listening.sentence);
  expect(startLoop(kuka)).toBeNull();
  return { kuka, port: kuka.listening.address.port, log };
}
async function driver(host: string, port: number) {
  const real = createRealController({
    face: createKukaAdapter({ robot, scheduler, network, host, port, stale_s: PATIENT_S }),
    scheduler,
  });
  open.push(real);
  expect(await real.connect()).toEqual({ kind: "done" });
  return real;
}
const shifted = (by_rad: number): number[] => Array.from(robot.home_rad, (q, i) => (i === 4 ? q - by_rad : q + by_rad));
const farthest = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(a, (q, i) => Math.abs(q - b[i]!)));

describe("KUKA on real sockets", () => {
  test("T-22 T-23 the driver moves the virtual controller over the loopback; the port is the vendor's own", async () => {
    const { kuka } = await virtualKuka("127.0.0.31", 7000);
    const real = await driver("127.0.0.31", 7000);
    let samples = 0;
    real.onSample(() => {
      samples++;
    });
    const begun_s = scheduler.now_s();
    expect(await real.moveJoints(shifted(0.3))).toEqual({ kind: "done" });
    const rate_Hz = samples / (scheduler.now_s() - begun_s);
    expect(farthest(real.jointAngles(), shifted(0.3))).toBeLessThanOrEqual(ACCURACY_RAD);
    expect(farthest(kuka.arm.jointAngles(), shifted(0.3))).toBeLessThanOrEqual(ACCURACY_RAD);
    expect(rate_Hz).toBeGreaterThan(30);
    expect(real.link.roundTrip_s).toBeLessThan(0.1);
    const moving = real.moveJoints(shifted(-0.3));
    await pause(200);
    real.stop();
    expect((await moving).kind).toBe("stopped");
    real.disconnect();
    expect(real.isConnected).toBe(false);
  });

  test("a KRL text runs on the controller, from file to end; one with an error is refused", async () => {
    const { kuka, port } = await virtualKuka("127.0.0.32");
    const real = await driver("127.0.0.32", port);
    const text = [
      "DEF SHORT( )",
      "BAS(#INITMOV,0)",
      "BAS(#VEL_PTP,100)",
      "PTP {A1 5,A2 -90,A3 90,A4 0,A5 60,A6 0}",
      "$OUT[4]=TRUE",
      "PTP {A1 -5,A2 -85,A3 90,A4 0,A5 60,A6 0}",
      "END",
      "",
    ].join("\r\n");
    const outcome: CommandOutcome = await real.runText!([
      { name: "SHORT.src", text, lines: text.split("\r\n").map(() => "") },
    ]);
    expect(outcome).toEqual({ kind: "done" });
    expect(kuka.arm.jointAngle(1)).toBeCloseTo((-5 * Math.PI) / 180, 6);
    expect(kuka.variables.read("$OUT[4]")).toBe("TRUE");
    expect(kuka.program).toMatchObject({ name: "TWINCELL" });
    expect(
      await real.runText!([{ name: "BAD.src", text: "DEF BAD( )\r\nJUMP HIGH\r\nEND\r\n", lines: [] }]),
    ).toMatchObject({ kind: "refused", why: { code: "kuka.program" } });
  });

  test("garbage on the port is logged once and cut off; the next client is served", async () => {
    const { port, log } = await virtualKuka("127.0.0.33");
    const socket = connect({ host: "127.0.0.33", port });
    const over = new Promise<void>(resolve => {
      socket.once("close", () => {
        resolve();
      });
    });
    socket.on("error", () => {
      /* A reset is what is wanted. */
    });
    socket.resume();
    socket.write(Uint8Array.of(0, 1, 0, 0, 9, 9, 9));
    await over;
    expect(log).toHaveLength(1);
    expect((await driver("127.0.0.33", port)).isConnected).toBe(true);
  });
});

const PYTHON = process.env["TWINCELL_PYTHON"] ?? "python3";
/** What a script printed, and how it ended. */
const python = (script: string, ...args: string[]): Promise<{ code: number; out: string }> =>
  new Promise(resolve => {
    const child = spawn(PYTHON, ["-c", script, ...args], { stdio: ["ignore", "pipe", "pipe"] });
    let out = "";
    child.stdout.on("data", (chunk: Buffer) => {
      out += chunk.toString();
    });
    child.stderr.on("data", (chunk: Buffer) => {
      out += chunk.toString();
    });
    child.once("error", problem => {
      resolve({ code: -1, out: problem.message });
    });
    child.once("close", code => {
      resolve({ code: code ?? -1, out });
    });
  });
const hasOpenShowVar = (await python("import py_openshowvar")).code === 0;

const CLIENT = `
import json, sys, time
from py_openshowvar import openshowvar
client = openshowvar(sys.argv[1], int(sys.argv[2]))
said = {"can": client.can_connect}
for name in ["$AXIS_ACT", "$POS_ACT", "$MODE_OP", "$PRO_STATE1", "$OV_PRO", "$ROBNAME[]", "PING", "TWC_AXIS"]:
    said[name] = client.read(name, debug=False).decode()
said["override"] = client.write("$OV_PRO", "40", debug=False).decode()
said["refused"] = client.write("$MODE_OP", "#T1", debug=False)
said["unknown"] = client.read("NOBODY", debug=False)
for name, value in [("TWC_AXIS", "{E6AXIS: A1 10,A2 -80,A3 80,A4 0,A5 45,A6 0}"), ("TWC_KIND", "1"), ("TWC_RATIO", "100"), ("TWC_WATCH", "20000"), ("TWC_CMD", "77")]:
    client.write(name, value, debug=False)
until = time.time() + 20
while time.time() < until and client.read("TWC_DONE", debug=False) != b"77":
    time.sleep(0.01)
said["axes"] = client.read("$AXIS_ACT", debug=False).decode()
said["result"] = client.read("TWC_RESULT", debug=False).decode()
begun, count = time.perf_counter(), 0
while time.perf_counter() - begun < 1.0:
    client.read("$AXIS_ACT", debug=False)
    count += 1
said["reads"] = count / (time.perf_counter() - begun)
client.close()
print(json.dumps(said))
`;

const SKIPPED = hasOpenShowVar ? "" : " (no Python with py-openshowvar: name one by TWINCELL_PYTHON)";
test.skipIf(!hasOpenShowVar)(
  `py-openshowvar 1.1.7, a client that nobody here wrote, reads, writes and moves the virtual KUKA${SKIPPED}`,
  async () => {
    const { kuka, port } = await virtualKuka("127.0.0.34");
    const { code, out } = await python(CLIENT, "127.0.0.34", String(port));
    expect(out.trim().split("\n").at(-1)).toMatch(/^\{/);
    expect(code).toBe(0);
    const said = JSON.parse(out.trim().split("\n").at(-1)!) as Record<string, unknown>;
    expect(said).toMatchObject({
      can: true,
      $MODE_OP: "#EX",
      $PRO_STATE1: "#P_ACTIVE",
      $OV_PRO: "100",
      PING: "PONG",
      override: "40",
      refused: null,
      unknown: null,
      result: "1",
    });
    expect(said["$AXIS_ACT"]).toMatch(/^\{E6AXIS: A1 0\.0, A2 -90\.0, A3 90\.0/);
    expect(said["axes"]).toMatch(/^\{E6AXIS: A1 10\.0, A2 -80\.0, A3 80\.0, A4 0\.0, A5 45\.0/);
    expect(kuka.arm.jointAngle(1)).toBeCloseTo((10 * Math.PI) / 180, 6);
    expect(said["reads"]).toBeGreaterThan(200);
    if (process.env["TWINCELL_SHOW"])
      process.stdout.write(`py-openshowvar: ${Math.round(Number(said["reads"]))} reads/s\n`);
  },
  60_000,
);
