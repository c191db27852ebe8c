import { identity, pose, robotById, type Robot } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { randomProgram } from "../testing/programs.ts";
import { ALL_ON, near, testHundredPrograms, testLongText, witnessOf } from "../testing/witness.ts";
import { melfaBasic } from "./index.ts";

const robot: Robot = robotById("mitsubishi_rv7fl")!;
const half = Math.SQRT1_2;

const { run, faults } = witnessOf(melfaBasic, robot);

describe("a program written by hand from the fact sheet", () => {
  const text = [
    "1 ' written by hand",
    "2 Servo On",
    "3 MLAMP=5",
    "4 Tool PHAND",
    "5 JOvrd 50",
    "6 Spd 100",
    "7 Mov JHOME",
    "8 Cnt 1, 10, 20",
    "9 Mov PPICK,-50",
    "10 Cnt 0",
    "11 Mvs PPICK",
    "12 HClose 1",
    "13 Dly 0.5",
    "14 M_Out(MLAMP)=1",
    "15 M_Out(6)=0 Dly 0.2",
    "16 PUP=PPICK",
    "17 PUP.Z=PPICK.Z+50",
    "18 Mvs PUP",
    "19 For M1=1 To 2",
    "20   GoSub *AWAY",
    "21 Next M1",
    "22 If M_In(9)=0 Then",
    "23   Mvr PUP,PTABLE*P1,PTABLE*P2",
    "24 EndIf",
    "25 Hlt",
    "26 End",
    "27 *AWAY",
    "28 Mvs P_Curr*(0,0,-10,0,0,0)",
    "29 Return",
    "JHOME=(0.00,0.00,90.00,0.00,90.00,0.00)",
    "PHAND=(+0.00,+0.00,+80.00,+0.00,+0.00,+0.00)(0,0)",
    "PPICK=(+450.00,+0.00,+200.00,+180.00,+0.00,+180.00,+0.00,+0.00)(7,0)",
    "PTABLE=(400,100,0,0,0,90)(7,0)",
    "P1=(0,0,10,180,0,90)(7,0)",
    "P2=(50,0,0,180,0,90)(7,0)",
    "",
  ].join("\r\n");

  test("means what the sheet says: flags, steps along the hand, components, lines, routines, arcs and their starts", () => {
    const steps = run(text).map(({ line, step }) => ({ line, ...step! }));
    const [home, above, at] = steps;
    expect(steps.map(({ line, type }) => [line, type])).toEqual([
      [7, "move"],
      [9, "move"],
      [11, "move"],
      [12, "gripper"],
      [13, "wait"],
      [14, "set"],
      [15, "set"],
      [18, "move"],
      [28, "move"],
      [28, "move"],
      [23, "move"],
      [23, "move"],
      [25, "stop"],
    ]);
    expect(home).toMatchObject({
      path: "ptp",
      target: { q: near([0, 0, Math.PI / 2, 0, Math.PI / 2, 0], 12) },
      speed: { ratio: 0.5 },
      blend_m: 0,
    });
    // A = 180°, C = 180°: the tool points down, its x backwards. -50 lies 50 mm behind the hand: higher.
    expect(above).toMatchObject({
      path: "ptp",
      target: {
        pose: { position: near([0.45, 0, 0.25]) },
        tool: "phand",
        branch: { shoulder: "front", elbow: "up", wrist: "positive" },
      },
      blend_m: 0.01,
    });
    const turned = (at as unknown as { target: { pose: { quaternion: number[] } } }).target.pose.quaternion;
    expect(turned.map(Math.abs)).toEqual(near([0, 1, 0, 0]));
    expect(at).toMatchObject({
      path: "lin",
      target: { pose: { position: near([0.45, 0, 0.2]) } },
      speed: { mps: 0.1 },
      blend_m: 0,
    });
    expect(steps[4]).toMatchObject({ s: 0.5 });
    expect(steps.slice(5, 7)).toMatchObject([
      { signal: "mlamp", to: true },
      { signal: "DO6", to: false, pulse_s: 0.2 },
    ]);
    expect(steps[7]).toMatchObject({ target: { pose: { position: near([0.45, 0, 0.25]) } } });
    expect(steps.slice(8, 10)).toMatchObject([
      { target: { pose: { position: near([0.45, 0, 0.26]) } } },
      { target: { pose: { position: near([0.45, 0, 0.27]) } } },
    ]);
    // The hand is not where the arc starts: it goes there first, straight.
    expect(steps[10]).toMatchObject({ path: "lin", target: { pose: { position: near([0.45, 0, 0.25]) } } });
    expect(steps[11]).toMatchObject({
      path: "circ",
      via: { pose: { position: near([0, 0, 0.01]) }, frame: "ptable" },
      target: { pose: { position: near([0.05, 0, 0]) }, frame: "ptable" },
    });
    const { context } = melfaBasic.interpret(text, robot) as Extract<
      ReturnType<typeof melfaBasic.interpret>,
      { kind: "ready" }
    >;
    expect(context.frames).toMatchObject({
      ptable: { position: near([0.4, 0.1, 0]), quaternion: near([0, 0, half, half]) },
    });
    expect(context.tools).toMatchObject({ phand: pose([0, 0, 0.08]) });
  });

  test("an input that is on takes the other way", () => {
    expect(run(text, ALL_ON).map(({ line }) => line)).not.toContain(23);
  });
});

