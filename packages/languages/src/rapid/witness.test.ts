/**
 * Text written out by hand from the statements of RAPID, not by the emitter; and what it means, worked out by hand from
 * those statements, not by the interpreter.
 */
import { readFileSync } from "node:fs";
import {
  SignalTable,
  angleBetween,
  distance,
  emptyProgram,
  flangePose,
  fromMatrix,
  pose,
  radians,
  robotById,
  type MoveStep,
  type Program,
  type Step,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { PROOF_TOLERANCE } from "../prove.ts";
import { rapid } from "./index.ts";
import { readInTime } from "../testing/reading-time.ts";

const robot = robotById("abb_irb120")!;
const AXES = "[9E9,9E9,9E9,9E9,9E9,9E9]";
const moduleOf = (data: string, ...lines: string[]): string =>
  ["MODULE a", data, "PROC main()", ...lines, "ENDPROC", "ENDMODULE", ""].join("\n");
const body = (...lines: string[]): string => moduleOf("", ...lines);
function executed(text: string, signals = new SignalTable(), of = robot): Step[] {
  const answer = rapid.interpret(text, of);
  if (answer.kind === "not-understood") throw new Error(JSON.stringify(answer.faults));
  const steps: Step[] = [];
  const run = answer.run(signals);
  for (let next = run.next(); next.done !== true && steps.length < 1000; next = run.next())
    if (next.value.step !== undefined) steps.push(next.value.step);
  return steps;
}
const moves = (...lines: string[]): MoveStep[] =>
  executed(body(...lines)).filter((step): step is MoveStep => step.type === "move");
const mm = (step: MoveStep): number[] => {
  if ("q" in step.target) throw new Error("joint angles");
  return step.target.pose.position.map(v => Math.round(v * 1e6) / 1e3 + 0);
};
const xyzw = (step: MoveStep): number[] => {
  if ("q" in step.target) throw new Error("joint angles");
  return step.target.pose.quaternion.map(v => Math.round(v * 1e6) / 1e6 + 0);
};

describe("executing RAPID", () => {
  test("a robtarget is millimetres and w x y z from the base; a jointtarget degrees", () => {
    const [joints, target] = moves(
      `MoveAbsJ [[10,20,-30,40,50,-60],${AXES}],v1000,fine,tool0;`,
      `MoveL [[300,100,400],[0,1,0,0],[0,0,0,0],${AXES}],v100,z10,tool0;`,
    );
    expect(joints!.target).toEqual({
      q: [10, 20, -30, 40, 50, -60].map(angle => expect.closeTo(radians(angle), 12)),
      tool: "flange",
    });
    expect([mm(target!), xyzw(target!)]).toEqual([
      [300, 100, 400],
      [1, 0, 0, 0],
    ]);
    expect([joints, target].map(step => [step!.path, step!.speed, step!.blend_m])).toEqual([
      ["ptp", { mps: 1 }, 0],
      ["lin", { mps: 0.1 }, 0.01],
    ]);
  });

  test("speeds and zones: predefined, own, \\V, \\T, \\Z, z0 is 0.3 mm, VelSet and AccSet hold until they are set again", () => {
    const p = `[[300,0,400],[0,1,0,0],[0,0,0,0],${AXES}]`;
    const steps = executed(
      moduleOf(
        "CONST speeddata slow:=[12.5,500,5000,1000];\nCONST zonedata wide:=[FALSE,7.5,11,11,1.1,11,1.1];",
        `MoveL ${p},slow,wide,tool0;`,
        `MoveL ${p},v100\\V:=250,z0,tool0;`,
        `MoveL ${p},v100\\T:=2.5,fine,tool0;`,
        "VelSet 50,800;",
        "AccSet 40,100;",
        `MoveL ${p},v5000,z1,tool0;`,
        "VelSet 100,5000;",
        "AccSet 100,100;",
        `MoveL ${p},v5000,z1,tool0;`,
      ),
    ) as MoveStep[];
    expect(steps.map(step => step.speed)).toEqual([
      { mps: 0.0125 },
      { mps: 0.25 },
      { time_s: 2.5 },
      { mps: 0.8 },
      { mps: 5 },
    ]);
    expect(steps.map(step => step.blend_m)).toEqual([0.0075, 0.0003, 0, 0.001, 0.001]);
    expect(steps.map(step => step.acceleration?.ratio)).toEqual([undefined, undefined, undefined, 0.4, undefined]);
  });

  test("tools and work objects: the target counts from user frame times object frame", () => {
    const steps = executed(
      moduleOf(
        [
          "PERS tooldata torch:=[TRUE,[[0,0,140],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];",
          'PERS wobjdata carton:=[FALSE,TRUE,"",[[400,0,0],[0.7071068,0,0,0.7071068]],[[0,0,100],[1,0,0,0]]];',
        ].join("\n"),
        `MoveL [[50,0,0],[0,1,0,0],[0,0,0,0],${AXES}],v100,fine,torch\\WObj:=carton;`,
      ),
    );
    expect(steps[0]).toMatchObject({ target: { tool: "torch", frame: "carton", pose: { position: [0.05, 0, 0] } } });
    const ready = rapid.interpret(
      moduleOf(
        'PERS wobjdata carton:=[FALSE,TRUE,"",[[400,0,0],[0.7071068,0,0,0.7071068]],[[0,0,100],[1,0,0,0]]];',
        `MoveL [[50,0,0],[0,1,0,0],[0,0,0,0],${AXES}],v100,fine,tool0,\\WObj:=carton;`,
      ),
      robot,
      pose([1, 0, 0.5]),
    );
    expect(ready).toMatchObject({
      kind: "ready",
      context: { frames: { carton: { position: [expect.closeTo(1.4), 0, expect.closeTo(0.6)] } } },
    });
  });

  test("Offs goes along the work object, RelTool along the tool; components and records can be changed", () => {
    const target = `[[300,0,400],[0,1,0,0],[0,0,0,0],${AXES}]`;
    const [offs, tool, spun, lifted] = executed(
      moduleOf(
        `CONST robtarget p1:=${target};\nVAR robtarget p2;\nVAR pos up:=[0,0,10];`,
        "MoveL Offs(p1,1,2,3),v100,fine,tool0;",
        "MoveL RelTool(p1,1,2,3),v100,fine,tool0;",
        "MoveL RelTool(p1,0,0,0\\Rz:=90),v100,fine,tool0;",
        "p2:=p1;",
        "p2.trans:=p2.trans+2*up;",
        "p2.trans.x:=310;",
        "MoveL p2,v100,fine,tool0;",
      ),
    ) as MoveStep[];
    expect(mm(offs!)).toEqual([301, 2, 403]);
    // The tool hangs upside down, turned about x by 180°.
    expect(mm(tool!)).toEqual([301, -2, 397]);
    // Rx(180°)·Rz(90°): half turn about the axis between x and −y.
    expect(xyzw(spun!).map(Math.abs)).toEqual([0.707107, 0.707107, 0, 0]);
    expect(mm(lifted!)).toEqual([310, 0, 420]);
  });

  test("a configuration chooses the posture: quarters of axes 1, 4, 6 and cfx", () => {
    // Both ways round the wrist: axis 5 at 60° and at −60°, axes 4 and 6 half a turn on.
    const {
      position,
      quaternion: [x, y, z, w],
    } = flangePose(robot.arm, [10, 20, 10, 100, 60, 30].map(radians));
    const at = `[[${position.map(v => v * 1000).join(",")}],[${[w, x, y, z].join(",")}]`;
    const move = (conf: string): string => `MoveJ ${at},${conf},${AXES}],v100,fine,tool0;`;
    const positive = { shoulder: "front", elbow: "up", wrist: "positive" };
    expect(moves(move("[0,1,0,0]"))[0]!.target).toMatchObject({ branch: positive });
    expect(moves(move("[0,-1,-2,1]"))[0]!.target).toMatchObject({ branch: { ...positive, wrist: "negative" } });
    expect(moves("ConfJ\\Off;", move("[0,-1,-2,1]"))[0]!.target).not.toHaveProperty("branch");
    // The angles themselves: CJointT behind the move.
    const back = moves(move("[0,-1,-2,1]"), "MoveAbsJ CJointT(),v100,fine,tool0;")[1]!.target;
    expect("q" in back && back.q.map(q => Math.round((q / Math.PI) * 180))).toEqual([10, 20, 10, -80, -60, -150]);
  });

  test("loops, decisions, routines, arrays and lines", () => {
    const text = [
      "%%%",
      "VERSION:1",
      "LANGUAGE:ENGLISH",
      "%%%",
      "MODULE prog(SYSMODULE)",
      "  ! data",
      "  CONST num waits{3}:=[0.1,0.2,0.3];",
      "  VAR num i:=0;",
      "  LOCAL PERS bool done:=FALSE;",
      "  FUNC num twice(num x)",
      "    RETURN 2*x;",
      "  ENDFUNC",
      "  PROC rest(num s\\switch Long)",
      "    WaitTime s;",
      "  ENDPROC",
      "  PROC main()",
      "    VAR num k;",
      "    FOR j FROM 3 TO 1 STEP -1 DO",
      "      rest waits{j};",
      "    ENDFOR",
      "    WHILE i<2 DO",
      "      i:=i+1;",
      "      TEST i",
      "      CASE 1,7:",
      "        WaitTime twice(i)+0.5;",
      "      DEFAULT:",
      "        SetDO do3,1;",
      "      ENDTEST",
      "    ENDWHILE",
      "    IF i=2 AND NOT done THEN",
      "      Set lamp;",
      "      Reset lamp;",
      "    ELSEIF i=3 THEN",
      "      Stop;",
      "    ENDIF",
      "    IF i=2 PulseDO\\PLength:=0.5,lamp;",
      "    SetDO doGripper,1;",
      "    SetAO level,2.5;",
      "    WaitDI part,1\\MaxTime:=5;",
      "    WaitUntil DInput(part)=0;",
      "    WaitAI level_in\\GT,3;",
      '    TPWrite "say ""hi""";',
      "    GripLoad [1.5,[0,0,50],[1,0,0,0],0,0,0];",
      "    EXIT;",
      "    WaitTime 99;",
      "  ENDPROC",
      "ENDMODULE",
    ].join("\r\n");
    expect(executed(text)).toMatchObject([
      { s: 0.3 },
      { s: 0.2 },
      { s: 0.1 },
      { s: 2.5 },
      { type: "set", signal: "do3", to: true },
      { signal: "lamp", to: true },
      { signal: "lamp", to: false },
      { signal: "lamp", to: true, pulse_s: 0.5 },
      { type: "gripper", closed: true },
      { signal: "level", to: 2.5 },
      { type: "wait-for", when: { signal: "part", is: true }, timeout_s: 5 },
      { when: { signal: "part", is: false } },
      { when: { signal: "level_in", above: 3 } },
      { type: "message", text: 'say "hi"' },
      { type: "payload", mass_kg: 1.5, center_m: [0, 0, 0.05] },
      { type: "stop" },
    ]);
  });

  test("records and other names of types are passed by", () => {
    const steps = executed(
      moduleOf("RECORD job\nnum count;\nstring name;\nENDRECORD\nALIAS num level;", "WaitTime 1.5;"),
    );
    expect(steps).toMatchObject([{ type: "wait", s: 1.5 }]);
  });

  test("SearchL ends at the line; without an answer it is a fault, or goes on where the handler says so", () => {
    const text = (handler: string): string =>
      `MODULE a\nVAR robtarget sp;\nPROC main()\nSearchL\\Stop,touch,sp,[[300,0,400],[0,1,0,0],[0,0,0,0],${AXES}],v50,tool0;\n${handler}ENDPROC\nENDMODULE\n`;
    expect(executed(text(""))).toMatchObject([
      { path: "lin", until: { when: { signal: "touch", is: true }, missing: "fault" } },
    ]);
    expect(executed(text("ERROR\nIF ERRNO=ERR_WHLSEARCH THEN\nTRYNEXT;\nENDIF\n"))).toMatchObject([
      { until: { missing: "continue" } },
    ]);
  });
});

describe("golden poses", () => {
  const orientations = JSON.parse(
    readFileSync(new URL("../../../../fixtures/conventions/orientations.json", import.meta.url), "utf8"),
  ) as {
    readonly cases: readonly {
      readonly matrix: readonly (readonly number[])[];
      readonly abb_q1234: readonly number[];
    }[];
  };

  test("47 orientations, 7 of them singular: q1 … q4 mean the matrix that scipy and robodk say, read and written", () => {
    expect(orientations.cases).toHaveLength(47);
    for (const { matrix, abb_q1234 } of orientations.cases) {
      const wanted = fromMatrix(matrix.slice(0, 3).flatMap(row => row.slice(0, 3)));
      const position = matrix.slice(0, 3).map(row => row[3]!);
      const [step] = moves(
        "ConfJ\\Off;",
        `MoveL [[${position.join(",")}],[${abb_q1234.map(x => x.toFixed(9)).join(",")}],[0,0,0,0],${AXES}],v100,fine,tool0;`,
      );
      if (step === undefined || "q" in step.target) throw new Error("no pose");
      expect(angleBetween(step.target.pose.quaternion, wanted)).toBeLessThan(PROOF_TOLERANCE.angle_rad);
      expect(
        distance(step.target.pose.position, [position[0]! / 1000, position[1]! / 1000, position[2]! / 1000]),
      ).toBeLessThan(PROOF_TOLERANCE.position_m);
      const near: Step = {
        id: "a",
        type: "move",
        path: "lin",
        target: { pose: { position: [0.3, 0, 0.3], quaternion: wanted }, frame: "world", tool: "flange" },
        speed: { mps: 0.1 },
        blend_m: 0,
      };
      const emitted = rapid.emit({ ...emptyProgram(robot.id), steps: [near] }, robot);
      if (emitted.kind === "cannot") continue;
      const written = /robtarget p10:=\[\[[^\]]*\],\[([^\]]*)\]/
        .exec(emitted.files[0]!.text)![1]!
        .split(",")
        .map(Number);
      // A quaternion and its negative are one orientation.
      const sign = Math.sign(written.reduce((sum, v, i) => sum + v * abb_q1234[i]!, 0));
      for (const [i, v] of written.entries())
        expect(Math.abs(sign * v - abb_q1234[i]!), `${written}`).toBeLessThan(3e-7);
    }
  });
});

