/*
 * What programs of a shop floor hold beside plain motions: offsets in the tool, second groups, arguments, remarks,
 * welding. Every program is written for this test; the positions that are expected are worked out by hand.
 */
import { robotById, type MoveStep } from "@twincell/core";
import { expect, test } from "vitest";
import { executeText, fanucLs } from "./index.ts";
import { noticesOf, told as toldWith } from "./testing/brief.ts";

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
const run = (text: string): ReturnType<typeof executeText> =>
  executeText(fanucLs, text, "cell", robot, undefined, { missingPrograms: "leave-out" });
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

/** The place [mm] of a motion as the controller counts it, or its joint angles [°]. */
const motion = ({ target }: MoveStep): unknown => {
  if (!("pose" in target)) return target.q.map(rad => Math.round((rad * 180e3) / Math.PI) / 1e3 + 0);
  const [x, y, z] = target.pose.position;
  return [x, y, z - ZERO_Z_M].map(m => Math.round(m * 1e6) / 1e3 + 0).join(" ");
};
const told = (answer: ReturnType<typeof executeText>): unknown => toldWith(answer, motion);
const joints = (number: number, deg: readonly number[]): string =>
  [
    `P[${number}]{`,
    "   GP1:",
    "	UF : F, UT : F,",
    ...[0, 3].map(from => `	${[0, 1, 2].map(i => `J${from + i + 1}= ${deg[from + i]} deg`).join(",	")},`),
    "};",
  ].join("\n");

test("machine tending: the logic of a point is done when the point is reached, in the order of its lines, in English and in German", () => {
  const english = listing(
    "TEND",
    [
      "  UTOOL_NUM=0 ;",
      "J P[1] 50% CNT0 ACC100 TB   0.00sec,P-SPS    ;\n      1:  DO[15:door]=ON ;\n      2:  WAIT (DI[9])    ;\n       ------ ;",
      "  F[3:loaded]=(ON) ;",
      "  IF (F[3] AND !DI[4]),CALL LEAVE ;",
      "  JMP LBL[1] ;",
      "L P[3] 100mm/sec FINE    ;",
      "  LBL[1] ;",
    ],
    [position(1, 400), position(3, 300)],
  );
  const leave = listing("LEAVE", ["L P[2] max_speed FINE DB   5.0mm,DO[16]=OFF    ;"], [position(2, 450)]);
  const german = english
    .replace("/MN", "/ATTR\nEIGN.\t\t= MNEDITOR;\n/MN")
    .replace("UTOOL_NUM", "WKZ_NUM")
    .replace("TB   0.00sec", "ZEIT VOR   0.00sek")
    .replace("DO[15:door]=ON", "A[15:door]=AN")
    .replace("WAIT (DI[9])", "WARTE (E[9])")
    .replace("(ON)", "(AN)")
    .replace("IF (F[3] AND !DI[4]),CALL", "WENN (F[3] [&] !E[4]),AUFRUF")
    .replace("JMP LBL[1]", "SPRUNG LABEL[1]")
    .replace("  LBL[1] ;", "  LABEL[1] ;");
  const wanted = ["400 0 100", "door=true", "until DI[9]", "450 0 100", "DO[16]=false"];
  expect(told(run(english + leave))).toEqual(wanted);
  expect(told(run(german + leave))).toEqual(wanted);
  expect(noticesOf(run(english + leave))).toEqual([
    expect.stringMatching(/: DB 5mm: what is done about the point is done when it is reached\.$/),
  ]);
});

test("palletising: register values come from the backup's .va files; PR in joint angles, offsets from R, a label that is worked out", () => {
  const text =
    listing(
      "STACK",
      [
        "J PR[1:HOME] 20% FINE    ;",
        "  FOR R[5]=1 TO 2 ;",
        "  PR[2,1]=R[5]*R[7:pitch]    ;",
        "L P[1] R[8]mm/sec FINE Offset,PR[2]    ;",
        "  ENDFOR ;",
        "  JMP LBL[R[9]] ;",
        "  LBL[1] ;",
        "L P[2] 100mm/sec FINE    ;",
        "  LBL[2] ;",
        "  RO[2]=(R[5]>5) ;",
      ],
      [position(1, 300), position(2, 450)],
    ) +
    [
      "[*NUMREG*]$NUMREG  Storage: CMOS  Access: RW  : ARRAY[200] OF Numeric Reg",
      "  [7] = 40.5  'pitch' ",
      "  [8] = 250  '' ",
      "  [9] = 2  '' ",
      "[*POSREG*]$POSREG  Storage: CMOS  Access: RW  : ARRAY[1,100] OF Position Reg",
      "    [1,1] =   'HOME J1 = 9'   Group: 1",
      "  J1 =    10.000 deg   J2 =   -20.000 deg   J3 =    30.000 deg ",
      "  J4 =     0.000 deg   J5 =   -60.000 deg   J6 =     0.000 deg ",
      "    [1,2] =   '' ",
      "  Group: 1   Config: N U T, 0, 0, 0",
      "  X:     0.000   Y:     0.000   Z:    15.000",
      "  W:     0.000   P:     0.000   R:     0.000",
      "    [1,3] =   '' Uninitialized",
      "",
    ].join("\n");
  const answer = run(text);
  // J3 is shown against the horizon: joint 3 is 30 − 20.
  expect(told(answer)).toEqual([[10, -20, 10, 0, -60, 0], "340.5 0 115", "381 0 115", "RO[2]=false"]);
  expect(answer.kind === "executed" && answer.program.steps[1]).toMatchObject({ speed: { mps: 0.25 } });
  expect(noticesOf(answer)).toEqual([]);
});

