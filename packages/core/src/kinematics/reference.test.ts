import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { allBranches, flangePose, fromMatrix, robotById, wrapAngle, type Pose } from "../index.ts";

const fixture = (name: string): unknown =>
  JSON.parse(readFileSync(new URL(`../../../../fixtures/kinematics/${name}`, import.meta.url), "utf8"));
const robot = robotById("staubli_rx90l")!;

/** Witness of both files: pinocchio, cross-checked with yourdfpy and MuJoCo; solutions by EAIK. Units m, rad. */
const forward = fixture("staubli_rx90l.forward.json") as { samples: { q: number[]; T: number[][] }[] };
const inverse = fixture("staubli_rx90l.inverse.json") as { poses: { T: number[][]; solutions: number[][] }[] };

function poseOf(T: number[][]): Pose<"base", "flange"> {
  return {
    position: [T[0]![3]!, T[1]![3]!, T[2]![3]!],
    quaternion: fromMatrix([...T[0]!.slice(0, 3), ...T[1]!.slice(0, 3), ...T[2]!.slice(0, 3)]),
  };
}
function gap(got: Pose, wanted: Pose): number {
  const sign = Math.sign(got.quaternion.reduce((sum, value, i) => sum + value * wanted.quaternion[i]!, 0));
  return Math.max(
    ...got.position.map((value, i) => Math.abs(value - wanted.position[i]!)),
    ...got.quaternion.map((value, i) => Math.abs(value - sign * wanted.quaternion[i]!)),
  );
}

test("N-10 forward kinematics agrees with every reference case to 1e-9", () => {
  expect(forward.samples.length).toBe(200);
  for (const { q, T } of forward.samples) expect(gap(flangePose(robot.arm, q), poseOf(T))).toBeLessThan(1e-9);
});

test("N-11 inverse kinematics finds every solution of the reference and invents none", () => {
  expect(inverse.poses.length).toBe(200);
  for (const { T, solutions } of inverse.poses) {
    const got = allBranches(robot, poseOf(T));
    expect(got.length).toBe(solutions.length);
    for (const wanted of solutions) {
      const nearest = Math.min(
        ...got.map(q => Math.max(...wanted.map((angle, i) => Math.abs(wrapAngle(angle - q[i]!))))),
      );
      expect(nearest).toBeLessThan(1e-9);
    }
  }
});
