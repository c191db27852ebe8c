/**
 * FANUC's Remote Motion Interface on the system's own sockets: our driver, and a client that nobody here wrote. The
 * Python that has it is named by TWINCELL_PYTHON, or is the python3 of the path:
 *   pip install fanuc-rmi==0.3.1
 */
import { createFanucAdapter, createRealController, createVirtualFanuc, type VirtualFanuc } from "@twincell/controllers";
import { emptyProgram, robotById } from "@twincell/core";
import { dialectById } from "@twincell/languages";
import { spawn } from "node:child_process";
import { afterEach, expect, test } from "vitest";
import { nodeScheduler } from "./clock.ts";
import { nodeNetwork } from "./sockets/node-network.ts";

const robot = robotById("fanuc_lrmate200id")!;
const tp = dialectById("fanuc-ls")!;
const network = nodeNetwork();
const scheduler = nodeScheduler;
const DEG = Math.PI / 180;
/** Robot and driver share one processor here with whatever else it does. */
const PATIENT_S = 1;
const open: (() => void)[] = [];
afterEach(() => {
  for (const close of open.splice(0).reverse()) close();
});

async function virtualFanuc(host: string, own = false): Promise<VirtualFanuc> {
  const started = await createVirtualFanuc({
    robot,
    scheduler,
    network,
    host,
    ftpPort: 0,
    interpret: text => tp.interpret(text, robot),
    ...(own ? {} : { port: 0, sessionPort: 0 }),
  });
  if (started.kind === "taken") throw new Error(started.sentence);
  open.push(() => {
    started.virtual.close();
  });
  return started.virtual;
}

test("T-22 T-23 FANUC: the driver moves the virtual controller over the loopback; the ports are the vendor's own", async () => {
  const fanuc = await virtualFanuc("127.0.0.41", true);
  const real = createRealController({
    face: createFanucAdapter({ robot, scheduler, network, host: "127.0.0.41", stale_s: PATIENT_S }),
    scheduler,
  });
  open.push(() => {
    real.close();
  });
  expect(await real.connect()).toEqual({ kind: "done" });
  const target = robot.home_rad.map(q => q + 0.3);
  expect(await real.moveJoints(target)).toEqual({ kind: "done" });
  for (const is of [real.jointAngles(), fanuc.arm.jointAngles()])
    is.forEach((q, i) => {
      expect(Math.abs(q - target[i]!)).toBeLessThanOrEqual(0.001 * DEG);
    });
  expect(fanuc.ports).toMatchObject({ connect: 16_001, session: 16_002 });
});

test("a program of the studio goes to the controller as a TP listing by FTP, and is run there to its end", async () => {
  const host = "127.0.0.43";
  const fanuc = await virtualFanuc(host);
  const { connect: port, files: ftpPort } = fanuc.ports;
  const real = createRealController({
    face: createFanucAdapter({ robot, scheduler, network, host, port, ftpPort, stale_s: PATIENT_S }),
    scheduler,
  });
  open.push(() => {
    real.close();
  });
  expect(await real.connect()).toEqual({ kind: "done" });
  const q = robot.home_rad.map(angle => angle + 0.2);
  const emitted = tp.emit(
    {
      ...emptyProgram(robot.id, "job"),
      steps: [{ id: "a", type: "move", path: "ptp", target: { q: [...q] }, speed: { ratio: 1 }, blend_m: 0 }],
    },
    robot,
  );
  if (emitted.kind === "cannot") throw new Error(emitted.sentence);
  expect(await real.runText!(emitted.files)).toEqual({ kind: "done" });
  // A listing has thousandths of a degree.
  q.forEach((angle, i) => {
    expect(Math.abs(fanuc.arm.jointAngle(i + 1) - angle)).toBeLessThan(0.001 * DEG);
  });
  expect(fanuc.programs.names).toHaveLength(1);
}, 30_000);

