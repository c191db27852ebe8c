/**
 * Jobs written out by hand from the data transmission manual and from the instructions of INFORM, not by the emitter;
 * and what they mean, worked out by hand, not by the interpreter.
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
  type Robot,
  type Signals,
  type Step,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { inform, informDialect, informExamplePulses, proveText, runnableFile } from "../index.ts";
import { readInTime } from "../testing/reading-time.ts";

const robot = robotById("yaskawa_gp8")!;
const HEAD = (count: number, ...positions: string[]): string[] => [
  "/JOB",
  "//NAME TEST",
  "//POS",
  `///NPOS ${count},0,0,0,0,0`,
  ...positions,
  "//INST",
  "///DATE 2019/03/01 10:20",
  "///ATTR SC,RW,RJ",
  "////FRAME BASE",
  "///GROUP1 RB1",
  "NOP",
];
const RECTAN = ["///TOOL 0", "///POSTYPE BASE", "///RECTAN", "///RCONF 0,0,0,0,0,0,0,0"];
const job = (positions: readonly string[], ...lines: string[]): string =>
  [...HEAD(positions.filter(each => each.startsWith("C")).length, ...positions), ...lines, "END", ""].join("\r\n");

const move = (id: string, q_deg: readonly number[], more: Partial<MoveStep> = {}): MoveStep => ({
  id,
  type: "move",
  path: "ptp",
  target: { q: q_deg.map(radians) },
  speed: { ratio: 0.5 },
  blend_m: 0,
  ...more,
});
const program = (steps: readonly Step[], more: Partial<Program> = {}): Program => ({
  ...emptyProgram(robot.id, "Stack parts"),
  steps,
  ...more,
});

function executed(text: string, signals?: Signals, dialect = inform): Step[] {
  const answer = dialect.interpret(text, robot);
  if (answer.kind === "not-understood") throw new Error(JSON.stringify(answer.faults));
  const run = answer.run(signals);
  const steps: Step[] = [];
  for (let next = run.next(); next.done !== true && steps.length < 300; next = run.next())
    if (next.value.step !== undefined) steps.push(next.value.step);
  return steps;
}
const moves = (text: string): MoveStep[] => executed(text).filter((step): step is MoveStep => step.type === "move");
const faultOf = (text: string): unknown => {
  const answer = inform.interpret(text, robot);
  return answer.kind === "ready" ? undefined : answer.faults[0];
};
function emitted(
  of: Program,
  dialect = inform,
): {
  files: readonly { name: string; text: string; lines: readonly string[] }[];
  jobs: string[][];
  warnings: readonly string[];
} {
  const answer = dialect.emit(of, robot);
  if (answer.kind === "cannot") throw new Error(answer.sentence);
  return { files: answer.files, jobs: answer.files.map(({ text }) => text.split("\r\n")), warnings: answer.warnings };
}
const joined = (of: Program, dialect = inform): string => runnableFile(dialect, emitted(of, dialect).files)!.text;

describe("what a job means", () => {
  test("X, Y, Z count from the height of axis L; Rx, Ry, Rz are about fixed axes", () => {
    const [step] = moves(
      job([...RECTAN, "C00000=400.000,100.000,200.000,180.0000,0.0000,0.0000"], "MOVL C00000 V=250.0"),
    );
    if (step === undefined || !("pose" in step.target)) throw new Error("no pose");
    expect(step).toMatchObject({ path: "lin", speed: { mps: 0.25 }, blend_m: 0 });
    expect(step.target.pose.position.map(value => Math.round(value * 1e6) / 1e3)).toEqual([400, 100, 530]);
    expect(Math.abs(step.target.pose.quaternion[0])).toBeCloseTo(1, 9);
  });

  test("pulses need the controller's numbers: 13400 pulses of S at 1340 to the degree are 10°", () => {
    const text = job(
      ["///TOOL 0", "///POSTYPE PULSE", "///PULSE", "C00000=13400,-26800,13400,1000,-2000,620"],
      "MOVJ C00000 VJ=12.50",
    );
    expect(faultOf(text)).toMatchObject({ expected: expect.stringMatching(/pulses per degree/) });
    const [step] = executed(text, undefined, informExamplePulses) as MoveStep[];
    expect(step).toMatchObject({ path: "ptp", speed: { ratio: 0.125 } });
    if (step === undefined || !("q" in step.target)) throw new Error("no joint angles");
    expect(step.target.q.map(q => Math.round(degrees(q) * 1e6) / 1e6)).toEqual([10, -20, 10, 1, -2, 1]);
  });

  test("RCONF chooses the posture: no flip turns R by half a turn, rear looks over the shoulder", () => {
    const at = (rconf: string): MoveStep =>
      moves(
        job(
          [
            "///TOOL 0",
            "///POSTYPE BASE",
            "///RECTAN",
            `///RCONF ${rconf}`,
            "C00000=400.000,0.000,100.000,180.0000,0.0000,0.0000",
          ],
          "MOVJ C00000 VJ=10.00",
        ),
      )[0]!;
    const branch = (rconf: string): unknown => {
      const { target } = at(rconf);
      return "pose" in target ? target.branch : "angles";
    };
    const flip = branch("0,0,0,0,0,0") as { wrist: string };
    const noFlip = branch("1,0,0,0,0,0") as { wrist: string };
    expect(flip).toMatchObject({ shoulder: "front", elbow: "up" });
    expect(noFlip.wrist).not.toBe(flip.wrist);
  });

  test("a position is passed by CR or PL into another motion; DOUT, TIMER and WAIT stop the robot before them", () => {
    const points = [
      ...RECTAN,
      ...[0, 1, 2, 3].map(i => `C0000${i}=400.000,${i * 20}.000,200.000,180.0000,0.0000,0.0000`),
    ];
    expect(
      moves(
        job(
          points,
          "MOVL C00000 V=100.0 CR=8.0",
          "MOVL C00001 PL=2",
          "MOVL C00002 PL=2",
          "DOUT OT#(1) ON",
          "MOVL C00003 PL=0",
        ),
      ).map(step => [step.blend_m, step.speed]),
    ).toEqual([
      [0.008, { mps: 0.1 }],
      [0.025, { mps: 0.1 }],
      [0, { mps: 0.1 }],
      [0, { mps: 0.1 }],
    ]);
  });

  test("three MOVC are one arc from the first through the second to the third; MOVS begins where it stands", () => {
    const points = [
      ...RECTAN,
      ...[0, 1, 2, 3, 4, 5].map(
        i => `C0000${i}=400.000,${i * 20}.000,${200 + (i % 2) * 10}.000,180.0000,0.0000,0.0000`,
      ),
    ];
    const steps = moves(
      job(
        points,
        "MOVL C00000 V=100.0",
        "MOVC C00001 V=50.0",
        "MOVC C00002",
        "MOVC C00003 FPT",
        "MOVS C00004",
        "MOVS C00005",
      ),
    );
    expect(steps.map(({ path }) => path)).toEqual(["lin", "lin", "circ", "lin", "spline"]);
    expect(steps[2]).toMatchObject({
      via: { pose: { position: [0.4, 0.04, expect.closeTo(0.53, 9)] } },
      target: { pose: { position: [0.4, 0.06, expect.closeTo(0.54, 9)] } },
    });
    expect(
      faultOf(job(points.slice(0, -3), "MOVL C00000 V=100.0", "MOVC C00001 V=50.0", "MOVC C00002", "TIMER T=1.00")),
    ).toMatchObject({ expected: "a third MOVC behind it" });
  });

  test("variables, loops, labels, decisions, jobs, shifts", () => {
    const main = job(
      [...RECTAN, "C00000=400.000,0.000,200.000,180.0000,0.0000,0.0000"],
      "SET D000 20000",
      "FOR I000 START= 0 TO 2 STEP=1",
      "SET D001 D000",
      "MUL D001 I000",
      "SETE P010 (2) D001",
      "SFTON P010 BF",
      "MOVL C00000 V=100.0",
      "SFTOF",
      "NEXT I000",
      "SET B000 0",
      "*AGAIN",
      "INC B000",
      "CALL JOB:SUB-1 IF B000=2",
      "JUMP *AGAIN IF B000<3",
      "IFTHENEXP B000=3",
      "TIMER T=0.50",
      "ELSE",
      "ABORT",
      "ENDIF",
    );
    const text = `${main}${["/JOB", "//NAME SUB-1", "//POS", "///NPOS 0,0,0,0,0,0", "//INST", "NOP", "DOUT OT#(4) ON", "END", ""].join("\r\n")}`;
    const steps = executed(text);
    expect(steps.map(step => step.type)).toEqual(["move", "move", "move", "set", "wait"]);
    expect(
      steps
        .slice(0, 3)
        .map(step =>
          step.type === "move" && "pose" in step.target ? Math.round(step.target.pose.position[1] * 1e6) / 1e3 : 0,
        ),
    ).toEqual([0, 20, 40]);
    expect(steps[3]).toMatchObject({ signal: "ot_4", to: true });
  });

  test("tools and user frames behind the job, of which none is guessed", () => {
    const text = job(
      [
        "///USER 2",
        "///TOOL 1",
        "///POSTYPE USER",
        "///RECTAN",
        "///RCONF 0,0,0,0,0,0",
        "C00000=10.000,0.000,0.000,180.0000,0.0000,0.0000",
      ],
      "MOVL C00000 V=100.0",
    );
    const parsed = inform.parse(text, robot);
    expect(parsed).toMatchObject({
      kind: "parsed",
      warnings: [
        { sentence: "User frame 2 is kept on the controller: it is taken to be 0." },
        { sentence: "Tool 1 is kept on the controller: it is taken to be 0." },
      ].toSorted(),
    });
    const both = inform.parse(
      `${text}//TOOL 1\r\n///NAME Torch\r\n0.000,0.000,120.000,0.0000,0.0000,0.0000\r\n//UFRAME 2\r\n///NAME Table\r\n////BUSER 400.000,0.000,0.000,0.0000,0.0000,90.0000\r\n`,
      robot,
    );
    expect(both).toMatchObject({
      kind: "parsed",
      warnings: [],
      program: {
        tools: { Torch: { position: [0, 0, 0.12] } },
        frames: { Table: { position: [0.4, 0, 0.33] } },
        steps: [{ target: { frame: "Table", tool: "Torch" } }],
      },
    });
  });

  test("what is not understood has its line, its column and what was expected", () => {
    expect(faultOf(job([...RECTAN, "C00000=1,2,3,4,5"], "MOVL C00000 V=100.0"))).toMatchObject({
      line: 9,
      expected: "six numbers",
    });
    expect(faultOf(job([...RECTAN], "MOVL C00000 V=100.0"))).toMatchObject({ expected: "a position of this job" });
    expect(faultOf(job([...RECTAN], "IMOVE P000 V=100.0 BF"))).toMatchObject({
      line: 15,
      column: 1,
      expected: "an instruction of INFORM",
    });
    expect(faultOf(job([...RECTAN], "*A", "JUMP *A"))).toMatchObject({
      sentence: expect.stringMatching(/without a motion/),
    });
    expect(faultOf(job([...RECTAN], "JUMP *B"))).toMatchObject({ column: 6, expected: "a label of this job" });
    expect(faultOf(job([...RECTAN, "C00000=400,0,200,180,0,0"]).replace("NPOS 1", "NPOS 2"))).toMatchObject({
      line: 4,
      expected: "1 and 0",
    });
  });
});

describe("what is written", () => {
  const target = {
    pose: pose<"frame", "tcp">([0.4, 0.1, 0.53], [1, 0, 0, 0]),
    frame: "world",
    tool: "flange",
    branch: { shoulder: "front", elbow: "up", wrist: "negative" },
  } as const;
  const steps: Step[] = [
    move("home", [0, 0, 0, 0, -90, 0], { name: "Start" }),
    { id: "in", type: "move", path: "lin", target, speed: { mps: 0.25 }, blend_m: 0 },
    { id: "w", type: "wait", s: 0.5 },
    { id: "g", type: "gripper", closed: true },
  ];

  test("a job as a person would read it", () => {
    const { files, jobs } = emitted(program(steps));
    expect(files.map(({ name }) => name)).toEqual(["STACK_PARTS.JBI"]);
    const [text] = jobs;
    expect(text!.slice(0, 8)).toEqual([
      "/JOB",
      "//NAME STACK_PARTS",
      "//POS",
      "///NPOS 2,0,0,0,0,0",
      "///TOOL 0",
      "///POSTYPE BASE",
      "///RECTAN",
      `///RCONF ${Array(24).fill(0).join(",")}`,
    ]);
    expect(text).toContain("C00001=400.000,100.000,200.000,180.0000,0.0000,0.0000");
    expect(text!.slice(text!.indexOf("//INST"))).toEqual([
      "//INST",
      "///DATE 2000/01/01 00:00",
      "///COMM Stack parts",
      "///ATTR SC,RW,RJ",
      "////FRAME BASE",
      "///GROUP1 RB1",
      "NOP",
      "'Start",
      "MOVJ C00000 VJ=50.00 PL=0",
      "MOVL C00001 V=250.0 PL=0",
      "TIMER T=0.50",
      "HAND 1 ON",
      "END",
      "",
    ]);
  });

  test("pulses are refused without the controller's numbers, and marked when they are an example", () => {
    const unknown = informDialect({ positions: "pulse" });
    expect(unknown.emit(program(steps), robot)).toMatchObject({
      kind: "cannot",
      sentence: "The pulses per degree of this Yaskawa GP8 are not known.",
    });
    const withPulses = (perDegree: readonly number[]): Robot => ({
      ...robot,
      vendorSection: {
        ...robot.vendorSection!,
        pulses: { perRadian: perDegree.map(value => (value * 180) / Math.PI), source: "ALL.PRM of the cell" },
      },
    });
    const own = unknown.emit(
      program([move("a", [10, 20, 30, 0, -90, 5.004])]),
      withPulses([100, 100, 100, 100, 100, 100]),
    );
    expect(own.kind === "emitted" && own.files[0]!.text).toContain("C00000=1000,2000,3000,0,-9000,500");
    expect(emitted(program(steps), informExamplePulses).warnings.join(" ")).toMatch(
      /example for the virtual controller/,
    );
    expect(own.kind === "emitted" && own.warnings.join(" ")).toMatch(/by ALL\.PRM of the cell/);
    expect(unknown.emit(program(steps), withPulses([100, 100])).kind).toBe("cannot");
  });

  const signals: Program["signals"] = {
    part: { kind: "digital-in", address: 3 },
    lamp: { kind: "digital-out", address: 7 },
  };
  const tray: Pallet = {
    frame: "table",
    origin: pose([0.1, 0, 0]),
    rowEnd: [0.16, 0, 0],
    columnEnd: [0.1, 0.06, 0],
    rows: 3,
    columns: 3,
    layers: 1,
    layer_m: 0,
  };
  const frames = { table: pose<"world", "frame">([0.3, -0.1, 0.4], [0, 0, Math.sin(0.1), Math.cos(0.1)]) };
  const at = (frame: string, z: number): MoveStep["target"] => ({
    pose: pose([0, 0, z], [1, 0, 0, 0]),
    frame,
    tool: "flange",
    branch: { shoulder: "front", elbow: "up", wrist: "negative" },
  });
  const lin = (id: string, z: number): MoveStep => ({
    id,
    type: "move",
    path: "lin",
    target: at("tray", z),
    speed: { mps: 0.2 },
    blend_m: 0,
  });
  const of = (more: Partial<Pallet>): Program =>
    program(
      [
        {
          id: "pal",
          type: "pallet",
          pallet: "tray",
          steps: [
            move("pick", [0, 0, 0, 0, -90, 0]),
            lin("over", 0.1),
            lin("on", 0.05),
            { id: "open", type: "gripper", closed: false },
          ],
        },
      ],
      { pallets: { tray: { ...tray, ...more } }, frames },
    );

  test("M-54 nine places are loops with a shift, not nine copies", () => {
    const [text] = emitted(of({})).jobs;
    expect(text!.filter(line => line.startsWith("MOV"))).toHaveLength(3);
    expect(text!.filter(line => line.startsWith("FOR "))).toHaveLength(3);
    expect(executed(joined(of({}))).map(step => step.type)).toEqual(
      Array.from({ length: 9 }, () => ["move", "move", "move", "gripper"]).flat(),
    );
  });

  test.each(["rows", "columns", "rows-zigzag", "columns-zigzag"] as const)(
    "every place in the order %s, with shifted rows and two layers, in a frame and in the world",
    order => {
      for (const frame of ["table", "world"]) {
        const origin =
          frame === "world"
            ? compose(frames.table as Pose as Pose<"frame", "table">, tray.origin as Pose as Pose<"table", "place">)
            : tray.origin;
        const shift =
          frame === "world"
            ? {
                rowEnd: [origin.position[0] + 0.06, origin.position[1], origin.position[2]] as [number, number, number],
                columnEnd: [origin.position[0], origin.position[1] + 0.06, origin.position[2]] as [
                  number,
                  number,
                  number,
                ],
              }
            : {};
        const shifted: Pallet = {
          ...tray,
          ...shift,
          frame,
          origin,
          order,
          interleave: "odd-rows-shifted",
          layers: 2,
          layer_m: 0.03,
        };
        const whole = { ...of({}), pallets: { tray: shifted } };
        const answer = inform.interpret(joined(whole), robot);
        if (answer.kind !== "ready") throw new Error(JSON.stringify(answer.faults));
        const seen: Pose[] = [];
        const run = answer.run();
        for (let next = run.next(); next.done !== true; next = run.next()) {
          const { step } = next.value;
          if (step?.type === "move" && step.path === "lin" && "pose" in step.target)
            seen.push(compose((answer.context.frames[step.target.frame] ?? pose()) as Pose, step.target.pose as Pose));
        }
        const world = frame === "world" ? pose<"world", "frame">() : frames.table;
        const should = palletSlots(shifted).map(
          each => compose(world as Pose as Pose<"world", "table">, each as Pose as Pose<"table", "place">).position,
        );
        expect(seen).toHaveLength(2 * should.length);
        for (const [i, position] of should.entries())
          for (const k of [0, 1, 2])
            expect(seen[2 * i + 1]!.position[k]).toBeCloseTo(position[k]! + (k === 2 ? 0.05 : 0), 5);
      }
    },
  );

  test("T-30 T-31 signals, decisions, loops, jobs for routines, search", () => {
    const full = program(
      [
        move("h", [0, 0, 0, 0, -90, 0]),
        { id: "r", type: "repeat", times: 2, steps: [{ id: "c", type: "call", routine: "Pick up" }] },
        {
          id: "i",
          type: "if",
          when: { signal: "part", is: true },
          then: [{ id: "l", type: "set", signal: "lamp", to: true }],
          else: [{ id: "m", type: "message", text: "No part" }],
        },
        {
          id: "s",
          type: "move",
          path: "lin",
          target: { q: [0, 5, 0, 0, -90, 0].map(radians) },
          speed: { mps: 0.05 },
          blend_m: 0,
          until: { when: { signal: "part", is: true }, missing: "fault" },
        },
        { id: "e", type: "stop" },
      ],
      {
        signals,
        routines: {
          "Pick up": [
            { id: "wf", type: "wait-for", when: { signal: "part", is: false } },
            { id: "pu", type: "set", signal: "lamp", to: true, pulse_s: 0.5 },
            { id: "co", type: "comment", text: "Gently" },
          ],
        },
      },
    );
    const { files, jobs } = emitted(full);
    expect(files.map(({ name }) => name)).toEqual(["STACK_PARTS.JBI", "PICK_UP.JBI"]);
    expect(jobs[0]).toEqual(
      expect.arrayContaining([
        "FOR I000 START= 1 TO 2",
        "CALL JOB:PICK_UP",
        "NEXT I000",
        "IFTHENEXP IN#(3)=ON",
        "DOUT OT#(7) ON",
        "ELSE",
        'MSG "No part"',
        "ENDIF",
        "ABORT IF IN#(3)=OFF",
        "ABORT",
      ]),
    );
    expect(jobs[1]).toEqual(expect.arrayContaining(["WAIT IN#(3)=OFF", "PULSE OT#(7) T=0.50", "'* Gently"]));
    const types = (there: boolean): string[] =>
      executed(joined(full), { read: () => there, write: () => undefined }).map(step => step.type);
    expect(types(true)).toEqual(["move", "wait-for", "set", "wait-for", "set", "set", "move", "stop"]);
    expect(types(false)).toEqual(["move", "wait-for", "set", "wait-for", "set", "message", "move", "stop"]);
    expect(executed(joined(full)).at(-2)).toMatchObject({
      until: { when: { signal: "in_3", is: true }, missing: "fault" },
    });
    expect(inform.parse(joined(full), robot)).toMatchObject({
      program: { signals: { in_3: { kind: "digital-in", address: 3 }, ot_7: { kind: "digital-out", address: 7 } } },
    });
  });

  test("what INFORM lacks stops the export at its step", () => {
    const refuse = (step: Step, more: Partial<Program> = {}): unknown =>
      inform.emit(program([move("h", [0, 0, 0, 0, -90, 0]), step], more), robot);
    expect(refuse({ id: "x", type: "payload", mass_kg: 1, center_m: [0, 0, 0] })).toMatchObject({
      kind: "cannot",
      step: "x",
    });
    expect(refuse({ id: "x", type: "wait", s: 700 })).toMatchObject({
      kind: "cannot",
      step: "x",
      sentence: expect.stringMatching(/655\.35/),
    });
    expect(refuse({ id: "x", type: "set", signal: "lamp", to: true })).toMatchObject({ kind: "cannot", step: "x" });
    expect(refuse({ id: "x", type: "set", signal: "lamp", to: false, pulse_s: 1 }, { signals })).toMatchObject({
      kind: "cannot",
      step: "x",
    });
  });

  test("what is written is proven", () => {
    for (const dialect of [inform, informExamplePulses])
      expect(
        proveText(dialect, runnableFile(dialect, emitted(program(steps), dialect).files)!, program(steps), robot),
      ).toMatchObject({ kind: "proven" });
  });
});

describe("golden poses", () => {
  interface Orientation {
    readonly matrix: readonly (readonly number[])[];
    readonly fanuc_WPR_yaskawa_RxRyRz_deg: readonly number[];
  }
  const cases = (
    JSON.parse(
      readFileSync(new URL("../../../../fixtures/conventions/orientations.json", import.meta.url), "utf8"),
    ) as { readonly cases: readonly Orientation[] }
  ).cases;

  test("47 orientations, 7 of them singular: Rx, Ry, Rz mean the matrix that scipy and robodk say", () => {
    expect(cases).toHaveLength(47);
    for (const { matrix, fanuc_WPR_yaskawa_RxRyRz_deg: turns } of cases) {
      const p = matrix.slice(0, 3).map(row => row[3]!);
      const [step] = moves(
        job(
          [
            "///TOOL 0",
            "///POSTYPE BASE",
            "///RECTAN",
            `C00000=${[...p, ...turns].map(value => value.toFixed(9)).join(",")}`,
          ],
          "MOVL C00000 V=100.0",
        ),
      );
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
      for (const k of [0, 1, 2])
        expect(Math.abs(step.target.pose.position[k]! - p[k]! / 1000 - (k === 2 ? 0.33 : 0))).toBeLessThan(1e-5);
    }
  });
});

test("a job of 100,000 lines is read in less than two seconds", () => {
  const positions: string[] = [];
  const lines: string[] = [];
  for (let i = 0; i < 49_990; i++) {
    positions.push(`C${String(i).padStart(5, "0")}=${i % 900},${i % 800},${i % 700},${i % 600},${i % 500},${i % 400}`);
    lines.push(`MOVJ C${String(i).padStart(5, "0")} VJ=${1 + (i % 90)}.00 PL=0`);
  }
  const { parsed, least_s } = readInTime(
    informExamplePulses,
    job(["///TOOL 0", "///POSTYPE PULSE", "///PULSE", ...positions], ...lines),
    robot,
  );
  expect(least_s).toBeLessThan(2);
  expect(parsed.kind).toBe("parsed");
});
