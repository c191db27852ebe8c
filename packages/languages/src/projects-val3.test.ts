/*
 * Applications of several files as a CS8 or CS9 controller keeps them. Written for these tests; what the robot does is
 * worked out by hand: degrees of the joints, millimetres in the frame, and the order of lines and motions.
 */
import { robotById } from "@twincell/core";
import { expect, test } from "vitest";
import { val3 } from "./index.ts";
import { told } from "./testing/told.ts";

const robot = robotById("staubli_rx160")!;
const run = (files: Parameters<typeof told>[2], inputs?: Parameters<typeof told>[3]): ReturnType<typeof told> =>
  told(val3, robot, files, inputs);
const program = (name: string, lines: readonly string[], head: readonly string[] = []): string[] => [
  '<?xml version="1.0" encoding="utf-8"?>',
  '<Programs xmlns="http://www.staubli.com/robotics/VAL3/Program/2">',
  `<Program name="${name}" access="public">`,
  ...head,
  "<Code><![CDATA[",
  ...lines,
  "]]></Code></Program></Programs>",
];
const data = (...lines: string[]): string[] => [
  '<?xml version="1.0" encoding="utf-8"?>',
  '<Database xmlns="http://www.staubli.com/robotics/VAL3/Data/2"><Datas>',
  ...lines,
  "</Datas></Database>",
];
const datum = (name: string, type: string, ...values: string[]): string =>
  `<Data name="${name}" access="private" xsi:type="array" type="${type}" size="${Math.max(1, values.length)}">${values.join("")}</Data>`;
const M = datum(
  "mFast",
  "mdesc",
  '<Value key="0" accel="100" vel="50" decel="100" tmax="99999" rmax="99999" blend="off" leave="50" reach="50" />',
);
const JOINT = datum("jReady", "jointRx", '<Value key="0" j1="0" j2="10" j3="80" j4="0" j5="90" j6="0" />');
const at = (key: number, x: number, y: number, z: number): string =>
  `<Value key="${key}" x="${x}" y="${y}" z="${z}" rx="180" ry="0" rz="0" shoulder="ssame" elbow="esame" wrist="wsame" fatherId="fTable[0]" />`;
const TABLE = datum(
  "fTable",
  "frame",
  '<Value key="0" x="600" y="0" z="100" rx="0" ry="0" rz="0" fatherId="world[0]" />',
);

test("an application with a library: arrays with gaps, components, arguments by reference, switch, and waits for two lines", () => {
  const { does, notes } = run(
    {
      "app/start.pgx": program(
        "start",
        [
          "begin",
          "  nStep = 2",
          "  movej(jReady,tGrip,mFast)",
          "  waitEndMove()",
          "  for i = 0 to 1",
          "    // der Platz und der darüber",
          "    pNow = pPlace[nStep]",
          "    pNow.trsf.z = pNow.trsf.z + 40*i",
          "    call hand:take(pNow,nStep)",
          "  endFor",
          "  mFast.vel = 25",
          "  movel(appro(pPlace[0],{0,0,-30,0,0,0}),tGrip,mFast)",
          "end",
        ],
        ['<Locals><Local name="i" type="num" /><Local name="pNow" type="pointRx" /></Locals>'],
      ),
      "app/app.dtx": data(
        M,
        JOINT,
        TABLE,
        '<Data name="pPlace" access="private" xsi:type="array" type="pointRx" size="3">' +
          at(0, 10, 0, 50) +
          at(2, 110, 0, 50) +
          "</Data>",
        datum("nStep", "num"),
        datum("tGrip", "tool", '<Value key="0" x="0" y="0" z="120" rx="0" ry="0" rz="0" fatherId="flange[0]" />'),
      ),
      "hand/take.pgx": program(
        "take",
        [
          "begin",
          "  movel(x_pAt,tGrip,mFast)",
          "  waitEndMove()",
          "  switch x_nCount",
          "    case 2, 3",
          "      dOpen = true",
          "      wait(dReady == true and dAir)",
          "    break",
          "    default",
          "      delay(2)",
          "    break",
          "  endSwitch",
          "  x_nCount = x_nCount - 2",
          "end",
        ],
        [
          '<Parameters><Parameter name="x_pAt" type="pointRx" use="value" /><Parameter name="x_nCount" type="num" use="reference" /></Parameters>',
        ],
      ),
      "hand/hand.dtx": data(datum("dOpen", "dio"), datum("dReady", "dio"), datum("dAir", "dio"), M),
    },
    {},
  );
  expect(does).toEqual([
    "ptp q 0 10 80 0 90 0",
    "lin 110 0 50 in fTable",
    "dOpen = true",
    'wait for {"signal":"dReady","is":true}',
    'wait for {"signal":"dAir","is":true}',
    "lin 10 0 90 in fTable",
    "wait 2 s",
    "lin 10 0 80 in fTable",
  ]);
  expect(notes).toEqual([]);
});

