/**
 * Universal Robots on the system's own sockets: our driver, and clients that nobody here wrote. The Python that has
 * them is named by TWINCELL_PYTHON, or is the python3 of the path:
 *   pip install ur_rtde==1.6.5 urx==0.11.0
 * and UR's own RTDE client from its public repository.
 */
import { createRealController, createUrAdapter, createVirtualUr, type VirtualUr } from "@twincell/controllers";
import { robotById } from "@twincell/core";
import { urScript } from "@twincell/languages";
import { spawn, spawnSync } from "node:child_process";
import { connect } from "node:net";
import { setTimeout as pause } from "node:timers/promises";
import { afterEach, describe, expect, test } from "vitest";
import { nodeScheduler } from "./clock.ts";
import { nodeNetwork } from "./sockets/node-network.ts";

const robot = robotById("ur10e")!;
const network = nodeNetwork();
const scheduler = nodeScheduler;
const ACCURACY_RAD = (0.001 * Math.PI) / 180;
const python = process.env["TWINCELL_PYTHON"] ?? "python3";
const has = (module: string): boolean => spawnSync(python, ["-c", `import ${module}`]).status === 0;
const noUrRtde = !has("rtde_control");
const noRtde = !has("rtde.rtde");
const noUrx = !has("urx.urrtmon");
const open: { close(): void }[] = [];
afterEach(() => {
  for (const each of open.splice(0).reverse()) each.close();
});

/** Foreign clients know the vendor's ports only: several controllers stand on one machine by address. */
async function virtualUr(host: string): Promise<{ ur: VirtualUr; log: string[] }> {
  const log: string[] = [];
  const started = await createVirtualUr({
    robot,
    scheduler,
    network,
    host,
    interpret: text => urScript.interpret(text, robot),
    log: sentence => {
      log.push(sentence);
    },
  });
  if (started.kind === "taken") throw new Error(started.sentence);
  open.push(started.virtual);
  return { ur: started.virtual, log };
}
async function driver(host: string) {
  const real = createRealController({ face: createUrAdapter({ robot, scheduler, network, host }), scheduler });
  open.push(real);
  expect(await real.connect()).toEqual({ kind: "done" });
  return real;
}
const farthest = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(a, (q, i) => Math.abs(q - b[i]!)));
const near = (by_rad: number): number[] => Array.from(robot.home_rad, q => q + by_rad);

/** Runs a Python client while the controller goes on here; what it prints last is JSON. */
function client(host: string, text: string): Promise<Record<string, unknown>> {
  return new Promise((resolve, reject) => {
    const child = spawn(python, ["-c", text, host], { stdio: ["ignore", "pipe", "pipe"] });
    let out = "";
    let err = "";
    open.push({
      close() {
        child.kill("SIGKILL");
      },
    });
    child.stdout.on("data", (chunk: Buffer) => {
      out += chunk.toString();
    });
    child.stderr.on("data", (chunk: Buffer) => {
      err += chunk.toString();
    });
    child.on("close", code => {
      const last = out.trim().split("\n").at(-1) ?? "";
      if (code === 0 && last.startsWith("{")) resolve(JSON.parse(last) as Record<string, unknown>);
      else reject(new Error(`The client ended with ${code}: ${err}${out}`));
    });
  });
}

