import { describe, expect, test } from "vitest";
import { branchOf } from "../kinematics/branch.ts";
import { flangePose } from "../kinematics/forward.ts";
import { LIBRARY, robotById } from "../robots/library/index.ts";
import { compose, identity, pose, posesAgree, type Pose } from "../spatial/pose.ts";
import { fromAxisAngle } from "../spatial/quaternion.ts";
import { emptyProgram, type MoveStep, type Program, type Target } from "./program.ts";
import { retargetProgram } from "./retarget.ts";
import { everyStep } from "./walk.ts";

const rx90l = robotById("staubli_rx90l")!;
const worldFromBase: Pose<"world", "base"> = { position: [0.2, -0.1, 0.75], quaternion: fromAxisAngle([0, 0, 1], 0.4) };
const flangeFromTcp: Pose<"flange", "tcp"> = pose([0.01, 0, 0.14], fromAxisAngle([0, 1, 0], 0.3));
const near = (by: number): number[] => rx90l.home_rad.map((q, j) => q + by * [0.3, 0.25, 0.2, 0.3, 0.9, 0.4][j]!);
const move = (id: string, target: Target, more: Partial<MoveStep> = {}): MoveStep => ({
  id,
  type: "move",
  path: "ptp",
  speed: { ratio: 0.5 },
  blend_m: 0,
  target,
  ...more,
});
const taught: Program = {
  ...emptyProgram(rx90l.id),
  tools: { torch: flangeFromTcp },
  frames: { table: pose([1.05, 0.1, 0.9]) },
  steps: [
    move("home", { q: [...rx90l.home_rad], tool: "torch" }),
    {
      id: "twice",
      type: "repeat",
      times: 2,
      steps: [
        move("a", { q: near(1), tool: "torch" }),
        move("b", { q: near(0.7) }, { path: "circ", via: { q: near(0.8) } }),
      ],
    },
    move("c", {
      pose: pose([0, 0, 0.2], fromAxisAngle([0, 1, 0], Math.PI)),
      frame: "table",
      tool: "torch",
      branch: branchOf(rx90l, near(1))!,
    }),
  ],
  routines: { park: [move("p", { q: near(0.5), tool: "torch" }), { id: "w", type: "wait", s: 1 }] },
};
const tip = (robot: typeof rx90l, target: Target): Pose<"world", "tcp"> => {
  const tool = target.tool === "torch" ? flangeFromTcp : identity<"flange", "tcp">();
  if ("q" in target) return compose(compose(worldFromBase, flangePose(robot.arm, target.q)), tool);
  return compose(target.frame === "world" ? identity<"world", "frame">() : taught.frames[target.frame]!, target.pose);
};
const moves = (program: Program): MoveStep[] => [...everyStep(program)].filter(step => step.type === "move");

describe("a program for another robot", () => {
  test.each(LIBRARY.filter(robot => robot !== rx90l).map(robot => [robot.id, robot] as const))(
    "home stays home, every other tip stays where it is: %s",
    (_, robot) => {
      const { program, points, unreached } = retargetProgram(taught, rx90l, robot, worldFromBase);
      expect(program.robot).toBe(robot.id);
      expect(points).toBe(6);
      const before = moves(taught);
      const after = moves(program);
      expect(after.map(step => step.id)).toEqual(before.map(step => step.id));
      expect(after[0]!.target).toEqual({ q: [...robot.home_rad], tool: "torch" });
      for (const [i, step] of after.entries()) {
        if (i === 0) continue;
        expect(posesAgree(tip(robot, step.target), tip(rx90l, before[i]!.target), 1e-8, 1e-8)).toBe(true);
        if (step.via) expect(posesAgree(tip(robot, step.via), tip(rx90l, before[i]!.via!), 1e-8, 1e-8)).toBe(true);
        // What is reached is joint angles inside the limits; what is not stays a pose and is named.
        if ("q" in step.target)
          for (const [j, { limits }] of robot.arm.joints.entries()) {
            expect(step.target.q[j]).toBeGreaterThanOrEqual(limits.lower_rad - 1e-9);
            expect(step.target.q[j]).toBeLessThanOrEqual(limits.upper_rad + 1e-9);
          }
        else {
          expect(step.target.branch).toBeUndefined();
          if (before[i]!.id !== "c") expect(unreached).toContain(step.id);
        }
      }
    },
  );

  test("a larger arm of the same kind reaches all of it; a point out of reach stays a pose in the world and is named", () => {
    const rx160 = robotById("staubli_rx160")!;
    expect(retargetProgram(taught, rx90l, rx160, worldFromBase).unreached).toEqual([]);
    const far: Program = {
      ...emptyProgram(rx160.id),
      steps: [move("far", { q: [0, Math.PI / 4, Math.PI / 2, 0, 0.3, 0] })],
    };
    const { program, unreached } = retargetProgram(far, rx160, robotById("fanuc_lrmate200id")!, worldFromBase);
    expect(unreached).toEqual(["far"]);
    expect(moves(program)[0]!.target).toMatchObject({ frame: "world", tool: "flange" });
  });

  test("each point is solved next to the one before", () => {
    const line: Program = {
      ...emptyProgram(rx90l.id),
      steps: Array.from({ length: 40 }, (_, i) => move(`${i}`, { q: near(0.4 + i / 100) })),
    };
    const { program } = retargetProgram(line, rx90l, robotById("staubli_rx160")!, pose([0, 0, 0.75]));
    const angles = moves(program).flatMap(({ target }) => ("q" in target ? [target.q] : []));
    expect(angles.length).toBeGreaterThan(10);
    for (let i = 1; i < angles.length; i++)
      for (let j = 0; j < 6; j++) expect(Math.abs(angles[i]![j]! - angles[i - 1]![j]!)).toBeLessThan(0.5);
  });

  test("the same robot changes nothing", () => {
    expect(retargetProgram(taught, rx90l, rx90l, worldFromBase).program).toBe(taught);
  });
});