test("the older file form: code as text, sections of data, points and frames with their fathers", () => {
  const { does } = run({
    "old/start.pgx": [
      '<?xml version="1.0" encoding="utf-8" ?>',
      '<programList xmlns="ProgramNameSpace" >',
      '  <program name="start" public="true" >',
      "    <description>first &amp; last</description>",
      "    <paramSection/>",
      '    <localSection><local name="i" type="num" byVal="true" /></localSection>',
      "    <source>",
      "      <code>begin",
      "  i=2",
      "  if i&lt;3 and i&gt;1",
      "    movej(jReady,flange,mSlow)",
      "  endIf",
      "  movel(pPut,flange,mSlow)",
      "  waitEndMove()",
      "end</code>",
      "    </source>",
      "  </program>",
      "</programList>",
    ],
    "old/old.dtx": [
      '<?xml version="1.0" encoding="utf-8" ?>',
      '<dataList xmlns="DataNameSpace" >',
      "  <aioSection />",
      "  <frameSection>",
      '    <frame name="fTable" public="false" >',
      '      <fFather alias="" name="world" fatherIndex="0" />',
      '      <valueFrame index="0" ><tfValue x="600" y="0" z="100" rx="0" ry="0" rz="0" /></valueFrame>',
      "    </frame>",
      "  </frameSection>",
      "  <jointSection>",
      '    <joint name="jReady" public="false" ><valueJoint index="0" ><jointValue j1="5" j2="10" j3="80" j4="0" j5="90" j6="0" /></valueJoint></joint>',
      "  </jointSection>",
      "  <mdescSection>",
      '    <mdesc name="mSlow" public="false" ><valueMdesc index="0" ><mdescValue accel="100" vel="20" decel="100" tmax="99999" rmax="99999" blend="joint" leave="30" reach="40" /></valueMdesc></mdesc>',
      "  </mdescSection>",
      "  <pointSection>",
      '    <point name="pPut" public="false" >',
      '      <pFather alias="" name="fTable" fatherIndex="0" />',
      '      <valuePoint index="0" ><tpValue x="10" y="20" z="30" rx="180" ry="0" rz="0" /><cpValue shoulder="ssame" elbow="esame" wrist="wsame" /></valuePoint>',
      "    </point>",
      "  </pointSection>",
      "</dataList>",
    ],
  });
  expect(does).toEqual(["ptp q 5 10 80 0 90 0 within 30", "lin 10 20 30 in fTable within 30"]);
});

test("tasks: one that moves the robot is carried out behind the program, another is named and gives no value", () => {
  const files = (...body: string[]): Parameters<typeof told>[2] => ({
    "cell/start.pgx": program("start", [
      "begin",
      '  taskCreate "talk", 10, talk()',
      '  taskCreate "arm", 100, body(2)',
      "  dLamp = true",
      "end",
    ]),
    "cell/body.pgx": program(
      "body",
      ["begin", ...body, "end"],
      ['<Parameters><Parameter name="x_n" type="num" use="value" /></Parameters>'],
    ),
    "cell/talk.pgx": program("talk", [
      "begin",
      "  while true",
      "    sioGet(sLink,nOrder)",
      "    nOrder = nOrder+1",
      "  endWhile",
      "end",
    ]),
    "cell/cell.dtx": data(M, JOINT, datum("dLamp", "dio"), datum("nOrder", "num"), datum("pDrop", "pointRx")),
  });
  const { does, notes } = run(
    files("  for nOrder2 = 1 to x_n", "    movej(jReady,flange,mFast)", "    waitEndMove()", "  endFor"),
  );
  expect(does).toEqual(["dLamp = true", "ptp q 0 10 80 0 90 0", "ptp q 0 10 80 0 90 0"]);
  expect(notes).toEqual([
    "cell/start.pgx 6: The task talk does not move the robot: it is kept and not executed. What it gives to data is not known.",
    "cell/start.pgx 7: The task body runs beside this program on the controller: it is carried out behind it here.",
  ]);
  expect(run(files("  if nOrder == 1", "    movej(jReady,flange,mFast)", "  endIf")).does.at(-1)).toBe(
    'cell/body.pgx 7: "nOrder" is what another machine or a task answers: it is not known here.',
  );
});

test("what no open file has: a speed and a tool are taken and named, a point is left out, and here() is refused behind it", () => {
  const files = (...lines: string[]): Parameters<typeof told>[2] => ({
    "a/start.pgx": program("start", ["begin", ...lines, "end"]),
    "a/a.dtx": data(JOINT),
  });
  const unknown = run(files("dArc = true"));
  expect(unknown.does).toEqual([]);
  expect(unknown.notes).toEqual([
    "a/start.pgx 6: dArc is in no file that is open: whether it is a line is not known, and no line is set.",
  ]);
  const points = run(files("movej(jReady,tTorch,mWeld)", "movel(pSeam,flange,mWeld)", "movej(jReady,flange,mWeld)"));
  expect(points.does).toEqual(["ptp q 0 10 80 0 90 0", "ptp q 0 10 80 0 90 0"]);
  expect(points.notes).toEqual([
    "a/start.pgx 6: The tool tTorch is in no file that is open: the flange is taken for it.",
    "a/start.pgx 6: The motion descriptor mWeld is in no file that is open: full speed without blending is taken for it.",
    "a/start.pgx 7: The motion to pSeam is left out: no file that is open has the point. The robot goes on to the next point from where it is.",
  ]);
  expect(run(files("movel(pSeam,flange,mWeld)", "movel(here(flange,world),flange,mWeld)")).does[0]).toMatch(
    /^a\/start\.pgx 7: The robot was to be at a point that no open file has\./,
  );
  expect(run(files("dance(jReady)")).does).toEqual([
    'a/start.pgx 6: "dance" is no instruction that is understood here.',
  ]);
});
