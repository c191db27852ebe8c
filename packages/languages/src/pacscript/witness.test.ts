import { identity, pose, robotById, type Robot } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { randomProgram } from "../testing/programs.ts";
import { ALL_ON, near, testHundredPrograms, testLongText, witnessOf } from "../testing/witness.ts";
import { pacScript } from "./index.ts";

const robot: Robot = robotById("denso_vs060")!;
const half = Math.SQRT1_2;

const { run, faults } = witnessOf(pacScript, robot);

describe("a program written by hand from the fact sheet", () => {
  const text = [
    "#Define hand 1",
    "#Define doGripper 128",
    "#Define lamp 24",
    "Sub Main",
    "  Dim i As Integer",
    "  Dim pick As Position",
    "  TakeArm Keep = 0",
    "  Tool hand, P(0, 0, 80, 0, 0, 0)",
    "  Work 2, P(300, 100, 0, 0, 0, 90)",
    "  pick = P(300, 0, 200, 180, 0, 180, 5)",
    "  Speed 50",
    "  Move P, @0 J(0, 0, 90, 0, 90, 0)",
    "  ChangeTool hand",
    "  Approach P, pick, @P 50",
    "  Move L, @E pick, Speed = Mps(0.1)",
    "  Set IO[doGripper]",
    "  Delay 500",
    "  Set IO[lamp]",
    "  Reset IO[25]",
    "  Move L, @20 Dev(pick, P(0, 0, 50)), S = 20, Accel = 40, Decel = 40",
    "  For i = 1 To 2",
    "    Call Away(i * 10)",
    "  Next i",
    "  If IO[8] = Off Then",
    "    ChangeWork 2",
    "    Move C, P(0, 0, 10, 180, 0, 90), @P P(50, 0, 0, 180, 0, 90)",
    "  End If",
    "  Payload 500, V(0, 0, 50), V(10, 20, 30)",
    "  Halt",
    "End Sub",
    "Sub Away(ByVal up As Single)",
    "  Depart L, up",
    "End Sub",
    "",
  ].join("\r\n");

  test("means what the sheet says: figures, steps along the hand and along the base, works, lines, calls, arcs, loads", () => {
    const steps = run(text).map(({ line, step }) => ({ line, ...step! }));
    const [home, above, at] = steps;
    expect(steps.map(({ line, type }) => [line, type])).toEqual([
      [12, "move"],
      [14, "move"],
      [15, "move"],
      [16, "gripper"],
      [17, "wait"],
      [18, "set"],
      [19, "set"],
      [20, "move"],
      [32, "move"],
      [32, "move"],
      [26, "move"],
      [28, "payload"],
      [29, "stop"],
    ]);
    expect(home).toMatchObject({
      path: "ptp",
      target: { q: near([0, 0, Math.PI / 2, 0, Math.PI / 2, 0], 12) },
      speed: { ratio: 0.5 },
      blend_m: 0,
    });
    // RX = 180°, RZ = 180°: the hand points down, its x backwards. An approach ends behind the hand: higher.
    expect(above).toMatchObject({
      path: "ptp",
      target: {
        pose: { position: near([0.3, 0, 0.25]) },
        tool: "hand",
        branch: { shoulder: "front", elbow: "up", wrist: "positive" },
      },
      blend_ratio: 1,
    });
    const turned = (at as unknown as { target: { pose: { quaternion: number[] } } }).target.pose.quaternion;
    expect(turned.map(Math.abs)).toEqual(near([0, 1, 0, 0]));
    expect(at).toMatchObject({
      path: "lin",
      target: { pose: { position: near([0.3, 0, 0.2]) } },
      speed: { mps: 0.1 },
      blend_m: 0,
    });
    expect(steps[4]).toMatchObject({ s: 0.5 });
    expect(steps.slice(5, 7)).toMatchObject([
      { signal: "lamp", to: true },
      { signal: "DO25", to: false },
    ]);
    expect(steps[7]).toMatchObject({
      target: { pose: { position: near([0.3, 0, 0.25]) } },
      speed: { ratio: 0.2 },
      acceleration: { ratio: 0.4 },
      blend_m: 0.02,
    });
    expect(steps.slice(8, 10)).toMatchObject([
      { target: { pose: { position: near([0.3, 0, 0.26]) } } },
      { target: { pose: { position: near([0.3, 0, 0.28]) } } },
    ]);
    expect(steps[10]).toMatchObject({
      path: "circ",
      via: { pose: { position: near([0, 0, 0.01]) }, frame: "work2" },
      target: { pose: { position: near([0.05, 0, 0]) }, frame: "work2" },
    });
    expect(steps[11]).toMatchObject({
      mass_kg: 0.5,
      center_m: near([0, 0, 0.05]),
      inertia_kgm2: near([0.001, 0.002, 0.003, 0, 0, 0]),
    });
    const { context } = pacScript.interpret(text, robot) as Extract<
      ReturnType<typeof pacScript.interpret>,
      { kind: "ready" }
    >;
    expect(context.frames).toMatchObject({
      work2: { position: near([0.3, 0.1, 0]), quaternion: near([0, 0, half, half]) },
    });
    expect(context.tools).toMatchObject({ hand: pose([0, 0, 0.08]) });
  });

  test("an input that is on takes the other way", () => {
    expect(run(text, ALL_ON).map(({ line }) => line)).not.toContain(26);
  });
});

