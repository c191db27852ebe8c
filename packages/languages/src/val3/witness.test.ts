/**
 * An application written out by hand from the statements of VAL 3, not by the emitter; and what it means, worked out by
 * hand from those statements, not by the interpreter.
 */
import { readFileSync } from "node:fs";
import {
  SignalTable,
  angleBetween,
  compose,
  distance,
  emptyProgram,
  flangePose,
  fromMatrix,
  pose,
  radians,
  robotById,
  seededRandom,
  type MoveStep,
  type Program,
  type Step,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { PROOF_TOLERANCE } from "../prove.ts";
import { damaged, expectSane } from "../testing/damage.ts";
import { val3 } from "./index.ts";
import { readInTime } from "../testing/reading-time.ts";

const robot = robotById("staubli_rx160")!;
const XSI = 'xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"';
const NS = "http://www.staubli.com/robotics/VAL3";
const program = (name: string, lines: readonly string[], locals = ""): string =>
  `\uFEFF<?xml version="1.0" encoding="utf-8"?>\r\n<Programs ${XSI} xmlns="${NS}/Program/2">\r\n  <Program name="${name}" access="public">\r\n${locals}    <Code><![CDATA[begin\r\n${lines.join("\r\n")}\r\nend]]></Code>\r\n  </Program>\r\n</Programs>\r\n`;
const datum = (name: string, type: string, value: string): string =>
  `<Data name="${name}" access="private" xsi:type="array" type="${type}" size="1"><Value key="0" ${value} /></Data>\r\n`;
const data = (...all: string[]): string =>
  `<?xml version="1.0" encoding="utf-8"?>\r\n<Database ${XSI} xmlns="${NS}/Data/2">\r\n<Datas>\r\n${all.join("")}</Datas>\r\n</Database>\r\n`;
const six = (values: readonly number[]): string =>
  ["x", "y", "z", "rx", "ry", "rz"].map((name, i) => `${name}="${values[i]}"`).join(" ");
const joint = (name: string, deg: readonly number[]): string =>
  datum(name, "jointRx", deg.map((angle, i) => `j${i + 1}="${angle}"`).join(" "));
const point = (name: string, at: readonly number[], words = "righty epositive wpositive", father = "world"): string => {
  const [shoulder, elbow, wrist] = words.split(" ");
  return datum(
    name,
    "pointRx",
    `${six(at)} shoulder="${shoulder}" elbow="${elbow}" wrist="${wrist}" fatherId="${father}[0]"`,
  );
};
const mdesc = (name: string, more = ""): string =>
  datum(
    name,
    "mdesc",
    `accel="100" vel="50" decel="100" tmax="99999" rmax="99999" blend="off" leave="50" reach="50" ${more}`.replace(
      /(\w+)="[^"]*"(?=.* \1=)/g,
      "",
    ),
  );
const M = mdesc("m");
const SLOW = datum(
  "slow",
  "mdesc",
  'accel="40" vel="100" decel="40" tmax="250" rmax="99999" blend="Cartesian" leave="20" reach="15"',
);
function executed(text: string, signals = new SignalTable()): Step[] {
  const answer = val3.interpret(text, robot);
  if (answer.kind === "not-understood") throw new Error(JSON.stringify(answer.faults));
  const steps: Step[] = [];
  const run = answer.run(signals);
  for (let next = run.next(); next.done !== true && steps.length < 1000; next = run.next())
    if (next.value.step !== undefined) steps.push(next.value.step);
  return steps;
}
const mm = (step: Step): number[] => {
  if (step.type !== "move" || "q" in step.target) throw new Error("no pose");
  return step.target.pose.position.map(v => Math.round(v * 1e6) / 1e3 + 0);
};
const xyzw = (step: Step): number[] => {
  if (step.type !== "move" || "q" in step.target) throw new Error("no pose");
  return step.target.pose.quaternion.map(v => Math.round(v * 1e6) / 1e6 + 0);
};
const faultOf = (text: string): unknown => {
  const answer = val3.interpret(text, robot);
  return answer.kind === "not-understood" ? answer.faults[0] : undefined;
};

