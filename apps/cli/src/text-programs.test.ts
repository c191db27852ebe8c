import { spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { addProgram, emptyCell, saveDocument, textFileOf } from "@twincell/project";
import { zipSync } from "fflate";
import { afterAll, expect, test } from "vitest";

const root = fileURLToPath(new URL("../../../", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "twincell-text-"));
afterAll(() => {
  rmSync(folder, { recursive: true, force: true });
});
const SRC = "DEF weld( )\r\nPTP XHOME\r\n; f\u00fcr\r\nPTP XP1\r\nEND\r\n";
const DAT = (a1: number): string =>
  `DEFDAT weld\r\nDECL E6AXIS XHOME={A1 0.0,A2 -90.0,A3 90.0,A4 0.0,A5 20.0,A6 0.0}\r\nDECL E6AXIS XP1={A1 ${a1},A2 -80.0,A3 90.0,A4 0.0,A5 20.0,A6 0.0}\r\nENDDAT\r\n`;
function project(name: string, a1: number): string {
  const at = join(folder, name);
  mkdirSync(at);
  writeFileSync(join(at, "weld.src"), Buffer.from(SRC, "latin1"));
  writeFileSync(join(at, "weld.dat"), Buffer.from(DAT(a1), "latin1"));
  return at;
}
function twincell(...args: readonly string[]) {
  const run = spawnSync(process.execPath, ["apps/cli/src/main.ts", ...args], { cwd: root, encoding: "utf8" });
  return { code: run.status, out: run.stdout, err: run.stderr };
}
interface Judged {
  readonly ok: boolean;
  readonly steps: readonly { readonly verdict: string; readonly file: string; readonly line: number }[];
}
const good = project("good", 30);
const bad = project("bad", 200);
const ROBOT = ["--robot", "kuka_kr6_2"];

test("run and check --as-text find the .dat beside the .src, and take both files or their folder as well", () => {
  for (const paths of [
    [join(good, "weld.src")],
    [join(good, "weld.dat"), join(good, "weld.src")],
    [good, "--dialect", "krl"],
  ]) {
    const checked = twincell("check", ...paths, "--as-text", ...ROBOT);
    expect(checked).toMatchObject({ code: 0 });
    const { ok, steps } = JSON.parse(checked.out) as Judged;
    expect(ok).toBe(true);
    expect(steps.map(({ verdict, file, line }) => [verdict, file, line])).toEqual([
      ["ok", join(good, "weld.src"), 2],
      ["ok", join(good, "weld.src"), 4],
    ]);
    const ran = twincell("run", ...paths, ...ROBOT, "--period", "0.1");
    expect(ran).toMatchObject({ code: 0 });
    const last = JSON.parse(ran.out.trim().split("\n").at(-1)!) as { readonly q: readonly number[] };
    expect(
      Math.abs(last.q[0]! + (30 / 180) * Math.PI) < 1e-6 || Math.abs(last.q[0]! - (30 / 180) * Math.PI) < 1e-6,
    ).toBe(true);
  }
});

test("an archive is a folder: its one program opens as it is, of several one is named by its path, a broken one is one sentence", () => {
  const bytes = (text: string): Uint8Array => Buffer.from(text, "latin1");
  const at = (name: string): string => join(folder, name);
  writeFileSync(at("one.zip"), zipSync({ "KRC/R1/weld.src": bytes(SRC), "KRC/R1/weld.dat": bytes(DAT(30)) }));
  const two = { "R1/weld.src": bytes(SRC), "R1/weld.dat": bytes(DAT(30)), "R1/other.src": bytes(SRC) };
  writeFileSync(at("two.zip"), zipSync({ ...two, "am.ini": bytes("[Archive]") }));
  writeFileSync(at("broken.zip"), "PK");
  const inside = `${at("two.zip")}/R1/weld.src`;
  for (const [path, file] of [
    [at("one.zip"), `${at("one.zip")}/KRC/R1/weld.src`],
    [inside, inside],
  ] as const) {
    const checked = twincell("check", path, "--as-text", ...ROBOT, "--dialect", "krl");
    expect(checked).toMatchObject({ code: 0 });
    const { steps } = JSON.parse(checked.out) as Judged;
    expect(steps.map(step => [step.file, step.line])).toEqual([
      [file, 2],
      [file, 4],
    ]);
  }
  expect(twincell("run", at("one.zip"), ...ROBOT, "--dialect", "krl", "--period", "0.5")).toMatchObject({ code: 0 });
  // Files of no language, such as the list of the backup, are passed over.
  const several = twincell("check", at("two.zip"), "--as-text", ...ROBOT);
  expect(several).toMatchObject({ code: 2 });
  expect(several.err).toContain(`${at("two.zip")} holds 2 programs.`);
  expect(several.err).toContain(`${at("two.zip")}/R1/other.src`);
  expect(twincell("check", `${inside}x`, "--as-text", ...ROBOT, "--dialect", "krl").err).toContain(
    "There is no file R1/weld.srcx",
  );
  expect(twincell("check", at("broken.zip"), "--as-text", ...ROBOT, "--dialect", "krl")).toMatchObject({ code: 2 });
});

test("a program of a controller's backup runs with the routines and data of other folders that it names, and with no others", () => {
  const r1 = join(folder, "backup", "KRC", "R1");
  const write = (path: string, ...lines: string[]): void => {
    mkdirSync(join(r1, path, ".."), { recursive: true });
    writeFileSync(join(r1, path), `${lines.join("\r\n")}\r\n`);
  };
  write("Program/Jobs/main.src", "&ACCESS RVP", "DEF main( )", "PTP XHOME", "approach(turn)", "END");
  write("Program/Lib/approach.src", "&ACCESS RVP", "DEF approach(by :IN)", "DECL REAL by", "PTP {A1 by}", "END");
  write("Program/Lib/unnamed.src", "&ACCESS RVP", "DEF unnamed( )", "no statement at all", "END");
  write(
    "System/$config.dat",
    "DEFDAT  $CONFIG",
    "DECL E6AXIS XHOME={A1 0,A2 -90,A3 90,A4 0,A5 20,A6 0}",
    "REAL turn=12.5",
    "ENDDAT",
  );
  const main = join(r1, "Program", "Jobs", "main.src");
  const checked = twincell("check", main, "--as-text", ...ROBOT);
  expect(checked).toMatchObject({ code: 0 });
  const { ok, steps } = JSON.parse(checked.out) as Judged;
  expect(ok).toBe(true);
  expect(steps.map(({ file, line }) => [file, line])).toEqual([
    [main, 3],
    [join(r1, "Program", "Lib", "approach.src"), 4],
  ]);
  const ran = twincell("run", main, ...ROBOT, "--period", "0.1");
  const last = JSON.parse(ran.out.trim().split("\n").at(-1)!) as { readonly q: readonly number[] };
  expect(Math.abs(last.q[0]!)).toBeCloseTo((12.5 / 180) * Math.PI, 6);
});

test("check --as-text says what is wrong with its file and line, and ends with 1", () => {
  const { code, err } = twincell("check", join(bad, "weld.src"), "--as-text", ...ROBOT);
  expect(code).toBe(1);
  expect(err).toContain(`${join(bad, "weld.src")}, line 4: `);
});

test("check --as-text names on stderr what it shows and does not execute, with file and line, and judges the rest", () => {
  const path = join(folder, "lamp.script");
  const lines = [
    "def job():",
    "  thread counter():",
    "    while (True):",
    "      sync()",
    "    end",
    "  end",
    "  run counter()",
    "  movej([0.1, -1.2, 1.3, -1.6, -1.5, 0.2], a=1.4, v=1.05)",
    "end",
    "job()",
  ];
  writeFileSync(path, `${lines.join("\n")}\n`);
  const { code, out, err } = twincell("check", path, "--as-text", "--robot", "ur10e");
  expect(err).toContain(`${path}, line 2: Thread counter is shown, not executed: it does not move the robot.`);
  expect([code, (JSON.parse(out) as Judged).steps.map(({ line }) => line)]).toEqual([0, [8]]);
});

test("check --as-text judges the text that a cell keeps, in that cell and on its robot", () => {
  const files = [
    textFileOf("weld.src", Buffer.from(SRC, "latin1")),
    textFileOf("weld.dat", Buffer.from(DAT(30), "latin1")),
  ];
  const cell = addProgram(emptyCell("kuka_kr6_2"), {
    format: "twincell.text-program",
    version: 1,
    name: "weld",
    robot: "kuka_kr6_2",
    language: "krl",
    main: "weld.src",
    files,
  });
  const path = join(folder, "cell.json");
  writeFileSync(path, saveDocument(cell));
  const checked = twincell("check", path, "--as-text");
  expect(checked).toMatchObject({ code: 0 });
  expect((JSON.parse(checked.out) as Judged).steps.map(({ file, line }) => [file, line])).toEqual([
    ["weld.src", 2],
    ["weld.src", 4],
  ]);
  writeFileSync(path, saveDocument(emptyCell("kuka_kr6_2")));
  expect(twincell("check", path, "--as-text").err).toContain('the selected program "Program" is of steps');
});

test("a fault is named with its own file, a binary program and a missing file with one sentence", () => {
  const wrong = project("wrong", 30);
  writeFileSync(join(wrong, "weld.dat"), "DEFDAT weld\r\nDECL E6AXIS XHOME={A1 0.0,A2 }\r\nENDDAT\r\n");
  const faulty = twincell("check", join(wrong, "weld.src"), "--as-text", ...ROBOT);
  expect(faulty.code).toBe(2);
  expect(faulty.err).toContain(`${join(wrong, "weld.dat")}, line 2, column `);
  const binary = join(folder, "main.src");
  writeFileSync(binary, Uint8Array.from([1, 0, 2]));
  expect(twincell("run", binary, ...ROBOT)).toMatchObject({ code: 2 });
  expect(twincell("run", binary, ...ROBOT).err).toContain("main.src is a binary program, not a text.");
  expect(twincell("run", join(folder, "none.src"), ...ROBOT)).toMatchObject({ code: 2 });
});

test("check --as-text refuses a text that calls a program of no file, with its line; left out when asked for, it is not ok: exit 1", () => {
  const path = join(folder, "main.ls");
  const position =
    "P[1]{\n   GP1:\n  UF : 0, UT : 1,\n  J1= 0 deg, J2= 0 deg, J3= 0 deg,\n  J4= 0 deg, J5= -90 deg, J6= 0 deg\n};\n";
  writeFileSync(path, `/PROG MAIN\n/MN\n   1:  J P[1] 50% FINE ;\n   2:  CALL PICK ;\n/POS\n${position}/END\n`);
  for (const command of [
    ["check", path, "--as-text"],
    ["run", path],
  ] as const) {
    const refused = twincell(...command, "--robot", "fanuc_lrmate200id");
    expect([refused.code, refused.out]).toEqual([2, ""]);
    expect(refused.err).toContain(
      `${path}, line 4, column 8: PICK is called here and is in none of the files: give the file that holds it as well, or let the call do nothing.`,
    );
  }
  expect(twincell("run", path, "--leave-out-missing", "--robot", "fanuc_lrmate200id").code).toBe(0);
  const checked = twincell("check", path, "--as-text", "--leave-out-missing", "--robot", "fanuc_lrmate200id");
  expect(checked.code).toBe(1);
  const { ok, steps, assumed } = JSON.parse(checked.out) as Judged & { assumed: { file: string; line: number }[] };
  expect([ok, steps.map(({ verdict }) => verdict)]).toEqual([false, ["ok"]]);
  expect(assumed).toContainEqual(expect.objectContaining({ file: path, line: 4 }));
  expect(checked.err).toContain("The verdict is not ok");
});
