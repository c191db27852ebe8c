/**
 * Yaskawa on the system's own sockets: our driver, and clients and a server that nobody here wrote, where they are:
 * TWINCELL_FS100 is the path of fs100.py (github.com/hsinkoyu/fs100), TWINCELL_MOTO_HSES the folder of the built
 * programs of moto-hses 0.4 (cargo build --release --bins --examples), which has `server` and `examples/` in it.
 */
import {
  createRealController,
  createVirtualYaskawa,
  yaskawaExampleScale,
  yaskawaAdapter,
  type VirtualYaskawa,
  type YaskawaAdapterOptions,
} from "@twincell/controllers";
import { emptyProgram, robotById, type EmittedFile, type Program } from "@twincell/core";
import { inform } from "@twincell/languages";
import { spawn, spawnSync } from "node:child_process";
import { createSocket } from "node:dgram";
import { existsSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { setTimeout as pause } from "node:timers/promises";
import { afterEach, describe, expect, test } from "vitest";
import { nodeScheduler } from "./clock.ts";
import { nodeNetwork } from "./sockets/node-network.ts";

const robot = robotById("yaskawa_gp8")!;
const network = nodeNetwork();
const scheduler = nodeScheduler;
const ACCURACY_RAD = (0.001 * Math.PI) / 180;
/**
 * On a machine that runs other tests beside this one a state may be late; how soon silence is noticed is shown in
 * virtual time.
 */
const BUSY_S = 3;
async function until(so: () => boolean, most_s = 10): Promise<void> {
  for (const end_s = scheduler.now_s() + most_s; !so() && scheduler.now_s() < end_s; ) await pause(10);
  expect(so()).toBe(true);
}
const open: { close(): void }[] = [];
afterEach(() => {
  for (const each of open.splice(0).reverse()) each.close();
});

async function virtualYaskawa(
  host: string,
  ports = { robot: 0, files: 0 },
): Promise<{ virtual: VirtualYaskawa; log: string[] }> {
  const log: string[] = [];
  const started = await createVirtualYaskawa({
    robot,
    scheduler,
    network,
    host,
    ports,
    servoOn_s: 0.1,
    interpret: text => inform.interpret(text, robot),
    log: line => {
      log.push(line);
    },
  });
  if (started.kind === "taken") throw new Error(started.sentence);
  open.push(started.controller);
  return { virtual: started.controller, log };
}
async function driver(host: string, ports: VirtualYaskawa["ports"], options: Partial<YaskawaAdapterOptions> = {}) {
  const real = createRealController({
    face: yaskawaAdapter({
      robot,
      scheduler,
      network,
      host,
      ports,
      scale: yaskawaExampleScale(robotById("yaskawa_gp8")!),
      stale_s: BUSY_S,
      ...options,
    }),
    scheduler,
  });
  open.push(real);
  expect(await real.connect()).toEqual({ kind: "done" });
  return real;
}
const shifted = (by_rad: number): number[] => Array.from(robot.home_rad, q => q + by_rad);
const farthest = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(a, (q, i) => Math.abs(q - b[i]!)));
function written(): readonly EmittedFile[] {
  const program: Program = {
    ...emptyProgram(robot.id, "Pick"),
    signals: { lamp: { kind: "digital-out", address: 2 } },
    steps: [
      { id: "a", type: "move", path: "ptp", target: { q: shifted(0.2) }, speed: { ratio: 0.8 }, blend_m: 0 },
      { id: "s", type: "set", signal: "lamp", to: true },
      { id: "b", type: "move", path: "lin", target: { q: shifted(0.1) }, speed: { mps: 0.2 }, blend_m: 0 },
    ],
  };
  const emitted = inform.emit(program, robot);
  if (emitted.kind === "cannot") throw new Error(emitted.sentence);
  return emitted.files;
}

