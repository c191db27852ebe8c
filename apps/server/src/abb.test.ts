/**
 * ABB's externally guided motion and Robot Web Services on the system's own sockets: our driver, and a client that
 * nobody here wrote. The Python that has it is named by TWINCELL_PYTHON, or is the python3 of the path:
 *   pip install abb-robot-client==0.4.0
 */
import { abbAdapter, createRealController, createVirtualAbb, type VirtualAbb } from "@twincell/controllers";
import { degrees, emptyProgram, robotById } from "@twincell/core";
import { dialectById } from "@twincell/languages";
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { setTimeout as pause } from "node:timers/promises";
import { afterEach, expect, test } from "vitest";
import { nodeScheduler } from "./clock.ts";
import { nodeNetwork } from "./sockets/node-network.ts";
import { freeDatagramPort } from "./testing/free-port.ts";

const robot = robotById("abb_irb120")!;
const rapid = dialectById("rapid")!;
const network = nodeNetwork();
const scheduler = nodeScheduler;
const ACCURACY_RAD = (0.001 * Math.PI) / 180;
/**
 * On a machine that runs other tests beside this one a state may be late; how soon silence is noticed is shown in
 * virtual time.
 */
const BUSY_S = 3;
const open: { close(): void }[] = [];
afterEach(() => {
  for (const each of open.splice(0).reverse()) each.close();
});

async function virtualAbb(host: string, port: number): Promise<VirtualAbb> {
  const started = await createVirtualAbb({
    robot,
    scheduler,
    network,
    host,
    sensor: { host, port },
    rws: 0,
    interpret: text => rapid.interpret(text, robot),
    commTimeout_s: BUSY_S,
  });
  if (started.kind === "taken") throw new Error(started.sentence);
  open.push(started.controller);
  return started.controller;
}

test("T-22 T-23 the driver guides the virtual controller over the loopback, on the vendor's own port", async () => {
  const host = "127.0.0.51";
  const virtual = await virtualAbb(host, 6510);
  const real = createRealController({
    face: abbAdapter({ robot, scheduler, network, host, ports: { rws: virtual.rws!.port }, stale_s: BUSY_S }),
    scheduler,
  });
  open.push(real);
  expect(await real.connect()).toEqual({ kind: "done" });
  let samples = 0;
  real.onSample(() => {
    samples++;
  });
  const target = Float64Array.from(robot.home_rad, q => q + 0.3);
  const begun_s = scheduler.now_s();
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
  // The rest goes over Robot Web Services: a program of the studio as RAPID, motors off and on.
  const q = Array.from(robot.home_rad, angle => angle + 0.1);
  const emitted = rapid.emit(
    {
      ...emptyProgram(robot.id, "job"),
      steps: [{ id: "a", type: "move", path: "ptp", target: { q }, speed: { ratio: 1 }, blend_m: 0 }],
    },
    robot,
  );
  if (emitted.kind === "cannot") throw new Error(emitted.sentence);
  expect(await real.runText!(emitted.files)).toEqual({ kind: "done" });
  q.forEach((angle, i) => {
    expect(virtual.neutral.jointAngle(i + 1)).toBeCloseTo(angle, 4);
  });
  real.stop(true);
  for (let i = 0; i < 100 && virtual.cabinet.motorsOn; i++) await pause(20);
  expect(virtual.cabinet.state).toBe("motoroff");
  void real.reset();
  for (let i = 0; i < 200 && !virtual.programs.isRunning; i++) await pause(20);
  expect([virtual.cabinet.state, virtual.programs.isRunning]).toEqual(["motoron", true]);
}, 60_000);

const PYTHON = process.env["TWINCELL_PYTHON"] ?? "python3";
const hasClient = spawnSync(PYTHON, ["-c", "import abb_robot_client.egm, abb_robot_client.rws"]).status === 0;
const python = (program: string, ...args: string[]): Promise<{ code: number; out: string }> =>
  new Promise(resolve => {
    const child = spawn(PYTHON, ["-c", program, ...args], { stdio: ["ignore", "pipe", "pipe"], timeout: 60_000 });
    let said = "";
    for (const stream of [child.stdout, child.stderr])
      stream.on("data", (chunk: Buffer) => {
        said += chunk.toString();
      });
    child.once("error", problem => {
      resolve({ code: -1, out: problem.message });
    });
    child.once("close", ended => {
      resolve({ code: ended ?? -1, out: said });
    });
  });
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
test.skipIf(!hasClient)(
  `abb-robot-client, a client that nobody here wrote, guides the virtual controller${hasClient ? "" : " (skipped: no Python with abb-robot-client; name one by TWINCELL_PYTHON)"}`,
  async () => {
    const host = "127.0.0.52";
    const port = await freeDatagramPort(host);
    const virtual = await virtualAbb(host, port);
    const { code, out } = await python(GUIDE, String(port));
    expect(code, out).toBe(0);
    const said = JSON.parse(out.trim().split("\n").at(-1)!) as {
      first: number[];
      last: number[];
      motors: boolean;
      rapid: boolean;
      rate: number;
    };
    said.first.forEach((angle, i) => {
      expect(angle).toBeCloseTo(degrees(robot.home_rad[i]!), 9);
    });
    expect(said).toMatchObject({ motors: true, rapid: true });
    expect(said.last[0]! - said.first[0]!).toBeCloseTo(20, 2);
    expect(degrees(virtual.neutral.jointAngle(1)) - said.first[0]!).toBeCloseTo(20, 2);
    expect(said.rate).toBeGreaterThan(20);
    if (process.env["TWINCELL_SHOW"]) process.stdout.write(`abb-robot-client: ${Math.round(said.rate)} messages/s\n`);
  },
  90_000,
);

