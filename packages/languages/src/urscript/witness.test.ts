/**
 * Text written out by hand from the statements of URScript, not by the emitter; and what it means, worked out by hand
 * from those statements, not by the interpreter.
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
  robotById,
  type MoveStep,
  type Pose,
  type Program,
  type Step,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { PROOF_TOLERANCE } from "../prove.ts";
import { urScript } from "./index.ts";
import { readInTime } from "../testing/reading-time.ts";

const robot = robotById("ur10e")!;
const body = (...lines: string[]): string => ["def a():", ...lines, "end", ""].join("\n");
function executed(text: string, signals = new SignalTable()): Step[] {
  const answer = urScript.interpret(text, robot);
  if (answer.kind === "not-understood") throw new Error(JSON.stringify(answer.faults));
  const steps: Step[] = [];
  const run = answer.run(signals);
  for (let next = run.next(); next.done !== true && steps.length < 1000; next = run.next())
    if (next.value.step !== undefined) steps.push(next.value.step);
  return steps;
}
const moves = (...lines: string[]): MoveStep[] =>
  executed(body(...lines)).filter((step): step is MoveStep => step.type === "move");
function placed(step: MoveStep): { m: number[]; quaternion: number[] } {
  if ("q" in step.target) throw new Error("joint angles");
  const { position, quaternion } = step.target.pose;
  return {
    m: position.map(v => Math.round(v * 1e9) / 1e9 + 0),
    quaternion: quaternion.map(v => Math.round(v * 1e9) / 1e9 + 0),
  };
}

describe("executing URScript", () => {
  test("the controller's base is the robot's turned by half a turn; metres; a rotation vector is axis times angle", () => {
    const [far, down] = moves("movel(p[0.5, 0.1, 0.3, 0, 0, 0])", "movel(p[0.5, 0.1, 0.3, 3.141592653589793, 0, 0])");
    expect(placed(far!)).toEqual({ m: [-0.5, -0.1, 0.3], quaternion: [0, 0, 1, 0] });
    // Rz(180°)·Rx(180°) = Ry(180°)
    expect(placed(down!).quaternion.map(Math.abs)).toEqual([0, 1, 0, 0]);
  });

  test("joint angles are radians in the robot's own order; v, t and r count for one move, and so do their defaults", () => {
    const steps = moves(
      "movej([0.1, -1, 1.2, -0.5, 0.4, 6])",
      "movej([0, -1, 1, 0, 0, 0], a=1, v=2.0943951023931953, r=0.02)",
      "movel(p[0.5, 0, 0.5, 0, 0, 0], 1.2, 0.4)",
      "movel(p[0.5, 0, 0.6, 0, 0, 0], t=2.5)",
      "movep(p[0.5, 0, 0.5, 0, 0, 0], 1.2, 0.3, 0.01)",
    );
    expect(steps[0]!.target).toEqual({ q: [0.1, -1, 1.2, -0.5, 0.4, 6] });
    expect(steps.map(step => step.speed)).toEqual([
      { ratio: expect.closeTo(1.05 / 2.0943951, 6) },
      { ratio: 1 },
      { mps: 0.4 },
      { time_s: 2.5 },
      { mps: 0.3 },
    ]);
    expect(steps.map(step => [step.path, step.blend_m])).toEqual([
      ["ptp", 0],
      ["ptp", 0.02],
      ["lin", 0],
      ["lin", 0],
      ["lin", 0.01],
    ]);
  });

  test("movec passes through a point", () => {
    const [, arc] = moves(
      "movel(p[0.5, 0, 0.5, 0, 0, 0])",
      "movec(p[0.6, 0.1, 0.5, 0, 0, 0], p[0.7, 0, 0.5, 0, 0, 0], a=1.2, v=0.25, r=0.05)",
    );
    expect(arc).toMatchObject({
      path: "circ",
      speed: { mps: 0.25 },
      blend_m: 0.05,
      via: { pose: { position: [expect.closeTo(-0.6), expect.closeTo(-0.1), 0.5] } },
    });
  });

  test("pose_trans multiplies, pose_add adds apart, pose_inv undoes; a named frame stays one", () => {
    const steps = moves(
      "box = p[0.4, 0, 0.2, 0, 0, 1.5707963267948966]",
      "movel(pose_trans(box, p[0.1, 0, 0, 0, 0, 0]))",
      "movel(pose_add(box, p[0.1, 0, 0, 0, 0, 0]))",
      "movel(pose_trans(pose_inv(box), box))",
      "q = p[0.1, 0.2, 0.3, 0, 0, 0]",
      "q[2] = q[2] + 0.05",
      "movel(q)",
    );
    expect(steps[0]!.target).toMatchObject({ frame: "box", pose: { position: [0.1, 0, 0] } });
    expect(placed(steps[1]!).m).toEqual([-0.5, 0, 0.2]);
    expect(placed(steps[2]!)).toEqual({ m: [0, 0, 0], quaternion: [0, 0, 1, 0] });
    expect(placed(steps[3]!).m).toEqual([-0.1, -0.2, 0.35]);
    const answer = urScript.interpret(
      body("box = p[0.4, 0, 0.2, 0, 0, 0]", "movel(pose_trans(box, p[0.1, 0, 0, 0, 0, 0]))"),
      robot,
      pose([1, 0, 0]),
    );
    expect(answer).toMatchObject({
      kind: "ready",
      context: { frames: { box: { position: [0.6, expect.closeTo(0), 0.2] } } },
    });
  });

  test("set_tcp is the tool of what follows, under the name of its variable", () => {
    const steps = moves(
      "torch = p[0, 0, 0.14, 0, 0, 0]",
      "set_tcp(torch)",
      "movel(p[0.5, 0, 0.5, 0, 0, 0])",
      "set_tcp(p[0,0,0,0,0,0])",
      "movel(p[0.5, 0, 0.5, 0, 0, 0])",
    );
    expect(steps.map(step => step.target.tool)).toEqual(["torch", "flange"]);
  });

  test("get_forward_kin is where the joints put the tool; get_inverse_kin asks for the posture nearest to qnear", () => {
    const q = [0.1, -1.2, 1.4, -1.6, -1.5, 0.3];
    const [there, , solved] = moves(
      `p1 = get_forward_kin([${q.join(",")}])`,
      "movel(p1)",
      `movej([${q.join(",")}])`,
      `movej(get_inverse_kin(p1, [${q.join(",")}]))`,
    );
    const wanted = flangePose(robot.arm, q);
    if ("q" in there!.target || "q" in solved!.target) throw new Error("joint angles");
    for (const target of [there!.target, solved!.target]) {
      expect(distance(target.pose.position, wanted.position)).toBeLessThan(1e-9);
      expect(angleBetween(target.pose.quaternion, wanted.quaternion)).toBeLessThan(1e-7);
    }
  });

  test("loops, decisions, functions, lists, text and lines", () => {
    const text = body(
      "def lift(h, v=0.1):",
      "  if h > 0.25 and not (h > 0.3 or False):",
      "    movel(p[0.5, 0, h, 0, 0, 0], v=v)",
      "  elif h == 0.1:",
      '    textmsg("low ", h)',
      "  else:",
      "    sleep(h)",
      "  end",
      "  return h * 2",
      "end",
      "heights = [0.1, 0.2, 0.3]",
      "i = 0",
      "while True:",
      "  if i >= 3:",
      "    break",
      "  end",
      "  twice = lift(heights[i], v=0.05 + i % 2)",
      "  i = i + 1",
      "end",
      "sleep(twice)",
      "set_standard_digital_out(2, True)",
      "set_tool_digital_out(0, True)",
      "set_configurable_digital_out(1, False)",
      "set_payload(1.5, [0, 0, 0.05])",
      "while (get_standard_digital_in(3) == False):",
      "  sync()",
      "end",
      "halt",
      "sleep(99)",
    );
    expect(executed(text)).toMatchObject([
      { type: "message", text: "low 0.1" },
      { type: "wait", s: 0.2 },
      { type: "move", speed: { mps: 0.05 } },
      { type: "wait", s: 0.6 },
      { type: "set", signal: "DO2", to: true },
      { type: "gripper", closed: true },
      { type: "set", signal: "DO9", to: false },
      { type: "payload", mass_kg: 1.5, center_m: [0, 0, 0.05] },
      { type: "wait-for", when: { signal: "DI3", is: true } },
      { type: "stop" },
    ]);
  });

  test("a decision reads the line when it is reached", () => {
    const text = body(
      "global part = 1",
      "if get_standard_digital_in(part):",
      "  sleep(1)",
      "else:",
      "  sleep(2)",
      "end",
    );
    expect(executed(text)).toMatchObject([{ s: 2 }]);
    expect(executed(text, new SignalTable([["part", true]]))).toMatchObject([{ s: 1 }]);
  });

  test("what the pendant writes around a program is read: labels, comments, no indentation, CR LF", () => {
    expect(
      executed(
        'def unnamed():\r\n# begin: setup\r\n$ 1 "Robot Program"\r\n$ 2 "MoveJ"\r\nmovej([0,-1.57,1.57,0,0,0],\r\n   a=1.4, v=1.05)\r\n$ 3 \'x\' "breakAfter"\r\nend\r\n',
      ),
    ).toHaveLength(1);
    expect(executed("sleep(1)\nsleep(2)\n")).toHaveLength(2);
  });
});

describe("reading what others wrote", () => {
  const parsed = (...lines: string[]): { program: Program; warnings: number } => {
    const answer = urScript.parse(body(...lines), robot);
    if (answer.kind === "not-understood") throw new Error(JSON.stringify(answer.faults));
    return { program: answer.program, warnings: answer.warnings.length };
  };

  test("a loop stays a loop only when every round does the same", () => {
    expect(parsed("i = 0", "while i < 500:", "  sleep(1)", "  i = i + 1", "end").program.steps).toMatchObject([
      { type: "repeat", times: 500, steps: [{ type: "wait" }] },
    ]);
    // The first and the last round are alike, the one between is not.
    const odd = parsed(
      "i = 0",
      "while i < 3:",
      "  if i % 2 == 1:",
      "    sleep(2)",
      "  else:",
      "    sleep(1)",
      "  end",
      "  i = i + 1",
      "end",
    );
    expect([odd.program.steps.map(step => (step.type === "wait" ? step.s : 0)), odd.warnings]).toEqual([[1, 2, 1], 1]);
    const growing = parsed("x = 0.1", "i = 0", "while i < 3:", "  x = x + 0.1", "  sleep(x)", "  i = i + 1", "end");
    expect(growing.program.steps).toHaveLength(3);
  });

  test("comments name steps and groups, and routines stay routines", () => {
    const { program } = parsed(
      "def pick():",
      "  set_tool_digital_out(0, True)",
      "end",
      "#== Station 1",
      "# First",
      "sleep(1)",
      "pick()",
      "#==",
      "#- mind the hose",
      "pick()",
    );
    expect(program.steps).toMatchObject([
      { type: "wait", name: "First", group: "g1" },
      { type: "call", routine: "pick" },
      { type: "comment", text: "mind the hose" },
      { type: "call" },
    ]);
    expect(program.routines).toMatchObject({ pick: [{ type: "gripper", closed: true }] });
    expect(program.groups).toEqual({ g1: { name: "Station 1" } });
  });
});

describe("golden poses", () => {
  const orientations = JSON.parse(
    readFileSync(new URL("../../../../fixtures/conventions/orientations.json", import.meta.url), "utf8"),
  ) as {
    readonly cases: readonly {
      readonly matrix: readonly (readonly number[])[];
      readonly ur_rotvec_rad: readonly number[];
    }[];
  };
  /** The controller's base as the matrix diag(−1, −1, 1), worked out here and nowhere else. */
  const inBase = (rows: readonly (readonly number[])[]): number[] =>
    rows.slice(0, 3).flatMap((row, i) => row.slice(0, 3).map(v => (i < 2 ? -v : v)));

  test("47 orientations, 7 of them singular: p[…] means the matrix that scipy and robodk say, read and written", () => {
    expect(orientations.cases).toHaveLength(47);
    for (const { matrix, ur_rotvec_rad } of orientations.cases) {
      const wanted: Pose = {
        position: [-matrix[0]![3]! / 1000, -matrix[1]![3]! / 1000, matrix[2]![3]! / 1000],
        quaternion: fromMatrix(inBase(matrix)),
      };
      const [step] = moves(
        `movel(p[${[...matrix.slice(0, 3).map(row => row[3]! / 1000), ...ur_rotvec_rad].map(x => x.toFixed(12)).join(", ")}])`,
      );
      if (step === undefined || "q" in step.target) throw new Error("no pose");
      expect(angleBetween(step.target.pose.quaternion, wanted.quaternion)).toBeLessThan(PROOF_TOLERANCE.angle_rad);
      expect(distance(step.target.pose.position, wanted.position)).toBeLessThan(PROOF_TOLERANCE.position_m);
      // Written by a robot that is asked for a pose of any distance: only joint moves without a branch need no posture.
      const far: Step = {
        id: "a",
        type: "move",
        path: "lin",
        target: { pose: { position: [0.5, 0.2, 0.4], quaternion: wanted.quaternion }, frame: "world", tool: "flange" },
        speed: { mps: 0.1 },
        blend_m: 0,
      };
      const emitted = urScript.emit({ ...emptyProgram(robot.id), steps: [far] }, robot);
      if (emitted.kind === "cannot") continue;
      const vector = /movel\(p\[([^\]]*)\]/.exec(emitted.files[0]!.text)![1]!.split(",").map(Number).slice(3);
      const same = vector.every((v, i) => Math.abs(v - ur_rotvec_rad[i]!) < 2e-6);
      const length = Math.hypot(...ur_rotvec_rad);
      const around = vector.every((v, i) => Math.abs(v + (ur_rotvec_rad[i]! * (2 * Math.PI - length)) / length) < 2e-6);
      expect(same || around, `${vector} and ${ur_rotvec_rad}`).toBe(true);
    }
  });
});

