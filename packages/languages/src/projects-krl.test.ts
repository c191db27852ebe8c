/*
 * Projects of several files as a controller's backup holds them. Written for these tests; what the robot does is worked
 * out by hand: degrees of the axes, millimetres in the base, and the order of lines and motions.
 */
import { robotById } from "@twincell/core";
import { expect, test } from "vitest";
import { krl } from "./index.ts";
import { told } from "./testing/told.ts";

const robot = robotById("kuka_kr6_2")!;
const run = (files: Parameters<typeof told>[2], inputs?: Parameters<typeof told>[3]): ReturnType<typeof told> =>
  told(krl, robot, files, inputs);

const STACK = {
  "Program/stack.src": [
    "&ACCESS RVP",
    "&COMMENT Stapeln",
    "DEF stack( )",
    "DECL INT row, layer",
    "BAS (#INITMOV,0 )",
    "BAS (#BASE,3)",
    "PTP XHOME",
    "FOR layer=1 TO 2",
    "  FOR row=1 TO 2",
    "    IF layer<>row THEN",
    "      place(shift[layer,row])",
    "    ENDIF",
    "  ENDFOR",
    "ENDFOR",
    "report(#FULL)",
    "END",
    "DEF place(offset :IN)",
    "DECL REAL offset",
    "DECL E6POS p",
    "p=XP1",
    "p.X=p.X+offset",
    "$APO.CDIS=20",
    "LIN p C_DIS",
    "TRIGGER WHEN DISTANCE=1 DELAY=0 DO grip(1)",
    "LIN {X 100,Y 0,Z 150,A 0,B 90,C 0} C_DIS",
    "LIN p",
    "END",
  ],
  "Program/stack.dat": [
    "&ACCESS RVP",
    "DEFDAT  STACK",
    "DECL E6POS XP1={X 100.0,Y 20.0,Z 300.0,A 0.0,B 90.0,C 0.0}",
    "DECL REAL shift[2,2]",
    "shift[1,1]=1",
    "shift[1,2]=40",
    "shift[2,1]=-40",
    "shift[2,2]=4",
    "DECL INT pieces=7",
    "ENDDAT",
  ],
  // A file of the project that nothing names, and that the controller would not load.
  "Program/broken.src": ["DEF broken( )", "THIS IS NO KRL", "END"],
  "Lib/grip.src": [
    "&ACCESS RVP",
    "GLOBAL DEF grip(which :IN)",
    "DECL INT which",
    "place()",
    "VALVES=which+4",
    "pieces=pieces+1",
    "WAIT SEC 0.2",
    "END",
    "DEF place()",
    "$OUT[12]=TRUE",
    "END",
  ],
  "Lib/grip.dat": ["&ACCESS RVP", "DEFDAT GRIP", "DECL INT pieces=1", "ENDDAT"],
  "Lib/report.src": [
    "&ACCESS RVP",
    "DEF report(how :IN)",
    "DECL STATE_T how",
    "SWITCH how",
    "CASE #EMPTY,#HALF",
    "  $OUT[13]=FALSE",
    "CASE #FULL",
    "  IF (pieces==3) AND (belts[2].place[1]==5) THEN",
    "    $OUT[13]=TRUE",
    "  ENDIF",
    "DEFAULT",
    "  HALT",
    "ENDSWITCH",
    "END",
  ],
  "Lib/report.dat": [
    "&ACCESS RVP",
    "DEFDAT REPORT PUBLIC",
    "GLOBAL ENUM STATE_T EMPTY,HALF,FULL",
    "STRUC BELT_T INT place[2]",
    "DECL BELT_T belts[2]",
    "belts[2].place[1]=5",
    "belts[2].place[2]=6",
    "DECL INT pieces=3",
    "ENDDAT",
  ],
  "System/$config.dat": [
    "&ACCESS RVP",
    "DEFDAT  $CONFIG",
    "SIGNAL VALVES $OUT[20] TO $OUT[22]",
    "DECL FRAME BASE_DATA[16]",
    "BASE_DATA[3]={X 500.0,Y 0.0,Z 200.0,A 0.0,B 0.0,C 0.0}",
    "DECL E6AXIS XHOME={A1 0.0,A2 -90.0,A3 90.0,A4 0.0,A5 10.0,A6 0.0}",
    "ENDDAT",
  ],
};

