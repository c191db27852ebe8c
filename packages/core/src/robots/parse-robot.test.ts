import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import {
  checkProgram,
  distance,
  emptyProgram,
  flangePose,
  linkShapes,
  linkSolids,
  planProgram,
  parseRobot,
  robotById,
  seededRandom,
  solveAll,
  type Program,
  type Robot,
} from "../index.ts";

const example = (): Record<string, unknown> =>
  JSON.parse(readFileSync(new URL("../../../../examples/robots/small-arm.json", import.meta.url), "utf8")) as Record<
    string,
    unknown
  >;
function robotOf(value: unknown): Robot {
  const answer = parseRobot(value);
  if (answer.kind !== "robot") throw new Error(JSON.stringify(answer.faults));
  return answer.robot;
}
const turn = (q: number[], ratio: number, robot: Robot): Program => ({
  ...emptyProgram(robot.id),
  steps: [{ id: "turn", type: "move", path: "ptp", target: { q }, speed: { ratio }, blend_m: 0 }],
});

describe("T-16 M-60 a robot is added by data alone", () => {
  const robot = robotOf(example());

  test("one JSON file is enough to compute, solve, plan, check, draw and collide", () => {
    expect(robot).toMatchObject({
      id: "small_arm",
      name: "Small arm",
      payload_kg: 2,
      family: { kind: "ortho-parallel", a1_m: 0.02, c2_m: 0.25 },
    });
    const random = seededRandom(16);
    for (let n = 0; n < 50; n++) {
      const q = robot.arm.joints.map(
        ({ limits }) => limits.lower_rad + random() * (limits.upper_rad - limits.lower_rad),
      );
      const pose = flangePose(robot.arm, q);
      const reach = solveAll(robot, pose, { near: q });
      if (reach.kind !== "reached") throw new Error(reach.kind);
      expect(Math.max(...q.map((angle, j) => Math.abs(angle - reach.solutions[0]!.q_rad[j]!)))).toBeLessThan(1e-6);
    }
    const program = turn([0.5, 0.3, -0.2, 0.1, 0.4, 1], 0.5, robot);
    expect(planProgram(program, robot).plan.segments.length).toBe(1);
    expect(checkProgram(program, robot).verdict.ok).toBe(true);
    expect(linkShapes(robot).length).toBe(7);
    expect(linkSolids(robot).every(({ mesh }) => mesh.indices.length > 0)).toBe(true);
    expect(
      robot.assumptions.some(sentence => sentence.startsWith("Joint accelerations are not in the robot file")),
    ).toBe(true);
  });

  test("the file says the same arm as a library entry: the IRB 120 written out", () => {
    const known = robotById("abb_irb120")!;
    const file = {
      format: "twincell.robot",
      version: 1,
      id: "mine",
      joints: known.arm.joints.map(({ parentFromJoint, axis, limits }) => ({
        xyz_m: parentFromJoint.position,
        axis,
        lower_rad: limits.lower_rad,
        upper_rad: limits.upper_rad,
        speed_rad_s: limits.speed_rad_s,
      })),
      flange: { rpy_rad: [0, Math.PI / 2, 0] },
    };
    const mine = robotOf(JSON.parse(JSON.stringify(file)));
    for (const q of [
      [0.1, 0.2, 0.3, 0.4, 0.5, 0.6],
      [-2, 1, -1, 2, -2, 5],
    ])
      expect(distance(flangePose(mine.arm, q).position, flangePose(known.arm, q).position)).toBeLessThan(1e-15);
  });

  test("every fault is named with its place", () => {
    const faultsOf = (change: (file: Record<string, unknown>) => void): readonly string[] => {
      const file = example();
      change(file);
      const answer = parseRobot(file);
      return answer.kind === "robot" ? [] : answer.faults.map(({ path, sentence }) => `${path}: ${sentence}`);
    };
    const joint = (file: Record<string, unknown>, i: number): Record<string, unknown> =>
      (file.joints as Record<string, unknown>[])[i]!;
    expect(faultsOf(() => undefined)).toEqual([]);
    expect(
      faultsOf(file => {
        joint(file, 2).axis = [0, 0, 0];
      }),
    ).toEqual(["joints[2].axis: The axis of joint 3 has a direction; here it is 0, 0, 0."]);
    expect(
      faultsOf(file => {
        joint(file, 0).lower_rad = 4;
      })[0],
    ).toMatch(/^joints\[0\]: The lower limit of joint 1 is below its upper one; here they are 4 and /);
    expect(
      faultsOf(file => {
        joint(file, 1).speed_rad_s = -1;
      }),
    ).toEqual(["joints[1].speed_rad_s: The speed of joint 2 is above 0; here it is -1."]);
    expect(
      faultsOf(file => {
        joint(file, 1).upper_rad = null;
      })[0],
    ).toContain("joints[1].upper_rad: The upper_rad of joint 2 is a finite number [rad]; here it is null.");
    expect(
      faultsOf(file => {
        file.joints = [];
      })[0],
    ).toContain("a robot has 1 to 32 joints; here it has 0".slice(1));
    expect(
      faultsOf(file => {
        file.home_rad = [9, 0, 0, 0, 0, 0];
      })[0],
    ).toContain("home_rad[0]");
    expect(
      faultsOf(file => {
        file.colour = "red";
      })[0],
    ).toContain("has no field “colour”");
    expect(
      faultsOf(file => {
        file.version = 2;
      }),
    ).toEqual(["version: Robot files of version 1 are read; this one is of version 2."]);
    for (const wrong of [null, 3, "arm", [], { format: "twincell.program" }])
      expect(parseRobot(wrong).kind).toBe("not-a-robot");
  });
});

