/*
 * What programs of RC+ hold beside plain motions: point files, Jump, pallets, Till, memory bits, labels, other tasks.
 * Every program is written for this test; the positions that are expected are worked out by hand.
 */
import { robotById, type MoveStep } from "@twincell/core";
import { expect, test } from "vitest";
import { executeText, spel } from "./index.ts";
import { noticesOf, told as toldWith } from "./testing/brief.ts";

const robot = robotById("epson_c4_a601s")!;
const run = (text: string, inputs: Readonly<Record<string, boolean | number>> = {}): ReturnType<typeof executeText> =>
  executeText(spel, text, "cell", robot, undefined, { inputs, missingPrograms: "leave-out" });
/** The path and place [mm] of a motion, or its joint angles [°]. */
const motion = ({ path, target }: MoveStep): unknown =>
  "pose" in target
    ? `${path} ${target.pose.position.map(m => Math.round(m * 1e5) / 1e2 + 0).join(" ")}`
    : target.q.map(rad => Math.round((rad * 180e2) / Math.PI) / 1e2 + 0);
const told = (answer: ReturnType<typeof executeText>): unknown => toldWith(answer, motion);
const points = (
  ...taught: readonly (readonly [number: number, label: string, x: number, y: number, z: number])[]
): string =>
  [
    'sVersion="2.0.0"',
    "nNumberOfJoints=4",
    `nNumberOfPoints=${taught.length}`,
    ...taught.flatMap(([number, label, x, y, z], i) => [
      `Point${i + 1} {`,
      `\tnNumber=${number}`,
      `\tsLabel="${label}"`,
      "\tnUndefined=0",
      `\trX=${x}`,
      `\trY=${y}`,
      `\trZ=${z}`,
      "\trU=0",
      "\trV=0",
      "\trW=180",
      "\tnLocal=0",
      "}",
    ]),
    "",
  ].join("\r\n");

test("pick and place: points by number and label from the point file, Jump over LimZ, memory bits, what is done meanwhile", () => {
  const text = `${[
    "Function main",
    "  Motor On",
    "  Trap Error Xqt Stopped",
    "  LimZ 350",
    "  Go P0",
    "  Jump pick !D50; On 8!",
    "  MemOn 3",
    "  If MemSw(3) = On Then",
    "    Jump P2 +Z(20) LimZ 300",
    "  Else",
    "    Go P0",
    "  EndIf",
    "  Move P2 :Z(280)",
    "  BMove XY(10, -20, 0, 0)",
    "Fend",
  ].join("\n")}\n${points([0, "", 350, 0, 250], [1, "pick", 350, 100, 250], [2, "", 350, -50, 250])}`;
  const answer = run(text);
  expect(told(answer)).toEqual([
    "ptp 350 0 250",
    "lin 350 0 350",
    "lin 350 100 350",
    "lin 350 100 250",
    "DO8=true",
    "lin 350 100 300",
    "lin 350 -50 300",
    "lin 350 -50 270",
    "lin 350 -50 280",
    "lin 360 -70 280",
  ]);
  expect(noticesOf(answer)).toEqual([
    "3: Line 3 is shown, not executed: errors and interrupts are looked after.",
    "6: Line 6: what is done during the motion is done when it is over.",
    "6: Line 6: Jump is executed as up, across and down; its arch is not.",
    "9: Line 9: Jump is executed as up, across and down; its arch is not.",
  ]);
});

test("palletising: a pallet between taught corners, arrays, a search that a line ends, a label", () => {
  const text = `${[
    "Function main",
    "  Integer i, order(3)",
    "  order(1) = 4",
    "  Pallet 1, P1, P2, P3, 2, 3",
    "again:",
    "  i = i + 1",
    "  Move Pallet(1, order(1) + i - 1) Till Sw(2) = On",
    "  If i < 2 Then GoTo again",
    "  Wait Sw(5) = On, 2.5",
    "  Out 1, 6",
    "Fend",
  ].join("\n")}\n${points([1, "", 300, 0, 250], [2, "", 340, 0, 250], [3, "", 300, 100, 260])}`;
  const answer = run(text);
  // Two along x, three along y: the fourth is the second of the second row, the fifth the first of the third.
  expect(told(answer)).toEqual(["lin 340 50 255", "lin 300 100 260", "wait 2.5", "Out 1=6"]);
  expect(answer.kind === "executed" && answer.program.steps[0]).toMatchObject({
    until: { when: { signal: "DI2", is: true }, missing: "continue" },
  });
  expect(told(run(text, { DI5: true }))).toEqual(["lin 340 50 255", "lin 300 100 260", "wait 0", "Out 1=6"]);
});

test("what only the controller knows is left out with its line, and what counts from there too; kept as steps it is refused", () => {
  const text = [
    "Function main",
    "  Go P5",
    "  TMove XY(0, 0, 10, 0)",
    "  Go XY(350, 0, 250, 0, 0, 180)",
    "  Xqt Conveyor",
    "  CheckPart 3",
    "  BMove XY(0, 0, 10, 0)",
    "  If InW(4) = 2 Then Go P5",
    "  Jump XY(350, 50, 250, 0, 0, 180)",
    "  OpenNet #201 As Server",
    "Fend",
    "Function Conveyor",
    "  On 3",
    "Fend",
    "",
  ].join("\n");
  const answer = run(text);
  expect(told(answer)).toEqual(["ptp 350 0 250", "ptp 350 50 250"]);
  expect(noticesOf(answer)).toEqual([
    "10: Line 10 is shown, not executed: another device is spoken to.",
    "2: p5 is in none of the files: the motion is not executed.",
    "3: Where the robot stands before it is not known: the motion is not executed.",
    "5: What the task that is started beside does, motions too, is not executed.",
    "7: Where the robot stands before it is not known: the motion is not executed.",
    "9: Line 9: Jump lifts the hand to LimZ, which is not said: the motion goes straight to its goal.",
    "6: checkpart is called here and is in none of the files: what it does, motions too, is not executed.",
  ]);
  expect(spel.parse(text, robot)).toMatchObject({ kind: "not-understood" });
  expect(told(run("Function main\nGoTo nowhere\nFend\n"))).toMatch(/^line 2: The label nowhere is not reached/);
});
