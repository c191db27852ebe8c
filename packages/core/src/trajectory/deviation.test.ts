import { describe, expect, test } from "vitest";
import { flangePose } from "../kinematics/forward.ts";
import { nearestSolution } from "../kinematics/inverse.ts";
import { robotById } from "../robots/library/index.ts";
import type { Pose } from "../spatial/pose.ts";
import { distance, type Vector3 } from "../spatial/vector.ts";
import { jointMoveDeviation, configurationsAlongLine } from "./deviation.ts";

const robot = robotById("staubli_rx90l")!;
const at = (position: Vector3): Pose<"base", "tcp"> => ({ position, quaternion: [1, 0, 0, 0] });
const A = at([0.5, -0.3, 0.4]);
const B = at([0.6, 0.3, 0.4]);
function posture(pose: Pose<"base", "tcp">): Float64Array {
  const q = new Float64Array(6);
  if (!nearestSolution(robot, { position: pose.position, quaternion: pose.quaternion }, [0, -1, 2, 0, 0.6, 0], q))
    throw new Error("out of reach");
  return q;
}
/** Slow witness: distance to the line at many places. */
function worstOff(q0: Float64Array, q1: Float64Array, a: Vector3, b: Vector3): number {
  const length = distance(a, b);
  let worst = 0;
  for (let k = 0; k <= 2000; k++) {
    const p = flangePose(
      robot.arm,
      q0.map((x, j) => x + ((q1[j]! - x) * k) / 2000),
    ).position;
    const t = Math.min(1, Math.max(0, a.reduce((sum, x, i) => sum + (p[i]! - x) * (b[i]! - x), 0) / length ** 2));
    worst = Math.max(
      worst,
      distance(p, [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t]),
    );
  }
  return worst;
}

describe("joint interpolation beside a straight line", () => {
  test("N-58 the largest deviation of a joint move is found", () => {
    const q0 = posture(A);
    const q1 = posture(B);
    const found = jointMoveDeviation(robot, q0, q1);
    expect(found.deviation_m).toBeGreaterThan(0.02);
    expect(found.deviation_m).toBeCloseTo(worstOff(q0, q1, A.position, B.position), 6);
    expect(jointMoveDeviation(robot, q0, q0)).toMatchObject({ deviation_m: 0 });
  });

  test.each([1e-3, 1e-4, 1e-5])("N-58 points are put in until %f m is kept", tolerance_m => {
    const found = configurationsAlongLine(robot, posture(A), A, B, tolerance_m);
    if (found.kind !== "postures") throw new Error("out of reach");
    expect(found.deviation_m).toBeLessThanOrEqual(tolerance_m);
    let before = posture(A);
    let worst = 0;
    for (const q of found.q_rad) {
      worst = Math.max(worst, worstOff(before, q, A.position, B.position));
      before = q;
    }
    expect(worst).toBeLessThan(tolerance_m * 1.05);
    expect(distance(flangePose(robot.arm, found.q_rad.at(-1)!).position, B.position)).toBeLessThan(1e-9);
    // Halving the pieces quarters the deviation: not many more points than that law asks for.
    expect(found.q_rad.length).toBeLessThan(
      4 * Math.sqrt(jointMoveDeviation(robot, posture(A), posture(B)).deviation_m / tolerance_m) + 4,
    );
  });

  test("a line that leaves the reach says where", () => {
    expect(configurationsAlongLine(robot, posture(A), A, at([1.5, 0, 0.4]), 1e-3)).toMatchObject({
      kind: "out-of-reach",
    });
  });
});
