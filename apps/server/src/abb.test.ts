/**
 * ABB's externally guided motion on the system's own sockets: our driver, and a client that nobody here wrote. The Python that
 * has it is named by TWINCELL_PYTHON, or is the python3 of the path:  pip install abb-robot-client==0.4.0
 */
import { abbFace, createRealController, createVirtualAbb, type VirtualAbb } from "@twincell/controllers";
import { degrees, robotById } from "@twincell/core";
import { spawn, spawnSync } from "node:child_process";
import { createSocket } from "node:dgram";
import { setTimeout as pause } from "node:timers/promises";
import { afterEach, expect, test } from "vitest";
import { nodeScheduler } from "./clock.ts";
import { nodeNetwork } from "./sockets/node-network.ts";

const robot = robotById("abb_irb120")!, network = nodeNetwork(), scheduler = nodeScheduler, ACCURACY_RAD = 0.001 * Math.PI / 180;
/** On a machine that runs other tests beside this one a state may be late; how soon silence is noticed is shown in virtual time. */
const BUSY_S = 3;
const open: { close(): void }[] = [];
afterEach(() => { for (const each of open.splice(0).reverse()) each.close(); });

async function virtualAbb(host: string, port: number): Promise<VirtualAbb> {
  const started = await createVirtualAbb({ robot, scheduler, network, host, sensor: { host, port }, commTimeout_s: BUSY_S });
  if (started.kind === "taken") throw new Error(started.sentence);
  open.push(started.controller);
  return started.controller;
}
/** A port that nobody has. */
const freePort = (host: string): Promise<number> => new Promise(resolve => {
  const socket = createSocket("udp4");
  socket.bind(0, host, () => { const { port } = socket.address(); socket.close(() => { resolve(port); }); });
});

test("T-22 T-23 the driver guides the virtual controller over the loopback, on the vendor's own port", async () => {
  const host = "127.0.0.51", virtual = await virtualAbb(host, 6510), real = createRealController({ face: abbFace({ robot, scheduler, network, host, stale_s: BUSY_S }), scheduler });
  open.push(real);
  expect(await real.connect()).toEqual({ kind: "done" });
  let samples = 0;
  real.onSample(() => { samples++; });
  const target = Float64Array.from(robot.home_rad, q => q + 0.3), begun_s = scheduler.now_s();
  expect(await real.moveJoints(target)).toEqual({ kind: "done" });
  expect(samples / (scheduler.now_s() - begun_s)).toBeGreaterThan(20);
  target.forEach((q, i) => {
    expect(Math.abs(real.jointAngle(i + 1) - q)).toBeLessThanOrEqual(ACCURACY_RAD);
    expect(Math.abs(virtual.neutral.jointAngle(i + 1) - q)).toBeLessThanOrEqual(ACCURACY_RAD);
  });
  const moving = real.moveJoints(robot.home_rad.with(0, -1.5));
  await pause(150);
  real.stop();
  expect((await moving).kind).toBe("stopped");
});

const PYTHON = process.env["TWINCELL_PYTHON"] ?? "python3", hasClient = spawnSync(PYTHON, ["-c", "import abb_robot_client.egm"]).status === 0;
const GUIDE = `
import json, sys, time
import numpy as np
from abb_robot_client.egm import EGM
egm, target, first, seen = EGM(int(sys.argv[1])), None, None, 0
begun = time.perf_counter()
while time.perf_counter() - begun < 20.0:
    ok, state = egm.receive_from_robot(1.0)
    if not ok: continue
    seen += 1
    if first is None: first, target = state, np.array(state.joint_angles)
    target[0] = min(target[0] + 0.2, first.joint_angles[0] + 20.0)
    egm.send_to_robot(target)
    if abs(state.joint_angles[0] - first.joint_angles[0] - 20.0) < 0.001: break
print(json.dumps({"first": list(first.joint_angles), "last": list(state.joint_angles), "motors": bool(state.motors_on), "rapid": bool(state.rapid_running), "rate": seen / (time.perf_counter() - begun)}))
egm.close()
`;
test.skipIf(!hasClient)(`abb-robot-client, a client that nobody here wrote, guides the virtual controller${hasClient ? "" : " (skipped: no Python with abb-robot-client; name one by TWINCELL_PYTHON)"}`, async () => {
  const host = "127.0.0.52", port = await freePort(host), virtual = await virtualAbb(host, port);
  const { code, out } = await new Promise<{ code: number; out: string }>(resolve => {
    const child = spawn(PYTHON, ["-c", GUIDE, String(port)], { stdio: ["ignore", "pipe", "pipe"], timeout: 60_000 });
    let said = "";
    for (const stream of [child.stdout, child.stderr]) stream.on("data", (chunk: Buffer) => { said += chunk.toString(); });
    child.once("error", problem => { resolve({ code: -1, out: problem.message }); });
    child.once("close", ended => { resolve({ code: ended ?? -1, out: said }); });
  });
  expect(code, out).toBe(0);
  const said = JSON.parse(out.trim().split("\n").at(-1)!) as { first: number[]; last: number[]; motors: boolean; rapid: boolean; rate: number };
  said.first.forEach((angle, i) => { expect(angle).toBeCloseTo(degrees(robot.home_rad[i]!), 9); });
  expect(said).toMatchObject({ motors: true, rapid: true });
  expect(said.last[0]! - said.first[0]!).toBeCloseTo(20, 2);
  expect(degrees(virtual.neutral.jointAngle(1)) - said.first[0]!).toBeCloseTo(20, 2);
  expect(said.rate).toBeGreaterThan(20);
  if (process.env["TWINCELL_SHOW"]) process.stdout.write(`abb-robot-client: ${Math.round(said.rate)} messages/s\n`);
}, 90_000);
