import { describe, expect, test } from "vitest";
import {
  checkProgram,
  emptyProgram,
  explainReach,
  flangePose,
  reachOfConfiguration,
  robotById,
  solveAll,
  type DeclaredWorkspace,
  type Program,
  type Robot,
} from "../index.ts";

const ur10e = robotById("ur10e")!;

/** A posture whose wrist centre is that far from axis 2: wrist in line with the forearm, elbow bent. */
function configurationAt(distance_m: number): number[] {
  const { workspace } = ur10e;
  // Written out: upper arm 612.7 mm, forearm 571.55 mm, and 119.85 mm on from axis 4 to where axes 5 and 6 meet.
  const upper = 0.6127;
  const rest = 0.57155 + 0.11985;
  const elbow = Math.acos((distance_m ** 2 - upper ** 2 - rest ** 2) / (2 * upper * rest));
  const q = [0.4, -0.9, elbow, -Math.PI / 2, 0.3, 0.2];
  expect(reachOfConfiguration(ur10e, workspace!, q)).toBeCloseTo(distance_m, 8);
  return q;
}
const programTo = (q: number[], robot: Robot): Program => ({
  ...emptyProgram(robot.id),
  steps: [{ id: "there", type: "move", path: "ptp", target: { q }, speed: { ratio: 0.5 }, blend_m: 0 }],
});

describe("X-08 the declared reach of the UR10e, from axis 2 to the wrist centre", () => {
  test("1299 mm are ok, 1301 mm are refused by a finding of its own; the links alone would reach 1304.1 mm", () => {
    const near = checkProgram(programTo(configurationAt(1.299), ur10e), ur10e).verdict;
    expect(near.steps[0]!.findings.filter(({ code }) => code.startsWith("reach"))).toEqual([]);
    const far = checkProgram(programTo(configurationAt(1.301), ur10e), ur10e).verdict;
    expect(far.ok).toBe(false);
    expect(far.steps[0]!.findings).toContainEqual(
      expect.objectContaining({
        code: "reach.beyond-workspace",
        value: expect.closeTo(1.301, 6) as number,
        limit: 1.3,
        unit: "m",
        sentence: "The wrist would be 1301 mm from axis 2; Universal Robots UR10e is declared to reach 1300 mm.",
      }),
    );
    configurationAt(1.3041);
    expect(() => configurationAt(1.3042)).toThrow();
  });

  test("a pose is refused with another answer than one the links cannot reach", () => {
    // An arm with a closed form and a workspace of 1299.5 mm around axis 2: the same poses with and without it.
    const arm = robotById("kuka_kr6_2")!;
    const workspace: DeclaredWorkspace = { reach_m: 1.2995, wristInFlange_m: [0, 0, -0.115] };
    const fenced: Robot = { ...arm, workspace };
    const stretched = (bend: number): number[] => [0, -0.6, bend, 0.3, 0.5, 0.1];
    const poses: [number, number][] = [];
    for (let bend = 0; bend < 1.2; bend += 0.01)
      poses.push([bend, reachOfConfiguration(arm, workspace, stretched(bend))]);
    const [inside] = poses.filter(([, d]) => d < 1.2995).sort((a, b) => b[1] - a[1]);
    const [outside] = poses.filter(([, d]) => d > 1.2995).sort((a, b) => a[1] - b[1]);
    expect(solveAll(fenced, flangePose(arm.arm, stretched(inside![0]))).kind).toBe("reached");
    const refused = solveAll(fenced, flangePose(arm.arm, stretched(outside![0])));
    expect(refused).toMatchObject({
      kind: "beyond-workspace",
      distance_m: expect.closeTo(outside![1], 9) as number,
      declared_m: 1.2995,
    });
    expect(explainReach(refused)).toMatch(
      /^The wrist would be 13\d\d mm from axis 2; the maker declares a reach of 13?\d\d\d? mm\.$/,
    );
    expect(solveAll(arm, flangePose(arm.arm, stretched(outside![0]))).kind).toBe("reached");
    expect(solveAll(fenced, { position: [3, 0, 1], quaternion: [0, 0, 0, 1] }).kind).toBe("too-far");
  });
});
