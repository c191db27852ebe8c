/*
 * What programs and backups of AS controllers hold beside plain motions: the head that SAVE writes, data of the
 * controller, jumps, texts, rows of places, points that only the controller has. Every program is written for this
 * test; the positions that are expected are worked out by hand.
 */
import { robotById } from "@twincell/core";
import { expect, test } from "vitest";
import { executeText, joinFiles, kawasakiAs } from "./index.ts";
import { noticesOf, told } from "./testing/brief.ts";

const robot = robotById("kawasaki_rs007l")!;
const run = (text: string, inputs: Readonly<Record<string, boolean>> = {}): ReturnType<typeof executeText> =>
  executeText(kawasakiAs, text, "cell", robot, undefined, { inputs });

test("a whole backup opens: its head, one-line entries and data of the controller are passed over, taught steps are motions", () => {
  const text = [
    ".***************************************************************************",
    ".*=== AS GROUP ===         : AS_00000000 2020/01/01 10:00",
    ".***************************************************************************",
    '.NETCONF     192.168.0.2,"cell",255.255.255.0',
    ".ROBOTDATA1",
    "ZSYSTEM         1   5   1        -106",
    "ZÖ € 1",
    ".END",
    ".PROGRAM a.home() #12",
    "  JOINT SPEED9 ACCU1 TIMER0 TOOL1 WORK0 CLAMP1 (OFF,0,0,O) OX= WX= #[10,20,-90,0,-70,5] ;",
    "  JMOVE above",
    ".END",
    ".TRANS",
    "above 400.000000 10.000000 300.000000 0.000000 180.000000 0.000000",
    ".END",
    ".STRINGS",
    '$name = "cell 1"',
    ".END",
    "",
  ].join("\r\n");
  expect(told(run(text))).toEqual(["ptp 10 20 -90 0 -70 5°", "ptp 400 10 300"]);
});

test("GOTO, with IF and without, goes to numbers and names; one to a label that is not there is told with its line", () => {
  const text = [
    ".PROGRAM main()",
    "  n = 0",
    "10 n = n + 1",
    "  JMOVE #[n,0,-90,0,-90,0]",
    "  IF n < 3 GOTO 10",
    "  GOTO over IF SIG(1001)",
    "  JMOVE #[50,0,-90,0,-90,0]",
    "over:",
    "  JMOVE #[60,0,-90,0,-90,0]",
    ".END",
    "",
  ].join("\n");
  const counted = [1, 2, 3].map(n => `ptp ${n} 0 -90 0 -90 0°`);
  expect(told(run(text))).toEqual([...counted, "ptp 50 0 -90 0 -90 0°", "ptp 60 0 -90 0 -90 0°"]);
  expect(told(run(text, { DI1001: true }))).toEqual([...counted, "ptp 60 0 -90 0 -90 0°"]);
  expect(told(run(".PROGRAM main()\n  GOTO 5\n.END\n"))).toBe("line 2: There is no label 5 in this program.");
  expect(kawasakiAs.parse(text, robot)).toMatchObject({
    kind: "not-understood",
    faults: [{ sentence: "Steps know no GOTO: run the text as it is." }],
  });
});

test("a program hands back what it makes of its parameters, rows of places too, and values in brackets stay the caller's", () => {
  const text = [
    ".PROGRAM main()",
    "  .n = 3",
    "  POINT .p[0,1] = TRANS(400,0,300,0,180,0)",
    "  POINT .p[0,2] = TRANS(400,50,300,0,180,0)",
    "  CALL more(.n)",
    "  CALL more(7)",
    "  JMOVE #[.n,0,-90,0,-90,0]",
    "  CALL trace(.&p[,],2)",
    "  LMOVE .p[0,1]",
    ".END",
    ".PROGRAM more(.x)",
    "  .x = .x + 5",
    ".END",
    ".PROGRAM trace(.&q[,],.last)",
    "  FOR .i = 1 TO .last",
    "    LMOVE .q[0,.i]",
    "  END",
    "  POINT .q[0,1] = SHIFT(.q[0,1] BY 0,0,25)",
    ".END",
    "",
  ].join("\n");
  const expected = ["ptp 8 0 -90 0 -90 0°", "lin 400 0 300", "lin 400 50 300", "lin 400 0 325"];
  expect(told(run(text))).toEqual(expected);
});

