import {
  compose,
  emptyProgram,
  flangePose,
  pose,
  robotById,
  type MoveStep,
  type Program,
  type Robot,
} from "@twincell/core";
import { expect, test } from "vitest";
import { fanucLs, inform, proveText, runnableFile } from "./index.ts";
import { inParts } from "./emitter/index.ts";

/** Up and down over the home position, passed at every point but each fortieth. */
function long(robot: Robot, count: number): Program {
  const home = flangePose(robot.arm, robot.home_rad);
  const move = (i: number): MoveStep => ({
    id: `s${i}`,
    type: "move",
    path: i === 0 ? "ptp" : "lin",
    target: {
      pose: compose(compose(pose<"frame", "base">(), home), pose<"flange", "tcp">([0, 0, (i % 7) * 0.001])),
      frame: "world",
      tool: "flange",
    },
    speed: i === 0 ? { ratio: 0.5 } : { mps: 0.1 },
    blend_m: i % 40 === 39 ? 0 : 0.0002,
  });
  return { ...emptyProgram(robot.id, "Long way"), steps: Array.from({ length: count }, (_, i) => move(i)) };
}

test.each([
  ["INFORM", inform, "yaskawa_gp8", 10_050, 5],
  ["FANUC TP", fanucLs, "fanuc_lrmate200id", 10_050, 8],
] as const)(
  "%s: a program that is longer than the controller holds is written in parts that are called one after the other",
  (_, dialect, id, count, files) => {
    const robot = robotById(id)!;
    const program = long(robot, count);
    const emitted = dialect.emit(program, robot);
    if (emitted.kind === "cannot") throw new Error(emitted.sentence);
    expect(emitted.files.filter(({ name }) => /\.(?:JBI|LS)$/.test(name))).toHaveLength(files);
    expect(emitted.warnings.join(" ")).toContain("that are called one after the other");
    const proof = proveText(dialect, runnableFile(dialect, emitted.files)!, program, robot);
    expect(proof.kind, proof.sentence).toBe("proven");
  },
);

test("parts end where the robot stands, and a list that never stands stays whole", () => {
  const robot = robotById("ur10e")!;
  const program = long(robot, 100);
  const parts = inParts(program, 50);
  expect(Object.entries(parts.routines).map(([name, steps]) => [name, steps.length])).toEqual([
    ["Long way 1", 40],
    ["Long way 2", 40],
    ["Long way 3", 20],
  ]);
  expect(parts.steps).toMatchObject([
    { type: "call", routine: "Long way 1" },
    { type: "call", id: "s40" },
    { type: "call", id: "s80" },
  ]);
  expect(Object.values(inParts(program, 30).routines).map(steps => steps.length)).toEqual([40, 40, 20]);
  const never = {
    ...program,
    steps: program.steps.map(step => (step.type === "move" ? { ...step, blend_m: 0.001 } : step)),
  };
  expect(Object.values(inParts(never, 30).routines).map(steps => steps.length)).toEqual([100]);
});
