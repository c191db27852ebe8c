/**
 * RSI on the system's own sockets, against RSIPI 0.3.0 both ways: its client moves our virtual robot, and our driver
 * moves its robot. The Python that has it is named by TWINCELL_PYTHON, or is the python3 of the path:
 *   pip install RSIPI==0.3.0
 */
import {
  axisConfig,
  createKukaRsiAdapter,
  createRealController,
  createVirtualKuka,
  readRsiConfig,
  rsiConfigText,
  RSI_NAME,
  startLoop,
} from "@twincell/controllers";
import { robotById } from "@twincell/core";
import { krl } from "@twincell/languages";
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { setTimeout as pause } from "node:timers/promises";
import { afterEach, expect, test } from "vitest";
import { nodeScheduler } from "./clock.ts";
import { nodeNetwork } from "./sockets/node-network.ts";

const robot = robotById("kuka_kr6r900sixx")!;
const network = nodeNetwork();
const scheduler = nodeScheduler;
const DEG = Math.PI / 180;
/** Robot and driver share one processor here with whatever else it does. */
const PATIENT_S = 1;
const open: (() => void)[] = [];
afterEach(() => {
  for (const close of open.splice(0).reverse()) close();
});

const PYTHON = process.env["TWINCELL_PYTHON"] ?? "python3";
function python(
  script: string,
  args: readonly string[] = [],
  cwd = tmpdir(),
): { readonly ended: Promise<{ code: number; out: string }>; stop(): void } {
  const child = spawn(PYTHON, ["-c", script, ...args], { stdio: ["pipe", "pipe", "pipe"], cwd });
  let out = "";
  for (const stream of [child.stdout, child.stderr])
    stream.on("data", (chunk: Buffer) => {
      out += chunk.toString();
    });
  child.stdin.on("error", () => {
    /* It has gone already. */
  });
  return {
    stop() {
      child.stdin.end();
    },
    ended: new Promise(resolve => {
      child.once("error", problem => {
        resolve({ code: -1, out: problem.message });
      });
      child.once("close", code => {
        resolve({ code: code ?? -1, out });
      });
    }),
  };
}
const has =
  (await python("import importlib.util as u, sys; sys.exit(0 if u.find_spec('RSIPI') else 1)").ended).code === 0;
const SKIPPED = has ? "" : " (no Python with RSIPI: name one by TWINCELL_PYTHON)";
/** A folder of its own: RSIPI keeps its log where it is started. */
function folder(): string {
  const made = mkdtempSync(join(tmpdir(), "twincell-rsi-"));
  open.push(() => {
    rmSync(made, { recursive: true, force: true });
  });
  return made;
}
const lastJson = (out: string): Record<string, number> => {
  const line = out
    .trim()
    .split("\n")
    .findLast(each => each.startsWith("{"));
  if (line === undefined) throw new Error(out);
  return JSON.parse(line) as Record<string, number>;
};

const CLIENT = `
import json, sys, time
if __name__ == "__main__":
    from RSIPI import RSIAPI
    api = RSIAPI(sys.argv[1], rsi_mode="relative")
    api.start()
    connected = api.wait_for_connection(15)
    before = api.motion.get_current_joints()
    api.motion.update_joints(A1=0.02)
    time.sleep(1.0)
    api.motion.update_joints(A1=0.0)
    time.sleep(0.5)
    after = api.motion.get_current_joints()
    pose = api.motion.get_current_pose()
    print(json.dumps({"connected": int(connected), "before": before["A1"], "after": after["A1"], "a2": after["A2"], "x": pose["X"]}), flush=True)
    sys.stdin.read()
    api.stop()
`;
const WHERE =
  "import RSIPI, os; print(os.path.join(os.path.dirname(RSIPI.__file__), 'contexts', 'RSI_EthernetConfig_Joints.xml'))";