const SERVICES = `
import json, sys, time
from abb_robot_client.rws import RWS, ABBException
rws, said = RWS(sys.argv[1]), {}
said["state"], said["mode"], said["speed"] = rws.get_controller_state(), rws.get_operation_mode(), rws.get_speedratio()
said["running"], said["tasks"] = rws.get_execution_state().ctrlexecstate, {name: [task.type_, task.active, task.motiontask] for name, task in rws.get_tasks().items()}
said["joints"], said["trans"] = list(rws.get_jointtarget().robax), list(rws.get_robtarget().trans)
rws.set_digital_io("DO2", 1)
said["io"] = [rws.get_digital_io("DO2"), rws.get_digital_io("DI4")]
rws.set_analog_io("AO1", 1.5)
said["analogue"] = rws.get_analog_io("AO1")
module = open(sys.argv[2], "rb").read()
rws.upload_file("$home/job.mod", module)
said["same"], said["files"] = rws.read_file("$home/job.mod") == module, sorted(rws.list_files("$home"))
rws.stop()
while rws.get_execution_state().ctrlexecstate != "stopped": time.sleep(0.02)
rws._do_post("rw/rapid/tasks/T_ROB1?action=unloadmod", {"module": "TwincellEGM"})
rws._do_post("rw/rapid/tasks/T_ROB1?action=loadmod", {"modulepath": "$home/job.mod"})
rws.set_rapid_variable_num("job/parts", 12.5)
said["number"], said["variables"] = rws.get_rapid_variable_num("job/parts"), [each["name"] for each in rws.get_rapid_variables()]
rws.set_speedratio(50)
rws.resetpp()
rws.start(cycle="once")
said["started"] = rws.get_execution_state().ctrlexecstate
begun = time.perf_counter()
while rws.get_execution_state().ctrlexecstate != "stopped" and time.perf_counter() - begun < 20: time.sleep(0.02)
said["end"], said["lamp"] = list(rws.get_jointtarget().robax), rws.get_digital_io("lamp")
rws.set_controller_state("motoroff")
said["off"] = rws.get_controller_state()
try: rws.start()
except ABBException as refused: said["refused"] = [refused.code, str(refused)]
rws.set_controller_state("motoron")
rws.delete_file("$home/job.mod")
said["left"], said["log"], said["disk"] = rws.list_files("$home"), [[entry.code, entry.title] for entry in rws.read_event_log()][:3], rws.get_ramdisk_path()
rws.close()
print(json.dumps(said))
`;
test.skipIf(!hasClient)(
  `abb-robot-client reads and drives the virtual controller over Robot Web Services: states, signals, data, files, a program from start to end${hasClient ? "" : " (skipped: no Python with abb-robot-client; name one by TWINCELL_PYTHON)"}`,
  async () => {
    const host = "127.0.0.53";
    const virtual = await virtualAbb(host, await freeDatagramPort(host));
    const folder = mkdtempSync(`${tmpdir()}/twincell-abb-`);
    const file = `${folder}/job.mod`;
    open.push({
      close() {
        rmSync(folder, { recursive: true });
      },
    });
    const goal = Array.from(robot.home_rad, (angle, i) => degrees(angle) + (i === 0 ? 25 : 0));
    writeFileSync(
      file,
      `MODULE job\n  PERS num parts:=3;\n  PROC main()\n    SetDO lamp,1;\n    MoveAbsJ [[${goal.map(angle => angle.toFixed(4)).join(",")}],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;\n  ENDPROC\nENDMODULE\n`,
    );
    virtual.pendant.setInput("DI4", true);
    const { code, out } = await python(SERVICES, `http://${host}:${virtual.rws!.port}`, file);
    expect(code, out).toBe(0);
    const said = JSON.parse(out.trim().split("\n").at(-1)!) as {
      joints: number[];
      end: number[];
      trans: number[];
      off: string;
    };
    expect(said).toMatchObject({
      state: "motoron",
      mode: "AUTO",
      speed: 100,
      running: "running",
      tasks: { T_ROB1: ["norm", true, true] },
      io: [1, 1],
      analogue: 1.5,
      same: true,
      files: ["TwincellEGM.mod", "job.mod"],
      number: 12.5,
      variables: ["parts"],
      started: "running",
      lamp: 1,
      off: "motoroff",
      refused: [-1073445859, "The controller is in the state motoroff."],
      left: ["TwincellEGM.mod"],
      disk: "$RAMDISK",
      log: [
        [10011, "Motors ON state"],
        [10010, "Motors OFF state"],
        [10123, "Program stopped"],
      ],
    });
    said.joints.forEach((angle, i) => {
      expect(angle).toBeCloseTo(degrees(robot.home_rad[i]!), 6);
    });
    said.end.forEach((angle, i) => {
      expect(angle).toBeCloseTo(goal[i]!, 3);
    });
    expect(Math.hypot(...said.trans)).toBeGreaterThan(100);
  },
  90_000,
);