describe("L-57 what is written", () => {
  const program: Program = {
    ...emptyProgram(robot.id, "Pick & place"),
    tools: { "Torch 45°": pose([0, 0, 0.14]) },
    frames: { carton: pose([-0.5, 0.1, 0.2], [0, 0, 1, 0]) },
    signals: { lamp: { kind: "digital-out", address: 9 } },
    steps: [
      {
        id: "home",
        name: "Home",
        type: "move",
        path: "ptp",
        target: { q: [0, -1.5, 1.5, 0, 0.5, 0] },
        speed: { ratio: 0.5 },
        blend_m: 0,
      },
      {
        id: "on",
        type: "move",
        path: "lin",
        target: { pose: pose([0, 0, 0.1], [1, 0, 0, 0]), frame: "carton", tool: "Torch 45°" },
        speed: { mps: 0.1 },
        blend_m: 0.01,
      },
      {
        id: "in",
        type: "move",
        path: "lin",
        target: { pose: pose([0, 0, 0], [1, 0, 0, 0]), frame: "carton", tool: "Torch 45°" },
        speed: { time_s: 2.5 },
        blend_m: 0.01,
      },
      { id: "w", type: "wait", s: 0.5 },
      { id: "g", type: "gripper", closed: true },
      { id: "l", type: "set", signal: "lamp", to: true },
    ],
  };

  test("as a person would write it", () => {
    const emitted = urScript.emit(program, robot);
    if (emitted.kind === "cannot") throw new Error(emitted.sentence);
    expect(emitted.files[0]!.name).toBe("Pick_place.script");
    expect(emitted.files[0]!.text.split("\n").map(line => line.trim())).toEqual([
      "def Pick_place():",
      "#* Pick & place",
      "#* Universal Robots UR10e. Lengths in m, angles in rad, poses in the base of the controller.",
      "global Torch_45 = p[0, 0, 0.14, 0, 0, 0]",
      "global carton = p[0.5, -0.1, 0.2, 0, 0, 0]",
      "global lamp = 1",
      "# Home",
      "movej([0, -1.5, 1.5, 0, 0.5, 0], v=1.047198)",
      "set_tcp(Torch_45)",
      "movel(pose_trans(carton, p[0, 0, 0.1, 3.141593, 0, 0]), v=0.1, r=0.01)",
      "movel(pose_trans(carton, p[0, 0, 0, 3.141593, 0, 0]), t=2.5)",
      "sleep(0.5)",
      "set_tool_digital_out(0, True)",
      "set_configurable_digital_out(lamp, True)",
      "end",
      "",
    ]);
    expect(emitted.warnings).toEqual(["The gripper is taken to close while output 0 at the tool is on."]);
  });

  test.each<[what: string, step: Partial<MoveStep> | Step, sentence: RegExp]>([
    [
      "an arc of given duration",
      {
        id: "x",
        type: "move",
        path: "circ",
        target: { q: [0, -1, 1, 0, 0, 0] },
        via: { q: [0.1, -1, 1, 0, 0, 0] },
        speed: { time_s: 2 },
        blend_m: 0,
      },
      /movec takes a speed/,
    ],
    ["a line without a number", { id: "x", type: "set", signal: "horn", to: true }, /number is not known/],
    ["a pulse", { id: "x", type: "set", signal: "lamp", to: true, pulse_s: 1 }, /second thread/],
    [
      "a joint out of its limits",
      { id: "x", type: "move", path: "ptp", target: { q: [7, -1, 1, 0, 0, 0] }, speed: { ratio: 1 }, blend_m: 0 },
      /turns joint 1 to 401\.07°/,
    ],
  ])("%s stops the export at its step: no file comes out", (_, step, sentence) => {
    expect(urScript.emit({ ...program, steps: [...program.steps, step as Step] }, robot)).toMatchObject({
      kind: "cannot",
      step: "x",
      sentence: expect.stringMatching(sentence),
    });
  });
});