test("an approach is the motion to DevH of the place, as the maker's manual rewrites it", () => {
  const [a] = run("Sub Main\nApproach P, P(300, 50, 250, 150, 20, 180), 30\nEnd Sub\n");
  const [b] = run("Sub Main\nMove P, DevH(P(300, 50, 250, 150, 20, 180), P(0, 0, -30))\nEnd Sub\n");
  expect(a!.step).toEqual({ ...b!.step! });
});

test("a figure names the posture: 5 is in front, above, not flipped, as programs of such arms have it", () => {
  const branch = (fig: number): unknown =>
    (
      run(`Sub Main\nMove P, P(503, 0, 595, 0, 90, 0, ${fig})\nEnd Sub\n`)[0]!.step as unknown as {
        target: { branch?: unknown };
      }
    ).target.branch;
  expect(branch(5)).toMatchObject({ shoulder: "front", elbow: "up", wrist: "positive" });
  expect(branch(1)).toMatchObject({ shoulder: "front", elbow: "up", wrist: "negative" });
  expect(branch(7)).toMatchObject({ shoulder: "front", elbow: "down", wrist: "positive" });
  expect(branch(-1)).toBeUndefined();
});

test("loops and choices of every sort are carried out", () => {
  const waits = (body: string): number => run(`Sub Main\n${body}\nEnd Sub\n`).length;
  expect(waits("i = 0\nDo While i < 3\nDelay 1\ni = i + 1\nLoop")).toBe(3);
  expect(waits("i = 0\nDo\nDelay 1\ni = i + 1\nLoop Until i = 2")).toBe(2);
  expect(waits("For i = 3 To 1 Step -1\nDelay i\nNext")).toBe(3);
  expect(
    waits("n = 2\nSelect Case n\nCase 1\nDelay 1\nCase 2, 3\nDelay 2\nDelay 2\nCase Else\nDelay 3\nEnd Select"),
  ).toBe(2);
  expect(waits("If 1 = 2 Then\nDelay 1\nElseIf 1 = 1 Then\nDelay 2\nDelay 2\nElse\nDelay 3\nEndIf")).toBe(2);
  expect(
    run("Sub Main\nP[3] = P(300, 0, 400, 180, 0, 180)\nMove L, @[5] P[3], Next\nIO[30] = On\nEnd Sub\n").map(
      ({ step }) => step,
    ),
  ).toMatchObject([{ blend_m: 0.005 }, { type: "set", signal: "DO30" }]);
});