const PYTHON = process.env["TWINCELL_PYTHON"] ?? "python3";
const python = (script: string, ...args: string[]): Promise<{ code: number; out: string }> =>
  new Promise(resolve => {
    const child = spawn(PYTHON, ["-c", script, ...args], { stdio: ["ignore", "pipe", "pipe"] });
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
const has = (await python("import fanuc_rmi")).code === 0;
const SKIPPED = has ? "" : " (no Python with fanuc-rmi: name one by TWINCELL_PYTHON)";

const CLIENT = `
import json, os, sys, tempfile
from fanuc_rmi.client import RobotClient
robot = RobotClient(host=sys.argv[1], startup_port=int(sys.argv[2]), main_port=int(sys.argv[3]))
robot.connect()
robot.initialize(uframe=0, utool=1)
robot.speed_override(100)
robot.joint_absolute({"J1": 20, "J2": 10, "J3": -15, "J4": 0, "J5": -60, "J6": 0}, speed_percentage=100, sequence_id=1)
robot.joint_relative({"J1": 5, "J2": 0, "J3": 0, "J4": 0, "J5": 0, "J6": 0}, speed_percentage=100, sequence_id=2)
robot.linear_relative({"X": 0, "Y": 0, "Z": 30, "W": 0, "P": 0, "R": 0}, speed=200, sequence_id=3)
out = os.path.join(tempfile.mkdtemp(), "said.jsonl")
joints = robot.read_joint_coordinates(output_path=out)
place = robot.read_cartesian_coordinates(output_path=out)
print("\\n" + json.dumps({"joints": joints["JointAngle"], "place": place["Position"]}))
`;

test.skipIf(!has)(
  `fanuc-rmi 0.3.1, a client that nobody here wrote, moves the virtual FANUC${SKIPPED}`,
  async () => {
    const fanuc = await virtualFanuc("127.0.0.42");
    const { code, out } = await python(CLIENT, "127.0.0.42", String(fanuc.ports.connect), String(fanuc.ports.session));
    expect(code, out).toBe(0);
    const said = JSON.parse(out.trim().split("\n").at(-1)!) as {
      joints: Record<string, number>;
      place: Record<string, number>;
    };
    expect(said.joints["J1"]).toBeCloseTo(25, 1);
    expect(said.joints["J1"]).toBeCloseTo(fanuc.arm.jointAngle(1) / DEG, 4);
    // Joint 3 as the pendant shows it: against the horizon.
    expect(said.joints["J3"]).toBeCloseTo((fanuc.arm.jointAngle(3) - fanuc.arm.jointAngle(2)) / DEG, 4);
    expect(Number.isFinite(said.place["Z"])).toBe(true);
    expect(out).not.toMatch(/'ErrorID': [1-9]/);
  },
  60_000,
);

const FILES = `
import io, json, sys
from ftplib import FTP, all_errors
ftp, said, back = FTP(), {}, io.BytesIO()
said["welcome"] = ftp.connect(sys.argv[1], int(sys.argv[2]))
ftp.login()
ftp.cwd("md:")
listing = b"/PROG  HELLO\\n/MN\\n/END\\n"
ftp.storbinary("STOR hello.ls", io.BytesIO(listing))
said["names"] = ftp.nlst()
ftp.retrbinary("RETR hello.ls", back.write)
said["same"], said["size"] = back.getvalue() == listing, ftp.size("hello.ls")
try: ftp.storbinary("STOR hello.tp", io.BytesIO(b"x"))
except all_errors as refused: said["refused"] = str(refused)
ftp.storlines("STOR big.ls", io.BytesIO(b"/PROG  BIG\\n" + b"! line\\n" * 100000))
said["big"] = ftp.size("big.ls")
ftp.delete("hello.ls")
said["left"], said["bye"] = ftp.nlst(), ftp.quit()
print("\\n" + json.dumps(said))
`;
const hasFtp = (await python("import ftplib")).code === 0;
test.skipIf(!hasFtp)(
  `ftplib, a client that nobody here wrote, puts, lists, reads and deletes listings${hasFtp ? "" : " (skipped: no Python; name one by TWINCELL_PYTHON)"}`,
  async () => {
    const host = "127.0.0.44";
    const fanuc = await virtualFanuc(host);
    const { code, out } = await python(FILES, host, String(fanuc.ports.files));
    expect(code, out).toBe(0);
    expect(JSON.parse(out.trim().split("\n").at(-1)!)).toEqual({
      welcome: "220 Twincell virtual controller FTP server ready.",
      names: ["HELLO.LS"],
      same: true,
      size: 22,
      refused: "550 HELLO.TP is no name of a listing (.LS).",
      big: 12 + 800_000,
      left: ["BIG.LS"],
      bye: "221 Goodbye.",
    });
  },
  60_000,
);