test.skipIf(!has)(
  `the client of RSIPI moves the virtual KUKA, by its own file of the robot${SKIPPED}`,
  async () => {
    const where = folder();
    const source = (await python(WHERE).ended).out.trim().split("\n").at(-1)!;
    const read = readRsiConfig(readFileSync(source, "utf8"));
    if (read.kind !== "read") throw new Error(read.sentence);
    const config = { ...read.config, ip: "127.0.0.1", port: 49_361 };
    const file = join(where, "config.xml");
    writeFileSync(file, rsiConfigText(config));
    const kuka = await createVirtualKuka({
      robot,
      scheduler,
      network,
      host: "127.0.0.35",
      port: 0,
      interpret: text => krl.interpret(text, robot),
      rsi: { config, timeout: 100_000 },
    });
    open.push(() => {
      kuka.close();
    });
    expect(startLoop(kuka, RSI_NAME)).toBeNull();
    let out = "";
    const client = python(CLIENT, [file], where);
    open.push(() => {
      client.stop();
    });
    for (let i = 0; i < 400 && kuka.arm.jointAngle(1) === 0; i++) await pause(50);
    await pause(2500);
    client.stop();
    ({ out } = await client.ended);
    const said = lastJson(out);
    const is_deg = kuka.arm.jointAngle(1) / DEG;
    expect(said["connected"]).toBe(1);
    expect(said["after"]! - said["before"]!).toBeGreaterThan(1);
    expect(said["after"]).toBeCloseTo(is_deg, 4);
    expect(said["a2"]).toBeCloseTo(-90, 4);
    // Shown, not judged: the timing of an interpreter on a shared machine.
    if (process.env["TWINCELL_SHOW"])
      process.stdout.write(`RSIPI client: A1 by ${is_deg.toFixed(3)}°, ${kuka.rsiDelay} late\n`);
  },
  60_000,
);

const ROBOT = `
import json, socket, sys, threading
bind = socket.socket.bind
socket.socket.bind = lambda self, at: bind(self, ("127.0.0.1", at[1]))
from RSIPI.rsi_echo_server import EchoServer
server = EchoServer(sys.argv[1], delay_ms=4, mode="relative", timeout_packets=100000)
server.start()
sys.stdin.read()
server.running = False
print(json.dumps({"a1": server.state["AIPos"]["A1"], "a3": server.state["AIPos"]["A3"], "faulty": server.faulty_packets, "sent": (server.ipoc_value - server.first_ipoc) // 4}), flush=True)
`;

test.skipIf(!has)(
  `our driver moves the robot of RSIPI${SKIPPED}`,
  async context => {
    const place = await network.bind({ host: "127.0.0.1", port: 50_000 });
    if (place.kind === "taken") {
      context.skip("UDP 50000, where the robot of RSIPI always sits, is taken.");
      return;
    }
    place.socket.close();
    await pause(50);
    const where = folder();
    const config = axisConfig("127.0.0.1", 49_362);
    const file = join(where, "config.xml");
    writeFileSync(file, rsiConfigText(config));
    // Mode and stops come over variables, which RSIPI's robot has not: ours says them.
    const kuka = await createVirtualKuka({
      robot,
      scheduler,
      network,
      host: "127.0.0.36",
      port: 0,
      interpret: text => krl.interpret(text, robot),
    });
    open.push(() => {
      kuka.close();
    });
    startLoop(kuka);
    if (kuka.listening.kind === "taken") throw new Error(kuka.listening.sentence);
    const real = createRealController({
      face: createKukaRsiAdapter({
        robot,
        scheduler,
        network,
        host: "127.0.0.36",
        port: kuka.listening.address.port,
        config,
        stale_s: PATIENT_S,
      }),
      scheduler,
    });
    open.push(() => {
      real.close();
    });
    let samples = 0;
    real.onSample(() => {
      samples++;
    });
    expect(await real.connect()).toEqual({ kind: "done" });
    const peer = python(ROBOT, [file], where);
    open.push(() => {
      peer.stop();
    });
    // It stands at zero on all axes, where ours does not.
    for (let i = 0; i < 400 && real.jointAngle(2) !== 0; i++) await pause(50);
    expect(real.jointAngle(2)).toBe(0);
    expect(await real.moveJoints([12.5 * DEG, 0, 7.25 * DEG, 0, 0, 0])).toEqual({ kind: "done" });
    // Long enough to count: its own pace depends on the machine.
    while (samples < 250) await pause(20);
    // Two digits are what it says.
    expect(real.jointAngle(1) / DEG).toBeCloseTo(12.5, 2);
    peer.stop();
    const said = lastJson((await peer.ended).out);
    expect(said["a1"]).toBeCloseTo(12.5, 2);
    expect(said["a3"]).toBeCloseTo(7.25, 2);
    expect(said["sent"]).toBeGreaterThan(100);
    if (process.env["TWINCELL_SHOW"])
      process.stdout.write(`RSIPI robot: A1 ${said["a1"]!.toFixed(4)}°, ${said["faulty"]} of ${said["sent"]} faulty\n`);
  },
  60_000,
);
