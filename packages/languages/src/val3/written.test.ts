/**
 * An application as a person would write it by the statements of VAL 3 and by what its files hold: the emitter writes
 * the same.
 */
import {
  emptyProgram,
  flangePose,
  pose,
  radians,
  robotById,
  type MoveStep,
  type Pose,
  type Program,
  type Step,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { proveText, runnableFile } from "../prove.ts";
import { val3 } from "./index.ts";

const robot = robotById("staubli_rx160")!;
const XSI = 'xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"';
const NS = "http://www.staubli.com/robotics/VAL3";
const HEADER = '<?xml version="1.0" encoding="utf-8"?>';
const at = (mm: readonly [number, number, number]): MoveStep["target"] => ({
  pose: pose([mm[0] / 1000, mm[1] / 1000, mm[2] / 1000], [0, 1, 0, 0]),
  frame: "table",
  tool: "torch",
  branch: { shoulder: "front", elbow: "up", wrist: "positive" },
});
const program = (steps: readonly Step[]): Program => ({
  ...emptyProgram(robot.id, "Fill trays"),
  steps,
  tools: { torch: pose([0, 0, 0.12]) },
  frames: { table: pose([0.7, 0.1, 0.2], [0, 0, Math.SQRT1_2, Math.SQRT1_2]) },
  signals: { lamp: { kind: "digital-out" } },
});
function written(of: Program): ReadonlyMap<string, readonly string[]> {
  const emitted = val3.emit(of, robot);
  if (emitted.kind === "cannot") throw new Error(emitted.sentence);
  return new Map(emitted.files.map(({ name, text }) => [name, text.split("\r\n")]));
}

describe("every file of an application, line by line", () => {
  const home: MoveStep = {
    id: "a",
    name: "Home",
    type: "move",
    path: "ptp",
    target: { q: [0, 0, 90, 0, 90, 0].map(radians) },
    speed: { ratio: 1 / 3 },
    blend_m: 0,
  };
  const files = written(
    program([
      home,
      {
        id: "b",
        type: "move",
        path: "lin",
        target: at([100, 50, 300]),
        speed: { mps: 0.25 },
        acceleration: { ratio: 0.4 },
        blend_m: 0.01,
      },
      { id: "c", type: "comment", text: "Slowly" },
      { id: "d", type: "move", path: "lin", target: at([100, 50, 200]), speed: { mps: 0.05 }, blend_m: 0 },
      { id: "e", type: "set", signal: "lamp", to: true },
      { id: "f", type: "wait", s: 0.5 },
    ]),
  );

  test("the project names its programs, its data and no library", () => {
    expect([...files.keys()]).toEqual(["start.pgx", "stop.pgx", "Fill_trays.dtx", "Fill_trays.pjx"]);
    expect(files.get("Fill_trays.pjx")).toEqual([
      HEADER,
      `<Project ${XSI} xmlns="${NS}/Project/3">`,
      '  <Parameters version="s7.0" stackSize="5000" millimeterUnit="true"/>',
      "  <Programs>",
      '    <Program file="start.pgx"/>',
      '    <Program file="stop.pgx"/>',
      "  </Programs>",
      "  <Database>",
      '    <Data file="Fill_trays.dtx"/>',
      "  </Database>",
      "  <Libraries/>",
      "</Project>",
      "",
    ]);
  });

  test("the program waits for the end of motions once, before what is no motion; a remark is none", () => {
    const around = (name: string, code: readonly string[]): readonly string[] => [
      HEADER,
      `<Programs ${XSI} xmlns="${NS}/Program/2">`,
      `  <Program name="${name}" access="public">`,
      "    <Code><![CDATA[",
      "    begin",
      ...code.map(line => `      ${line}`),
      "    end",
      "    ]]></Code>",
      "  </Program>",
      "</Programs>",
      "",
    ];
    expect(files.get("start.pgx")).toEqual(
      around("start", [
        "//* Fill trays",
        "// Home",
        "movej(Home,flange,m)",
        "movel(p10,torch,m_2)",
        "//- Slowly",
        "movel(p20,torch,m_3)",
        "waitEndMove()",
        "lamp=true",
        "delay(0.5)",
      ]),
    );
    expect(files.get("stop.pgx")).toEqual(around("stop", ["waitEndMove()"]));
  });

  test("the data: speeds in parts of the axes' and in mm/s, points as they were taught, frames from the height of axis 2", () => {
    const datum = (name: string, type: string, value: string): readonly string[] => [
      `    <Data name="${name}" access="private" xsi:type="array" type="${type}" size="1">`,
      `      <Value key="0" ${value}/>`,
      "    </Data>",
    ];
    // A half turn about y is Rx(180°)·Rz(180°); the table is 200 mm up, axis 2 550 mm.
    const point = (z: number): string =>
      `x="100" y="50" z="${z}" rx="180" ry="0" rz="180" shoulder="righty" elbow="epositive" wrist="wpositive" fatherId="table[0]"`;
    expect(files.get("Fill_trays.dtx")).toEqual([
      HEADER,
      `<Database ${XSI} xmlns="${NS}/Data/2">`,
      "  <Datas>",
      ...datum(
        "m",
        "mdesc",
        'accel="100" vel="33.33333" decel="100" tmax="99999" rmax="99999" blend="off" leave="50" reach="50"',
      ),
      ...datum("Home", "jointRx", 'j1="0" j2="0" j3="90" j4="0" j5="90" j6="0"'),
      ...datum("torch", "tool", 'x="0" y="0" z="120" rx="0" ry="0" rz="0" fatherId="flange[0]" ioLink="valve1"'),
      ...datum(
        "m_2",
        "mdesc",
        'accel="40" vel="100" decel="40" tmax="250" rmax="99999" blend="Cartesian" leave="10" reach="10"',
      ),
      ...datum("table", "frame", 'x="700" y="100" z="-350" rx="0" ry="0" rz="90" fatherId="world[0]"'),
      ...datum("p10", "pointRx", point(300)),
      ...datum(
        "m_3",
        "mdesc",
        'accel="100" vel="100" decel="100" tmax="50" rmax="99999" blend="off" leave="50" reach="50"',
      ),
      ...datum("p20", "pointRx", point(200)),
      ...datum("lamp", "dio", 'link=""'),
      "  </Datas>",
      "</Database>",
      "",
    ]);
  });
});

test("behind a line to taught angles the arm is where the line led it, not a turn away: the next point is reached from there", () => {
  const move = (id: string, path: "ptp" | "lin", target: MoveStep["target"]): MoveStep => ({
    id,
    type: "move",
    path,
    target,
    speed: { ratio: 0.1 },
    blend_m: 0,
  });
  // Axis 4 comes from 150° and goes on to 160°, whatever number a turn away was taught; at 80° the same wrist is nearer
  // than the other, at −100°.
  const next = flangePose(robot.arm, [0, 0, 90, 80, 30, 0].map(radians)) as Pose as Pose<"frame", "tcp">;
  const it = program([
    move("a", "ptp", { q: [0, 0, 90, 150, 30, 90].map(radians) }),
    move("b", "lin", { q: [0, 0, 90, -200, 30, 90].map(radians), tool: "flange" }),
    move("c", "ptp", { pose: next, frame: "world", tool: "flange" }),
  ]);
  const words = written(it)
    .get("Fill_trays.dtx")!
    .flatMap(line => /shoulder=.*wrist="\w+"/.exec(line) ?? []);
  expect(words).toEqual(Array.from({ length: 2 }, () => 'shoulder="righty" elbow="epositive" wrist="wpositive"'));
  const emitted = val3.emit(it, robot);
  expect(emitted.kind === "emitted" && proveText(val3, runnableFile(val3, emitted.files)!, it, robot).kind).toBe(
    "proven",
  );
});

test("a point without a posture of its own is reached in the one that is nearest to where the arm comes from", () => {
  const move = (id: string, target: MoveStep["target"]): MoveStep => ({
    id,
    type: "move",
    path: "ptp",
    target,
    speed: { ratio: 0.1 },
    blend_m: 0,
  });
  for (const [bend, word] of [
    [30, "wpositive"],
    [-30, "wnegative"],
  ] as const) {
    const next = flangePose(robot.arm, [10, 0, 90, 10, bend, 5].map(radians)) as Pose as Pose<"frame", "tcp">;
    const lines = written(
      program([
        move("a", { q: [0, 0, 90, 0, bend, 0].map(radians) }),
        move("b", { pose: next, frame: "world", tool: "flange" }),
      ]),
    ).get("Fill_trays.dtx")!;
    expect(lines.flatMap(line => /wrist="(\w+)"/.exec(line)?.[1] ?? [])).toEqual([word]);
  }
});

test("in a loop and behind it nobody knows whether the robot stands: the program waits for the end of motions once more", () => {
  const files = written(
    program([
      {
        id: "r",
        type: "repeat",
        times: 2,
        steps: [
          { id: "v", type: "wait", s: 0.5 },
          { id: "m", type: "move", path: "lin", target: at([100, 50, 300]), speed: { mps: 0.25 }, blend_m: 0 },
        ],
      },
      { id: "w", type: "wait", s: 1 },
    ]),
  );
  const lines = files.get("start.pgx")!.map(line => line.trim());
  expect(lines.slice(lines.indexOf("begin") + 1, lines.indexOf("end"))).toEqual([
    "//* Fill trays",
    "for l_count=1 to 2 step 1",
    "waitEndMove()",
    "delay(0.5)",
    "movel(p10,torch,m)",
    "waitEndMove()",
    "endFor",
    "waitEndMove()",
    "delay(1)",
  ]);
});