describe("executing VAL 3", () => {
  test("joints are degrees from upright; points count from the height of axis 2, 550 mm above the foot", () => {
    const [up, there] = executed(
      program("start", ["movej(jReady,flange,m)", "movel(pThere, flange, slow)", "waitEndMove()"]) +
        data(joint("jReady", [0, 0, 90, 0, 90, 0]), point("pThere", [775, 0, 715, 180, 0, 180]), M, SLOW),
    );
    // Upper arm upright, forearm level, hand down: 150 + 625 ahead, 825 − 110 above axis 2.
    const at = flangePose(robot.arm, [0, 0, 90, 0, 90, 0].map(radians));
    expect(up!).toMatchObject({
      path: "ptp",
      target: { q: [0, 0, 90, 0, 90, 0].map(angle => expect.closeTo(radians(angle), 12)), tool: "flange" },
      speed: { ratio: 0.5 },
      blend_m: 0,
    });
    expect(at.position.map(v => Math.round(v * 1e6) / 1e3)).toEqual([775, 0, 1265]);
    expect(mm(there!)).toEqual([775, 0, 1265]);
    // Rx(180°)·Rz(180°) is a half turn about y, as the hand stands at Ry(180°).
    if (there?.type !== "move" || "q" in there.target) throw new Error("no pose");
    expect(angleBetween(there.target.pose.quaternion, at.quaternion)).toBeLessThan(1e-9);
    expect(there).toMatchObject({
      path: "lin",
      speed: { mps: 0.25 },
      acceleration: { ratio: 0.4 },
      blend_m: 0.015,
      target: { branch: { shoulder: "front", elbow: "up", wrist: "positive" } },
    });
  });

  test("rx, ry, rz: each about the axes as turned by then", () => {
    const steps = executed(
      program("start", ["movel(a,flange,m)", "movel(b,flange,m)"]) +
        data(point("a", [700, 0, 300, 90, 90, 0]), point("b", [700, 0, 300, 0, 90, 90]), M),
    );
    expect(xyzw(steps[0]!)).toEqual([0.5, 0.5, 0.5, 0.5]);
    expect(xyzw(steps[1]!)).toEqual([0.5, 0.5, 0.5, 0.5]);
  });

  test("configuration words choose the posture; free ones leave it to what is near", () => {
    const deg = (q: number): number => (q * 180) / Math.PI;
    const {
      position,
      quaternion: [x, y, z, w],
    } = compose(pose<"world", "base">([0, 0, -0.55]), flangePose(robot.arm, [60, -30, 60, 30, 30, 20].map(radians)));
    // R = Rx·Ry·Rz read off the quaternion.
    const r = [
      deg(Math.atan2(2 * (w * x - y * z), 1 - 2 * (x * x + y * y))),
      deg(Math.asin(2 * (x * z + w * y))),
      deg(Math.atan2(2 * (w * z - x * y), 1 - 2 * (y * y + z * z))),
    ];
    const there = (words: string): unknown =>
      executed(
        program("start", ["movej(p,flange,m)"]) + data(point("p", [...position.map(v => v * 1000), ...r], words), M),
      )[0];
    const branch = { shoulder: "front", elbow: "up", wrist: "positive" };
    expect(there("righty epositive wpositive")).toMatchObject({ target: { branch } });
    expect(there("righty epositive wnegative")).toMatchObject({ target: { branch: { ...branch, wrist: "negative" } } });
    expect(there("righty enegative wfree")).toMatchObject({
      target: { branch: { ...branch, elbow: "down", wrist: expect.any(String) } },
    });
    expect(
      faultOf(
        program("start", ["movej(p,flange,m)"]) +
          data(point("p", [1500, 0, 0, 180, 0, 0], "lefty epositive wpositive"), M),
      ),
    ).toMatchObject({ sentence: "The point is not reached lefty, epositive, wpositive." });
    // Behind the shoulder the elbow that is bent the other way is the upper one.
    expect(there("lefty enegative wpositive")).toMatchObject({ target: { branch: { shoulder: "back", elbow: "up" } } });
  });

  test("frames stand in frames, tools on the flange; appro goes along the tool, compose along the frame", () => {
    const text =
      program("start", [
        "movel(p,tTorch,m)",
        "movel(appro(p,{0,0,-100,0,0,0}),tTorch,m)",
        "movel(compose(p,table,{0,0,50,0,0,0}),tTorch,m)",
        "movec(via,p,tTorch,m)",
      ]) +
      data(
        datum("table", "frame", `${six([700, 0, 100, 0, 0, 90])} fatherId="world[0]"`),
        datum("box", "frame", `${six([10, 0, 0, 0, 0, 0])} fatherId="table[0]"`),
        datum("tTorch", "tool", `${six([0, 0, 120, 0, 0, 0])} fatherId="flange[0]" ioLink="valve1"`),
        point("p", [0, 20, 30, 180, 0, 0], "ssame esame wsame", "box"),
        point("via", [5, 25, 30, 180, 0, 0], "ssame esame wsame", "box"),
        M,
      );
    const steps = executed(text);
    expect(steps[0]).toMatchObject({ target: { frame: "box", tool: "tTorch", pose: { position: [0, 0.02, 0.03] } } });
    expect(steps.slice(1, 3).map(mm)).toEqual([
      [0, 20, 130],
      [0, 20, 80],
    ]);
    expect(steps[3]).toMatchObject({ path: "circ", via: { pose: { position: [0.005, 0.025, 0.03] } } });
    // The box 10 mm along the table's x, which is the world's y.
    expect(val3.interpret(text, robot, pose([1, 0, 0]))).toMatchObject({
      context: {
        frames: { box: { position: [1.7, expect.closeTo(0.01, 12), expect.closeTo(0.65, 12)] } },
        tools: { tTorch: { position: [0, 0, 0.12] } },
      },
    });
  });

  test("loops, decisions, programs, lines, waits and texts; both versions of the files are read", () => {
    const locals = '    <Locals><Local name="i" type="num" xsi:type="array" size="1"/></Locals>\r\n';
    const text =
      program(
        "start",
        [
          "  // a remark",
          "  nCount=0",
          "  for i=3 to 1 step -1",
          "    delay(i/10)",
          "    nCount=nCount+i",
          "  endFor",
          "  while nCount<8",
          "    nCount=nCount+1",
          "  endWhile",
          "  do",
          "    nCount=nCount-1",
          "  until nCount==5",
          "  switch nCount",
          "    case 4,5",
          "      delay(nCount)",
          "    break",
          "    default",
          "      delay(99)",
          "    break",
          "  endSwitch",
          "  movej(jReady,flange,m)",
          "  close(tGrip)",
          "  doLamp=true",
          "  aioSet(aValve,2.5)",
          "  wait(diPart==true)",
          "  wait(!diPart)",
          "  if diPart and nCount==5",
          "    delay(50)",
          "  elseIf diPart!=true",
          "    call rest(1.5)",
          "  else",
          "    delay(60)",
          "  endIf",
          "  if !watch(aioGet(aLevel)>3,2)",
          "    return",
          "  endIf",
          '  putln("it\'s // done")',
          "  open(tGrip)",
          "  return",
          "  delay(70)",
        ],
        locals,
      ) +
      '<?xml version="1.0"?>\n<programList xmlns="ProgramNameSpace"><program name="rest" public="false"><description/><Parameters><Parameter name="s" type="num" use="value"/></Parameters><source><code><![CDATA[begin\n  delay(s)\nend]]></code></source></program></programList>\n' +
      data(
        datum("nCount", "num", 'value="7"'),
        joint("jReady", [0, 0, 90, 0, 90, 0]),
        M,
        datum("tGrip", "tool", `${six([0, 0, 0, 0, 0, 0])} fatherId="flange[0]" ioLink="valve1"`),
        ...["doLamp", "diPart"].map(name => datum(name, "dio", 'link=""')),
        ...["aValve", "aLevel"].map(name => datum(name, "aio", 'link=""')),
      );
    expect(executed(text)).toMatchObject([
      { s: expect.closeTo(0.3) },
      { s: expect.closeTo(0.2) },
      { s: expect.closeTo(0.1) },
      { s: 5 },
      { type: "move" },
      { type: "gripper", closed: true },
      { type: "set", signal: "doLamp", to: true },
      { type: "set", signal: "aValve", to: 2.5 },
      { type: "wait-for", when: { signal: "diPart", is: true } },
      { when: { signal: "diPart", is: false } },
      { s: 1.5 },
      { when: { signal: "aLevel", above: 3 }, timeout_s: 2 },
      { type: "message", text: "it's // done" },
      { type: "gripper", closed: false },
      { type: "stop" },
    ]);
  });

  test("what overtakes a motion, stands nowhere or is not known is a fault at its place", () => {
    const base = data(
      joint("jReady", [0, 0, 90, 0, 90, 0]),
      M,
      datum("doLamp", "dio", 'link=""'),
      point("p", [700, 0, 300, 180, 0, 0], "ssame esame wsame", "nowhere"),
    );
    const overtaking = val3.interpret(program("start", ["movej(jReady,flange,m)", "doLamp=true"]) + base, robot);
    expect(overtaking.kind === "ready" && overtaking.notExecuted).toMatchObject([
      { line: 6, expected: "waitEndMove()" },
    ]);
    expect(faultOf(program("start", ["movel(p,flange,m)"]) + base)).toMatchObject({
      line: 5,
      sentence: "The frame nowhere that a point counts from is not among the data.",
    });
    expect(faultOf(program("start", ["  delay(nPause)"]) + base)).toMatchObject({
      line: 5,
      column: 9,
      sentence: '"nPause" has no value here.',
    });
    expect(faultOf(program("start", ["movej(jReady,flange,m);"]) + base)).toMatchObject({ line: 5, column: 23 });
    expect(faultOf(program("start", ["if true"]) + base)).toMatchObject({ expected: "endif" });
    expect(faultOf(program("start", ["while true", "endWhile"]) + base)).toMatchObject({
      expected: "a motion, a wait or an end",
    });
    expect(faultOf('<Programs><Program name="start"><Code>begin\nend</Code></Program></Programs>')).toMatchObject({
      line: 1,
      column: 39,
      sentence: "Text stands outside the tags.",
    });
  });
});

