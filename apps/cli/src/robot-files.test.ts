import { spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { afterAll, describe, expect, test } from "vitest";

const root = fileURLToPath(new URL("../../../", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "twincell-robots-"));
afterAll(() => {
  rmSync(folder, { recursive: true, force: true });
});
const XACRO = "fixtures/xacro/arm_description/urdf/arm.urdf.xacro";

interface Pose {
  readonly position: number[];
  readonly quaternion: number[];
}
function twincell(args: readonly string[], input: readonly unknown[] = []) {
  const run = spawnSync(process.execPath, ["apps/cli/src/main.ts", ...args], {
    cwd: root,
    input: input.map(line => JSON.stringify(line)).join("\n"),
    encoding: "utf8",
    maxBuffer: 1 << 26,
  });
  return {
    code: run.status ?? -1,
    err: run.stderr,
    out: run.stdout,
    lines: <T>() =>
      run.stdout
        .trim()
        .split("\n")
        .filter(line => line !== "")
        .map(line => JSON.parse(line) as T),
  };
}
function file(name: string, text: string): string {
  const path = join(folder, name);
  writeFileSync(path, text);
  return path;
}
const largestGap = (a: readonly number[], b: readonly number[]): number =>
  Math.max(...a.map((value, i) => Math.abs(value - b[i]!)));

describe("L-08 a xacro as --robot", () => {
  const golden = JSON.parse(readFileSync(`${root}fixtures/xacro/forward.json`, "utf8")) as {
    cases: { args: Record<string, string>; tip: string; samples: { q: number[]; position: number[] }[] }[];
  };
  test.each(golden.cases)("fk agrees with the witness for $args", ({ args, tip, samples }) => {
    const given = Object.entries(args).flatMap(([name, value]) => ["--arg", `${name}:=${value}`]);
    const poses = twincell(
      ["fk", "--robot", XACRO, "--tip", tip, ...given],
      samples.map(({ q }) => ({ q })),
    ).lines<Pose>();
    expect(poses.length).toBe(samples.length);
    poses.forEach(({ position }, i) => {
      expect(largestGap(position, samples[i]!.position)).toBeLessThan(1e-12);
    });
  });

  test.each<[string, readonly string[], string]>([
    [
      "a link that is not there",
      ["fk", "--robot", XACRO, "--tip", "nose"],
      "has no link nose. The file ends in gripper: choose with --tip.",
    ],
    ["an argument that does not read", ["fk", "--robot", XACRO, "--arg", "prefix=left"], "--arg wants name:=value"],
    [
      "an argument without a truth value",
      ["fk", "--robot", XACRO, "--arg", "gripper:=maybe"],
      `${XACRO}, line 29: The condition “$(arg gripper)” became “maybe”`,
    ],
    ["a folder", ["fk", "--robot", "fixtures/xacro"], "is a folder, not a file."],
    [
      "a base without a robot",
      ["check", "examples/01-edge-trace/program.json", "--base", "x"],
      "--base is given without --robot.",
    ],
  ])("%s ends with 2 and one sentence", (_, args, says) => {
    const { code, err } = twincell(args);
    expect(code).toBe(2);
    expect(err).toContain(says);
    expect(err.trim().split("\n").length).toBe(1);
  });
});

describe("a library robot as URDF and as D-H table", () => {
  const q = [{ q: [0.3, -1, 1.2, 0.4, 0.7, -0.2] }, { q: [0, -1.57, 1.57, 0, 0, 0] }];
  const wanted = twincell(["fk", "--robot", "staubli_rx90l"], q).lines<Pose>();
  const urdf = join(folder, "rx90l.urdf");

  test("robots --urdf writes a file that fk, ik, check and simulate take, with its shapes", () => {
    expect(twincell(["robots", "--urdf", "staubli_rx90l", "-o", urdf])).toMatchObject({ code: 0, err: "" });
    const poses = twincell(["fk", "--robot", urdf], q).lines<Pose>();
    poses.forEach(({ position, quaternion }, i) => {
      expect(largestGap(position, wanted[i]!.position)).toBeLessThan(1e-12);
      expect(largestGap(quaternion, wanted[i]!.quaternion)).toBeLessThan(1e-12);
    });
    const [shoulder] = twincell(["fk", "--robot", urdf, "--base", "base"], q).lines<Pose>();
    expect(shoulder!.position[2]! - poses[0]!.position[2]!).toBeCloseTo(-0.42, 12);

    const [answer, far] = twincell(
      ["ik", "--robot", urdf],
      [wanted[0]!, { position: [4, 0, 1], quaternion: [0, 0, 0, 1] }],
    ).lines<{ solutions: number[][]; reach: { kind: string; sentence: string } }>();
    expect(answer!.solutions.length).toBe(8);
    expect(Math.min(...answer!.solutions.map(each => largestGap(each, q[0]!.q)))).toBeLessThan(1e-9);
    expect(far!.reach).toMatchObject({ kind: "too-far", sentence: expect.stringMatching(/\d.*\.$/) as string });
  });

  test("a program is judged and played on it as on the library's; the meshes are looked at in the cell", () => {
    const PROGRAM = "examples/01-edge-trace/program.json";
    const CELL = ["--cell", "examples/01-edge-trace/cell.json"];
    const own = twincell(["check", PROGRAM, ...CELL, "--robot", urdf]);
    const library = twincell(["check", PROGRAM, ...CELL]);
    expect({ code: own.code, err: own.err }).toEqual({ code: library.code, err: "" });
    const verdicts = (text: string): string[] =>
      (JSON.parse(text) as { steps: { id: string; verdict: string }[] }).steps.map(
        ({ id, verdict }) => `${id} ${verdict}`,
      );
    expect(verdicts(own.out)).toEqual(verdicts(library.out));
    const played = twincell(["simulate", PROGRAM, ...CELL, "--robot", urdf, "--period", "0.1"]);
    const usual = twincell(["simulate", PROGRAM, ...CELL, "--period", "0.1"]);
    expect(played.code).toBe(0);
    const ends = [played, usual].map(run => run.lines<Pose & { q: number[] }>().at(-1)!);
    expect(largestGap(ends[0]!.position, ends[1]!.position)).toBeLessThan(1e-9);
  });

  test("a program is written for it as well, and proven by its own text", () => {
    const program = file(
      "taught.json",
      JSON.stringify({
        format: "twincell.program",
        version: 1,
        name: "Taught",
        robot: "small_arm",
        tools: {},
        frames: {},
        groups: {},
        steps: [
          {
            id: "a",
            type: "move",
            path: "ptp",
            target: { q: [0.1, 0.2, 0.3, 0.1, 0.5, 0.2] },
            speed: { ratio: 0.3 },
            blend_m: 0,
          },
        ],
      }),
    );
    const out = join(folder, "posted");
    const { code, lines } = twincell([
      "post",
      program,
      "--to",
      "l-irl",
      "-o",
      out,
      "--robot",
      "examples/robots/small-arm.json",
    ]);
    expect(code).toBe(0);
    expect(lines<{ proof: { worst_m: number }[] }>()[0]!.proof[0]!.worst_m).toBeLessThan(1e-5);
    expect(readFileSync(join(out, "Taught.poses.txt"), "utf8")).toMatch(/^ROBOT "?small_arm"?\r?$/m);
    expect(twincell(["post", program, "--to", "l-irl", "-o", out]).err).toContain(
      'there is no robot "small_arm" in the library',
    );
  });

  test("an arm is what its kinematics say: saved under another robot's name it is not written for, under any name it is itself", () => {
    const urdfOf = (id: string, name: string): string => {
      const path = join(folder, name);
      expect(twincell(["robots", "--urdf", id, "-o", path])).toMatchObject({ code: 0 });
      return path;
    };
    const step = {
      id: "a",
      type: "move",
      path: "ptp",
      target: { q: [0.1, 0.2, 0.3, 0.1, 0.5, 0.2] },
      speed: { ratio: 0.3 },
      blend_m: 0,
    };
    const program = file(
      "for-irb120.json",
      JSON.stringify({
        format: "twincell.program",
        version: 1,
        name: "Taught",
        robot: "abb_irb120",
        tools: {},
        frames: {},
        groups: {},
        steps: [step],
      }),
    );
    const post = (robot: string, out: string) =>
      twincell(["post", program, "--to", "rapid", "-o", join(folder, out), "--robot", robot]);
    // The same make, 100 mm more between axes 2 and 3: an arm that the library does not have.
    const other = urdfOf("abb_irb120", "abb_irb120.urdf");
    const longer = readFileSync(other, "utf8").replace(/xyz="0 0 0\.27"/, 'xyz="0 0 0.37"');
    expect(longer).not.toBe(readFileSync(other, "utf8"));
    writeFileSync(other, longer);
    const wrong = post(other, "wrong-arm");
    expect(wrong.code).toBe(1);
    expect(wrong.err).toMatch(
      /called abb_irb120, but is not the ABB IRB 120.*its flange is at \([-0-9., ]+\) mm, that of the ABB IRB 120.* at \([-0-9., ]+\) mm/,
    );
    expect(existsSync(join(folder, "wrong-arm"))).toBe(false);
    expect(post(urdfOf("abb_irb120", "arm-of-cell-4.urdf"), "right-arm")).toMatchObject({ code: 0 });
  });

  test("check on a robot of other joints says so", () => {
    expect(twincell(["check", "examples/01-edge-trace/program.json", "--robot", XACRO])).toMatchObject({ code: 2 });
  });

  test.each(["modified", "standard"])("N-08 robots --dh, %s, is a robot again", convention => {
    const path = file(
      `${convention}.dh.json`,
      twincell(["robots", "--dh", "staubli_rx90l", "--convention", convention]).out,
    );
    twincell(["fk", "--robot", path], q)
      .lines<Pose>()
      .forEach(({ position }, i) => {
        expect(largestGap(position, wanted[i]!.position)).toBeLessThan(1e-12);
      });
    const [answer] = twincell(["ik", "--robot", path], [wanted[0]!]).lines<{ solutions: number[][] }>();
    expect(answer!.solutions.length).toBe(8);
  });

  test("a table as text, and one that is wrong", () => {
    const path = file("rx90l.dh.txt", twincell(["robots", "--dh", "staubli_rx90l", "--text"]).out);
    const [first] = twincell(["fk", "--robot", path], q).lines<Pose>();
    expect(largestGap(first!.position, wanted[0]!.position)).toBeLessThan(1e-9);
    expect(twincell(["fk", "--robot", file("wrong.dh.csv", "a,alpha,d\n1,2,3\n")])).toMatchObject({
      code: 2,
      err: expect.stringContaining("does not say its convention") as string,
    });
  });
});
