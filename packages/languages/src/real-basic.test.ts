/*
 * What programs of MELFA-BASIC and PacScript hold beside plain motions: line numbers, jumps, pallets, the older form
 * of a program, values that come back, points that only the controller has. Every program is written for this test;
 * expected positions are worked out by hand.
 */
import { robotById, type Dialect } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { executeText, joinFiles, melfaBasic, pacScript, spel } from "./index.ts";
import { noticesOf, told } from "./testing/brief.ts";

const runner = (dialect: Dialect, robotId: string) => {
  const robot = robotById(robotId)!;
  return {
    run: (text: string, inputs: Readonly<Record<string, boolean>> = {}) =>
      executeText(dialect, text, "cell", robot, undefined, { inputs }),
    parse: (text: string) => dialect.parse(text, robot),
  };
};
const speeds = (answer: ReturnType<typeof executeText>): unknown =>
  answer.kind === "executed"
    ? answer.program.steps.flatMap(step => (step.type === "move" ? [step.speed] : []))
    : answer;

describe("MELFA-BASIC", () => {
  const { run, parse } = runner(melfaBasic, "mitsubishi_rv7fl");
  const down = "180,0,180)(7,0)";

  test("numbered lines with jumps, and the list of positions behind the end", () => {
    const text = [
      "10 M1=0",
      "20 *LOOP",
      "30 M1=M1+1",
      `40 MVS P1,-10*M1`,
      "50 IF M1<3 THEN *LOOP",
      "60 IF M_IN(9)=1 THEN GOTO *FAR ELSE GOTO *NEAR",
      "70 *NEAR",
      "80 MOV J1",
      "90 END",
      "100 *FAR",
      "110 MVS P1",
      "120 END",
      `P1=(400,0,300,${down}`,
      "J1=(0,10,90,0,80,0)",
      "",
    ].join("\r\n");
    const rounds = [10, 20, 30].map(away => `lin 400 0 ${300 + away}`);
    expect(told(run(text))).toEqual([...rounds, "ptp 0 10 90 0 80 0°"]);
    expect(told(run(text, { DI9: true }))).toEqual([...rounds, "lin 400 0 300"]);
  });

  test("a pallet is counted along its first side, there and back or always in one direction", () => {
    const text = (order: number): string =>
      [
        `P10=(300,-50,350,${down}`,
        `P11=(300,50,350,${down}`,
        `P12=(400,-50,350,${down}`,
        `Def Plt 1,P10,P11,P12,,3,2,${order}`,
        "For M1=1 To 6",
        "  P1=(Plt 1,M1)",
        "  Mvs P1",
        "Next M1",
        "End",
      ].join("\n");
    const first = ["lin 300 -50 350", "lin 300 0 350", "lin 300 50 350"];
    const second = ["lin 400 -50 350", "lin 400 0 350", "lin 400 50 350"];
    expect(told(run(text(2)))).toEqual([...first, ...second]);
    expect(told(run(text(1)))).toEqual([...first, ...second.toReversed()]);
    expect(told(run(text(3)))).toBe("line 4: The order 3 of a pallet is not executed here.");
  });

  test("Ovrd slows joint motions and paths", () => {
    const text = `Ovrd 50\nMov J1\nSpd 200\nMvs P1\nOvrd 100\nMvs P1\nEnd\nJ1=(0,10,90,0,80,0)\nP1=(400,0,300,${down}\n`;
    expect(speeds(run(text))).toEqual([{ ratio: 0.5 }, { mps: 0.1 }, { mps: 0.2 }]);
    const kept = parse(text);
    const moves = kept.kind === "parsed" ? kept.program.steps.filter(step => step.type === "move") : [];
    expect(moves.map(({ speed }) => speed)).toEqual([{ ratio: 0.5 }, { mps: 0.1 }, { mps: 0.2 }]);
  });

  test("after a motion to a place that only the controller has nothing goes on from there", () => {
    const answer = run("Mov J1\nMvs P5\nMvs ,-50\nP6=P_Curr\nMvs P6\nMvc P5,P6,P7\nEnd\nJ1=(0,10,90,0,80,0)\n");
    expect(told(answer)).toEqual(["ptp 0 10 90 0 80 0°"]);
    expect(noticesOf(answer).map(notice => notice.replace(/:.*/, ""))).toEqual(["2", "3", "5", "6"]);
  });

  test("what gives a word another meaning or a value from outside is refused as steps, and Error ends the program", () => {
    const sentence = (text: string): string => {
      const answer = parse(text);
      return answer.kind === "parsed" ? "parsed" : answer.faults[0]!.sentence;
    };
    expect(sentence("Def Io LAMP=Bit,6\nLAMP=1\nEnd\n")).toBe(
      "Def Io gives a word another meaning, which is not executed here.",
    );
    expect(sentence("M1=1\nInput #1,M1\nDly M1\nEnd\n")).toBe(
      "Input takes a value from outside, which is not executed here.",
    );
    expect(told(run("Dly 1\nError 9100\nDly 2\nEnd\n"))).toEqual(["wait 1", "stop"]);
  });
});

