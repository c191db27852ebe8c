import { spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pose, robotById } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { describeDialect, describeMutations, type DialectBench } from "../testing/describe-dialect.ts";
import { describeStructure } from "../testing/describe-structure.ts";
import { linesOf } from "../testing/lines.ts";
import { randomProgram } from "../testing/programs.ts";
import { structuredProgram } from "../testing/structured.ts";
import { rapid } from "./index.ts";

const bench: DialectBench = {
  robot: robotById("abb_irb120")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ"],
  structured: true,
  signals: linesOf("rapid"),
};

describeDialect(rapid, bench);
describeStructure(rapid, bench);
describeDialect(rapid, { ...bench, robot: robotById("abb_crb15000_5_95")!, branches: false });

const PYTHON = process.env["TWINCELL_PYTHON"] ?? "python3";
/** The Python package rapidchecker: somebody else's grammar of RAPID, which knows nothing of ours. */
const hasChecker = spawnSync(PYTHON, ["-c", "import rapidchecker"]).status === 0;
describe.skipIf(!hasChecker)("a grammar of RAPID that is not ours (pip install rapidchecker)", () => {
  test("takes what is written", () => {
    const { robot, worldFromBase, paths } = bench;
    const folder = mkdtempSync(join(tmpdir(), "rapid-"));
    try {
      const programs = [1, 2, 3].map(seed => randomProgram(robot, { seed, steps: 40, worldFromBase, paths }));
      for (const [i, program] of [
        ...programs,
        structuredProgram(robot, worldFromBase, new Set(["spline"]), { order: "rows-zigzag" }),
      ].entries()) {
        const emitted = rapid.emit(program, robot, worldFromBase);
        if (emitted.kind === "cannot") throw new Error(emitted.sentence);
        writeFileSync(join(folder, `p${i}.mod`), emitted.files[0]!.text.replaceAll("\r", ""));
      }
      const answer = spawnSync(PYTHON, ["-m", "rapidchecker", folder], { encoding: "utf8" });
      expect(answer.stdout + answer.stderr).toMatch(/No RAPID format errors/);
      expect(answer.status).toBe(0);
    } finally {
      rmSync(folder, { recursive: true });
    }
  });
});

/** Changes the first constant of that sort. */
const datum =
  (type: string, change: (value: string) => string) =>
  (text: string): string =>
    text.replace(
      new RegExp(`((?:CONST|PERS) ${type} \\w+:=)([^;]*)`),
      (_, head: string, value: string) => head + change(value),
    );
const part =
  (at: number, change: (list: string[]) => string[]) =>
  (value: string): string => {
    let seen = -1;
    return value.replace(/\[([-0-9.,E]+)\]/g, (whole, list: string) =>
      ++seen === at ? `[${change(list.split(",")).join(",")}]` : whole,
    );
  };
const negated = (text: string): string => (text.startsWith("-") ? text.slice(1) : `-${text}`);
const plus =
  (i: number, by: number) =>
  (list: string[]): string[] =>
    list.with(i, String(Number(list[i]) + by));
const swapped =
  (i: number, j: number) =>
  (list: string[]): string[] =>
    list.with(i, list[j]!).with(j, list[i]!);

describeMutations(rapid, bench, {
  "a joint with the wrong sign": datum(
    "jointtarget",
    part(0, list => list.with(1, negated(list[1]!))),
  ),
  "two joints in the wrong order": datum("jointtarget", part(0, swapped(3, 4))),
  "radians for degrees": datum(
    "jointtarget",
    part(0, list => list.map(x => String((Number(x) / 180) * Math.PI))),
  ),
  "a joint turned by a hundredth of a degree": datum("jointtarget", part(0, plus(0, 0.01))),
  "metres for millimetres": datum(
    "robtarget",
    part(0, list => list.map(x => String(Number(x) / 1000))),
  ),
  "x and y in the wrong order": datum("robtarget", part(0, swapped(0, 1))),
  "two hundredths of a millimetre too high": datum("robtarget", part(0, plus(2, 0.02))),
  "x y z w for w x y z": datum(
    "robtarget",
    part(1, ([w, x, y, z]) => [x!, y!, z!, w!]),
  ),
  "the conjugate of a quaternion": datum(
    "robtarget",
    part(1, ([w, x, y, z]) => [w!, negated(x!), negated(y!), negated(z!)]),
  ),
  "a tool with the wrong sign": datum(
    "tooldata",
    part(0, list => list.with(0, negated(list[0]!))),
  ),
  "a tool with another orientation": datum(
    "tooldata",
    part(1, () => ["0", "1", "0", "0"]),
  ),
  "a work object with the wrong sign": datum(
    "wobjdata",
    part(0, list => list.with(0, negated(list[0]!))),
  ),
  "a work object as object frame of itself": datum("wobjdata", value =>
    value.replace("[[0,0,0],[1,0,0,0]]", "[[0,0,100],[1,0,0,0]]"),
  ),
  "the wrong side of the wrist in every configuration": text =>
    text
      .replace(
        /(,\[-?[0-9],-?[0-9],-?[0-9],)([0-7])\]/g,
        (_, head: string, cfx: string) => `${head}${Number(cfx) ^ 1}]`,
      )
      .replace(
        /,\[(-?[0-9]),(-?[0-9]),(-?[0-9]),/g,
        (_, a: string, b: string, c: string) => `,[${a},${Number(b) >= 0 ? Number(b) - 2 : Number(b) + 2},${c},`,
      ),
  "a joint motion for a straight one": text => text.replace("MoveL ", "MoveJ "),
  "a straight motion for a joint one": text => text.replace("MoveJ ", "MoveL "),
  "the point of an arc and its end in the wrong order": text => text.replace(/MoveC (\w+),(\w+),/, "MoveC $2,$1,"),
  "a lost stop": text => text.replace(/,fine(,[^\n]*\n {4}Move)/, ",z10$1"),
  "a lost tool": text => text.replace(/,(torch|long_tool_2)([\\;])/, ",tool0$2"),
  "a lost work object": text => text.replace(/\\WObj:=\w+/, ""),
  "a lost motion": text => text.replace(/ {4}Move[^\n]*\n/, ""),
  "open for close": text =>
    text.replace(/SetDO doGripper,([01])/, (_, is: string) => `SetDO doGripper,${1 - Number(is)}`),
  "a wait in milliseconds": text =>
    text.replace(/WaitTime ([0-9.]+)/, (_, s: string) => `WaitTime ${Number(s) * 1000}`),
  "a speed in metres per second": datum("speeddata", value => value.replace(/[0-9.]+/, v => String(Number(v) / 1000))),
  "a lost duration": text => text.replace(/\\T:=[0-9.]+/, ""),
});
