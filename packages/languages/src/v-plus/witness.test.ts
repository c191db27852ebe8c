/**
 * Text written out by hand from the published sample lines and from the statements of V+, not by the emitter; and what
 * it means, worked out by hand from those statements, not by the interpreter.
 */
import {
  angleBetween,
  compose,
  degrees,
  emptyProgram,
  flangePose,
  pose,
  radians,
  robotById,
  rotate,
  type MoveStep,
  type Program,
  type Step,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { vPlus } from "../index.ts";

const robot = robotById("staubli_rx90l")!;
// biome-ignore format: table of numbers
const SAMPLE = [
  [67.2654, -62.22573, 7.642985, -164.0191, 82.99246, 71.44165],
  [67.2654, -56.76529, -3.899122, -163.7236, 77.17347, 69.71836],
];
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
  ...emptyProgram(robot.id, "Edge trace"),
  steps,
  ...more,
});

function emitted(
  of: Program,
  worldFromBase = pose<"world", "base">(),
): { runnable: string[]; list: string[]; lines: readonly string[] } {
  const answer = vPlus.emit(of, robot, worldFromBase);
  if (answer.kind === "cannot") throw new Error(answer.sentence);
  const [runnable, list] = answer.files;
  return {
    runnable: runnable!.text.split("\r\n").map(line => line.trim()),
    list: list!.text.split("\r\n"),
    lines: runnable!.lines,
  };
}
/** Steps that a text amounts to. */
function executed(text: string): Step[] {
  const answer = vPlus.interpret(text, robot);
  if (answer.kind === "not-understood") throw new Error(JSON.stringify(answer.faults));
  const steps: Step[] = [];
  const run = answer.run();
  for (let next = run.next(); next.done !== true; next = run.next())
    if (next.value.step !== undefined) steps.push(next.value.step);
  return steps;
}
const body = (...lines: string[]): string => [".PROGRAM a()", ...lines, ".END", ""].join("\r\n");
const moves = (...lines: string[]): MoveStep[] =>
  executed(body(...lines)).filter((step): step is MoveStep => step.type === "move");
const q_deg = (step: MoveStep): number[] =>
  "q" in step.target ? step.target.q.map(q => Math.round(degrees(q) * 1e4) / 1e4) : [];
const shoulderPose = (step: MoveStep): { mm: number[]; quaternion: number[] } => {
  if ("q" in step.target) throw new Error("joint angles");
  const {
    position: [x, y, z],
    quaternion,
  } = step.target.pose;
  return {
    mm: [x, y, z - 0.42].map(v => Math.round(v * 1e6) / 1e3 + 0),
    quaternion: quaternion.map(v => Math.round(v * 1e6) / 1e6 + 0),
  };
};

describe("N-54 N-55 N-56 the point list", () => {
  test("the published sample lines, byte for byte", () => {
    const { list } = emitted(program(SAMPLE.map((q, i) => move(`p${i}`, q))));
    expect(list).toEqual([
      "DO DECOMPOSE J_V[0]=#PPOINT(67.2654,-62.22573,7.642985,-164.0191,82.99246,71.44165)",
      "DO DECOMPOSE J_V[6]=#PPOINT(67.2654,-56.76529,-3.899122,-163.7236,77.17347,69.71836)",
      "",
    ]);
  });

  test("zeros, small and round numbers stay without exponent, sign of zero or trailing zeros", () => {
    const { list } = emitted(program([move("p", [0, -90, 90, -0, 1e-5, 120])]));
    expect(list[0]).toBe("DO DECOMPOSE J_V[0]=#PPOINT(0,-90,90,0,0.00001,120)");
  });

  test("E-08 it fills an array and moves nothing", () => {
    expect(executed("DO DECOMPOSE J_V[0]=#PPOINT(67.2654,-62.22573,7.642985,-164.0191,82.99246,71.44165)\r\n")).toEqual(
      [],
    );
  });

  test("E-21 blanks and en dashes of the printed page are read", () => {
    const printed =
      "DO DECOMPOSE J_V[0] = #PPOINT(67.2654, –62.22573, 7.642985, −164.0191, 82.99246, 71.44165)\nDO DECOMPOSE J_V[6]=#PPOINT (67.2654, –56.76529, –3.899122, –163.7236, 77.17347, 69.71836)";
    const parsed = vPlus.parse(printed, robot);
    expect(parsed.kind).toBe("parsed");
    if (parsed.kind !== "parsed") return;
    // biome-ignore format: table of numbers
    expect(parsed.program.steps.map(step => q_deg(step as MoveStep))).toEqual([
      [67.2654, -62.2257, 7.643, -164.0191, 82.9925, 71.4417], [67.2654, -56.7653, -3.8991, -163.7236, 77.1735, 69.7184],
    ]);
    expect(parsed.warnings).toHaveLength(1);
  });
});