describe("faults have a place and say what is expected", () => {
  test.each<[line: string, atLine: number, column: number]>([
    ["movej([0, 1", 3, 1],
    ["  frob 12", 2, 3],
    ["frob(12)", 2, 1],
    ["movel(p[1,2,3])", 2, 7],
    ["movel()", 2, 1],
    ["x = y + 1", 2, 5],
    ["x = 1 / 0", 2, 7],
    ["if x:", 4, 1],
    ["set_tcp(5)", 2, 1],
    ["sleep(-1)", 2, 1],
    ["movej([0,0,0], v=0)", 2, 1],
    ["x = [1, 2][5]", 2, 12],
    ["sec t():", 2, 1],
    ["servoj([0,0,0,0,0,0])", 2, 1],
    ["x = §", 2, 5],
    ["set_standard_digital_out(9, True)", 2, 26],
  ])("%s", (line, atLine, column) => {
    const answer = urScript.interpret(body(line), robot);
    expect(answer.kind).toBe("not-understood");
    if (answer.kind !== "not-understood") return;
    expect([answer.faults[0]!.line, answer.faults[0]!.column], JSON.stringify(answer.faults)).toEqual([atLine, column]);
    expect(answer.faults[0]!.expected).not.toBe("");
    expect(answer.faults[0]!.sentence).toMatch(/\.$/);
  });

  test("a loop without a motion is reported, and all faults are told at once", () => {
    expect(urScript.interpret(body("while True:", "  x = 1", "end"), robot)).toMatchObject({
      kind: "not-understood",
      faults: [{ sentence: expect.stringMatching(/runs on the spot for ever/) }],
    });
    const answer = urScript.interpret(body("x = )", "sleep(1)", "y = ]"), robot);
    expect(answer.kind === "not-understood" && answer.faults.map(fault => fault.line)).toEqual([2, 4]);
  });

  test("a program of 100,000 lines is read in less than 2 s", () => {
    const lines = Array.from(
      { length: 100_000 },
      (_, i) => `  movel(p[0.5, ${(i % 100) / 1000}, 0.4, 0, 3.141593, 0], a=1.2, v=0.25, r=0.001)`,
    );
    const text = body(lines.join("\n"));
    const { parsed, least_s } = readInTime(urScript, text, robot);
    expect(least_s).toBeLessThan(2);
    expect(parsed.kind === "parsed" && parsed.program.steps.length).toBe(100_000);
  });
});
