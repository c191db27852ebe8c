import { describe, expect, test } from "vitest";
import { branchOf, flangePose, sameBranch } from "../kinematics/index.ts";
import { seededRandom } from "../random.ts";
import { robotById } from "../robots/library/index.ts";
import type { Robot } from "../model/robot.ts";
import { planProgram } from "./planner.ts";
import { checkProgram } from "../checks/check.ts";
import { parseProgram } from "../program/parse.ts";
import { emptyProgram, type MoveStep, type Program } from "../program/program.ts";
import { serializeProgram } from "../program/serialize.ts";
import { Stepper } from "./stepper.ts";
import { withBranches } from "./with-branches.ts";

function poseStep(robot: Robot, id: string, path: MoveStep["path"], q: readonly number[]): MoveStep {
  const { position, quaternion } = flangePose(robot.arm, q);
  return {
    id,
    type: "move",
    path,
    target: { pose: { position, quaternion }, frame: "world", tool: "flange" },
    speed: path === "ptp" ? { ratio: 1 } : { mps: 0.1 },
    blend_m: 0,
  };
}

/** A joint move to a pose and a straight move from it, many seeds. */
function programOf(robot: Robot, seed: number): Program {
  const random = seededRandom(seed);
  const limits = robot.arm.joints.map(joint => joint.limits);
  const a = limits.map(
    ({ lower_rad, upper_rad }) => (lower_rad + upper_rad) / 2 + (upper_rad - lower_rad) * 0.5 * (random() - 0.5),
  );
  const b = a.map((angle, j) =>
    Math.min(limits[j]!.upper_rad - 0.02, Math.max(limits[j]!.lower_rad + 0.02, angle + 1.4 * (random() - 0.5))),
  );
  return { ...emptyProgram(robot.id), steps: [poseStep(robot, "a", "ptp", a), poseStep(robot, "b", "lin", b)] };
}

/** Where a controller ends that executes the steps one by one; undefined where it stops with a fault. */
function executed(program: Program, robot: Robot): Float64Array | undefined {
  const stepper = new Stepper(robot, program, program.steps, robot.home_rad);
  const q = new Float64Array(robot.arm.joints.length);
  for (let k = 0; k < 100_000; k++) {
    const { kind } = stepper.advance(0.05, 1, q);
    if (kind === "done") return q;
    if (kind !== "running") return undefined;
  }
  return undefined;
}

function endOfPlan(program: Program, robot: Robot): Float64Array | undefined {
  const answer = planProgram(program, robot);
  const last = answer.plan.segments.at(-1);
  return answer.kind === "planned" && last !== undefined
    ? last.q_rad.slice(last.q_rad.length - robot.arm.joints.length)
    : undefined;
}

const far = (a: Float64Array, b: Float64Array): number => Math.max(...a.map((angle, j) => Math.abs(angle - b[j]!)));

describe("withBranches", () => {
  test.each(["staubli_rx90l", "kuka_kr6r900sixx", "ur10e"])(
    "%s: what is executed step by step is what was checked, also where the nearest posture leads nowhere",
    id => {
      const robot = robotById(id)!;
      let rescued = 0;
      let same = 0;
      for (let seed = 1; seed <= 60 && rescued < 3; seed++) {
        const program = programOf(robot, seed);
        const planned = endOfPlan(program, robot);
        if (planned === undefined) continue;
        const needed = withBranches(program, robot, { where: "needed" });
        if (needed === program) {
          same++;
          continue;
        }
        expect(executed(program, robot) ?? planned.map(() => 9)).not.toEqual(planned);
        expect(far(executed(needed, robot)!, planned)).toBeLessThan(1e-6);
        rescued++;
      }
      expect(rescued).toBe(3);
      expect(same).toBeGreaterThan(0);
    },
  );

  test("everywhere: every pose has its branch, the plan stays the same, and the file is read again", () => {
    for (const id of ["staubli_rx90l", "ur10e", "kuka_lbr_iiwa_14_r820"]) {
      const robot = robotById(id)!;
      const program = [1, 2, 3, 4, 5, 6]
        .map(seed => programOf(robot, seed))
        .find(one => endOfPlan(one, robot) !== undefined)!;
      const written = withBranches(program, robot);
      const end = endOfPlan(program, robot)!;
      for (const step of written.steps)
        expect(step.type === "move" && ("q" in step.target || step.target.branch !== undefined)).toBe(true);
      const last = written.steps.at(-1) as MoveStep;
      if ("pose" in last.target) expect(sameBranch(last.target.branch!, branchOf(robot, end)!)).toBe(true);
      // Seven joints keep their elbow angle to some 1e-5.
      expect(far(endOfPlan(written, robot)!, end)).toBeLessThan(id.includes("iiwa") ? 1e-4 : 1e-6);
      expect(withBranches(written, robot)).toBe(written);
      expect(parseProgram(serializeProgram(written))).toMatchObject({ kind: "program" });
    }
  });

  test("a straight path that runs joint 6 into its limit in every posture says how far the best gets", () => {
    const robot = robotById("staubli_rx90l")!;
    const q = [0, -1, 2, 0, 0.8, 4.6];
    const program: Program = {
      ...emptyProgram(robot.id),
      steps: [
        { ...poseStep(robot, "a", "ptp", q), target: { q } },
        poseStep(robot, "b", "lin", [0, -1, 2, 0, 0.8, 5.2]),
      ],
    };
    const findings = checkProgram(program, robot).verdict.steps.find(step => step.id === "b")!.findings;
    expect(findings.find(({ code }) => code === "branch.no-way")).toMatchObject({ joint: 6, unit: "1", limit: 1 });
    expect(findings.find(({ code }) => code === "branch.flip")!.sentence).toMatch(
      /turns over before this step.*joint \d by \d+\.\d° where it stands\./,
    );
  });
});