describe("T-15 a command beyond a joint's own limit is refused with joint, value and limit", () => {
  test.each(["yaskawa_gp8", "ur10e", "kuka_lbr_iiwa_14_r820", "lola_rl15_placeholder"])(
    "%s, every joint, both ends",
    id => {
      const robot = robotById(id)!;
      robot.arm.joints.forEach(({ limits }, j) => {
        for (const [limit, beyond] of [
          [limits.lower_rad, -0.01],
          [limits.upper_rad, 0.01],
        ] as const) {
          const q = [...robot.home_rad];
          q[j] = limit + beyond;
          const { verdict } = checkProgram(turn(q, 0.3, robot), robot);
          expect(verdict.steps[0]!.findings).toContainEqual(
            expect.objectContaining({ code: "limits.joint", joint: j + 1, limit: expect.closeTo(limit, 9) as number }),
          );
          q[j] = limit - beyond;
          expect(
            checkProgram(turn(q, 0.3, robot), robot).verdict.steps[0]!.findings.filter(
              ({ code }) => code === "limits.joint",
            ),
          ).toEqual([]);
        }
      });
    },
  );
});

test("T-17 the speed of a move is a share of the robot's own greatest speed: another maximum, another duration", () => {
  const robot = robotById("yaskawa_gp8")!;
  const q = [2.5, 0, 0, 0, -1.5, 0];
  const slower: Robot = {
    ...robot,
    arm: {
      ...robot.arm,
      joints: robot.arm.joints.map(joint => ({
        ...joint,
        limits: { ...joint.limits, speed_rad_s: joint.limits.speed_rad_s / 4 },
      })),
    },
  };
  const cruise = (one: Robot, ratio: number): number =>
    planProgram(turn(q, ratio, one), one, { start_rad: one.home_rad }).plan.duration_s;
  // A trapezoid of length L at speed v and acceleration a takes L / v + v / a; rounding its corners takes up to 0.1 s
  // more.
  const { speed_rad_s: v, acceleration_rad_s2: a } = robot.arm.joints[0]!.limits;
  expect(Math.abs(cruise(robot, 0.1) - (2.5 / (0.1 * v) + (0.1 * v) / a) - 0.05)).toBeLessThanOrEqual(0.05 + 1e-9);
  expect(Math.abs(cruise(slower, 0.1) - (2.5 / (0.025 * v) + (0.025 * v) / a) - 0.05)).toBeLessThanOrEqual(0.05 + 1e-9);
  expect(cruise(slower, 0.1)).toBeGreaterThan(3.9 * cruise(robot, 0.1) * 0.95);
});
