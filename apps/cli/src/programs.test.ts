import { spawnSync } from "node:child_process";
import { chmodSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { robotById } from "@twincell/core";
import { afterAll, describe, expect, test } from "vitest";

const root = fileURLToPath(new URL("../../../", import.meta.url));
const PROGRAM = "examples/01-edge-trace/program.json";
const CELL = "examples/01-edge-trace/cell.json";
const IN_CELL = ["--cell", CELL];
const folder = mkdtempSync(join(tmpdir(), "twincell-cli-"));
afterAll(() => {
  rmSync(folder, { recursive: true, force: true });
});

interface Moment {
  readonly t: number;
  readonly position: readonly number[];
  readonly step: string;
  readonly line?: number;
}
interface TaughtStep {
  id: string;
  type: string;
  path?: string;
  target?: Record<string, unknown>;
}
interface Taught {
  name: string;
  steps: TaughtStep[];
}

/** The command as users run it. */
function twincell(...args: readonly string[]) {
  const run = spawnSync(process.execPath, ["apps/cli/src/main.ts", ...args], {
    cwd: root,
    encoding: "utf8",
    maxBuffer: 1 << 28,
  });
  return {
    code: run.status ?? -1,
    out: run.stdout,
    err: run.stderr,
    sentences: run.stderr
      .trim()
      .split("\n")
      .filter(line => line !== ""),
  };
}
const moments = (text: string): Moment[] =>
  text
    .trim()
    .split("\n")
    .map(line => JSON.parse(line) as Moment);
/** The taught example with something changed, as a file. */
function changed(name: string, change: (program: Taught) => void): string {
  const program = JSON.parse(readFileSync(`${root}${PROGRAM}`, "utf8")) as Taught;
  const path = join(folder, `${name}.json`);
  change(program);
  writeFileSync(path, JSON.stringify(program));
  return path;
}
const pointed = (program: Taught, id: string, position: readonly number[]): void => {
  program.steps.find(step => step.id === id)!.target = { pose: { position, quaternion: [0, 1, 0, 0] }, tool: "torch" };
};

describe("check", () => {
  test("--json: a bad step says what binds it and up to three proven changes; the first makes it good", () => {
    const path = changed("tilted-away", program => {
      pointed(program, "s3", [0.95, 0.62, 0.45]);
    });
    const first = twincell("check", path, "--json");
    expect(first.code).toBe(1);
    interface Said {
      readonly id: string;
      readonly verdict: string;
      readonly repair?: {
        readonly cause: string;
        readonly sentence: string;
        readonly repairs: readonly { readonly replace?: TaughtStep; readonly alsoReplace?: readonly TaughtStep[] }[];
        readonly tried: readonly string[];
      };
    }
    const { steps } = JSON.parse(first.out) as { steps: readonly Said[] };
    expect(steps.filter(step => step.verdict !== "bad").every(step => step.repair === undefined)).toBe(true);
    const bad = steps.find(step => step.verdict === "bad")!;
    expect(bad.repair!.sentence).toMatch(/\d/);
    expect(["reach", "joint-limit", "branch"]).toContain(bad.repair!.cause);
    const [way] = bad.repair!.repairs.filter(({ replace }) => replace !== undefined);
    const after = changed("tilted-back", program => {
      pointed(program, "s3", [0.95, 0.62, 0.45]);
      for (const step of [way!.replace!, ...(way!.alsoReplace ?? [])])
        program.steps[program.steps.findIndex(({ id }) => id === step.id)] = step;
    });
    const second = JSON.parse(twincell("check", after).out) as { steps: readonly Said[] };
    expect(second.steps.find(({ id }) => id === bad.id)!.verdict).toMatch(/ok|warn/);
  });

  test("a good program is judged step by step, exit 0", () => {
    const { code, out, err } = twincell("check", PROGRAM, ...IN_CELL);
    const verdict = JSON.parse(out) as { ok: boolean; steps: { id: string; verdict: string }[] };
    expect({ code, err, ok: verdict.ok }).toEqual({ code: 0, err: "", ok: true });
    expect(verdict.steps.map(step => step.id)).toEqual(
      (JSON.parse(readFileSync(`${root}${PROGRAM}`, "utf8")) as Taught).steps.map(step => step.id),
    );
  });
  test("a step out of reach is named, exit 1, and is a failure in the JUnit report", () => {
    const path = changed("too-far", program => {
      pointed(program, "s4", [4, 0, 1]);
    });
    const report = join(folder, "deep", "report.xml");
    const { code, out } = twincell("check", path, ...IN_CELL, "--junit", report);
    const xml = readFileSync(report, "utf8");
    const bad = (
      JSON.parse(out) as { steps: { id: string; verdict: string; findings: { sentence: string }[] }[] }
    ).steps.filter(step => step.verdict === "bad");
    expect(code).toBe(1);
    expect(bad.map(step => step.id)).toContain("s4");
    expect(bad[0]!.findings[0]!.sentence).toMatch(/\d.*\.$/);
    expect(xml).toMatch(/<testcase classname="Edge trace" name="s4"><failure message="[^"]+"\/>/);
    expect(xml).toContain(`failures="${bad.length}"`);
    expect(readdirSync(join(folder, "deep"))).toEqual(["report.xml"]);
  });
  test("T-64 says every part of the distance that is kept: asked for, shape, registration and twin, in the verdict and, where the cell was measured, on stderr", () => {
    const cell = JSON.parse(readFileSync(`${root}${CELL}`, "utf8")) as Record<string, unknown>;
    const path = join(folder, "measured.json");
    writeFileSync(path, JSON.stringify({ ...cell, errors: { registration_m: 0.003, twin_m: 0.002 } }));
    const { out, err } = twincell("check", PROGRAM, "--cell", path, "--margin", "0.001");
    const shape_mm = 1000 * robotById("staubli_rx90l")!.shapeError_m;
    const kept = `Between the robot and what stands around it ${(6 + shape_mm).toFixed(0)} mm are kept: 1.0 mm asked for, ${shape_mm.toFixed(0)} mm for the drawn shape of the links, 3.0 mm for the registration, 2.0 mm for the twin.`;
    expect((JSON.parse(out) as { assumptions: string[] }).assumptions).toContain(kept);
    expect(err).toContain(kept);
  });

  test("M-49 a certificate is written, proven again, and refuted for a cell that has changed", () => {
    const file = join(folder, "certificate.json");
    const crowded = join(folder, "crowded.json");
    expect(twincell("check", PROGRAM, ...IN_CELL, "--certificate", file).code).toBe(0);
    expect(twincell("check", PROGRAM, ...IN_CELL, "--verify", file)).toMatchObject({
      code: 0,
      sentences: [expect.stringMatching(/^All [0-9]+ motions are proven clear a second time, in [0-9]+ looks\.$/)],
    });
    const cell = JSON.parse(readFileSync(`${root}${CELL}`, "utf8")) as {
      objects: { id: string; worldFromObject: { position: number[] } }[];
    };
    cell.objects.find(({ id }) => id === "carton")!.worldFromObject.position[2]! += 0.05;
    writeFileSync(crowded, JSON.stringify(cell));
    const refuted = twincell("check", PROGRAM, "--cell", crowded, "--verify", file);
    expect(refuted.code).toBe(1);
    expect(refuted.sentences[0]).toMatch(/^The certificate does not hold for step /);
    expect(twincell("check", PROGRAM, "--certificate", file)).toMatchObject({
      code: 2,
      sentences: [expect.stringContaining("A certificate is about a cell.")],
    });
    expect(twincell("check", PROGRAM, ...IN_CELL, "--verify", PROGRAM)).toMatchObject({ code: 2 });
  });
  test("names with marks of XML do not break the report", () => {
    const path = changed("marks", program => {
      program.name = `a<b & "c"`;
    });
    const report = join(folder, "marks.xml");
    expect(twincell("check", path, "--junit", report).code).toBe(0);
    expect(readFileSync(report, "utf8")).not.toMatch(/<b |& /);
  });
});

describe("post, run, parse", () => {
  test("the posted text says at the end of every step what simulate says, within 0.01 mm", () => {
    const posted = twincell("post", PROGRAM, "--to", "v-plus", "-o", join(folder, "post"), ...IN_CELL);
    expect(posted.code, posted.err).toBe(0);
    const { files } = JSON.parse(posted.out) as { files: string[] };
    const text = files.find(file => file.endsWith(".v2"))!;
    expect(readdirSync(join(folder, "post")).sort()).toEqual(
      files.map(file => file.slice(folder.length + "/post/".length)).sort(),
    );
    const planned = moments(twincell("simulate", PROGRAM, ...IN_CELL, "--period", "0.001").out);
    const ran = twincell(
      "run",
      text,
      "--robot",
      "staubli_rx90l",
      "--dialect",
      "v-plus",
      ...IN_CELL,
      "--period",
      "0.001",
    );
    expect(ran.code, ran.err).toBe(0);
    const plannedEnds = ends(planned, each => each.step);
    const ranEnds = ends(moments(ran.out), each => String(each.line));
    const moves = (JSON.parse(readFileSync(`${root}${PROGRAM}`, "utf8")) as Taught).steps.filter(
      step => step.type === "move",
    ).length;
    expect(plannedEnds.length).toBeGreaterThanOrEqual(moves - 1);
    // In their order: the end of each step is an end in the text, after that of the step before it.
    let at = 0;
    for (const wanted of plannedEnds) {
      const found = ranEnds.findIndex((got, i) => i >= at && distance(wanted.position, got.position) < 0.00001);
      expect(found, `end of step ${wanted.step}`).toBeGreaterThanOrEqual(at);
      at = found;
    }
  });
  test("M-51 M-52 M-53 G-10 three joint motions of a KR 6 are written as the published list PTP_AXIS, byte for byte, proven; anything else is refused with the step", () => {
    const path = join(folder, "kuka.json");
    const { version } = JSON.parse(readFileSync(`${root}${PROGRAM}`, "utf8")) as { version: number };
    // Figure 9 of the paper [deg], its lines unwrapped.
    const points = [
      [26.5651, 3.46629, 34.4992, 220.355, 43.6572, 149.288],
      [-42.605, -10.3901, 19.0239, -62.5439, 3.33649, 45.7593],
      [37.8414, -8.14868, -2.29048, 57.5508, -7.09465, -42.9173],
    ];
    const steps: Record<string, unknown>[] = points.map((q, i) => ({
      id: `p${i + 1}`,
      type: "move",
      path: "ptp",
      target: { q: q.map(degrees => (degrees * Math.PI) / 180) },
      speed: { ratio: 1 },
      blend_m: 0,
    }));
    const program = { format: "twincell.program", version, name: "List", robot: "kuka_kr6_2", steps };
    const rest = { tools: {}, frames: {}, pallets: {}, groups: {}, signals: {}, routines: {} };
    writeFileSync(path, JSON.stringify({ ...program, ...rest }));
    const to = join(folder, "kuka");
    const { code, out, err } = twincell("post", path, "--to", "krl", "--form", "axis-list", "-o", to);
    expect({ code, err }).toEqual({ code: 0, err: "" });
    expect(JSON.parse(out)).toMatchObject({ warnings: [], proof: [{ file: "PTP_AXIS.src" }] });
    const axes = (name: string): string[] => [1, 2, 3, 4, 5, 6].map(axis => `$${name}_AXIS[${axis}] = 100`);
    expect(readFileSync(join(to, "PTP_AXIS.src"), "utf8")).toBe(
      [
        "DEF PTP_AXIS()",
        ...axes("VEL"),
        "",
        ...axes("ACC"),
        "",
        "PTP {AXIS:A1 26.5651, A2 3.46629,A3 34.4992, A4 220.355, A5 43.6572, A6 149.288}",
        "PTP {AXIS:A1 -42.605, A2 -10.3901,A3 19.0239, A4 -62.5439, A5 3.33649, A6 45.7593}",
        "PTP {AXIS:A1 37.8414, A2 -8.14868,A3 -2.29048, A4 57.5508, A5 -7.09465, A6 -42.9173}",
        "END",
        "",
      ].join("\r\n"),
    );
    writeFileSync(path, JSON.stringify({ ...program, ...rest, steps: [...steps, { id: "w", type: "wait", s: 1 }] }));
    const refused = twincell("post", path, "--to", "krl", "--form", "axis-list", "-o", to);
    expect(refused.code).toBe(1);
    expect(refused.err).toContain("Step w: ");
    expect(twincell("post", path, "--to", "krl", "--form", "song", "-o", to).err).toContain("Forms: axis-list.");
  });

  test("parse gives a program that simulates to the same end", () => {
    const text = join(folder, "post", "edge_trace.v2");
    const parsed = twincell("parse", text, "--robot", "staubli_rx90l", "--dialect", "v-plus");
    expect(parsed.code, parsed.err).toBe(0);
    const path = join(folder, "parsed.json");
    writeFileSync(path, parsed.out);
    const was = moments(twincell("simulate", PROGRAM).out).at(-1)!;
    const is = moments(twincell("simulate", path).out).at(-1)!;
    expect(distance(was.position, is.position)).toBeLessThan(0.00001);
  });
  test("text that cannot be read is named with line and column, exit 2", () => {
    const path = join(folder, "wrong.v2");
    writeFileSync(path, ".PROGRAM a()\n  MOVE (\n.END\n");
    for (const command of ["parse", "run"]) {
      const { code, sentences } = twincell(command, path, "--robot", "staubli_rx90l", "--dialect", "v-plus");
      expect(code).toBe(2);
      expect(sentences).toEqual([expect.stringMatching(/line 2, column \d+:/) as string]);
    }
  });
  test("--skip-unknown leaves out what is not understood and names it, motions above all", () => {
    const path = join(folder, "unknown.v2");
    writeFileSync(
      path,
      ".PROGRAM a()\n  MOVE #PPOINT(10,-90,90,0,45,0)\n  BREAK\n  FROBNICATE 5\n  MOVES SPIN(5)\n  DELAY 1\n.END\n",
    );
    expect(twincell("parse", path, "--robot", "staubli_rx90l").code).toBe(2);
    for (const command of ["parse", "run"]) {
      const { code, out, err } = twincell(
        command,
        path,
        "--robot",
        "staubli_rx90l",
        "--dialect",
        "v-plus",
        "--skip-unknown",
      );
      expect(code, err).toBe(0);
      expect(err).toMatch(/line 4, column 3: Line 4 is left out\. /);
      expect(err).toMatch(/line 5, column \d+: The motion in line 5 is left out: /);
      expect(err).toContain(
        "1 of 2 places left out is a motion or a branch: the robot does not do what the text says.",
      );
      if (command === "parse")
        expect((JSON.parse(out) as { steps: { type: string }[] }).steps.map(({ type }) => type)).toEqual([
          "move",
          "wait",
        ]);
    }
  });
  test("a program that cannot be carried out is not written, exit 1 with the step", () => {
    const path = changed("post-too-far", program => {
      pointed(program, "s4", [4, 0, 1]);
    });
    const target = join(folder, "none");
    const { code, sentences } = twincell("post", path, "--to", "v-plus", "-o", target);
    expect(code).toBe(1);
    expect(sentences[0]).toContain("s4");
    expect(() => readdirSync(target)).toThrow();
  });
  test("a place that cannot be written to is one sentence, exit 2, and nothing is left behind", () => {
    const file = join(folder, "file");
    writeFileSync(file, "mine");
    for (const target of [file, join(file, "below")]) {
      const { code, sentences } = twincell("post", PROGRAM, "--to", "v-plus", "-o", target);
      expect({ code, sentences }).toEqual({
        code: 2,
        sentences: [expect.stringContaining("is a file, not a folder") as string],
      });
    }
    expect(readFileSync(file, "utf8")).toBe("mine");
    const taken = join(folder, "taken");
    mkdirSync(join(taken, "edge_trace.v2"), { recursive: true });
    expect(twincell("post", PROGRAM, "--to", "v-plus", "-o", taken)).toMatchObject({
      code: 2,
      sentences: [expect.stringContaining("it is a folder") as string],
    });
    expect(readdirSync(taken)).toEqual(["edge_trace.v2"]);
    expect(twincell("check", PROGRAM, "--junit", join(file, "report.xml"))).toMatchObject({
      code: 2,
      sentences: [expect.stringContaining("is a file, not a folder") as string],
    });
  });
  test.skipIf(process.getuid?.() === 0)("a folder of somebody else's is one sentence, exit 2 (not as root)", () => {
    const closed = join(folder, "closed");
    mkdirSync(closed);
    chmodSync(closed, 0o555);
    expect(twincell("post", PROGRAM, "--to", "v-plus", "-o", closed)).toMatchObject({
      code: 2,
      sentences: [expect.stringContaining("may not write there") as string],
    });
    expect(readdirSync(closed)).toEqual([]);
  });
});

test("X-10 torques of a UR10e with 10 kg: check names joint and torque, simulate writes them and slows down when asked", () => {
  const q = (shoulder: number): number[] => [0.2, shoulder, 0.4, -1.5, -1.5, 0];
  const move = (id: string, shoulder: number): object => ({
    id,
    type: "move",
    path: "ptp",
    target: { q: q(shoulder) },
    speed: { ratio: 1 },
    blend_m: 0,
  });
  const path = join(folder, "heavy.json");
  writeFileSync(
    path,
    JSON.stringify({
      format: "twincell.program",
      version: 1,
      robot: "ur10e",
      tools: {},
      frames: {},
      steps: [{ id: "load", type: "payload", mass_kg: 10, center_m: [0, 0, 0.1] }, move("up", -1.6), move("out", -0.2)],
    }),
  );
  const judged = twincell("check", path);
  expect(judged.code).toBe(1);
  expect(judged.err).toMatch(/^Joint 2 is asked most: [\d.]+ of 330\.0 N m at [\d.]+ s\.$/m);
  expect(judged.out).toContain("with 10 kg; its limit is");
  const lines = twincell("simulate", path, "--torque", "--period", "0.01");
  const torques = lines.out
    .trim()
    .split("\n")
    .map(line => (JSON.parse(line) as { torque: number[] }).torque);
  expect(torques.every(torque => torque.length === 6)).toBe(true);
  const held = twincell("simulate", path, "--torque", "--within-torque", "--period", "0.01");
  expect(held.err).toMatch(
    /^Step out runs at \d\d % of its speed: joint 2 would need [\d.]+ N m; its limit is 330\.0 N m\.$/m,
  );
  expect(moments(held.out).at(-1)!.t).toBeGreaterThan(moments(lines.out).at(-1)!.t);
  for (const line of held.out.trim().split("\n"))
    expect(Math.abs((JSON.parse(line) as { torque: number[] }).torque[1]!)).toBeLessThan(330);
  const off = twincell("simulate", path, "--accuracy", "0.2,0.4")
    .out.trim()
    .split("\n")
    .map(line => JSON.parse(line) as { override: number; worst_m: number });
  expect(off.map(({ override }) => override)).toEqual([0.2, 0.4]);
  expect(off[1]!.worst_m).toBeGreaterThan(off[0]!.worst_m);
  const unknown = twincell("simulate", PROGRAM, "--torque");
  expect(unknown.code).toBe(1);
  expect(unknown.err).toMatch(/The torques of Stäubli RX90L are unknown/);
});

test("simulate stops at the step that cannot be carried out and names it, exit 1", () => {
  const path = changed("simulate-too-far", program => {
    pointed(program, "s4", [4, 0, 1]);
  });
  const { code, out, sentences } = twincell("simulate", path);
  expect(code).toBe(1);
  expect(sentences).toEqual([expect.stringMatching(/^twincell: Step s4: /) as string]);
  expect(moments(out).length).toBeGreaterThan(10);
  expect(out).not.toContain("NaN");
});

test("dialects says of each what it cannot", () => {
  const { code, out } = twincell("dialects");
  const [first] = moments(out);
  expect(code).toBe(0);
  expect(first).toMatchObject({ id: "v-plus", emits: true, parses: true, interprets: true });
});

const withNaN = (): string => {
  const path = join(folder, "nan.json");
  writeFileSync(
    path,
    readFileSync(`${root}${PROGRAM}`, "utf8").replace('"speed":{"ratio":0.3}', '"speed":{"ratio":NaN}'),
  );
  return path;
};
test.each([
  ["a number that is none", () => ["check", withNaN()], /nan\.json/],
  [
    "an angle that is none",
    () => [
      "check",
      changed("null", program => {
        program.steps[1]!.target = { q: [0, null, 0, 0, 0, 0], tool: "torch" };
      }),
    ],
    /steps.*1/,
  ],
  [
    "a robot nobody knows",
    () => [
      "simulate",
      changed("robot", program => {
        Object.assign(program, { robot: "nobody" });
      }),
    ],
    /no robot "nobody"/,
  ],
  ["a file that is not there", () => ["check", "nowhere.json"], /no file nowhere\.json/],
  ["a cell that is not there", () => ["check", PROGRAM, "--cell", "nowhere.json"], /no file nowhere\.json/],
  ["a program in place of a cell", () => ["check", PROGRAM, "--cell", PROGRAM], /program\.json/],
  ["a dialect nobody speaks", () => ["post", PROGRAM, "--to", "latin", "-o", folder], /no dialect "latin"/],
  ["no folder", () => ["post", PROGRAM, "--to", "v-plus"], /-o DIR is missing/],
  ["a period of nothing", () => ["simulate", PROGRAM, "--period", "0"], /--period/],
  ["a benchmark that is none", () => ["bench", "nobody"], /no benchmark "nobody".*frame/],
] as const)("%s is one sentence, exit 2", (_what, args, says) => {
  const { code, out, sentences } = twincell(...args());
  expect({ code, out, count: sentences.length }).toEqual({ code: 2, out: "", count: 1 });
  expect(sentences[0]).toMatch(says);
});

/** The last moment of each stretch that belongs to one step or line. */
function ends(all: readonly Moment[], of: (moment: Moment) => string): Moment[] {
  return all.filter(
    (moment, i) => of(moment) !== (i + 1 < all.length ? of(all[i + 1]!) : undefined) && moment.step !== "",
  );
}
const distance = (a: readonly number[], b: readonly number[]): number =>
  Math.hypot(...a.map((value, i) => value - b[i]!));