describe("golden poses", () => {
  const fixture = <T>(path: string): T =>
    JSON.parse(readFileSync(new URL(`../../../../fixtures/${path}`, import.meta.url), "utf8")) as T;
  const orientations = fixture<{
    readonly cases: readonly {
      readonly matrix: readonly (readonly number[])[];
      readonly val3_rxryrz_deg: readonly number[];
    }[];
  }>("conventions/orientations.json").cases;
  interface Sample {
    readonly q: readonly number[];
    readonly vendor_pose: Readonly<Record<string, number>>;
  }
  const { samples } = fixture<{ readonly samples: readonly Sample[] }>("kinematics/staubli_rx160.forward.json");

  test("47 orientations, 7 of them singular: rx, ry, rz mean the matrix that scipy and robodk say", () => {
    expect(orientations).toHaveLength(47);
    for (const { matrix, val3_rxryrz_deg: r } of orientations) {
      const wanted = fromMatrix(matrix.slice(0, 3).flatMap(row => row.slice(0, 3)));
      const [step] = executed(program("start", ["movel(p,flange,m)"]) + data(point("p", [700, 0, 300, ...r]), M));
      if (step?.type !== "move" || "q" in step.target) throw new Error("no pose");
      expect(angleBetween(step.target.pose.quaternion, wanted)).toBeLessThan(PROOF_TOLERANCE.angle_rad);
    }
  });

  test("200 postures: what is written are the numbers of pinocchio and robodk, and mean where they are", () => {
    let written = 0;
    for (const { q, vendor_pose } of samples) {
      const at = flangePose(robot.arm, q);
      const numbers = Object.values(vendor_pose);
      const [step] = executed(program("start", ["movel(p,flange,m)"]) + data(point("p", numbers), M));
      if (step?.type !== "move" || "q" in step.target) throw new Error("no pose");
      expect(distance(step.target.pose.position, at.position)).toBeLessThan(PROOF_TOLERANCE.position_m);
      expect(angleBetween(step.target.pose.quaternion, at.quaternion)).toBeLessThan(PROOF_TOLERANCE.angle_rad);
      const move: MoveStep = {
        id: "a",
        type: "move",
        path: "lin",
        target: {
          pose: compose(pose<"frame", "base">(), compose(at, pose<"flange", "tcp">())),
          frame: "world",
          tool: "flange",
        },
        speed: { mps: 0.1 },
        blend_m: 0,
      };
      const it: Program = { ...emptyProgram(robot.id), steps: [move] };
      const emitted = val3.emit(it, robot);
      if (emitted.kind === "cannot") continue;
      written++;
      const dtx = emitted.files.find(({ name }) => name.endsWith(".dtx"))!.text;
      for (const [i, name] of ["x", "y", "z"].entries())
        expect(Math.abs(Number(new RegExp(` ${name}="([^"]*)"`).exec(dtx)![1]) - numbers[i]!)).toBeLessThan(1e-4);
    }
    expect(written).toBeGreaterThan(190);
  });
});