describe("PacScript", () => {
  const { run } = runner(pacScript, "denso_vs060");

  test("the form of the RC7, with labels, opens; places of the controller are named", () => {
    const text = [
      '\'!TITLE "cell"',
      "PROGRAM PRO1",
      "  TAKEARM",
      "  MOVE P, J(0, 0, 90, 0, 90, 0)",
      "  APPROACH P, P1, 30",
      "  DEPART L, 60",
      "  IF IO[10] THEN *FAR",
      "  SET IO[24]",
      "  GOTO *DONE",
      "*FAR:",
      "  RESET IO[24]",
      "*DONE:",
      "  DELAY 125",
      "  GIVEARM",
      "END",
      "",
    ].join("\r\n");
    const answer = run(text);
    expect(told(answer)).toEqual(["ptp 0 0 90 0 90 0°", "DO24=true", "wait 0.125"]);
    expect(told(run(text, { DI10: true }))).toEqual(["ptp 0 0 90 0 90 0°", "DO24=false", "wait 0.125"]);
    expect(noticesOf(answer)).toEqual([
      "5: p1 is in none of the files: the motion is not executed.",
      "6: Where the robot then is is in none of the files: the motion is not executed.",
    ]);
  });

  test("an argument comes back changed unless it is ByVal", () => {
    const text = (how: string): string =>
      `Sub Main\n  Dim n As Integer\n  n = 3\n  Call More(n)\n  Move P, J(n, 0, 90, 0, 90, 0)\nEnd Sub\nSub More(${how}x As Integer)\n  x = x + 5\nEnd Sub\n`;
    expect(told(run(text("")))).toEqual(["ptp 8 0 90 0 90 0°"]);
    expect(told(run(text("ByRef ")))).toEqual(["ptp 8 0 90 0 90 0°"]);
    expect(told(run(text("ByVal ")))).toEqual(["ptp 3 0 90 0 90 0°"]);
  });

  test("of a project the subs that are called are loaded", () => {
    const files = [
      { name: "main.pcs", text: "Sub Main\n  Call Grip\nEnd Sub\n" },
      { name: "grip.pcs", text: "Sub Grip\n  Delay 2000\nEnd Sub\n" },
      { name: "other.pcs", text: "Sub Unused\n  Fly\nEnd Sub\n" },
    ];
    expect(told(run(joinFiles(pacScript, files, "main.pcs").text))).toEqual(["wait 2"]);
  });
});

describe("SPEL+", () => {
  const { run } = runner(spel, "epson_c4_a601s");
  test("an argument comes back changed only ByRef", () => {
    const text = (how: string): string =>
      `Function main\n  Integer n\n  n = 3\n  Call More(${how}n)\n  Go JA(n, 0, 0, 0, 0, 0)\nFend\nFunction More(${how}x As Integer)\n  x = x + 5\nFend\n`;
    expect(told(run(text("")))).toEqual(["ptp 3 0 0 0 0 0°"]);
    expect(told(run(text("ByRef ")))).toEqual(["ptp 8 0 0 0 0 0°"]);
  });
});