test("G-03 the two sample lines are a vertical move of the wrist by -80.003 mm, turned by 0.025°, tool axis 45° from vertical", () => {
  const text =
    "DO DECOMPOSE J_V[0]=#PPOINT(67.2654,-62.22573,7.642985,-164.0191,82.99246,71.44165)\nDO DECOMPOSE J_V[6]=#PPOINT(67.2654,-56.76529,-3.899122,-163.7236,77.17347,69.71836)\n";
  const parsed = vPlus.parse(text, robot);
  expect(parsed.kind).toBe("parsed");
  if (parsed.kind !== "parsed") return;
  const flanges = parsed.program.steps.map(step => {
    if (step.type !== "move" || !("q" in step.target)) throw new Error("not a joint move");
    return flangePose(robot.arm, step.target.q);
  });
  // Wrist centre 85 mm behind the flange, counted from the shoulder 420 mm above the base.
  const wrists = flanges.map(flange =>
    compose(flange, pose<"flange", "wrist">([0, 0, -0.085])).position.map((v, i) => (v - (i === 2 ? 0.42 : 0)) * 1000),
  );
  const expected = [
    [-123.678, -295.16, 774.848],
    [-123.674, -295.152, 694.845],
  ];
  for (const [i, wrist] of wrists.entries())
    for (const [k, v] of wrist.entries()) expect(v).toBeCloseTo(expected[i]![k]!, 2);
  expect(wrists[1]![2]! - wrists[0]![2]!).toBeCloseTo(-80.003, 2);
  expect(Math.hypot(wrists[1]![0]! - wrists[0]![0]!, wrists[1]![1]! - wrists[0]![1]!)).toBeLessThan(0.01);
  expect(degrees(angleBetween(flanges[0]!.quaternion, flanges[1]!.quaternion))).toBeCloseTo(0.025, 3);
  expect(flanges.map(({ quaternion }) => 180 - degrees(Math.acos(rotate(quaternion, [0, 0, 1])[2])))).toEqual([
    expect.closeTo(45.02, 1),
    expect.closeTo(44.99, 1),
  ]);
});

