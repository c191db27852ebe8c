/**
 * Robots from files with a vendor section, by data alone: written for, executed, read back, simulated by their maker's
 * virtual controller and driven by the driver over it. Every command is a process of its own.
 */
import { execFile, spawn, type ChildProcess } from "node:child_process";
import { copyFileSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import {
  compose,
  emptyProgram,
  flangePose,
  parseRobot,
  pose,
  type MoveStep,
  type Pose,
  type Program,
  type Robot,
} from "@twincell/core";
import { dialectById, runnableFile } from "@twincell/languages";
import { afterAll, describe, expect, test } from "vitest";

const root = fileURLToPath(new URL("../../../", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "twincell-vendor-"));
const children: ChildProcess[] = [];
afterAll(async () => {
  for (const child of children) {
    if (child.exitCode !== null || child.signalCode !== null) continue;
    const ended = new Promise(resolve => child.once("exit", resolve));
    child.kill("SIGTERM");
    await ended;
  }
  rmSync(folder, { recursive: true, force: true });
});

interface Ran {
  readonly code: number;
  readonly out: string;
  readonly err: string;
}
const twincell = (...args: string[]): Promise<Ran> =>
  new Promise(resolve => {
    const child = execFile(process.execPath, ["apps/cli/src/main.ts", ...args], { cwd: root }, (_, out, err) => {
      resolve({ code: child.exitCode ?? -1, out, err });
    });
  });
const fileOf = (name: string): string => `fixtures/robots/${name}.json`;
const robotOf = (name: string): Robot => {
  const answer = parseRobot(JSON.parse(readFileSync(join(root, fileOf(name)), "utf8")));
  if (answer.kind !== "robot") throw new Error(answer.faults[0]!.sentence);
  return answer.robot;
};
const turned = ({ home_rad }: Robot, by: number): number[] =>
  home_rad.map((q, i) => q + by * [0.3, 0.12, -0.1, 0.2, -0.15, 0.4][i]!);
const move = (id: string, path: MoveStep["path"], target: MoveStep["target"]): MoveStep => ({
  id,
  type: "move",
  path,
  target,
  speed: path === "ptp" ? { ratio: 0.5 } : { mps: 0.2 },
  blend_m: 0,
});
function lap(robot: Robot): Program {
  const at = flangePose(robot.arm, turned(robot, 1)) as Pose as Pose<"base", "tcp">;
  return {
    ...emptyProgram(robot.id, "Lap"),
    steps: [
      move("turned", "ptp", { q: turned(robot, 1) }),
      move("down", "lin", {
        pose: compose(pose<"frame", "base">([0, 0, -0.01]), at),
        frame: "world",
        tool: "flange",
      }),
      move("back", "ptp", { q: robot.home_rad }),
    ],
  };
}

const ROBOTS = [
  { name: "ur5e", language: "urscript", driver: "ur", host: "127.0.0.31" },
  { name: "irb2400", language: "rapid", driver: "abb", host: "127.0.0.32" },
  { name: "gp12", language: "inform", driver: "yaskawa", host: "127.0.0.33" },
  { name: "kr16", language: "krl", driver: "kuka", host: "127.0.0.34" },
  { name: "m10id", language: "fanuc-ls", driver: "fanuc", host: "127.0.0.35" },
  { name: "tx2-90l", language: "val3", driver: "staubli", host: "127.0.0.36" },
] as const;

describe.each(ROBOTS)("$name from a file, by its vendor section", ({ name, language }) => {
  const robot = robotOf(name);
  const chosen = ["--robot", fileOf(name)];

  test(`post writes ${language} and proves it, run executes it, parse reads the same motions`, async () => {
    const program = join(folder, `${name}.json`);
    writeFileSync(program, JSON.stringify(lap(robot)));
    const written = await twincell("post", program, "--to", language, ...chosen, "-o", join(folder, name));
    expect(written.err).toBe("");
    const { files, proof } = JSON.parse(written.out) as {
      files: string[];
      proof: { worst_m: number; worst_rad: number }[];
    };
    expect(proof[0]!.worst_m).toBeLessThan(1e-5);
    expect(proof[0]!.worst_rad).toBeLessThan(2e-5);
    const texts = files.map(file => (file.startsWith("/") ? file : join(root, file)));

    const ran = await twincell("run", ...texts, ...chosen, "--dialect", language, "--period", "0.05");
    expect(ran.err).toBe("");
    const moments = ran.out
      .trim()
      .split("\n")
      .map(line => JSON.parse(line) as { q: number[] });
    const furthest = moments.reduce(
      (most, { q }) => (Math.abs(q[0]! - robot.home_rad[0]!) > Math.abs(most[0]! - robot.home_rad[0]!) ? q : most),
      [...robot.home_rad],
    );
    expect(furthest[0]!).toBeCloseTo(robot.home_rad[0]! + 0.3, 2);
    moments.at(-1)!.q.forEach((q, i) => expect(q).toBeCloseTo(robot.home_rad[i]!, 3));

    const parts = texts.map(file => ({ name: basename(file), text: readFileSync(file, "utf8"), lines: [] }));
    const whole = join(folder, `${name}-${basename(texts[0]!)}`);
    writeFileSync(whole, runnableFile(dialectById(language)!, parts)!.text);
    const parsed = await twincell("parse", whole, ...chosen, "--dialect", language);
    expect(parsed.err).toBe("");
    expect(parsed.code).toBe(0);
    const { steps } = JSON.parse(parsed.out) as Program;
    expect(steps.filter(({ type }) => type === "move").length).toBeGreaterThanOrEqual(3);
  }, 120_000);
});

// All drivers are held to such files on virtual time in packages/controllers; here three of them as processes.
describe.each(ROBOTS.filter(({ name }) => ["ur5e", "irb2400", "gp12"].includes(name)))(
  "$name from a file, on a controller of its own",
  ({ name, driver, host }) => {
    const robot = robotOf(name);
    const chosen = ["--robot", fileOf(name)];
    test(`virtual ${driver} is that robot, and move brings it to joint angles over its own protocol`, async () => {
      const child = spawn(
        process.execPath,
        ["apps/cli/src/main.ts", "virtual", driver, ...chosen, "--host", host, "--json"],
        { cwd: root, stdio: ["pipe", "pipe", "inherit"] },
      );
      children.push(child);
      const lines = createInterface({ input: child.stdout })[Symbol.asyncIterator]();
      expect(JSON.parse((await lines.next()).value as string)).toMatchObject({ brand: driver, robot: robot.id });
      const at = ["--at", host, "--driver", driver, ...chosen];
      const wanted = turned(robot, 0.5);
      const moved = await twincell("move", ...at, "--joints", wanted.join(","), "--confirm");
      expect(JSON.parse(moved.out)).toEqual({ kind: "done" });
      const stood = await twincell("watch", ...at, "--samples", "1", "--only", "sample");
      const { q_rad } = JSON.parse(stood.out) as { q_rad: number[] };
      q_rad.forEach((q, i) => expect(q).toBeCloseTo(wanted[i]!, 3));
      child.kill("SIGTERM");
    }, 180_000);
  },
);

test("a vendor section beside a URDF makes it a robot of that make; on another arm it is refused with both flanges", async () => {
  const urdf = (upper: number): string => {
    const links = ["base_link", ...[1, 2, 3, 4, 5, 6].map(n => `link_${n}`), "tool0"];
    const joint = (n: number, xyz: string, axis: string): string =>
      `<joint name="joint_${n}" type="revolute"><parent link="${links[n - 1]!}"/><child link="${links[n]!}"/><origin xyz="${xyz}"/><axis xyz="${axis}"/><limit lower="-2" upper="2" velocity="3" effort="0"/></joint>`;
    return `<robot name="arm">${links.map(link => `<link name="${link}"/>`).join("")}${[
      joint(1, "0 0 0.3991", "0 0 1"),
      joint(2, "0 0 0", "0 1 0"),
      joint(3, `0 0 ${upper}`, "0 1 0"),
      joint(4, "0 0 0.042", "1 0 0"),
      joint(5, "0.351 0 0", "0 1 0"),
      joint(6, "0.082 0 0", "1 0 0"),
    ].join(
      "",
    )}<joint name="flange" type="fixed"><parent link="link_6"/><child link="tool0"/><origin rpy="0 1.5707963267948966 0"/></joint></robot>`;
  };
  const section = join(root, "fixtures/robots/arm.vendor.json");
  const own = join(folder, "arm.urdf");
  writeFileSync(own, urdf(0.35));
  copyFileSync(section, join(folder, "arm.vendor.json"));
  const program = join(folder, "beside.json");
  const steps = [move("there", "ptp", { q: [0.1, 0.2, 0.3, 0.4, 0.5, 0.6] })];
  writeFileSync(program, JSON.stringify({ ...emptyProgram("arm", "Beside"), steps }));
  const written = await twincell("post", program, "--to", "rapid", "--robot", own, "-o", join(folder, "beside"));
  expect(written.err).toBe("");
  const [file] = (JSON.parse(written.out) as { files: string[] }).files;
  expect(readFileSync(file!.startsWith("/") ? file! : join(root, file!), "utf8")).toContain(
    "[[5.72958,11.45916,17.18873,22.91831,28.64789,34.37747]",
  );
  writeFileSync(own, urdf(0.448));
  const refused = await twincell("post", program, "--to", "rapid", "--robot", own, "-o", join(folder, "beside"));
  expect(refused.code).toBe(2);
  expect(refused.err).toMatch(
    /arm\.vendor\.json: postures: .*has the flange at \(.*\) mm, that of the .* is at \(.*\) mm: \d+\.\d mm apart/,
  );
}, 60_000);

test("docs/add-a-robot.md, followed: the section that it writes makes its arm one that speaks RAPID", async () => {
  const guide = readFileSync(join(root, "docs/add-a-robot.md"), "utf8");
  const vendor: unknown = JSON.parse(/^```json vendor\n([\s\S]*?)^```$/m.exec(guide)![1]!);
  const arm = JSON.parse(readFileSync(join(root, "examples/robots/small-arm.json"), "utf8")) as object;
  const path = join(folder, "small-arm.json");
  writeFileSync(path, JSON.stringify({ ...arm, vendor }));
  const answer = parseRobot({ ...arm, vendor });
  const robot = answer.kind === "robot" ? answer.robot : undefined;
  const program = join(folder, "small-program.json");
  writeFileSync(program, JSON.stringify(lap(robot!)));
  const written = await twincell("post", program, "--to", "rapid", "--robot", path, "-o", join(folder, "small"));
  expect(written.err).toBe("");
  expect(JSON.parse(written.out)).toMatchObject({ dialect: "rapid", proof: [{ file: expect.any(String) as string }] });
  const without = await twincell(
    ...["post", program, "--to", "rapid", "--robot", "examples/robots/small-arm.json"],
    ...["-o", join(folder, "small")],
  );
  expect(without.code).toBe(1);
  expect(without.err).toContain("The controller of the Small arm does not speak RAPID.");
}, 60_000);

test("a language or a driver that there is not is named, and so is a section without a posture", async () => {
  const data = JSON.parse(readFileSync(join(root, fileOf("ur5e")), "utf8")) as { vendor: Record<string, unknown> };
  const path = join(folder, "strange.json");
  const fk = async (vendor: Record<string, unknown>): Promise<string> => {
    writeFileSync(path, JSON.stringify({ ...data, vendor: { ...data.vendor, ...vendor } }));
    return (await twincell("fk", "--robot", path)).err;
  };
  expect(await fk({ languages: ["ur-script"] })).toMatch(/there is no language "ur-script"\. There are: v-plus, krl/);
  expect(await fk({ drivers: ["universal"] })).toMatch(/there is no driver "universal"\. There are: ur, kuka/);
  expect(await fk({ postures: [] })).toMatch(/vendor\.postures: A vendor section has at least one posture/);
}, 120_000);