test("a position behind * counts from the one before it, whose flags it has", () => {
  const text = "1 P100=P1*P2\n2 Mov P100\n3 End\nP1=(400,150,300,180,0,180)(6,0)\nP2=(10,5,0,0,0,0)(0,0)\n";
  const [moved] = run(text);
  const interpreted = melfaBasic.interpret(text, robot);
  expect(moved!.step).toMatchObject({
    target: { pose: { position: near([0.01, 0.005, 0]) }, frame: "p1", branch: { wrist: "negative" } },
  });
  expect(interpreted.kind === "ready" && interpreted.context.frames).toMatchObject({
    p1: { position: near([0.4, 0.15, 0.3]) },
  });
});

test("loops, choices and flags of every sort are read", () => {
  const waits = (body: string): number => run(`${body}\nEnd\n`).length;
  expect(waits("M1=0\nWhile M1<3\nDly 1\nM1=M1+1\nWEnd")).toBe(3);
  expect(waits("For M1=3 To 1 Step -1\nDly M1\nNext M1")).toBe(3);
  expect(waits("M1=2\nSelect M1\nCase 1\nDly 1\nBreak\nCase 2\nDly 2\nDly 2\nBreak\nDefault\nDly 3\nEnd Select")).toBe(
    2,
  );
  expect(waits("If M_In(1)=0 Then Dly 1 Else Dly 2")).toBe(1);
  expect(run("Mov P1\nEnd\nP1=(450,0,300,180,0,180,0,0)(7,&H00100000)\n")[0]!.step).toMatchObject({
    target: { branch: { shoulder: "front" } },
  });
  expect(run("Mov P1\nEnd\nP1=(450,0,300,180,0,180)(6,0)\n")[0]!.step).toMatchObject({
    target: { branch: { wrist: "negative" } },
  });
});

test("statements that are no steps are told with their place", () => {
  expect(faults("1 GoTo *THERE\n2 Fly P1\n3 End\n")).toMatchObject([
    { line: 1, column: 3 },
    { line: 2, column: 3, sentence: '"Fly" is no statement of MELFA-BASIC that is understood here.' },
  ]);
  expect(faults("While 1\nM1=1\nWEnd\nEnd\n")).toMatchObject([
    { sentence: expect.stringContaining("runs on the spot") as string },
  ]);
  expect(faults("Mvs PNOWHERE\nEnd\n")).toMatchObject([
    { line: 1, column: 5, sentence: '"pnowhere" has no value yet.' },
  ]);
  expect(faults("GoSub *LOST\nEnd\n")).toMatchObject([{ line: 1, column: 8 }]);
  expect(faults("Mov P1\nEnd\nP1=(0,0,2450,180,0,180)(7,0)\n")).toMatchObject([
    { line: 1, sentence: expect.stringContaining("cannot be reached") as string },
  ]);
});

testLongText(
  melfaBasic,
  robot,
  () =>
    `${Array.from({ length: 50_000 }, (_, i) => `${2 * i + 1} Mvs (${i % 300},400,300,180,0,180)\n${2 * i + 2} Dly 0.1\n`).join("")}End\n`,
);
testHundredPrograms(melfaBasic, robot);

test("what does not fit into the controller is refused with the step", () => {
  const program = {
    ...randomProgram(robot, { seed: 3, steps: 3, worldFromBase: identity(), paths: ["lin"], cannot: ["duration"] }),
    name: "Cell",
  };
  expect(
    melfaBasic.emit(
      {
        ...program,
        signals: { lamp: { kind: "digital-out", address: 40_000 } },
        steps: [{ id: "a", type: "set", signal: "lamp", to: true }],
      },
      robot,
    ),
  ).toMatchObject({
    kind: "cannot",
    step: "a",
    sentence: "Step a uses the line lamp with the number 40000; MELFA-BASIC counts lines from 0 to 32767.",
  });
  expect(
    melfaBasic.emit({ ...program, steps: [{ id: "a", type: "comment", text: "x".repeat(200) }] }, robot),
  ).toMatchObject({ kind: "cannot", step: "a", sentence: expect.stringContaining("a controller takes 127") as string });
  const many = Array.from({ length: 33_000 }, (_, i) => ({ id: `k${i}`, type: "wait", s: 1 }) as const);
  expect(melfaBasic.emit({ ...program, steps: many }, robot)).toMatchObject({
    kind: "cannot",
    sentence: expect.stringContaining("a controller numbers up to 32767") as string,
  });
});