describe("E-08 the runnable program", () => {
  const torch = pose<"flange", "tcp">([0, 0, 0.14]);
  const steps: Step[] = [
    move("home", [0, -90, 90, 0, 0, 0], { name: "Home" }),
    {
      id: "in",
      name: "Über dem Karton",
      type: "move",
      path: "ptp",
      target: {
        pose: pose([0.5, 0.1, 0.9], [1, 0, 0, 0]),
        frame: "world",
        tool: "Torch 45°",
        branch: { shoulder: "front", elbow: "up", wrist: "positive" },
      },
      speed: { ratio: 0.5 },
      blend_m: 0.01,
    },
    {
      id: "on",
      type: "move",
      path: "lin",
      target: {
        pose: pose([0, 0, 0], [1, 0, 0, 0]),
        frame: "carton",
        tool: "Torch 45°",
        branch: { shoulder: "front", elbow: "up", wrist: "positive" },
      },
      speed: { mps: 0.1 },
      blend_m: 0,
    },
    { id: "w", type: "wait", s: 0.5 },
    { id: "g", type: "gripper", closed: true },
    { id: "o", type: "gripper", closed: false },
    move("t", [0, -90, 90, 0, 0, 0], { speed: { time_s: 2.5 } }),
  ];
  const full = program(steps, { tools: { "Torch 45°": torch }, frames: { carton: pose([0.5, 0.1, 0.8]) } });

  test("as a person would write it, base 750 mm above the floor", () => {
    const { runnable, lines } = emitted(full, pose([0, 0, 0.75]));
    expect(runnable).toEqual([
      ".PROGRAM edge_trace() ;Edge trace",
      ";* Staubli RX90L. Lengths in mm, angles in degrees, the world at the shoulder.",
      "SET torch_45 = TRANS(0,0,140,0,0,0)",
      ";Home",
      "SPEED 50 ALWAYS",
      "MOVE #PPOINT(0,-90,90,0,0,0)",
      "BREAK",
      ";Uber dem Karton",
      "TOOL torch_45",
      "RIGHTY",
      "ABOVE",
      "NOFLIP",
      "MOVE TRANS(500,100,-270,180,180,0)",
      "SPEED 100 MMPS ALWAYS",
      "MOVES TRANS(500,100,-370,180,180,0)",
      "BREAK",
      "DELAY 0.5",
      "CLOSEI",
      "OPENI",
      "SPEED 100 ALWAYS",
      "DURATION 2.5",
      "MOVE #PPOINT(0,-90,90,0,0,0)",
      "BREAK",
      ".END",
      "",
    ]);
    expect(lines).toEqual([
      "",
      "",
      "",
      ...Array(4).fill("home"),
      ...Array(6).fill("in"),
      ...Array(3).fill("on"),
      "w",
      "g",
      "o",
      ...Array(4).fill("t"),
      "",
    ]);
  });

  test("a curve stops the export at its step, and no file comes out", () => {
    const curved = program([
      move("a", [0, -90, 90, 0, 0, 0]),
      move("b", [10, -90, 90, 0, 0, 0], { path: "spline", name: "Bow" }),
    ]);
    expect(vPlus.emit(curved, robot)).toMatchObject({
      kind: "cannot",
      step: "b",
      sentence: expect.stringMatching(/^Step Bow is a spline move\. /),
    });
  });

  test("a point out of reach or outside the limits stops the export with the joint and the number", () => {
    expect(vPlus.emit(program([move("a", [170, -90, 90, 0, 0, 0])]), robot)).toEqual({
      kind: "cannot",
      step: "a",
      sentence: "Step a turns joint 1 to 170.00°; it may turn from -160.0° to 160.0°.",
      hint: "Move the point, or choose another branch for it.",
    });
    const far: Step = {
      id: "f",
      type: "move",
      path: "lin",
      target: { pose: pose([3, 0, 1]), frame: "world", tool: "flange" },
      speed: { mps: 0.1 },
      blend_m: 0,
    };
    expect(vPlus.emit(program([far]), robot)).toMatchObject({
      kind: "cannot",
      step: "f",
      sentence: expect.stringMatching(/^Step f cannot be reached\. The wrist would be .* mm from the shoulder/),
    });
  });
});

