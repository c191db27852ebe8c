import { pose, robotById, type Program } from "@twincell/core";
import { expect, test } from "vitest";
import { val3 } from "../index.ts";
import { linesOf } from "./lines.ts";
import { randomProgram } from "./programs.ts";
import { flawsOfApplication, type AppFile } from "./strict-val3.ts";
import { structuredProgram } from "./structured.ts";

const robot = robotById("staubli_rx160")!;
const worldFromBase = pose<"world", "base">([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]);
const cannot = val3.cannot.map(({ what }) => what);
const whole = structuredProgram(robot, worldFromBase, new Set(cannot));
const written = (program: Program): readonly AppFile[] => {
  const emitted = val3.emit(program, robot, worldFromBase);
  if (emitted.kind === "cannot") throw new Error(emitted.sentence);
  return emitted.files;
};

test("a strict checker, written from the facts alone, takes the VAL 3 applications that are written", () => {
  for (let seed = 1; seed <= 20; seed++)
    expect(
      flawsOfApplication(
        written(
          randomProgram(robot, {
            seed,
            steps: 40,
            worldFromBase,
            paths: ["ptp", "lin", "circ"],
            cannot,
            signals: linesOf("val3"),
          }),
        ),
      ),
    ).toEqual([]);
  for (const order of ["rows", "columns-zigzag"] as const)
    expect(flawsOfApplication(written(structuredProgram(robot, worldFromBase, new Set(cannot), { order })))).toEqual(
      [],
    );
});

test.each([
  ["a semicolon", "movej(Home,flange,m)", "movej(Home,flange,m);"],
  ["an argument that is missing", "movej(Home,flange,m)", "movej(Home,flange)"],
  ["an instruction in capitals", "movej(Home", "moveJ(Home"],
  ["a point that is nowhere", "movej(Home,", "movej(Away,"],
  ["a loop that is not closed", "endFor", ""],
  ["a decision that is not closed", "endIf", ""],
  ["a program that is not there", "call drop()", "call lost()"],
  ["assignment for comparison", "if part==true", "if part=true"],
  ["no begin", "    begin", ""],
  ["another namespace", "VAL3/Data/2", "VAL3/Data/9"],
  ["a father that is not there", 'fatherId="flange[0]"', 'fatherId="hand[0]"'],
  ["an angle that is no number", 'j3="90"', 'j3="90,0"'],
  ["a type that is none", 'type="mdesc"', 'type="motion"'],
  ["code outside of CDATA", "<![CDATA[", ""],
  ["an element that is not closed", "</Programs>", ""],
  ["a program that the project does not list", '    <Program file="stop.pgx"/>\r\n', ""],
  ["data that are not there", '<Data file="', '<Data file="Old_'],
  ["a project without a list of libraries", "  <Libraries/>\r\n", ""],
  ["a blend that is none", 'blend="off"', 'blend="none"'],
])("it refuses %s", (_, from, to) => {
  const files = written(whole);
  expect(files.some(({ text }) => text.includes(from))).toBe(true);
  expect(flawsOfApplication(files.map(file => ({ ...file, text: file.text.replace(from, to) })))).not.toEqual([]);
});

test("it refuses an application without its entries", () => {
  for (const name of ["start.pgx", "stop.pgx"])
    expect(flawsOfApplication(written(whole).filter(file => file.name !== name))).toContain(`there is no ${name}`);
});
