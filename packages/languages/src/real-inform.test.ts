/*
 * What jobs of a shop floor hold beside plain motions: stations, variables, arguments, searches, jobs of other files.
 * Every job is written for this test; the positions that are expected are worked out by hand.
 */
import { robotById, type MoveStep } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { executeText, informDialect } from "./index.ts";
import { noticesOf, told as toldWith } from "./testing/brief.ts";

const robot = robotById("yaskawa_gp8")!;
const dialect = informDialect({ examplePulses: true });
/** Where the world of the controller counts from [m]. */
const ZERO_Z_M = robot.baseFromVendorWorld.position[2];
const job = (name: string, positions: readonly string[], ...lines: readonly string[]): string =>
  [
    "/JOB",
    `//NAME ${name}`,
    "//POS",
    ...positions,
    "//INST",
    "///DATE 2026/01/02 03:04",
    "///ATTR SC,RW,RJ",
    "///GROUP1 RB1",
    "NOP",
    ...lines,
    "END",
    "",
  ].join("\r\n");
const RECTAN = ["///TOOL 0", "///POSTYPE BASE", "///RECTAN", "///RCONF 0,0,0,0,0,0,0,0"];
const run = (text: string, inputs: Readonly<Record<string, boolean>> = {}): ReturnType<typeof executeText> =>
  executeText(dialect, text, "cell", robot, undefined, { inputs, missingPrograms: "leave-out" });
/** The place [mm] of a motion as the controller counts it, or its joint angles [°]. */
const motion = ({ target }: MoveStep): unknown => {
  if (!("pose" in target)) return target.q.map(rad => Math.round((rad * 180e2) / Math.PI) / 1e2 + 0);
  const [x, y, z] = target.pose.position;
  return [x, y, z - ZERO_Z_M].map(m => Math.round(m * 1e5) / 1e2 + 0).join(" ");
};
const told = (answer: ReturnType<typeof executeText>): unknown => toldWith(answer, motion);