describe("executing V+", () => {
  test("locations: TRANS is Rz·Ry·Rz in mm and degrees from the shoulder; compounds multiply from left to right", () => {
    const [down, turned, compound, shift, inverse, omitted] = moves(
      "MOVE TRANS(500,0,-200,0,180,0)",
      "MOVES TRANS(500,0,-200,90,90,0)",
      "MOVES TRANS(500,0,0,90,0,0):TRANS(100,0,0,0,90,0)",
      "MOVES SHIFT(TRANS(500,0,0,90,0,0) BY 1,2,3)",
      "SET a = TRANS(100,200,300,90,0,0)",
      "MOVES INVERSE(a)",
      "MOVES TRANS(500,,10)",
    );
    expect(shoulderPose(down!)).toEqual({ mm: [500, 0, -200], quaternion: [0, 1, 0, 0] });
    // Rz(90)·Ry(90): z of the tool along y of the world.
    expect(
      rotate(
        (turned!.target as { pose: { quaternion: [number, number, number, number] } }).pose.quaternion,
        [0, 0, 1],
      ).map(v => Math.round(v * 1e9) + 0),
    ).toEqual([0, 1e9, 0]);
    expect(shoulderPose(compound!).mm).toEqual([500, 100, 0]);
    expect(shoulderPose(shift!).mm).toEqual([501, 2, 3]);
    expect(shoulderPose(inverse!).mm).toEqual([-200, 100, -300]);
    expect(shoulderPose(omitted!)).toEqual({ mm: [500, 0, 10], quaternion: [0, 0, 0, 1] });
  });

  test("APPRO stays back along the tool axis of the target, DEPART goes back from where the tool is", () => {
    const [appro, there, depart] = moves("SET a = TRANS(500,0,-200,0,180,0)", "APPRO a,50", "MOVES a", "DEPARTS 30");
    expect([shoulderPose(appro!).mm, shoulderPose(there!).mm, shoulderPose(depart!).mm]).toEqual([
      [500, 0, -150],
      [500, 0, -200],
      [500, 0, -170],
    ]);
    expect([appro!.path, depart!.path]).toEqual(["ptp", "lin"]);
  });

  test("DRIVE turns one joint by a difference, in degrees", () => {
    const [, driven] = moves("MOVE #PPOINT(10,-80,90,0,20,0)", "DRIVE 2,-5.5,40");
    expect(q_deg(driven!)).toEqual([10, -85.5, 90, 0, 20, 0]);
    expect(driven!.speed).toEqual({ ratio: 0.4 });
  });

  test("SPEED counts for one motion unless ALWAYS; MMPS is millimetres per second", () => {
    const speeds = moves(
      "SPEED 25 ALWAYS",
      "MOVE #PPOINT()",
      "SPEED 250 MMPS",
      "MOVES #PPOINT(10)",
      "MOVE #PPOINT(20)",
      "SPEED 10 IPS ALWAYS",
      "MOVE #PPOINT(0)",
      "DURATION 3",
      "MOVE #PPOINT(1)",
      "MOVE #PPOINT(2)",
    ).map(step => step.speed);
    expect(speeds).toEqual([
      { ratio: 0.25 },
      { mps: 0.25 },
      { ratio: 0.25 },
      { mps: 0.254 },
      { time_s: 3 },
      { mps: 0.254 },
    ]);
  });

  test("motions flow into each other unless BREAK, a delay, the hand or a new tool comes between", () => {
    const steps = executed(
      body(
        "SPEED 100 MMPS ALWAYS",
        "MOVES #PPOINT(1)",
        "x = 1",
        "MOVES #PPOINT(2)",
        "BREAK",
        "MOVES #PPOINT(3)",
        "CLOSEI",
        "MOVES #PPOINT(4)",
        "DELAY 0.25",
        "MOVES #PPOINT(5)",
        "TOOL TRANS(0,0,100)",
        "MOVES #PPOINT(6)",
        "CPOFF",
        "MOVES #PPOINT(7)",
        "MOVES #PPOINT(8)",
      ),
    );
    expect(steps.map(step => (step.type === "move" ? step.blend_m > 0 : step.type))).toEqual([
      true,
      false,
      false,
      "gripper",
      false,
      "wait",
      false,
      false,
      false,
      false,
    ]);
    expect(steps.filter(step => step.type !== "move")).toMatchObject([{ closed: true }, { s: 0.25 }]);
  });

  test("RIGHTY, ABOVE and NOFLIP name the posture until another is asked for", () => {
    const targets = moves(
      "RIGHTY",
      "ABOVE",
      "FLIP",
      "MOVE TRANS(500)",
      "MOVES TRANS(510)",
      "LEFTY",
      "MOVE TRANS(500)",
      "MOVE #PPOINT()",
      "MOVE TRANS(500)",
    ).map(step => ("pose" in step.target ? step.target.branch : "joints"));
    const flip = { shoulder: "front", elbow: "up", wrist: "negative" };
    expect(targets).toEqual([flip, flip, { ...flip, shoulder: "back" }, "joints", undefined]);
  });

  test("arrays, loops, branches, labels and calls", () => {
    const values = moves(
      "DECOMPOSE j[0] = #PPOINT(1,2,3,4,5,6)",
      "DECOMPOSE j[6] = #PPOINT(11,12,13,14,15,16)",
      "FOR i = 6 TO 0 STEP -6",
      "MOVE #PPOINT(j[i],j[i+1],j[i+2],j[i+3],j[i+4],j[i+5])",
      "END",
      "n = 0",
      "WHILE n < 2 DO",
      "n = n+1",
      "CASE n OF",
      "VALUE 1,7:",
      "MOVE #PPOINT(21)",
      "VALUE 2:",
      "MOVE #PPOINT(22)",
      "ANY",
      "MOVE #PPOINT(99)",
      "END",
      "END",
      "DO",
      "n = n-1",
      "IF n == 1 THEN",
      "MOVE #PPOINT(31)",
      "ELSE",
      "MOVE #PPOINT(32)",
      "END",
      "UNTIL n == 0",
      "GOTO 20",
      "MOVE #PPOINT(98)",
      "20 IF NOT (n <> 0 OR FALSE) GOTO 30",
      "MOVE #PPOINT(97)",
      "30 CALL sub(41)",
      "STOP",
      "MOVE #PPOINT(96)",
      ".END",
      ".PROGRAM sub(x)",
      "MOVE #PPOINT(x, MIN(3,2), INT(2.7), ABS(-4), SQRT(25), 7 MOD 4)",
      "RETURN",
      "MOVE #PPOINT(95)",
    ).map(q_deg);
    // biome-ignore format: table of numbers
    expect(values).toEqual([
      [11, 12, 13, 14, 15, 16], [1, 2, 3, 4, 5, 6], [21, 0, 0, 0, 0, 0], [22, 0, 0, 0, 0, 0], [31, 0, 0, 0, 0, 0], [32, 0, 0, 0, 0, 0], [41, 2, 2, 4, 5, 3],
    ]);
  });

  test("the point list and a loop over it, as the paper meant it", () => {
    const text =
      "DO DECOMPOSE J_V[0]=#PPOINT(1,2,3,4,5,6)\nDO DECOMPOSE J_V[6]=#PPOINT(7,8,9,10,11,12)\n.PROGRAM run()\nFOR i = 0 TO 6 STEP 6\nMOVE #PPOINT(j_v[i],j_v[i+1],j_v[i+2],j_v[i+3],j_v[i+4],j_v[i+5])\nEND\n.END\n";
    expect((executed(text) as MoveStep[]).map(q_deg)).toEqual([
      [1, 2, 3, 4, 5, 6],
      [7, 8, 9, 10, 11, 12],
    ]);
  });

  test("locations of a disk file, signals and the world shifted by BASE", () => {
    const steps = executed(
      ".LOCATIONS\npick 500 0 -200 0 180 0\n#safe 0 -90 90 0 0 0\n.END\n.PROGRAM a()\nMOVE #safe\nSIGNAL 5\nWAIT SIG(5, -6)\nBASE 100,0,0,0\nMOVES pick\n.END\n",
    ).filter(step => step.type === "move");
    expect(q_deg(steps[0]!)).toEqual([0, -90, 90, 0, 0, 0]);
    expect(shoulderPose(steps[1]!).mm).toEqual([600, 0, -200]);
  });

  test("a straight line is that of the tool in use", () => {
    const [, step] = moves(
      "MOVE #PPOINT()",
      "SET torch = TRANS(0,0,140,0,0,0)",
      "TOOL torch",
      "MOVES TRANS(500,0,-200,0,180,0)",
    );
    expect(step).toMatchObject({ path: "lin", target: { tool: "torch" } });
    const ready = vPlus.interpret(
      body("SET torch = TRANS(0,0,140,0,0,0)", "TOOL torch", "TOOL TRANS(0,0,50)", "TOOL NULL"),
      robot,
    );
    expect(ready).toMatchObject({
      kind: "ready",
      context: { tools: { torch: { position: [0, 0, 0.14] }, tool: { position: [0, 0, 0.05] } } },
    });
  });
});