describe("Yaskawa on real sockets", () => {
  test("T-22 T-23 the driver moves the virtual controller over the loopback, on the vendor's own ports", async () => {
    const { virtual } = await virtualYaskawa("127.0.0.41", { robot: 10_040, files: 10_041 });
    const real = await driver("127.0.0.41", virtual.ports);
    let samples = 0;
    real.onSample(() => {
      samples++;
    });
    const begun_s = scheduler.now_s();
    expect(await real.moveJoints(shifted(0.3))).toEqual({ kind: "done" });
    expect(samples / (scheduler.now_s() - begun_s)).toBeGreaterThan(5);
    expect(farthest(real.jointAngles(), shifted(0.3))).toBeLessThanOrEqual(ACCURACY_RAD);
    expect(farthest(virtual.neutral.jointAngles(), shifted(0.3))).toBeLessThanOrEqual(ACCURACY_RAD);
    expect(real.link.roundTrip_s).toBeLessThan(0.1);
    const moving = real.moveJoints(shifted(-0.6));
    await pause(150);
    real.stop();
    expect((await moving).kind).toBe("stopped");
    let safety = "";
    real.onSample(lent => {
      safety = lent.safety;
    });
    real.stop(true);
    await until(() => safety === "emergency-stop");
    expect(await real.moveToZero()).toMatchObject({ kind: "refused", why: { code: "safety.emergency-stop" } });
    real.disconnect();
    expect(real.isConnected).toBe(false);
  });

  test("an INFORM job goes over block by block, is started and watched to its end", async () => {
    const { virtual } = await virtualYaskawa("127.0.0.42");
    const real = await driver("127.0.0.42", virtual.ports);
    expect(await real.runText!(written())).toEqual({ kind: "done" });
    expect(farthest(real.jointAngles(), shifted(0.1))).toBeLessThanOrEqual(3 * ACCURACY_RAD);
    expect(virtual.neutral.signals.read("ot_2")).toBe(true);
    expect(virtual.files.names(".JBI")).toEqual(["PICK.JBI"]);
  });

  test("garbage on both ports is logged once and changes nothing", async () => {
    const { virtual, log } = await virtualYaskawa("127.0.0.43");
    const socket = createSocket("udp4");
    for (let i = 0; i < 200; i++)
      for (const port of [virtual.ports.robot, virtual.ports.files])
        socket.send(
          Uint8Array.from({ length: i }, (_, k) => (k * 37 + i) & 255),
          port,
          "127.0.0.43",
        );
    await until(() => log.length > 0);
    await pause(100);
    socket.close();
    expect(new Set(log).size).toBe(log.length);
    expect((await driver("127.0.0.43", virtual.ports)).isConnected).toBe(true);
  });
});

