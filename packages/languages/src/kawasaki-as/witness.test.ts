import { flangePose, identity, pose, robotById, type Executed, type Robot, type Signals } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { proveText } from "../prove.ts";
import { randomProgram } from "../testing/programs.ts";
import { about, sixOf, trans } from "./run/frame.ts";
import { kawasakiAs } from "./index.ts";
import { readInTime } from "../testing/reading-time.ts";
import { times } from "../parser/index.ts";

const robot: Robot = robotById("kawasaki_rs007l")!;

function run(text: string, signals?: Signals): Executed[] {
  const interpreted = kawasakiAs.interpret(text, robot);
  if (interpreted.kind === "not-understood") throw new Error(JSON.stringify(interpreted.faults));
  const done: Executed[] = [];
  for (let next = interpreted.run(signals), one = next.next(); one.done !== true; one = next.next())
    if (one.value.step !== undefined) done.push(one.value);
  return done;
}
const faults = (text: string): unknown => {
  const answer = kawasakiAs.interpret(text, robot);
  return answer.kind === "not-understood" ? answer.faults : "ready";
};
const half = Math.SQRT1_2;

describe("a program written by hand from the fact sheet", () => {
  const text = [
    ".PROGRAM main() ; written by hand",
    "  BASE NULL",
    "  TOOL hand",
    "  SPEED 50 ALWAYS",
    "  ACCURACY 5 ALWAYS",
    "  JMOVE #[0,0,-90,0,-90,0]",
    "  BREAK",
    "  LAPPRO pick,100",
    "  SPEED 100 MM/S",
    "  LMOVE pick",
    "  BREAK",
    "  CLOSEI",
    "  TWAIT 0.5",
    "  SIGNAL 3, -4",
    "  LMOVE SHIFT(pick BY ,,50)",
    "  FOR .i = 1 TO 2",
    "    CALL away(.i*10)",
    "  END",
    "  IF SIG(-1001) THEN",
    "    C1MOVE table+TRANS(0,0,10)",
    "    C2MOVE table+TRANS(50)",
    "  END",
    "  HALT",
    ".END",
    ".PROGRAM away(.up)",
    "  TDRAW 0, 0, -.up",
    ".END",
    ".TRANS",
    "hand 0 0 80 0 0 0",
    "pick 0.000 500.000 200.000 90.000 180.000 0.000",
    "table 100 400 0 0 0 90",
    ".END",
    "",
  ].join("\r\n");

  test("means what the sheet says: postures, approach, speeds, passing, lines, calls, arcs", () => {
    const steps = run(text).map(({ line, step }) => ({ line, ...step! }));
    expect(steps.map(({ line, type }) => [line, type])).toEqual([
      [6, "move"],
      [8, "move"],
      [10, "move"],
      [12, "gripper"],
      [13, "wait"],
      [14, "set"],
      [14, "set"],
      [15, "move"],
      [26, "move"],
      [26, "move"],
      [21, "move"],
      [23, "stop"],
    ]);
    expect(steps[0]).toMatchObject({
      path: "ptp",
      target: { q: [0, 0, expect.closeTo(-Math.PI / 2, 12), 0, expect.closeTo(-Math.PI / 2, 12), 0] },
      speed: { ratio: 0.5 },
      blend_m: 0,
    });
    // O = 90°, A = 180°: the tool points down, its x axis to -y … of Rz(90)·Ry(180).
    const down = [half, -half, 0, 0].map(Math.abs);
    expect(
      (steps[1] as unknown as { target: { pose: { quaternion: number[] } } }).target.pose.quaternion.map(Math.abs),
    ).toEqual(down.map(x => expect.closeTo(x, 9) as number));
    // Away from the place against the tool's z, which points down: 100 mm higher.
    expect(steps[1]).toMatchObject({
      path: "lin",
      target: { pose: { position: [expect.closeTo(0, 9), expect.closeTo(0.5, 9), expect.closeTo(0.3, 9)] } },
      speed: { ratio: 0.5 },
      blend_m: 0.005,
    });
    expect(steps[2]).toMatchObject({
      path: "lin",
      target: { pose: { position: [expect.closeTo(0, 9), expect.closeTo(0.5, 9), expect.closeTo(0.2, 9)] } },
      speed: { mps: 0.1 },
      blend_m: 0,
    });
    expect(steps.slice(3, 7)).toMatchObject([
      { closed: true },
      { s: 0.5 },
      { signal: "DO3", to: true },
      { signal: "DO4", to: false },
    ]);
    expect(steps[7]).toMatchObject({
      target: { pose: { position: [expect.closeTo(0, 9), expect.closeTo(0.5, 9), expect.closeTo(0.25, 9)] } },
      speed: { ratio: 0.5 },
    });
    expect(steps[8]).toMatchObject({
      target: { pose: { position: [expect.closeTo(0, 9), expect.closeTo(0.5, 9), expect.closeTo(0.26, 9)] } },
    });
    expect(steps[9]).toMatchObject({
      target: { pose: { position: [expect.closeTo(0, 9), expect.closeTo(0.5, 9), expect.closeTo(0.28, 9)] } },
    });
    expect(steps[10]).toMatchObject({
      path: "circ",
      via: { frame: "table", pose: { position: [0, 0, 0.01] } },
      target: { frame: "table", pose: { position: [0.05, 0, 0] } },
    });
    const context = kawasakiAs.interpret(text, robot);
    expect(context.kind === "ready" && context.context.frames).toMatchObject({
      table: { position: [0.1, 0.4, 0], quaternion: [0, 0, expect.closeTo(half, 12), expect.closeTo(half, 12)] },
    });
    expect(context.kind === "ready" && context.context.tools).toMatchObject({ hand: pose([0, 0, 0.08]) });
  });

  test("an input that is on takes the other way", () => {
    expect(
      run(text, {
        read: () => true,
        write: () => {
          /* nobody listens */
        },
      }).map(({ line }) => line),
    ).not.toContain(21);
  });
});

