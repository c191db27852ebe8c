import { emptyProgram, identity, pose, robotById, type Robot } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { randomProgram } from "../testing/programs.ts";
import { ALL_ON, near, testHundredPrograms, testLongText, witnessOf } from "../testing/witness.ts";
import { on, rigid, sixNumbers } from "../parser/basic/index.ts";
import { spel } from "./index.ts";

const robot: Robot = robotById("epson_c4_a601s")!;
const half = Math.SQRT1_2;

const { run, faults } = witnessOf(spel, robot);

describe("a program written by hand from the fact sheet", () => {
  const text = [
    "#define hand 1",
    "#define Table 2",
    "#define lamp 3",
    "' written by hand",
    "Function main",
    "  Integer i",
    "  Motor On; Power High",
    "  TLSet hand, XY(0, 0, 80, 0, 0, 0)",
    "  Local Table, XY(100, 400, 0, 90, 0, 0)",
    "  P1 = XY(0, 450, 260, 90, 0, 180)",
    "  Speed 50; SpeedS 100",
    "  Go JA(0, 0, 0, 0, -90, 0)",
    "  Tool hand",
    "  Go P1 -TLZ(50) /R /A /NF CP",
    "  Move P1",
    "  On doGripper",
    "  Wait 0.5",
    "  On lamp; Off 4, 0.2",
    "  Move P1 +Z(50)",
    "  For i = 1 To 2",
    "    Call away(i * 10)",
    "  Next i",
    "  If Sw(1) = Off Then",
    "    Arc3 XY(0, 0, 10) /2, XY(50) /2 CP",
    "  EndIf",
    "  Quit All",
    "Fend",
    "Function away(up As Real)",
    "  TMove XY(0, 0, -up)",
    "Fend",
    "",
  ].join("\r\n");

  test("means what the sheet says: zeros, postures, tools, steps along the tool, locals, lines, calls, arcs", () => {
    const steps = run(text).map(({ line, step }) => ({ line, ...step! }));
    const [home, above, at] = steps;
    expect(steps.map(({ line, type }) => [line, type])).toEqual([
      [12, "move"],
      [14, "move"],
      [15, "move"],
      [16, "gripper"],
      [17, "wait"],
      [18, "set"],
      [18, "set"],
      [19, "move"],
      [29, "move"],
      [29, "move"],
      [24, "move"],
      [26, "stop"],
    ]);
    expect(home).toMatchObject({
      path: "ptp",
      target: { q: near([0, 0, 0, 0, -Math.PI / 2, 0], 12) },
      speed: { ratio: 0.5 },
      blend_m: 0,
    });
    // 50 mm against the tool's z, which points down: higher. The wrist in front, the elbow up, joint 5 below 0.
    expect(above).toMatchObject({
      path: "ptp",
      target: {
        pose: { position: near([0, 0.45, 0.31]) },
        tool: "hand",
        branch: { shoulder: "front", elbow: "up", wrist: "positive" },
      },
      blend_ratio: 1,
    });
    // U = 90°, V = 0°, W = 180°: x of the tool to y, z down.
    const turned = (at as unknown as { target: { pose: { quaternion: number[] } } }).target.pose.quaternion;
    expect(turned.map(Math.abs)).toEqual(near([half, half, 0, 0]));
    expect(at).toMatchObject({
      path: "lin",
      target: { pose: { position: near([0, 0.45, 0.26]) } },
      speed: { mps: 0.1 },
      blend_m: 0,
    });
    expect(at).not.toHaveProperty("blend_ratio");
    expect(steps[4]).toMatchObject({ s: 0.5 });
    expect(steps.slice(5, 7)).toMatchObject([
      { signal: "lamp", to: true },
      { signal: "DO4", to: false, pulse_s: 0.2 },
    ]);
    expect(steps[7]).toMatchObject({ target: { pose: { position: near([0, 0.45, 0.31]) } } });
    expect(steps.slice(8, 10)).toMatchObject([
      { target: { pose: { position: near([0, 0.45, 0.32]) } } },
      { target: { pose: { position: near([0, 0.45, 0.34]) } } },
    ]);
    expect(steps[10]).toMatchObject({
      path: "circ",
      via: { pose: { position: near([0, 0, 0.01]) }, frame: "table" },
      target: { pose: { position: near([0.05, 0, 0]) }, frame: "table" },
    });
    const { context } = spel.interpret(text, robot) as Extract<ReturnType<typeof spel.interpret>, { kind: "ready" }>;
    expect(context.frames).toMatchObject({
      table: { position: near([0.1, 0.4, 0]), quaternion: near([0, 0, half, half]) },
    });
    expect(context.tools).toMatchObject({ hand: pose([0, 0, 0.08]) });
  });

  test("an input that is on takes the other way", () => {
    expect(run(text, ALL_ON).map(({ line }) => line)).not.toContain(24);
  });
});

test("a point of the maker's own sample program is reached straight ahead, and all joints at 0 hold Tool 0 as the reference says", () => {
  const [down] = run("Function main\nGo XY(0, 450, 260, 90, 0, 180) /R /A /NF\nFend\n");
  expect(down!.step).toMatchObject({ target: { branch: { shoulder: "front", elbow: "up" } } });
  const [zero] = run("Function main\nMove JA(0, 0, 0, 0, 0, 0)\nP1 = Here\nMove P1\nFend\n").slice(1);
  // x of Tool 0 along the robot's z, y along its x, z along its y.
  expect(zero!.step).toMatchObject({
    target: { pose: { position: near([0, 0.415, 0.57]), quaternion: near([0.5, 0.5, 0.5, -0.5].map(x => -x)) } },
  });
});

