import { compose, flangePose, identity, inverse, type Pose, type Reach, type Robot } from "@twincell/core";

/**
 * A second, independent solver for poses: damped least squares on finite differences of the forward kinematics.
 * Slow and near-sighted; it is here so that tests have a witness that shares nothing with the closed form.
 */
export function numericSolver(
  robot: Robot,
): (baseFromFlange: Pose<"base", "flange">, near_rad: ArrayLike<number>) => Reach {
  const n = robot.arm.joints.length;
  return (wanted, near_rad) => {
    const q_rad = Float64Array.from(near_rad);
    const step = 1e-6;
    for (let turn = 0; turn < 200; turn++) {
      const error = difference(flangePose(robot.arm, q_rad), wanted);
      if (Math.hypot(...error) < 1e-10) {
        return {
          kind: "reached",
          solutions: [{ q_rad, branch: { shoulder: "front", elbow: "up", wrist: "positive" } }],
          singular: false,
          considered: 1,
        };
      }
      const columns = Array.from({ length: n }, (_, j) => {
        const moved = Float64Array.from(q_rad);
        moved[j]! += step;
        return difference(flangePose(robot.arm, moved), wanted).map((value, i) => (error[i]! - value) / step);
      });
      const jjt = error.map((_, a) =>
        error.map((__, b) => columns.reduce((sum, column) => sum + column[a]! * column[b]!, a === b ? 1e-8 : 0)),
      );
      const y = solveLinear(jjt, error);
      const steps = columns.map(column => column.reduce((sum, value, i) => sum + value * y[i]!, 0));
      const damp = Math.min(1, LONGEST_STEP_RAD / Math.hypot(...steps));
      steps.forEach((by, j) => {
        q_rad[j]! += damp * by;
      });
    }
    return { kind: "no-solver", because: "The search did not come to an end." };
  };
}

const LONGEST_STEP_RAD = 0.2;

/** Position [m] and rotation [rad] still to go, seen in the flange that is. */
function difference(baseFromIs: Pose<"base", "flange">, baseFromWanted: Pose<"base", "flange">): number[] {
  const isFromBase = inverse(baseFromIs);
  const gap = compose(isFromBase as Pose, baseFromWanted as Pose, identity());
  const [x, y, z, w] = gap.quaternion;
  const sign = w < 0 ? -2 : 2;
  return [...gap.position, sign * x, sign * y, sign * z];
}

/** Gaussian elimination with row exchange; the inputs are used up. */
function solveLinear(a: number[][], b: readonly number[]): number[] {
  const x = [...b];
  const n = x.length;
  for (let k = 0; k < n; k++) {
    let pivot = k;
    for (let i = k; i < n; i++) if (Math.abs(a[i]![k]!) > Math.abs(a[pivot]![k]!)) pivot = i;
    [a[k], a[pivot]] = [a[pivot]!, a[k]!];
    [x[k], x[pivot]] = [x[pivot]!, x[k]!];
    for (let i = k + 1; i < n; i++) {
      const factor = a[i]![k]! / a[k]![k]!;
      for (let j = k; j < n; j++) a[i]![j]! -= factor * a[k]![j]!;
      x[i]! -= factor * x[k]!;
    }
  }
  for (let k = n - 1; k >= 0; k--) {
    for (let j = k + 1; j < n; j++) x[k]! -= a[k]![j]! * x[j]!;
    x[k]! /= a[k]![k]!;
  }
  return x;
}