/** What a program printed, and how it ended. */
const run = (program: string, args: readonly string[], within_s: number): Promise<{ code: number; out: string }> =>
  new Promise(resolve => {
    const child = spawn(program, args, { stdio: ["ignore", "pipe", "pipe"], timeout: within_s * 1000 });
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

const PYTHON = process.env["TWINCELL_PYTHON"] ?? "python3";
const FS100 = process.env["TWINCELL_FS100"] ?? "";
const hasFs100 = existsSync(FS100) && spawnSync(PYTHON, ["--version"]).status === 0;
const CHECKS = `
import importlib.util, json, os, sys, tempfile, time
spec = importlib.util.spec_from_file_location("fs100", sys.argv[1])
fs100 = importlib.util.module_from_spec(spec)
spec.loader.exec_module(fs100)
FS100 = fs100.FS100
FS100._connect.__defaults__ = (int(sys.argv[3]),)
FS100.UDP_PORT_FILE_CONTROL = int(sys.argv[4])
robot, said = FS100(sys.argv[2]), {}
def into(name, call, kind=dict):
    box = kind()
    said[name] = [call(box), robot.errno, box]
into("alarm", robot.get_last_alarm)
into("history", lambda box: robot.read_alarm_info(1, box))
into("status", robot.get_status)
into("job", robot.read_executing_job_info)
into("axes", lambda box: robot.read_axis_name(box, 1))
into("pulses", lambda box: robot.read_position(box, 1))
into("place", lambda box: robot.read_position(box, 101))
into("error", robot.read_position_error)
into("torque", robot.read_torque)
into("system", lambda box: robot.acquire_system_info(FS100.SystemInfoType.R1, box))
into("hours", lambda box: robot.acquire_management_time(FS100.ManagementTimeType.SERVO_POWER_ON_TOTAL, box))
said["text"] = robot.show_text_on_pendant("hello")
place = {"data_type": 16, "form": 0, "tool_no": 0, "user_coor_no": 0, "extended_form": 0, "pos": (1, -2, 3, 4, 5, 6, 0, 0)}
axes = {"data_type": 0, **{f"{n}_axis": i for i, n in enumerate(["1st", "2nd", "3rd", "4th", "5th", "6th", "7th", "8th"])}}
for kind, value, number in [("IO", 129, 2701), ("REGISTER", 4660, 0), ("BYTE", 200, 1), ("INTEGER", -2, 2), ("DOUBLE", -70000, 3), ("REAL", 12.5, 4), ("STRING", "HELLO", 5), ("ROBOT_POSITION", place, 6), ("BASE_POSITION", axes, 7), ("EXTERNAL_AXIS", axes, 8)]:
    type = FS100.VarType[kind]
    wrote = robot.write_variable(FS100.Variable(type, number, value))
    variable = FS100.Variable(type, number)
    said[kind] = [wrote, robot.read_variable(variable), variable.val]
many = [FS100.Variable(FS100.VarType.INTEGER, n) for n in (1, 2, 3)]
said["many"] = [robot.read_variables(many), [v.val for v in many]]
said["unwritable"] = [robot.write_variable(FS100.Variable(FS100.VarType.IO, 1001, 1)), robot.errno]
said["cycle"] = robot.select_cycle(FS100.CYCLE_TYPE_ONE_CYCLE)
said["servo"] = [robot.switch_power(FS100.POWER_TYPE_SERVO, FS100.POWER_SWITCH_OFF), robot.play_job(), robot.errno, robot.switch_power(FS100.POWER_TYPE_SERVO, FS100.POWER_SWITCH_ON)]
time.sleep(0.5)
def stand():
    for _ in range(500):
        box = {}
        robot.get_status(box)
        if not box["running"]: return
        time.sleep(0.01)
said["pmov"] = robot.pmov(FS100.MOVE_TYPE_JOINT_ABSOLUTE_POS, FS100.MOVE_SPEED_CLASS_PERCENT, 5000, (13400, 0, 0, 0, -90000, 0, 0))
stand()
into("there", lambda box: robot.read_position(box, 1))
now = {}
robot.read_position(now, 101)
aim = list(now["pos"])[:7]
aim[2] -= 30000
said["mov"] = robot.mov(FS100.MOVE_TYPE_LINEAR_ABSOLUTE_POS, FS100.MOVE_COORDINATE_SYSTEM_BASE, FS100.MOVE_SPEED_CLASS_MILLIMETER, 2000, tuple(aim))
stand()
into("lower", lambda box: robot.read_position(box, 101))
said["aim"] = aim
said["hold"] = [robot.switch_power(FS100.POWER_TYPE_HOLD, FS100.POWER_SWITCH_ON), robot.pmov(1, 0, 100, (0, 0, 0, 0, 0, 0, 0)), robot.errno, robot.switch_power(FS100.POWER_TYPE_HOLD, FS100.POWER_SWITCH_OFF)]
said["reset"] = [robot.reset_alarm(FS100.RESET_ALARM_TYPE_ALARM), robot.reset_alarm(FS100.RESET_ALARM_TYPE_ERROR)]
with tempfile.TemporaryDirectory() as folder:
    said["send"] = robot.send_file(sys.argv[5])
    into("list", lambda box: robot.get_file_list("*.JBI", box), list)
    said["recv"] = robot.recv_file("PICK.JBI", folder)
    said["same"] = open(os.path.join(folder, "PICK.JBI"), "rb").read() == open(sys.argv[5], "rb").read()
said["select"] = [robot.select_job("NOBODY"), robot.errno, robot.select_job("PICK")]
said["play"] = robot.play_job()
stand()
into("after", lambda box: robot.read_position(box, 1))
said["delete"] = [robot.delete_file("PICK.JBI"), robot.delete_file("PICK.JBI"), robot.errno]
print(json.dumps(said))
`;

test.skipIf(!hasFs100)(
  `fs100, a client that nobody here wrote, reads, writes, moves, transfers and plays on the virtual controller${hasFs100 ? "" : " (skipped: TWINCELL_FS100 names no fs100.py)"}`,
  async () => {
    const { virtual, log } = await virtualYaskawa("127.0.0.44");
    const folder = mkdtempSync(join(tmpdir(), "twincell-hses-"));
    try {
      // Longer than one block on the wire.
      const file = join(folder, "PICK.JBI");
      const text = written()[0]!.text.replace("NOP", `NOP\r\n${"'a line that says nothing\r\n".repeat(40)}`);
      writeFileSync(file, text);
      const { code, out } = await run(
        PYTHON,
        ["-c", CHECKS, FS100, "127.0.0.44", String(virtual.ports.robot), String(virtual.ports.files), file],
        60,
      );
      expect(code, out).toBe(0);
      const said = JSON.parse(out.trim().split("\n").at(-1)!) as Record<string, unknown>;
      const pos = (name: string): number[] => (said[name] as [number, number, { pos: number[] }])[2].pos;
      for (const name of [
        "alarm",
        "history",
        "status",
        "job",
        "axes",
        "pulses",
        "place",
        "error",
        "torque",
        "system",
        "hours",
        "there",
        "lower",
        "list",
        "after",
      ])
        expect((said[name] as number[])[0], name).toBe(0);
      expect(said["status"]).toMatchObject([
        0,
        0,
        { running: false, cmd_remote: true, servo_on: true, alarming: false },
      ]);
      expect(said["axes"]).toMatchObject([0, 0, { "1st_axis": "S", "6th_axis": "T" }]);
      expect(pos("pulses")).toEqual([0, 0, 0, 0, -90_000, 0, 0, 0]);
      expect(pos("place")).toEqual([380_000, 0, 305_000, 1_800_000, 0, 0, 0, 0]);
      for (const [kind, value] of [
        ["IO", 129],
        ["REGISTER", 4660],
        ["BYTE", 200],
        ["INTEGER", -2],
        ["DOUBLE", -70_000],
        ["REAL", 12.5],
        ["STRING", "HELLO"],
      ] as const)
        expect(said[kind], kind).toEqual([0, 0, value]);
      expect(said["ROBOT_POSITION"]).toMatchObject([0, 0, { data_type: 16, pos: [1, -2, 3, 4, 5, 6, 0, 0] }]);
      expect(said["BASE_POSITION"]).toMatchObject([0, 0, { "8th_axis": 7 }]);
      expect(said["EXTERNAL_AXIS"]).toMatchObject([0, 0, { "3rd_axis": 2 }]);
      expect(said["many"]).toEqual([0, [0, -2, 0]]);
      expect(said["unwritable"]).toEqual([0x1f, 0x2110]);
      expect(said["servo"]).toEqual([0, 0x1f, 0x2070, 0]);
      expect([
        said["text"],
        said["cycle"],
        said["pmov"],
        said["mov"],
        said["send"],
        said["recv"],
        said["same"],
        said["play"],
      ]).toEqual([0, 0, 0, 0, 0, 0, true, 0]);
      expect(pos("there").slice(0, 6)).toEqual([13_400, 0, 0, 0, -90_000, 0]);
      (said["aim"] as number[]).forEach((aim, i) => {
        expect(Math.abs(pos("lower")[i]! - aim), `element ${i + 1}`).toBeLessThanOrEqual(2);
      });
      expect(said["hold"]).toEqual([0, 0x1f, 0x2050, 0]);
      expect(said["reset"]).toEqual([0, 0]);
      expect(said["list"]).toEqual([0, 0, ["PICK.JBI"]]);
      expect(said["select"]).toEqual([0x1f, 0x4040, 0]);
      expect(farthest(virtual.neutral.jointAngles(), shifted(0.1))).toBeLessThanOrEqual(3 * ACCURACY_RAD);
      expect(said["delete"]).toEqual([0, 0x1f, 0xe2b3]);
      expect([virtual.pendant.text, log]).toEqual(["hello", []]);
    } finally {
      rmSync(folder, { recursive: true });
    }
  },
  90_000,
);

const MOTO = process.env["TWINCELL_MOTO_HSES"] ?? "";
const hasMoto = existsSync(join(MOTO, "server"));
const WITHOUT_MOTO = hasMoto ? "" : " (skipped: TWINCELL_MOTO_HSES names no folder of built programs)";

test.skipIf(!hasMoto)(
  `the example clients of moto-hses run on the virtual controller${WITHOUT_MOTO}`,
  async () => {
    const { virtual, log } = await virtualYaskawa("127.0.0.45");
    const examples = [
      "read_status",
      "read_executing_job_info",
      "position_operations",
      "byte_variable_operations",
      "integer_variable_operations",
      "double_variable_operations",
      "real_variable_operations",
      "string_variable_operations",
      "register_operations",
      "io_operations",
      "cycle_mode_control",
      "hold_servo_control",
      "alarm_operations",
    ];
    for (const example of examples) {
      process.env["RUST_LOG"] = "info";
      const { code, out } = await run(join(MOTO, "examples", example), ["127.0.0.45", String(virtual.ports.robot)], 30);
      expect(code, `${example}: ${out}`).toBe(0);
      expect(out, example).not.toMatch(/✗|panicked/);
    }
    expect(log).toEqual([]);
  },
  120_000,
);

test.skipIf(!hasMoto)(
  `our driver reads the mock server of moto-hses, writes a line, takes its servo off and puts it on again${WITHOUT_MOTO}`,
  async () => {
    const ports = { robot: 20_140, files: 20_141 };
    const server = spawn(join(MOTO, "server"), ["127.0.0.46", String(ports.robot), String(ports.files)], {
      stdio: "ignore",
    });
    open.push({
      close() {
        server.kill();
      },
    });
    await pause(1000);
    const real = await driver("127.0.0.46", ports, { model: "", signals: { start: 27_013 } });
    let safety = "";
    let message = "";
    real.onSample(lent => {
      safety = lent.safety;
      message = lent.message;
    });
    await until(() => safety === "normal" && real.link.rate_Hz > 5);
    expect(message).toBe("");
    expect([...real.jointAngles()]).toEqual([0, 0, 0, 0, 0, 0]);
    expect(await real.run([{ id: "s", type: "set", signal: "start", to: true }], { tools: {}, frames: {} })).toEqual({
      kind: "done",
    });
    await until(() => real.signals?.read("start") === true);
    // Hold and servo off, then the alarm reset, the hold let go and the servo on: the server says what it was told.
    real.stop(true);
    await until(() => safety === "emergency-stop");
    void real.reset();
    await until(() => safety === "normal");
  },
  30_000,
);
