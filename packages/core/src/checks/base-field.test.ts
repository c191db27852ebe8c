import { describe, expect, test } from "vitest";
import { solveAll } from "../kinematics/inverse.ts";
import { emptyProgram, type MoveStep, type Program } from "../program/program.ts";
import { robotById } from "../robots/library/index.ts";
import { compose, identity, inverse, pose, type Pose } from "../spatial/pose.ts";
import { fromAxisAngle, type Quaternion } from "../spatial/quaternion.ts";
import { baseField, suggestBase, type BaseField } from "./base-field.ts";
import { checkProgram } from "./check.ts";
import { shiftedPose } from "./repair/repair-search.ts";

const robot = robotById("staubli_rx90l")!;
const DOWN: Quaternion = [1, 0, 0, 0];
const to = (id: string, path: MoveStep["path"], x: number, y: number, z: number): MoveStep => ({
  id,
  type: "move",
  path,
  target: { pose: { position: [x, y, z], quaternion: DOWN }, frame: "world", tool: "flange" },
  speed: path === "lin" ? { mps: 0.2 } : { ratio: 0.5 },
  blend_m: 0,
});
/** A line at 1.3 m: beyond the reach of the arm as it stands. */
const program: Program = {
  ...emptyProgram(robot.id),
  steps: [
    { ...to("home", "ptp", 0, 0, 0), target: { q: [...robot.home_rad] } },
    to("a", "ptp", 1.4, -0.3, 0.5),
    to("b", "lin", 1.4, 0.3, 0.5),
  ],
};
const stand: Pose<"world", "base"> = pose<"world", "base">([0.1, 0.05, 0], fromAxisAngle([0, 0, 1], 0.6));
const fields = [...baseField(program, robot, stand)];
const field: BaseField = fields.at(-1)!;

describe("from where a program could be carried out", () => {
  test("a coarse field comes first, then finer ones in which it is contained; points taught as angles do not count", () => {
    expect(fields.map(({ square_m, complete }) => [square_m, complete])).toEqual([
      [0.4, false],
      [0.2, false],
      [0.1, true],
    ]);
    expect(field.points).toBe(1 + 9);
    expect(field.squares).toHaveLength(25 * 25);
    for (const coarse of fields.slice(0, 2))
      for (const square of coarse.squares) expect(field.squares).toContain(square);
  });

  test("every square counts the points that the inverse kinematics reaches from there", () => {
    const points = [
      [1.4, -0.3, 0.5] as const,
      ...Array.from({ length: 9 }, (_, k) => [1.4, -0.3 + 0.075 * k, 0.5] as const),
    ];
    for (const square of field.squares) {
      const baseFromWorld = inverse(shiftedPose(stand, [square.x_m, square.y_m, 0]));
      const reached = points.filter(([x, y, z]) => {
        const worldFromFlange = pose<"world", "flange">([x, y, z], DOWN);
        return solveAll(robot, compose(baseFromWorld, worldFromFlange)).kind === "reached";
      }).length;
      expect([square.x_m, square.y_m, square.reached]).toEqual([square.x_m, square.y_m, reached]);
      expect(square.roomy).toBeLessThanOrEqual(square.reached);
    }
  });

  test("the suggested place is one from which the whole program is good; no checked place is faster", () => {
    expect(checkProgram(program, robot, { worldFromBase: stand }).verdict.ok).toBe(false);
    const best = suggestBase(field, program, robot, { worldFromBase: stand })!;
    const { verdict } = checkProgram(program, robot, { worldFromBase: shiftedPose(stand, [best.x_m, best.y_m, 0]) });
    expect(verdict.ok).toBe(true);
    expect(verdict.duration_s).toBeCloseTo(best.duration_s, 9);
    expect(best.reached).toBe(field.points);
  });

  test("a program of joint angles has no field and no suggestion", () => {
    const angles: Program = { ...program, steps: program.steps.slice(0, 1) };
    const last = [...baseField(angles, robot, identity())].at(-1)!;
    expect(last.points).toBe(0);
    expect(suggestBase(last, angles, robot, { worldFromBase: identity() })).toBeUndefined();
  });
});