describe("numbers of real controllers", () => {
  const DEG = Math.PI / 180;
  const oat = (deg: readonly number[]): readonly number[] => {
    const {
      quaternion: [x, y, z, w],
    } = flangePose(
      robot.arm,
      deg.map(angle => angle * DEG),
    );
    return sixOf({
      r: [
        1 - 2 * (y * y + z * z),
        2 * (x * y - z * w),
        2 * (x * z + y * w),
        2 * (x * y + z * w),
        1 - 2 * (x * x + z * z),
        2 * (y * z - x * w),
        2 * (x * z - y * w),
        2 * (y * z + x * w),
        1 - 2 * (x * x + y * y),
      ],
      p: [0, 0, 0],
    }).slice(3);
  };

  test("the O, A, T that an arm shows beside its joint angles are those of these axes, within its calibration", () => {
    const shown = [-146.04, 142.521, 46.437];
    for (const [i, angle] of oat([-6.552, 23.595, -87.421, -147.271, 88.57, -167.663]).entries())
      expect(Math.abs(angle - shown[i]!)).toBeLessThan(0.25);
  });

  test("a taught posture that points straight down does so, and turns the tool nowhere", () => {
    const [, a] = oat([49.69, 3.4, -119.081, 0, -57.519, -49.69]);
    expect(a).toBeCloseTo(180, 3);
  });

  test("all joints at 0 stand straight up over the base with the tool as the base", () => {
    const flange = flangePose(robot.arm, [0, 0, 0, 0, 0, 0]);
    expect(flange.position.map(x => Math.round(x * 1e6) / 1e6)).toEqual([0, 0, 1.368]);
    expect(Math.abs(flange.quaternion[3])).toBeCloseTo(1, 12);
  });
});

test("O, A, T turn about z, the new y and the new z", () => {
  const wanted = times(times(about("z", 30), about("y", 40)), about("z", 50));
  trans([1, 2, 3, 30, 40, 50]).r.forEach((x, i) => {
    expect(x).toBeCloseTo(wanted.r[i]!, 14);
  });
  for (const six of [
    [1, 2, 3, 30, 40, 50],
    [0, 0, 0, -170, 90, 180],
    [0, 0, 0, 77, 0, 0],
    [0, 0, 0, 77, 180, 0],
  ] as const)
    sixOf(trans(six)).forEach((x, i) => {
      expect(x).toBeCloseTo(six[i]!, 9);
    });
});

test("words name the posture of the next joint motion, and a place that is not reached so is told", () => {
  const move = (words: string): string =>
    `.PROGRAM a()\n${words}\nJMOVE TRANS(100,450,300,90,180,0)\nJMOVE TRANS(100,450,310,90,180,0)\n.END\n`;
  expect(run(move("RIGHTY\nABOVE\nDWRIST")).map(({ step }) => step)).toMatchObject([
    { target: { branch: { shoulder: "front", elbow: "up", wrist: "positive" } } },
    { target: {} },
  ]);
  expect(run(move("RIGHTY\nABOVE\nDWRIST"))[1]!.step).not.toHaveProperty("target.branch");
  expect(run(move("UWRIST"))[0]!.step).toMatchObject({ target: { branch: { wrist: "negative" } } });
  expect(faults(".PROGRAM a()\nLEFTY\nJMOVE TRANS(0,2450,300,90,180,0)\n.END\n")).toMatchObject([
    { line: 3, sentence: expect.stringContaining("cannot be reached LEFTY") as string },
  ]);
});