describe("Universal Robots on real sockets", () => {
  test("T-22 T-23 the driver moves the virtual controller over the loopback on the vendor's own ports", async () => {
    const { ur } = await virtualUr("127.0.0.41");
    const real = await driver("127.0.0.41");
    let samples = 0;
    real.onSample(() => {
      samples++;
    });
    // A machine that does much else may stall this process past the watchdog of the robot: then it stops, as it should,
    // and is told again.
    let outcome = await real.moveJoints(near(0.3));
    for (let tries = 1; tries < 5 && outcome.kind !== "done"; tries++) {
      await pause(1000);
      outcome = await real.moveJoints(near(0.3));
    }
    expect(outcome).toEqual({ kind: "done" });
    await pause(50);
    expect(samples).toBeGreaterThan(100);
    for (const is of [real.jointAngles(), ur.jointAngles()])
      expect(farthest(is, near(0.3))).toBeLessThanOrEqual(ACCURACY_RAD);
    const moving = real.moveJoints(near(-0.3));
    await pause(200);
    real.stop();
    expect((await moving).kind).toBe("stopped");
    real.disconnect();
    expect(real.isConnected).toBe(false);
  });

  test("a program as it is exported runs on the controller through the language's own interpreter", async () => {
    const { ur } = await virtualUr("127.0.0.42");
    const real = await driver("127.0.0.42");
    const text =
      "def exported():\n  set_standard_digital_out(1, True)\n  movej([0.2, -1.4, 1.4, -1.5, -1.5, 0.1], v=2)\n  sleep(0.1)\n  set_standard_digital_out(1, False)\nend\n";
    const running = real.runText!([{ name: "exported.script", text, lines: [] }]);
    await pause(300);
    expect(ur.digitalOut(1)).toBe(true);
    expect(await running).toEqual({ kind: "done" });
    expect(ur.digitalOut(1)).toBe(false);
    expect(farthest(ur.jointAngles(), [0.2, -1.4, 1.4, -1.5, -1.5, 0.1])).toBeLessThanOrEqual(ACCURACY_RAD);
  });

  test("any bytes on any port end that connection, and the next one is served", async () => {
    const { ur, log } = await virtualUr("127.0.0.43");
    // The read-only copies do not even look at what comes.
    for (const port of Object.entries(ur.ports)
      .filter(([name]) => !name.endsWith("Copy"))
      .map(([, number]) => number)) {
      await new Promise<void>(resolve => {
        const socket = connect({ host: "127.0.0.43", port }, () => {
          socket.write(Buffer.alloc(1 << 20, "\u0000\u0001x"));
        });
        socket.resume();
        socket.on("error", () => {
          /* The other side hung up, as it should. */
        });
        socket.on("close", () => {
          resolve();
        });
      });
    }
    expect(log).toHaveLength(5);
    const real = await driver("127.0.0.43");
    expect(real.isConnected).toBe(true);
  });

  test.skipIf(noUrRtde)(
    `ur_rtde receives, sets outputs and the slider, and moves the robot with its own control script${noUrRtde ? " (skipped: it is not installed)" : ""}`,
    async () => {
      const { ur, log } = await virtualUr("127.0.0.44");
      const told = await client("127.0.0.44", UR_RTDE);
      expect(told).toMatchObject({
        connected: true,
        robotMode: 7,
        safetyMode: 1,
        output: true,
        slider: 0.5,
        ready: true,
        moveJ: true,
        moveL: true,
        speedJ: true,
        servo: true,
        stopped: 0,
        program: true,
      });
      // The controller's own clock: 2 ms from one state to the next, however late they are read.
      expect(told["step_s"]).toBeCloseTo(0.002, 9);
      for (const key of ["joint_error", "pose_error", "ik_error", "fk_error", "servo_error"])
        expect(told[key], key).toBeLessThan(1e-5);
      expect(told["speed"]).toBeCloseTo(0.2, 6);
      expect(told["offset"]).toEqual([0, 0, 0.1, 0, 0, 0]);
      expect(told["protective"]).toEqual({ stopped: true, moveJ: false });
      expect(ur.digitalOut(3)).toBe(true);
      expect(log.filter(sentence => sentence.startsWith("RTDE: "))).toEqual([]);
    },
    60_000,
  );

  test.skipIf(noUrx)(
    `urx reads joints and the tool from the real-time interface${noUrx ? " (skipped: it is not installed)" : ""}`,
    async () => {
      const { ur } = await virtualUr("127.0.0.47");
      const told = await client(
        "127.0.0.47",
        `
import json, sys, time
from urx.urrtmon import URRTMonitor
monitor = URRTMonitor(sys.argv[1])
monitor.daemon = True
monitor.start()
time.sleep(1)
print(json.dumps({"q": list(monitor.q_actual()), "tcp": list(monitor.tcf_pose())}))
`,
      );
      expect(farthest(told["q"] as number[], ur.jointAngles())).toBeLessThan(1e-12);
      const slot = ur.memory.slotOf("actual_TCP_pose");
      expect(farthest(told["tcp"] as number[], ur.memory.slots.subarray(slot, slot + 6))).toBeLessThan(1e-12);
    },
    30_000,
  );

  test.skipIf(noRtde)(
    `UR's own RTDE client receives 125 states a second and writes registers${noRtde ? " (skipped: it is not installed)" : ""}`,
    async () => {
      const { ur } = await virtualUr("127.0.0.45");
      const told = await client("127.0.0.45", UR_CLIENT);
      expect(told).toMatchObject({
        version: [5, 12, 0, 1_101_319],
        started: true,
        mode: 7,
        q: Array.from(robot.home_rad),
        types: "INT32,DOUBLE",
      });
      // It leaves out states that were overtaken by newer ones; what it keeps is on the raster of 8 ms.
      expect(told["off_raster_s"]).toBeLessThan(1e-6);
      expect([ur.memory.get("input_int_register_24"), ur.memory.get("input_double_register_24")]).toEqual([42, -0.5]);
    },
    60_000,
  );
});

