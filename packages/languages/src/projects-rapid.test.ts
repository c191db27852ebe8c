/*
 * Tasks of several modules as a controller's backup holds them. Written for these tests; what the robot does is worked
 * out by hand: degrees of the joints, millimetres in the work object, and the order of lines and motions.
 */
import { robotById } from "@twincell/core";
import { expect, test } from "vitest";
import { rapid } from "./index.ts";
import { told } from "./testing/told.ts";

const robot = robotById("abb_irb120")!;
const run = (files: Parameters<typeof told>[2], inputs?: Parameters<typeof told>[3]): ReturnType<typeof told> =>
  told(rapid, robot, files, inputs);
const target = (x: number, y: number, z: number): string =>
  `[[${x},${y},${z}],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]`;
const HOME = "[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";

test("a task of three modules: data of their own, records, arrays, INOUT handed back, optional arguments, TEST and FOR", () => {
  const { does, notes } = run({
    "PROGMOD/Main.mod": [
      "%%%",
      "  VERSION:1",
      "  LANGUAGE:ENGLISH",
      "%%%",
      "MODULE 1_Main",
      "  RECORD part",
      "    num count;",
      "    robtarget place;",
      "  ENDRECORD",
      "  LOCAL VAR num stride:=1;",
      "  VAR part box;",
      `  CONST jointtarget jHome:=${HOME};`,
      "  PROC main()",
      "    VAR num row{2,2}:=[[0,40],[80,120]];",
      "    MoveAbsJ jHome,v1000,fine,tool0;",
      `    box.place:=${target(300, 0, 200)};`,
      "    box.count:=0;",
      "    FOR i FROM 1 TO 2 DO",
      "      TEST i",
      "      CASE 1:",
      "        stack box\\high:=50;",
      "      CASE 2,3:",
      "        stack box;",
      "      DEFAULT:",
      "        Stop;",
      "      ENDTEST",
      "    ENDFOR",
      "    IF box.count=2 AND stride=1 MoveL Offs(box.place,row{2,1},0,0),v200,z10,tGrip\\WObj:=wTable;",
      "  ENDPROC",
      "ENDMODULE",
    ],
    "PROGMOD/Stack.mod": [
      "MODULE Stack",
      "  LOCAL VAR num stride:=20;",
      "  PROC stack(INOUT part item\\num high)",
      "    VAR num up:=0;",
      "    IF Present(high) up:=high;",
      "    stride:=stride+10;",
      "    MoveL Offs(item.place,stride,0,up),v500,z10,tGrip\\WObj:=wTable;",
      "    grip;",
      "    Incr item.count;",
      "  ENDPROC",
      "  LOCAL PROC grip()",
      "    SetDO doVacuum,1;",
      "    WaitTime 0.3;",
      "  ENDPROC",
      "ENDMODULE",
    ],
    "SYSMOD/Cell.sys": [
      "MODULE Cell(SYSMODULE)",
      "  PERS tooldata tGrip:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];",
      '  PERS wobjdata wTable:=[FALSE,TRUE,"",[[10,20,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];',
      "ENDMODULE",
    ],
    "PROGMOD/Old.mod": ["MODULE Old", "  this is no RAPID", "ENDMODULE"],
  });
  expect(does).toEqual([
    "ptp q 0 0 0 0 30 0",
    "lin 330 0 250 in wTable within 10",
    "doVacuum = true",
    "wait 0.3 s",
    "lin 340 0 200 in wTable within 10",
    "doVacuum = true",
    "wait 0.3 s",
    "lin 380 0 200 in wTable within 10",
  ]);
  expect(notes).toEqual([]);
});

test("GOTO out of blocks, calls by name, lines handed to a routine, and events at the end of a motion", () => {
  const files = {
    "Pick.mod": [
      "MODULE Pick",
      "  VAR num tries:=0;",
      "  VAR triggdata open;",
      `  CONST jointtarget jHome:=${HOME};`,
      "  PROC main()",
      "    again:",
      "    tries:=tries+1;",
      '    %"job"+NumToStr(tries,0)%;',
      "    WHILE TRUE DO",
      "      IF tries<2 GOTO again;",
      "      GOTO ready;",
      "    ENDWHILE",
      "    Stop;",
      "    ready:",
      "    TriggIO open,15\\DOp:=doOpen,1;",
      `    TriggL ${target(300, 0, 250)},v100,open,fine,tool0;`,
      `    MoveLDO ${target(300, 50, 250)},v100,z5,tool0,doGlue,0;`,
      "    ask diReady,doAsk;",
      "  ENDPROC",
      "  PROC job1()",
      "    MoveAbsJ jHome,v100,fine,tool0;",
      "  ENDPROC",
      "  PROC job2()",
      "    Set doTwo;",
      "  ENDPROC",
      "  PROC ask(VAR signaldi answer,VAR signaldo question)",
      "    SetDO question,1;",
      "    WaitDI answer,1;",
      "    IF answer=0 Stop;",
      "  ENDPROC",
      "ENDMODULE",
    ],
  };
  const { does, notes } = run(files, { diReady: true });
  expect(does).toEqual([
    "ptp q 0 0 0 0 30 0",
    "doTwo = true",
    "lin 300 0 250 in world",
    "doOpen = true",
    "lin 300 50 250 in world within 5",
    "doGlue = false",
    "doAsk = true",
    'wait for {"signal":"diReady","is":true}',
  ]);
  expect(notes).toEqual(["Pick.mod 16: open acts at the end of the motion here, and not 15 mm from it."]);
});

