/*
 * What programs of a shop floor hold beside plain motions: offsets in the tool, second groups, arguments, remarks,
 * welding. Every program is written for this test; the positions that are expected are worked out by hand.
 */
import { robotById, type MoveStep } from "@twincell/core";
import { expect, test } from "vitest";
import { executeText, fanucLs } from "./index.ts";

const robot = robotById("fanuc_lrmate200id")!;
/** Where the world of the controller counts from [m]: the height of joint 2. */
const ZERO_Z_M = 0.33;
const position = (number: number, x_mm: number, more = ""): string =>
  [
    `P[${number}]{`,
    "   GP1:",
    "	UF : 0, UT : 0,		CONFIG : 'N U T, 0, 0, 0',",
    `	X = ${x_mm} mm,	Y = 0 mm,	Z = 100 mm,`,
    "	W = 180 deg,	P = 0 deg,	R = 0 deg",
    ...(more === "" ? [] : ["   GP2:", "	UF : 0, UT : 0,", `	J1 = ${more} deg`]),
    "};",
  ].join("\n");
const listing = (name: string, statements: readonly string[], positions: readonly string[] = []): string =>
  [
    `/PROG  ${name}`,
    "/MN",
    ...statements.map((each, i) => `${String(i + 1).padStart(4)}:${each}`),
    "/POS",
    ...positions,
    "/END",
    "",
  ].join("\n");
const run = (text: string): ReturnType<typeof executeText> => executeText(fanucLs, text, "cell", robot);
/** X, Y, Z of every motion [mm] in the controller's world, or the first fault. */
function places(answer: ReturnType<typeof executeText>): unknown {
  if (answer.kind === "not-understood") return `line ${answer.faults[0]!.line}: ${answer.faults[0]!.sentence}`;
  return answer.program.steps
    .filter((step): step is MoveStep => step.type === "move")
    .map(({ target }) => {
      if (!("pose" in target)) return "joints";
      const [x, y, z] = target.pose.position;
      return [x, y, z - ZERO_Z_M].map(m => Math.round(m * 1e6) / 1e3 + 0);
    });
}

test("Tool_Offset shifts a point along the axes of its own tool: with the hand down, +20 along z is 20 mm lower, +y is −y", () => {
  const statements = [
    "  PR[5]=LPOS    ;",
    ...[0, 5, 20, 0, 0, 0].map((value, i) => `  PR[5,${i + 1}]=${value}    ;`),
    "L P[1] 100mm/sec FINE Tool_Offset,PR[5]    ;",
    "  TOOL_OFFSET CONDITION PR[5]    ;",
    "L P[2] 100mm/sec FINE Tool_Offset    ;",
    "L P[2] 100mm/sec FINE    ;",
  ];
  expect(places(run(listing("SHIFT", statements, [position(1, 400), position(2, 450)])))).toEqual([
    [400, -5, 80],
    [450, -5, 80],
    [450, 0, 100],
  ]);
});

test("a program called with arguments reads them as AR[n]", () => {
  const main = listing("MAIN", ["  CALL GO(30,2)    ;", "  CALL GO(10,4)    ;"]);
  const called = listing(
    "GO",
    [
      "  PR[1]=LPOS    ;",
      ...[0, 0, 0, 0, 0, 0].map((value, i) => `  PR[1,${i + 1}]=${value}    ;`),
      "  PR[1,1]=AR[1]*AR[2]    ;",
      "L P[1] 100mm/sec FINE Offset,PR[1]    ;",
    ],
    [position(1, 300)],
  );
  expect(places(run(main + called))).toEqual([
    [360, 0, 100],
    [340, 0, 100],
  ]);
});

test("remarks behind a semicolon, text registers and the arc are kept; the arc and the register are named", () => {
  const statements = [
    "  SR[3]=SR[4]    ;",
    "L P[1] 100mm/sec FINE    ; ! above the seam",
    "  Arc Start[1]    ;",
    "L P[2] 100mm/sec FINE    ; // end of the seam",
    "  Arc End[1]    ;",
  ];
  const answer = run(listing("WELD", statements, [position(1, 400), position(2, 450)]));
  expect(places(answer)).toEqual([
    [400, 0, 100],
    [450, 0, 100],
  ]);
  expect(answer.kind === "executed" && answer.notExecuted.map(({ sentence }) => sentence)).toEqual([
    "Line 3 is shown, not executed: a text register is given a text.",
    "Line 5 is shown, not executed: the arc of a welding torch is switched.",
    "Line 7 is shown, not executed: the arc of a welding torch is switched.",
  ]);
});

test("a second group is kept and named as not moved; COORD is executed while that group stands still and refused when it goes on", () => {
  const statements = ["L P[1] 100mm/sec FINE COORD    ;", "L P[2] 100mm/sec FINE COORD    ;"];
  const still = run(listing("TURN", statements, [position(1, 400, "15.5"), position(2, 450, "15.5")]));
  expect(places(still)).toEqual([
    [400, 0, 100],
    [450, 0, 100],
  ]);
  expect(still.kind === "executed" && still.notExecuted.map(({ sentence }) => sentence)).toEqual([
    "Further axes are kept and not moved: P[1] has GP2 J1 15.5; and 1 more positions name theirs.",
  ]);
  expect(places(run(listing("TURN", statements, [position(1, 400, "15.5"), position(2, 450, "30")])))).toBe(
    "line 4: With COORD the robot follows the other group, which goes from GP2 J1 15.5 to GP2 J1 30: other groups are not moved here.",
  );
});

test("weaving changes the path and is refused with its line", () => {
  expect(
    places(run(listing("WEAVE", ["  Weave Sine[1]    ;", "L P[1] 100mm/sec FINE    ;"], [position(1, 400)]))),
  ).toBe('line 3: "WEAVE" is no statement of TP that is executed here.');
});