test("a project of five modules: arrays, own and shared data, groups of outputs, and a trigger that does not stop the robot", () => {
  const { does, notes } = run(STACK);
  const grip = ["out_12 = true", "out_20 = true", "out_21 = false", "out_22 = true"];
  const place = (x: number): string[] => [
    `lin ${x} 20 300 in base_data[3] within 20`,
    "lin 100 0 150 in base_data[3] within 20",
    ...grip,
    `lin ${x} 20 300 in base_data[3]`,
  ];
  expect(does).toEqual(["ptp q 0 -90 90 0 10 0", ...place(140), ...place(60), "out_13 = true"]);
  expect(notes).toEqual([
    "Lib/grip.src 7: The wait belongs to a trigger, beside which the robot goes on: it is not carried out.",
  ]);
});

test("a file that nothing names is not loaded, and one that is not understood matters where it is reached", () => {
  const call = (word: string): Parameters<typeof told>[2] => ({
    "a.src": [
      "&ACCESS RVP",
      "DEF a( )",
      "BAS (#INITMOV,0 )",
      "PTP XHOME",
      `IF ${word} THEN`,
      "  broken( )",
      "ENDIF",
      "END",
    ],
    "broken.src": ["&ACCESS RVP", "DEF broken( )", "PTP XHOME", "THIS IS NO KRL", "END"],
  });
  expect(run(call("FALSE")).does).toEqual(["ptp q 0 -90 90 0 0 0"]);
  expect(run(call("TRUE")).does[0]).toMatch(/^broken\.src 4: "THIS" is no statement of KRL/);
});

test("a cell program waits for its number, which is given by hand, and runs that job with a line handed over as itself", () => {
  const files = {
    "cell.src": [
      "&ACCESS RVP",
      "DEF cell( )",
      "DECL INT tries",
      "BAS (#INITMOV,0 )",
      'IF NOT (VARSTATE("count")==#INITIALIZED) THEN',
      "  count=0",
      "ENDIF",
      "P00 (#EXT_PGNO,#PGNO_GET,DMY[],0 )",
      "SWITCH PGNO",
      "CASE 1",
      "  $OUT[1]=TRUE",
      "CASE 2",
      "  tries=0",
      "  REPEAT",
      "    tries=tries+1",
      "    ask(READY, DONE)",
      "  UNTIL tries>=2",
      "DEFAULT",
      "  WAIT SEC 1",
      "ENDSWITCH",
      "IF ($MODE_OP==#T1) OR door THEN",
      "  HALT",
      "ENDIF",
      "PTP {A1 count+10,A2 -90,A3 90,A4 0,A5 0,A6 0}",
      "END",
      "DEF ask(request, permission)",
      "DECL BOOL request, permission",
      "request=TRUE",
      "WAIT FOR permission AND NOT $IN[9]",
      "request=FALSE",
      "END",
    ],
    "cell.dat": [
      "&ACCESS RVP",
      "DEFDAT CELL",
      "DECL INT count",
      "SIGNAL READY $OUT[2]",
      "SIGNAL DONE $IN[8]",
      "ENDDAT",
    ],
  };
  const ask = [
    "ready = true",
    'wait for {"signal":"done","is":true}',
    'wait for {"signal":"in_9","is":false}',
    "ready = false",
  ];
  expect(run(files, { PGNO: 2 }).does).toEqual([...ask, ...ask, "ptp q 10 -90 90 0 0 0"]);
  expect(run(files, { PGNO: 1 }).does).toEqual(["out_1 = true", "ptp q 10 -90 90 0 0 0"]);
  // The door is declared nowhere: it is an input that is off, and stops the program where it is on.
  const open = run(files, { door: true });
  expect(open.does).toEqual(["wait 1 s", "stop"]);
  expect(open.notes).toEqual([
    "cell.src 8: P00 belongs to a package of the controller: it is not executed. It does not move the robot.",
    "cell.src 21: DOOR is declared in no file that is open: it counts as an input, off until it is given by hand.",
  ]);
});