test("what no open module declares: a tool, a work object and a point are named; what another machine answers decides nothing", () => {
  const files = (...lines: string[]): Parameters<typeof told>[2] => ({
    "Weld.mod": [
      "MODULE Weld",
      "  VAR num answer;",
      "  VAR intnum watch;",
      `  CONST robtarget p1:=${target(300, 0, 250)};`,
      "  PROC main()",
      ...lines,
      "  ENDPROC",
      "  TRAP stopped",
      "    Stop;",
      "  ENDTRAP",
      "ENDMODULE",
    ],
  });
  const named = run(
    files(
      "    CONNECT watch WITH stopped;",
      "    ISignalDI diStop,1,watch;",
      "    MoveL p1,v100,fine,tTorch\\WObj:=wFixture;",
      "    MoveL Offs(pWeld,0,0,10),v100,fine,tTorch;",
      "    IF diPart=1 MoveJ p1,v100,fine,tTorch;",
      "    IF diLeft=1 OR diRight=0 Set doLeft;",
    ),
  );
  expect(named.does).toEqual(["lin 300 0 250 in world", "doLeft = true"]);
  expect(named.notes).toEqual([
    "Weld.mod 6: CONNECT is kept and not executed: it does not move the robot.",
    "Weld.mod 7: ISignalDI is kept and not executed: it does not move the robot.",
    "Weld.mod 8: The tool tTorch is declared in no file that is open: the flange is taken for it.",
    "Weld.mod 8: The work object wFixture is declared in no file that is open: the base of the robot is taken for it.",
    "Weld.mod 9: The motion to pWeld is left out: no file that is open declares the point. The robot goes on to the next point from where it is.",
  ]);
  expect(
    run(files("    MoveL pWeld,v100,fine,tool0;", "    MoveL Offs(CRobT(),0,0,5),v100,fine,tool0;")).does[0],
  ).toMatch(/^Weld\.mod 7: The robot was to be at a point that no open file declares\./);
  const ask = files('    TPReadFK answer,"Go?","yes","no","","","";', "    IF answer=1 MoveL p1,v100,fine,tool0;");
  expect(run(ask)).toMatchObject({ does: [], cut: expect.stringMatching(/waits until somebody answers "answer"/) });
  expect(run(ask, { answer: 1 }).does).toEqual(["lin 300 0 250 in world"]);
  expect(run(ask, { answer: 2 }).does).toEqual([]);
  expect(
    run(files("    SocketReceive socket1\\Str:=answer;", "    IF answer=1 MoveL p1,v100,fine,tool0;")).does,
  ).toEqual(['Weld.mod 7: "answer" is what another machine answers: it is not known here.']);
  expect(run(files("    ReachAround p1;")).does[0]).toMatch(
    /^Weld\.mod 6: ReachAround is called here and is in none of the files/,
  );
});

test("a routine that wants arguments, and a module without main, are not run by themselves", () => {
  const lines = (...routines: string[]): Parameters<typeof told>[2] => ({
    "A.mod": ["MODULE A", ...routines, "ENDMODULE"],
  });
  const alone = run(lines("PROC go(num x)", `  MoveAbsJ ${HOME},v100,fine,tool0;`, "ENDPROC"));
  expect(alone.does).toEqual([]);
  expect(alone.notes).toEqual([
    "A.mod 2: go wants to be given x: it is not run by itself. Open it with the module that calls it.",
  ]);
  const two = run(lines("PROC a()", "ENDPROC", "PROC b()", "ENDPROC"));
  expect(two.notes).toEqual([
    "A.mod 2: No module that is open has PROC main: no routine is run. Put the module that calls them beside it.",
  ]);
});
