/**
 * FANUC's Remote Motion Interface on the system's own sockets: our driver, and a client that nobody here wrote. The Python that has
 * it is named by TWINCELL_PYTHON, or is the python3 of the path:  pip install fanuc-rmi==0.3.1
 */
import { createFanucFace, createRealController, createVirtualFanuc, type VirtualFanuc } from "@twincell/controllers";
import { robotById } from "@twincell/core";
import { spawn } from "node:child_process";
import { afterEach, expect, test } from "vitest";
import { nodeScheduler } from "./clock.ts";
import { nodeNetwork } from "./sockets/node-network.ts";

const robot = robotById("fanuc_lrmate200id")!, network = nodeNetwork(), scheduler = nodeScheduler, DEG = Math.PI / 180;
/** Robot and driver share one processor here with whatever else it does. */
const PATIENT_S = 1;
const open: (() => void)[] = [];
afterEach(() => { for (const close of open.splice(0).reverse()) close(); });

async function virtualFanuc(host: string, own = false): Promise<VirtualFanuc> {
  const started = await createVirtualFanuc({ robot, scheduler, network, host, ...(own ? {} : { port: 0, sessionPort: 0 }) });
  if (started.kind === "taken") throw new Error(started.sentence);
  open.push(() => { started.virtual.close(); });
  return started.virtual;
}

test("T-22 T-23 FANUC: the driver moves the virtual controller over the loopback; the ports are the vendor's own", async () => {
  const fanuc = await virtualFanuc("127.0.0.41", true), real = createRealController({ face: createFanucFace({ robot, scheduler, network, host: "127.0.0.41", stale_s: PATIENT_S }), scheduler });
  open.push(() => { real.close(); });
  expect(await real.connect()).toEqual({ kind: "done" });
  const target = robot.home_rad.map(q => q + 0.3);
  expect(await real.moveJoints(target)).toEqual({ kind: "done" });
  for (const is of [real.jointAngles(), fanuc.arm.jointAngles()]) is.forEach((q, i) => { expect(Math.abs(q - target[i]!)).toBeLessThanOrEqual(0.001 * DEG); });
  expect(fanuc.ports).toEqual({ connect: 16_001, session: 16_002 });
});

const PYTHON = process.env["TWINCELL_PYTHON"] ?? "python3";
const python = (script: string, ...args: string[]): Promise<{ code: number; out: string }> => new Promise(resolve => {
  const child = spawn(PYTHON, ["-c", script, ...args], { stdio: ["ignore", "pipe", "pipe"] });
  let out = "";
  for (const stream of [child.stdout, child.stderr]) stream.on("data", (chunk: Buffer) => { out += chunk.toString(); });
  child.once("error", problem => { resolve({ code: -1, out: problem.message }); });
  child.once("close", code => { resolve({ code: code ?? -1, out }); });
});
const has = (await python("import fanuc_rmi")).code === 0, SKIPPED = has ? "" : " (no Python with fanuc-rmi: name one by TWINCELL_PYTHON)";

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

test.skipIf(!has)(`fanuc-rmi 0.3.1, a client that nobody here wrote, moves the virtual FANUC${SKIPPED}`, async () => {
  const fanuc = await virtualFanuc("127.0.0.42"), { code, out } = await python(CLIENT, "127.0.0.42", String(fanuc.ports.connect), String(fanuc.ports.session));
  expect(code, out).toBe(0);
  const said = JSON.parse(out.trim().split("\n").at(-1)!) as { joints: Record<string, number>; place: Record<string, number> };
  expect(said.joints["J1"]).toBeCloseTo(25, 1);
  expect(said.joints["J1"]).toBeCloseTo(fanuc.arm.jointAngle(1) / DEG, 4);
  // Joint 3 as the pendant shows it: against the horizon.
  expect(said.joints["J3"]).toBeCloseTo((fanuc.arm.jointAngle(3) - fanuc.arm.jointAngle(2)) / DEG, 4);
  expect(Number.isFinite(said.place["Z"])).toBe(true);
  expect(out).not.toMatch(/'ErrorID': [1-9]/);
}, 60_000);
