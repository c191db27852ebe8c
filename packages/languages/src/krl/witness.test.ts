/**
 * Text written out by hand from the published listing and from the statements of KRL, not by the emitter; and what it
 * means, worked out by hand from those statements, not by the interpreter.
 */
import { readFileSync } from "node:fs";
import {
  compose,
  degrees,
  emptyProgram,
  palletSlots,
  pose,
  radians,
  robotById,
  type MoveStep,
  type Pallet,
  type Pose,
  type Program,
  type Signals,
  type Step,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { dialectInForm, krl, proveText, runnableFile } from "../index.ts";
import { readInTime } from "../testing/reading-time.ts";

const robot = robotById("kuka_kr6_2")!;
const axisList = dialectInForm(krl, "axis-list")!;
const emitPtpAxis = axisList.emit;
// biome-ignore format: table of numbers
const POINTS = [
  [26.5651, 3.46629, 34.4992, 220.355, 43.6572, 149.288],
  [-42.605, -10.3901, 19.0239, -62.5439, 3.33649, 45.7593],
  [37.8414, -8.14868, -2.29048, 57.5508, -7.09465, -42.9173],
];
const FILE = [
  "DEF PTP_AXIS()",
  "$VEL_AXIS[1] = 100",
  "$VEL_AXIS[2] = 100",
  "$VEL_AXIS[3] = 100",
  "$VEL_AXIS[4] = 100",
  "$VEL_AXIS[5] = 100",
  "$VEL_AXIS[6] = 100",
  "",
  "$ACC_AXIS[1] = 100",
  "$ACC_AXIS[2] = 100",
  "$ACC_AXIS[3] = 100",
  "$ACC_AXIS[4] = 100",
  "$ACC_AXIS[5] = 100",
  "$ACC_AXIS[6] = 100",
  "",
  "PTP {AXIS:A1 26.5651, A2 3.46629,A3 34.4992, A4 220.355, A5 43.6572, A6 149.288}",
  "PTP {AXIS:A1 -42.605, A2 -10.3901,A3 19.0239, A4 -62.5439, A5 3.33649, A6 45.7593}",
  "PTP {AXIS:A1 37.8414, A2 -8.14868,A3 -2.29048, A4 57.5508, A5 -7.09465, A6 -42.9173}",
  "END",
  "",
].join("\r\n");

const move = (id: string, q_deg: readonly number[], more: Partial<MoveStep> = {}): MoveStep => ({
  id,
  type: "move",
  path: "ptp",
  target: { q: q_deg.map(radians) },
  speed: { ratio: 1 },
  blend_m: 0,
  ...more,
});
const program = (steps: readonly Step[], more: Partial<Program> = {}): Program => ({
  ...emptyProgram(robot.id, "Stack parts"),
  steps,
  ...more,
});

function executed(text: string, signals?: Signals): Step[] {
  const answer = krl.interpret(text, robot);
  if (answer.kind === "not-understood") throw new Error(JSON.stringify(answer.faults));
  const run = answer.run(signals);
  const steps: Step[] = [];
  for (let next = run.next(); next.done !== true && steps.length < 200; next = run.next())
    if (next.value.step !== undefined) steps.push(next.value.step);
  return steps;
}
const body = (...lines: string[]): string => ["DEF a( )", ...lines, "END", ""].join("\r\n");
const moves = (...lines: string[]): MoveStep[] =>
  executed(body(...lines)).filter((step): step is MoveStep => step.type === "move");
const q_deg = (step: MoveStep): number[] =>
  "q" in step.target ? step.target.q.map(q => Number(degrees(q).toPrecision(6))) : [];
const faultOf = (...lines: string[]): unknown => {
  const answer = krl.interpret(body(...lines), robot);
  return answer.kind === "ready" ? undefined : answer.faults[0];
};
function emitted(of: Program): {
  files: readonly { name: string; text: string; lines: readonly string[] }[];
  src: string[];
  dat: string[];
  warnings: readonly string[];
} {
  const answer = krl.emit(of, robot);
  if (answer.kind === "cannot") throw new Error(answer.sentence);
  const [src, dat] = answer.files.map(({ text }) => text.split("\r\n").map(line => line.trim()));
  return { files: answer.files, src: src!, dat: dat!, warnings: answer.warnings };
}
const joined = (of: Program): string => runnableFile(krl, emitted(of).files)!.text;

describe("M-50 M-51 M-52 M-53 G-10 the list of axis positions", () => {
  test("byte for byte the published file", () => {
    const answer = emitPtpAxis(program(POINTS.map((q, i) => move(`p${i}`, q))), robot);
    expect(answer).toMatchObject({ kind: "emitted", files: [{ name: "PTP_AXIS.src", text: FILE }] });
  });

  test("M-52 it reads as three joint motions at full speed", () => {
    const steps = executed(FILE);
    expect(steps).toHaveLength(3);
    for (const [i, step] of steps.entries()) {
      expect(step).toMatchObject({ type: "move", path: "ptp", speed: { ratio: 1 } });
      expect(q_deg(step as MoveStep)).toEqual(POINTS[i]);
    }
    expect(krl.parse(FILE, robot)).toMatchObject({ kind: "parsed", warnings: [] });
  });

  test("the list is proven by executing it: all steps within what six digits say, at full speed whatever was taught", () => {
    const taught = program(POINTS.map((q, i) => move(`p${i}`, q, { speed: { ratio: 0.3 } })));
    const answer = axisList.emit(taught, robot);
    expect(answer).toMatchObject({
      kind: "emitted",
      warnings: ["The list moves every axis at 100 %, whatever speed was taught."],
    });
    const file = runnableFile(axisList, answer.kind === "emitted" ? answer.files : [])!;
    expect(proveText(axisList, file, axisList.form.said(taught), robot)).toMatchObject({ kind: "proven" });
    // As taught it would be told to be wrong: the speeds are others.
    expect(proveText(axisList, file, taught, robot).kind).not.toBe("proven");
  });

  test("anything but a joint motion to joint angles is refused at its step", () => {
    expect(emitPtpAxis(program([move("a", POINTS[0]!), { id: "w", type: "wait", s: 1 }]), robot)).toMatchObject({
      kind: "cannot",
      step: "w",
    });
  });

  test("an index of $VEL_AXIS beyond the axes of the robot is warned of, beyond those of the controller refused", () => {
    const parsed = krl.parse(FILE.replace("$VEL_AXIS[6]", "$VEL_AXIS[7]"), robot);
    expect(parsed).toMatchObject({
      kind: "parsed",
      warnings: [{ line: 7, sentence: "$VEL_AXIS[7] is an external axis: the robot has 6 axes." }],
    });
    expect(krl.parse(FILE.replace("$VEL_AXIS[6]", "$VEL_AXIS[13]"), robot)).toMatchObject({
      kind: "not-understood",
      faults: [{ line: 7 }],
    });
  });
});

test("M-57 LIN and PTP to the same point, as the header and the data list are written", () => {
  const target = {
    pose: pose<"frame", "tcp">([1.2, 0.1, 0.9], [0, 1, 0, 0]),
    frame: "world",
    tool: "flange",
    branch: { shoulder: "front", elbow: "up", wrist: "positive" },
  } as const;
  const { files, src, dat } = emitted(
    program([
      move("home", [0, -90, 90, 0, 0, 0], { name: "Start", speed: { ratio: 0.5 } }),
      { id: "in", type: "move", path: "ptp", target, speed: { ratio: 0.5 }, blend_m: 0.02 },
      { id: "on", type: "move", path: "lin", target, speed: { mps: 0.25 }, blend_m: 0 },
      { id: "w", type: "wait", s: 0.5 },
      { id: "g", type: "gripper", closed: true },
    ]),
  );
  expect(files.map(({ name }) => name)).toEqual(["STACK_PARTS.src", "STACK_PARTS.dat"]);
  expect(src).toEqual([
    "&ACCESS RVP",
    "&REL 1",
    "&COMMENT Stack parts",
    "DEF STACK_PARTS( )",
    ";FOLD INI",
    "GLOBAL INTERRUPT DECL 3 WHEN $STOPMESS==TRUE DO IR_STOPM( )",
    "INTERRUPT ON 3",
    "BAS(#INITMOV,0)",
    ";ENDFOLD (INI)",
    ";Start",
    "BAS(#VEL_PTP,50)",
    "PTP XSTART",
    "$APO.CDIS=20",
    "PTP XP2 C_DIS",
    "$VEL.CP=0.25",
    "LIN XP3",
    "WAIT SEC 0.5",
    "GRIPPER=TRUE",
    "END",
    "",
  ]);
  expect(dat).toEqual([
    "&ACCESS RVP",
    "&REL 1",
    "DEFDAT STACK_PARTS",
    "EXT BAS(BAS_COMMAND :IN,REAL :IN)",
    "DECL E6AXIS XSTART={A1 0,A2 -90,A3 90,A4 0,A5 0,A6 0}",
    expect.stringMatching(
      /^DECL E6POS XP2=\{X 1200,Y 100,Z 900,A -?180,B 0,C 180|DECL E6POS XP2=\{X 1200,Y 100,Z 900,.*,S 2,T [0-9]+\}$/,
    ),
    expect.stringMatching(/^DECL E6POS XP3=\{X 1200,Y 100,Z 900,.*,S 2\}$/),
    "SIGNAL GRIPPER $OUT[1]",
    "ENDDAT",
    "",
  ]);
});

describe("what the text means", () => {
  test("Status 2 and Turn 2: wrist in front, elbow up, A5 positive, of all axes only A2 negative", () => {
    const at = (more: string): MoveStep =>
      moves("PTP {A1 0,A2 -90,A3 90,A4 0,A5 10,A6 0}", `PTP {X 1200,Y 0,Z 900,A 180,B 0,C 180${more}}`)[1]!;
    const branch = (more: string): unknown => {
      const { target } = at(more);
      return "pose" in target ? target.branch : target;
    };
    expect(branch(",S 2,T 2")).toEqual({ shoulder: "front", elbow: "up", wrist: "positive" });
    expect(branch(",S 6")).toMatchObject({ wrist: "negative" });
  });

  test("a Turn that is not the nearest one is said by the axes", () => {
    const [, near] = moves("PTP {A1 0,A2 -90,A3 90,A4 0,A5 40,A6 10}", "PTP {X 1200,Y 0,Z 900,A 0,B 120,C 0,S 2}");
    expect("pose" in near!.target).toBe(true);
    const [, , turned] = moves(
      "PTP {A1 0,A2 -90,A3 90,A4 0,A5 40,A6 10}",
      "PTP {X 1200,Y 0,Z 900,A 20,B 120,C 10,S 2}",
      "PTP {X 1200,Y 0,Z 900,A 20,B 120,C 10,S 2,T 'B101010'}",
    );
    expect(turned?.target).toHaveProperty("q");
    expect(faultOf("PTP {X 1200,Y 0,Z 900,A 0,B 120,C 0,S 1,T 0}")).toMatchObject({
      line: 2,
      expected: expect.stringMatching(/Status|Turn/),
    });
  });

  test("A, B, C are turns about z, y and x in this order", () => {
    const [step] = moves("LIN {X 900,Y 0,Z 900,A 90,B 0,C 90}");
    if (step === undefined || !("pose" in step.target)) throw new Error("no pose");
    // Rz(90) · Rx(90): the tool's z points along x, its x along y.
    for (const [i, value] of [0.5, 0.5, 0.5, 0.5].entries())
      expect(Math.abs(step.target.pose.quaternion[i]!)).toBeCloseTo(value, 9);
  });

  test("base, tool and the operator that joins frames", () => {
    const [step] = moves(
      "DECL FRAME F",
      "F={X 100,Y 0,Z 0,A 90,B 0,C 0}",
      "$BASE=F:{X 50,Y 0,Z 0,A 0,B 0,C 0}",
      "$TOOL={X 0,Y 0,Z 200,A 0,B 0,C 0}",
      "LIN {X 10,Y 0,Z 900,A 0,B 90,C 0}",
    );
    const answer = krl.interpret(
      body("$BASE={X 100,Y 50,Z 0,A 90,B 0,C 0}", "LIN {X 10,Y 0,Z 900,A 0,B 90,C 0}"),
      robot,
    );
    if (answer.kind !== "ready" || step === undefined || !("pose" in step.target)) throw new Error("no pose");
    expect(step.target.pose.position[0]).toBeCloseTo(0.01, 9);
    expect(answer.context.frames["base"]!.position.map(value => Math.round(value * 1e6))).toEqual([100000, 50000, 0]);
  });

  test("speeds: BAS and $VEL_AXIS in percent, $VEL.CP in metres per second", () => {
    expect(
      moves(
        "BAS(#VEL_PTP,30)",
        "PTP {A1 10}",
        "$VEL_AXIS[3]=20",
        "PTP {A1 0}",
        "$VEL.CP=0.2",
        "LIN {X 1200}",
        "BAS(#VEL_CP,1.5)",
        "LIN {X 1300}",
      ).map(step => step.speed),
    ).toEqual([{ ratio: 0.3 }, { ratio: 0.2 }, { mps: Math.fround(0.2) }, { mps: 1.5 }]);
  });

  test("a point is passed only into another motion; a wait or an output stops the robot before it", () => {
    const blends = (...lines: string[]): unknown[] =>
      moves("$APO.CDIS=30", "$APO.CPTP=50", ...lines).map(({ blend_m, blend_ratio }) => blend_ratio ?? blend_m);
    expect(blends("PTP {A1 10} C_PTP", "PTP {A1 20} C_DIS", "LIN {X 1200} C_DIS", "LIN {X 1100}")).toEqual([
      0.5, 0.03, 0.03, 0,
    ]);
    expect(blends("LIN {X 1200} C_DIS", "WAIT SEC 0", "LIN {X 1100} C_DIS", "$OUT[3]=TRUE", "LIN {X 1000}")).toEqual([
      0, 0, 0,
    ]);
  });

  test("inline forms of the pendant, with their folds and parameter sets", () => {
    const text = [
      "&ACCESS RVP",
      "DEF weld( )",
      ";FOLD INI",
      "  BAS (#INITMOV,0 )",
      ";ENDFOLD (INI)",
      ";FOLD PTP P1 Vel= 50 % PDAT1 Tool[1] Base[0];%{PE}%R 5.2.25,%MKUKATPBASIS,%CMOVE,%VPTP,%P 1:PTP, 2:P1, 3:C_PTP, 5:50, 7:PDAT1",
      "$BWDSTART=FALSE",
      "PDAT_ACT=PPDAT1",
      "FDAT_ACT=FP1",
      "BAS(#PTP_PARAMS,50)",
      "PTP XP1 C_PTP",
      ";ENDFOLD",
      "LDAT_ACT=LCPDAT1",
      "BAS(#CP_PARAMS,0.4)",
      "LIN XP2",
      "END",
      "DEFDAT weld",
      "EXT BAS (BAS_COMMAND :IN,REAL :IN )",
      "DECL INT SUCCESS",
      "DECL E6AXIS XP1={A1 10.0,A2 -80.0,A3 90.0,A4 0.0,A5 20.0,A6 0.0,E1 0.0}",
      'DECL FDAT FP1={TOOL_NO 1,BASE_NO 0,IPO_FRAME #BASE,POINT2[] " ",TQ_STATE FALSE}',
      "DECL PDAT PPDAT1={VEL 100.0,ACC 100.0,APO_DIST 40.0}",
      "DECL E6POS XP2={X 1200.0,Y 0.0,Z 900.0,A 0.0,B 90.0,C 0.0,S 2,T 2}",
      "DECL LDAT LCPDAT1={VEL 2.0,ACC 100.0,APO_DIST 80.0,APO_FAC 50.0,ORI_TYP #VAR}",
      "ENDDAT",
      "",
    ].join("\n");
    const steps = executed(text);
    expect(steps).toMatchObject([
      { path: "ptp", speed: { ratio: 0.5 }, blend_ratio: 0.4 },
      { path: "lin", speed: { mps: Math.fround(0.4) } },
    ]);
    expect(krl.parse(text, robot)).toMatchObject({
      kind: "parsed",
      warnings: [{ sentence: "TOOL_DATA[1] is kept on the controller: it is taken as it is on delivery." }],
    });
  });

  test("arrays, whole numbers, loops, decisions, routines that hand values back", () => {
    const text = [
      "DEF a( )",
      "INT i,n",
      "DECL E6AXIS p[3]",
      "n=7/2",
      "FOR i=1 TO n",
      "  next(i,p[1])",
      "  PTP p[1]",
      "ENDFOR",
      "WHILE n>1",
      "  n=n-1",
      "  IF n==2 THEN",
      "    WAIT SEC 0.2",
      "  ELSE",
      "    HALT",
      "  ENDIF",
      "ENDWHILE",
      "END",
      "DEF next(k:IN, to:OUT)",
      "INT k",
      "DECL E6AXIS to",
      "to={A1 0,A2 -90,A3 90,A4 0,A5 0,A6 0}",
      "to.A1=turn(k)",
      "END",
      "DEFFCT REAL turn(k:IN)",
      "INT k",
      "RETURN k*1.5",
      "ENDFCT",
      "",
    ].join("\n");
    const steps = executed(text);
    expect(steps.map(step => step.type)).toEqual(["move", "move", "move", "wait", "stop"]);
    expect(steps.slice(0, 3).map(step => q_deg(step as MoveStep)[0])).toEqual([1.5, 3, 4.5]);
  });

  test("arrays filled in the data list, structures declared without DECL, a motion along the axes of the tool, a text as an answer", () => {
    const text = [
      "DEF a( )",
      "FRAME up",
      "ON_ERROR_PROCEED",
      "up={X 0,Y 0,Z 50,A 0,B 0,C 0}",
      "LIN spot[2]",
      "LIN_REL {Z -100} #TOOL",
      "LIN_REL {Z -100}",
      "END",
      "DEFFCT CHAR[8] word( )",
      'RETURN "x"',
      "ENDFCT",
      "DEFDAT a",
      "DECL E6POS spot[2]",
      "spot[1]={X 0,Y 0,Z 0,A 0,B 0,C 0}",
      "spot[2]={X 900,Y 0,Z 1200,A 0,B 90,C 0}",
      "ENDDAT",
      "",
    ].join("\r\n");
    const xyz = (executed(text) as MoveStep[]).map(({ target }) =>
      "q" in target ? [] : target.pose.position.map(v => Math.round(v * 1e6) / 1e3),
    );
    // The tool's z points along x of $WORLD: B turns z onto x.
    expect(xyz).toEqual([
      [900, 0, 1200],
      [800, 0, 1200],
      [800, 0, 1100],
    ]);
  });

  test("what is not understood has its line, its column and what was expected", () => {
    expect(faultOf("LIN {A1 0,A2 -90,A3 90,A4 0,A5 0,A6 0}")).toEqual({
      line: 2,
      column: 1,
      expected: "a position with X, Y, Z, A, B, C",
      sentence: "LIN does not take axis values.",
    });
    expect(faultOf("n=m+1")).toMatchObject({ line: 2, column: 3, expected: "a variable that has a value" });
    expect(faultOf("TRIGGER WHEN SPEED=0 DO $OUT[1]=TRUE")).toMatchObject({ line: 2 });
    expect(faultOf("a_name_that_is_far_too_long=1")).toMatchObject({ expected: "a name of at most 24 characters" });
    expect(faultOf("LOOP", "ENDLOOP")).toMatchObject({ sentence: expect.stringMatching(/without a motion/) });
  });
});

describe("structure is kept", () => {
  const signals: Program["signals"] = {
    "part there": { kind: "digital-in", address: 3 },
    lamp: { kind: "digital-out", address: 7 },
  };
  const down = pose<"frame", "tcp">([0, 0, 0.1], [0, 1, 0, 0]);
  const tray: Pallet = {
    frame: "table",
    origin: pose([0.1, 0, 0]),
    rowEnd: [0.3, 0, 0],
    columnEnd: [0.1, 0.2, 0],
    rows: 3,
    columns: 3,
    layers: 1,
    layer_m: 0,
  };
  const at = (frame: string, tcp: Pose<"frame", "tcp">): MoveStep["target"] => ({
    pose: tcp,
    frame,
    tool: "flange",
    branch: { shoulder: "front", elbow: "up", wrist: "positive" },
  });
  const place = (id: string, z: number): MoveStep => ({
    id,
    type: "move",
    path: "lin",
    target: at("tray", pose([0, 0, z], [0, 1, 0, 0])),
    speed: { mps: 0.2 },
    blend_m: 0,
  });
  const frames = { table: pose<"world", "frame">([0.9, -0.1, 0.5], [0, 0, Math.sin(0.1), Math.cos(0.1)]) };

  const pallet = program(
    [
      {
        id: "pal",
        type: "pallet",
        pallet: "tray",
        steps: [
          { id: "pick", type: "move", path: "ptp", target: at("table", down), speed: { ratio: 0.5 }, blend_m: 0 },
          place("over", 0.1),
          place("on", 0),
          { id: "open", type: "gripper", closed: false },
        ],
      },
    ],
    { pallets: { tray }, frames },
  );

  test("M-54 nine places are three loops, not nine copies, and each place is met", () => {
    const { src } = emitted(pallet);
    expect(src.filter(line => line.startsWith("FOR "))).toHaveLength(3);
    expect(src.filter(line => /^(?:LIN|PTP) /.test(line))).toHaveLength(3);
    const steps = executed(joined(pallet));
    const answer = krl.interpret(joined(pallet), robot);
    if (answer.kind !== "ready") throw new Error("not understood");
    const again = answer.run();
    while (again.next().done !== true);
    expect(steps.map(step => step.type)).toEqual(
      Array.from({ length: 9 }, () => ["move", "move", "move", "gripper"]).flat(),
    );
    const on = steps.filter((_, i) => i % 4 === 2) as MoveStep[];
    for (const [i, wanted] of palletSlots(tray).entries()) {
      const target = on[i]!.target;
      if (!("pose" in target)) throw new Error("no pose");
      const world = compose(answer.context.frames[target.frame] ?? pose<"world", "frame">(), target.pose);
      const should = compose(frames.table as Pose as Pose<"world", "table">, wanted as Pose as Pose<"table", "place">);
      for (const k of [0, 1, 2]) expect(world.position[k]).toBeCloseTo(should.position[k]!, 6);
    }
  });

  test.each(["rows", "columns", "rows-zigzag", "columns-zigzag"] as const)(
    "every order of a pallet with shifted rows and two layers: %s",
    order => {
      const shifted: Pallet = { ...tray, order, interleave: "odd-rows-shifted", layers: 2, layer_m: 0.05 };
      const of = { ...pallet, pallets: { tray: shifted } };
      const answer = krl.interpret(joined(of), robot);
      if (answer.kind !== "ready") throw new Error(JSON.stringify(answer.faults));
      const seen: Pose[] = [];
      const run = answer.run();
      for (let next = run.next(); next.done !== true; next = run.next()) {
        const { step } = next.value;
        if (step?.type === "move" && "pose" in step.target && step.target.frame.startsWith("tray"))
          seen.push(compose(answer.context.frames[step.target.frame]!, step.target.pose) as Pose);
      }
      const should = palletSlots(shifted).map(
        each =>
          compose(frames.table as Pose as Pose<"world", "table">, each as Pose as Pose<"table", "place">).position,
      );
      expect(seen).toHaveLength(2 * should.length);
      for (const [i, position] of should.entries())
        for (const k of [0, 1, 2]) expect(seen[2 * i + 1]!.position[k]).toBeCloseTo(position[k]!, 6);
    },
  );

  test("T-30 T-31 signals by name, decisions, loops, calls, payload, message, search", () => {
    const home = move("h", [0, -90, 90, 0, 10, 0]);
    const full = program(
      [
        home,
        { id: "r", type: "repeat", times: 2, steps: [{ id: "c", type: "call", routine: "Pick up" }] },
        {
          id: "i",
          type: "if",
          when: { signal: "part there", is: true },
          then: [{ id: "l", type: "set", signal: "lamp", to: true }],
          else: [{ id: "m", type: "message", text: 'No "part"' }],
        },
        {
          id: "p",
          type: "payload",
          mass_kg: 2.5,
          center_m: [0, 0.01, 0.08],
          inertia_kgm2: [0.02, 0.03, 0.04, 0.001, 0, 0],
        },
        {
          id: "s",
          type: "move",
          path: "lin",
          target: { q: [0, -80, 90, 0, 10, 0].map(radians) },
          speed: { mps: 0.05 },
          blend_m: 0,
          until: { when: { signal: "part there", is: true }, missing: "fault" },
        },
        { id: "e", type: "stop" },
      ],
      {
        signals,
        routines: {
          "Pick up": [
            { id: "wf", type: "wait-for", when: { signal: "part there", is: false } },
            { id: "pu", type: "set", signal: "lamp", to: true, pulse_s: 0.5 },
            { id: "co", type: "comment", text: "Gently" },
          ],
        },
      },
    );
    const { src } = emitted(full);
    expect(src).toEqual(
      expect.arrayContaining([
        "PICK_UP( )",
        "DEF PICK_UP( )",
        "WAIT FOR NOT PART_THERE",
        "PULSE(LAMP,TRUE,0.5)",
        ";* Gently",
        "IF PART_THERE THEN",
        "LAMP=TRUE",
        "MsgNotify(\"No 'part'\")",
        "BRAKE",
        "RESUME",
      ]),
    );
    const types = (there: boolean): string[] =>
      executed(joined(full), { read: () => there, write: () => undefined }).map(step => step.type);
    expect(types(true)).toEqual(["move", "wait-for", "set", "wait-for", "set", "set", "payload", "move", "stop"]);
    expect(types(false)).toEqual(["move", "wait-for", "set", "wait-for", "set", "message", "payload", "move", "stop"]);
    const steps = executed(joined(full));
    expect(steps[1]).toMatchObject({ when: { signal: "part_there", is: false } });
    expect(steps[2]).toMatchObject({ signal: "lamp", to: true, pulse_s: 0.5 });
    const load = steps.find(step => step.type === "payload")!;
    expect(load.mass_kg).toBe(2.5);
    expect(load.center_m.map(value => Math.round(value * 1e6))).toEqual([0, 10000, 80000]);
    for (const [k, value] of [0.02, 0.03, 0.04, 0.001, 0, 0].entries())
      expect(load.inertia_kgm2![k]).toBeCloseTo(value, 7);
    expect(steps.at(-2)).toMatchObject({ until: { when: { signal: "part_there", is: true }, missing: "fault" } });
    expect(krl.parse(joined(full), robot)).toMatchObject({
      program: {
        signals: { part_there: { kind: "digital-in", address: 3 }, lamp: { kind: "digital-out", address: 7 } },
      },
    });
  });

  test("a point on a table stays a point on the table: its frame and its numbers survive", () => {
    const steps: Step[] = [
      move("h", [0, -90, 90, 0, 10, 0]),
      { id: "a", type: "move", path: "ptp", target: at("table", down), speed: { ratio: 0.5 }, blend_m: 0 },
    ];
    const of = program(steps, { frames });
    const parsed = krl.parse(joined(of), robot);
    expect(parsed).toMatchObject({ kind: "parsed", program: { steps: [{}, { target: { frame: "table" } }] } });
    expect(proveText(krl, runnableFile(krl, emitted(of).files)!, of, robot).kind).toBe("proven");
  });
});

test("a signal without a number, a duration and a routine that is not there stop the export at their step", () => {
  const refuse = (step: Step, more: Partial<Program> = {}): unknown =>
    krl.emit(program([move("h", [0, -90, 90, 0, 0, 0]), step], more), robot);
  expect(
    refuse({ id: "x", type: "set", signal: "lamp", to: true }, { signals: { lamp: { kind: "digital-out" } } }),
  ).toMatchObject({ kind: "cannot", step: "x", sentence: expect.stringMatching(/number on the controller/) });
  expect(refuse(move("x", [0, -90, 90, 0, 0, 0], { speed: { time_s: 2 } }))).toMatchObject({
    kind: "cannot",
    step: "x",
  });
  expect(refuse({ id: "x", type: "call", routine: "nowhere" })).toMatchObject({ kind: "cannot", step: "x" });
});

describe("golden poses", () => {
  interface Orientation {
    readonly matrix: readonly (readonly number[])[];
    readonly kuka_ABC_deg: readonly number[];
  }
  const cases = (
    JSON.parse(
      readFileSync(new URL("../../../../fixtures/conventions/orientations.json", import.meta.url), "utf8"),
    ) as { readonly cases: readonly Orientation[] }
  ).cases;

  test("47 orientations, 7 of them singular: A, B, C mean the matrix that scipy and robodk say", () => {
    expect(cases).toHaveLength(47);
    for (const { matrix, kuka_ABC_deg } of cases) {
      const [a, b, c] = kuka_ABC_deg;
      const p = matrix.slice(0, 3).map(row => row[3]!);
      const [step] = moves(`LIN {X ${p[0]!},Y ${p[1]!},Z ${p[2]!},A ${a!},B ${b!},C ${c!}}`);
      if (step === undefined || !("pose" in step.target)) throw new Error("no pose");
      const [x, y, z, w] = step.target.pose.quaternion;
      const got = [
        1 - 2 * (y * y + z * z),
        2 * (x * y - z * w),
        2 * (x * z + y * w),
        2 * (x * y + z * w),
        1 - 2 * (x * x + z * z),
        2 * (y * z - x * w),
        2 * (x * z - y * w),
        2 * (y * z + x * w),
        1 - 2 * (x * x + y * y),
      ];
      for (const [i, value] of got.entries())
        expect(Math.abs(value - matrix[Math.floor(i / 3)]![i % 3]!)).toBeLessThan(1e-6);
      for (const k of [0, 1, 2]) expect(Math.abs(step.target.pose.position[k]! - p[k]! / 1000)).toBeLessThan(1e-5);
    }
  });
});

test("a program of 100,000 lines is read in less than two seconds", () => {
  const lines: string[] = [];
  for (let i = 0; i < 49_990; i++)
    lines.push(`$VEL.CP=0.${1 + (i % 9)}`, `PTP {A1 ${i % 90},A2 -90,A3 90,A4 0,A5 ${i % 100}.5,A6 0}`);
  const { parsed, least_s } = readInTime(krl, body(...lines), robot);
  expect(least_s).toBeLessThan(2);
  expect(parsed.kind).toBe("parsed");
});
