/*
 * What programs of V+ controllers hold beside plain motions: variables of one program, arguments that come back, points
 * that only the controller has, files, reactions. Every program is written for this test; the positions that are
 * expected are worked out by hand.
 */
import { robotById } from "@twincell/core";
import { expect, test } from "vitest";
import { executeText, joinFiles, vPlus } from "./index.ts";
import { noticesOf, told } from "./testing/brief.ts";

const robot = robotById("staubli_rx90l")!;
const run = (text: string, inputs: Readonly<Record<string, boolean>> = {}): ReturnType<typeof executeText> =>
  executeText(vPlus, text, "cell", robot, undefined, { inputs });
const joint = (n: number): string => `ptp ${n} -90 90 0 90 0°`;

test("parameters and variables of AUTO belong to one call, and what a program makes of its parameters comes back", () => {
  const text = [
    ".PROGRAM main()",
    "  AUTO i",
    "  n = 3",
    "  x = 40",
    "  CALL more(n)",
    "  MOVE #PPOINT(n,-90,90,0,90,0)",
    "  MOVE #PPOINT(x,-90,90,0,90,0)",
    "  CALL more((n))",
    "  MOVE #PPOINT(n,-90,90,0,90,0)",
    "  FOR i = 1 TO 2",
    "    CALL count()",
    "    MOVE #PPOINT(i,-90,90,0,90,0)",
    "  END",
    ".END",
    ".PROGRAM more(x)",
    "  x = x + 5",
    ".END",
    ".PROGRAM count()",
    "  AUTO REAL i",
    "  FOR i = 10 TO 11",
    "    DELAY i",
    "  END",
    ".END",
    "",
  ].join("\n");
  const waits = ["wait 10", "wait 11"];
  const expected = [joint(8), joint(40), joint(8), ...waits, joint(1), ...waits, joint(2)];
  expect(told(run(text))).toEqual(expected);
  const kept = vPlus.parse(text, robot);
  const moves = kept.kind === "parsed" ? kept.program.steps.filter(({ type }) => type === "move") : [];
  expect(moves).toHaveLength(5);
});

test("a variable of LOCAL is the program's own and keeps its value from call to call", () => {
  const text = [
    ".PROGRAM main()",
    "  c = 70",
    "  CALL count()",
    "  CALL count()",
    "  MOVE #PPOINT(c,-90,90,0,90,0)",
    ".END",
    ".PROGRAM count()",
    "  LOCAL c",
    "  c = c + 1",
    "  MOVE #PPOINT(c,-90,90,0,90,0)",
    ".END",
    "",
  ].join("\n");
  expect(told(run(text))).toEqual([joint(1), joint(2), joint(70)]);
});

test("what only the controller knows is named with its line, and nothing goes on from a place that nobody knows", () => {
  const text = [
    ".PROGRAM main()",
    "  MOVE #PPOINT(0,-90,90,0,90,0)",
    "  APPRO pick, 50",
    "  DEPARTS 20",
    "  HERE kept",
    "  MOVES kept:TRANS(0,0,10)",
    "  SIGNAL lamp, -2",
    "  IF SIG(part) THEN",
    "    MOVE #PPOINT(90,-90,90,0,90,0)",
    "  END",
    "  READ (5) count",
    "  REACTI 1001, stop",
    "  MOVE #PPOINT(count,-90,90,0,90,0)",
    ".END",
    "",
  ].join("\n");
  const answer = run(text);
  expect(told(answer)).toEqual([joint(0), "lamp=true", "out_2=false", joint(0)]);
  expect(noticesOf(answer)).toEqual([
    "3: pick is in none of the files: the motion is not executed.",
    "4: Where the robot then is is in none of the files: the motion is not executed.",
    "5: Where the robot then is is in none of the files: the line is not executed.",
    "6: kept is in none of the files: the motion is not executed.",
    "11: READ is kept and shown, and not executed.",
    "12: REACTI is kept and shown, and not executed.",
    "13: count is in none of the files: it is taken as 0.",
  ]);
  expect(told(run(text, { part: true }))).toContain(joint(90));
  expect(vPlus.parse(text, robot).kind).toBe("not-understood");
});

test("of a project the programs that are called are loaded with the one that is run", () => {
  const files = [
    { name: "main.v2", text: ".PROGRAM main()\n  CALL grip\n.END\n" },
    { name: "grip.v2", text: ".PROGRAM grip()\n  DELAY 2\n.END\n" },
    { name: "unused.v2", text: ".PROGRAM other()\n  FLY\n.END\n" },
  ];
  expect(told(run(joinFiles(vPlus, files, "main.v2").text))).toEqual(["wait 2"]);
});
