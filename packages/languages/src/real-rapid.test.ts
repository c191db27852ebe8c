/* Routines with optional arguments, given on or not. Written for this test; the motions are worked out by hand. */
import { robotById, type MoveStep } from "@twincell/core";
import { expect, test } from "vitest";
import { executeText, rapid } from "./index.ts";

const robot = robotById("abb_irb120")!;
const TEXT = [
  "MODULE Cell",
  '  PERS wobjdata box:=[FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[100,0,50],[1,0,0,0]]];',
  "  PROC go(\\num up,robtarget p\\PERS wobjdata wobj)",
  "    VAR num height:=0;",
  "    IF Present(up) height:=up;",
  "    MoveL Offs(p,0,0,height),v100,fine,tool0\\WObj?wobj;",
  "  ENDPROC",
  "  PROC main()",
  "    VAR robtarget a:=[[300,0,400],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];",
  "    go a;",
  "    go\\up:=25,a;",
  "    go a\\wobj:=box;",
  "    go\\up:=10,a\\wobj:=box;",
  "  ENDPROC",
  "ENDMODULE",
  "",
];

test("an optional argument that is given on reaches the motion, and one that is not leaves it as it was", () => {
  const answer = executeText(rapid, TEXT.join("\n"), "cell", robot);
  if (answer.kind === "not-understood") throw new Error(JSON.stringify(answer.faults));
  const moves = answer.program.steps.filter((step): step is MoveStep => step.type === "move");
  const world = moves.map(({ target }) => {
    if (!("pose" in target)) return "joints";
    const from = target.frame === "world" ? [0, 0, 0] : answer.program.frames[target.frame]!.position;
    return target.pose.position.map((m, i) => Math.round((m + from[i]!) * 1e6) / 1e3);
  });
  expect(world).toEqual([
    [300, 0, 400],
    [300, 0, 425],
    [400, 0, 450],
    [400, 0, 460],
  ]);
});

test("an argument too many is refused with its line", () => {
  const answer = executeText(rapid, TEXT.join("\n").replace("    go a;", "    go a,a;"), "cell", robot);
  expect(answer.kind === "not-understood" && [answer.faults[0]!.line, answer.faults[0]!.sentence]).toEqual([
    10,
    "go takes 1 arguments; 2 are given.",
  ]);
});