describe("signals, messages and ends", () => {
  test("lines are called by the variables that hold their numbers, else by their numbers; inputs count from 1001", () => {
    const text = body(
      "lamp = 5",
      "SIGNAL lamp",
      "SIGNAL -7, 2001",
      "WAIT SIG(-1003)",
      "ACCEL 50, 50",
      "MOVE #PPOINT()",
      'TYPE "Tray full"',
      "HALT",
      "DELAY 9",
    );
    expect(executed(text).map(({ id: _, ...step }) => step)).toMatchObject([
      { type: "set", signal: "lamp", to: true },
      { type: "set", signal: "out_7", to: false },
      { type: "set", signal: "out_2001", to: true },
      { type: "wait-for", when: { signal: "in_1003", is: false } },
      { type: "move", acceleration: { ratio: 0.5 } },
      { type: "message", text: "Tray full" },
      { type: "stop" },
    ]);
    expect(vPlus.interpret(text, robot)).toMatchObject({
      context: {
        signals: { lamp: { kind: "digital-out", address: 5 }, in_1003: { kind: "digital-in", address: 1003 } },
      },
    });
  });

  test("a decision reads the line when it is come to, an output as it was written", () => {
    const interpreted = vPlus.interpret(
      body(
        "FOR i = 1 TO 2",
        "IF SIG(1001) THEN",
        "DELAY 1",
        "ELSE",
        "DELAY 2",
        "END",
        "END",
        "SIGNAL 3",
        "IF SIG(3) THEN",
        "DELAY 3",
        "END",
      ),
      robot,
    );
    if (interpreted.kind !== "ready") throw new Error(JSON.stringify(interpreted.faults));
    let reads = 0;
    const run = interpreted.run({
      read: () => ++reads > 1,
      write: () => {
        throw new Error("A text writes nothing by itself.");
      },
    });
    const seen: unknown[] = [];
    for (let next = run.next(); next.done !== true; next = run.next())
      if (next.value.step?.type === "wait") seen.push(next.value.step.s);
    expect(seen).toEqual([2, 1, 3]);
  });
});

