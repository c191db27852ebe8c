import { pose, robotById } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { describeDialect, describeMutations, type DialectBench } from "../testing/describe-dialect.ts";
import { describeStructure } from "../testing/describe-structure.ts";
import { linesOf } from "../testing/lines.ts";
import { randomProgram } from "../testing/programs.ts";
import { flawsOf } from "../testing/strict-urscript.ts";
import { structuredProgram } from "../testing/structured.ts";
import { urScript } from "./index.ts";

const bench: DialectBench = {
  robot: robotById("ur10e")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ"],
  structured: true,
  signals: linesOf("urscript"),
};

describeDialect(urScript, bench);
describeStructure(urScript, bench);

describe("a strict grammar, written from the facts by itself", () => {
  const { robot, worldFromBase, paths } = bench;
  const cannot = new Set(urScript.cannot.map(({ what }) => what));
  const text = (program: Parameters<typeof urScript.emit>[0]): string => {
    const emitted = urScript.emit(program, robot, worldFromBase);
    if (emitted.kind === "cannot") throw new Error(emitted.sentence);
    return emitted.files[0]!.text;
  };

  test("takes what is written", () => {
    for (let seed = 1; seed <= 20; seed++)
      expect(flawsOf(text(randomProgram(robot, { seed, steps: 40, worldFromBase, paths })))).toEqual([]);
    for (const order of ["rows", "columns-zigzag"] as const)
      expect(flawsOf(text(structuredProgram(robot, worldFromBase, cannot, { order })))).toEqual([]);
  });

  test("refuses what a controller would refuse", () => {
    const good = text(structuredProgram(robot, worldFromBase, cannot));
    for (const [from, to] of [
      ["movel(", "movL("],
      ["v=0.1", "speed=0.1"],
      ["\nend\n", "\n"],
      ["set_tcp(torch)", "set_tcp(torche)"],
      ["p[0, 0, 0.08, 0, 0, 0]", "p[0, 0, 0.08, 0, 0]"],
      ["while count < 5:", "while count < 5"],
      ["global lamp = 3", "global 3lamp = 3"],
      ["def drop():", "def drop:"],
      ["0.25)", "0,25,)"],
      ["sync()", "sync("],
    ] as const) {
      expect(good).toContain(from);
      expect(flawsOf(good.replace(from, to)), to).not.toEqual([]);
    }
  });
});

/** Changes the numbers of the first match: of a list of joint angles, or of a pose. */
const numbers =
  (head: RegExp, change: (list: string[]) => string[]) =>
  (text: string): string =>
    text.replace(head, (_, before: string, list: string) => `${before}${change(list.split(", ")).join(", ")}]`);
const joints = (change: (list: string[]) => string[]): ((text: string) => string) =>
  numbers(/(movej\(\[)([^\]]*)\]/, change);
const pose_ = (change: (list: string[]) => string[]): ((text: string) => string) =>
  numbers(/(move[jl]\((?:pose_trans\(\w+, )?p\[)([^\]]*)\]/, change);
const negated = (text: string): string => (text.startsWith("-") ? text.slice(1) : `-${text}`);
const plus =
  (i: number, by: number) =>
  (list: string[]): string[] =>
    list.with(i, String(Number(list[i]) + by));
const swapped =
  (i: number, j: number) =>
  (list: string[]): string[] =>
    list.with(i, list[j]!).with(j, list[i]!);

describeMutations(urScript, bench, {
  "a joint with the wrong sign": joints(list => list.with(1, negated(list[1]!))),
  "two joints in the wrong order": joints(swapped(3, 4)),
  "degrees for radians": joints(list => list.map(x => String((Number(x) / Math.PI) * 180))),
  "a joint turned by a hundredth of a degree": joints(plus(0, (0.01 / 180) * Math.PI)),
  "a whole turn too much": joints(plus(5, 2 * Math.PI)),
  "millimetres for metres": pose_(list => list.map((x, i) => (i < 3 ? String(Number(x) * 1000) : x))),
  "x and y in the wrong order": pose_(swapped(0, 1)),
  "the robot's base for the controller's": pose_(list => [negated(list[0]!), negated(list[1]!), ...list.slice(2)]),
  "a rotation vector with the wrong sign": pose_(list => list.map((x, i) => (i < 3 ? x : negated(x)))),
  "a rotation vector in degrees": pose_(list => list.map((x, i) => (i < 3 ? x : String((Number(x) / Math.PI) * 180)))),
  "a rotation vector in another order": pose_(swapped(3, 5)),
  "a height two hundredths of a millimetre off": pose_(plus(2, 2e-5)),
  "a joint motion for a straight one": text => text.replace("movel(p", "movej(p"),
  "the point of an arc and its end in the wrong order": text =>
    text.replace(/movec\((p\[[^\]]*\]), (p\[[^\]]*\])/, "movec($2, $1"),
  "a lost stop": text =>
    text.replace(/(movej\(\[[^\]]*\], v=[0-9.]+)\)(?=\n(?: {2}(?:#|set_tcp)[^\n]*\n)* {2}move)/, "$1, r=0.01)"),
  "a lost tool": text => text.replace(/ {2}set_tcp\((?!p)[^\n]*\n/, ""),
  "a tool with the wrong sign": text =>
    text.replace(/(global torch = p\[)([^,]*)/, (_, head: string, x: string) => head + negated(x)),
  "a frame with the wrong sign": text =>
    text.replace(/(global carton = p\[)([^,]*)/, (_, head: string, x: string) => head + negated(x)),
  "a pose that does not count from its frame": text => text.replace(/pose_trans\(\w+, (p\[[^\]]*\])\)/, "$1"),
  "a pose added to its frame": text => text.replace("pose_trans(", "pose_add("),
  "a lost motion": text => text.replace(/ {2}move[^\n]*\n/, ""),
  "open for close": text =>
    text.replace(
      /set_tool_digital_out\(0, (\w+)\)/,
      (_, is: string) => `set_tool_digital_out(0, ${is === "True" ? "False" : "True"})`,
    ),
  "a wait in milliseconds": text => text.replace(/sleep\(([0-9.]+)\)/, (_, s: string) => `sleep(${Number(s) * 1000})`),
  "a speed in millimetres per second": text =>
    text.replace(/(movel\([^\n]*v=)([0-9.]+)/, (_, head: string, v: string) => head + String(Number(v) * 1000)),
  "a speed in degrees per second": text =>
    text.replace(
      /(movej\([^\n]*v=)([0-9.]+)/,
      (_, head: string, v: string) => head + String((Number(v) / 180) * Math.PI),
    ),
  "a speed for a duration": text => text.replace(", t=", ", v="),
});