test("statements that are no steps are told with their place", () => {
  expect(faults("Sub Main\n  GoTo *there\n  Fly P1\nEnd Sub\n")).toMatchObject([
    { line: 2, column: 3 },
    { line: 3, column: 3, sentence: '"Fly" is no statement of PacScript that is understood here.' },
  ]);
  expect(faults("Sub Main\nDo\ni = 1\nLoop\nEnd Sub\n")).toMatchObject([
    { sentence: expect.stringContaining("runs on the spot") as string },
  ]);
  expect(faults("Sub Main\nMove L, nowhere\nEnd Sub\n")).toMatchObject([
    { line: 2, column: 9, sentence: '"nowhere" has no value yet.' },
  ]);
  expect(faults("Sub Main\nFor i = 1 To 3\nDelay 1\nEnd Sub\n")).toMatchObject([{ line: 4 }]);
  expect(faults("Sub Main\nCall Lost\nEnd Sub\n")).toMatchObject([
    {
      line: 2,
      column: 6,
      sentence:
        "lost is called here and is in none of the files: give the file that holds it as well, or let the call do nothing.",
    },
  ]);
  expect(faults("Sub Main\nMove P, P(0, 2450, 300, 180, 0, 180, 5)\nEnd Sub\n")).toMatchObject([
    { line: 2, sentence: expect.stringContaining("cannot be reached") as string },
  ]);
  expect(faults("Sub Main\nWait IO[1] = On, 500\nEnd Sub\n")).toMatchObject([{ line: 2, column: 16 }]);
});

test("two words that close a block stand on one line: End and Sub on two are not the end of a sub", () => {
  expect(pacScript.parse("Sub Main\nEnd\nSub\n", robot)).toMatchObject({
    kind: "not-understood",
    faults: [{ line: 3, column: 1, expected: "a statement" }, { line: 4 }, { line: 2 }],
  });
});

testLongText(
  pacScript,
  robot,
  () =>
    `Sub Main\n${Array.from({ length: 50_000 }, (_, i) => `  Move L, @0 P(${i % 300}, 300, 300, 180, 0, 90, -1)\n  Delay 100\n`).join("")}End Sub\n`,
);
testHundredPrograms(pacScript, robot);

test("what does not fit into the controller is refused with the step", () => {
  const program = {
    ...randomProgram(robot, { seed: 3, steps: 3, worldFromBase: identity(), paths: ["lin"], cannot: ["duration"] }),
    name: "Cell",
  };
  const lines = (lamp: number, part: number): unknown =>
    pacScript.emit(
      {
        ...program,
        signals: { lamp: { kind: "digital-out", address: lamp }, part: { kind: "digital-in", address: part } },
        steps: [
          { id: "a", type: "set", signal: "lamp", to: true },
          { id: "b", type: "wait-for", when: { signal: "part", is: true } },
        ],
      },
      robot,
    );
  expect(lines(600, 1)).toMatchObject({
    kind: "cannot",
    step: "a",
    sentence: "Step a uses the line lamp with the number 600; PacScript counts lines from 0 to 511.",
  });
  expect(lines(24, 128)).toMatchObject({
    kind: "cannot",
    step: "b",
    sentence: "Step b uses the output 128, which is the gripper's.",
  });
  expect(lines(24, 24)).toMatchObject({
    kind: "cannot",
    step: "b",
    sentence: "Step b uses the line part with the number 24, which lamp has.",
  });
  expect(
    pacScript.emit({ ...program, steps: [{ id: "a", type: "payload", mass_kg: 1.0005, center_m: [0, 0, 0] }] }, robot),
  ).toMatchObject({
    kind: "cannot",
    step: "a",
    sentence: "Step a gives a mass of 1.0005 kg; Payload takes whole grams.",
  });
});