test("a place that a program was given is no frame any more once the program has changed it", () => {
  const text = [
    ".PROGRAM main()",
    "  POINT base1 = TRANS(400,0,300,0,0,0)",
    "  CALL lift(base1)",
    "  LMOVE base1 + TRANS(10,0,0,0,180,0)",
    ".END",
    ".PROGRAM lift(.p)",
    "  POINT .p = SHIFT(.p BY 0,0,40)",
    ".END",
    "",
  ].join("\n");
  expect(told(run(text))).toEqual(["lin 410 0 340"]);
  const kept = kawasakiAs.parse(text, robot);
  expect(kept.kind === "parsed" ? kept.program.frames : kept.faults).toEqual({});
});

test("texts choose with SCASE, POINT/Z changes one number, XMOVE ends at its line, waits are waits", () => {
  const text = [
    ".PROGRAM main()",
    '  $mode = "left"',
    "  POINT p = TRANS(400,0,300,0,180,0)",
    "  POINT/Z p = TRANS(0,0,350)",
    "  SCASE $mode OF",
    '    SVALUE "right":',
    "      LMOVE TRANS(400,-100,300,0,180,0)",
    '    SVALUE "left":',
    "      LMOVE p",
    "  END",
    "  XMOVE TRANS(400,0,200,0,180,0) TILL 1005",
    "  DELAY 0.5",
    "  STABLE 0.2",
    "  WAIT SIG(1006)",
    "  MC PRINT 1",
    "  TIMER 1 = 0",
    ".END",
    "",
  ].join("\n");
  const answer = run(text);
  expect(told(answer)).toEqual(["lin 400 0 350", "lin 400 0 200", "wait 0.5", "wait 0.2", "until DI1006"]);
  expect(answer).toMatchObject({
    program: { steps: [{}, { until: { when: { signal: "DI1005", is: true } } }, {}, {}, {}] },
  });
  expect(noticesOf(answer)).toEqual([
    "15: MC is kept and shown, and not executed.",
    "16: TIMER is kept and shown, and not executed.",
  ]);
});

test("what only the controller knows is named with its line, and nothing goes on from a place that nobody knows", () => {
  const text = [
    ".PROGRAM main()",
    "  JMOVE #[0,0,-90,0,-90,0]",
    "  LMOVE pick",
    "  LDEPART 50",
    "  HERE kept",
    "  LMOVE kept",
    "  SIGNAL lamp",
    "  IF SIG(part) THEN",
    "    JMOVE #[90,0,-90,0,-90,0]",
    "  END",
    "  HOME",
    "  DRAW 10,0,0",
    "  JMOVE #[count,0,-90,0,-90,0]",
    ".END",
    "",
  ].join("\n");
  const answer = run(text);
  expect(told(answer)).toEqual(["ptp 0 0 -90 0 -90 0°", "lamp=true", "ptp 0 0 -90 0 -90 0°"]);
  expect(noticesOf(answer)).toEqual([
    "3: pick is in none of the files: the motion is not executed.",
    "4: Where the robot then is is in none of the files: the motion is not executed.",
    "6: Where the robot is is in none of the files: the motion is not executed.",
    "11: Where HOME goes, which the controller holds, is in none of the files: the motion is not executed.",
    "12: Where the robot then is is in none of the files: the motion is not executed.",
    "13: count is in none of the files: it is taken as 0.",
  ]);
  expect(told(run(text, { part: true }))).toContain("ptp 90 0 -90 0 -90 0°");
});

test("a fault in a program that is not called is told, and refused where it is called", () => {
  const text = (call: string): string =>
    `.PROGRAM main()\n  TWAIT 1\n${call}\n.END\n.PROGRAM broken()\n  RIGHTY\n  END\n.END\n.PROGRAM other()\n  CALL broken\n.END\n`;
  const answer = run(text(""));
  expect(told(answer)).toEqual(["wait 1"]);
  expect(noticesOf(answer)).toEqual([
    '7: "END" stands where a statement is expected. The program broken is refused where it is called.',
  ]);
  expect(told(run(text("CALL broken")))).toBe('line 7: "END" stands where a statement is expected.');
});

test("of a project the programs that are called are loaded with the one that is run", () => {
  const files = [
    { name: "main.as", text: ".PROGRAM main()\n  CALL grip\n.END\n" },
    { name: "old/grip.as", text: ".PROGRAM grip()\n  TWAIT 9\n.END\n" },
    { name: "grip.as", text: ".PROGRAM grip()\n  TWAIT 2\n.END\n" },
    { name: "unused.as", text: ".PROGRAM other()\n  FLY\n.END\n" },
  ];
  const { text, place } = joinFiles(kawasakiAs, files, "main.as");
  expect(told(run(text))).toEqual(["wait 2"]);
  expect(place(5)).toEqual({ file: 2, line: 2 });
});