describe("faults have a place and say what is expected", () => {
  test.each<[line: string, atLine: number, column: number, more?: string]>([
    ["MOVE #PPOINT(1,2", 2, 17],
    ["  FROB 12", 2, 3],
    ["MOVE", 2, 5],
    ["IF x = 1 THEN", 2, 6],
    ["OUT[5]=TRUE x", 2, 13],
    ["WAIT FOR IN[3]==TRUE", 2, 10],
    ["MOVE TRANS(1,2,3,4,5,6,7)", 2, 6],
    ["x = y + 1", 2, 5],
    ["x = 1/0", 2, 7],
    ["a_name_of_seventeen = 1", 2, 1],
    ["FOR i = 1 TO 3", 2, 1],
    ["GOTO 7", 2, 6],
    ["ELSEIF x == 2 THEN", 2, 1],
    ["CALL nobody()", 2, 1],
    ["WAIT SIG(1003, -5)", 2, 6],
    ["MOVE 5", 2, 6],
    ["SPEED 0", 2, 1],
    ["x = 5 §", 2, 7],
    ["MOVE TRANS(1)", 3, 1, "DRIVE 1,2,3"],
  ])("%s", (line: string, atLine: number, column: number, more?: string) => {
    const answer = vPlus.parse(body(line, ...(more === undefined ? [] : [more])), robot);
    expect(answer.kind).toBe("not-understood");
    if (answer.kind !== "not-understood") return;
    expect([answer.faults[0]!.line, answer.faults[0]!.column], JSON.stringify(answer.faults)).toEqual([atLine, column]);
    expect(answer.faults[0]!.expected).not.toBe("");
    expect(answer.faults[0]!.sentence).toMatch(/\.$/);
  });

  test("a loop without a motion is reported, one with a motion goes on for ever", () => {
    const idle = vPlus.interpret(body("10 x = 1", "GOTO 10"), robot);
    expect(idle).toMatchObject({
      kind: "not-understood",
      faults: [{ sentence: expect.stringMatching(/runs on the spot for ever/) }],
    });
    const busy = vPlus.interpret(body("WHILE TRUE DO", "MOVE #PPOINT(1)", "MOVE #PPOINT(2)", "END"), robot);
    expect(busy.kind).toBe("ready");
    if (busy.kind !== "ready") return;
    const run = busy.run();
    const seen: number[] = [];
    while (seen.length < 50) {
      const next = run.next();
      if (next.done !== true && next.value.step !== undefined) seen.push(next.value.line);
    }
    expect(seen.slice(0, 4)).toEqual([3, 4, 3, 4]);
    expect(vPlus.parse(body("WHILE TRUE DO", "MOVE #PPOINT(1)", "MOVE #PPOINT(2)", "END"), robot).kind).toBe(
      "not-understood",
    );
  });

  test("all faults are told at once", () => {
    const answer = vPlus.interpret(body("FROB", "MOVE #PPOINT(1)", "KRAM"), robot);
    expect(answer.kind === "not-understood" && answer.faults.map(fault => fault.line)).toEqual([2, 4]);
  });
});
