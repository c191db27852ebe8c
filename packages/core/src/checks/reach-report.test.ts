import { describe, expect, test } from "vitest";
import { flangePose } from "../kinematics/forward.ts";
import { solveAll } from "../kinematics/inverse.ts";
import { emptyProgram, type MoveStep, type Program } from "../program/program.ts";
import { robotById } from "../robots/library/index.ts";
import { compose, inverse, pose } from "../spatial/pose.ts";
import { fromAxisAngle, type Quaternion } from "../spatial/quaternion.ts";
import { reachReport, reachTable } from "./reach-report.ts";

const robot = robotById("staubli_rx90l")!;
const DOWN: Quaternion = [1, 0, 0, 0];
const to = (id: string, target: MoveStep["target"]): MoveStep => ({
  id,
  name: `Point, ${id}`,
  type: "move",
  path: "ptp",
  target,
  speed: { ratio: 0.5 },
  blend_m: 0,
});
const at = (x: number, y: number, z: number): MoveStep["target"] => ({
  pose: { position: [x, y, z], quaternion: DOWN },
  frame: "world",
  tool: "flange",
});
const stand = pose<"world", "base">([0.2, -0.1, 0.3], fromAxisAngle([0, 0, 1], 0.4));
const loop: MoveStep = to("looped", at(0.9, 0.2, 0.5));
const program: Program = {
  ...emptyProgram(robot.id),
  steps: [
    to("home", { q: [...robot.home_rad] }),
    to("beyond", { q: robot.home_rad.map((home, j) => (j === 4 ? 3 : home)) }),
    to("near", at(0.8, 0.1, 0.4)),
    to("far", at(2.6, 0, 0.4)),
    { id: "r", type: "repeat", times: 5, steps: [loop] },
  ],
};

describe("X-35 the reach report", () => {
  const report = reachReport(program, robot, stand);

  test("says of every taught point once whether it is reached, in how many postures, and with how much room", () => {
    expect(report.points.map(({ step, postures }) => [step, postures > 0])).toEqual([
      ["home", true],
      ["beyond", false],
      ["near", true],
      ["far", false],
      ["looped", true],
    ]);
    expect(report.reached).toBe(3);
    const near = report.points[2]!;
    const wanted = compose(inverse(stand), pose<"world", "flange">([0.8, 0.1, 0.4], DOWN));
    const reach = solveAll(robot, wanted);
    if (reach.kind !== "reached") throw new Error("The point is reached.");
    expect(near.postures).toBe(reach.solutions.length);
    const rooms = reach.solutions.map(({ q_rad }) =>
      Math.min(
        ...robot.arm.joints.map(({ limits }, j) =>
          Math.min(limits.upper_rad - q_rad[j]!, q_rad[j]! - limits.lower_rad),
        ),
      ),
    );
    expect(near.room!.value).toBeCloseTo(Math.max(...rooms), 12);
    expect(report.points[3]!.sentence).toMatch(/^The wrist would be \d+ mm from the shoulder/);
    expect(report.points[1]!.sentence).toBe("Joint 5 is taught beyond its limit.");
    const home = compose(stand, flangePose(robot.arm, robot.home_rad)).position;
    expect(report.points[0]!.position_m).toEqual([home[0], home[1], home[2]]);
  });

  test("is a table with one line a point, in mm and degrees, commas in names kept", () => {
    const lines = reachTable(report).trimEnd().split("\n");
    expect(lines).toHaveLength(1 + report.points.length);
    expect(lines[3]).toMatch(/^near,"Point, near",800\.0,100\.0,400\.0,yes,\d,\d,\d+\.\d,$/);
    expect(lines[4]).toMatch(/^far,"Point, far",2600\.0,0\.0,400\.0,no,0,,,"?The wrist/);
  });
});