test("a program of 100,000 lines is read in less than two seconds", () => {
  const lines = Array.from({ length: 100_000 }, (_, i) => `  movej(j${i % 50},flange,m)`);
  const text =
    program("start", lines) + data(...Array.from({ length: 50 }, (_, i) => joint(`j${i}`, [i, 0, 90, 0, 90, 0])), M);
  const { parsed, least_s } = readInTime(val3, text, robot);
  expect(parsed.kind === "parsed" && parsed.program.steps.length).toBe(100_000);
  expect(least_s).toBeLessThan(2);
});

test("2,000 damaged applications: no throw, no hang, every fault with its place", () => {
  const next = seededRandom(7);
  const source =
    program(
      "start",
      [
        "movej(jReady,flange,m)",
        "for i=1 to 3",
        "movel(appro(p,{0,0,-5,0,0,0}),flange,m)",
        "endFor",
        "waitEndMove()",
        "if diPart==true",
        "delay(1)",
        "endIf",
      ],
      '<Locals><Local name="i" type="num"/></Locals>',
    ) +
    data(
      joint("jReady", [0, 0, 90, 0, 90, 0]),
      point("p", [700, 0, 300, 180, 0, 0]),
      M,
      datum("diPart", "dio", 'link=""'),
    );
  for (let i = 0; i < 2000; i++) {
    const text = damaged(source, next);
    const answer = val3.interpret(text, robot);
    if (answer.kind === "not-understood") expectSane(answer.faults, text);
  }
});