test("U, V, W turn about z, the new y and the new x", () => {
  const about = [rigid([0, 0, 0, 0, 0, 30]), rigid([0, 0, 0, 0, 40, 0]), rigid([0, 0, 0, 50, 0, 0])] as const;
  const wanted = on(on(about[0], about[1]), about[2]);
  rigid([0, 0, 0, 50, 40, 30]).forEach((x, i) => {
    expect(x).toBeCloseTo(wanted[i]!, 14);
  });
  for (const six of [
    [1, 2, 3, 30, 40, 50],
    [0, 0, 0, 0, 90, 77],
    [0, 0, 0, 0, -90, -77],
    [4, 5, 6, 180, 0, 180],
  ] as const)
    sixNumbers(rigid(six)).forEach((x, i) => {
      expect(x).toBeCloseTo(six[i]!, 9);
    });
});

test("statements that are no steps are told with their place", () => {
  expect(faults("Function main\n  GoTo there\n  Fly P1\nFend\n")).toMatchObject([
    { line: 2, column: 3 },
    { line: 3, column: 3, sentence: '"Fly" is no statement of SPEL+ that is understood here.' },
  ]);
  expect(faults("Function main\nDo\ni = 1\nLoop\nFend\n")).toMatchObject([
    { sentence: expect.stringContaining("runs on the spot") as string },
  ]);
  expect(faults("Function main\nMove nowhere\nFend\n")).toMatchObject([
    { line: 2, column: 6, sentence: '"nowhere" has no value yet.' },
  ]);
  expect(faults("Function main\nFor i = 1 To 3\nWait 1\nFend\n")).toMatchObject([{ line: 4 }]);
  expect(faults("Function main\nCall lost\nFend\n")).toMatchObject([
    {
      line: 2,
      column: 6,
      sentence:
        "lost is called here and is in none of the files: give the file that holds it as well, or let the call do nothing.",
    },
  ]);
  expect(faults("Function main\nGo XY(0, 2450, 300, 90, 0, 180) /L\nFend\n")).toMatchObject([
    { line: 2, sentence: expect.stringContaining("cannot be reached") as string },
  ]);
  expect(faults("Function main\nWait Sw(1) = On, 5\nFend\n")).toMatchObject([{ line: 2, column: 16 }]);
});

test("loops and choices of every sort are carried out", () => {
  const waits = (body: string): number => run(`Function main\n${body}\nFend\n`).length;
  expect(waits("Do\nWait 1\ni = i0 + 1\nLoop Until True".replace("i0", "0"))).toBe(1);
  expect(waits("i = 0\nDo While i < 3\nWait 1\ni = i + 1\nLoop")).toBe(3);
  expect(waits("i = 0\nWhile i < 3\nWait 1\ni = i + 1\nWend")).toBe(3);
  expect(waits("For i = 3 To 1 Step -1\nWait i\nNext")).toBe(3);
  expect(waits("n = 2\nSelect n\nCase 1\nWait 1\nCase 2, 3\nWait 2\nWait 2\nDefault\nWait 3\nSend")).toBe(2);
  expect(waits("If 1 = 2 Then Wait 1 Else Wait 2")).toBe(1);
});

testLongText(
  spel,
  robot,
  () =>
    `Function main\n${Array.from({ length: 50_000 }, (_, i) => `  Move XY(${i % 300}, 400, 300, 90, 0, 180)\n  Wait 0.1\n`).join("")}Fend\n`,
);
testHundredPrograms(spel, robot);

test("what does not fit into the controller is refused with the step", () => {
  const program = {
    ...randomProgram(robot, { seed: 3, steps: 3, worldFromBase: identity(), paths: ["lin"], cannot: ["duration"] }),
    name: "Cell",
  };
  const line = (address: number): unknown =>
    spel.emit(
      {
        ...program,
        signals: { lamp: { kind: "digital-out", address } },
        steps: [{ id: "a", type: "set", signal: "lamp", to: true }],
      },
      robot,
    );
  expect(line(600)).toMatchObject({
    kind: "cannot",
    step: "a",
    sentence: "Step a uses the line lamp with the number 600; SPEL+ counts lines from 0 to 511.",
  });
  expect(line(15)).toMatchObject({
    kind: "cannot",
    step: "a",
    sentence: "Step a uses the output 15, which is the gripper's.",
  });
});

test("names that are words or points of the language get another", () => {
  const target = {
    pose: pose<"frame", "tcp">([0, 0.45, 0.26], [half, half, 0, 0]),
    frame: "P1",
    tool: "Line",
  } as const;
  const emitted = spel.emit(
    {
      ...emptyProgram(robot.id),
      tools: { Line: pose([0, 0, 0.01]) },
      frames: { P1: identity() },
      steps: [{ id: "a", type: "move", path: "lin", target, speed: { mps: 0.1 }, blend_m: 0 }],
    },
    robot,
  );
  expect(emitted.kind === "emitted" && emitted.files[0]!.text).toContain("#define line_2 1\r\n#define p1_2 1\r\n");
});