test("what a file of a controller holds beside programs is passed over, and statements that are no steps are told with their place", () => {
  expect(
    run(
      ".NETCONF 1,2\n.END\n.SYSDATA\nSWITCH CP ON\nzöö €\n.END\n.PROGRAM a()@25/12/11 10:43 #0\n10 TWAIT 1\n.END\n.REALS\nx = 1\n.END\n",
    ),
  ).toHaveLength(1);
  expect(faults(".PROGRAM a()\n  GOTO 10\n  FLY p\n.END\n")).toMatchObject([
    { line: 3, column: 3, sentence: '"FLY" is no statement of AS that is understood here.' },
    { line: 2, column: 3, sentence: "There is no label 10 in this program." },
  ]);
  expect(faults(".PROGRAM a()\nWHILE TRUE DO\nx = 1\nEND\n.END\n")).toMatchObject([
    { sentence: expect.stringContaining("runs on the spot") as string },
  ]);
  const kept = kawasakiAs.parse(".PROGRAM a()\nLMOVE nowhere\n.END\n", robot);
  expect(kept).toMatchObject({
    faults: [{ line: 2, column: 7, sentence: '"nowhere" has no value yet.' }],
  });
  expect(faults(".PROGRAM a()\nFOR i = 1 TO 3\nTWAIT 1\n.END\n")).toMatchObject([{ line: 4 }]);
});

test("loops of every sort are carried out", () => {
  const waits = (body: string): number => run(`.PROGRAM a()\n${body}\n.END\n`).length;
  expect(waits("DO\nTWAIT 1\ni = i0+1\nUNTIL TRUE".replace("i0", "0"))).toBe(1);
  expect(waits("i = 0\nWHILE i < 3\nTWAIT 1\ni = i + 1\nEND")).toBe(3);
  expect(waits("FOR i = 3 TO 1 STEP -1\nTWAIT i\nEND")).toBe(3);
  expect(waits("n = 2\nCASE n OF\nVALUE 1:\nTWAIT 1\nVALUE 2,3:\nTWAIT 2\nTWAIT 2\nANY:\nTWAIT 3\nEND")).toBe(2);
});

test("100,000 lines are read in less than two seconds", () => {
  const lines = Array.from(
    { length: 50_000 },
    (_, i) => `  LMOVE TRANS(${i % 300},400,300,90,180,0)\n  TWAIT 0.1\n`,
  ).join("");
  const text = `.PROGRAM long()\n${lines}.END\n`;
  const { parsed, least_s } = readInTime(kawasakiAs, text, robot);
  expect(parsed.kind === "parsed" && parsed.program.steps.length).toBe(100_000);
  expect(least_s).toBeLessThan(2);
});

test("100 random programs are met by their texts", () => {
  for (let seed = 101; seed <= 200; seed++) {
    const program = randomProgram(robot, { seed, steps: 12, worldFromBase: identity(), paths: ["ptp", "lin", "circ"] });
    const emitted = kawasakiAs.emit(program, robot);
    if (emitted.kind === "cannot") throw new Error(emitted.sentence);
    const proof = proveText(kawasakiAs, emitted.files[0]!, program, robot);
    expect(proof.kind, `seed ${seed}: ${proof.sentence}`).toBe("proven");
  }
});

test("names fit into 15 characters and lines have the numbers of the controller", () => {
  const program = {
    ...randomProgram(robot, { seed: 3, steps: 3, worldFromBase: identity(), paths: ["lin"] }),
    name: "A very long name of a program 1234567890",
  };
  const emitted = kawasakiAs.emit(program, robot);
  expect(
    emitted.kind === "emitted" && /^\.PROGRAM (\S+)\(\)/.exec(emitted.files[0]!.text)?.[1]?.length,
  ).toBeLessThanOrEqual(15);
  const odd = kawasakiAs.emit(
    {
      ...program,
      signals: { lamp: { kind: "digital-out", address: 1001 } },
      steps: [{ id: "a", type: "set", signal: "lamp", to: true }],
    },
    robot,
  );
  expect(odd).toMatchObject({
    kind: "cannot",
    step: "a",
    sentence: "Step a uses the line lamp with the number 1001; AS counts outputs from 1 to 960.",
  });
});