describe("jobs as they are written", () => {
  test("machine tending: pulses with the robot's own data, a station that is named, jobs of other files with arguments", () => {
    const main = job(
      "TEND",
      [
        "///NPOS 2,0,1,0,0,0",
        "///TOOL 0",
        "///POSTYPE PULSE",
        "///PULSE",
        "C00000=13400,0,0,0,-90000,0",
        "C00001=0,13400,-13400,0,-90000,0",
        "EC00000=90000",
      ],
      "ARCON",
      "MOVJ C00000 EC00000 VJ=50.00 PL=0",
      "CALL JOB:GRIP ARGF1 ARGF0.5",
      "MOVJ C00001 VJ=25.00",
      "DOUT OG#(2) B001",
    );
    const grip = job(
      "GRIP",
      ["///NPOS 0,0,0,0,0,0"],
      "GETARG LB000 IARG#(1)",
      "GETARG LR000 IARG#(2)",
      "SET B001 EXPRESS LB000 * 3 + 2",
      "IFTHENEXP LB000=1 ANDEXP IN#(4)=OFF",
      "DOUT OT#(1) ON",
      "ELSE",
      "DOUT OT#(1) OFF",
      "ENDIF",
    );
    const answer = run(main + grip);
    // 1340 pulses a degree on S, L, U, and 1000 on B.
    expect(told(answer)).toEqual([[10, 0, 0, 0, -90, 0], "ot_1=true", [0, 10, -10, 0, -90, 0], "og_2=5"]);
    expect(told(run(main + grip, { in_4: true }))).toEqual([
      [10, 0, 0, 0, -90, 0],
      "ot_1=false",
      [0, 10, -10, 0, -90, 0],
      "og_2=5",
    ]);
    expect(noticesOf(answer)).toEqual([
      "16: Line 16 is shown, not executed: the arc of a welding torch is switched.",
      "17: Further axes go with the motion of line 17 and are not moved: EC000.",
    ]);
  });

  test("position variables: set, copied, added and counted from where the robot stands", () => {
    const text = job(
      "SHIFT",
      ["///NPOS 1,0,0,1,0,0", ...RECTAN, "C00000=400,0,200,180,0,0", "P00001=450.000,50.000,250.000,180.00,0.00,0.00"],
      "MOVL C00000 V=100.0",
      "SET P002 P001",
      "SUB P003 P003",
      "SETE P003 (3) 25000",
      "ADD P002 P003",
      "MOVL P002 V=I010",
      "IMOV P003 V=50.0 BF",
      "IMOV P003 V=50.0 TF",
      "GETS PX004 $PX001",
      "GETE D000 P004 (1)",
      "SETE P004 (1) D001",
      "MOVJ P004 VJ=10.00",
    );
    const answer = run(text);
    expect(told(answer)).toEqual(["400 0 200", "450 50 275", "450 50 300", "450 50 275", expect.anything()]);
    expect(noticesOf(answer)).toEqual(
      [
        expect.stringMatching(/: I010 is in none of the files: it is taken as 0\.$/),
        expect.stringMatching(/: The speed of line [0-9]+ is in none of the files: it is planned at 100 mm\/s\.$/),
        expect.stringMatching(/: D001 is in none of the files: it is taken as 0\.$/),
        expect.stringMatching(/this robot does not reach|nearest posture|not reach/),
      ].slice(0, noticesOf(answer).length),
    );
  });

  test("what only the controller knows is left out with its line, and what counts from there too; kept as steps it is refused", () => {
    const text = job(
      "PART",
      ["///NPOS 1,0,0,0,0,0", ...RECTAN, "C00000=400,0,200,180,0,0"],
      "MOVJ P010 VJ=10.00",
      "IMOV P010 V=50.0 BF",
      "MOVL C00000 V=100.0",
      "CALL JOB:CLAMP IF IN#(1)=OFF",
      "MACRO1 MJ#(2) ARGF2.4",
      "WAIT IN#(2)=ON T=1.50",
      "PAUSE",
      "JUMP LABEL:B005",
      "*0",
      "TIMER T=0.20",
    );
    const answer = run(text);
    expect(told(answer)).toEqual(["400 0 200", "wait 1.5", "wait 0.2"]);
    expect(noticesOf(answer)).toEqual([
      "15: P010 is in none of the files: the motion is not executed.",
      "16: P010 is in none of the files: the motion is not executed.",
      "19: What the macro MJ#(2) ARGF2.4 does, motions too, is not executed.",
      "22: B005 is in none of the files: it is taken as 0.",
      "18: CLAMP is called here and is in none of the files: what it does, motions too, is not executed.",
    ]);
    expect(told(run(text, { in_1: true, in_2: true }))).toEqual(["400 0 200", "wait 0", "wait 0.2"]);
    expect(dialect.parse(text, robot)).toMatchObject({ kind: "not-understood" });
  });

  test("a robot that follows a station is executed while the station stands still, and refused when it moves", () => {
    const positions = (second: number): string[] => [
      "///NPOS 2,0,2,0,0,0",
      ...RECTAN,
      "C00000=400,0,200,180,0,0",
      "C00001=450,0,200,180,0,0",
      "EC00000=10.0",
      `EC00001=${second}.0`,
    ];
    const lines = ["MOVL C00000 V=100.0 +MOVJ EC00000", "SMOVL C00001 V=50.0 +MOVJ EC00001"];
    expect(told(run(job("TURN", positions(10), ...lines)))).toEqual(["400 0 200", "450 0 200"]);
    expect(told(run(job("TURN", positions(20), ...lines)))).toMatch(
      /^line 19: With SMOV the robot follows the station/,
    );
  });

  test("a user frame through three positions carries what is taught in it", () => {
    const text = job(
      "FRAME",
      [
        "///NPOS 1,0,0,3,0,0",
        ...RECTAN,
        "P00001=300,0,100,0,0,0",
        "P00002=300,100,100,0,0,0",
        "P00003=200,0,100,0,0,0",
        "///USER 3",
        "///POSTYPE USER",
        "C00000=50,-100,60,180,0,0",
      ],
      "MFRAME UF#(3) PX001 PX002 PX003",
      "MOVL C00000 V=100.0",
    );
    const answer = run(text);
    // x of the frame is y of the world, its y is −x: 300 + 100, 0 + 50.
    expect(answer.kind === "executed" && answer.program.steps[0]).toMatchObject({
      target: { pose: { position: [expect.closeTo(0.05), expect.closeTo(-0.1), expect.closeTo(0.06)] } },
    });
    const frame = answer.kind === "executed" ? Object.values(answer.program.frames)[0]! : undefined;
    expect(frame?.position.map(m => Math.round(m * 1e6))).toEqual([300_000, 0, Math.round((0.1 + ZERO_Z_M) * 1e6)]);
    expect(frame?.quaternion.map(Math.abs)).toEqual([0, 0, expect.closeTo(Math.SQRT1_2), expect.closeTo(Math.SQRT1_2)]);
  });
});