test("a point that only the controller has is left out and named, and nothing counts from where the robot then is", () => {
  const files = (...lines: string[]): Parameters<typeof told>[2] => ({
    "pick.src": ["&ACCESS RVP", "DEF pick( )", "BAS (#INITMOV,0 )", "PTP XHOME", "PTP XP9", ...lines, "END"],
  });
  const whole = run(files("PTP {A1 5,A2 -90,A3 90,A4 0,A5 0,A6 0}", "LIN_REL {Z 0}", "PTP $POS_ACT"));
  expect(whole.does.slice(0, 2)).toEqual(["ptp q 0 -90 90 0 0 0", "ptp q 5 -90 90 0 0 0"]);
  expect(whole.does).toHaveLength(4);
  expect(whole.notes).toEqual([
    "pick.src 5: The motion to XP9 is left out: the point is kept on the controller. Put its data list beside the program. The robot goes on to the next point from where it is.",
  ]);
  expect(run(files("LIN_REL {Z 10}")).does).toEqual([
    "pick.src 6: The robot was to be at a point that is kept on the controller. What counts from there is not carried out.",
  ]);
  expect(run(files("LIN {Z 10}")).does[0]).toMatch(/^pick\.src 6: The robot was to be/);
  expect(run(files("XP2=$POS_ACT", "PTP XP2")).does[0]).toMatch(/^pick\.src 6: .* \$POS_ACT is not known here\.$/);
});

test("a trigger away from its point is done at the point, and said; one that moves the robot is refused", () => {
  const files = (action: string): Parameters<typeof told>[2] => ({
    "glue.src": [
      "&ACCESS RVP",
      "DEF glue( )",
      "BAS (#INITMOV,0 )",
      "PTP XHOME C_PTP",
      `TRIGGER WHEN ${action} PRIO=-1`,
      "PTP {A1 30,A2 -90,A3 90,A4 0,A5 0,A6 0}",
      "END",
      "DEF away( )",
      "PTP XHOME",
      "END",
    ],
  });
  const early = run(files("PATH=-20 ONSTART DELAY=15 DO $OUT[4]=TRUE"));
  expect(early.does).toEqual(["ptp q 0 -90 90 0 0 0 within 100 %", "out_4 = true", "ptp q 30 -90 90 0 0 0"]);
  expect(early.notes).toEqual([
    "glue.src 5: The trigger acts at the point itself: -20 mm along the path and 15 ms from there are not carried out.",
  ]);
  expect(run(files("DISTANCE=1 DELAY=0 DO away( )")).does[0]).toBe(
    "glue.src 9: What a trigger does must not move the robot here.",
  );
});

test("a routine that wants arguments is not run by itself unless they are given by hand", () => {
  const files = {
    "job.src": ["&ACCESS RVP", "DEF job(n :IN)", "DECL INT n", "PTP {A1 n,A2 -90,A3 90,A4 0,A5 0,A6 0}", "END"],
  };
  const alone = run(files);
  expect(alone.does).toEqual([]);
  expect(alone.notes).toEqual([
    "job.src 2: JOB wants to be given N: it is not run by itself. Open it with the program that calls it, or give the values by hand.",
  ]);
  expect(run(files, { N: 7 }).does).toEqual(["ptp q 7 -90 90 0 0 0"]);
});

test("motion that the sensor of another program corrects is refused with its line", () => {
  const files = {
    "track.src": ["&ACCESS RVP", "DEF track( )", "BAS (#INITMOV,0 )", "PTP XHOME", "RSI_MOVECORR( )", "END"],
  };
  expect(run(files).does).toEqual([
    "track.src 5: RSI_MOVECORR is called here and is in none of the files: give the file that holds it as well, or let the call do nothing.",
  ]);
});