test("what only the controller knows is named with its line: a motion to it is left out, and what counts from there too", () => {
  const statements = [
    "J PR[4:PARK] 20% FINE    ;",
    "L P[1] 100mm/sec FINE INC    ;",
    "L P[2] WELD_SPEED CNT100    ;",
    "L P[1] 100mm/sec FINE INC    ;",
    "  CALL GRIP(1,'soft') ;",
    "  PR[5]=LPOS    ;",
    "  IF R[6:parts]=0,JMP LBL[1] ;",
    "L P[2] 100mm/sec FINE    ;",
    "  LBL[1] ;",
    "L PR[5] 100mm/sec FINE    ;",
    "J P[3] 10% FINE    ;",
  ];
  const answer = run(
    listing("LOAD", statements, [
      position(1, 30).replace("Z = 100", "Z = -5").replace("W = 180", "W = 0"),
      position(2, 400),
      joints(3, [0, 0, 0, 0, -90, 0]),
    ]),
  );
  expect(told(answer)).toEqual(["400 0 100", "430 0 95", "430 0 95", [0, 0, 0, 0, -90, 0]]);
  expect(noticesOf(answer)).toEqual([
    "3: PR[4] (PARK) is in none of the files: the motion is not executed.",
    "4: Where the robot stands before it is not known: the motion is not executed.",
    "5: The speed of line 5 is in none of the files: it is planned at 10 mm/s.",
    "9: R[6] (parts) is in none of the files: it is taken as 0.",
    "7: GRIP is called here and is in none of the files: what it does, motions too, is not executed.",
  ]);
  // Kept as steps nothing of it may be guessed.
  expect(fanucLs.parse(listing("LOAD", ["J PR[4:PARK] 20% FINE    ;"]), robot)).toMatchObject({
    kind: "not-understood",
  });
});

test("Skip, SkipJump and TIMEOUT lead to their labels when the line says so", () => {
  const statements = [
    "  SKIP CONDITION DI[1]=ON    ;",
    "L P[1] 100mm/sec FINE Skip,LBL[5]    ;",
    "  DO[1]=ON ;",
    "  LBL[6] ;",
    "L P[2] 100mm/sec FINE SkipJump,LBL[7]    ;",
    "  $WAITTMOUT=200 ;",
    "  WAIT DI[2]=ON TIMEOUT,LBL[7]    ;",
    "  DO[2]=ON ;",
    "  END ;",
    "  LBL[5] ;",
    "  DO[5]=ON ;",
    "  JMP LBL[6] ;",
    "  LBL[7] ;",
    "  DO[7]=ON ;",
  ];
  const text = listing("SEEK", statements, [position(1, 400), position(2, 450)]);
  const given = (inputs: Readonly<Record<string, boolean>>): unknown =>
    told(executeText(fanucLs, text, "cell", robot, undefined, { inputs }));
  const looked = Array.from({ length: 10 }, () => "wait 0.2");
  // Nothing comes: the first search goes to 5, the second on, the wait to 7 after 2 s.
  expect(given({})).toEqual(["400 0 100", "DO[5]=true", "450 0 100", ...looked, "DO[7]=true"]);
  expect(given({ "DI[2]": true })).toEqual(["400 0 100", "DO[5]=true", "450 0 100", "wait 0", "DO[2]=true"]);
  expect(given({ "DI[1]": true })).toEqual(["400 0 100", "DO[1]=true", "450 0 100", "DO[7]=true"]);
});

test("a jump to a label that is not there, and a tool that stands in the cell, are refused with their lines", () => {
  expect(told(run(listing("LOST", ["  JMP LBL[3] ;"])))).toMatch(/^line 3: A jump goes to the label 3/);
  const remote = position(1, 400).replace("X =", "RX =").replace("Y =", "RY =").replace("Z =", "RZ =");
  expect(
    told(
      run(
        listing(
          "GRIND",
          ["L P[1] 100mm/sec FINE RTCP    ;"],
          [remote.replace("W =", "RW =").replace("P =", "RP =").replace("R = 0", "RR = 0")],
        ),
      ),
    ),
  ).toMatch(/^line 3: P\[1\] was taught with a tool that stands in the cell/);
});