const UR_RTDE = `
import json, sys, time
from rtde_receive import RTDEReceiveInterface
from rtde_io import RTDEIOInterface
from rtde_control import RTDEControlInterface
host, told = sys.argv[1], {}
worst = lambda a, b: max(abs(x - y) for x, y in zip(a, b))
r = RTDEReceiveInterface(host)
told.update(connected=r.isConnected(), robotMode=r.getRobotMode(), safetyMode=r.getSafetyMode())
times = set()
end = time.time() + 0.5
while time.time() < end:
    times.add(r.getTimestamp()); time.sleep(0.0005)
times = sorted(times)
told["step_s"] = min(b - a for a, b in zip(times, times[1:]))
io = RTDEIOInterface(host)
io.setStandardDigitalOut(3, True); io.setSpeedSlider(0.5); time.sleep(0.2)
told.update(output=r.getDigitalOutState(3), slider=r.getTargetSpeedFraction())
io.setSpeedSlider(1.0)
c = RTDEControlInterface(host)
told["ready"] = c.isProgramRunning()
q = r.getActualQ(); q[0] += 0.5; q[5] -= 0.2
told["moveJ"] = c.moveJ(q, 2.0, 4.0); time.sleep(0.05)
told["joint_error"] = worst(r.getActualQ(), q)
p = r.getActualTCPPose(); p[2] += 0.05
told["moveL"] = c.moveL(p, 0.25, 1.2); time.sleep(0.05)
told["pose_error"] = worst(r.getActualTCPPose(), p)
told["ik_error"] = worst(c.getInverseKinematics(r.getActualTCPPose()), r.getActualQ())
told["fk_error"] = worst(c.getForwardKinematics()[:3], r.getActualTCPPose()[:3])
told["speedJ"] = c.speedJ([0.2, 0, 0, 0, 0, 0], 2.0, 0); time.sleep(0.5)
told["speed"] = r.getActualQd()[0]
c.speedStop(); time.sleep(0.05)
told["stopped"] = max(abs(v) for v in r.getActualQd())
goal = r.getActualQ()
for i in range(100):
    begun = c.initPeriod(); goal[5] += 0.0005; told["servo"] = c.servoJ(goal, 0, 0, 0.002, 0.1, 300); c.waitPeriod(begun)
time.sleep(2.0)
told["servo_error"] = worst(r.getActualQ(), goal)
c.servoStop()
c.setTcp([0, 0, 0.1, 0, 0, 0]); told["offset"] = c.getTCPOffset()
told["program"] = c.isProgramRunning()
c.triggerProtectiveStop(); time.sleep(0.2)
told["protective"] = {"stopped": r.isProtectiveStopped(), "moveJ": c.moveJ(q, 1, 1)}
print(json.dumps(told))
sys.stdout.flush()
import os; os._exit(0)
`;

const UR_CLIENT = `
import json, sys, time
import rtde.rtde as rtde
con = rtde.RTDE(sys.argv[1], 30004)
con.connect()
told = {"version": list(con.get_controller_version())}
con.send_output_setup(["timestamp", "actual_q", "robot_mode"], ["DOUBLE", "VECTOR6D", "INT32"], frequency=125)
setup = con.send_input_setup(["input_int_register_24", "input_double_register_24"], ["INT32", "DOUBLE"])
told["types"] = ",".join(["INT32", "DOUBLE"])
told["started"] = con.send_start()
setup.input_int_register_24, setup.input_double_register_24 = 42, -0.5
con.send(setup)
times = []
for _ in range(100):
    state = con.receive(); times.append(state.timestamp)
told["off_raster_s"] = max(abs((b - a) / 0.008 - round((b - a) / 0.008)) * 0.008 for a, b in zip(times, times[1:]))
told["mode"], told["q"] = state.robot_mode, list(state.actual_q)
con.send_pause(); con.disconnect()
print(json.dumps(told))
`;
