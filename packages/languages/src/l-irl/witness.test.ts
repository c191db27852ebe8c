/**
 * Lists written out by hand from docs/languages/l-irl.md, and what they mean, worked out by hand; neither is of the
 * emitter.
 */
import {
  LIBRARY,
  angleBetween,
  degrees,
  emptyProgram,
  pose,
  radians,
  robotById,
  type Pose,
  type Program,
  type Step,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { dialectsFor, loadPoses, poseList, proveText, savePoses } from "../index.ts";
import { readInTime } from "../testing/reading-time.ts";

const robot = robotById("staubli_rx90l")!;
const half = Math.SQRT1_2;
const steps = (text: string, worldFromBase?: Pose<"world", "base">): Step[] => {
  const answer = poseList.interpret(text, robot, worldFromBase);
  if (answer.kind === "not-understood") throw new Error(JSON.stringify(answer.faults));
  return Array.from({ [Symbol.iterator]: () => answer.run() }).flatMap(({ step }) => step ?? []);
};
const faults = (text: string): unknown[] => {
  const answer = poseList.parse(text, robot);
  return answer.kind === "parsed" ? [] : answer.faults.map(({ line, column, expected }) => [line, column, expected]);
};
const near = (found: Pose, position: readonly number[], quaternion: [number, number, number, number]): void => {
  expect(Math.hypot(...found.position.map((v, i) => v - position[i]!))).toBeLessThan(1e-9);
  expect(angleBetween(found.quaternion, quaternion)).toBeLessThan(1e-9);
};
const placeOf = (step: Step | undefined): Pose => {
  if (step?.type !== "move" || "q" in step.target) throw new Error("no pose");
  return step.target.pose;
};

describe("L-37 the parser", () => {
  const SAMPLE = [
    "POSES 1 MM DEG ZYX BASE",
    "{*by hand}",
    "robot staubli_rx90l",
    'PROGRAM "Two ""points"""',
    "TOOL torch 0 0 120 0 0 0",
    "FRAME carton 800 0 100 90 0 0",
    'GROUP g1 "Edge 1"',
    "POSE above, 800, 0, 500, 0, 180, 0",
    "{go}",
    "MOVE PTP JOINTS 0 -90 90 0 0 0 SPEED 20 %",
    'move lin at above tool torch speed 250 mmps acc 40 % blend 10 mm name "Above the carton" group g1',
    "MOVE CIRCLE VIA POSE 10 0 50 0 180 0 IN carton TO POSE 0 0 50 0 180 0 IN carton TOOL torch BRANCH FRONT UP NEGATIVE TIME 1.5",
    "GRIPPER CLOSE",
    "WAIT .5",
    "",
  ].join("\n");

  test("a sample by hand is read to the poses that were worked out by hand", () => {
    const parsed = poseList.parse(SAMPLE, robot, pose([1, 0, 0], [0, 0, half, half]));
    if (parsed.kind === "not-understood") throw new Error(JSON.stringify(parsed.faults));
    const { program } = parsed;
    expect(program.name).toBe('Two "points"');
    expect(program.groups).toEqual({ g1: { name: "Edge 1" } });
    expect(program.tools.torch).toEqual(pose([0, 0, 0.12]));
    // The base is turned by a quarter about z and stands at x = 1: (0.8, 0, 0.1) → (1, 0.8, 0.1), and the frame turns
    // once more.
    near(program.frames.carton!, [1, 0.8, 0.1], [0, 0, 1, 0]);
    expect(program.steps.map(({ type }) => type)).toEqual(["comment", "move", "move", "move", "gripper", "wait"]);
    expect(program.steps[1]).toMatchObject({
      path: "ptp",
      target: { q: [0, radians(-90), radians(90), 0, 0, 0] },
      speed: { ratio: 0.2 },
      blend_m: 0,
    });
    expect(program.steps[2]).toMatchObject({
      path: "lin",
      name: "Above the carton",
      group: "g1",
      target: { frame: "world", tool: "torch" },
      speed: { mps: 0.25 },
      acceleration: { ratio: 0.4 },
      blend_m: 0.01,
    });
    // Half a turn about y behind a quarter about z: x goes to −y and y to −x.
    near(placeOf(program.steps[2]), [1, 0.8, 0.5], [-half, half, 0, 0]);
    expect(program.steps[3]).toMatchObject({
      path: "circ",
      via: { frame: "carton", tool: "flange" },
      target: { frame: "carton", tool: "torch", branch: { shoulder: "front", elbow: "up", wrist: "negative" } },
      speed: { time_s: 1.5 },
    });
    near(placeOf(program.steps[3]), [0, 0, 0.05], [0, 1, 0, 0]);
    expect(program.steps.slice(4)).toMatchObject([
      { type: "gripper", closed: true },
      { type: "wait", s: 0.5 },
    ]);
  });

  test.each([
    [
      "POSES 1 MM DEG ZYX WORLD\n1000 0 0 90 0 90\n",
      [half / Math.SQRT2, half / Math.SQRT2, half / Math.SQRT2, half / Math.SQRT2],
    ],
    ["POSES 1 MM DEG ZYZ WORLD\n1000 0 0 90 90 -90\n", [-half, 0, 0, half]],
    [
      "POSES 1 M RAD XYZ WORLD\n1; 0; 0; 1.5707963267948966; 0; 1.5707963267948966\n",
      [half / Math.SQRT2, -half / Math.SQRT2, half / Math.SQRT2, half / Math.SQRT2],
    ],
  ] as const)("the order of the turns is that of the first line: %s", (text, quaternion) => {
    const parsed = poseList.parse(text, robot);
    if (parsed.kind === "not-understood") throw new Error(JSON.stringify(parsed.faults));
    near(placeOf(parsed.program.steps[0]), [1, 0, 0], [...quaternion]);
  });

  test("L-36 a text file of an offline language is a trajectory: rows of numbers become steps, with a warning", () => {
    const text =
      "\uFEFFPOSES 1 MM DEG ZYX BASE\r\n800\t0\t500\t0\t180\t0\r\n800;100;500;0;180;0\r\n800, 100, 400, 0, 180, 0\r\n";
    const parsed = poseList.parse(text, robot);
    if (parsed.kind === "not-understood") throw new Error(JSON.stringify(parsed.faults));
    expect(
      parsed.program.steps.map(step =>
        step.type === "move" ? [step.name, step.path, placeOf(step).position.map(v => Math.round(v * 1e6) / 1e6)] : [],
      ),
    ).toEqual([
      ["P1", "ptp", [0.8, 0, 0.5]],
      ["P2", "lin", [0.8, 0.1, 0.5]],
      ["P3", "lin", [0.8, 0.1, 0.4]],
    ]);
    expect(parsed.warnings).toMatchObject([{ line: 2, expected: "MOVE" }]);
    // Executed as it stands, it moves nothing.
    expect(steps(text)).toEqual([]);
  });

  test("every fault has line, column and what was expected, and all are told at once", () => {
    const head = "POSES 1 MM DEG ZYX BASE\n";
    expect(faults("800 0 500 0 180 0\n")).toEqual([[1, 1, "POSES"]]);
    expect(faults("")).toEqual([[1, 1, "POSES 1 MM DEG ZYX BASE"]]);
    expect(faults("POSES 2 MM DEG ZYX BASE\n")).toEqual([[1, 7, "the version 1"]]);
    expect(
      faults(`${head}MOVE LIN POSE 1 2 3 4 5 SPEED 1 %\nWAIT -1\nMOVE PTP JOINTS 0 0 0 0 0 0\nSIGNAL 3\n`),
    ).toEqual([
      [2, 25, "number 6 of 6"],
      [3, 6, "a time in seconds, 0 or more"],
      [4, 28, "SPEED or TIME"],
      [5, 1, expect.stringContaining("MOVE, WAIT")],
    ]);
    expect(
      faults(
        `${head}MOVE LIN AT gone SPEED 1 %\nMOVE LIN POSE 0 0 0 0 0 0 IN gone SPEED 1 %\nMOVE PTP JOINTS 0 0 0 0 0 0 TOOL gone SPEED 101 %\nROBOT ur10e\n`,
      ),
    ).toEqual([
      [2, 13, "a POSE of the list"],
      [3, 30, "a FRAME of the list"],
      [4, 34, "a TOOL of the list"],
      [5, 1, "the robot staubli_rx90l"],
    ]);
    expect(
      faults(`${head}POSE a 0 0 0 0 0 0\nPOSE a 0 0 0 0 0 0\n{open\nMOVE PTP JOINTS 0 0 0 0 0 1e999 SPEED 5 %\n`),
    ).toEqual([
      [3, 6, "a name used once"],
      [4, 1, "a } at the end of the comment"],
      [5, 27, expect.stringContaining("joint value")],
    ]);
  });

  test("100,000 lines are read in less than 2 s", () => {
    const line =
      'MOVE LIN POSE 812.3456 -12.3456 500.1234 12.34567 178.12345 -3.45678 IN carton TOOL torch SPEED 250 MMPS BLEND 10 MM NAME "Point"\n';
    const text = `POSES 1 MM DEG ZYX BASE\nTOOL torch 0 0 120 0 0 0\nFRAME carton 800 0 100 90 0 0\n${line.repeat(100_000)}`;
    const { parsed, least_s } = readInTime(poseList, text, robot);
    expect(least_s).toBeLessThan(2);
    expect(parsed.kind === "parsed" && parsed.program.steps.length).toBe(100_000);
  });
});

describe("the writer", () => {
  const program = (...list: Step[]): Program => ({
    ...emptyProgram(robot.id, "Edge ä"),
    tools: { torch: pose([0, 0, 0.12]) },
    frames: { carton: pose([0.8, 0, 0.1], [0, 0, half, half]) },
    steps: list,
  });
  const lines = (of: Program): string[] => {
    const answer = poseList.emit(of, robot);
    if (answer.kind === "cannot") throw new Error(answer.sentence);
    expect(answer.files.map(({ name }) => name)).toEqual(["Edge_a.poses.txt"]);
    return answer.files[0]!.text.split("\r\n").filter(line => line !== "" && !line.startsWith("{*"));
  };

  test("a program of every sort of line, as it was written out by hand", () => {
    expect(
      lines(
        program(
          { id: "c", type: "comment", text: "go {on}" },
          {
            id: "1",
            type: "move",
            path: "ptp",
            target: { q: [0, -90, 90, 0, 0, 0].map(radians) },
            speed: { ratio: 0.2 },
            blend_m: 0,
          },
          {
            id: "2",
            type: "move",
            path: "lin",
            target: { pose: pose([0, 0, 0.05], [0, 1, 0, 0]), frame: "carton", tool: "torch" },
            speed: { mps: 0.05 },
            blend_m: 0.01,
            name: '"On"',
          },
          { id: "3", type: "wait", s: 0.5 },
          { id: "4", type: "gripper", closed: false },
        ),
      ),
    ).toEqual([
      "POSES 1 MM DEG ZYX BASE",
      'ROBOT "staubli_rx90l"',
      'PROGRAM "Edge a"',
      "TOOL torch 0 0 120 0 0 0",
      "FRAME carton 800 0 100 90 0 0",
      "{go {on)}",
      "MOVE PTP JOINTS 0 -90 90 0 0 0 SPEED 20 %",
      expect.stringMatching(
        /^MOVE LIN POSE 0 0 50 (?:0 180 0|180 0 180|-?180 -?0 -?180) IN carton TOOL torch SPEED 50 MMPS BLEND 10 MM NAME """On"""$/,
      ),
      "WAIT 0.5",
      "GRIPPER OPEN",
    ]);
  });

  test.each([
    { id: "x", type: "set", signal: "lamp", to: true },
    { id: "x", type: "repeat", times: 2, steps: [] },
    { id: "x", type: "call", routine: "r" },
    { id: "x", type: "stop" },
    { id: "x", type: "message", text: "Hello." },
    { id: "x", type: "payload", mass_kg: 1, center_m: [0, 0, 0] },
    { id: "x", type: "wait-for", when: { signal: "part", is: true } },
    {
      id: "x",
      type: "move",
      path: "lin",
      target: { pose: pose(), frame: "gone", tool: "torch" },
      speed: { mps: 0.1 },
      blend_m: 0,
    },
    {
      id: "x",
      type: "move",
      path: "circ",
      target: { pose: pose(), frame: "world", tool: "torch" },
      speed: { mps: 0.1 },
      blend_m: 0,
    },
    { id: "x", type: "move", path: "ptp", target: { q: [0, 0] }, speed: { ratio: 0.1 }, blend_m: 0 },
  ] satisfies Step[])("what has no line stops the export at its step: %o", step => {
    expect(poseList.emit(program({ id: "a", type: "wait", s: 1 }, step), robot)).toMatchObject({
      kind: "cannot",
      step: "x",
      sentence: expect.stringMatching(/\.$/),
    });
  });

  test("every robot of the library speaks it", () => {
    for (const each of LIBRARY) {
      expect(dialectsFor(each)).toContain(poseList);
      const home: Program = {
        ...emptyProgram(each.id),
        steps: [{ id: "1", type: "move", path: "ptp", target: { q: each.home_rad }, speed: { ratio: 1 }, blend_m: 0 }],
      };
      const answer = poseList.emit(home, each);
      expect(answer.kind === "emitted" && proveText(poseList, answer.files[0]!, home, each).kind, each.id).toBe(
        "proven",
      );
    }
  });
});

describe("saved poses as a text", () => {
  const poses = [
    { name: "above", worldFromTcp: pose<"world", "tcp">([0.8, -0.1234567, 0.5], [0.1, 0.7, 0.1, 0.7]) },
    { name: 'Größe "2" {a}, b', worldFromTcp: pose<"world", "tcp">([0, 0, 40], [0, half, 0, half]) },
    { name: "P 3", worldFromTcp: pose<"world", "tcp">([-1, 2, -3], [0, 0, 0, 1]) },
  ];

  test("L-46 L-47 LoadCoords and SaveCoords: a .txt keeps names and poses, also those that no robot reaches", () => {
    const text = savePoses(poses);
    const loaded = loadPoses(text);
    if (loaded.kind === "not-understood") throw new Error(JSON.stringify(loaded.faults));
    expect(loaded.poses.map(({ name }) => name)).toEqual(poses.map(({ name }) => name));
    for (const [i, { worldFromTcp }] of loaded.poses.entries()) {
      expect(Math.hypot(...worldFromTcp.position.map((v, k) => v - poses[i]!.worldFromTcp.position[k]!))).toBeLessThan(
        1e-7,
      );
      expect(degrees(angleBetween(worldFromTcp.quaternion, poses[i]!.worldFromTcp.quaternion))).toBeLessThan(2e-5);
    }
    expect(savePoses(loaded.poses)).toBe(text);
    expect(loadPoses(savePoses([]))).toEqual({ kind: "poses", poses: [] });
  });

  test("a list from the base is placed by where the robot stands", () => {
    const loaded = loadPoses("POSES 1 MM DEG ZYX BASE\nPOSE a 100 0 0 0 0 0\n", pose([1, 2, 3], [0, 0, half, half]));
    expect(loaded.kind).toBe("poses");
    if (loaded.kind === "poses") near(loaded.poses[0]!.worldFromTcp, [1, 2.1, 3], [0, 0, half, half]);
  });

  test("a text that is no list is refused with its place", () => {
    expect(loadPoses("POSE a 1 2 3\n")).toMatchObject({ kind: "not-understood", faults: [{ line: 1, column: 1 }] });
  });
});