describe("L-57 what is written", () => {
  const program: Program = {
    ...emptyProgram(robot.id, "Edge trace"),
    tools: { "Torch 45°": pose([0, 0, 0.14]) },
    frames: { carton: pose([0.4, 0.1, 0.2], [0, 0, Math.SQRT1_2, Math.SQRT1_2]) },
    signals: { lamp: { kind: "digital-out" } },
    steps: [
      {
        id: "home",
        name: "Home",
        type: "move",
        path: "ptp",
        target: { q: [0, 0, 0, 0, Math.PI / 2, 0] },
        speed: { mps: 1 },
        blend_m: 0,
      },
      {
        id: "on",
        type: "move",
        path: "lin",
        target: { pose: pose([0, 0, 0.1], [0, 1, 0, 0]), frame: "carton", tool: "Torch 45°" },
        speed: { mps: 0.25 },
        blend_m: 0.01,
      },
      {
        id: "in",
        type: "move",
        path: "lin",
        target: { pose: pose([0, 0, 0.05], [0, 1, 0, 0]), frame: "carton", tool: "Torch 45°" },
        speed: { time_s: 2.5 },
        blend_m: 0.007,
      },
      { id: "w", type: "wait", s: 0.5 },
      { id: "g", type: "gripper", closed: true },
      { id: "l", type: "set", signal: "lamp", to: true },
    ],
  };
  const text = (of: Program): string => {
    const emitted = rapid.emit(of, robot);
    if (emitted.kind === "cannot") throw new Error(emitted.sentence);
    return emitted.files[0]!.text;
  };

  test("as a person would write it, with the list that loads it", () => {
    const emitted = rapid.emit(program, robot);
    if (emitted.kind === "cannot") throw new Error(emitted.sentence);
    expect(emitted.files.map(file => file.name)).toEqual(["Edge_trace.mod", "Edge_trace.pgf"]);
    expect(emitted.files[1]!.text).toContain("<Module>Edge_trace.mod</Module>");
    expect(
      text(program)
        .split("\r\n")
        .map(line => line.trim()),
    ).toEqual([
      "MODULE Edge_trace",
      "!* Edge trace",
      "!* ABB IRB 120-3/0.6. Lengths in mm, angles in degrees.",
      `CONST jointtarget Home:=[[0,0,0,0,90,0],${AXES}];`,
      "CONST speeddata v250:=[250,500,5000,1000];",
      "PERS tooldata Torch_45:=[TRUE,[[0,0,140],[1,0,0,0]],[0.001,[0,0,0.001],[1,0,0,0],0,0,0]];",
      'PERS wobjdata carton:=[FALSE,TRUE,"",[[400,100,200],[0.7071068,0,0,0.7071068]],[[0,0,0],[1,0,0,0]]];',
      expect.stringMatching(/^CONST robtarget p10:=\[\[0,0,100\],\[0,0,1,0\],\[0,-?\d,-?\d,\d\],/),
      expect.stringMatching(/^CONST robtarget p20:=\[\[0,0,50\],\[0,0,1,0\],/),
      "PROC main()",
      "ConfJ\\On;",
      "ConfL\\On;",
      "! Home",
      "AccSet 100,100;",
      "MoveAbsJ Home,v1000,fine,tool0;",
      "MoveL p10,v250,z10,Torch_45\\WObj:=carton;",
      "MoveL p20,v1000\\T:=2.5,fine,Torch_45\\WObj:=carton;",
      "WaitTime 0.5;",
      "SetDO doGripper,1;",
      "SetDO lamp,1;",
      "ENDPROC",
      "ENDMODULE",
      "",
    ]);
  });

  test("names are at most 32 characters, words of the language are passed by, and no two are one", () => {
    const long = {
      ...program,
      steps: [
        "A name that is far longer than any RAPID name may be",
        "a name that is far longer than any RAPID name may be",
        "for",
        "MoveL",
        "3rd",
      ].map(
        (name, i): Step => ({
          id: `p${i}`,
          name,
          type: "move",
          path: "ptp",
          target: { q: [0, 0, 0, 0, 1, i / 10] },
          speed: { mps: 1 },
          blend_m: 0,
        }),
      ),
    };
    const names = [...text(long).matchAll(/CONST jointtarget (\w+):=/g)].map(match => match[1]!);
    expect(names).toEqual([
      "A_name_that_is_far_longer_than_a",
      "a_name_that_is_far_longer_than_2",
      "for_2",
      "MoveL_2",
      "n_3rd",
    ]);
    expect(rapid.interpret(text(long), robot).kind).toBe("ready");
  });

  test.each<[what: string, step: Step, sentence: RegExp]>([
    ["a line whose name RAPID cannot hold", { id: "x", type: "set", signal: "Lamp 1", to: true }, /no name of RAPID/],
    ["a message that is too long", { id: "x", type: "message", text: "x".repeat(81) }, /81 characters; RAPID takes 80/],
    [
      "moments of deviation",
      { id: "x", type: "payload", mass_kg: 1, center_m: [0, 0, 0], inertia_kgm2: [1, 1, 1, 0.1, 0, 0] },
      /moments of deviation/,
    ],
    [
      "a target out of reach",
      {
        id: "x",
        type: "move",
        path: "lin",
        target: { pose: pose([3, 0, 0]), frame: "world", tool: "flange" },
        speed: { mps: 0.1 },
        blend_m: 0,
      },
      /cannot be reached/,
    ],
  ])("%s stops the export at its step: no file comes out", (_, step, sentence) => {
    expect(
      rapid.emit(
        {
          ...program,
          signals: { ...program.signals, "Lamp 1": { kind: "digital-out" } },
          steps: [...program.steps, step],
        },
        robot,
      ),
    ).toMatchObject({ kind: "cannot", step: "x", sentence: expect.stringMatching(sentence) });
  });
});

describe("faults have a place and say what is expected", () => {
  test.each<[line: string, atLine: number, column: number]>([
    ["MoveL 12,v100,fine,tool0;", 4, 7],
    ["MoveL [[1,2,3]],v100,fine,tool0;", 4, 7],
    ["MoveL;", 4, 1],
    ["  Frob 12;", 4, 3],
    ["x:=y+1;", 4, 4],
    ["x:=1/0;", 4, 5],
    ["GOTO a;", 4, 1],
    ["IF x THEN", 5, 1],
    ['WaitTime "a', 4, 10],
    ["TPWrite §;", 4, 9],
    ["MoveJ [[300,0,400],[0,2,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;", 4, 7],
    ["TriggL 1;", 4, 1],
  ])("%s", (line, atLine, column) => {
    const answer = rapid.interpret(body(line), robot);
    expect(answer.kind).toBe("not-understood");
    if (answer.kind !== "not-understood") return;
    expect([answer.faults[0]!.line, answer.faults[0]!.column], JSON.stringify(answer.faults)).toEqual([atLine, column]);
    expect(answer.faults[0]!.expected).not.toBe("");
    expect(answer.faults[0]!.sentence).toMatch(/\.$/);
  });

  test("a loop without a motion is reported, and all faults are told at once", () => {
    expect(rapid.interpret(moduleOf("VAR num x;", "WHILE TRUE DO", "x:=1;", "ENDWHILE"), robot)).toMatchObject({
      kind: "not-understood",
      faults: [{ sentence: expect.stringMatching(/runs on the spot for ever/) }],
    });
    const answer = rapid.interpret(body("x:=);", "WaitTime 1;", "y:=];"), robot);
    expect(answer.kind === "not-understood" && answer.faults.map(fault => fault.line)).toEqual([4, 6]);
  });

  test("a program of 100,000 lines is read in less than 2 s", () => {
    const lines = Array.from(
      { length: 100_000 },
      (_, i) => `  MoveAbsJ [[${i % 90},10,-20,30,40,50],${AXES}],v1000,z1,tool0;`,
    );
    const text = body(lines.join("\n"));
    const { parsed, least_s } = readInTime(rapid, text, robot);
    expect(least_s).toBeLessThan(2);
    expect(parsed.kind === "parsed" && parsed.program.steps.length).toBe(100_000);
  });
});
